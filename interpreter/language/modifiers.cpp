#include "interpreter/language/modifiers.hpp"

#include <algorithm>
#include <cmath>

#include "interpreter/language/clauses.hpp"
#include "interpreter/language/outline.hpp"
#include "interpreter/language/panel_interior.hpp"
#include "interpreter/language/parts.hpp"
#include "interpreter/language/word_lists.hpp"
#include "runtime/design/alter.hpp"

namespace garment::interpreter {
namespace {

using design::Point2;

constexpr int kMaxDepth = 64;

bool is_modifier(const Statement& statement) {
  const std::string& word = statement.keyword.text;
  return word == "slash" || word == "move" || word == "scale";
}

/// A panel that an operand speaks of, and what it says after its name.
struct Target {
  int panel = -1;
  std::vector<std::string> rest;
};

void add_target(std::vector<Target>& targets, const Declaration* declaration, const std::vector<std::string>& rest) {
  if (declaration == nullptr || declaration->index < 0) return;
  const std::string& keyword = declaration->statement->keyword.text;
  if (keyword == "panel" || keyword == "pair panel") targets.push_back({declaration->index, rest});
}

/// What an operand speaks of by its words alone, through parts, arguments and ports; `a + b` speaks of both. Nothing is
/// evaluated: the panels are still to be drawn.
std::vector<Target> find_targets(Program& program, const Expr& expr, Scope& scope, int depth = 0) {
  std::vector<Target> targets;
  if (depth > kMaxDepth) return targets;
  if (expr.kind == ExprKind::binary && expr.text == "+") {
    targets = find_targets(program, expr.children[0], scope, depth + 1);
    for (Target& target : find_targets(program, expr.children[1], scope, depth + 1)) targets.push_back(std::move(target));
    return targets;
  }
  const DeclaredPath path = find_path(program, expr, scope, true);
  if (path.declaration == nullptr) return targets;
  const Statement& statement = *path.declaration->statement;
  const bool port = statement.keyword.text == "port" && !statement.clauses.empty() && !statement.clauses[0].values.empty();
  if (port && path.rest.empty())
    return find_targets(program, statement.clauses[0].values[0], *path.declaration->scope, depth + 1);
  add_target(targets, path.declaration, path.rest);
  add_target(targets, path.twin, path.rest);
  return targets;
}

void attach(Program& program, const Item& item) {
  const Statement& statement = *item.statement;
  PartGuard guard(program, item.scope->part);
  if (statement.operands.empty())
    fail(program, Message("G0312", "`" + statement.keyword.text + "` needs something to act on", statement.keyword.span)
                      .help("write `" + std::string(find_construct(statement.keyword.text)->form) + "`"));
  std::vector<int> panels;
  for (const Expr& operand : statement.operands) {
    const std::vector<Target> targets = find_targets(program, operand, *item.scope);
    if (targets.empty()) {
      if (item.scope->module != nullptr && item.scope->module->has_broken) throw Stop{};
      const std::string text(program.sources.text(operand.span));
      fail(program, Message("G0433", "`" + text + "` is no declared panel nor a part of one", operand.span)
                        .help(did_you_mean(text.substr(0, text.find('.')), visible_names(*item.scope))));
    }
    for (const Target& target : targets)
      if (std::find(panels.begin(), panels.end(), target.panel) == panels.end()) panels.push_back(target.panel);
  }
  for (const int panel : panels) {
    PanelInfo& info = program.panels[static_cast<std::size_t>(panel)];
    if (info.ready)
      fail(program, Message("G0437", "panel `" + info.panel.name + "` is asked for before it is changed here",
                            statement.operands[0].span)
                        .help("what decides how often or whether a panel is changed may not depend on the panel"));
    info.modifiers.push_back(item);
  }
}

class Modifier {
 public:
  Modifier(Drawing& drawing, const Item& item)
      : drawing_(drawing),
        program_(drawing.program),
        panel_(drawing.panel),
        statement_(*item.statement),
        scope_(*item.scope),
        clauses_(program_, statement_, scope_) {}

  void apply() {
    const std::string& word = statement_.keyword.text;
    if (word == "slash") slash();
    if (word == "move") move();
    if (word == "scale") scale();
  }

