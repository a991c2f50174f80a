// constrain, friction, wind, drag, solver: what the scene states without a name.
#include "interpreter/language/clauses.hpp"
#include "interpreter/language/fabrics.hpp"
#include "interpreter/language/scene.hpp"

namespace garment::interpreter {
namespace {

constexpr double kFastestWind = 60;    // m/s
constexpr double kFarthestAir = 1000;  // m
constexpr double kMostDrag = 10;
constexpr double kMostFriction = 2;

const Expr& only_operand(Program& program, const Statement& statement, const char* example) {
  if (statement.operands.size() == 1) return statement.operands[0];
  const bool none = statement.operands.empty();
  fail(program, Message(none ? "G0312" : "G0313", "`" + statement.keyword.text + "` takes one value",
                        none ? statement.keyword.span : statement.operands[1].span)
                    .help("as in `" + std::string(example) + "`"));
}

/// One of `words`, written as a plain name.
std::size_t eval_word(Program& program, const Expr& expr, const std::vector<std::string>& words,
                      const std::string& what) {
  for (std::size_t k = 0; k < words.size(); ++k)
    if (expr.kind == ExprKind::name && expr.text == words[k]) return k;
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : ", ") + word;
  const std::string hint = expr.kind == ExprKind::name ? did_you_mean(expr.text, words) : "";
  fail(program,
       Message("G1306", "`" + std::string(program.sources.text(expr.span)) + "` is no " + what, expr.span)
           .help(hint.empty() ? "it is one of " + all : hint));
}

Eigen::Vector3d eval_way(Program& program, Clauses& clauses, const char* word) {
  const BoundClause& clause = clauses.need(word);
  const Expr& expr = clauses.value(clause);
  const Eigen::Vector3d way =
      eval_vector(program, expr, *clause.scope, kNumber, kFarthestAir, "`" + std::string(word) + "`");
  if (!(way.norm() > 1e-9))
    fail(program,
         Message("G0309", "`" + std::string(word) + "` has no direction: it is (0, 0, 0)", expr.span));
  return way.normalized();
}

/// What takes part in a friction pair.
struct Rubbing {
  int fabric = -1, body = -1;
};
Rubbing eval_rubbing(Program& program, const Expr& expr, Scope& scope) {
  const Value value = eval(program, expr, scope);
  if (const auto* body = value.as<BodyValue>()) return {-1, body->body};
  if (const auto* fabric = value.as<FabricValue>()) return {fabric_index(program, fabric->fabric), -1};
  fail(program, Message("G0306", kind_of(value) + " where `friction` takes a fabric or a body", expr.span)
                    .help("as in `friction shell form 0.25`"));
}

bool same_pair(const design::FrictionPair& a, const design::FrictionPair& b) {
  if (a.body != b.body) return false;
  return (a.fabric == b.fabric && a.other_fabric == b.other_fabric) ||
         (a.fabric == b.other_fabric && a.other_fabric == b.fabric);
}

void refuse_second(Program& program, const Statement& statement, OriginId first) {
  fail(program, Message("G0314", "`" + statement.keyword.text + "` is given twice", statement.keyword.span)
                    .also(program.origins[first.value], "first here"));
}

}  // namespace

void run_constrain(Program& program, const Item& item) {
  const Statement& statement = *item.statement;
  Scope& scope = *item.scope;
  using Kind = design::Constraint::Kind;
  if (statement.operands.size() != 2)
    fail(program,
         Message(statement.operands.size() < 2 ? "G0312" : "G0313", "`constrain` takes its kind and a point",
                 statement.operands.size() < 2 ? statement.keyword.span : statement.operands[2].span)
             .help("as in `constrain distance front.hem.start to back.hem.start of 3 cm`"));
  design::Constraint made;
  made.origin = program.origin(statement.span);
  made.kind = static_cast<Kind>(eval_word(
      program, statement.operands[0], {"distance", "on_line", "on_plane", "equal"}, "kind of constraint"));
  made.a = eval_panel_point(program, statement.operands[1], scope, -1, "`constrain`");
  Clauses clauses(program, statement, scope);
  if (made.kind == Kind::distance || made.kind == Kind::equal) {
    const BoundClause& to = clauses.need("to");
    made.b = eval_panel_point(program, clauses.value(to), *to.scope, -1, "`to`");
    if (made.a.panel == made.b.panel && (made.a.point - made.b.point).norm() < 1e-6)
      fail(program, Message("G1307", "a point is constrained to itself", clauses.value(to).span));
    if (made.kind == Kind::distance) {
      clauses.need("of");
      made.length = *clauses.quantity("of");
    }
  } else {
    const BoundClause& through = clauses.need("through");
    made.through =
        eval_vector(program, clauses.value(through), *through.scope, kLength, kFarthestAir, "`through`");
    made.along = eval_way(program, clauses, made.kind == Kind::on_line ? "along" : "normal");
  }
  clauses.finish();
  program.garment.scene.constraints.push_back(made);
}

