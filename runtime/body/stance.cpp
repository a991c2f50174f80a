#include "runtime/body/stance.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "runtime/base/number.hpp"
#include "runtime/base/portable_math.hpp"
#include "runtime/body/anatomy.hpp"

namespace garment::body {
namespace {

using Eigen::Matrix3d;

struct Unit {
  const char* name;
  double metres, low, high;  ///< heights of people in this unit
};
// 70 .. 90 might be a small child in centimetres; a grown person in inches is the likelier.
constexpr Unit kUnits[] = {
    {"m", 1, 0.7, 2.6}, {"inch", 0.0254, 45, 90}, {"cm", 0.01, 90, 260}, {"mm", 0.001, 700, 2600}};

/// A body without a head ends at 0.82 to 0.88 of the stature, so that its crotch (0.45 to 0.50 of the
/// stature, ANSUR II) stands at more than this share of its height.
constexpr double kHeadless = 0.525;
constexpr double kCrotchShare = 0.475;  // of the stature, as the legs of a mesh part: a little below the bone

/// Rotations that bring one axis of the file upwards, the usual ones first.
struct Upright {
  const char* axis;
  Matrix3d turn;  ///< rows: the new x, y, z in the file's axes
};
std::vector<Upright> uprights() {
  auto rows = [](const Vector3d& up, const Vector3d& front) {
    Matrix3d turn;
    turn.row(0) = up.cross(front), turn.row(1) = up, turn.row(2) = front;
    return turn;
  };
  const Vector3d x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  return {{"+y", rows(y, z)},  {"+z", rows(z, -y)}, {"-y", rows(-y, z)},
          {"-z", rows(-z, y)}, {"+x", rows(x, z)},  {"-x", rows(-x, z)}};
}

void turn_all(TriangleMesh& mesh, const Matrix3d& turn) {
  for (Vector3d& p : mesh.vertices) p = turn * p;
}

Matrix3d about_y(double c, double s) {
  const double n = std::sqrt(c * c + s * s);
  Matrix3d turn;
  turn << c / n, 0, s / n, 0, 1, 0, -s / n, 0, c / n;
  return turn;
}

/// Rotation about y that lays the line from leg to leg along x; the identity where there are no two legs.
Matrix3d legs_apart(const TriangleMesh& mesh) {
  const Heights h = heights_of(mesh);
  const std::vector<Loop> loops = slice(mesh, horizontal(h.low + 0.30 * (h.high - h.low)));
  if (loops.size() < 2) return Matrix3d::Identity();
  Vector2d across = loop_centroid(loops[0]) - loop_centroid(loops[1]);  // (x, -z)
  if (across.norm() < 1e-6) return Matrix3d::Identity();
  if (across.x() < 0) across = -across;
  return about_y(across.x(), -across.y());
}

/// Rotation about y that lays the long axis of the hip's section along x: a step forward turns the legs, not
/// the hip.
Matrix3d hip_across(const TriangleMesh& mesh, const Landmarks& marks) {
  const Loop hull = torso_hull(mesh, marks, marks.crotch + 0.03 * marks.stature);
  const Vector2d middle = loop_centroid(hull);
  double xx = 0, xy = 0, yy = 0;
  for (std::size_t k = 0; k < hull.size(); ++k) {
    const Vector2d a = hull[k] - middle, b = hull[(k + 1) % hull.size()] - middle;
    const double twice = a.x() * b.y() - a.y() * b.x();
    xx += twice * (a.x() * a.x() + a.x() * b.x() + b.x() * b.x());
    yy += twice * (a.y() * a.y() + a.y() * b.y() + b.y() * b.y());
    xy += twice * (a.x() * a.y() + b.x() * b.y() + 0.5 * (a.x() * b.y() + b.x() * a.y()));
  }
  const double angle = 0.5 * portable::atan2(2 * xy, xx - yy);  // counter-clockwise from above
  if (!(std::fabs(angle) < 0.4)) return Matrix3d::Identity();
  return about_y(portable::cos(angle), -portable::sin(angle));
}

/// How far the toes stand out beyond the heels on the +z side, m; where there are no feet, how far the calves
/// stand back.
double toes_forward(const TriangleMesh& mesh, const Landmarks& marks) {
  double forward = 0;
  for (int side : {+1, -1}) {
    const Loop ankle = leg_hull(mesh, marks, marks.height(0.06), side),
               foot = leg_hull(mesh, marks, marks.height(0.012), side);
    if (ankle.empty() || foot.empty()) continue;
    const double z = -loop_centroid(ankle).y();
    forward += (-loop_low(foot).y() - z) - (z + loop_high(foot).y());
  }
  if (std::fabs(forward) > 0.02 * marks.stature) return forward;
  auto z_at = [&](double share) {
    return -loop_centroid(leg_hull(mesh, marks, marks.height(share), +1)).y();
  };
  return 0.5 * (z_at(0.09) + z_at(0.28)) - z_at(0.21);
}

std::string nearest_axis(const Vector3d& way) {
  int k = 0;
  way.cwiseAbs().maxCoeff(&k);
  return std::string(way[k] < 0 ? "-" : "+") + "xyz"[k];
}

struct Attempt {
  std::optional<Stance> stance;
  Lacking lacking = Lacking::stature;
  double height = 0;  ///< in the file's unit
};

class Finder {
 public:
  Finder(const TriangleMesh& mesh, std::optional<double> unit) : mesh_(mesh), unit_(unit) {}

