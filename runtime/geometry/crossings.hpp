#pragma once
// Where two curves meet.
#include <vector>

#include "runtime/geometry/curve.hpp"

namespace garment::geometry {

struct Crossing {
  double on_a = 0, on_b = 0;  ///< arc lengths, m
  Point2 point{0, 0};
  bool touching = false;  ///< the curves only touch here, or one ends on the other
};

struct Crossings {
  std::vector<Crossing> found;  ///< in the order walked along the first curve
  bool overlap = false;         ///< the curves run along each other for a while; `found` is then not complete
  bool too_many = false;        ///< so many near misses that the search was given up; `found` is empty
};

/// Points that both curves share, within 1e-7 m of each. Points nearer than 1e-6 m to each other count once; where the
/// curves run at less than 0.1 degrees to each other that is 1e-4 m. The same points come out with the curves
/// exchanged.
Crossings crossings_of(const Curve& a, const Curve& b);

/// The shortest way between two curves: arc lengths on both, distance in metres. To within about 1e-5 m; for messages.
struct Approach {
  double on_a = 0, on_b = 0, distance = 0;
};
Approach nearest_approach(const Curve& a, const Curve& b);

}  // namespace garment::geometry
