// Buttons and what they go through.
#include <algorithm>
#include <cmath>

#include "interpreter/language/clauses.hpp"
#include "interpreter/language/closures.hpp"
#include "interpreter/language/edges.hpp"
#include "interpreter/language/evaluate.hpp"
#include "interpreter/language/outline.hpp"
#include "interpreter/language/regions.hpp"
#include "interpreter/language/word_lists.hpp"

namespace garment::interpreter {
namespace {

using design::Point2;

std::string point_text(const Point2& p) {
  return "(" + format_quantity(p.x(), kLength) + ", " + format_quantity(p.y(), kLength) + ")";
}

double distance_to_edge(const design::Panel& panel, const Point2& p, const design::Edge*& nearest) {
  double least = 1e300;
  for (const auto* edges : {&panel.edges, &panel.hole_edges})
    for (const design::Edge& edge : *edges) {
      const double d = (edge.curve.point_at(edge.curve.nearest(p)) - p).norm();
      if (d < least) least = d, nearest = &edge;
    }
  return least;
}

/// Reads `on PANEL at P through PANEL at Q [through PANEL at R ...]` and the clauses after it.
class ButtonReader {
 public:
  ButtonReader(Program& program, Declaration& declaration)
      : program_(program),
        declaration_(declaration),
        statement_(*declaration.statement),
        scope_(*declaration.scope) {}

  design::Button read() {
    for (const Expr& operand : statement_.operands)
      fail(program_, Message("G0313", "`" + std::string(program_.sources.text(operand.span)) + "` means nothing before `on`", operand.span));
    button_.name = declaration_.name;
    button_.origin = program_.origin(statement_.span);
    for (std::size_t k = 0; k < statement_.clauses.size(); ++k) take(k);
    if (button_.panel < 0 || awaiting_)
      fail(program_,
           Message("G0312",
                   awaiting_ ? "`at POINT` is missing after the panel" : "`button` needs `on PANEL at POINT`",
                   awaiting_ ? last_panel_ : statement_.keyword.span)
               .help("write `" + std::string(find_construct("button")->form) + "`"));
    if (button_.holes.empty())
      fail(program_, Message("G0312", "`button` needs `through PANEL at POINT`", statement_.keyword.span)
                         .help("say where its hole is: `button top on left at (2 cm, 40 cm) through right at "
                               "(-2 cm, 40 cm)`"));
    for (Override& change : declaration_.overrides) assign(change);
    if (!shank_stated_ && button_.kind != design::Button::Kind::sew_through) button_.shank = 0;
    for (const auto& [hole, span] : spans_)
      check_room(hole.panel, hole.point, span, &hole != &spans_.front().first);
    return button_;
  }

 private:
  void take(std::size_t k) {
    const Clause& clause = statement_.clauses[k];
    const std::string& word = clause.word.text;
    if (word == "on" || word == "through") return take_panel(clause, word == "on");
    if (word == "at") return take_point(clause);
    for (std::size_t j = 0; j < k; ++j)
      if (statement_.clauses[j].word.text == word)
        fail(program_, Message("G0314", "`" + word + "` is given twice", clause.word.span)
                           .also(statement_.clauses[j].word.span, "first here"));
    if (clause.values.size() != 1)
      fail(program_, Message("G0312", "`" + word + "` takes one value", clause.span));
    set(word, clause.values[0], scope_);
  }

  void take_panel(const Clause& clause, bool on) {
    if (awaiting_) fail(program_, Message("G0312", "`at POINT` is missing after the panel", last_panel_));
    if (on && button_.panel >= 0) fail(program_, Message("G0314", "`on` is given twice", clause.word.span));
    if (clause.values.size() != 1)
      fail(program_, Message("G0312", "`" + clause.word.text + "` takes one panel", clause.span));
    name_panel(clause.values[0], on);
  }

  void name_panel(const Expr& expr, bool on) {
    panel_ = eval_panel_part(program_, expr, scope_, on ? "`on`" : "`through`").panel;
    last_panel_ = expr.span;
    on_ = on;
    awaiting_ = true;
  }

  /// `at P`, or `at P, PANEL` where the next `at` follows: the list form of several holes.
  void take_point(const Clause& clause) {
    if (!awaiting_)
      fail(program_, Message("G0313", "`at` follows `on PANEL` or `through PANEL`", clause.word.span));
    if (clause.values.empty()) fail(program_, Message("G0312", "`at` needs a point", clause.word.span));
    const Expr& expr = clause.values[0];
    const Point2 p = eval_cloth_point(program_, expr, scope_, panel_, on_ ? "the button" : "its hole");
    if (on_) {
      button_.panel = panel_;
      button_.point = p;
    } else {
      button_.holes.push_back({panel_, p});
    }
    spans_.push_back({{panel_, p}, expr.span});
    awaiting_ = false;
    if (clause.values.size() == 2 && !on_) return name_panel(clause.values[1], false);
    if (clause.values.size() > 1)
      fail(program_, Message("G0313", "`at` takes one point, here is more", clause.values[1].span)
                         .help(words_hint(*find_construct("button"), clause.values[1].text)));
  }

  void assign(Override& change) {
    static const char* const words[] = {"mass", "diameter", "shank", "kind"};
    if (change.path.size() != 1 ||
        std::none_of(std::begin(words), std::end(words), [&](const char* w) { return change.path[0] == w; }))
      return;
    change.used = true;
    set(change.path[0], *change.value, *change.scope);
  }

