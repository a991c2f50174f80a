#include "interpreter/language/placements.hpp"

#include "interpreter/language/bodies.hpp"
#include "interpreter/language/clauses.hpp"
#include "interpreter/language/edges.hpp"
#include "interpreter/language/outline.hpp"
#include "interpreter/language/seams.hpp"
#include "interpreter/language/word_lists.hpp"
#include "runtime/base/portable_math.hpp"

namespace garment::interpreter {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Vector3d vector_of(const PointValue& p) { return {p.at[0], p.at[1], p.at[2]}; }

Matrix3d rotation(const Vector3d& r) {
  const double cx = portable::cos(r.x()), sx = portable::sin(r.x());
  const double cy = portable::cos(r.y()), sy = portable::sin(r.y());
  const double cz = portable::cos(r.z()), sz = portable::sin(r.z());
  Matrix3d x, y, z;
  x << 1, 0, 0, 0, cx, -sx, 0, sx, cx;
  y << cy, 0, sy, 0, 1, 0, -sy, 0, cy;
  z << cz, -sz, 0, sz, cz, 0, 0, 0, 1;
  return z * y * x;
}

BodyPlaceValue eval_body_place(Program& program, const Expr& expr, Scope& scope, const std::string& what) {
  const Value value = eval(program, expr, scope);
  if (const auto* place = value.as<BodyPlaceValue>()) {
    if (scope.half.empty() || (place->path != "arm" && place->path != "leg")) return *place;
    for (const Scope* at = &scope; at != nullptr; at = at->parent) at->half_used = true;
    return {place->body, place->path + '.' + scope.half};
  }
  fail(program, Message("G0306", kind_of(value) + " where " + what, expr.span)
                    .help("as in `form.waist`, `form.front` or `form.arm.left`"));
}

std::string outline_name(Program& program, const PanelInfo& info, const design::EdgePart& part, Span span) {
  if (part.on != design::EdgePart::On::outline)
    fail(program, Message("G0610", "`with` takes an edge of the outline; `" + design::edge_of(info.panel, part).name +
                                       "` lies inside the panel",
                          span));
  return info.panel.edges[static_cast<std::size_t>(part.edge)].name;
}

/// Name of a design edge for `with EDGE`: a name of the panel, or `front.waist`.
std::string eval_with_edge(Program& program, const Expr& expr, Scope& scope, int panel) {
  const PanelInfo& info = program.panels[static_cast<std::size_t>(panel)];
  if (expr.kind == ExprKind::name) {
    const std::string name = name_of(program, expr, scope);
    const NamedEdge* edge = find_edge(info, "", name);
    if (edge == nullptr) edge = find_edge(info, "left", name);
    if (edge == nullptr)
      fail(program, Message("G0301", "panel `" + info.panel.name + "` has no edge `" + name + "`", expr.span)
                        .help(meant_or_listed(name, edge_names(info), "its edges are")));
    return outline_name(program, info, edge->parts.front(), expr.span);
  }
  const EdgeValue edge = eval_edges(program, expr, scope, "`with`");
  if (edge.spans.size() != 1 || edge.spans[0].panel != panel)
    fail(program, Message("G0610", "`" + std::string(program.sources.text(expr.span)) + "` where `with` takes an edge of the panel that is placed, `" + info.panel.name + "`", expr.span)
                      .help("its edges are " + listed(edge_names(info))));
  return outline_name(program, info, edge.spans[0].parts.front(), expr.span);
}

class Placer {
 public:
  Placer(Program& program, Clauses& clauses, int panel)
      : program_(program), clauses_(clauses), panel_(panel) {}

  design::Placement make() {
    const BoundClause* on = clauses_.find("on");
    const BoundClause* around = clauses_.find("around");
    placement_.origin = program_.origin(clauses_.statement().span);
    if (on != nullptr && around != nullptr)
      fail(program_, Message("G0415", "a panel is placed `on` a side or `around` a part, not both",
                             around->clause->span));
    if (on != nullptr) wrap(*on, design::Placement::Kind::on_part);
    if (around != nullptr) wrap(*around, design::Placement::Kind::around);
    if (on == nullptr && around == nullptr && !only_how_it_begins()) rigid();
    if (const BoundClause* start = clauses_.find("start")) {
      const Expr& word = clauses_.value(*start);
      if (word.kind != ExprKind::name || word.text != "folded")
        fail(program_, Message("G0313", "`start` takes `folded`", word.span));
      placement_.folded = true;
    }
    clauses_.finish();
    return placement_;
  }

