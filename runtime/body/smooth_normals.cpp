// Normals to push along. The mesh of a body is a stand-in for a smooth one: with the normals of its facets, a particle that
// is pressed into the shallow valley between two of them is thrown to and fro for ever.
#include <algorithm>
#include <cmath>

#include "runtime/base/portable_math.hpp"
#include "runtime/body/index.hpp"

namespace garment::body {
namespace {

constexpr double kSharp = 0.77;       // cosine between facets of an edge that is meant to be one, about 40 degrees
constexpr double kFarPoint = 1e-6;    // m: nearer, the way to the surface has no direction

struct Incidence {
  int vertex, triangle, corner;
  friend auto operator<=>(const Incidence&, const Incidence&) = default;
};

Vector3d face_normal(const Body::Index& index, int triangle) {
  return index.normals[triangle][static_cast<int>(Feature::face)];
}

double corner_angle(const TriangleMesh& mesh, const Incidence& at) {
  const auto& t = mesh.triangles[at.triangle];
  const Vector3d& p = mesh.vertices[at.vertex];
  const Vector3d a = mesh.vertices[t[(at.corner + 1) % 3]] - p, b = mesh.vertices[t[(at.corner + 2) % 3]] - p;
  return portable::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

void make_smooth(const TriangleMesh& mesh, Body::Index& index) {
  const std::size_t n = mesh.triangles.size();
  index.smooth.assign(n, {});
  index.sharp.assign(n, 0);
  index.valence.assign(mesh.vertices.size(), 0);
  std::vector<Incidence> at;
  at.reserve(3 * n);
  for (std::size_t t = 0; t < n; ++t)
    for (int k = 0; k < 3; ++k) at.push_back({mesh.triangles[t][k], static_cast<int>(t), k});
  std::sort(at.begin(), at.end());
  for (std::size_t begin = 0, end = 0; begin < at.size(); begin = end) {
    while (end < at.size() && at[end].vertex == at[begin].vertex) ++end;
    index.valence[at[begin].vertex] = static_cast<int>(end - begin);
    for (std::size_t i = begin; i < end; ++i) {
      const Vector3d mine = face_normal(index, at[i].triangle);
      Vector3d sum = Vector3d::Zero();
      bool sharp = false;
      for (std::size_t j = begin; j < end; ++j) {
        const Vector3d other = face_normal(index, at[j].triangle);
        if (other.isZero()) continue;  // of a triangle without area
        if (mine.dot(other) > kSharp)
          sum += corner_angle(mesh, at[j]) * other;
        else
          sharp = true;
      }
      // Beside a sharp edge the facet keeps its own normal, or the direction would jump where the edge takes over.
      index.smooth[at[i].triangle][at[i].corner] = !sharp && sum.norm() > 0 ? Vector3d(sum.normalized()) : mine;
      if (sharp) index.sharp[at[i].triangle] |= static_cast<std::uint8_t>(1 << at[i].corner);
    }
  }
  // An edge is sharp where its two facets disagree: their normal there lies far from that of either.
  for (std::size_t t = 0; t < n; ++t)
    for (int k = 0; k < 3; ++k) {
      const int edge = static_cast<int>(Feature::edge_0) + k;
      const double half = index.normals[t][edge].dot(face_normal(index, static_cast<int>(t)));
      if (2 * half * half - 1 < kSharp) index.sharp[t] |= static_cast<std::uint8_t>(1 << edge);
    }
}

SurfacePoint surface_point(const Body::Index& index, const Body::Index::Leaf& leaf, const TrianglePoint& at,
                           const Vector3d& p) {
  const int t = leaf.triangle, feature = static_cast<int>(at.feature);
  SurfacePoint s{at.point, index.normals[t][feature], {}, 0, t};
  const Vector3d way = p - at.point;
  const double length = way.norm(), side = way.dot(s.normal) < 0 ? -1 : 1;
  s.distance = side * length;
  const bool sharp = at.feature != Feature::face && (index.sharp[t] >> feature & 1) != 0;
  if (sharp && length > kFarPoint) {
    s.push = way * (side / length);
    return s;
  }
  const Vector3d a = leaf.corner[1] - leaf.corner[0], b = leaf.corner[2] - leaf.corner[0], q = at.point - leaf.corner[0];
  const double aa = a.dot(a), ab = a.dot(b), bb = b.dot(b), det = aa * bb - ab * ab;
  double u = 1.0 / 3, v = 1.0 / 3;
  if (det > 0) {
    u = std::clamp((bb * q.dot(a) - ab * q.dot(b)) / det, 0.0, 1.0);
    v = std::clamp((aa * q.dot(b) - ab * q.dot(a)) / det, 0.0, 1.0 - u);
  }
  const auto& n = index.smooth[t];
  s.push = (1 - u - v) * n[0] + u * n[1] + v * n[2];
  const double size = s.push.norm();
  s.push = size > 0 ? Vector3d(s.push / size) : s.normal;
  return s;
}

}  // namespace garment::body
