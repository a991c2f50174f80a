#pragma once
// The root of a function of one number, between two places where its signs differ.
#include <functional>

namespace garment::interpreter {

struct Bracket {
  double low = 0, f_low = 0;    ///< place and value; the two values have opposite signs, or one is 0
  double high = 0, f_high = 0;
  int trials = 0;
};

/// Narrows the bracket until its ends agree to twelve digits, or one value is 0, with at most 100 trials of `f`
/// (Brent 1973, Algorithms for Minimization without Derivatives, ch. 4). Deterministic.
Bracket narrow(Bracket bracket, const std::function<double(double)>& f);

}  // namespace garment::interpreter