 private:
  /// What the operand names of this panel, each by its drawn name; "" for the panel itself. Halves are drawn as one.
  std::vector<std::string> parts_of(const Expr& expr, Scope& scope) {
    std::vector<std::string> parts;
    for (const Target& target : find_targets(program_, expr, scope)) {
      if (target.panel != drawing_.index) continue;
      std::vector<std::string> rest = target.rest;
      if (!rest.empty() && !drawing_.recipe.fold.empty() && (rest[0] == "left" || rest[0] == "right")) {
        const std::string half = rest[0];
        rest.erase(rest.begin());
        halves_.push_back({half, rest.empty() ? "" : rest[0], expr.span});
      }
      if (rest.size() > 1)
        fail(program_, Message("G0433", "`" + rest[1] + "` is no part of `" + panel_.name + "` that can be changed",
                               expr.span)
                           .help("name an edge, line, point or hole of the panel"));
      parts.push_back(rest.empty() ? "" : rest[0]);
    }
    return parts;
  }

  /// The halves of a panel on the fold are drawn as one: who names one must name the other too.
  void check_halves() {
    for (const Half& half : halves_) {
      const std::string other = half.side == "left" ? "right" : "left";
      const bool both = std::any_of(halves_.begin(), halves_.end(), [&](const Half& h) { return h.side == other && h.part == half.part; });
      if (!both)
        fail(program_,
             Message("G0433", "the halves of `" + panel_.name + "` are drawn as one and change together", half.span)
                 .help("leave `" + half.side + "` out, or name the " + other + " one too, or draw the whole panel"));
    }
  }

  void move() {
    const BoundClause& by = clauses_.need("by");
    const PointValue p = eval_point(program_, clauses_.value(by), *by.scope, 2, kLength, "`by`");
    clauses_.finish();
    const Point2 shift(p.at[0], p.at[1]);
    if (!(shift.cwiseAbs().maxCoeff() <= 2))
      fail(program_, Message("G0309", "a move by " + format_point(shift) + "; it must lie in -200 cm .. 200 cm",
                             clauses_.value(by).span));
    std::vector<std::string> names;
    for (const Expr& operand : statement_.operands)
      for (const std::string& name : parts_of(operand, scope_)) {
        design::Panel trial = panel_;
        if (name.empty() || !design::move(trial, {name}, shift)) fail_part(operand, name);
        names.push_back(name);
      }
    check_halves();
    design::move(panel_, names, shift, drawing_.recipe.fold);
  }

  [[noreturn]] void fail_part(const Expr& operand, const std::string& name) {
    std::vector<std::string> names = drawn_edge_names(panel_);
    for (const design::InteriorPoint& point : panel_.points) names.push_back(point.name);
    for (const design::Hole& hole : panel_.holes) names.push_back(hole.name);
    std::string all;
    for (const std::string& known : names) all += (all.empty() ? "it has " : ", ") + known;
    const std::string hint = did_you_mean(name, names);
    fail(program_, Message("G0311",
                           name.empty() ? "`move` takes an edge, line, point or hole of a panel"
                                        : "panel `" + panel_.name + "` has no edge, line, point or hole `" + name + "`",
                           operand.span)
                       .help(hint.empty() ? all : hint));
  }

  void scale() {
    const BoundClause& by = clauses_.need("by");
    const Expr& expr = clauses_.value(by);
    double x = 1, y = 1;
    if (expr.kind == ExprKind::point) {
      const PointValue p = eval_point(program_, expr, *by.scope, 2, kNumber, "`by`");
      x = p.at[0];
      y = p.at[1];
    } else {
      x = y = eval_quantity(program_, expr, *by.scope, kNumber, "`by`").value;
    }
    clauses_.finish();
    for (const Expr& operand : statement_.operands)
      for (const std::string& part : parts_of(operand, scope_))
        if (!part.empty() || !halves_.empty()) fail(program_, Message("G0306", "`scale` takes a panel as a whole", operand.span)
                           .help("to change one edge, `move` it"));
    for (const double f : {x, y})
      if (!(f >= 0.2 && f <= 5))
        fail(program_, Message("G0309", "`by` is " + format_quantity(f, {}) + "; it must lie in 0.2 .. 5", expr.span));
    design::scale(panel_, x, y);
  }

  void slash() {
    const std::vector<std::string> parts = parts_of(statement_.operands[0], scope_);
    if (statement_.operands.size() != 1 || parts.size() != 1 || !parts[0].empty() || !halves_.empty())
      fail(program_, Message("G0306", "`slash` takes one panel", statement_.operands.back().span)
                         .help("as in `slash sleeve along sleeve.elbow spread 2 cm`"));
    const BoundClause& along = clauses_.need("along");
    const std::string line = line_name(clauses_.value(along), *along.scope);
    const auto spread = clauses_.quantity("spread");
    if (!spread) clauses_.need("spread");
    const double end = clauses_.quantity("to").value_or(*spread);
    clauses_.finish();
    const Findings findings = design::slash(panel_, line, *spread, end, drawing_.recipe.fold);
    for (Diagnostic& diagnostic : to_diagnostics(findings, program_.origins)) {
      Message message("", "", statement_.span);
      message.diagnostic = std::move(diagnostic);
      message.also(statement_.keyword.span, "slashed here");
      report(program_, std::move(message));
    }
    if (has_errors(findings)) throw Stop{};
  }