  Attempt attempt(const Upright& upright) {
    Attempt out;
    Stance s;
    s.mesh = mesh_;
    turn_all(s.mesh, upright.turn);
    const Heights h = heights_of(s.mesh);
    out.height = h.high - h.low;
    if (!choose_unit(s, out.height)) return out;
    for (Vector3d& p : s.mesh.vertices) p = s.unit * Vector3d(p.x(), p.y() - h.low, p.z());
    Matrix3d turn = upright.turn;
    auto turn_by = [&](const Matrix3d& by) { turn_all(s.mesh, by), turn = by * turn; };
    turn_by(legs_apart(s.mesh));
    std::optional<Landmarks> marks = find_landmarks(s.mesh, std::nullopt, &out.lacking);
    if (!marks) return out;
    std::optional<double> stature;
    s.head = marks->crotch < kHeadless * marks->stature;
    if (!s.head) stature = marks->crotch / kCrotchShare;
    if (!s.head && !(marks = find_landmarks(s.mesh, stature, &out.lacking))) return out;
    turn_by(hip_across(s.mesh, *marks));
    if (!(marks = find_landmarks(s.mesh, stature, &out.lacking))) return out;
    if (toes_forward(s.mesh, *marks) < 0) turn_by(about_y(-1, 0));
    if (!(marks = find_landmarks(s.mesh, stature, &out.lacking))) return out;
    const double depth =
        -loop_centroid(torso_hull(s.mesh, *marks, marks->crotch + 0.03 * marks->stature)).y();
    for (Vector3d& p : s.mesh.vertices) p -= Vector3d(marks->center_x, 0, depth);
    marks->center_x = 0;
    s.marks = *marks;
    s.up = nearest_axis(turn.row(1));
    s.front = nearest_axis(turn.row(2));
    out.stance = std::move(s);
    return out;
  }

 private:
  bool choose_unit(Stance& s, double height) const {
    if (unit_) {
      s.unit = *unit_;
      s.unit_name = format_number(*unit_);
      return true;
    }
    for (const Unit& u : kUnits)
      if (height >= u.low && height <= u.high) {
        s.unit = u.metres;
        s.unit_name = u.name;
        return true;
      }
    return false;
  }

  const TriangleMesh& mesh_;
  std::optional<double> unit_;
};

std::string why_not(Lacking lacking, double height, std::optional<double> unit) {
  switch (lacking) {
    case Lacking::stature:
      if (unit)
        return fmt::format("with {} m for one unit it is {} m high; a person is 0.7 to 2.6 m",
                           format_number(*unit), format_number(*unit * height, 4));
      return fmt::format(
          "it is {} units high; a person is 0.7 to 2.6 m, 90 to 260 cm, 700 to 2600 mm or 45 to 90 inches",
          format_number(height, 4));
    case Lacking::legs:
      return "a level cut at 0.3 of its height does not meet two legs of like thickness";
    case Lacking::crotch:
      return "its legs do not join between 0.36 and 0.6 of its height";
    case Lacking::torso:
      return "there is no trunk above the legs";
    case Lacking::nothing:
      break;
  }
  return "";
}

Finding finding(const char* code, Severity severity, std::string message, std::string help) {
  return {code, severity, std::move(message), {}, std::move(help)};
}

}  // namespace

StanceResult find_stance(const TriangleMesh& mesh, std::optional<double> unit, const std::string& name) {
  StanceResult result;
  Finder finder(mesh, unit);
  Attempt best;
  for (const Upright& upright : uprights()) {
    Attempt attempt = finder.attempt(upright);
    const bool first = best.height == 0;
    if (first || attempt.stance || attempt.lacking > best.lacking) best = std::move(attempt);
    if (best.stance) break;
  }
  if (!best.stance) {
    result.findings.push_back(
        finding("G0714", Severity::error,
                fmt::format("`{}` is no upright body: {}", name, why_not(best.lacking, best.height, unit)),
                "the body stands on both feet, legs apart; `--scale` says how many metres one unit of "
                "the file is"));
    return result;
  }
  const Stance& s = *best.stance;
  auto note = [&](const char* code, std::string message, std::string help) {
    result.findings.push_back(finding(code, Severity::note, std::move(message), std::move(help)));
  };
  if (!unit && s.unit != 1)
    note("G0715",
         fmt::format("`{}` is {} units high: they are taken as {}", name, format_number(best.height, 4),
                     s.unit_name),
         fmt::format("in a script: mesh(\"{}\", scale: {}); here `--scale` says otherwise", name,
                     format_number(s.unit)));
  if (s.up != "+y" || s.front != "+z")
    note("G0716", fmt::format("`{}` stands along {} and faces {}; it was turned", name, s.up, s.front),
         "to drape on it, export it with y up, facing +z");
  if (!s.head)
    note("G0717",
         fmt::format("`{}` has no head; its stature is taken as {} cm from the height of the crotch", name,
                     format_number(100 * s.marks.stature, 4)),
         "levels that follow the stature are less sure");
  result.stance = std::move(best.stance);
  return result;
}

}  // namespace garment::body
