#include "runtime/modeller/pressing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "runtime/base/portable_math.hpp"

namespace garment::modeller {
namespace {

using design::Point2;
using design::Press;
using model::Index;

constexpr double kChordError = 1e-4;       // m, of curves that are folded along
constexpr double kLargestFold = 3.05;      // rad; folded flat, cloth turns about its own thickness
constexpr double kSharp = 1e-6;            // m, shorter folds lie in one cell

double cross(const Point2& a, const Point2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// The thread of a bending stencil: its middle, its direction, and the length that it answers for.
struct Thread {
  int panel;
  Point2 at, along;
  double length;
};

/// One press as its panels see it.
class Pressed {
 public:
  Pressed(const design::Garment& garment, const Press& press) : press_(press) {
    for (const design::EdgePart& part : press.line)
      lines_.push_back({part.panel, points_of(design::edge_of(garment.panels[part.panel], part).curve, part)});
    if (press.region < 0) return;
    for (const design::RegionPart& part : garment.regions[press.region].parts)
      regions_.emplace_back(part.panel, design::RegionTest(garment.panels[part.panel], part.shape));
  }

  /// Changes the thread's rest fold; true where it did.
  bool apply(const Thread& thread, double& angle) const {
    const double before = angle;
    if (press_.kind == Press::Kind::fold) angle += folded(thread);
    if (press_.kind == Press::Kind::curl && holds(thread)) angle += curled(thread);
    if (press_.kind == Press::Kind::flat && holds(thread)) angle *= 1 - std::min(1.0, press_.factor);
    return angle != before;
  }

  /// The panels on which it should have done something, each once.
  std::vector<int> panels() const {
    std::vector<int> all;
    if (press_.kind == Press::Kind::fold)
      for (const Line& line : lines_) all.push_back(line.panel);
    else
      for (const auto& region : regions_) all.push_back(region.first);
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }

 private:
  struct Line {
    int panel;
    std::vector<Point2> points;
  };

  /// The part of the curve as a polyline.
  static std::vector<Point2> points_of(const geometry::Curve& curve, const design::EdgePart& part) {
    const double from = std::min(part.from, part.to), to = std::max(part.from, part.to);
    std::vector<double> at;
    const std::vector<Point2> whole = curve.polyline(kChordError, &at);
    std::vector<Point2> points{curve.point_at(from)};
    for (std::size_t k = 0; k < whole.size(); ++k)
      if (at[k] > from && at[k] < to) points.push_back(whole[k]);
    points.push_back(curve.point_at(to));
    return points;
  }

  double side() const { return press_.to == design::Facing::back ? 1 : -1; }

  bool holds(const Thread& thread) const {
    return std::any_of(regions_.begin(), regions_.end(),
                       [&](const auto& r) { return r.first == thread.panel && r.second.contains(thread.at); });
  }

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
        sum += turn * share(ahead, press_.radius * whole / std::max(sine, 0.1), thread.length);
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

  double curled(const Thread& thread) const {
    double nearest = std::numeric_limits<double>::infinity(), sine = 1;
    for (const Line& line : lines_) {
      if (line.panel != thread.panel) continue;
      for (std::size_t k = 0; k + 1 < line.points.size(); ++k) {
        const Point2 way = line.points[k + 1] - line.points[k];
        if (!(way.norm() > 0)) continue;
        const double t = std::clamp((thread.at - line.points[k]).dot(way) / way.squaredNorm(), 0.0, 1.0);
        const double distance = (line.points[k] + t * way - thread.at).squaredNorm();
        if (distance >= nearest) continue;
        nearest = distance;
        sine = cross(thread.along, way) / way.norm();
      }
    }
    if (nearest == std::numeric_limits<double>::infinity() || !(press_.radius > 0)) return 0;
    return side() * press_.set * press_.factor * thread.length / press_.radius * sine * sine;
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

void add_creases(const design::Garment& garment, const std::vector<MeshedPanel>& panels, model::Model& model,
                 Findings& findings) {
  if (std::none_of(garment.presses.begin(), garment.presses.end(), bends)) return;
  std::vector<Thread> threads = threads_of(model);
  std::vector<double> angle(model.bend.size(), 0);
  for (std::size_t k = 0; k < threads.size(); ++k) {
    const GridFrame& frame = panels[threads[k].panel].frame;
    threads[k].along = k % 2 == 0 ? frame.warp() : frame.weft();  // stencils come in pairs
  }
  for (const Press& press : garment.presses) {
    if (!bends(press)) continue;
    const Pressed pressed(garment, press);
    std::vector<char> reached(panels.size(), 0);
    for (std::size_t k = 0; k < threads.size(); ++k)
      if (pressed.apply(threads[k], angle[k])) reached[threads[k].panel] = 1;
    for (int panel : pressed.panels())
      if (!reached[panel]) findings.push_back(unreached(press, panels[panel]));
  }
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