  std::string line_name(const Expr& expr, Scope& scope) {
    std::string name = expr.kind == ExprKind::name ? name_of(program_, expr, scope) : "";
    // A half's line stands for the drawn one: the panel that is slashed is named whole.
    for (const std::string& part : parts_of(expr, scope)) name = part;
    std::vector<std::string> names;
    for (const design::Edge& edge : panel_.lines) {
      if (edge.name == name) return name;
      names.push_back(edge.name);
    }
    fail(program_, Message("G0433",
                           "`" + std::string(program_.sources.text(expr.span)) + "` is no interior line of `" +
                               panel_.name + "`",
                           expr.span)
                       .help(names.empty() ? "draw it in the panel: `line NAME from POINT to POINT`"
                                           : did_you_mean(name, names).empty() ? "its lines are " + listed(names)
                                           : did_you_mean(name, names)));
  }

  /// A half that an operand names, and what of it.
  struct Half {
    std::string side, part;
    Span span;
  };

  Drawing& drawing_;
  Program& program_;
  std::vector<Half> halves_;
  design::Panel& panel_;
  const Statement& statement_;
  Scope& scope_;
  Clauses clauses_;
};

/// Mouths and pleats must still fit their edges.
void check_stretches(Drawing& drawing, Span span) {
  const design::Panel& panel = drawing.panel;
  auto check = [&](const std::string& what, const std::string& edge, double from, double to) {
    const design::Edge* e = find_drawn_edge(panel, edge);
    if (e == nullptr || (from >= -1e-6 && to <= e->curve.length() + 1e-6)) return;
    fail(drawing.program, Message("G0436",
                                  what + " no longer fits edge `" + edge + "` of `" + panel.name + "`, which is now " +
                                      format_quantity(e->curve.length(), kLength) + " long",
                                  span)
                              .help("change the edge less, or make what stands on it smaller"));
  };
  for (const design::EdgeDart& dart : panel.darts)
    check("dart `" + dart.name + "`", dart.edge, dart.at - dart.width / 2, dart.at + dart.width / 2);
  for (const design::Pleat& pleat : panel.pleats) {
    const double reach = (pleat.count - 1) * pleat.spacing;
    check("pleat `" + pleat.name + "`", pleat.edge, pleat.at - pleat.take() / 2, pleat.at + reach + pleat.take() / 2);
  }
  for (const design::LegDart& dart : panel.leg_darts) {
    const design::Edge *a = find_drawn_edge(panel, dart.leg_a), *b = find_drawn_edge(panel, dart.leg_b);
    if (a == nullptr || b == nullptr || std::fabs(a->curve.length() - b->curve.length()) <= 1e-3) continue;
    fail(drawing.program, Message("G0436",
                                  "the legs of dart `" + dart.name + "` are now " + format_mm(a->curve.length()) + " and " +
                                      format_mm(b->curve.length()) + " long",
                                  span)
                              .help("move both legs alike"));
  }
}

}  // namespace

void collect_modifiers(Program& program, Module& module) {
  for (const Item& item : module.items) {
    if (!is_modifier(*item.statement)) continue;
    try {
      attach(program, item);
    } catch (const Stop&) {
    }
  }
}

bool apply_modifiers(Drawing& drawing) {
  try {
    for (const Item& item : drawing.info.modifiers) {
      const std::size_t before = drawing.program.diagnostics.size();
      Modifier(drawing, item).apply();
      const Span span = item.statement->span;
      std::vector<Span> spans;
      for (const design::Edge& edge : drawing.panel.edges) spans.push_back(drawing.info.spans[edge.name]);
      bool good = true;
      try {
        check_crossings(drawing.program, "`" + drawing.panel.name + "`", drawing.panel.edges, spans);
        good = check_interior(drawing);
        check_stretches(drawing, span);
      } catch (const Stop&) {
        good = false;
      }
      if (good) continue;
      // The drawing was right; it is the change that made it wrong.
      for (std::size_t k = before; k < drawing.program.diagnostics.size(); ++k)
        drawing.program.diagnostics[k].labels.push_back({span, "changed here"});
      return false;
    }
  } catch (const Stop&) {
    return false;
  }
  return true;
}

void run_modifier(Program&, const Item&) {}

}  // namespace garment::interpreter
