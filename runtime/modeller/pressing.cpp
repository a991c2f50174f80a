#include "runtime/modeller/pressing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "runtime/base/portable_math.hpp"
#include "runtime/modeller/folding.hpp"

namespace garment::modeller {
namespace {

using design::Point2;
using design::Press;
using geometry::cross;
using model::Index;

constexpr double kLeastTwist = 1e-6;       // 1/m; curls along the threads leave none
constexpr double kSharp = 1e-6;            // m, shorter folds lie in one cell

/// The thread of a bending stencil: its middle, its direction, and the length that it answers for.
struct Thread {
  int panel;
  Point2 at, along;
  double length;
};

/// A cell: its panel, its middle, its threads.
struct Spot {
  int panel;
  Point2 at, weft, warp;
};

/// One press as its panels see it.
class Pressed {
 public:
  Pressed(const design::Garment& garment, const std::vector<BorderPanel>& outlines, const Press& press) : press_(press) {
    for (const design::EdgePart& part : press.line) {
      if (press.kind == Press::Kind::fold && part.on != design::EdgePart::On::line) continue;
      const design::Panel& panel = garment.panels[part.panel];
      lines_.push_back({part.panel, design::polyline_of(panel, part), follows_fold(press, panel, part, outlines[part.panel].h)});
    }
    if (press.region < 0) return;
    for (const design::RegionPart& part : garment.regions[press.region].parts)
      regions_.emplace_back(part.panel, design::RegionTest(garment.panels[part.panel], part.shape));
  }

  /// Changes the thread's rest fold; true where it did.
  bool apply(const Thread& thread, double& angle) const {
    const double before = angle;
    if (press_.kind == Press::Kind::fold) angle += folded(thread);
    if (press_.kind == Press::Kind::curl && holds(thread.panel, thread.at)) {
      const double sine = cross(thread.along, way_at(thread.panel, thread.at));
      angle += curl() * thread.length * sine * sine;
    }
    if (press_.kind == Press::Kind::flat && holds(thread.panel, thread.at)) angle *= 1 - std::min(1.0, press_.factor);
    return angle != before;
  }

  /// Changes the cell's rest twist, 1/m.
  void apply(const Spot& cell, double& twist) const {
    if (press_.kind == Press::Kind::curl && holds(cell.panel, cell.at)) {
      const Point2 way = way_at(cell.panel, cell.at);
      twist -= curl() * cross(cell.weft, way) * cross(cell.warp, way);  // to the back: against the normal
    }
    if (press_.kind == Press::Kind::flat && holds(cell.panel, cell.at)) twist *= 1 - std::min(1.0, press_.factor);
  }

  /// The panels on which the mesh follows its folds.
  std::vector<int> followed() const {
    std::vector<int> all;
    for (const Line& line : lines_)
      if (line.followed) all.push_back(line.panel);
    return all;
  }

  /// The panels on which it should have done something, each once.
  std::vector<int> panels() const {
    std::vector<int> all;
    if (press_.kind == Press::Kind::fold) {
      for (const Line& line : lines_)
        if (!line.followed) all.push_back(line.panel);
    } else
      for (const auto& region : regions_) all.push_back(region.first);
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }

 private:
  struct Line {
    int panel;
    std::vector<Point2> points;
    bool followed;  // by the mesh: particles lie on it
  };

  double side() const { return press_.to == design::Facing::back ? 1 : -1; }

  bool holds(int panel, const Point2& at) const {
    return std::any_of(regions_.begin(), regions_.end(),
                       [&](const auto& r) { return r.first == panel && r.second.contains(at); });
  }

  /// Curvature of a curl, positive to the back, 1/m.
  double curl() const { return press_.radius > 0 ? side() * press_.set * press_.factor / press_.radius : 0; }

