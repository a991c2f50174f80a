#include "interpreter/language/root_finding.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace garment::interpreter {

//   b is the best place so far, c the other end of the bracket, a the place before b. A step goes by inverse quadratic
//   or linear interpolation where that shrinks the bracket fast enough, else by halving.
Bracket narrow(Bracket bracket, const std::function<double(double)>& f) {
  double a = bracket.low, fa = bracket.f_low, b = bracket.high, fb = bracket.f_high, c = a, fc = fa;
  double step = b - a, before = step;
  const double scale = std::max(std::fabs(a), std::fabs(b));
  while (bracket.trials < 100) {
    if (std::fabs(fc) < std::fabs(fb)) a = b, b = c, c = a, fa = fb, fb = fc, fc = fa;
    const double tolerance = 1e-13 * scale + 4e-16 * std::fabs(b), middle = 0.5 * (c - b);
    if (std::fabs(middle) <= tolerance || fb == 0) break;
    if (std::fabs(before) < tolerance || std::fabs(fa) <= std::fabs(fb)) {
      step = before = middle;
    } else {
      double p, q;
      const double s = fb / fa;
      if (a == c) {
        p = 2 * middle * s;
        q = 1 - s;
      } else {
        const double r = fb / fc, t = fa / fc;
        p = s * (2 * middle * t * (t - r) - (b - a) * (r - 1));
        q = (t - 1) * (r - 1) * (s - 1);
      }
      if (p > 0) q = -q;
      p = std::fabs(p);
      if (2 * p < std::min(3 * middle * q - std::fabs(tolerance * q), std::fabs(before * q))) {
        before = step;
        step = p / q;
      } else {
        step = before = middle;
      }
    }
    a = b;
    fa = fb;
    b += std::fabs(step) > tolerance ? step : std::copysign(tolerance, middle);
    fb = f(b);
    ++bracket.trials;
    if ((fb > 0) == (fc > 0)) {
      c = a;
      fc = fa;
      step = before = b - a;
    }
  }
  bracket.low = b, bracket.f_low = fb, bracket.high = c, bracket.f_high = fc;
  if (bracket.low > bracket.high) {
    std::swap(bracket.low, bracket.high);
    std::swap(bracket.f_low, bracket.f_high);
  }
  return bracket;
}

}  // namespace garment::interpreter
