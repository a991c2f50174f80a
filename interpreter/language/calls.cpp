// Calls: declared functions, builtin functions, and `edge.at(...)`, `draped.length(...)`.
#include <algorithm>

#include "interpreter/language/curve_values.hpp"
#include "interpreter/language/declarations.hpp"
#include "interpreter/language/edges.hpp"
#include "interpreter/language/evaluate.hpp"
#include "interpreter/language/formal_parameters.hpp"
#include "interpreter/language/function_table.hpp"

namespace garment::interpreter {
namespace {

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

/// Puts the arguments of a call, and the defaults of what is not given, into the scope of the function.
[[gnu::noinline]] void bind_arguments(Program& program, const Declaration& function, const Expr& expr,
                                      Scope& scope, Scope& local) {
  const Statement& statement = *function.statement;
  const std::vector<FormalParameter> parameters = parameters_of(program, statement.operands[0]);
  const std::vector<std::size_t> given =
      match_arguments(program, function.name, parameters, expr, statement.operands[0].span);
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    if (given[p] == 0) continue;
    const Expr& argument = expr.children[given[p]];
    local.values.emplace(parameters[p].name, checked_kind(program, parameters[p].name, parameters[p].kind,
                                                          eval(program, argument, scope), argument.span));
  }
  for (const FormalParameter& parameter : parameters) {
    if (local.values.contains(parameter.name)) continue;
    local.values.emplace(parameter.name,
                         checked_kind(program, parameter.name, parameter.kind,
                                      eval(program, *parameter.standard, local), parameter.standard->span));
  }
}

/// Value of a function whose parameters stand in `local`.
[[gnu::noinline]] Value run_body(Program& program, const Declaration& function, Scope& local) {
  return eval(program, function.statement->clauses[0].values[0], local);
}

[[gnu::noinline]] Value call_declared(Program& program, const Declaration& function, const Expr& expr,
                                      Scope& scope) {
  CallGuard guard(program, expr.span);
  Scope local;
  local.parent = function.scope;
  local.module = function.module;
  local.half = scope.half;
  bind_arguments(program, function, expr, scope, local);
  Value result = run_body(program, function, local);
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

[[gnu::noinline]] Value curve_at(Program& program, const Expr& expr, const geometry::Curve& curve, Scope& scope) {
  if (expr.children.size() != 2)
    fail(program, Message("G0307", "`at` takes one position", expr.span).help("as in `curve.at(5 cm)`"));
  const Value at = eval(program, expr.children[1], scope);
  const design::Point2 p = curve.point_at(position_along(program, at, curve.length(), expr.children[1].span, "`at`"));
  return Value{PointValue{{p.x(), p.y(), 0}, 2, kLength, -1}};
}

}  // namespace

Value call_function(Program& program, const Value& function, const std::vector<Value>& values, const Expr& call,
                    Span asked_at) {
  const auto* declared = function.as<FunctionValue>();
  if (declared == nullptr)
    fail(program, Message("G0306", kind_of(function) + " where a function is wanted", asked_at)
                      .help("declare one, as in `fn half(x) = x / 2`, and give its name"));
  count_step(program, call.span);
  CallGuard guard(program, call.span);
  const Declaration& declaration = *declared->declaration;
  const std::vector<FormalParameter> parameters = parameters_of(program, declaration.statement->operands[0]);
  std::size_t required = 0;
  for (const FormalParameter& parameter : parameters) required += parameter.standard == nullptr;
  if (values.size() > parameters.size() || values.size() < required)
    fail(program, Message("G0307",
                          "`" + declaration.name + "` takes " + std::to_string(parameters.size()) +
                              (parameters.size() == 1 ? " value" : " values") + ", here it is given " +
                              std::to_string(values.size()),
                          asked_at)
                      .also(declaration.statement->operands[0].span, "declared here"));
  Scope local;
  local.parent = declaration.scope;
  local.module = declaration.module;
  for (std::size_t k = 0; k < parameters.size(); ++k)
    local.values.emplace(parameters[k].name,
                         k < values.size()
                             ? checked_kind(program, parameters[k].name, parameters[k].kind, values[k], asked_at)
                             : checked_kind(program, parameters[k].name, parameters[k].kind,
                                            eval(program, *parameters[k].standard, local),
                                            parameters[k].standard->span));
  return run_body(program, declaration, local);
}

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

namespace {

/// An argument of a builtin; a direction (+x, an angle) becomes a unit vector.
Value eval_argument(Program& program, const FunctionRecord& record, std::size_t k, const Expr& expr, Scope& scope) {
  const bool named = k < record.parameters.size();
  if (!named || std::find(record.directions.begin(), record.directions.end(), record.parameters[k]) ==
                    record.directions.end())
    return eval(program, expr, scope);
  const design::Point2 way = eval_direction(program, expr, scope, "`" + std::string(record.parameters[k]) + "`");
  return Value{PointValue{{way.x(), way.y(), 0}, 2, kNumber, -1}};
}

}  // namespace

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
    call.arguments[at] = eval_argument(program, record, at, child, scope);
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
    if (const auto* curve = base.as<CurveValue>(); curve != nullptr && callee.text == "at")
      return curve_at(program, expr, (*curve)->curve, scope);
    if (const auto* panel = base.as<PanelValue>(); panel != nullptr && callee.text == "at") {
      if (expr.children.size() != 2)
        fail(program, Message("G0307", "`at` takes one point of a panel", expr.span).help("as in `front.at((3 cm, 4 cm))`"));
      PointValue p = eval_point(program, expr.children[1], scope, 2, kLength, "`at`");
      p.panel = panel->panel;
      return Value{p};
    }
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
