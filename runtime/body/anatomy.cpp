#include "runtime/body/anatomy.hpp"

#include <algorithm>
#include <cmath>

namespace garment::body {
namespace {

constexpr double kScan = 0.005;    // m, between the sections of a search
constexpr double kSpacing = 0.02;  // m, between the sections of a part
constexpr double kAnkle = 0.05;    // of stature: just above the malleolus (0.039), where the tape lies

enum class Extreme { least, most };

/// Height in [low, high] with the smallest or largest girth; `fallback` when that is at an end, where it
/// means nothing.
template <class Girth>
double extreme_height(double low, double high, double fallback, Extreme kind, const Girth& girth_at) {
  double best = fallback, best_girth = 0;
  bool inner = false;
  for (int i = 0, n = static_cast<int>((high - low) / kScan); i <= n; ++i) {
    double y = low + i * kScan, girth = girth_at(y);
    if (girth <= 0) continue;
    if (best_girth == 0 || (kind == Extreme::least ? girth < best_girth : girth > best_girth)) {
      best_girth = girth;
      best = y;
      inner = i > 0 && i < n;
    }
  }
  return inner ? best : fallback;
}

/// The middle of the heights about the smallest girth that are as good as it: a waist is often flat for centimetres.
template <class Girth>
double narrowest(double low, double high, double fallback, const Girth& girth_at) {
  constexpr double kAsGood = 1.006;
  const double least = extreme_height(low, high, fallback, Extreme::least, girth_at);
  const double limit = kAsGood * girth_at(least);
  double from = least, to = least;
  while (from - kScan > low && girth_at(from - kScan) < limit) from -= kScan;
  while (to + kScan < high && girth_at(to + kScan) < limit) to += kScan;
  return 0.5 * (from + to);
}

/// Height of the fullest place of the chest: where the front stands out most, for girths grow towards the arms. Where the
/// belly stands out farther, the largest girth all the same.
double fullest(const TriangleMesh& mesh, const Landmarks& marks, double high) {
  const double low = marks.height(0.69);
  double best = low, most = -1e9;
  for (double y = low; y <= high; y += kScan) {
    const Loop hull = torso_hull(mesh, marks, y);
    if (hull.size() < 3) continue;
    const double front = -loop_low(hull).y();
    if (front > most + 1e-6) most = front, best = y;
  }
  if (best > low) return best;
  return extreme_height(low, high, std::min(marks.height(0.727), high), Extreme::most,
                        [&](double y) { return perimeter(torso_hull(mesh, marks, y)); });
}

Part torso_part(const TriangleMesh& mesh, const Landmarks& marks, const std::string& name, double low,
                double high, double spacing) {
  Part part{name, {}};
  int n = std::max(1, static_cast<int>(std::lround((high - low) / spacing)));
  for (int i = 0; i <= n; ++i) {
    double y = low + (high - low) * i / n;
    Loop hull = torso_hull(mesh, marks, y);
    if (hull.size() >= 3) part.sections.push_back(make_section(horizontal(y), hull));
  }
  return part;
}

Part leg_part(const TriangleMesh& mesh, const Landmarks& marks, const std::string& name, int side) {
  Part part{name, {}};
  double high = marks.crotch - 0.01, low = marks.height(kAnkle);
  int n = std::max(1, static_cast<int>(std::lround((high - low) / kSpacing)));
  for (int i = 0; i <= n; ++i) {
    double y = high + (low - high) * i / n;
    Loop hull = leg_hull(mesh, marks, y, side);
    if (hull.size() < 3) continue;
    for (Vector2d& p : hull) p.y() = -p.y();  // the axis points down: v is +z
    part.sections.push_back(make_section({{0, y, 0}, {1, 0, 0}, {0, 0, 1}}, convex_hull(hull)));
  }
  return part;
}

double neck_height(const TriangleMesh& mesh, const Landmarks& marks) {
  const double high = std::min(marks.height(0.91), marks.top - 0.015);  // a neck that ends is no narrow one
  return extreme_height(marks.height(0.82), high, std::min(marks.height(0.86), high), Extreme::least,
                        [&](double y) { return perimeter(torso_hull(mesh, marks, y)); });
}

/// Highest point of the surface above the armpit, at the side of the torso: the end of the shoulder.
double shoulder_height(const TriangleMesh& mesh, const Landmarks& marks) {
  double high = marks.armpit;
  Plane upright{{marks.center_x + marks.reach, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const Loop& loop : slice(mesh, upright))
    if (loop_low(loop).x() < marks.height(0.84))
      high = std::max(high, std::min(loop_high(loop).x(), marks.height(0.86)));
  return high;
}

}  // namespace

Heights heights_of(const TriangleMesh& mesh) {
  Heights h;
  for (const Vector3d& p : mesh.vertices) h.low = std::min(h.low, p.y()), h.high = std::max(h.high, p.y());
  return h;
}

std::map<std::string, Part> find_parts(const TriangleMesh& mesh, const Landmarks& marks) {
  std::map<std::string, Part> parts;
  double neck = neck_height(mesh, marks);
  parts["torso"] = torso_part(mesh, marks, "torso", marks.crotch + 0.005, neck, kSpacing);
  parts["neck"] =
      torso_part(mesh, marks, "neck", neck - 0.015 * marks.stature, neck + 0.015 * marks.stature, 0.01);
  parts["head"] =
      torso_part(mesh, marks, "head", neck + 0.02 * marks.stature, marks.height(1) - 0.005, kSpacing);
  parts["leg.left"] = leg_part(mesh, marks, "leg.left", +1);
  parts["leg.right"] = leg_part(mesh, marks, "leg.right", -1);
  for (int side : {+1, -1}) {
    std::size_t biceps = 0, wrist = 0;
    std::string name = side > 0 ? "arm.left" : "arm.right";
    std::vector<Section> sections = trace_arm(mesh, marks, side, &biceps, &wrist);
    if (!sections.empty()) parts[name] = Part{name, std::move(sections)};
  }
  return parts;
}

std::map<std::string, Level> find_levels(const TriangleMesh& mesh, const Landmarks& marks,
                                         const std::map<std::string, Part>& parts) {
  std::map<std::string, Level> levels;
  auto torso_girth = [&](double y) { return perimeter(torso_hull(mesh, marks, y)); };
  auto leg_girth = [&](double y) { return perimeter(leg_hull(mesh, marks, y, +1)); };
  auto put = [&](const char* name, double y, double girth) {
    if (girth > 0) levels[name] = Level{y, girth};
  };
  auto put_torso = [&](const char* name, double y) { put(name, y, torso_girth(y)); };
  auto put_leg = [&](const char* name, double y) { put(name, y, leg_girth(y)); };
  double h = marks.stature, below_arms = marks.armpit - 0.005;

  double waist = narrowest(marks.height(0.58), marks.height(0.68), marks.height(0.644), torso_girth);
  double hip = extreme_height(marks.crotch + 0.01, marks.height(0.56), marks.height(0.516), Extreme::most,
                              torso_girth);
  double bust = fullest(mesh, marks, std::min(marks.height(0.76), below_arms));
  double knee = marks.height(0.277), ankle = marks.height(kAnkle);
  put_torso("head", extreme_height(marks.height(0.91), marks.height(0.98), marks.height(0.95), Extreme::most,
                                   torso_girth));
  put_torso("neck", neck_height(mesh, marks));
  put_torso("shoulder", shoulder_height(mesh, marks));
  put_torso("armpit", marks.armpit);
  put_torso("bust", bust);
  put_torso("underbust", bust - 0.045 * h);
  put_torso("waist", waist);
  put_torso("hip", hip);
  put_torso("crotch", marks.crotch);
  put_leg("thigh", marks.crotch - 0.02 * h);
  put_leg("knee", knee);
  put_leg("calf", extreme_height(marks.height(0.15), knee, marks.height(0.21), Extreme::most, leg_girth));
  put_leg("ankle", ankle);
  if (auto arm = parts.find("arm.left"); arm != parts.end()) {
    std::size_t biceps = 0, wrist = 0;
    std::vector<Section> sections = trace_arm(mesh, marks, +1, &biceps, &wrist);
    put("biceps", sections[biceps].center.y(), perimeter(sections[biceps].hull));
    put("wrist", sections[wrist].center.y(), perimeter(sections[wrist].hull));
  }
  return levels;
}

}  // namespace garment::body