  double folded(const Thread& thread) const {
    const double whole = std::min(kLargestFold, press_.angle * press_.set * press_.factor);
    double sum = 0;
    for (const Line& line : lines_) {
      if (line.panel != thread.panel) continue;
      for (std::size_t k = 0; k + 1 < line.points.size(); ++k) {
        const Point2 way = line.points[k + 1] - line.points[k], off = line.points[k] - thread.at;
        const double size = way.norm(), across = cross(thread.along, way);
        if (!(size > 0) || std::abs(across) < 1e-9 * size) continue;
        const double on_line = cross(off, thread.along) / across, ahead = cross(off, way) / across;
        if (on_line < 0 || on_line >= 1) continue;
        const double sine = std::abs(across) / size;
        const double turn = 2 * portable::asin(std::min(1.0, sine * portable::sin(whole / 2)));
        const double width = line.followed ? 0 : press_.radius * whole / std::max(sine, 0.1);
        sum += turn * share(ahead, width, thread.length);
      }
    }
    return side() * sum;
  }

  /// Of a fold as wide as `width` whose middle lies `ahead` of the thread's, the share that lies in its length.
  static double share(double ahead, double width, double length) {
    if (width < kSharp) return ahead >= -length / 2 && ahead < length / 2 ? 1 : 0;
    const double from = std::max(ahead - width / 2, -length / 2), to = std::min(ahead + width / 2, length / 2);
    return std::max(0.0, to - from) / width;
  }

  /// Unit direction of the nearest place of the lines on the panel; zero without any.
  Point2 way_at(int panel, const Point2& at) const {
    double nearest = std::numeric_limits<double>::infinity();
    Point2 best(0, 0);
    for (const Line& line : lines_) {
      if (line.panel != panel) continue;
      for (std::size_t k = 0; k + 1 < line.points.size(); ++k) {
        const Point2 way = line.points[k + 1] - line.points[k];
        if (!(way.norm() > 0)) continue;
        const double t = std::clamp((at - line.points[k]).dot(way) / way.squaredNorm(), 0.0, 1.0);
        const double distance = (line.points[k] + t * way - at).squaredNorm();
        if (distance >= nearest) continue;
        nearest = distance;
        best = way.normalized();
      }
    }
    return best;
  }

