// Names, and expressions of one wanted kind.
#include <algorithm>
#include <set>

#include "interpreter/language/edges.hpp"
#include "interpreter/language/evaluate.hpp"
#include "interpreter/language/function_table.hpp"
#include "interpreter/language/standard_libraries.hpp"
#include "runtime/base/portable_math.hpp"

namespace garment::interpreter {
namespace {

bool name_char(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         (static_cast<unsigned char>(c) & 0x80) != 0;
}

bool scope_asks(const Expr& expr, Scope& scope, std::set<const Declaration*>& seen);

bool name_asks(const std::string& name, Scope& scope, std::set<const Declaration*>& seen) {
  if (find_local(scope, name) != nullptr) return false;
  if (Declaration* declaration = find_declaration(scope, name)) {
    if (!seen.insert(declaration).second || declaration->statement == nullptr) return false;
    const std::string& keyword = declaration->statement->keyword.text;
    if (keyword != "fn" && keyword != "let" && keyword != "measure") return false;
    for (const Clause& clause : declaration->statement->clauses)
      for (const Expr& value : clause.values)
        if (scope_asks(value, *declaration->scope, seen)) return true;
    return false;
  }
  const FunctionRecord* function = find_function(name);
  return function != nullptr && function->asks_drape;
}

bool scope_asks(const Expr& expr, Scope& scope, std::set<const Declaration*>& seen) {
  if (expr.kind == ExprKind::name && name_asks(expr.text, scope, seen)) return true;
  for (const Expr& child : expr.children)
    if (scope_asks(child, scope, seen)) return true;
  return false;
}

}  // namespace

bool asks_drape(const Expr& expr, Scope& scope) {
  std::set<const Declaration*> seen;
  return scope_asks(expr, scope, seen);
}

const Value* find_local(Scope& scope, std::string_view name) {
  for (Scope* at = &scope; at != nullptr; at = at->parent) {
    if (const auto found = at->values.find(name); found != at->values.end()) return &found->second;
    if (at->declared.find(name) != at->declared.end()) return nullptr;
  }
  return nullptr;
}

Declaration* find_declaration(Scope& scope, std::string_view name) {
  for (Scope* at = &scope; at != nullptr; at = at->parent)
    if (const auto found = at->declared.find(name); found != at->declared.end()) return found->second;
  return nullptr;
}

Declaration* find_half(Program& program, Scope& scope, const std::string& name, Span span) {
  Declaration* left = find_declaration(scope, name + ".left");
  Declaration* right = find_declaration(scope, name + ".right");
  if (left == nullptr || right == nullptr) return nullptr;
  if (scope.half.empty())
    fail(program, Message("G0311", "`" + name + "` is there twice, left and right", span)
                      .help("write `" + name + ".left` or `" + name + ".right`, or put `both` before the statement"));
  for (const Scope* at = &scope; at != nullptr; at = at->parent) at->half_used = true;
  return scope.half == "left" ? left : right;
}

std::vector<std::string> visible_names(const Scope& scope) {
  std::vector<std::string> names;
  for (const Scope* at = &scope; at != nullptr; at = at->parent) {
    for (const auto& [name, value] : at->values) names.push_back(name);
    for (const auto& [name, declaration] : at->declared) names.push_back(name);
  }
  for (const FunctionRecord& function : function_table()) names.emplace_back(function.name);
  return names;
}

// Names that are compared for a hint, over all messages: a broken script of many names must not take minutes.
constexpr std::size_t kMostComparisons = 2'000'000;

namespace {

/// `front.waist` for `waist`: what a drawn panel has under that name.
std::string thing_of_a_panel(const Program& program, const std::string& name) {
  for (const PanelInfo& info : program.panels) {
    if (!info.ready) continue;
    const design::Panel& panel = info.panel;
    const auto has = [&](const auto& list) {
      return std::any_of(list.begin(), list.end(), [&](const auto& thing) { return thing.name == name; });
    };
    if (has(panel.edges) || has(panel.lines) || has(panel.points) || has(panel.holes)) return panel.name + '.' + name;
    for (const design::Notch& notch : panel.notches)
      if (notch.name == name) return panel.name + '.' + notch.edge + '.' + name;
  }
  return "";
}

/// `form.waist` for `waist`: a level of a body that was asked before.
std::string place_of_a_body(const Program& program, const std::string& name) {
  for (const auto& [index, frame] : program.frames)
    if (frame.levels.contains(name)) return program.garment.bodies[static_cast<std::size_t>(index)].name + '.' + name;
  return "";
}

/// What an unknown name is elsewhere, or a unit it was meant for.
std::string known_elsewhere(const Program& program, const std::string& name) {
  for (const StandardLibrary& library : kStandardLibraries)
    if (name == library.name) return "write `use " + name + "` at the top";
  for (const std::string& found : {place_of_a_body(program, name), thing_of_a_panel(program, name)})
    if (!found.empty()) return "did you mean `" + found + "`?";
  if (name.size() > 1 && (name.back() == '2' || name.back() == '3') && find_unit(name.substr(0, name.size() - 1)))
    return "a power of a unit is written `" + name.substr(0, name.size() - 1) + '^' + name.back() + "`";
  return "";
}

}  // namespace

bool known_name_is_near(const Program& program, const std::string& name, const Scope& scope) {
  constexpr std::size_t kHints = 100;
  return program.diagnostics.size() < kHints && !did_you_mean(name, visible_names(scope)).empty();
}

namespace {

/// Names of what is drawn in the panels, for slips in a notch or edge.
std::vector<std::string> drawn_names(const Program& program) {
  constexpr std::size_t kMost = 2000;
  std::vector<std::string> names;
  for (const PanelInfo& info : program.panels) {
    if (!info.ready || names.size() > kMost) continue;
    for (const design::Notch& notch : info.panel.notches) names.push_back(notch.name);
    for (const design::Edge& edge : info.panel.edges) names.push_back(edge.name);
    for (const design::Edge& line : info.panel.lines) names.push_back(line.name);
  }
  return names;
}

}  // namespace

void fail_unknown_name(Program& program, const std::string& name, Span span, Scope& scope) {
  if (scope.module != nullptr && scope.module->has_broken)
    throw Stop{};  // a broken line may have declared it
  Message message("G0301", "there is nothing named `" + name + "`", span);
  std::string hint = known_elsewhere(program, name);
  constexpr std::size_t kHints = 100;  // after so many mistakes no names are compared any more: it would take minutes
  if (hint.empty() && program.diagnostics.size() < kHints)
    if (const std::vector<std::string> names = visible_names(scope);
        names.size() * (program.diagnostics.size() + 1) <= kMostComparisons)
      hint = did_you_mean(name, names);
  if (hint.empty() && program.diagnostics.size() < kHints) hint = did_you_mean(name, drawn_names(program));
  if (hint.empty() && find_unit(name)) hint = "`" + name + "` is a unit: write it after a number";
  fail(program, message.help(hint));
}

namespace {

std::string fill_parts(Program& program, const Expr* first, const Expr* last, Span span, Scope& scope) {
  std::string out;
  for (const Expr* part = first; part != last; ++part) {
    if (part->kind == ExprKind::text) {
      out += part->text;
      continue;
    }
    const Value value = eval(program, *part, scope);
    const auto* q = value.as<Quantity>();
    const auto* s = value.as<std::string>();
    std::string filled;
    if (q != nullptr && q->dimension.none() && !q->percent) filled = show(value);
    if (s != nullptr) filled = *s;
    if (filled.empty() || filled.size() > 100 || !std::all_of(filled.begin(), filled.end(), name_char))
      fail(program, Message("G0326", "`" + show(value) + "` cannot be part of a name", span)
                        .help("whole numbers and words can"));
    out += filled;
  }
  return out;
}

}  // namespace

std::string fill_name(Program& program, const grammar::Name& name, Scope& scope) {
  if (name.parts.empty()) return name.text;
  return fill_parts(program, name.parts.data(), name.parts.data() + name.parts.size(), name.span, scope);
}

std::string name_of(Program& program, const Expr& expr, Scope& scope) {
  const std::size_t first = expr.kind == ExprKind::member ? 1 : 0;
  if (expr.children.size() <= first) return expr.text;
  return fill_parts(program, expr.children.data() + first, expr.children.data() + expr.children.size(),
                    expr.kind == ExprKind::member ? expr.name_span : expr.span, scope);
}

Quantity as_quantity(Program& program, const Value& value, Span span, Dimension dimension,
                     const std::string& what) {
  const auto* q = value.as<Quantity>();
  if (q == nullptr)
    fail(program,
         Message("G0306", kind_of(value) + " where " + what + " takes " + describe(dimension), span));
  if (q->dimension == dimension) return *q;
  if (is_plain_zero(*q)) return {0, dimension, false};
  Message message(q->dimension.none() ? "G0308" : "G0305",
                  describe(q->dimension) + " (" + format_quantity(q->value, q->dimension, q->percent) +
                      ") where " + what + " takes " + describe(dimension),
                  span);
  if (q->dimension.none() && !q->percent)
    message.help("give it a unit: `" + format_quantity(q->value, {}) + ' ' + example_unit(dimension) + "`");
  fail(program, message);
}

Quantity eval_quantity(Program& program, const Expr& expr, Scope& scope, Dimension dimension,
                       const std::string& what) {
  return as_quantity(program, eval(program, expr, scope), expr.span, dimension, what);
}

bool eval_truth(Program& program, const Expr& expr, Scope& scope, const std::string& what) {
  const Value value = eval(program, expr, scope);
  if (const bool* b = value.as<bool>()) return *b;
  fail(program, Message("G0306", kind_of(value) + " where " + what + " takes true or false", expr.span)
                    .help(value.as<EdgeValue>() != nullptr ? "sides of a seam are joined by `to`, edges of one side by `+`"
                                                           : "compare it: `... > 0`"));
}

std::string eval_text(Program& program, const Expr& expr, Scope& scope, const std::string& what) {
  const Value value = eval(program, expr, scope);
  if (const auto* text = value.as<std::string>()) return *text;
  fail(program, Message("G0306", kind_of(value) + " where " + what + " takes text in quotes", expr.span));
}

PointValue eval_point(Program& program, const Expr& expr, Scope& scope, int size, Dimension dimension,
                      const std::string& what) {
  const Value value = eval(program, expr, scope);
  const auto* p = value.as<PointValue>();
  if (p == nullptr || p->size != size)
    fail(program, Message("G0306",
                          kind_of(value) + " where " + what + " takes a point with " + std::to_string(size) +
                              " coordinates",
                          expr.span));
  PointValue point = *p;
  bool zero = true;
  for (double x : point.at) zero = zero && x == 0;
  if (zero) point.dimension = dimension;
  if (point.dimension != dimension)
    fail(program, Message(point.dimension.none() ? "G0308" : "G0305",
                          "coordinates are " + describe(point.dimension) + " where " + what + " takes " +
                              describe(dimension),
                          expr.span)
                      .help("give them a unit, as in `10 " + example_unit(dimension) + "`"));
  return point;
}

int eval_panel(Program& program, const Expr& expr, Scope& scope, const std::string& what) {
  const Value value = eval(program, expr, scope);
  if (const auto* panel = value.as<PanelValue>()) return panel->panel;
  fail(program, Message("G0306", kind_of(value) + " where " + what + " takes a panel", expr.span));
}

EdgeValue eval_edges(Program& program, const Expr& expr, Scope& scope, const std::string& what) {
  const Value value = eval(program, expr, scope);
  if (const auto* edge = value.as<EdgeValue>()) return *edge;
  Message message("G0306", kind_of(value) + " where " + what + " takes an edge", expr.span);
  if (const auto* panel = value.as<PanelValue>()) {
    std::string names;
    for (const std::string& name : edge_names(program.panels[static_cast<std::size_t>(panel->panel)]))
      names += (names.empty() ? "" : ", ") + name;
    message.help("its edges are " + names);
  }
  fail(program, message);
}

design::Point2 eval_direction(Program& program, const Expr& expr, Scope& scope, const std::string& what) {
  const Expr* axis = &expr;
  double sign = 1;
  bool has_sign = false;
  if (expr.kind == ExprKind::unary && (expr.text == "+" || expr.text == "-") && !expr.children.empty()) {
    sign = expr.text == "-" ? -1 : 1;
    axis = &expr.children[0];
    has_sign = true;
  }
  if (axis->kind == ExprKind::name && has_sign) {
    if (axis->text == "x") return {sign, 0};
    if (axis->text == "y") return {0, sign};
  }
  const Value value = eval(program, expr, scope);
  const auto* q = value.as<Quantity>();
  if (q == nullptr || (q->dimension != kAngle && !is_plain_zero(*q)))
    fail(program, Message(q != nullptr && q->dimension.none() ? "G0308" : "G0306",
                          (q != nullptr ? format_quantity(q->value, q->dimension) : kind_of(value)) +
                              " where " + what + " takes a direction",
                          expr.span)
                      .help("directions are +x, -x, +y, -y, or an angle from +x such as `30 deg`"));
  return {portable::cos(q->value), portable::sin(q->value)};
}

}  // namespace garment::interpreter