 private:
  /// `place front start folded`: where it lies comes from its seams.
  bool only_how_it_begins() {
    for (const char* word : {"at", "flat", "turn", "with", "offset"})
      if (clauses_.find(word) != nullptr) return false;
    return clauses_.find("start") != nullptr;
  }

  static constexpr const char* kWhole = "";

  /// A part of a body, or a whole plain shape.
  BodyPlaceValue round(const Expr& expr, Scope& scope) {
    const Value value = eval(program_, expr, scope);
    if (const auto* body = value.as<BodyValue>(); body != nullptr && is_plain(program_, body->body, expr.span)) return {body->body, kWhole};
    return eval_body_place(program_, expr, scope, "`around` takes a part of a body, or a plain shape");
  }

  void wrap(const BoundClause& clause, design::Placement::Kind kind) {
    const bool side = kind == design::Placement::Kind::on_part;
    const Expr& expr = clauses_.value(clause);
    const BodyPlaceValue place = side ? eval_body_place(program_, expr, *clause.scope, "`on` takes a side of a body") : round(expr, *clause.scope);
    placement_.kind = kind;
    placement_.part = place.path == kWhole ? kWhole : checked_part(program_, place, expr.span, side);
    placement_.body = program_.garment.bodies[static_cast<std::size_t>(place.body)].name;
    if (const auto offset = clauses_.quantity("offset")) placement_.offset = *offset;
    const BoundClause* with = clauses_.find("with");
    const BoundClause* at = clauses_.find("at");
    if ((with == nullptr) != (at == nullptr))
      fail(program_,
           Message("G0312", with != nullptr ? "`with EDGE` needs `at LEVEL`" : "`at LEVEL` needs `with EDGE`",
                   (with != nullptr ? with : at)->clause->span)
               .help("as in `with waist at form.waist`"));
    if (with == nullptr) return;
    placement_.edge = eval_with_edge(program_, clauses_.value(*with), *with->scope, panel_);
    const Expr& level = clauses_.value(*at);
    const BodyPlaceValue value = eval_body_place(program_, level, *at->scope, "`at` takes a level of a body");
    if (value.body != place.body)
      fail(
          program_,
          Message("G0610", "the level is of another body", level.span).also(expr.span, "placed on this one"));
    placement_.level = checked_level(program_, value, level.span);
  }

  void rigid() {
    const bool flat = clauses_.flag("flat");
    const BoundClause& at = clauses_.need("at");
    const PointValue p = eval_point(program_, clauses_.value(at), *at.scope, 3, kLength, "`at`");
    placement_.kind = design::Placement::Kind::rigid;
    placement_.translation = vector_of(p);
    const BoundClause* turn = clauses_.find("turn");
    if (flat && turn != nullptr)
      fail(program_,
           Message("G0415", "`flat` says how the panel lies; `turn` says it again", turn->clause->span));
    if (flat) placement_.rotation << 1, 0, 0, 0, 0, 1, 0, -1, 0;
    if (turn != nullptr) {
      const PointValue r = eval_point(program_, clauses_.value(*turn), *turn->scope, 3, kAngle, "`turn`");
      placement_.rotation = rotation(vector_of(r));
    }
  }

  Program& program_;
  Clauses& clauses_;
  int panel_;
  design::Placement placement_;
};

}  // namespace

void run_place(Program& program, const Item& item) {
  const Statement& statement = *item.statement;
  Scope& scope = *item.scope;
  Declaration* owner = item.declaration;
  int panel = -1;
  if (owner != nullptr) {
    if (owner->state != Declaration::State::done) throw Stop{};
    panel = owner->index;
    if (!statement.operands.empty())
      fail(program,
           Message("G0313", "inside a panel `place` speaks of that panel", statement.operands[0].span));
  } else {
    if (statement.operands.size() != 1)
      fail(program, Message("G0312", "`place` takes one panel", statement.keyword.span)
                        .help("as in `place front on form.front`"));
    panel = eval_panel(program, statement.operands[0], scope, "`place`");
  }
  PanelInfo& info = program.panels[static_cast<std::size_t>(panel)];
  if (!program.placed.insert(panel).second)
    fail(program, Message("G0612", "panel `" + info.panel.name + "` is placed twice", statement.span)
                      .also(program.origins[info.panel.placement.origin.value], "first here"));
  Clauses clauses(program, statement, scope);
  info.panel.placement.origin = program.origin(statement.span);
  info.panel.placement = Placer(program, clauses, panel).make();
}

