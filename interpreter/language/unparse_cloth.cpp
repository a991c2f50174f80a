#include "interpreter/language/unparse_cloth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "interpreter/language/unparse_region.hpp"
#include "interpreter/language/unparse_seam.hpp"
#include "runtime/base/number.hpp"
#include "runtime/base/portable_math.hpp"

namespace garment::interpreter::text {
namespace {

const char* side(design::Facing facing) { return facing == design::Facing::face ? "face" : "back"; }
std::string percent(double share) { return number(std::round(share * 1e12) / 1e10) + "%"; }
std::string degrees(double radians) { return angle_deg(radians * (180 / portable::kPi)); }
std::string grams(double mass) { return number(1e3 * mass) + " g"; }

class ClothWriter {
 public:
  ClothWriter(const design::Garment& garment, const Names& names) : garment_(garment), names_(names) {
    for (const auto* list :
         {&names.fabrics, &names.bodies, &names.panels, &names.seams, &names.pins, &names.undeclared_bodies})
      taken_.insert(list->begin(), list->end());
  }

  std::vector<std::string> write() {
    for (const design::Hem& hem : garment_.hems)
      line("hem {} on {} turn {} to {}", fresh(hem.name, "hem"), chain(hem.parts), length(hem.turn),
           side(hem.to));
    for (const design::Zip& zip : garment_.zips) write_zip(zip);
    for (const design::Button& button : garment_.buttons) write_button(button);
    for (std::size_t r = 0; r < garment_.regions.size(); ++r) write_region(garment_.regions[r]);
    for (const design::Tack& tack : garment_.tacks)
      line("tack {}: {} to {} {}", fresh(tack.name, "tack"), panel(tack.panel[0]), panel(tack.panel[1]),
           tack.line.empty() ? "in " + region(tack.region) : "along " + chain(tack.line));
    for (const design::Layer& layer : garment_.layers) layers_.push_back(fresh(layer.name, "layer"));
    for (std::size_t k = 0; k < garment_.layers.size(); ++k) write_layer(k);
    for (const design::Pad& pad : garment_.pads) write_pad(pad);
    for (const design::Press& press : garment_.presses) write_press(press);
    for (const design::Starch& starch : garment_.starches)
      line("starch {} factor {}", region(starch.region), number(starch.factor));
    return std::move(lines_);
  }

 private:
  template <class... Args>
  void line(fmt::format_string<Args...> form, Args&&... args) {
    lines_.push_back(fmt::format(form, std::forward<Args>(args)...));
  }
  std::string fresh(const std::string& name, const char* fallback) {
    return fresh_name(name, fallback, taken_);
  }
  const std::string& panel(int index) const { return names_.panels[static_cast<std::size_t>(index)]; }
  const std::string& region(int index) const { return regions_[static_cast<std::size_t>(index)]; }

  std::string chain(const std::vector<design::EdgePart>& parts) const {
    std::string out;
    for (const design::EdgePart& part : parts)
      out += (out.empty() ? "" : " + ") + std::string(part.from > part.to ? "-" : "") +
             edge_part(garment_, names_, part);
    return out;
  }

  bool with_loop(const design::EdgePart& part) const {
    double area = 0;
    for (const design::Edge& edge : garment_.panels[static_cast<std::size_t>(part.panel)].edges)
      area += edge.curve.area_term();
    return (part.to >= part.from) == (area > 0);
  }

  void write_zip(const design::Zip& zip) {
    // The rule runs the second side against the first; what runs with it was reversed.
    std::vector<design::EdgePart> second = zip.sides[1];
    const bool same_way = with_loop(zip.sides[0].front()) == with_loop(second.front());
    line("zip {}: {} to {}{}{}", fresh(zip.name, "zip"), chain(zip.sides[0]), chain(second),
         same_way ? " reversed" : "", zip.open > 0 ? " open " + percent(zip.open) : "");
  }

  void write_button(const design::Button& button) {
    static const char* const kinds[] = {"sew_through", "hook", "snap"};
    std::string out = fmt::format("button {} on {} at {}", fresh(button.name, "button"), panel(button.panel),
                                  point(button.point));
    for (const design::ButtonHole& hole : button.holes)
      out += fmt::format(" through {} at {}", panel(hole.panel), point(hole.point));
    lines_.push_back(out + fmt::format(" mass {} diameter {} shank {} kind {}", grams(button.mass),
                                       length(button.diameter), length(button.shank),
                                       kinds[static_cast<std::size_t>(button.kind)]));
  }

  void write_region(const design::Region& r) {
    regions_.push_back(fresh(r.name, "region"));
    const std::string& name = regions_.back();
    std::string panels, shape;
    for (const design::RegionPart& part : r.parts) {
      const auto p = static_cast<std::size_t>(part.panel);
      panels += (panels.empty() ? "" : ", ") + names_.panels[p];
      std::string own = region_shape(garment_, names_, p, part.shape);
      if (r.parts.size() > 1) own = fmt::format("({})", bound(part.shape) ? own : bind(p, own));
      shape += (shape.empty() ? "" : " or ") + own;
    }
    line("region {} in {}: {}", name, panels, shape);
    write_factors(name, r.factors);
  }