  void set(const std::string& word, const Expr& expr, Scope& scope) {
    if (word == "kind") return set_kind(expr);
    const ClauseRecord& record = *find_clause(*find_construct("button"), word);
    const Quantity q = eval_quantity(program_, expr, scope, record.dimension, "`" + word + "`");
    const double x = checked_quantity(program_, record, q, expr.span);
    if (word == "mass") button_.mass = x;
    if (word == "diameter") button_.diameter = x;
    if (word == "shank") button_.shank = x, shank_stated_ = true;
  }

  void set_kind(const Expr& expr) {
    using Kind = design::Button::Kind;
    const std::string word = expr.kind == ExprKind::name ? expr.text : "";
    if (word == "sew_through")
      button_.kind = Kind::sew_through;
    else if (word == "hook")
      button_.kind = Kind::hook;
    else if (word == "snap")
      button_.kind = Kind::snap;
    else
      fail(program_, Message("G0313", "`kind` takes sew_through, hook or snap", expr.span)
                         .help(meant_or_listed(word, {"sew_through", "hook", "snap"}, "it is one of")));
  }

  void check_room(int panel, const Point2& p, Span span, bool hole) {
    const design::Edge* edge = nullptr;
    const design::Panel& cloth = program_.panels[static_cast<std::size_t>(panel)].panel;
    const double d = distance_to_edge(cloth, p, edge);
    if (d >= button_.diameter / 2 - 1e-9) return;
    report(program_, Message("G1402",
                             std::string(hole ? "the hole of button `" : "button `") + button_.name +
                                 "` lies " + format_mm(d) + " from edge `" + cloth.name + '.' + edge->name +
                                 "`; half its diameter is " + format_mm(button_.diameter / 2),
                             span)
                         .warning()
                         .help("set it further in, or take a smaller button"));
  }

  Program& program_;
  Declaration& declaration_;
  const Statement& statement_;
  Scope& scope_;
  design::Button button_;
  std::vector<std::pair<design::ButtonHole, Span>> spans_;
  int panel_ = -1;
  bool on_ = true, awaiting_ = false, shank_stated_ = false;
  Span last_panel_;
};

}  // namespace

Point2 eval_cloth_point(Program& program, const Expr& expr, Scope& scope, int panel,
                        const std::string& what) {
  const PointValue value = eval_point(program, expr, scope, 2, kLength, "`at`");
  const design::Panel& cloth = program.panels[static_cast<std::size_t>(panel)].panel;
  const Point2 p(value.at[0], value.at[1]);
  if (value.panel >= 0 && value.panel != panel)
    fail(program, Message("G1401",
                          what + " is on `" + cloth.name + "`, the point on `" +
                              program.panels[static_cast<std::size_t>(value.panel)].panel.name + "`",
                          expr.span)
                      .help("take a point of `" + cloth.name + "`"));
  bool in_hole = false;
  for (const design::Hole& hole : cloth.holes) {
    design::Panel loop;
    const auto first = cloth.hole_edges.begin() + hole.first;
    loop.edges.assign(first, first + hole.count);
    in_hole = in_hole || contains(loop, p, 0);
  }
  if (!in_hole && contains(cloth, p, 1e-6)) return p;
  Point2 low(1e300, 1e300), high(-1e300, -1e300);
  for (const design::Edge& edge : cloth.edges)
    for (const Point2& q : edge.curve.polyline(1e-3)) low = low.cwiseMin(q), high = high.cwiseMax(q);
  fail(program,
       Message("G1401",
               what + " at " + point_text(p) + " lies " + (in_hole ? "in a hole of `" : "outside panel `") +
                   cloth.name + "`",
               expr.span)
           .help("the panel runs from " + point_text(low) + " to " + point_text(high) + ", as drawn"));
}

void check_buttons(Program& program) {
  constexpr double kSame = 1e-3;  // m
  std::vector<design::Button>& buttons = program.garment.buttons;
  for (std::size_t i = 0; i < buttons.size(); ++i)
    for (std::size_t j = i + 1; j < buttons.size(); ++j) {
      const design::Button &a = buttons[i], &b = buttons[j];
      if (a.panel < 0 || a.panel != b.panel || (a.point - b.point).norm() > kSame) continue;
      report(program, Message("G1403",
                              "buttons `" + a.name + "` and `" + b.name +
                                  "` are sewn on one place: " + point_text(b.point) + " of `" +
                                  program.panels[static_cast<std::size_t>(a.panel)].panel.name + "`",
                              program.origins[b.origin.value])
                          .also(program.origins[a.origin.value], "first here")
                          .help("move one of them, or let one button go through both: a second `through`"));
    }
}

int reserve_button(Program& program, const Declaration& declaration) {
  program.garment.buttons.emplace_back().name = declaration.name;
  return static_cast<int>(program.garment.buttons.size()) - 1;
}

Value evaluate_button(Program& program, Declaration& declaration) {
  design::Button button = ButtonReader(program, declaration).read();
  program.garment.buttons[static_cast<std::size_t>(declaration.index)] = std::move(button);
  return Value{ThingValue{"button", &declaration, declaration.index}};
}

}  // namespace garment::interpreter
