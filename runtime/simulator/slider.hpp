#pragma once
// The Jenkin slider: a spring that slips where it would carry more than its yield.
#include <algorithm>
#include <cmath>

#include "runtime/simulator/tensile_table.hpp"

namespace garment::simulator {

/// What one slider does at one strain: its potential, the force by the strain, and the slope of that.
struct Slip {
  double energy = 0, force = 0, slope = 0;
};

/// The state of one slider, frozen between two slips.
///
///     force            /-----  Y(s)          Between `low` and `high` the spring k (s - anchor) holds;
///                     /                      beyond them it carries its yield. The potential is that of
///         ----+------/-------- s             Huber, with a yield that may depend on the strain.
///            low  anchor  high
///        -----/
struct Slider {
  double anchor = 0, low = 0, high = 0;
};

/// A yield Y(s) >= 0: `at` the yield, `slope` dY/ds, `work` its integral from strain 0.
struct ConstantYield {
  double yield = 0;
  double at(double) const { return yield; }
  double slope(double) const { return 0; }
  double work(double s) const { return yield * s; }
};

/// Of shear by phi: Y = HG + m (|phi| - phi0), not below zero, m = (HG5 - HG) / (phi5 - phi0), phi0 = 0.5 and phi5 = 5 degrees. With
/// the elastic slope G - m the loop has the width 2HG at phi0 and 2HG5 at phi5, and its way out the slope G.
struct ShearYield {
  static constexpr double kFirst = 0.5 * 0.017453292519943295, kSecond = 5 * 0.017453292519943295;  // rad
  double base = 0, rise = 0;  // Y = base + rise |phi|
  ShearYield() = default;
  ShearYield(double hg, double hg5) : rise((hg5 - hg) / (kSecond - kFirst)) { base = hg - rise * kFirst; }
  double at(double phi) const { return std::max(0.0, base + rise * std::abs(phi)); }
  double slope(double phi) const { return at(phi) > 0 ? std::copysign(rise, phi) : 0; }
  double work(double phi) const {
    double from = 0, to = std::abs(phi);
    if (rise > 0) from = std::max(0.0, -base / rise);
    if (rise < 0) to = std::min(to, std::max(0.0, -base / rise));
    if (!(to > from)) return 0;
    if (rise == 0 && base <= 0) return 0;
    return std::copysign((to - from) * (base + 0.5 * rise * (from + to)), phi);
  }
};

/// Of tension: the share f of what the whole law bears; none in compression.
struct TensileYield {
  const TensileTable& law;
  double share = 0;
  double at(double strain) const { return strain > 0 ? share * law.at(strain).force : 0; }
  double slope(double strain) const { return strain > 0 ? share * law.at(strain).slope : 0; }
  double work(double strain) const { return strain > 0 ? share * law.at(strain).psi : 0; }
};

/// Sets where the slider begins to slip about its anchor; k must be larger than the slope of the yield, by which the iteration
/// closes in.
template <class Yield>
void set_reach(Slider& slider, double k, const Yield& yield) {
  constexpr int kIterations = 60;
  slider.low = slider.high = slider.anchor;
  if (!(k > 0)) return;
  for (int i = 0; i < kIterations; ++i) slider.high = slider.anchor + yield.at(slider.high) / k;
  for (int i = 0; i < kIterations; ++i) slider.low = slider.anchor - yield.at(slider.low) / k;
}

template <class Yield>
Slip slip_at(const Slider& slider, double k, const Yield& yield, double s) {
  if (s > slider.high) {
    const double held = slider.high - slider.anchor;
    return {0.5 * k * held * held + yield.work(s) - yield.work(slider.high), yield.at(s), yield.slope(s)};
  }
  if (s < slider.low) {
    const double held = slider.low - slider.anchor;
    return {0.5 * k * held * held - yield.work(s) + yield.work(slider.low), -yield.at(s), -yield.slope(s)};
  }
  const double held = s - slider.anchor;
  return {0.5 * k * held * held, k * held, k};
}

/// Return mapping: lets the anchor follow a slider that slipped to s, so that its force stays what it is. Returns the heat per
/// unit of what the slider stands for.
template <class Yield>
double follow(Slider& slider, double k, const Yield& yield, double s) {
  if (!(k > 0) || (s >= slider.low && s <= slider.high)) return 0;
  const double before = slip_at(slider, k, yield, s).energy, force = slip_at(slider, k, yield, s).force;
  slider.anchor = s - force / k;
  set_reach(slider, k, yield);
  return before - 0.5 * force * force / k;
}

}  // namespace garment::simulator
