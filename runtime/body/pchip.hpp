#pragma once
// Monotone piecewise cubic interpolation (PCHIP): never overshoots its knots, so a figure gets no waves
// between tapes.
#include <vector>

namespace garment::body {

/// Fritsch & Butland 1984. Constant beyond the ends. `x` strictly ascending, as many values as knots, at
/// least one.
class Pchip {
 public:
  Pchip() = default;
  Pchip(std::vector<double> x, std::vector<double> y);
  double operator()(double x) const;

 private:
  std::vector<double> x_, y_, slope_;
};

}  // namespace garment::body
