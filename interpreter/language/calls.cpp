// Calls: declared functions, builtin functions, and `edge.at(...)`, `draped.length(...)`.
#include <algorithm>

#include "interpreter/language/declarations.hpp"
#include "interpreter/language/edges.hpp"
#include "interpreter/language/evaluate.hpp"
#include "interpreter/language/function_table.hpp"

namespace garment::interpreter {
namespace {

constexpr std::size_t kMaxCalls = 256;

struct CallGuard {
  Program& program;
  CallGuard(Program& p, Span span) : program(p) {
    if (p.calls.size() >= kMaxCalls)
      fail(p, Message("G0316", "calls are nested more than 256 deep", span)
                  .help("a function that calls itself needs an `if` that ends it"));
    p.calls.push_back(span);
  }
  CallGuard(const CallGuard&) = delete;
  CallGuard& operator=(const CallGuard&) = delete;
  ~CallGuard() { program.calls.pop_back(); }
};

struct FormalParameter {
  std::string name;
  std::string kind;  ///< "length", "number", ...; empty: anything
  const Expr* standard = nullptr;
};

constexpr std::pair<std::string_view, Dimension> kQuantityKinds[] = {{"number", kNumber}, {"length", kLength},
                                                                     {"angle", kAngle},   {"area", kArea},
                                                                     {"time", kTime},     {"mass", kMass}};
constexpr std::string_view kOtherKinds[] = {"text",   "truth", "point", "list",
                                            "fabric", "body",  "panel", "edge"};

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
  if (kind == "fabric") return value.as<FabricValue>() != nullptr;
  if (kind == "body") return value.as<BodyValue>() != nullptr;
  if (kind == "panel") return value.as<PanelValue>() != nullptr;
  return value.as<EdgeValue>() != nullptr;
}

/// The value as its parameter takes it, or a report and Stop.
Value checked_kind(Program& program, const FormalParameter& parameter, Value value, Span span) {
  if (parameter.kind.empty()) return value;
  for (const auto& [name, dimension] : kQuantityKinds)
    if (name == parameter.kind)
      return Value{as_quantity(program, value, span, dimension, "`" + parameter.name + "`")};
  if (is_kind(value, parameter.kind)) return value;
  const bool vowel = parameter.kind == "edge";
  fail(program, Message("G0306",
                        kind_of(value) + " where `" + parameter.name + "` takes " +
                            (parameter.kind == "text" ? ""
                             : vowel                  ? "an "
                                                      : "a ") +
                            parameter.kind,
                        span));
}

/// Parameters of `fn f(a, b: length, c: length = 2 cm)`; they stand as the arguments of a call.
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
    parameters.push_back(parameter);
  }
  return parameters;
}

std::string label_of(const Expr& call, std::size_t k) {
  return k - 1 < call.labels.size() ? call.labels[k - 1].text : "";
}

[[noreturn]] void fail_label(Program& program, const Expr& call, std::size_t k, const std::string& function,
                             const std::vector<std::string>& names) {
  Message message("G0307", "`" + function + "` takes no `" + label_of(call, k) + "`",
                  call.labels[k - 1].span);
  std::string hint = did_you_mean(label_of(call, k), names);
  if (hint.empty()) {
    for (const std::string& name : names) hint += (hint.empty() ? "it takes " : ", ") + name;
  }
  fail(program, message.help(hint));
}

/// Puts the arguments of a call, and the defaults of what is not given, into the scope of the function.
[[gnu::noinline]] void bind_arguments(Program& program, const Declaration& function, const Expr& expr,
                                      Scope& scope, Scope& local) {
  const Statement& statement = *function.statement;
  const std::vector<FormalParameter> parameters = parameters_of(program, statement.operands[0]);
  std::vector<std::string> names;
  for (const FormalParameter& parameter : parameters) names.push_back(parameter.name);
  std::size_t next = 0;
  for (std::size_t k = 1; k < expr.children.size(); ++k) {
    std::string name = label_of(expr, k);
    if (name.empty()) {
      if (next >= parameters.size())
        fail(program, Message("G0307",
                              "`" + function.name + "` takes " + std::to_string(parameters.size()) +
                                  (parameters.size() == 1 ? " value" : " values") + ", here is one more",
                              expr.children[k].span));
      name = parameters[next++].name;
    } else if (std::find(names.begin(), names.end(), name) == names.end()) {
      fail_label(program, expr, k, function.name, names);
    }
    if (local.values.contains(name))
      fail(program, Message("G0314", "`" + name + "` is given twice", expr.children[k].span));
    const auto formal = std::find(names.begin(), names.end(), name) - names.begin();
    local.values.emplace(name, checked_kind(program, parameters[static_cast<std::size_t>(formal)],
                                            eval(program, expr.children[k], scope), expr.children[k].span));
  }
  for (const FormalParameter& parameter : parameters) {
    if (local.values.contains(parameter.name)) continue;
    if (parameter.standard == nullptr)
      fail(program, Message("G0307", "`" + function.name + "` needs `" + parameter.name + "`", expr.span)
                        .also(statement.operands[0].span, "declared here"));
    local.values.emplace(parameter.name,
                         checked_kind(program, parameter, eval(program, *parameter.standard, local),
                                      parameter.standard->span));
  }
}

[[gnu::noinline]] Value call_declared(Program& program, const Declaration& function, const Expr& expr,
                                      Scope& scope) {
  CallGuard guard(program, expr.span);
  Scope local;
  local.parent = function.scope;
  local.module = function.module;
  local.half = scope.half;
  bind_arguments(program, function, expr, scope, local);
  Value result = eval(program, function.statement->clauses[0].values[0], local);
  if (local.half_used)
    for (const Scope* at = &scope; at != nullptr; at = at->parent) at->half_used = true;
  return result;
}

