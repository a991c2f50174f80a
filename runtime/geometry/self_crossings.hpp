#pragma once
// Where a surface of triangles meets itself.
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace garment::geometry {

/// Two triangles of one surface that meet, first < second.
struct TrianglePair {
  std::int32_t first = -1, second = -1;
  friend bool operator==(const TrianglePair&, const TrianglePair&) = default;
};

struct SelfCrossings {
  std::size_t count = 0;            ///< all pairs
  std::vector<TrianglePair> pairs;  ///< ascending, the first `most` of them
};

/// Pairs of triangles (numbers of points) that meet at `points` [n_points], m. Signs are exact; touching counts. Points
/// with one number or closer than 1e-9 m are one point: pairs that share two or three points are not tested, pairs that
/// share one are tested by their opposite edges. Same result for any thread count.
SelfCrossings self_crossings(const std::vector<std::array<std::int32_t, 3>>& triangles,
                             const std::vector<Eigen::Vector3d>& points, std::size_t most);

}  // namespace garment::geometry