void run_friction(Program& program, const Item& item) {
  const Statement& statement = *item.statement;
  if (statement.operands.size() != 3)
    fail(program, Message(statement.operands.size() < 3 ? "G0312" : "G0313",
                          "`friction` takes two things and a number",
                          statement.operands.size() < 3 ? statement.keyword.span : statement.operands[3].span)
                      .help("as in `friction shell form 0.25` or `friction shell lining 0.3`"));
  const Rubbing a = eval_rubbing(program, statement.operands[0], *item.scope),
                b = eval_rubbing(program, statement.operands[1], *item.scope);
  if (a.body >= 0 && b.body >= 0)
    fail(program, Message("G1308", "two bodies do not rub on each other", statement.operands[1].span)
                      .help("name a fabric and a body, or two fabrics"));
  design::FrictionPair pair;
  pair.origin = program.origin(statement.span);
  pair.fabric = a.fabric >= 0 ? a.fabric : b.fabric;
  pair.body = std::max(a.body, b.body);
  pair.other_fabric = a.fabric >= 0 && b.fabric >= 0 ? b.fabric : -1;
  const Expr& factor = statement.operands[2];
  pair.factor = eval_quantity(program, factor, *item.scope, kNumber, "`friction`").value;
  if (!(pair.factor >= 0 && pair.factor <= kMostFriction))
    fail(
        program,
        Message("G0309", "a friction of " + format_quantity(pair.factor, kNumber) + "; it must lie in 0 .. 2",
                factor.span));
  for (const design::FrictionPair& other : program.garment.scene.frictions)
    if (same_pair(other, pair))
      fail(program, Message("G1309", "the friction of this pair is stated twice", statement.span)
                        .also(program.origins[other.origin.value], "first here"));
  program.garment.scene.frictions.push_back(pair);
}

void run_wind(Program& program, const Item& item) {
  const Statement& statement = *item.statement;
  if (program.garment.scene.wind) refuse_second(program, statement, program.garment.scene.wind->origin);
  design::Wind wind;
  wind.origin = program.origin(statement.span);
  wind.velocity = eval_vector(program, only_operand(program, statement, "wind (0, 0, 5 m/s) gust 20%"),
                              *item.scope, Dimension{1, 0, -1, 0}, kFastestWind, "`wind`");
  Clauses clauses(program, statement, *item.scope);
  if (const auto gust = clauses.quantity("gust")) wind.gust = *gust;
  clauses.finish();
  program.garment.scene.wind = wind;
}

void run_drag(Program& program, const Item& item) {
  const Statement& statement = *item.statement;
  design::Scene& scene = program.garment.scene;
  if (scene.drag) refuse_second(program, statement, scene.drag_origin);
  const Expr& expr = only_operand(program, statement, "drag 1.2");
  const double factor = eval_quantity(program, expr, *item.scope, kNumber, "`drag`").value;
  if (!(factor >= 0 && factor <= kMostDrag))
    fail(program,
         Message("G0309",
                 "a drag coefficient of " + format_quantity(factor, kNumber) + "; it must lie in 0 .. 10",
                 expr.span)
             .help("a sheet across the air has about 1.2"));
  scene.drag = factor;
  scene.drag_origin = program.origin(statement.span);
}

void run_solver(Program& program, const Item& item) {
  const Statement& statement = *item.statement;
  design::Scene& scene = program.garment.scene;
  if (scene.solver) refuse_second(program, statement, scene.solver->origin);
  design::SolverChoice choice;
  choice.origin = program.origin(statement.span);
  choice.method = static_cast<design::SolverChoice::Method>(
      eval_word(program, only_operand(program, statement, "solver quasi_static"),
                {"quasi_static", "dynamic_constraints", "implicit", "semi_implicit", "explicit"}, "solver"));
  Clauses clauses(program, statement, *item.scope);
  const BoundClause* stated = clauses.find("step");
  if (const auto step = clauses.quantity("step")) choice.step = *step;
  if (const BoundClause* hysteresis = clauses.find("hysteresis"))
    choice.hysteresis = eval_word(program, clauses.value(*hysteresis), {"off", "on"}, "word of `hysteresis`") == 1;
  if (const BoundClause* symmetric = clauses.find("symmetric"))
    choice.symmetric = eval_word(program, clauses.value(*symmetric), {"off", "on"}, "word of `symmetric`") == 1;
  clauses.finish();
  if (stated != nullptr && choice.method == design::SolverChoice::Method::quasi_static)
    fail(program,
         Message("G0313", "`step` goes with a solver of motion; `quasi_static` takes steps of its own",
                 stated->clause->span)
             .help("leave `step` out"));
  scene.solver = choice;
}

}  // namespace garment::interpreter
