#include "interpreter/language/unparse_region.hpp"

#include <fmt/format.h>

#include <cmath>

#include "interpreter/language/unparse_seam.hpp"

namespace garment::interpreter::text {
namespace {

using design::EdgePart;
using design::Panel;
using design::Point2;
using design::RegionShape;
using RegionKind = RegionShape::Kind;

constexpr double kHalfPlane = 50;  // m: half planes are written as polygons of this reach

/// The part of the panel's mirror image of an edge; the part itself where there is none.
EdgePart mirrored(const Panel& panel, const EdgePart& part) {
  const geometry::Curve& curve = design::edge_of(panel, part).curve;
  auto image = [&](const Point2& p) { return Point2(2 * *panel.fold_x - p.x(), p.y()); };
  const auto& list = part.on == EdgePart::On::line   ? panel.lines
                     : part.on == EdgePart::On::hole ? panel.hole_edges
                                                     : panel.edges;
  for (std::size_t k = 0; k < list.size(); ++k) {
    const geometry::Curve& other = list[k].curve;
    const double length = other.length();
    if (std::fabs(length - curve.length()) > 1e-6) continue;
    EdgePart result = part;
    result.edge = static_cast<int>(k);
    if ((other.start() - image(curve.end())).norm() < 1e-6 &&
        (other.end() - image(curve.start())).norm() < 1e-6) {
      result.from = length - part.from;
      result.to = length - part.to;
      return result;
    }
    if ((other.start() - image(curve.start())).norm() < 1e-6 &&
        (other.end() - image(curve.end())).norm() < 1e-6)
      return result;
  }
  return part;
}

RegionShape mirrored(const Panel& panel, RegionShape leaf) {
  for (Point2& p : leaf.points) p.x() = 2 * *panel.fold_x - p.x();
  for (EdgePart& part : leaf.parts) part = mirrored(panel, part);
  if (leaf.kind == RegionKind::left_of)
    leaf.kind = RegionKind::right_of;
  else if (leaf.kind == RegionKind::right_of)
    leaf.kind = RegionKind::left_of;
  return leaf;
}

RegionShape half_plane(double x, int sign) {
  RegionShape shape;
  shape.kind = RegionKind::beyond;
  shape.size = x;
  shape.sign = sign;
  return shape;
}

class RegionWriter {
 public:
  RegionWriter(const design::Garment& garment, const Names& names, std::size_t panel)
      : garment_(garment), names_(names), panel_(garment.panels[panel]) {}

  std::string write(const RegionShape& shape) const {
    switch (shape.kind) {
      case RegionKind::all_of:
        return joined(shape, " and ");
      case RegionKind::any_of:
        return joined(shape, " or ");
      case RegionKind::minus:
        return joined(shape, " minus ");
      case RegionKind::opposite:
        return "not (" + write(shape.children[0]) + ")";
      default:
        return halves(shape);
    }
  }

 private:
  std::string joined(const RegionShape& shape, const char* word) const {
    std::string out;
    for (const RegionShape& child : shape.children)
      out += (out.empty() ? "" : word) + ("(" + write(child) + ")");
    return out;
  }

  /// A shape of the drawn half holds there, and its image on the other side.
  std::string halves(const RegionShape& leaf) const {
    const bool same = leaf.kind == RegionKind::above || leaf.kind == RegionKind::below || leaf.kind == RegionKind::everywhere;
    if (leaf.drawn_side == 0 || !panel_.fold_x || same) return plain(leaf);
    return fmt::format("(({}) and ({})) or (({}) and ({}))", plain(leaf),
                       plain(half_plane(*panel_.fold_x, leaf.drawn_side)), plain(mirrored(panel_, leaf)),
                       plain(half_plane(*panel_.fold_x, -leaf.drawn_side)));
  }

  std::string edges(const RegionShape& leaf, const std::string& before) const {
    std::string out;
    for (const EdgePart& part : leaf.parts)
      out += (out.empty() ? "" : " or ") + before + (part.from > part.to ? "-" : "") +
             edge_part(garment_, names_, part) + ")";
    return leaf.parts.size() > 1 ? "(" + out + ")" : out;
  }

  std::string chain(const RegionShape& leaf) const {
    std::string out;
    for (const EdgePart& part : leaf.parts)
      out += (out.empty() ? "" : " + ") + std::string(part.from > part.to ? "-" : "") +
             edge_part(garment_, names_, part);
    return out;
  }

  std::string plain(const RegionShape& leaf) const {
    switch (leaf.kind) {
      case RegionKind::everywhere:
        return fmt::format("above({})", length(-kHalfPlane));
      case RegionKind::nowhere:
        return fmt::format("above({})", length(kHalfPlane));
      case RegionKind::polygon: {
        std::string out;
        for (const Point2& p : leaf.points) out += (out.empty() ? "" : ", ") + point(p);
        return "polygon(" + out + ")";
      }
      case RegionKind::circle:
        return fmt::format("circle({}, {})", point(leaf.points[0]), length(leaf.size));
      case RegionKind::near:
        if (leaf.parts.empty())
          return fmt::format("within({}, {})", length(leaf.size), point(leaf.points[0]));
        return edges(leaf, fmt::format("within({}, ", length(leaf.size)));
      case RegionKind::above:
        return fmt::format("above({})", length(leaf.size));
      case RegionKind::below:
        return fmt::format("below({})", length(leaf.size));
      case RegionKind::left_of:
        return "left_of(" + chain(leaf) + ")";
      case RegionKind::right_of:
        return "right_of(" + chain(leaf) + ")";
      default: {
        const double far = leaf.size + leaf.sign * kHalfPlane;
        return fmt::format("polygon({}, {}, {}, {})", point(Point2(leaf.size, -kHalfPlane)),
                           point(Point2(far, -kHalfPlane)), point(Point2(far, kHalfPlane)),
                           point(Point2(leaf.size, kHalfPlane)));
      }
    }
  }

  const design::Garment& garment_;
  const Names& names_;
  const Panel& panel_;
};

}  // namespace

std::string region_shape(const design::Garment& garment, const Names& names, std::size_t panel,
                         const design::RegionShape& shape) {
  return RegionWriter(garment, names, panel).write(shape);
}

}  // namespace garment::interpreter::text