void run_attach(Program& program, const Item& item) {
  const Statement& statement = *item.statement;
  Scope& scope = *item.scope;
  Clauses clauses(program, statement, scope);
  design::Attachment attachment;
  attachment.origin = program.origin(statement.span);
  if (statement.operands.empty())
    fail(program, Message("G0312", "`attach` needs an edge", statement.keyword.span)
                      .help("as in `attach front.waist, back.waist to form.waist`"));
  for (const Expr& operand : statement.operands) {
    const EdgeValue edge = eval_edges(program, operand, scope, "`attach`");
    attachment.name += (attachment.name.empty() ? "" : ", ") + show(Value{edge});
    for (const EdgeSpan& span : edge.spans)
      attachment.parts.insert(attachment.parts.end(), span.parts.begin(), span.parts.end());
  }
  const BoundClause& to = clauses.need("to");
  const Expr& level = clauses.value(to);
  const BodyPlaceValue place =
      eval_body_place(program, level, *to.scope, "`attach ... to` takes a level of a body");
  attachment.level = checked_level(program, place, level.span);
  attachment.body = program.garment.bodies[static_cast<std::size_t>(place.body)].name;
  const bool slide = clauses.flag("slide"), hold = clauses.flag("hold");
  if (slide && hold) fail(program, Message("G0415", "edges `slide` or `hold`, not both", statement.span));
  attachment.slide = !hold;
  clauses.finish();
  program.garment.attachments.push_back(std::move(attachment));
}

void run_gravity(Program& program, const Item& item) {
  const Statement& statement = *item.statement;
  Scope& scope = *item.scope;
  if (statement.operands.size() > 1)
    fail(program, Message("G0313", "`gravity` takes one value, here is more", statement.operands[1].span)
                      .help("as in `gravity 9.81 m/s^2`"));
  if (statement.operands.empty())
    fail(program, Message("G0312", "`gravity` takes an acceleration or `(x, y, z)`", statement.keyword.span));
  const Expr& expr = statement.operands[0];
  const Value value = eval(program, expr, scope);
  if (value.as<PointValue>() != nullptr) {
    program.garment.gravity = vector_of(eval_point(program, expr, scope, 3, kAcceleration, "`gravity`"));
  } else {
    program.garment.gravity = {0, -as_quantity(program, value, expr.span, kAcceleration, "`gravity`").value,
                               0};
  }
  if (!(program.garment.gravity.norm() <= 1000))
    fail(program,
         Message("G0309", "a gravity of " + show(value) + "; it must be 1000 m/s^2 at most", expr.span));
}

int reserve_pin(Program& program, const Declaration& declaration) {
  program.garment.pins.emplace_back().name = declaration.name;
  return static_cast<int>(program.garment.pins.size()) - 1;
}

Value evaluate_pin(Program& program, Declaration& declaration) {
  const Statement& statement = *declaration.statement;
  Clauses clauses(program, statement, *declaration.scope, &declaration.overrides);
  const BoundClause& on = clauses.need("on");
  const int panel = eval_panel(program, clauses.value(on), *on.scope, "`on`");
  const BoundClause& at = clauses.need("at");
  const Expr& expr = clauses.value(at);
  const PointValue p = eval_point(program, expr, *at.scope, 2, kLength, "`at`");
  clauses.finish();
  const PanelInfo& info = program.panels[static_cast<std::size_t>(panel)];
  if (p.panel >= 0 && p.panel != panel)
    fail(program, Message("G0613",
                          "the point lies on panel `" +
                              program.panels[static_cast<std::size_t>(p.panel)].panel.name + "`, not on `" + info.panel.name + "`",
                          expr.span)
                      .help("name the panel that the point lies on after `on`, or take a point of `" + info.panel.name + "`"));
  const design::Point2 point(p.at[0], p.at[1]);
  if (!contains(info.panel, point, 1e-3))
    fail(program,
         Message("G0613", "the point " + show(Value{p}) + " lies outside panel `" + info.panel.name + "`",
                 expr.span)
             .help("points of a panel are in its own coordinates, as drawn"));
  design::Pin& pin = program.garment.pins[static_cast<std::size_t>(declaration.index)];
  pin = {declaration.name, program.origin(statement.span), panel, point};
  return Value{PinValue{declaration.index}};
}

}  // namespace garment::interpreter
