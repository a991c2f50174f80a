// All places of a body's surface that face a point, not the nearest one alone.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "runtime/body/index.hpp"

namespace garment::body {
namespace {

constexpr double kSamePlace = 1e-9;     // m
constexpr double kSameDirection = 0.77;  // cosine, about 40 degrees: less than that the surface just curves

/// The closest point of one triangle.
struct Candidate {
  Vector3d point;
  double distance2;
  const Body::Index::Leaf* leaf;
  Feature feature;
};

void gather(const Body::Index& index, const Vector3d& p, double radius, std::vector<Candidate>& out) {
  thread_local std::vector<int> stack;
  out.clear();
  stack.assign(1, 0);
  while (!stack.empty()) {
    const Body::Index::Node& node = index.nodes[stack.back()];
    stack.pop_back();
    for (int side = 0; side < 2; ++side) {
      const auto& box = node.box[side];
      double distance2 = 0;
      for (int k = 0; k < 3; ++k) {
        double d = std::max({box[k] - p[k], p[k] - box[k + 3], 0.0});
        distance2 += d * d;
      }
      if (distance2 >= radius * radius) continue;
      if (node.count[side] == 0 && node.child[side] >= 0) stack.push_back(node.child[side]);
      for (int k = 0; k < node.count[side]; ++k) {
        const Body::Index::Leaf& leaf = index.leaves[~node.child[side] + k];
        if (leaf.covered) continue;
        TrianglePoint q = closest_on_triangle(p, leaf.corner[0], leaf.corner[1], leaf.corner[2]);
        double d = (q.point - p).squaredNorm();
        if (d < radius * radius) out.push_back({q.point, d, &leaf, q.feature});
      }
    }
  }
}

}  // namespace

void Body::facing(const Vector3d& p, double radius, const SurfacePoint& nearest, std::vector<SurfacePoint>& out) const {
  out.clear();
  if (!index || index->nodes.empty() || !p.allFinite() || nearest.distance <= 0) return;
  thread_local std::vector<Candidate> found;
  gather(*index, p, radius, found);
  std::sort(found.begin(), found.end(), [](const Candidate& a, const Candidate& b) {
    return std::tie(a.distance2, a.leaf->triangle) < std::tie(b.distance2, b.leaf->triangle);
  });
  // A place on an edge or a corner is the nearest of its surroundings only where all triangles around agree on it.
  auto agreed = [&](const Candidate& c) {
    if (c.feature == Feature::face) return true;
    int needed = 2;
    if (c.feature <= Feature::corner_2) needed = index->valence[mesh.triangles[c.leaf->triangle][static_cast<int>(c.feature)]];
    for (const Candidate& other : found)
      if ((other.point - c.point).squaredNorm() < kSamePlace * kSamePlace) --needed;
    return needed <= 0;
  };
  auto same_direction = [&](const Vector3d& n, const SurfacePoint& s) { return n.dot(p - s.point) > kSameDirection * s.distance; };
  for (const Candidate& c : found) {
    const double distance = std::sqrt(c.distance2);
    const Vector3d& normal = index->normals[c.leaf->triangle][static_cast<int>(c.feature)];
    if (distance < kSamePlace || (p - c.point).dot(normal) <= 0) continue;
    const Vector3d n = (p - c.point) / distance;
    if (same_direction(n, nearest)) continue;
    if (std::any_of(out.begin(), out.end(), [&](const SurfacePoint& s) { return same_direction(n, s); })) continue;
    if (agreed(c)) out.push_back(surface_point(*index, *c.leaf, {c.point, c.feature}, p));
  }
}

}  // namespace garment::body