  const Press& press_;
  std::vector<Line> lines_;
  std::vector<std::pair<int, design::RegionTest>> regions_;
};

bool bends(const Press& press) { return press.kind != Press::Kind::shrink && press.kind != Press::Kind::extend; }

/// The threads of the model's bending stencils.
std::vector<Thread> threads_of(const model::Model& model) {
  std::vector<Index> vertex(model.n_particles(), 0);  // grid particles have one each; neighbours may have several
  for (std::size_t v = 0; v < model.n_vertices(); ++v) vertex[model.vertex_particle[v]] = static_cast<Index>(v);
  std::vector<Thread> threads;
  for (std::size_t k = 0; k < model.bend.size(); ++k) {
    const Index v = vertex[model.bend[k][1]];
    threads.push_back({model.vertex_panel[v], model.vertex_uv[v], Point2(0, 0),
                       0.5 * (model.bend_lengths[k][0] + model.bend_lengths[k][1])});
  }
  return threads;
}

/// Rest twists from curls, and what `flat` leaves of them.
void add_twists(const std::vector<MeshedPanel>& panels, const std::vector<Pressed>& presses, model::Model& model) {
  std::size_t c = 0;
  for (std::size_t p = 0; p < panels.size(); ++p) {
    const MeshedPanel& panel = panels[p];
    for (const auto& cell : panel.mesh.cells) {
      const Spot spot{static_cast<int>(p), 0.5 * (panel.mesh.at[cell[0]] + panel.mesh.at[cell[2]]), panel.frame.weft(),
                      panel.frame.warp()};
      double twist = 0;
      for (const Pressed& press : presses) press.apply(spot, twist);
      if (std::abs(twist) > kLeastTwist) {
        model.twist_cell.push_back(static_cast<Index>(c));
        model.twist_rest.push_back(twist);
      }
      ++c;
    }
  }
}

/// Is something sewn to the edge, or is it turned over?
bool has_cloth_beyond(const design::Garment& garment, const design::EdgePart& part) {
  auto meets = [&](const std::vector<design::EdgePart>& parts) {
    return std::any_of(parts.begin(), parts.end(), [&](const design::EdgePart& other) {
      return other.panel == part.panel && other.on == part.on && other.edge == part.edge &&
             std::min(other.from, other.to) < std::max(part.from, part.to) && std::min(part.from, part.to) < std::max(other.from, other.to);
    });
  };
  for (const design::Hem& hem : garment.hems)
    if (meets(hem.parts)) return true;
  for (const design::Seam& seam : garment.seams)
    for (const design::SeamSide& side : seam.sides)
      if (meets(side.parts)) return true;
  for (const design::Zip& zip : garment.zips)
    if (meets(zip.sides[0]) || meets(zip.sides[1])) return true;
  return false;
}

Finding unreached(const Press& press, const MeshedPanel& panel) {
  std::string help = "give the panel a finer resolution, or iron farther from its border";
  if (press.kind == Press::Kind::flat) help = "press flat after the folds that are to go; without a fold the cloth is flat";
  if (press.kind == Press::Kind::curl) help = "the line that the cloth is curled about lies on the same panel";
  return {"G1150",
          Severity::warning,
          fmt::format("iron `{}` changes no thread of panel `{}`", press.name, panel.panel->name),
          {{press.origin, ""}},
          help};
}

}  // namespace

void add_creases(const design::Garment& garment, const std::vector<MeshedPanel>& panels,
                 const std::vector<BorderPanel>& outlines, model::Model& model, Findings& findings) {
  if (std::none_of(garment.presses.begin(), garment.presses.end(), bends)) return;
  std::vector<Thread> threads = threads_of(model);
  std::vector<double> angle(model.bend.size(), 0);
  for (std::size_t k = 0; k < threads.size(); ++k) {
    const GridFrame& frame = panels[threads[k].panel].frame;
    threads[k].along = k % 2 == 0 ? frame.warp() : frame.weft();  // stencils come in pairs
  }
  std::vector<Pressed> presses;
  for (const Press& press : garment.presses) {
    if (!bends(press)) continue;
    const Pressed& pressed = presses.emplace_back(garment, outlines, press);
    std::vector<char> reached(panels.size(), 0);
    for (std::size_t k = 0; k < threads.size(); ++k)
      if (pressed.apply(threads[k], angle[k])) reached[threads[k].panel] = 1;
    for (const Pressed& before : presses)  // what the mesh follows is flattened there (folding.hpp)
      for (int panel : before.followed())
        if (press.kind == Press::Kind::flat) reached[panel] = 1;
    for (int panel : pressed.panels())
      if (!reached[panel]) findings.push_back(unreached(press, panels[panel]));
    if (press.kind != Press::Kind::fold) continue;
    for (const design::EdgePart& part : press.line)
      if (part.on != design::EdgePart::On::line && !has_cloth_beyond(garment, part))
        findings.push_back({"G1150",
                            Severity::warning,
                            fmt::format("iron `{}` folds edge `{}` of panel `{}`, beyond which there is no cloth", press.name,
                                        design::edge_of(garment.panels[part.panel], part).name, panels[part.panel].panel->name),
                            {{press.origin, ""}},
                            "fold along a line inside the panel, or turn the edge over with `hem`"});
  }
  add_twists(panels, presses, model);
  for (std::size_t k = 0; k < angle.size(); ++k) {
    if (angle[k] == 0) continue;
    model.crease_bend.push_back(static_cast<Index>(k));
    model.crease_angle.push_back(std::clamp(angle[k], -kLargestFold, kLargestFold));
    // About the other thread: the weft's way back for the warp, the warp's way on for the weft turn to the back.
    const model::Indices<3>& other = model.bend[k % 2 == 0 ? k + 1 : k - 1];
    model.crease_axis.push_back(k % 2 == 0 ? model::Indices<2>{other[2], other[0]} : model::Indices<2>{other[0], other[2]});
  }
}

}  // namespace garment::modeller
