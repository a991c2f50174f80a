#include "interpreter/language/curve_questions.hpp"

#include <algorithm>
#include <cmath>

namespace garment::interpreter {
namespace {

constexpr double kSame = 1e-6;  // of the range of x: the ends of paths are off by rounding

double reach(const CurvePoints& curve) {
  double low = 1e300, high = -1e300;
  for (const auto& p : curve) {
    low = std::min(low, p[0]);
    high = std::max(high, p[0]);
  }
  return curve.empty() ? 0 : high - low;
}

double between(const std::array<double, 2>& a, const std::array<double, 2>& b, double x) {
  if (b[0] == a[0]) return b[1];
  const double share = std::clamp((x - a[0]) / (b[0] - a[0]), 0.0, 1.0);
  return a[1] + share * (b[1] - a[1]);
}

/// y at every time that x passes `at`, in order; a turn right there counts once.
std::vector<double> crossings(const CurvePoints& curve, double at) {
  std::vector<double> found;
  const double same = kSame * reach(curve);
  int side = 0;  // of the last point that was off `at`
  for (std::size_t k = 0; k < curve.size(); ++k) {
    const double off = curve[k][0] - at;
    if (std::abs(off) <= same) {
      const bool first = k == 0 || std::abs(curve[k - 1][0] - at) > same;
      if (first) found.push_back(curve[k][1]);
      side = 0;
      continue;
    }
    const int now = off > 0 ? 1 : -1;
    if (side != 0 && now != side) found.push_back(between(curve[k - 1], curve[k], at));
    side = now;
  }
  return found;
}

}  // namespace

std::optional<CurvePoints> passage(const CurvePoints& curve, double from, double to) {
  const double way = to > from ? 1 : -1, same = kSame * std::max(reach(curve), std::abs(to - from));
  auto gone = [&](std::size_t k) { return way * (curve[k][0] - from); };  // past `from`
  const double whole = way * (to - from);
  CurvePoints part;
  for (std::size_t k = 0; k < curve.size(); ++k) {
    if (gone(k) < -same) {
      part.clear();
      continue;
    }
    if (part.empty()) {
      const bool here = std::abs(gone(k)) <= same;
      if (!here && k == 0) continue;
      if (!here && gone(k - 1) > 0) continue;  // it was beyond already, and came back without passing
      part.push_back({from, here ? curve[k][1] : between(curve[k - 1], curve[k], from)});
      if (here) continue;
    } else if (std::abs(gone(k)) <= same && part.size() == 1) {
      part[0] = {from, curve[k][1]};  // still, or again, at the start
      continue;
    }
    if (gone(k) >= whole - same) {
      part.push_back({to, gone(k) <= whole + same ? curve[k][1] : between(curve[k - 1], curve[k], to)});
      return part;
    }
    part.push_back(curve[k]);
  }
  return std::nullopt;
}

std::optional<double> slope_of(const CurvePoints& curve, double from, double to) {
  const std::optional<CurvePoints> part = passage(curve, from, to);
  if (!part) return std::nullopt;
  const auto n = static_cast<double>(part->size());
  double x = 0, y = 0, xx = 0, xy = 0;
  for (const auto& p : *part) {
    x += p[0] / n;
    y += p[1] / n;
  }
  for (const auto& p : *part) {
    xx += (p[0] - x) * (p[0] - x);
    xy += (p[0] - x) * (p[1] - y);
  }
  return xx > 0 ? std::optional(xy / xx) : std::nullopt;
}

std::optional<double> work_of(const CurvePoints& curve, double from, double to) {
  const std::optional<CurvePoints> part = passage(curve, from, to);
  if (!part) return std::nullopt;
  double sum = 0;
  for (std::size_t k = 0; k + 1 < part->size(); ++k)
    sum += 0.5 * ((*part)[k][1] + (*part)[k + 1][1]) * ((*part)[k + 1][0] - (*part)[k][0]);
  return sum;
}

std::optional<double> reading_of(const CurvePoints& curve, double at) {
  const std::vector<double> found = crossings(curve, at);
  return found.empty() ? std::nullopt : std::optional(found[0]);
}

std::optional<double> loop_width_of(const CurvePoints& curve, double at) {
  const std::vector<double> found = crossings(curve, at);
  return found.size() < 2 ? std::nullopt : std::optional(std::abs(found[0] - found[1]));
}

}  // namespace garment::interpreter
