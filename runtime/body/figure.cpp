#include "runtime/body/figure.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/base/portable_math.hpp"

namespace garment::body {
namespace {

using portable::kPi;

constexpr double kRow = 0.006;  // m, between rows of the trunk's table
constexpr int kColumns = 64;    // angles from the front (0) to the back (pi)
constexpr double kBehind = 10;  // m, "nowhere near"

/// Smooth minimum and maximum: equal to the plain one where |a - b| >= k (Quilez, polynomial form).
double smooth_min(double a, double b, double k) {
  double h = std::max(k - std::fabs(a - b), 0.0) / k;
  return std::min(a, b) - 0.25 * h * h * k;
}
double smooth_max(double a, double b, double k) { return -smooth_min(-a, -b, k); }

/// Mean over about 4 cm, twice: a cubic through the knots still has ledges where its curvature jumps.
void soften(std::vector<double>& values) {
  constexpr int kReach = 3;
  int n = static_cast<int>(values.size());
  for (int pass = 0; pass < 2; ++pass) {
    std::vector<double> mean(values.size(), 0);
    for (int i = 0; i < n; ++i) {
      for (int k = -kReach; k <= kReach; ++k) mean[i] += values[std::clamp(i + k, 0, n - 1)];
      mean[i] /= 2 * kReach + 1;
    }
    values = std::move(mean);
  }
}

}  // namespace

double Figure::Ellipsoid::distance(const Vector3d& p) const {
  Vector3d q = (p - center).cwiseQuotient(radii);
  double k0 = q.norm(), k1 = q.cwiseQuotient(radii).norm();
  return k1 > 0 ? k0 * (k0 - 1) / k1 : -radii.minCoeff();
}

double Figure::Limb::distance(double at, double u, double z) const {
  double clamped = std::clamp(at, low, high);
  double p = across(clamped), q = along(clamped);
  double du = u - center_across(clamped), dz = z - center_z(clamped);
  double over = at - clamped, round = std::min(p, q);  // an end is half an ellipsoid
  double rho = std::sqrt(du * du + dz * dz + over * over);
  double g = std::sqrt(du * du / (p * p) + dz * dz / (q * q) + over * over / (round * round));
  return g > 0 ? rho - rho / g : -round;
}

Figure::Limb Figure::make_limb(const std::vector<LimbKnot>& knots) const {
  std::vector<double> at, across, along, center_across, center_z;
  for (const LimbKnot& k : knots) {
    at.push_back(k.at);
    across.push_back(k.across * scale_of(k.tape));
    along.push_back(k.along * scale_of(k.tape));
    center_across.push_back(k.center_across);
    center_z.push_back(k.center_z);
  }
  Limb limb;
  limb.low = at.front();
  limb.high = at.back();
  limb.across = Pchip(at, across);
  limb.along = Pchip(at, along);
  limb.center_across = Pchip(at, center_across);
  limb.center_z = Pchip(at, center_z);
  return limb;
}

void Figure::rebuild() {
  leg_ = make_limb(leg_knots_);
  arm_ = make_limb(arm_knots_);
  if (bust_tape_ >= 0) {
    double out = tapes_[bust_tape_].knob;
    breast_.radii.z() = 0.03 * unit_ + out;
  }
  std::vector<double> y, breadth, depth, center, exponent;
  for (const TrunkKnot& k : trunk_knots_) {
    y.push_back(k.y);
    breadth.push_back(k.breadth * scale_of(k.tape));
    depth.push_back(k.depth * scale_of(k.tape));
    center.push_back(k.center);
    exponent.push_back(k.exponent);
  }
  Pchip breadth_at(y, breadth), depth_at(y, depth), center_at(y, center), exponent_at(y, exponent);
  table_low_ = y.front();
  int rows = static_cast<int>((y.back() - y.front()) / kRow) + 2;
  table_high_ = table_low_ + (rows - 1) * kRow;
  radius_.resize(static_cast<std::size_t>(rows) * (kColumns + 1));
  slope_.resize(rows);
  std::vector<double> breadths(rows), depths(rows);
  center_.resize(rows);
  for (int r = 0; r < rows; ++r) {
    double h = table_low_ + r * kRow;
    breadths[r] = breadth_at(h);
    depths[r] = depth_at(h);
    center_[r] = center_at(h);
  }
  for (std::vector<double>* values : {&breadths, &depths, &center_}) soften(*values);
  for (int r = 0; r < rows; ++r) {
    double h = table_low_ + r * kRow, n = exponent_at(h), a = breadths[r], d = depths[r];
    double steep = (breadths[std::min(r + 1, rows - 1)] - breadths[std::max(r - 1, 0)]) / (2 * kRow);
    slope_[r] = 1 / std::sqrt(1 + steep * steep);
    for (int c = 0; c <= kColumns; ++c) {
      double angle = kPi * c / kColumns;
      double s = std::fabs(portable::sin(angle)) / a, t = std::fabs(portable::cos(angle)) / d;
      radius_[r * (kColumns + 1) + c] = portable::pow(portable::pow(s, n) + portable::pow(t, n), -1 / n);
    }
  }
}

double Figure::trunk_distance(const Vector3d& p) const {
  double row = std::clamp((p.y() - table_low_) / kRow, 0.0, static_cast<double>(center_.size()) - 1.001);
  std::size_t r = static_cast<std::size_t>(row);
  double fr = row - static_cast<double>(r);
  double dz = p.z() - ((1 - fr) * center_[r] + fr * center_[r + 1]);
  double rho = std::sqrt(p.x() * p.x() + dz * dz);
  double column = std::clamp(portable::atan2(p.x(), dz) * (kColumns / kPi), 0.0, kColumns - 1e-9);
  std::size_t c = static_cast<std::size_t>(column);
  double fc = column - static_cast<double>(c);
  const double* low = &radius_[r * (kColumns + 1) + c];
  const double* high = low + kColumns + 1;
  double radius = (1 - fr) * ((1 - fc) * low[0] + fc * low[1]) + fr * ((1 - fc) * high[0] + fc * high[1]);
  return (rho - radius) * ((1 - fr) * slope_[r] + fr * slope_[r + 1]);
}

double Figure::arm_distance(const Vector3d& p) const {
  Vector3d d = p - shoulder_;
  return arm_.distance(d.dot(arm_axis_), d.dot(arm_across_), d.z());
}

double Figure::field(const Vector3d& p) const {
  double y = p.y(), f = kBehind;
  bool near_leg = y<m_.trochanterionheight + 0.1, near_trunk = y> m_.crotchheight - 0.15;
  if (near_trunk) {
    f = trunk_distance(p);
    // Between the legs the trunk ends; outwards it goes on inside them, so that no fold shows.
    f = smooth_max(f, (m_.crotchheight - y - 0.4 * p.x()) / 1.08, 0.03 * unit_);
    f = smooth_max(f, y - table_high_ + 0.01, 0.02);
    if (bust_tape_ >= 0 && y > m_.chestheight - 0.2 && y < m_.chestheight + 0.2 && p.z() > -0.02)
      f = smooth_min(f, breast_.distance(p), 0.045 * unit_);
    if (y > m_.cervicaleheight - 0.05)
      f = smooth_min(f, smooth_min(cranium_.distance(p), jaw_.distance(p), 0.04 * unit_), 0.035 * unit_);
  }
  if (near_leg) {
    double leg = leg_.distance(y, p.x(), p.z());
    if (y < 0.25 * unit_)
      leg = smooth_min(leg, smooth_min(foot_.distance(p), heel_.distance(p), 0.03 * unit_), 0.035 * unit_);
    f = smooth_min(f, leg, 0.025 * unit_);
  }
  if (p.x() > 0.06 * unit_ && y < m_.cervicaleheight) {
    // A soft shoulder, but a clear armpit: at the bust the tape must pass between torso and arm.
    double blend = std::clamp(0.6 * (y - m_.axillaheight), 0.018, 0.06) * unit_;
    f = smooth_min(f, arm_distance(p), blend);
  }
  return y < 0.1 ? smooth_max(f, -y, 0.012) : f;
}

Plane Figure::tape_plane(const Tape& tape) const {
  if (tape.where == Tape::Where::arm) {
    double u = arm_.center_across(tape.at), z = arm_.center_z(tape.at);
    return {shoulder_ + tape.at * arm_axis_ + u * arm_across_ + Vector3d(0, 0, z),
            {0, 0, 1},
            arm_axis_.cross(Vector3d(0, 0, 1))};
  }
  Plane plane = horizontal(tape.at);
  if (tape.where == Tape::Where::leg) {
    plane.origin.x() = leg_.center_across(tape.at);
    plane.origin.z() = leg_.center_z(tape.at);
  } else {
    double row = std::clamp((tape.at - table_low_) / kRow, 0.0, static_cast<double>(center_.size()) - 1);
    plane.origin.z() = center_[static_cast<std::size_t>(row)];
  }
  return plane;
}

double Figure::field_girth(const Tape& tape) const {
  constexpr int kRays = 144;
  constexpr double kReach = 0.5, kStep = 0.01;  // m
  Plane plane = tape_plane(tape);
  Loop loop;
  for (int i = 0; i < kRays; ++i) {
    double angle = 2 * kPi * i / kRays;
    Vector2d way(portable::cos(angle), portable::sin(angle));
    auto value = [&](double s) {
      Vector3d p = plane.lift(s * way);
      p.x() = std::fabs(p.x());
      return field(p);
    };
    double low = 0, high = kStep;
    while (high < kReach && value(high) < 0) low = high, high += kStep;
    for (int k = 0; k < 24; ++k) {
      double middle = 0.5 * (low + high);
      (value(middle) < 0 ? low : high) = middle;
    }
    loop.push_back(0.5 * (low + high) * way);
  }
  return perimeter(convex_hull(std::move(loop)));
}

Vector3d Figure::low() const { return {0, -0.02, -0.30 * unit_ - 0.3 * (m_.hip - 0.9)}; }

Vector3d Figure::high() const {
  Vector3d hand = shoulder_ + arm_.high * arm_axis_;
  return {hand.x() + 0.08, m_.stature + 0.03, 0.32 * unit_ + 0.3 * (m_.bust_chest - 0.8)};
}

}  // namespace garment::body
