#include "runtime/body/slice.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace garment::body {
namespace {

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Where one triangle is cut: from the mesh edge that goes up through the plane to the one that comes down.
struct Segment {
  std::uint64_t from, to;
  Vector2d point;  ///< on `from`
};

std::uint64_t edge_key(int a, int b) {
  return static_cast<std::uint64_t>(std::min(a, b)) << 32 | static_cast<std::uint32_t>(std::max(a, b));
}

std::vector<Segment> cut_triangles(const TriangleMesh& mesh, const Plane& plane) {
  std::vector<double> height(mesh.vertices.size());
  Vector3d normal = plane.normal();
  for (std::size_t i = 0; i < height.size(); ++i) height[i] = normal.dot(mesh.vertices[i] - plane.origin);
  auto crossing = [&](int a, int b) {
    if (a > b) std::swap(a, b);  // both triangles of an edge must get the same point
    Vector3d p =
        mesh.vertices[a] + height[a] / (height[a] - height[b]) * (mesh.vertices[b] - mesh.vertices[a]);
    p -= plane.origin;
    return Vector2d(p.dot(plane.u), p.dot(plane.v));
  };
  std::vector<Segment> segments;
  for (const auto& t : mesh.triangles) {
    // A vertex on the plane counts as above: then every triangle is cut in no or in two edges.
    std::array<bool, 3> above{height[t[0]] >= 0, height[t[1]] >= 0, height[t[2]] >= 0};
    if (above[0] == above[1] && above[1] == above[2]) continue;
    Segment s{0, 0, {0, 0}};
    for (int k = 0; k < 3; ++k) {
      int next = (k + 1) % 3;
      if (above[k] == above[next]) continue;
      // Walking from the edge that comes down to the one that goes up keeps the solid to the left.
      if (above[k]) {
        s.from = edge_key(t[k], t[next]);
        s.point = crossing(t[k], t[next]);
      } else {
        s.to = edge_key(t[k], t[next]);
      }
    }
    segments.push_back(s);
  }
  return segments;
}

}  // namespace

Plane horizontal(double y) { return {{0, y, 0}, {1, 0, 0}, {0, 0, -1}}; }

std::vector<Loop> slice(const TriangleMesh& mesh, const Plane& plane) {
  std::vector<Segment> segments = cut_triangles(mesh, plane);
  std::stable_sort(segments.begin(), segments.end(),
                   [](const Segment& a, const Segment& b) { return a.from < b.from; });
  std::vector<bool> used(segments.size(), false);
  std::vector<Loop> loops;
  for (std::size_t first = 0; first < segments.size(); ++first) {
    if (used[first]) continue;
    Loop loop;
    for (std::size_t i = first; i < segments.size();) {
      used[i] = true;
      loop.push_back(segments[i].point);
      auto next = std::lower_bound(segments.begin(), segments.end(), segments[i].to,
                                   [](const Segment& s, std::uint64_t key) { return s.from < key; });
      std::size_t k = next - segments.begin();
      while (k < segments.size() && segments[k].from == segments[i].to && used[k]) ++k;
      i = k < segments.size() && segments[k].from == segments[i].to ? k : segments.size();
    }
    if (loop.size() >= 3) loops.push_back(std::move(loop));
  }
  std::stable_sort(loops.begin(), loops.end(), [](const Loop& a, const Loop& b) {
    return std::fabs(loop_area(a)) > std::fabs(loop_area(b));
  });
  return loops;
}

double loop_area(const Loop& loop) {
  double sum = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) sum += cross(loop[i], loop[(i + 1) % loop.size()]);
  return 0.5 * sum;
}

Vector2d loop_centroid(const Loop& loop) {
  Vector2d sum(0, 0), mean(0, 0);
  for (const Vector2d& p : loop) mean += p / static_cast<double>(loop.size());
  double area = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    Vector2d a = loop[i] - mean, b = loop[(i + 1) % loop.size()] - mean;
    area += cross(a, b);
    sum += cross(a, b) * (a + b);
  }
  return std::fabs(area) > 1e-12 ? Vector2d(mean + sum / (3 * area)) : mean;
}

Loop convex_hull(Loop points) {
  auto less = [](const Vector2d& a, const Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  };
  std::sort(points.begin(), points.end(), less);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  Loop hull;
  for (int pass = 0; pass < 2; ++pass) {
    std::size_t base = hull.size();
    for (const Vector2d& p : points) {
      while (hull.size() >= base + 2 && cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0)
        hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

double perimeter(const Loop& loop) {
  double sum = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) sum += (loop[(i + 1) % loop.size()] - loop[i]).norm();
  return sum;
}

Loop clip_x(const Loop& loop, double low, double high) {
  Loop kept;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vector2d &a = loop[i], &b = loop[(i + 1) % loop.size()];
    if (a.x() >= low && a.x() <= high) kept.push_back(a);
    for (double x : {low, high})
      if ((a.x() < x) != (b.x() < x)) kept.push_back(a + (x - a.x()) / (b.x() - a.x()) * (b - a));
  }
  return kept;
}

Vector2d loop_low(const Loop& loop) {
  Vector2d low(std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity());
  for (const Vector2d& p : loop) low = low.cwiseMin(p);
  return low;
}

Vector2d loop_high(const Loop& loop) {
  Vector2d high(-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity());
  for (const Vector2d& p : loop) high = high.cwiseMax(p);
  return high;
}

}  // namespace garment::body
