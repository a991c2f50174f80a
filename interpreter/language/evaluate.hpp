#pragma once
// Expressions: tree in, value out.
#include <optional>
#include <string>

#include "interpreter/language/program.hpp"

namespace garment::interpreter {

/// Value of an expression. Reports and throws Stop where it has none.
Value eval(Program& program, const Expr& expr, Scope& scope);

/// Value of a declaration, evaluated at the first demand. Throws Stop where it failed (said once), and on
/// cycles.
const Value& force(Program& program, Declaration& declaration, Span asked_at);

/// The text of a declared name, or of a name or member expression, with its `{i}` parts filled.
std::string fill_name(Program& program, const grammar::Name& name, Scope& scope);
std::string name_of(Program& program, const Expr& expr, Scope& scope);

/// Declared thing or builtin of that name; nothing if there is none.
Declaration* find_declaration(Scope& scope, std::string_view name);
/// Of what is declared left and right (a pair, or by `both`): the one of the scope's half; nothing if nothing of that name
/// is. Reports and throws Stop where the scope has no half.
Declaration* find_half(Program& program, Scope& scope, const std::string& name, Span span);
const Value* find_local(Scope& scope, std::string_view name);
/// Names that could be meant at this place.
std::vector<std::string> visible_names(const Scope& scope);
/// True where a name that could be meant is known here.
bool known_name_is_near(const Program& program, const std::string& name, const Scope& scope);
[[noreturn]] void fail_unknown_name(Program& program, const std::string& name, Span span, Scope& scope);

/// Values of one kind. They report and throw Stop where the expression is of another kind; `what` names the
/// place for the message ("`offset`").
Quantity eval_quantity(Program& program, const Expr& expr, Scope& scope, Dimension dimension,
                       const std::string& what);
Quantity as_quantity(Program& program, const Value& value, Span span, Dimension dimension,
                     const std::string& what);
bool eval_truth(Program& program, const Expr& expr, Scope& scope, const std::string& what);
std::string eval_text(Program& program, const Expr& expr, Scope& scope, const std::string& what);
PointValue eval_point(Program& program, const Expr& expr, Scope& scope, int size, Dimension dimension,
                      const std::string& what);
int eval_panel(Program& program, const Expr& expr, Scope& scope, const std::string& what);
EdgeValue eval_edges(Program& program, const Expr& expr, Scope& scope, const std::string& what);
/// `+x -x +y -y` or an angle from +x; a unit vector.
design::Point2 eval_direction(Program& program, const Expr& expr, Scope& scope, const std::string& what);

/// `a + b`, `-a` and so on on values; `span` for messages.
Value apply_binary(Program& program, const Expr& expr, const Value& a, const Value& b);
Value apply_unary(Program& program, const Expr& expr, const Value& a);
/// `base.name`.
Value eval_member(Program& program, const Expr& expr, Scope& scope);
Value eval_call(Program& program, const Expr& expr, Scope& scope);
Value eval_range_index(Program& program, const Expr& expr, Scope& scope);
Value eval_with(Program& program, const Expr& expr, Scope& scope);

/// True where the expression (or a function or value it names in this scope) asks the drape.
bool asks_drape(const Expr& expr, Scope& scope);

}  // namespace garment::interpreter
