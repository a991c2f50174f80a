#include "interpreter/service/members.hpp"

#include <algorithm>
#include <set>

#include "interpreter/language/edges.hpp"
#include "interpreter/language/evaluate.hpp"
#include "interpreter/language/fabrics.hpp"

namespace garment::service {
namespace {

using namespace interpreter;

std::string cm(double metres) { return format_quantity(metres, kLength); }

std::string edge_detail(const Program& program, const EdgeValue& edge) {
  const double sewn = sewn_length(program, edge), cut = cut_length(edge);
  return cm(sewn) + (std::abs(sewn - cut) > 1e-6 ? " sewn, " + cm(cut) + " cut" : "");
}

EdgeValue value_of(const Program& program, int panel, const NamedEdge& edge) {
  EdgeSpan span;
  span.panel = panel;
  span.name = program.panels[static_cast<std::size_t>(panel)].panel.name + '.' + edge.name;
  span.parts = edge.parts;
  return EdgeValue{{span}};
}

/// The name in its half: "left.waist_dart" is `waist_dart` of `left`; nothing if it belongs to the other
/// half.
std::optional<std::string> in_half(const std::string& name, const std::string& half, bool folded) {
  if (!folded) return name;
  if (!half.empty())
    return name.rfind(half + '.', 0) == 0 ? std::optional<std::string>(name.substr(half.size() + 1))
                                          : std::nullopt;
  if (name.rfind("left.", 0) == 0) return name.substr(5);
  return name.rfind("right.", 0) == 0 ? std::nullopt : std::optional<std::string>(name);
}

void add(std::vector<Member>& out, std::string name, std::string kind, std::string detail,
         std::string doc = {}) {
  for (const Member& member : out)
    if (member.name == name) return;
  out.push_back({std::move(name), std::move(kind), std::move(detail), std::move(doc)});
}

std::vector<Member> panel_members(const Program& program, int panel, const std::string& half,
                                  bool own_block) {
  const PanelInfo& info = program.panels[static_cast<std::size_t>(panel)];
  std::vector<Member> out;
  for (const NamedEdge& edge : info.edges)
    if (edge.half == half || own_block)
      add(out, edge.name, "edge", edge_detail(program, value_of(program, panel, edge)));
  for (const design::EdgeDart& dart : info.panel.darts)
    if (const auto name = in_half(dart.name, half, info.folded))
      add(out, *name, "dart", cm(dart.width) + " wide");
  for (const design::Notch& notch : info.panel.notches)
    if (const auto name = in_half(notch.name, half, info.folded))
      add(out, *name, "notch", "on " + notch.edge);
  for (const design::Edge& line : info.panel.lines)
    if (const auto name = in_half(line.name, half, info.folded))
      add(out, *name, "line", cm(line.curve.length()));
  for (const design::InteriorPoint& point : info.panel.points)
    if (const auto name = in_half(point.name, half, info.folded))
      add(out, *name, "point", '(' + cm(point.point.x()) + ", " + cm(point.point.y()) + ')');
  if (!half.empty() || own_block) return out;
  if (info.folded) {
    add(out, "left", "half", "the wearer's left half");
    add(out, "right", "half", "the wearer's right half");
  }
  add(out, "resolution", "length", cm(info.panel.resolution));
  return out;
}

std::vector<Member> edge_members(const Program& program, const EdgeValue& edge) {
  std::vector<Member> out;
  if (edge.spans.size() != 1) return out;
  const EdgeSpan& span = edge.spans.front();
  add(out, "start", "point", "", "where it begins, as drawn");
  add(out, "end", "point", "", "where it ends, as drawn");
  add(out, "middle", "point", "", "halfway along it");
  add(out, "at", "function", "at(POSITION)", "the point that far along it");
  for (const design::Notch& notch : program.panels[static_cast<std::size_t>(span.panel)].panel.notches)
    if (const auto at = notch_position(program, span, notch.name)) {
      const std::size_t dot = notch.name.find('.');  // after the half
      add(out, notch.name.substr(dot == std::string::npos ? 0 : dot + 1), "notch", "at " + cm(*at));
    }
  return out;
}

/// What a script may ask of a body, without its surface where it is a mannequin.
body::Frame frame_of(Program& program, int index) {
  const std::size_t k = static_cast<std::size_t>(index);
  if (const auto known = program.frames.find(index); known != program.frames.end()) return known->second;
  if (body::FrameResult made = body::make_frame(program.garment.bodies[k]); made.frame) return *made.frame;
  body::Frame frame;
  if (program.built[k] == nullptr) return frame;
  for (const auto& [name, level] : program.built[k]->levels) frame.levels[name] = {level.height, level.girth};
  for (const auto& [name, part] : program.built[k]->parts) frame.parts.push_back(name);
  return frame;
}

std::string level_detail(const body::FrameLevel& level) {
  std::string text = level.height ? cm(*level.height) + " high" : "";
  if (level.girth) text += (text.empty() ? "" : ", ") + cm(*level.girth) + " round";
  return text;
}

std::vector<Member> body_members(Program& program, int index, const std::string& path) {
  std::vector<Member> out;
  const body::Frame frame = frame_of(program, index);
  if (!path.empty()) {
    if (const auto level = frame.levels.find(path); level != frame.levels.end()) {
      add(out, "girth", "length", level->second.girth ? cm(*level->second.girth) : "",
          "round the body at this level");
      add(out, "height", "length", level->second.height ? cm(*level->second.height) : "", "above the floor");
    }
    for (const std::string& name : frame.parts)
      if (name.rfind(path + '.', 0) == 0) add(out, name.substr(path.size() + 1), "part", "");
    return out;
  }
  for (const auto& [name, level] : frame.levels) add(out, name, "level", level_detail(level));
  if (std::find(frame.parts.begin(), frame.parts.end(), "torso") != frame.parts.end())
    for (const char* side : {"front", "back", "left", "right"}) add(out, side, "part", "side of the torso");
  for (const std::string& name : frame.parts) add(out, name.substr(0, name.find('.')), "part", "");
  for (const auto& [name, length] : frame.lengths) add(out, name, "length", cm(length));
  return out;
}

/// What is declared in a part's component, its ports first.
std::vector<Member> part_members(Program& program, const ThingValue& part) {
  std::vector<Member> out;
  if (part.keyword != "part" || part.index < 0 ||
      static_cast<std::size_t>(part.index) >= program.parts.size())
    return out;
  const Scope* scope = program.parts[static_cast<std::size_t>(part.index)].scope;
  if (scope == nullptr) return out;
  for (const bool ports : {true, false})
    for (const auto& [name, declaration] : scope->declared) {
      if (declaration->statement == nullptr) continue;
      const std::string& keyword = declaration->statement->keyword.text;
      if ((keyword == "port") != ports) continue;
      const bool done = declaration->state == Declaration::State::done;
      add(out, name.substr(name.rfind('.') + 1), keyword,
          done ? describe_value(program, declaration->value) : keyword, declaration->statement->doc);
    }
  return out;
}

std::vector<Member> module_members(Program& program, const Module& module) {
  std::vector<Member> out;
  for (const auto& [name, declaration] : module.scope->declared) {
    if (declaration->statement == nullptr) continue;
    const Statement& statement = *declaration->statement;
    std::string detail;
    if (statement.keyword.text == "fn" && !statement.operands.empty())
      detail = "fn " + std::string(program.sources.text(statement.operands[0].span));
    if (detail.size() > 80) detail = "fn " + name + "(...)";
    add(out, name, statement.keyword.text, detail, statement.doc);
  }
  return out;
}

}  // namespace

std::vector<Member> panel_items(const Program& program, int panel) {
  return panel_members(program, panel, "", true);
}

std::vector<Member> members_of(Program& program, const Value& value) {
  std::vector<Member> out;
  if (const auto* v = value.as<ModuleValue>()) return module_members(program, *v->module);
  if (const auto* v = value.as<PanelValue>()) return panel_members(program, v->panel, "", false);
  if (const auto* v = value.as<HalfValue>()) return panel_members(program, v->panel, v->half, false);
  if (const auto* v = value.as<EdgeValue>()) return edge_members(program, *v);
  if (const auto* v = value.as<ThingValue>()) return part_members(program, *v);
  if (const auto* v = value.as<BodyValue>()) return body_members(program, v->body, "");
  if (const auto* v = value.as<BodyPlaceValue>()) return body_members(program, v->body, v->path);
  if (value.as<DartValue>() != nullptr)
    for (const char* name : {"width", "depth", "at"}) add(out, name, "length", "");
  if (const auto* v = value.as<PointValue>())
    for (int k = 0; k < v->size; ++k)
      add(out, std::string(1, "xyz"[k]), "number",
          format_quantity(v->at[static_cast<std::size_t>(k)], v->dimension));
  if (const auto* v = value.as<RecordValue>())
    for (const auto& [name, field] : **v) add(out, name, "field", show(field));
  if (const auto* v = value.as<FabricValue>())
    for (const std::string& name : fabric_field_names())
      if (const auto field = fabric_field(*v->fabric, name)) add(out, name, "field", show(*field));
  if (value.as<DrapedValue>() != nullptr) {
    add(out, "length", "function", "draped.length(EDGE)", "length after the drape");
    add(out, "area", "function", "draped.area(PANEL | all)", "area after the drape");
  }
  return out;
}

std::string describe_value(Program& program, const Value& value) {
  const std::string kind = kind_of(value);
  if (const auto* v = value.as<EdgeValue>()) return kind + ", " + edge_detail(program, *v);
  if (const auto* v = value.as<PanelValue>())
    return kind + ", " +
           format_quantity(cloth_area(program.panels[static_cast<std::size_t>(v->panel)]), kArea);
  if (const auto* v = value.as<FabricValue>())
    return kind + (v->fabric->kind.empty() ? "" : ", " + v->fabric->kind);
  if (value.as<FunctionValue>() != nullptr || value.as<ModuleValue>() != nullptr) return kind;
  const std::string shown = show(value);
  return shown.empty() || shown == kind || kind.ends_with(shown) ? kind : kind + ", " + shown;
}

std::optional<Value> quiet_value(Program& program, const Expr& expr, Scope& scope) {
  grammar::Diagnostics kept = std::move(program.diagnostics);
  const bool had_error = program.has_error;
  const std::size_t steps = program.steps, n_calls = program.calls.size(), n_running = program.running.size();
  program.diagnostics.clear();
  std::optional<Value> value;
  try {
    value = eval(program, expr, scope);
  } catch (const Stop&) {
  } catch (const Exhausted&) {
  }
  program.diagnostics = std::move(kept);
  program.has_error = had_error;
  program.steps = steps;
  program.calls.resize(n_calls);
  program.running.resize(n_running);
  return value;
}

std::optional<Value> quiet_value(Program& program, std::string_view text) {
  if (program.main == nullptr || program.main->scope == nullptr) return std::nullopt;
  grammar::Sources sources;
  const grammar::SourceId id = sources.add("<expression>", std::string(text));
  const grammar::ExpressionResult parsed = grammar::parse_expression(sources, id, vocabulary());
  if (!parsed.diagnostics.empty()) return std::nullopt;
  return quiet_value(program, parsed.expr, *program.main->scope);
}

}  // namespace garment::service
