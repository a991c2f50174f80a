// Zips, hems and tacks.
#include "interpreter/language/closures.hpp"

#include <cmath>

#include "interpreter/language/clauses.hpp"
#include "interpreter/language/edges.hpp"
#include "interpreter/language/regions.hpp"
#include "interpreter/language/seam_finish.hpp"

namespace garment::interpreter {
namespace {

constexpr double kZipTolerance = 2e-3;  // m

std::vector<design::EdgePart> parts_of(const EdgeValue& edge) {
  std::vector<design::EdgePart> parts;
  for (const EdgeSpan& span : edge.spans) {
    const EdgeSpan walked = span.backwards ? reversed(span) : span;
    parts.insert(parts.end(), walked.parts.begin(), walked.parts.end());
  }
  return parts;
}

void refuse_operands(Program& program, const Statement& statement, const char* first) {
  if (!statement.operands.empty())
    fail(program, Message("G0313", "this means nothing before `" + std::string(first) + "`",
                          statement.operands[0].span)
                      .help("write `" + std::string(find_construct(statement.keyword.text)->form) + "`"));
}

}  // namespace

int reserve_zip(Program& program, const Declaration& declaration) {
  program.garment.zips.emplace_back().name = declaration.name;
  return static_cast<int>(program.garment.zips.size()) - 1;
}

Value evaluate_zip(Program& program, Declaration& declaration) {
  const Statement& statement = *declaration.statement;
  Clauses clauses(program, statement, *declaration.scope, &declaration.overrides);
  refuse_operands(program, statement, ":");
  design::Zip zip;
  zip.name = declaration.name;
  zip.origin = program.origin(statement.span);
  EdgeValue edges[2];
  Span spans[2];
  for (int k = 0; k < 2; ++k) {
    const BoundClause& clause = clauses.need(k == 0 ? ":" : "to");
    const Expr& expr = clauses.value(clause);
    edges[k] = eval_edges(program, expr, *clause.scope, "a side of a zip");
    spans[k] = expr.span;
    zip.side_origin[k] = program.origin(expr.span);
    zip.sides[k] = parts_of(edges[k]);
  }
  const bool turned = clauses.flag("reversed");
  if (const auto open = clauses.quantity("open")) zip.open = *open;
  clauses.finish();
  const double one = sewn_length(program, edges[0]), two = sewn_length(program, edges[1]);
  if (std::fabs(one - two) > kZipTolerance)
    fail(program, Message("G1404",
                          "the sides of zip `" + zip.name + "` differ by " + format_mm(std::fabs(one - two)) +
                              "; a zip's tapes are equally long",
                          spans[1], format_mm(two))
                      .also(spans[0], format_mm(one))
                      .help("shorten the longer side, `" + std::string(program.sources.text(spans[one > two ? 0 : 1])) + "`, to " +
                            format_quantity(std::min(one, two), kLength) + ": a part of an edge is written `EDGE[start .. 20 cm]`"));
  // The rule of seams: the sides run oppositely round their loops; the first one counts from its drawn start.
  auto with_loop = [&](const design::EdgePart& part) {
    return (part.to >= part.from) == program.panels[static_cast<std::size_t>(part.panel)].counter_clockwise;
  };
  const bool same_way = with_loop(zip.sides[0].front()) == with_loop(zip.sides[1].front());
  if (same_way != turned) {
    EdgeSpan second;
    second.parts = zip.sides[1];
    zip.sides[1] = reversed(second).parts;
  }
  program.garment.zips[static_cast<std::size_t>(declaration.index)] = std::move(zip);
  return Value{ThingValue{"zip", &declaration, declaration.index}};
}

int reserve_hem(Program& program, const Declaration& declaration) {
  program.garment.hems.emplace_back().name = declaration.name;
  return static_cast<int>(program.garment.hems.size()) - 1;
}

Value evaluate_hem(Program& program, Declaration& declaration) {
  const Statement& statement = *declaration.statement;
  Clauses clauses(program, statement, *declaration.scope, &declaration.overrides);
  refuse_operands(program, statement, "on");
  design::Hem hem;
  hem.name = declaration.name;
  hem.origin = program.origin(statement.span);
  const BoundClause& on = clauses.need("on");
  hem.parts = parts_of(eval_edges(program, clauses.value(on), *on.scope, "`on`"));
  for (const design::EdgePart& part : hem.parts)
    if (part.on == design::EdgePart::On::line)
      fail(program, Message("G1405", "a hem turns an edge of the cloth; this is a line inside it",
                            on.clause->values[0].span)
                        .help("fold along a line with `iron NAME along LINE fold 180 deg to back`"));
  const auto turn = clauses.quantity("turn");
  if (!turn) clauses.need("turn");
  hem.turn = *turn;
  if (const BoundClause* to = clauses.find("to")) hem.to = eval_facing(program, *to->clause, "a hem");
  clauses.finish();
  program.garment.hems[static_cast<std::size_t>(declaration.index)] = std::move(hem);
  return Value{ThingValue{"hem", &declaration, declaration.index}};
}

int reserve_tack(Program& program, const Declaration& declaration) {
  program.garment.tacks.emplace_back().name = declaration.name;
  return static_cast<int>(program.garment.tacks.size()) - 1;
}

Value evaluate_tack(Program& program, Declaration& declaration) {
  const Statement& statement = *declaration.statement;
  Clauses clauses(program, statement, *declaration.scope, &declaration.overrides);
  refuse_operands(program, statement, ":");
  design::Tack tack;
  tack.name = declaration.name;
  tack.origin = program.origin(statement.span);
  for (int k = 0; k < 2; ++k) {
    const BoundClause& clause = clauses.need(k == 0 ? ":" : "to");
    tack.panel[k] =
        eval_panel_part(program, clauses.value(clause), *clause.scope, k == 0 ? "`tack`" : "`to`").panel;
    if (k == 1 && tack.panel[0] == tack.panel[1])
      fail(program, Message("G1406",
                            "a tack holds two panels together; both are `" +
                                program.panels[static_cast<std::size_t>(tack.panel[0])].panel.name + "`",
                            clauses.value(clause).span)
                        .help("to fold a panel onto itself, iron or hem it"));
  }
  const BoundClause *along = clauses.find("along"), *in = clauses.find("in");
  if ((along == nullptr) == (in == nullptr))
    fail(program, Message("G0312", "a tack is sewn `along LINE` or `in REGION`", statement.span)
                      .help("write `" + std::string(find_construct("tack")->form) + "`"));
  if (along != nullptr) {
    const Expr& expr = clauses.value(*along);
    tack.line = parts_of(eval_edges(program, expr, *along->scope, "`along`"));
    for (const design::EdgePart& part : tack.line)
      if (part.panel != tack.panel[0])
        fail(program,
             Message("G1406",
                     "the line lies on `" + program.panels[static_cast<std::size_t>(part.panel)].panel.name +
                         "`; a tack follows a line of its first panel, `" +
                         program.panels[static_cast<std::size_t>(tack.panel[0])].panel.name + "`",
                     expr.span)
                 .help("name the panel with the line first"));
  } else {
    const Expr& expr = clauses.value(*in);
    tack.region = eval_region_on(program, expr, *in->scope, tack.panel[0], "`in`");
  }
  clauses.finish();
  program.garment.tacks[static_cast<std::size_t>(declaration.index)] = std::move(tack);
  return Value{ThingValue{"tack", &declaration, declaration.index}};
}

}  // namespace garment::interpreter
