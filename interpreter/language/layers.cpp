#include "interpreter/language/layers.hpp"

#include <algorithm>

#include "interpreter/language/clauses.hpp"
#include "interpreter/language/closures.hpp"
#include "interpreter/language/fabrics.hpp"
#include "interpreter/language/regions.hpp"
#include "interpreter/language/seam_finish.hpp"
#include "runtime/base/portable_math.hpp"

namespace garment::interpreter {
namespace {

design::Panel& panel_at(Program& program, int index) {
  return program.panels[static_cast<std::size_t>(index)].panel;
}

const char* side_text(design::Facing side) { return side == design::Facing::face ? "face" : "back"; }

void refuse_layer_operands(Program& program, const Statement& statement) {
  if (!statement.operands.empty())
    fail(program,
         Message("G0313", "this means nothing here", statement.operands[0].span)
             .help("the form is `" + std::string(find_construct(statement.keyword.text)->form) + "`"));
}

void take_under(Program& program, Clauses& clauses, design::Layer& layer) {
  const BoundClause* above = clauses.find("above");
  if (above == nullptr) return;
  const Expr& expr = clauses.value(*above);
  const Value value = eval(program, expr, *above->scope);
  const auto* thing = value.as<ThingValue>();
  if (thing == nullptr || thing->keyword != "layer")
    fail(program, Message("G0306", kind_of(value) + " where `above` takes a layer", expr.span)
                      .help("a whole panel lies `under` or `over` another by a clause of its own"));
  const design::Layer& other = program.garment.layers[static_cast<std::size_t>(thing->index)];
  const std::string own = panel_at(program, layer.panel).name, theirs = panel_at(program, other.panel).name;
  if (other.panel != layer.panel)
    fail(program, Message("G1110",
                          "layer `" + other.name + "` is on panel `" + theirs + "`, `" + layer.name +
                              "` on `" + own + "`",
                          expr.span)
                      .also(program.origins[other.origin.value], "the other layer")
                      .help("a layer lies above a layer of its own panel"));
  if (other.side != layer.side)
    fail(program, Message("G1110",
                          "layer `" + other.name + "` lies on the " + side_text(other.side) + " of `" + own +
                              "`, `" + layer.name + "` on its " + side_text(layer.side),
                          expr.span)
                      .also(program.origins[other.origin.value], "the other layer")
                      .help("put both on one side: `side " + std::string(side_text(other.side)) + "`"));
  layer.above = thing->index;
}

/// Order of a layer over its panel: one more than that of the layer it lies on.
void number_layers(Program& program) {
  std::vector<design::Layer>& layers = program.garment.layers;
  std::vector<std::pair<int, std::size_t>>
      ranks;  // how many layers it was said to lie on; declared order decides ties
  for (std::size_t k = 0; k < layers.size(); ++k) {
    int rank = 0;
    for (int at = layers[k].above; at >= 0 && rank <= static_cast<int>(layers.size());
         at = layers[static_cast<std::size_t>(at)].above)
      ++rank;
    ranks.emplace_back(rank, k);
  }
  std::sort(ranks.begin(), ranks.end());
  for (std::size_t i = 0; i < ranks.size(); ++i) {
    design::Layer& layer = layers[ranks[i].second];
    layer.order = 0;
    for (std::size_t j = 0; j < i; ++j) {
      const design::Layer& below = layers[ranks[j].second];
      if (below.panel == layer.panel && below.side == layer.side) ++layer.order;
    }
  }
}

/// Takes `under PANEL` and `over PANEL` of one panel statement.
void take_stackings(Program& program, const Declaration& declaration) {
  for (const Clause& clause : declaration.statement->clauses) {
    const bool over = clause.word.text == "over";
    if (!over && clause.word.text != "under") continue;
    if (clause.values.empty())
      fail(program, Message("G0312", "`" + clause.word.text + "` needs a panel", clause.span));
    for (const Expr& expr : clause.values) {
      const int other = eval_panel(program, expr, *declaration.scope, "`" + clause.word.text + "`");
      if (other == declaration.index)
        fail(program,
             Message("G1113", "panel `" + declaration.name + "` cannot lie " + clause.word.text + " itself",
                     expr.span)
                 .help("name the panel that it covers or lines"));
      program.garment.stackings.push_back({program.origin(clause.span), declaration.index, other, over});
    }
  }
}

/// Path from panel `at` to `goal` along "lies over"; true once found.
bool find_path(const std::vector<design::Stacking>& stackings, int at, int goal, std::vector<char>& seen,
               std::vector<const design::Stacking*>& path) {
  for (const design::Stacking& s : stackings) {
    const int upper = s.over ? s.panel : s.other, lower = s.over ? s.other : s.panel;
    if (upper != at) continue;
    path.push_back(&s);
    if (lower == goal) return true;
    if (!seen[static_cast<std::size_t>(lower)]) {
      seen[static_cast<std::size_t>(lower)] = 1;
      if (find_path(stackings, lower, goal, seen, path)) return true;
    }
    path.pop_back();
  }
  return false;
}

void check_stackings(Program& program) {
  const std::vector<design::Stacking>& stackings = program.garment.stackings;
  for (const design::Stacking& s : stackings) {
    const int upper = s.over ? s.panel : s.other;
    std::vector<char> seen(program.panels.size(), 0);
    std::vector<const design::Stacking*> path;
    if (!find_path(stackings, upper, upper, seen, path)) continue;
    std::string text = '`' + panel_at(program, upper).name + '`';
    for (const design::Stacking* step : path)
      text += " over `" + panel_at(program, step->over ? step->other : step->panel).name + "`";
    Message message("G1112", "the panels lie over each other in a circle: " + text,
                    program.origins[path.back()->origin.value]);
    for (std::size_t k = 0; k + 1 < path.size(); ++k)
      message.also(program.origins[path[k]->origin.value], "");
    report(program,
           message.help("leave out one of these clauses; `under` is toward the body, `over` away from it"));
    return;
  }
}

/// A region of its own, which no statement names, for a layer on one half of a panel.
int add_half_region(Program& program, const design::Layer& layer, const PanelPart& part) {
  design::Region region;
  region.name = layer.name;
  region.origin = layer.origin;
  region.parts = {{part.panel, half_shape(program, part)}};
  program.garment.regions.push_back(std::move(region));
  return static_cast<int>(program.garment.regions.size()) - 1;
}

}  // namespace

int reserve_layer(Program& program, const Declaration& declaration) {
  program.garment.layers.emplace_back().name = declaration.name;
  return static_cast<int>(program.garment.layers.size()) - 1;
}

Value evaluate_layer(Program& program, Declaration& declaration) {
  const Statement& statement = *declaration.statement;
  Clauses clauses(program, statement, *declaration.scope, &declaration.overrides);
  refuse_layer_operands(program, statement);
  design::Layer layer;
  layer.name = declaration.name;
  layer.origin = program.origin(statement.span);
  const BoundClause& of = clauses.need("of");
  const Value cloth = eval(program, clauses.value(of), *of.scope);
  const auto* fabric = cloth.as<FabricValue>();
  if (fabric == nullptr)
    fail(program, Message("G0306", kind_of(cloth) + " where `of` takes a fabric", of.clause->values[0].span));
  const BoundClause& on = clauses.need("on");
  const PanelPart part = eval_panel_part(program, clauses.value(on), *on.scope, "`on`");
  layer.panel = part.panel;
  layer.grain_angle = panel_at(program, layer.panel).grain_angle;
  if (const BoundClause* in = clauses.find("in"))
    layer.region = eval_region_on(program, clauses.value(*in), *in->scope, layer.panel, "`in`");
  else if (!part.half.empty())
    layer.region = add_half_region(program, layer, part);
  const bool fused = clauses.flag("fused"), basted = clauses.flag("basted");
  if (fused == basted)
    fail(program, Message(fused ? "G0415" : "G0312",
                          fused ? "a layer is `fused` or `basted`, not both"
                                : "say how the layer is joined: `fused` or `basted`",
                          statement.keyword.span)
                      .help(fused ? "leave one of them out"
                                  : "a layer that hangs free is a panel of its own, `under` this one"));
  layer.fused = fused;
  if (const BoundClause* grain = clauses.find("grain")) {
    const design::Point2 way = eval_direction(program, clauses.value(*grain), *grain->scope, "`grain`");
    layer.grain_angle = portable::atan2(-way.x(), way.y());
  }
  if (const BoundClause* side = clauses.find("side"))
    layer.side = eval_facing(program, *side->clause, "`side`");
  take_under(program, clauses, layer);
  clauses.finish();
  layer.fabric = fabric_index(program, fabric->fabric);
  program.garment.layers[static_cast<std::size_t>(declaration.index)] = std::move(layer);
  return Value{ThingValue{"layer", &declaration, declaration.index}};
}

int reserve_pad(Program& program, const Declaration& declaration) {
  program.garment.pads.emplace_back().name = declaration.name;
  return static_cast<int>(program.garment.pads.size()) - 1;
}

Value evaluate_pad(Program& program, Declaration& declaration) {
  const Statement& statement = *declaration.statement;
  Clauses clauses(program, statement, *declaration.scope, &declaration.overrides);
  refuse_layer_operands(program, statement);
  design::Pad pad;
  pad.name = declaration.name;
  pad.origin = program.origin(statement.span);
  const BoundClause& on = clauses.need("on");
  pad.panel = eval_panel_part(program, clauses.value(on), *on.scope, "`on`").panel;
  const BoundClause *in = clauses.find("in"), *at = clauses.find("at");
  if ((in == nullptr) == (at == nullptr))
    fail(program,
         Message("G0312", "a pad lies `in REGION` or `at POINT radius LENGTH`", statement.keyword.span)
             .help("write `" + std::string(find_construct("pad")->form) + "`"));
  if (in != nullptr) pad.region = eval_region_on(program, clauses.value(*in), *in->scope, pad.panel, "`in`");
  if (at != nullptr) {
    pad.centre = eval_cloth_point(program, clauses.value(*at), *at->scope, pad.panel, "the pad");
    const auto radius = clauses.quantity("radius");
    if (!radius) clauses.need("radius");
    pad.radius = *radius;
  }
  const BoundClause& thickness = clauses.need("thickness");
  const ClauseRecord& record = *find_clause(*find_construct("pad"), "thickness");
  for (const Expr& expr : thickness.clause->values)
    pad.thickness.push_back(checked_quantity(
        program, record, eval_quantity(program, expr, *thickness.scope, kLength, "`thickness`"), expr.span));
  if (pad.thickness.empty())
    fail(program, Message("G0312", "`thickness` needs a length, or several from the middle outwards",
                          thickness.clause->span));
  if (const BoundClause* side = clauses.find("side"))
    pad.side = eval_facing(program, *side->clause, "`side`");
  clauses.finish();
  program.garment.pads[static_cast<std::size_t>(declaration.index)] = std::move(pad);
  return Value{ThingValue{"pad", &declaration, declaration.index}};
}

void settle_layers(Program& program) {
  number_layers(program);
  for (const Declaration& declaration : program.declarations) {
    if (declaration.statement == nullptr || declaration.statement->keyword.text != "panel" ||
        declaration.state != Declaration::State::done)
      continue;
    try {
      take_stackings(program, declaration);
    } catch (const Stop&) {
    }
  }
  check_stackings(program);
}

}  // namespace garment::interpreter
