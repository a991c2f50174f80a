#include "interpreter/language/formal_parameters.hpp"

#include <algorithm>

#include "interpreter/language/word_lists.hpp"

namespace garment::interpreter {
namespace {

constexpr std::pair<std::string_view, Dimension> kQuantityKinds[] = {{"number", kNumber}, {"length", kLength},
                                                                     {"angle", kAngle},   {"area", kArea},
                                                                     {"time", kTime},     {"mass", kMass}};
constexpr std::string_view kOtherKinds[] = {"text",  "truth",  "point", "list",  "record", "function",
                                            "curve", "fabric", "body",  "panel", "edge",   "part"};

std::vector<std::string> kind_names() {
  std::vector<std::string> names(std::begin(kOtherKinds), std::end(kOtherKinds));
  for (const auto& [name, dimension] : kQuantityKinds) names.emplace_back(name);
  return names;
}

bool is_kind(const Value& value, const std::string& kind) {
  if (kind == "text") return value.as<std::string>() != nullptr;
  if (kind == "truth") return value.as<bool>() != nullptr;
  if (kind == "point") return value.as<PointValue>() != nullptr;
  if (kind == "list") return value.as<ListValue>() != nullptr;
  if (kind == "record") return value.as<RecordValue>() != nullptr;
  if (kind == "function") return value.as<FunctionValue>() != nullptr;
  if (kind == "curve") return value.as<CurveValue>() != nullptr || value.as<EdgeValue>() != nullptr;
  if (kind == "fabric") return value.as<FabricValue>() != nullptr;
  if (kind == "body") return value.as<BodyValue>() != nullptr;
  if (kind == "panel") return value.as<PanelValue>() != nullptr;
  if (kind == "part") {
    const auto* thing = value.as<ThingValue>();
    return thing != nullptr && thing->keyword == "part";
  }
  return value.as<EdgeValue>() != nullptr;
}

}  // namespace

Value checked_kind(Program& program, const std::string& name, const std::string& kind, Value value,
                   Span span) {
  if (kind.empty()) return value;
  for (const auto& [word, dimension] : kQuantityKinds)
    if (word == kind) return Value{as_quantity(program, value, span, dimension, "`" + name + "`")};
  if (is_kind(value, kind)) return value;
  const char* article = kind == "text" ? "" : kind == "edge" ? "an " : "a ";
  fail(program, Message("G0306", kind_of(value) + " where `" + name + "` takes " + article + kind, span));
}

std::vector<FormalParameter> parameters_of(Program& program, const Expr& head) {
  std::vector<FormalParameter> parameters;
  const std::vector<std::string> kinds = kind_names();
  for (std::size_t k = 1; k < head.children.size(); ++k) {
    const Expr& child = head.children[k];
    FormalParameter parameter;
    const bool labelled = k < head.labels.size() + 1 && !head.labels[k - 1].text.empty();
    const bool standard = child.kind == ExprKind::binary && child.text == "=" && child.children.size() == 2;
    const Expr& word = standard ? child.children[0] : child;
    if (word.kind != ExprKind::name || (standard && !labelled))
      fail(program,
           Message("G0307", "a parameter is `name`, `name: kind` or `name: kind = default`", child.span));
    if (labelled) {
      parameter.name = head.labels[k - 1].text;
      parameter.kind = word.text;
      if (std::find(kinds.begin(), kinds.end(), parameter.kind) == kinds.end()) {
        std::string hint = did_you_mean(parameter.kind, kinds);
        if (hint.empty()) {
          for (const std::string& kind : kinds) hint += (hint.empty() ? "kinds are " : ", ") + kind;
        }
        fail(program, Message("G0301", "there is no kind `" + parameter.kind + "`", word.span).help(hint));
      }
      if (standard) parameter.standard = &child.children[1];
    } else {
      parameter.name = word.text;
    }
    for (const FormalParameter& other : parameters)
      if (other.name == parameter.name)
        fail(program, Message("G0302", "the parameter `" + parameter.name + "` is there twice", child.span));
    parameter.span = child.span;
    parameters.push_back(parameter);
  }
  return parameters;
}

std::string label_of(const Expr& call, std::size_t k) {
  return k - 1 < call.labels.size() ? call.labels[k - 1].text : "";
}

void fail_label(Program& program, const Expr& call, std::size_t k, const std::string& function,
                const std::vector<std::string>& names) {
  Message message("G0307", "`" + function + "` takes no `" + label_of(call, k) + "`",
                  call.labels[k - 1].span);
  std::string hint = did_you_mean(label_of(call, k), names);
  if (hint.empty() && !names.empty()) hint = "it takes " + listed(names);
  fail(program, message.help(hint));
}

std::vector<std::size_t> match_arguments(Program& program, const std::string& name,
                                         const std::vector<FormalParameter>& parameters, const Expr& call,
                                         Span head) {
  std::vector<std::string> names;
  for (const FormalParameter& parameter : parameters) names.push_back(parameter.name);
  std::vector<std::size_t> given(parameters.size(), 0);
  std::size_t next = 0;
  const std::size_t count = call.kind == ExprKind::call ? call.children.size() : 1;
  for (std::size_t k = 1; k < count; ++k) {
    const std::string label = label_of(call, k);
    if (label.empty() && next >= parameters.size())
      fail(program, Message("G0307",
                            "`" + name + "` takes " + std::to_string(parameters.size()) +
                                (parameters.size() == 1 ? " value" : " values") + ", here is one more",
                            call.children[k].span)
                        .also(head, "declared here")
                        .help(names.empty() ? "leave it out" : "it takes " + listed(names) + ", in this order or by name"));
    const auto found = label.empty() ? names.begin() + static_cast<std::ptrdiff_t>(next++)
                                     : std::find(names.begin(), names.end(), label);
    if (found == names.end()) fail_label(program, call, k, name, names);
    std::size_t& place = given[static_cast<std::size_t>(found - names.begin())];
    if (place != 0) fail(program, Message("G0314", "`" + *found + "` is given twice", call.children[k].span));
    place = k;
  }
  for (std::size_t p = 0; p < parameters.size(); ++p)
    if (given[p] == 0 && parameters[p].standard == nullptr)
      fail(program, Message("G0307", "`" + name + "` needs `" + parameters[p].name + "`", call.span)
                        .also(head, "declared here")
                        .help("add `" + parameters[p].name + ": VALUE`; it takes " + listed(names)));
  return given;
}

}  // namespace garment::interpreter
