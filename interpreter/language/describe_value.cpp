// Values as answers to a person at the prompt.
#include <algorithm>

#include "interpreter/language/ask.hpp"
#include "interpreter/language/edges.hpp"
#include "interpreter/language/word_lists.hpp"

namespace garment::interpreter {
namespace {

constexpr int kDigits = 7;
constexpr double kSameLength = 1e-7;  // m

std::string length_text(double metres) { return format_quantity(metres, kLength, false, kDigits); }

std::string describe_edge(const Program& program, const Value& value, const DrapeMeasures* drape) {
  const EdgeValue& edge = *value.as<EdgeValue>();
  const double sewn = sewn_length(program, edge), cut = cut_length(edge);
  std::string text = show(value) + ": " + length_text(sewn);
  if (cut - sewn > kSameLength) text += " sewn, " + length_text(cut) + " as cut";
  if (drape == nullptr) return text;
  std::vector<design::EdgePart> parts;
  for (const EdgeSpan& span : edge.spans) parts.insert(parts.end(), span.parts.begin(), span.parts.end());
  if (const auto draped = drape->length(parts))
    text += ", " + format_quantity(*draped, kLength, false, 4) + " in the drape";
  return text;
}

std::string describe_panel(const Program& program, int index) {
  const PanelInfo& info = program.panels[static_cast<std::size_t>(index)];
  std::string text =
      "panel " + info.panel.name + ": " + format_quantity(cloth_area(info), kArea, false, kDigits);
  const std::size_t fabric = static_cast<std::size_t>(info.panel.fabric);
  if (fabric < program.garment.fabrics.size()) text += " of " + program.garment.fabrics[fabric].name;
  text += "; edges " + listed(edge_names(info));
  std::vector<std::string> darts, notches;
  for (const design::EdgeDart& dart : info.panel.darts) darts.push_back(dart.name);
  for (const design::Notch& notch : info.panel.notches) notches.push_back(notch.name);
  if (!darts.empty()) text += "; darts " + listed(darts);
  if (!notches.empty()) text += "; notches " + listed(notches);
  return text;
}

std::string describe_dart(const Program& program, const DartValue& dart) {
  const PanelInfo& info = program.panels[static_cast<std::size_t>(dart.panel)];
  for (const design::EdgeDart& d : info.panel.darts) {
    if (d.name != dart.name) continue;
    std::string text =
        "dart " + info.panel.name + '.' + d.name + " on " + d.edge + ": width " + length_text(d.width);
    if (!d.apex) text += ", depth " + length_text(d.depth);
    return text;
  }
  return "dart " + dart.name;
}

std::string describe_notch(const Program& program, const NotchValue& notch) {
  const PanelInfo& info = program.panels[static_cast<std::size_t>(notch.panel)];
  for (const design::Notch& n : info.panel.notches)
    if (n.name == notch.name)
      return "notch " + info.panel.name + '.' + n.name + ": " + length_text(n.at) + " along " + n.edge;
  return "notch " + notch.name;
}

std::string describe_seam(const Program& program, int index) {
  const SeamInfo& info = program.seams[static_cast<std::size_t>(index)];
  std::string text = "seam " + info.seam.name + ": ";
  for (std::size_t k = 0; k < info.sides.size(); ++k)
    text += (k > 0 ? " to " : "") + show(Value{info.sides[k]}) + " (" +
            length_text(sewn_length(program, info.sides[k])) + ")";
  return text;
}

std::string describe_fabric(const design::Fabric& f) {
  std::string text = "fabric " + f.name + ": " + format_quantity(f.areal_density, kArealDensity) + ", " +
                     format_quantity(f.thickness, kLength) + " thick, bending " +
                     format_quantity(f.bending_rigidity[0], kMoment) + " warp " +
                     format_quantity(f.bending_rigidity[1], kMoment) + " weft";
  if (!f.kind.empty()) text += "; " + f.kind;
  if (!f.source.empty()) text += ": " + f.source;
  return text;
}

std::string describe_body(const Program& program, int index) {
  const std::size_t k = static_cast<std::size_t>(index);
  std::string text = "body " + program.garment.bodies[k].name;
  const auto& built = program.built[k];
  if (built == nullptr) return text;
  std::vector<std::string> levels, parts;
  for (const auto& [name, level] : built->levels) levels.push_back(name);
  for (const auto& [name, part] : built->parts) parts.push_back(name);
  if (!levels.empty()) text += "; levels " + listed(levels);
  if (!parts.empty()) text += "; parts " + listed(parts);
  return text;
}

std::string describe_place(const Program& program, const BodyPlaceValue& place) {
  const std::size_t k = static_cast<std::size_t>(place.body);
  const std::string name = program.garment.bodies[k].name + '.' + place.path;
  const auto& built = program.built[k];
  if (built != nullptr)
    if (const auto level = built->levels.find(place.path); level != built->levels.end())
      return "level " + name + ": height " + length_text(level->second.height) + ", girth " +
             length_text(level->second.girth);
  return "part " + name;
}

std::string thing_name(const ThingValue& thing) {
  return std::string(thing.keyword) + (thing.declaration != nullptr ? ' ' + thing.declaration->name : "");
}

}  // namespace

std::string describe_value(const Interpretation& interpretation, const Value& value,
                           const DrapeMeasures* drape) {
  const Program& program = *interpretation.program;
  if (const auto* q = value.as<Quantity>())
    return format_quantity(q->value, q->dimension, q->percent, kDigits);
  if (value.as<std::string>() != nullptr) return '"' + show(value) + '"';
  if (value.as<EdgeValue>() != nullptr) return describe_edge(program, value, drape);
  if (const auto* panel = value.as<PanelValue>()) return describe_panel(program, panel->panel);
  if (const auto* half = value.as<HalfValue>())
    return half->half + " half of " + describe_panel(program, half->panel);
  if (const auto* dart = value.as<DartValue>()) return describe_dart(program, *dart);
  if (const auto* notch = value.as<NotchValue>()) return describe_notch(program, *notch);
  if (const auto* seam = value.as<SeamValue>()) return describe_seam(program, seam->seam);
  if (const auto* fabric = value.as<FabricValue>()) return describe_fabric(*fabric->fabric);
  if (const auto* body = value.as<BodyValue>()) return describe_body(program, body->body);
  if (const auto* place = value.as<BodyPlaceValue>()) return describe_place(program, *place);
  if (const auto* thing = value.as<ThingValue>()) return thing_name(*thing);
  return show(value);
}

}  // namespace garment::interpreter
