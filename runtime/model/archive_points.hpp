#pragma once
// Points and lists of points in an Archive.
#include <Eigen/Core>
#include <vector>

#include "runtime/base/archive.hpp"
#include "runtime/model/model.hpp"

namespace garment::model {

inline void keep(Archive& a, Vector3d& point) { a.numbers(point.data(), 3); }

/// Any number of points.
inline void keep(Archive& a, std::vector<Vector3d>& points) {
  static_assert(sizeof(Vector3d) == 3 * sizeof(double));
  if (!a.length(points, sizeof(Vector3d)) || points.empty()) return;
  a.numbers(points.front().data(), 3 * points.size());
}

/// Exactly `n` points, or, where there may be none, none.
inline void keep(Archive& a, std::vector<Vector3d>& points, std::size_t n, bool or_none = false) {
  keep(a, points);
  a.demand(points.size() == n || (or_none && points.empty()));
}

/// Exactly `n` numbers.
template <class T>
void keep(Archive& a, std::vector<T>& numbers, std::size_t n) {
  a.keep(numbers);
  a.demand(numbers.size() == n);
}

}  // namespace garment::model