[[gnu::noinline]] Value edge_at(Program& program, const Expr& expr, const EdgeValue& edge, Scope& scope) {
  if (edge.spans.size() != 1 || expr.children.size() != 2)
    fail(program,
         Message("G0307", "`at` takes one position on one edge", expr.span).help("as in `edge.at(5 cm)`"));
  const EdgeSpan& span = edge.spans[0];
  const double length = cut_length(span);
  auto mark = [&](std::string_view name) -> std::optional<double> {
    if (name == "start") return 0.0;
    if (name == "end") return length;
    return notch_position(program, span, name);
  };
  const double at = eval_position(program, {expr.children[1]}, scope, length, mark, expr.span, "`at`");
  if (!(at >= -1e-6 && at <= length + 1e-6))
    fail(program,
         Message("G0309",
                 format_quantity(at, kLength) + " along an edge of " + format_quantity(length, kLength),
                 expr.children[1].span));
  const design::Point2 p = point_at(program, span, at);
  return Value{PointValue{{p.x(), p.y(), 0}, 2, kLength, span.panel}};
}

}  // namespace

void check_function(Program& program, const Declaration& declaration) {
  const Statement& statement = *declaration.statement;
  if (statement.operands.size() != 1 || statement.operands[0].kind != ExprKind::call)
    fail(program, Message("G0307", "`fn` needs its parameters in parentheses", statement.keyword.span)
                      .help("as in `fn half(x) = x / 2`"));
  if (statement.clauses.size() != 1 || statement.clauses[0].values.size() != 1)
    fail(program, Message("G0312", "`fn` needs `=` and one value", statement.keyword.span));
  for (const FormalParameter& parameter : parameters_of(program, statement.operands[0]))
    if (find_unit(parameter.name) || find_function(parameter.name) != nullptr)
      fail(program, Message("G0303", "the parameter `" + parameter.name + "` hides a unit or builtin",
                            statement.operands[0].span));
}

Value call_builtin(Program& program, const FunctionRecord& record, const Expr& expr, Scope& scope) {
  Call call{program, record, expr, {}, {}};
  const std::size_t n = record.parameters.size();
  call.arguments.resize(n);
  call.places.resize(n, nullptr);
  std::size_t next = 0;
  const std::vector<std::string> names(record.parameters.begin(), record.parameters.end());
  const std::size_t count = expr.kind == ExprKind::call ? expr.children.size() : 1;
  for (std::size_t k = 1; k < count; ++k) {
    const Expr& child = expr.children[k];
    const std::string label = label_of(expr, k);
    std::size_t at = next;
    if (!label.empty()) {
      at = static_cast<std::size_t>(std::find(names.begin(), names.end(), label) - names.begin());
      if (at == n && record.open) {
        for (const auto& [name, value] : call.further)
          if (name == label) fail(program, Message("G0314", "`" + label + "` is given twice", child.span));
        call.further.emplace_back(label, eval(program, child, scope));
        call.further_places.push_back(&child);
        continue;
      }
      if (at == n) fail_label(program, expr, k, std::string(record.name), names);
    } else {
      ++next;
    }
    if (at >= n && record.many) {
      call.arguments.push_back(eval(program, child, scope));
      call.places.push_back(&child);
      continue;
    }
    if (at >= n)
      fail(program, Message("G0307",
                            "`" + std::string(record.name) + "` takes " +
                                (n == 0 ? "no value" : std::to_string(n) + (n == 1 ? " value" : " values")) +
                                ", here is one more",
                            child.span)
                        .help("write `" + std::string(record.form) + "`"));
    if (call.places[at] != nullptr)
      fail(program, Message("G0314", "`" + names[at] + "` is given twice", child.span));
    call.arguments[at] = eval(program, child, scope);
    call.places[at] = &child;
  }
  for (std::size_t k = 0; k < record.required; ++k)
    if (call.places[k] == nullptr && expr.kind == ExprKind::call)
      fail(program, Message("G0307", "`" + std::string(record.name) + "` needs `" + names[k] + "`", expr.span)
                        .help("write `" + std::string(record.form) + "`"));
  return record.run(call);
}

Value eval_call(Program& program, const Expr& expr, Scope& scope) {
  const Expr& callee = expr.children[0];
  Value function;
  if (callee.kind == ExprKind::name) {
    const std::string name = name_of(program, callee, scope);
    if (const Value* local = find_local(scope, name)) {
      function = *local;
    } else if (Declaration* declaration = find_declaration(scope, name)) {
      function = force(program, *declaration, callee.span);
    } else if (const FunctionRecord* record = find_function(name)) {
      return call_builtin(program, *record, expr, scope);
    } else {
      fail_unknown_name(program, name, callee.span, scope);
    }
  } else if (callee.kind == ExprKind::member) {
    const Value base = eval(program, callee.children[0], scope);
    if (const auto* edge = base.as<EdgeValue>(); edge != nullptr && callee.text == "at")
      return edge_at(program, expr, *edge, scope);
    if (base.as<DrapedValue>() != nullptr) {
      if (const FunctionRecord* record = find_function("draped." + callee.text))
        return call_builtin(program, *record, expr, scope);
      fail(program, Message("G0311", "`draped` has no `" + callee.text + "`", callee.name_span)
                        .help("it has length(EDGE) and area(PANEL)"));
    }
    function = eval(program, callee, scope);
  } else {
    function = eval(program, callee, scope);
  }
  if (const auto* declared = function.as<FunctionValue>())
    return call_declared(program, *declared->declaration, expr, scope);
  fail(program, Message("G0306", kind_of(function) + " cannot be called", callee.span));
}

}  // namespace garment::interpreter
