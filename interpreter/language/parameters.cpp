#include "interpreter/language/parameters.hpp"

#include <algorithm>

#include "interpreter/language/clauses.hpp"
#include "interpreter/language/collections.hpp"

namespace garment::interpreter {
namespace {

constexpr std::size_t kMaxGiven = 10'000;

Value eval_given(Program& program, const std::string& name, const std::string& text, Scope& scope) {
  const grammar::SourceId source = program.sources.add("-p " + name, text.substr(0, kMaxGiven));
  grammar::ExpressionResult parsed = grammar::parse_expression(program.sources, source, vocabulary());
  if (!parsed.diagnostics.empty()) {
    for (Diagnostic& diagnostic : parsed.diagnostics) {
      Message message("", "", Span{});
      message.diagnostic = std::move(diagnostic);
      report(program, std::move(message));
    }
    throw Stop{};
  }
  // A word that names nothing is meant as text: -p fit=slim
  if (parsed.expr.kind == ExprKind::name && find_local(scope, parsed.expr.text) == nullptr &&
      find_declaration(scope, parsed.expr.text) == nullptr)
    return text_value(program, parsed.expr.text, parsed.expr.span);
  return eval(program, parsed.expr, scope);
}

std::string choices(const std::vector<Value>& values) {
  std::string text;
  for (const Value& value : values) {
    if (text.size() > 200) return text + ", ...";
    text += (text.empty() ? "" : ", ") + show(value);
  }
  return text;
}

void check_allowed(Program& program, const std::string& name, const Value& value, const Value& allowed,
                   Span span, Span allowed_span) {
  if (const auto* range = allowed.as<RangeValue>()) {
    const Quantity q = as_quantity(program, value, span, range->from.dimension, "`" + name + "`");
    if (q.value >= range->from.value && q.value <= range->to.value) return;
    fail(program, Message("G0310",
                          "`" + name + "` is " + format_quantity(q.value, q.dimension, q.percent) +
                              "; it must lie in " + show(allowed),
                          span)
                      .also(allowed_span, "allowed"));
  }
  const auto* list = allowed.as<ListValue>();
  if (list == nullptr)
    fail(program,
         Message("G0306", kind_of(allowed) + " where `in` takes a range or a list of choices", allowed_span));
  for (const Value& choice : **list)
    if (equal_values(program, choice, value, span)) return;
  std::vector<std::string> names;
  for (std::size_t k = 0; k < (*list)->size() && k < 1000; ++k) names.push_back(show((**list)[k]));
  const std::string hint = did_you_mean(show(value), names);
  fail(program,
       Message("G0310", "`" + name + "` is " + show(value) + "; the choices are " + choices(**list), span)
           .also(allowed_span, "allowed")
           .help(hint));
}

void check_kind(Program& program, const std::string& name, const Value& value, const Value& standard,
                Span span) {
  if (const auto* q = standard.as<Quantity>()) {
    as_quantity(program, value, span, q->dimension, "`" + name + "`");
    return;
  }
  const bool fabric = standard.as<FabricValue>() != nullptr,
             other = value.data.index() != standard.data.index();
  if (other)
    fail(program, Message("G0306", kind_of(value) + " where `" + name + "` takes " + kind_of(standard), span)
                      .help(fabric ? "as in `fabrics.denim`" : ""));
}

}  // namespace

Value evaluate_param(Program& program, Declaration& declaration) {
  const Statement& statement = *declaration.statement;
  Scope& scope = *declaration.scope;
  Clauses clauses(program, statement, scope);
  const BoundClause& definition = clauses.need("=");
  const std::vector<Expr>& values = definition.clause->values;
  if (values.empty()) fail(program, Message("G0312", "`param` needs a value", statement.keyword.span));
  Parameter parameter;
  parameter.name = declaration.name;
  const Value standard = eval(program, values[0], scope);
  auto take_doc = [&](const std::vector<Expr>& from) {
    if (from.size() > 2 || (from.size() == 2 && from[1].kind != ExprKind::string))
      fail(program,
           Message("G0313", "a param has one value and one text that says what it is", from.back().span)
               .help(std::any_of(from.begin(), from.end(), [](const Expr& e) { return e.kind == ExprKind::name && e.text == "to"; })
                         ? "a range is written with `..`: `in 30 cm .. 90 cm`"
                         : ""));
    if (from.size() == 2) parameter.doc = eval_text(program, from[1], scope, "what the param is");
  };
  take_doc(values);
  Value allowed;
  Span allowed_span = statement.span;
  if (const BoundClause* in = clauses.find("in")) {
    if (in->clause->values.empty())
      fail(program, Message("G0312", "`in` needs a range or a list", in->clause->span));
    take_doc(in->clause->values);
    allowed_span = in->clause->values[0].span;
    allowed = eval(program, in->clause->values[0], scope);
    check_allowed(program, declaration.name, standard, allowed, values[0].span, allowed_span);
    parameter.range = show(allowed);
  }
  clauses.finish();
  Value value = standard;
  Span span = values[0].span;
  for (Override& change : declaration.overrides) {
    change.used = change.path.empty();
    if (!change.path.empty()) continue;
    span = change.value->span;
    value = eval(program, *change.value, *change.scope);
  }
  if (const auto given = program.options.params.find(declaration.name);
      given != program.options.params.end()) {
    parameter.given = true;
    value = eval_given(program, declaration.name, given->second, scope);
    span = Span{static_cast<grammar::SourceId>(program.sources.size() - 1), 0,
                static_cast<std::uint32_t>(given->second.size())};
  }
  check_kind(program, declaration.name, value, standard, span);
  if (allowed.data.index() != 0) check_allowed(program, declaration.name, value, allowed, span, allowed_span);
  if (const auto* q = value.as<Quantity>(); q != nullptr && is_plain_zero(*q))
    value = number_value(0, standard.as<Quantity>()->dimension);
  parameter.standard = show(standard);
  parameter.value = show(value);
  program.parameters.push_back(parameter);
  return value;
}

void forget_param(Program& program, Declaration& declaration) {
  std::erase_if(program.parameters, [&](const Parameter& known) { return known.name == declaration.name; });
}

void check_given_parameters(Program& program) {
  for (const auto& [name, text] : program.options.params) {
    const auto found = program.main->scope->declared.find(name);
    if (found != program.main->scope->declared.end() && found->second->statement->keyword.text == "param")
      continue;
    std::vector<std::string> names;
    for (const auto& [key, declaration] : program.main->scope->declared)
      if (declaration->statement->keyword.text == "param") names.push_back(key);
    const grammar::SourceId source = program.sources.add("-p " + name, text);
    std::string hint = did_you_mean(name, names);
    if (hint.empty() && names.empty()) hint = "the script has no param";
    if (hint.empty()) {
      for (const std::string& key : names) hint += (hint.empty() ? "it has " : ", ") + key;
    }
    report(program, Message("G0324", "the script has no param `" + name + "`",
                            Span{source, 0, static_cast<std::uint32_t>(text.size())})
                        .help(hint));
  }
}

}  // namespace garment::interpreter
