#include "interpreter/language/regions.hpp"

#include "interpreter/language/clauses.hpp"
#include "interpreter/language/edges.hpp"
#include "interpreter/language/evaluate.hpp"

namespace garment::interpreter {
namespace {

using design::Point2;
using design::RegionFactors;
using design::RegionShape;

struct FactorInfo {
  std::string_view name;
  double RegionFactors::*first;
  double RegionFactors::*second;  ///< of a word that sets both directions; else null
  double min, max;
};
constexpr FactorInfo kFactors[] = {
    {"stretch_warp", &RegionFactors::stretch_warp, nullptr, 1e-3, 1e3},
    {"stretch_weft", &RegionFactors::stretch_weft, nullptr, 1e-3, 1e3},
    {"stretch", &RegionFactors::stretch_warp, &RegionFactors::stretch_weft, 1e-3, 1e3},
    {"shear", &RegionFactors::shear, nullptr, 1e-3, 1e3},
    {"bend_warp", &RegionFactors::bend_warp, nullptr, 1e-3, 1e3},
    {"bend_weft", &RegionFactors::bend_weft, nullptr, 1e-3, 1e3},
    {"bend", &RegionFactors::bend_warp, &RegionFactors::bend_weft, 1e-3, 1e3},
    {"twist", &RegionFactors::twist, nullptr, 1e-3, 1e3},
    {"mass", &RegionFactors::mass, nullptr, 1e-2, 100},
    {"friction", &RegionFactors::friction, nullptr, 0, 10},
    {"damping", &RegionFactors::damping, nullptr, 0, 100},
    {"thickness", &RegionFactors::thickness, nullptr, 0.1, 10},
};

const FactorInfo* find_factor(std::string_view name) {
  for (const FactorInfo& factor : kFactors)
    if (factor.name == name) return &factor;
  return nullptr;
}

double checked_factor(Program& program, const FactorInfo& factor, const Override& change) {
  const std::string word = "`" + std::string(factor.name) + "`";
  const Quantity q = eval_quantity(program, *change.value, *change.scope, kNumber, word);
  if (!(q.value >= factor.min && q.value <= factor.max))
    fail(program, Message("G0309",
                          word + " is " + format_quantity(q.value, {}) + "; a factor of a region lies in " +
                              format_quantity(factor.min, {}) + " .. " + format_quantity(factor.max, {}),
                          change.value->span)
                      .help("1 leaves the cloth as it is, 2 doubles"));
  return q.value;
}

/// `yoke.bend = 1.4` and its kin.
void take_factors(Program& program, Declaration& declaration, RegionFactors& factors) {
  std::vector<std::pair<double RegionFactors::*, Span>> given;
  for (Override& change : declaration.overrides) {
    const FactorInfo* factor = change.path.size() == 1 ? find_factor(change.path[0]) : nullptr;
    if (factor == nullptr) {
      change.used = true;
      std::vector<std::string> names = region_factor_names();
      std::string hint = change.path.size() == 1 ? did_you_mean(change.path[0], names) : "";
      if (hint.empty()) {
        hint = "factors are ";
        for (std::size_t k = 0; k < names.size(); ++k) hint += (k > 0 ? ", " : "") + names[k];
      }
      fail(program, Message("G0311", "a region has no `" + change.path[0] + "`", change.span).help(hint));
    }
    change.used = true;
    const double x = checked_factor(program, *factor, change);
    for (double RegionFactors::*member : {factor->first, factor->second}) {
      if (member == nullptr) continue;
      for (const auto& [known, span] : given)
        if (known == member)
          fail(program,
               Message("G0314", "`" + change.path[0] + "` says again what is already given", change.span)
                   .also(span, "first here")
                   .help("`stretch` and `bend` set warp and weft at once"));
      given.emplace_back(member, change.span);
      factors.*member = x;
    }
  }
}

std::vector<PanelPart> panels_of(Program& program, const BoundClause& in) {
  std::vector<PanelPart> panels;
  for (const Expr& expr : in.clause->values) {
    const PanelPart part = eval_panel_part(program, expr, *in.scope, "`in`");
    for (const PanelPart& known : panels)
      if (known.panel == part.panel && (known.half == part.half || known.half.empty() || part.half.empty()))
        fail(program, Message("G0314", "the region names this panel twice", expr.span));
    panels.push_back(part);
  }
  return panels;
}

void check_empty(Program& program, const Declaration& declaration, const design::Region& region,
                 const std::vector<PanelPart>& panels, const BoundClause& in) {
  std::vector<std::size_t> empty;
  for (std::size_t k = 0; k < region.parts.size(); ++k) {
    const design::Panel& panel = program.panels[static_cast<std::size_t>(panels[k].panel)].panel;
    if (!covers_cloth(panel, region.parts[k].shape)) empty.push_back(k);
  }
  const Statement& statement = *declaration.statement;
  const Span name = statement.name ? statement.name->span : statement.keyword.span;
  const char* const remedy =
      "shapes are in the panel's own coordinates, as drawn; is a sign or a side wrong?";
  if (empty.size() == region.parts.size())
    fail(program, Message("G1102", "region `" + region.name + "` covers no cloth", name).help(remedy));
  for (std::size_t k : empty)
    report(program, Message("G1103",
                            "region `" + region.name + "` covers no cloth of `" +
                                program.panels[static_cast<std::size_t>(panels[k].panel)].panel.name + "`",
                            in.clause->values[k].span)
                        .warning()
                        .help("leave the panel out of the region; or: " + std::string(remedy)));
}

}  // namespace

std::vector<std::string> region_factor_names() {
  std::vector<std::string> names;
  for (const FactorInfo& factor : kFactors) names.emplace_back(factor.name);
  return names;
}

std::optional<Value> region_member(const design::Region& region, const std::string& name) {
  const FactorInfo* factor = find_factor(name);
  if (factor == nullptr) return std::nullopt;
  const double x = region.factors.*factor->first;
  return number_value(factor->second == nullptr ? x : (x + region.factors.*factor->second) / 2);
}

PanelPart eval_panel_part(Program& program, const Expr& expr, Scope& scope, const std::string& what) {
  const Value value = eval(program, expr, scope);
  if (const auto* half = value.as<HalfValue>()) return {half->panel, half->half};
  const auto* panel = value.as<PanelValue>();
  if (panel == nullptr)
    fail(program, Message("G0306", kind_of(value) + " where " + what + " takes a panel", expr.span));
  if (scope.half.empty() || !program.panels[static_cast<std::size_t>(panel->panel)].folded)
    return {panel->panel, ""};
  for (const Scope* at = &scope; at != nullptr; at = at->parent) at->half_used = true;
  return {panel->panel, scope.half};
}

bool covers_cloth(const design::Panel& panel, const RegionShape& shape) {
  constexpr int kSteps = 64;
  const RegionShape loop = design::outline_shape(panel);
  const design::RegionTest outline(panel, loop), region(panel, shape);
  Point2 low = loop.points[0], high = low;
  for (const Point2& p : loop.points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  std::vector<Point2> places;
  region.collect_marks(places);
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j)
      places.emplace_back(
          low + Point2((i + 0.5) / kSteps * (high.x() - low.x()), (j + 0.5) / kSteps * (high.y() - low.y())));
  for (const Point2& p : places)
    if (region.contains(p) && outline.contains(p)) return true;
  return false;
}

int reserve_region(Program& program, const Declaration& declaration) {
  program.garment.regions.emplace_back().name = declaration.name;
  return static_cast<int>(program.garment.regions.size()) - 1;
}

Value evaluate_region(Program& program, Declaration& declaration) {
  const Statement& statement = *declaration.statement;
  Scope& scope = *declaration.scope;
  for (const Expr& operand : statement.operands)
    fail(program, Message("G0313", "`" + std::string(program.sources.text(operand.span)) + "` means nothing before `in`", operand.span));
  BoundClause in{nullptr, &scope};
  bool shape_begun = false;
  for (const Clause& clause : statement.clauses) {
    if (clause.word.text == "in" && (in.clause != nullptr || shape_begun))
      fail(program, Message("G0314", "`in` stands once, before the shape", clause.word.span));
    if (clause.word.text == "in") in.clause = &clause;
    if (clause.word.text == ":") shape_begun = true;
    if (clause.word.text != "in" && !shape_begun)
      fail(program, Message("G0313", "`" + clause.word.text + "` stands after `:`", clause.word.span)
                        .help("write `region NAME in PANEL: SHAPE`"));
  }
  if (in.clause == nullptr || in.clause->values.empty())
    fail(program, Message("G0312", "`region` needs `in PANEL`", statement.keyword.span)
                      .help("write `region NAME in PANEL: SHAPE`"));
  const std::vector<PanelPart> panels = panels_of(program, in);
  design::Region region;
  region.name = declaration.name;
  region.origin = program.origin(statement.span);
  for (const PanelPart& on : panels)
    region.parts.push_back({on.panel, read_region_shape(program, statement, scope, on, panels)});
  take_factors(program, declaration, region.factors);
  check_empty(program, declaration, region, panels, in);
  program.garment.regions[static_cast<std::size_t>(declaration.index)] = std::move(region);
  return Value{ThingValue{"region", &declaration, declaration.index}};
}

int eval_region(Program& program, const Expr& expr, Scope& scope, const std::string& what) {
  const Value value = eval(program, expr, scope);
  const auto* thing = value.as<ThingValue>();
  if (thing != nullptr && thing->keyword == "region") return thing->index;
  fail(program, Message("G0306", kind_of(value) + " where " + what + " takes a region", expr.span)
                    .help("shapes are `within D of EDGE`, `above P`, `below P`, `left of LINE`, `right of LINE`, `circle(C, R)`, `polygon(P, Q, R)` and regions"));
}

int eval_region_on(Program& program, const Expr& expr, Scope& scope, int panel, const std::string& what) {
  const int index = eval_region(program, expr, scope, what);
  const design::Region& region = program.garment.regions[static_cast<std::size_t>(index)];
  for (const design::RegionPart& part : region.parts)
    if (part.panel == panel) return index;
  const std::string& name = program.panels[static_cast<std::size_t>(panel)].panel.name;
  fail(program,
       Message("G1104", "region `" + region.name + "` lies on other panels than `" + name + "`", expr.span)
           .also(program.origins[region.origin.value], "declared here")
           .help("name `" + name + "` in the region, or take another region"));
}

void run_starch(Program& program, const Item& item) {
  const Statement& statement = *item.statement;
  Scope& scope = *item.scope;
  Clauses clauses(program, statement, scope);
  const char* const form = "write `starch REGION factor 3`";
  if (statement.operands.empty())
    fail(program, Message("G0312", "`starch` takes one region", statement.keyword.span).help(form));
  if (statement.operands.size() > 1)
    fail(program,
         Message("G0313", "`" + std::string(program.sources.text(statement.operands[1].span)) + "` means nothing before `factor`",
                 statement.operands[1].span)
             .help(form));
  design::Starch starch;
  starch.origin = program.origin(statement.span);
  starch.region = eval_region(program, statement.operands[0], scope, "`starch`");
  const auto factor = clauses.quantity("factor");
  if (!factor) clauses.need("factor");
  starch.factor = *factor;
  clauses.finish();
  for (const design::Starch& other : program.garment.starches)
    if (other.region == starch.region)
      fail(program, Message("G0314", "the region is starched twice", statement.operands[0].span)
                        .also(program.origins[other.origin.value], "first here"));
  program.garment.starches.push_back(starch);
}

}  // namespace garment::interpreter