  /// True where the shape speaks of an edge of its panel throughout: it holds on no other panel.
  static bool bound(const design::RegionShape& shape) {
    using Kind = design::RegionShape::Kind;
    const auto& children = shape.children;
    if (shape.kind == Kind::all_of) return std::any_of(children.begin(), children.end(), bound);
    if (shape.kind == Kind::any_of) return std::all_of(children.begin(), children.end(), bound);
    if (shape.kind == Kind::minus) return bound(children[0]);
    return !shape.parts.empty();
  }

  /// One shape holds for all panels of a statement; this keeps it to one of them.
  std::string bind(std::size_t panel, const std::string& shape) const {
    return fmt::format("(within(5000 cm, {}.{})) and ({})", names_.panels[panel], names_.edges[panel][0],
                       shape);
  }

  void write_factors(const std::string& name, const design::RegionFactors& f) {
    auto factor = [&](const char* word, double value) {
      if (value != 1) line("{}.{} = {}", name, word, format_number(value));
    };
    factor("stretch_warp", f.stretch_warp);
    factor("stretch_weft", f.stretch_weft);
    factor("shear", f.shear);
    factor("bend_warp", f.bend_warp);
    factor("bend_weft", f.bend_weft);
    factor("twist", f.twist);
    factor("mass", f.mass);
    factor("friction", f.friction);
    factor("damping", f.damping);
    factor("thickness", f.thickness);
  }

  void write_layer(std::size_t k) {
    const design::Layer& layer = garment_.layers[k];
    line("layer {} of {} on {}{} {} grain {} side {}{}", layers_[k],
         names_.fabrics[static_cast<std::size_t>(layer.fabric)], panel(layer.panel),
         layer.region < 0 ? "" : " in " + region(layer.region), layer.fused ? "fused" : "basted",
         degrees(layer.grain_angle + portable::kPi / 2), side(layer.side),
         layer.above < 0 ? "" : " above " + layers_[static_cast<std::size_t>(layer.above)]);
  }

  void write_pad(const design::Pad& pad) {
    std::string where = pad.region >= 0
                            ? "in " + region(pad.region)
                            : fmt::format("at {} radius {}", point(pad.centre), length(pad.radius));
    std::string profile;
    for (double t : pad.thickness) profile += (profile.empty() ? "" : ", ") + length(t);
    line("pad {} on {} {} thickness {} side {}", fresh(pad.name, "pad"), panel(pad.panel), where, profile,
         side(pad.side));
  }

  void write_press(const design::Press& press) {
    using Kind = design::Press::Kind;
    std::string what;
    if (press.kind == Kind::fold) {
      what = fmt::format("along {} fold {} to {}", chain(press.line), degrees(press.angle), side(press.to));
      if (press.radius > 0) what += " radius " + length(press.radius);
      what += " set " + percent(press.set);
    } else {
      what = "in " + region(press.region);
      if (press.kind == Kind::flat) what += " flat";
      if (press.kind == Kind::curl)
        what += fmt::format(" curl radius {} about {} to {}", length(press.radius), chain(press.line),
                            side(press.to));
      if (press.kind == Kind::shrink || press.kind == Kind::extend)
        what += fmt::format(" {} warp {} weft {}", press.kind == Kind::shrink ? "shrink" : "extend",
                            percent(press.warp), percent(press.weft));
    }
    if (press.factor != 1) what += " factor " + number(press.factor);
    line("iron {} {}", fresh(press.name, "iron"), what);
  }

  const design::Garment& garment_;
  const Names& names_;
  std::set<std::string> taken_;
  std::vector<std::string> lines_, regions_, layers_;
};

}  // namespace

std::vector<std::string> cloth_statements(const design::Garment& garment, const Names& names) {
  return ClothWriter(garment, names).write();
}

std::string stacking_clauses(const design::Garment& garment, const Names& names, std::size_t index) {
  std::string under, over;
  for (const design::Stacking& s : garment.stackings) {
    if (s.panel != static_cast<int>(index)) continue;
    std::string& list = s.over ? over : under;
    list += (list.empty() ? (s.over ? " over " : " under ") : ", ") +
            names.panels[static_cast<std::size_t>(s.other)];
  }
  return under + over;
}

std::string finish_clauses(const design::Garment& garment, const Names& names, const design::Seam& seam) {
  const design::SeamFinish& f = seam.finish;
  std::string out;
  if (f.turned) out += " turned";
  if (f.lap != 0) out += " lapped " + length(f.lap);
  if (f.fold_angle) out += fmt::format(" fold {} to {}", degrees(*f.fold_angle), side(f.fold_to));
  if (f.ironed == design::SeamFinish::Ironed::open) out += " ironed open";
  if (f.ironed == design::SeamFinish::Ironed::toward) {
    const design::EdgePart& part = seam.sides[static_cast<std::size_t>(f.ironed_toward)].parts.front();
    out += " ironed toward " + edge_part(garment, names, part);
  }
  if (f.tension != 0) out += fmt::format(" tension {}", percent(f.tension));
  if (f.slack != 0) out += " slack " + length(f.slack);
  if (f.stiffness != 1) out += " stiffness " + number(f.stiffness);
  if (f.allowance) out += " allowance " + length(*f.allowance);
  return out;
}

}  // namespace garment::interpreter::text
