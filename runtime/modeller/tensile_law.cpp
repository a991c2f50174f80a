#include "runtime/modeller/tensile_law.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/base/portable_math.hpp"

namespace garment::modeller {
namespace {

constexpr int kKnots = 40;

/// Force and slope of the law at strain e in [0, max_strain].
struct ForceSlope {
  double force, slope;
};

ForceSlope below_one(const design::Tensile& t, double linearity, double e) {
  double s_m = t.max_force / t.max_strain;
  double r = std::min(0.25, linearity / 2);
  double p = 2 * (1 - r) / (linearity - r) - 1;
  double x = e / t.max_strain;
  if (x >= 1) return {t.max_force, s_m * (r + (1 - r) * p)};
  if (x <= 0) return {0, s_m * r};
  double power = portable::pow(x, p - 1);  // p > 1
  return {s_m * (r * e + (1 - r) * t.max_strain * power * x), s_m * (r + (1 - r) * p * power)};
}

ForceSlope above_one(const design::Tensile& t, double linearity, double e) {
  double s_m = t.max_force / t.max_strain;
  double a = (3 * linearity - 2) * s_m, b = 3 * (1 - linearity) * s_m / t.max_strain;
  if (e >= t.max_strain) return {t.max_force, a + 2 * b * t.max_strain};
  return {a * e + b * e * e, a + 2 * b * e};
}

std::size_t knot_before(const model::TensileLaw& law, double strain) {
  return static_cast<std::size_t>(std::upper_bound(law.strain.begin(), law.strain.end(), strain) - law.strain.begin()) - 1;
}

}  // namespace

model::TensileLaw make_tensile_law(const design::Tensile& tensile) {
  double linearity = std::clamp(tensile.linearity, 0.1, 1.3);
  model::TensileLaw law;
  for (int k = 0; k < kKnots; ++k) {
    double x = static_cast<double>(k) / (kKnots - 1);
    double e = k == kKnots - 1 ? tensile.max_strain : tensile.max_strain * x * std::sqrt(x);
    ForceSlope at = linearity < 1 ? below_one(tensile, linearity, e) : above_one(tensile, linearity, e);
    law.strain.push_back(e);
    law.force.push_back(at.force);
    law.slope.push_back(at.slope);
  }
  return law;
}

double tensile_force(const model::TensileLaw& law, double strain) {
  if (strain <= law.strain.front())
    return law.force.front() + law.slope.front() * (strain - law.strain.front());
  if (strain >= law.strain.back()) return law.force.back() + law.slope.back() * (strain - law.strain.back());
  const std::size_t k = knot_before(law, strain);
  double h = law.strain[k + 1] - law.strain[k], t = (strain - law.strain[k]) / h;
  double t2 = t * t, t3 = t2 * t;
  return (2 * t3 - 3 * t2 + 1) * law.force[k] + (t3 - 2 * t2 + t) * h * law.slope[k] +
         (3 * t2 - 2 * t3) * law.force[k + 1] + (t3 - t2) * h * law.slope[k + 1];
}

double tensile_slope(const model::TensileLaw& law, double strain) {
  if (strain <= law.strain.front()) return law.slope.front();
  if (strain >= law.strain.back()) return law.slope.back();
  const std::size_t k = knot_before(law, strain);
  const double h = law.strain[k + 1] - law.strain[k], t = (strain - law.strain[k]) / h;
  return (6 * t * t - 6 * t) / h * (law.force[k] - law.force[k + 1]) + (3 * t * t - 4 * t + 1) * law.slope[k] +
         (3 * t * t - 2 * t) * law.slope[k + 1];
}

model::TensileLaw add_laws(const std::vector<std::pair<const model::TensileLaw*, double>>& laws, double linear) {
  model::TensileLaw sum;
  for (const auto& [law, factor] : laws) sum.strain.insert(sum.strain.end(), law->strain.begin(), law->strain.end());
  std::sort(sum.strain.begin(), sum.strain.end());
  // Knots nearer than this are one: pieces too short to divide by say nothing.
  constexpr double kLeastApart = 1e-6;
  sum.strain.erase(std::unique(sum.strain.begin(), sum.strain.end(), [](double a, double b) { return b - a < kLeastApart; }),
                   sum.strain.end());
  for (double e : sum.strain) {
    double force = linear * e, slope = linear;
    for (const auto& [law, factor] : laws) {
      force += factor * tensile_force(*law, e);
      slope += factor * tensile_slope(*law, e);
    }
    sum.force.push_back(force);
    sum.slope.push_back(slope);
  }
  return sum;
}

}  // namespace garment::modeller
