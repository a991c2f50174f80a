#include "runtime/geometry/self_crossings.hpp"

#include <algorithm>

#include "runtime/base/parallel.hpp"
#include "runtime/geometry/box_tree.hpp"
#include "runtime/geometry/triangle_hit.hpp"

namespace garment::geometry {
namespace {

using Eigen::Vector3d;
using Corners = std::array<std::int32_t, 3>;

constexpr double kSamePoint = 1e-9;           // m
constexpr std::size_t kTrianglesAChunk = 256;

bool same_point(std::int32_t i, std::int32_t j, const Vector3d& a, const Vector3d& b) {
  return i == j || (a - b).squaredNorm() < kSamePoint * kSamePoint;
}

bool meet(const Corners& s, const Corners& t, const std::vector<Vector3d>& x) {
  const Triangle3 a{x[s[0]], x[s[1]], x[s[2]]}, b{x[t[0]], x[t[1]], x[t[2]]};
  int shared = 0, at_a = 0, at_b = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (same_point(s[i], t[j], a[i], b[j])) {
        ++shared;
        at_a = i;
        at_b = j;
      }
  if (shared == 0) return triangles_hit(a, b);
  if (shared > 1) return false;
  return segment_hits_triangle(a[(at_a + 1) % 3], a[(at_a + 2) % 3], b) ||
         segment_hits_triangle(b[(at_b + 1) % 3], b[(at_b + 2) % 3], a);
}

}  // namespace

SelfCrossings self_crossings(const std::vector<Corners>& triangles, const std::vector<Vector3d>& points, std::size_t most) {
  std::vector<ClosedBox> boxes(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::int32_t corner : triangles[t]) boxes[t].grow(points[corner]);
  const BoxTree tree(boxes);
  std::vector<SelfCrossings> found((triangles.size() + kTrianglesAChunk - 1) / kTrianglesAChunk);
  parallel_for(triangles.size(), kTrianglesAChunk, [&](std::size_t begin, std::size_t end) {
    SelfCrossings& out = found[begin / kTrianglesAChunk];
    for (std::size_t i = begin; i < end; ++i) {
      const auto first = static_cast<std::int32_t>(i);
      std::vector<TrianglePair> with;
      tree.visit([&](const ClosedBox& b) { return b.meets(boxes[i]); },
                 [&](std::int32_t j) {
                   if (j > first && meet(triangles[i], triangles[j], points)) with.push_back({first, j});
                 });
      std::sort(with.begin(), with.end(), [](const TrianglePair& p, const TrianglePair& q) { return p.second < q.second; });
      out.count += with.size();
      with.resize(std::min(with.size(), most - std::min(most, out.pairs.size())));
      out.pairs.insert(out.pairs.end(), with.begin(), with.end());
    }
  });
  SelfCrossings all;  // chunks are joined in their order, which keeps the list sorted
  for (const SelfCrossings& f : found) {
    all.count += f.count;
    const std::size_t room = std::min(f.pairs.size(), most - std::min(most, all.pairs.size()));
    all.pairs.insert(all.pairs.end(), f.pairs.begin(), f.pairs.begin() + static_cast<std::ptrdiff_t>(room));
  }
  return all;
}

}  // namespace garment::geometry
