// path, clamp, force, pressure: declared things of the scene.
#include "interpreter/language/clauses.hpp"
#include "interpreter/language/declarations.hpp"
#include "interpreter/language/scene.hpp"

namespace garment::interpreter {
namespace {

constexpr double kFarthestMove = 100;  // m a body may move
constexpr double kMostTurn = 1000;     // rad
constexpr double kMostForce = 10'000;  // N

template <class List>
int reserve_in(List& list, const Declaration& declaration) {
  list.emplace_back().name = declaration.name;
  return static_cast<int>(list.size()) - 1;
}

template <class List>
auto& place_of(List& list, Program& program, const Declaration& declaration) {
  auto& made = list[static_cast<std::size_t>(declaration.index)];
  made.origin = program.origin(declaration.statement->span);
  return made;
}

void refuse_operands(Program& program, const Statement& statement) {
  if (!statement.operands.empty())
    fail(
        program,
        Message("G0313", "this means nothing in `" + statement.keyword.text + "`", statement.operands[0].span)
            .help("the form is `" + std::string(find_construct(statement.keyword.text)->form) + "`"));
}

design::Pose read_pose(Program& program, const Statement& statement, Scope& scope) {
  refuse_operands(program, statement);
  Clauses clauses(program, statement, scope);
  design::Pose pose;
  clauses.need("at");
  pose.time = *clauses.quantity("at");
  if (const BoundClause* move = clauses.find("move"))
    pose.move = eval_vector(program, clauses.value(*move), *move->scope, kLength, kFarthestMove, "`move`");
  if (const BoundClause* turn = clauses.find("turn"))
    pose.turn = eval_vector(program, clauses.value(*turn), *turn->scope, kAngle, kMostTurn, "`turn`");
  clauses.finish();
  return pose;
}

}  // namespace

int reserve_path(Program& program, const Declaration& declaration) {
  return reserve_in(program.garment.scene.paths, declaration);
}

Value evaluate_path(Program& program, Declaration& declaration) {
  const Statement& statement = *declaration.statement;
  refuse_operands(program, statement);
  Clauses clauses(program, statement, *declaration.scope, &declaration.overrides);
  design::Path path = place_of(program.garment.scene.paths, program, declaration);
  if (const BoundClause* of = clauses.find("of")) {
    const Expr& expr = clauses.value(*of);
    const Value value = eval(program, expr, *of->scope);
    const auto* body = value.as<BodyValue>();
    if (body == nullptr)
      fail(program, Message("G0306", kind_of(value) + " where `of` takes a body", expr.span)
                        .help("a path without `of` is for a clamp: `clamp jaw: strip.end path NAME`"));
    path.body = body->body;
    for (const design::Path& other : program.garment.scene.paths)
      if (&other != &program.garment.scene.paths[static_cast<std::size_t>(declaration.index)] &&
          other.body == path.body)
        fail(program, Message("G1302",
                              "body `" + program.garment.bodies[static_cast<std::size_t>(path.body)].name +
                                  "` has the path `" + other.name + "` already",
                              expr.span)
                          .also(program.origins[other.origin.value], "first here")
                          .help("put all its poses into one path"));
  }
  clauses.finish();
  if (!statement.body)
    fail(program, Message("G0312", "`path` needs a block with poses", statement.keyword.span)
                      .help("as in `path lift of table { pose at 2 s move (0, 10 cm, 0) }`"));
  expand_block(program, *statement.body, *declaration.scope, [&](const Statement& pose, Scope& scope) {
    if (pose.keyword.text != "pose")
      fail(program,
           Message("G0322", "`" + pose.keyword.text + "` cannot stand in a path", pose.keyword.span));
    const design::Pose made = read_pose(program, pose, scope);
    if (path.poses.empty() && made.time > 0) path.poses.emplace_back();
    if (!path.poses.empty() && made.time <= path.poses.back().time)
      fail(program, Message("G1303",
                            "a pose at " + format_quantity(made.time, kTime) + " after one at " +
                                format_quantity(path.poses.back().time, kTime),
                            pose.span)
                        .help("poses follow each other in time"));
    path.poses.push_back(made);
  });
  if (path.poses.size() < 2)
    fail(program, Message("G1304", "path `" + path.name + "` moves nothing: it has one pose at 0 s or none",
                          statement.name ? statement.name->span : statement.span)
                      .help("write a `pose` at a later time"));
  program.garment.scene.paths[static_cast<std::size_t>(declaration.index)] = path;
  return Value{ThingValue{"path", &declaration, declaration.index}};
}

int reserve_clamp(Program& program, const Declaration& declaration) {
  return reserve_in(program.garment.scene.clamps, declaration);
}

Value evaluate_clamp(Program& program, Declaration& declaration) {
  refuse_operands(program, *declaration.statement);
  Clauses clauses(program, *declaration.statement, *declaration.scope, &declaration.overrides);
  design::Clamp& clamp = place_of(program.garment.scene.clamps, program, declaration);
  const BoundClause& what = clauses.need(":");
  const Expr& expr = clauses.value(what);
  const Value value = eval(program, expr, *what.scope);
  const auto* thing = value.as<ThingValue>();
  if (const auto* edge = value.as<EdgeValue>()) {
    for (const EdgeSpan& span : edge->spans)
      clamp.parts.insert(clamp.parts.end(), span.parts.begin(), span.parts.end());
  } else if (thing != nullptr && thing->keyword == "region") {
    clamp.region = thing->index;
  } else {
    fail(program,
         Message("G0306", kind_of(value) + " where `clamp` takes a region or an edge", expr.span)
             .help("as in `clamp jaw: strip.end`, or declare a region: `region grip in strip: below 2 cm`"));
  }
  if (const BoundClause* path = clauses.find("path")) {
    const Expr& name = clauses.value(*path);
    const Value moved = eval(program, name, *path->scope);
    const auto* motion = moved.as<ThingValue>();
    if (motion == nullptr || motion->keyword != "path")
      fail(program, Message("G0306", kind_of(moved) + " where `path` takes a path", name.span));
    if (program.garment.scene.paths[static_cast<std::size_t>(motion->index)].body >= 0)
      fail(program, Message("G1305", "path `" + motion->declaration->name + "` moves a body", name.span)
                        .also(motion->declaration->statement->span, "declared here")
                        .help("a clamp's path is declared without `of`"));
    clamp.path = motion->index;
  }
  clauses.finish();
  return Value{ThingValue{"clamp", &declaration, declaration.index}};
}

int reserve_force(Program& program, const Declaration& declaration) {
  return reserve_in(program.garment.scene.forces, declaration);
}

Value evaluate_force(Program& program, Declaration& declaration) {
  refuse_operands(program, *declaration.statement);
  Clauses clauses(program, *declaration.statement, *declaration.scope, &declaration.overrides);
  design::Force& force = place_of(program.garment.scene.forces, program, declaration);
  const BoundClause& on = clauses.need("on");
  force.panel = eval_panel(program, clauses.value(on), *on.scope, "`on`");
  const BoundClause& at = clauses.need("at");
  force.point = eval_panel_point(program, clauses.value(at), *at.scope, force.panel, "`at`").point;
  const BoundClause& of = clauses.need("of");
  force.newtons = eval_vector(program, clauses.value(of), *of.scope, kForce, kMostForce, "`of`");
  clauses.finish();
  return Value{ThingValue{"force", &declaration, declaration.index}};
}

int reserve_pressure(Program& program, const Declaration& declaration) {
  return reserve_in(program.garment.scene.pressures, declaration);
}

Value evaluate_pressure(Program& program, Declaration& declaration) {
  refuse_operands(program, *declaration.statement);
  Clauses clauses(program, *declaration.statement, *declaration.scope, &declaration.overrides);
  design::Pressure& pressure = place_of(program.garment.scene.pressures, program, declaration);
  const BoundClause& on = clauses.need("on");
  pressure.panel = eval_panel(program, clauses.value(on), *on.scope, "`on`");
  clauses.need("of");
  pressure.pascals = *clauses.quantity("of");
  clauses.finish();
  return Value{ThingValue{"pressure", &declaration, declaration.index}};
}

}  // namespace garment::interpreter
