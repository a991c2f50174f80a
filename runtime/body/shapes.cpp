#include "runtime/body/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "runtime/base/portable_math.hpp"

namespace garment::body {
namespace {

using Eigen::Vector2d;

constexpr double kEdge = 0.012;      // m, aim for the length of an edge
constexpr double kRounding = 0.005;  // m
constexpr double kFloorWidth = 8, kFloorDepth = 1, kFloorEdge = 0.25, kFloorRounding = 0.1;

int parts(double length, double edge, int least, int most) {
  return static_cast<int>(
      std::clamp(std::ceil(length / edge), static_cast<double>(least), static_cast<double>(most)));
}

/// Vertices that several faces of a shape share, found again by their integer place on the shape's lattice.
class Welder {
 public:
  explicit Welder(TriangleMesh& mesh) : mesh_(mesh) {}
  template <class Place>
  int vertex(const std::array<int, 3>& key, const Place& place) {
    auto [it, is_new] = known_.try_emplace(key, static_cast<int>(mesh_.vertices.size()));
    if (is_new) mesh_.vertices.push_back(place());
    return it->second;
  }

 private:
  TriangleMesh& mesh_;
  std::map<std::array<int, 3>, int> known_;
};

/// Points of one axis of a box: a half-width of `core` in equal steps, and at each end one more point that
/// the rounding maps to the middle of its quarter circle.
std::vector<double> axis_points(double core, double rounding, double edge) {
  int n = parts(2 * core, edge, 1, 400);
  std::vector<double> x{-core - rounding};
  for (int i = 0; i <= n; ++i) x.push_back(core * (2.0 * i / n - 1));
  x.push_back(core + rounding);
  return x;
}

TriangleMesh rounded_box(const Vector3d& size, double rounding, double edge) {
  TriangleMesh mesh;
  Welder welder(mesh);
  Vector3d core = (0.5 * size - Vector3d::Constant(rounding)).cwiseMax(0);
  std::array<std::vector<double>, 3> points;
  for (int k = 0; k < 3; ++k) points[k] = axis_points(core[k], rounding, edge);
  auto place = [&](const std::array<int, 3>& i) -> Vector3d {
    Vector3d q(points[0][i[0]], points[1][i[1]], points[2][i[2]]);
    Vector3d inner = q.cwiseMax(-core).cwiseMin(core);
    return inner + rounding * (q - inner).normalized();
  };
  for (int axis = 0; axis < 3; ++axis) {
    int u = (axis + 1) % 3, v = (axis + 2) % 3;
    int last = static_cast<int>(points[axis].size()) - 1;
    int nu = static_cast<int>(points[u].size()) - 1, nv = static_cast<int>(points[v].size()) - 1;
    for (int side : {0, last})
      for (int i = 0; i < nu; ++i)
        for (int j = 0; j < nv; ++j) {
          std::array<int, 4> corner{};
          for (int c = 0; c < 4; ++c) {
            std::array<int, 3> at{};
            at[axis] = side;
            at[u] = i + (c == 1 || c == 2);
            at[v] = j + (c >= 2);
            corner[c] = welder.vertex(at, [&] { return place(at); });
          }
          if (side == 0) std::swap(corner[1], corner[3]);
          mesh.triangles.push_back({corner[0], corner[1], corner[2]});
          mesh.triangles.push_back({corner[0], corner[2], corner[3]});
        }
  }
  return mesh;
}

/// A disc of rings with 6 k vertices each, about the axis at height y: triangles stay nearly equilateral to
/// the middle. Returns the first vertex of each ring; the outermost is ring n.
std::vector<int> add_disc(TriangleMesh& mesh, double radius, double y, int n, bool upward) {
  std::vector<int> first{static_cast<int>(mesh.vertices.size())};
  mesh.vertices.push_back({0, y, 0});
  auto triangle = [&](int a, int b, int c) {
    if (upward) std::swap(b, c);
    mesh.triangles.push_back({a, b, c});
  };
  for (int k = 1; k <= n; ++k) {
    first.push_back(static_cast<int>(mesh.vertices.size()));
    for (int i = 0; i < 6 * k; ++i) {
      double angle = 2 * portable::kPi * i / (6 * k), r = radius * k / n;
      mesh.vertices.push_back({r * portable::cos(angle), y, r * portable::sin(angle)});
    }
    int inner = first[k - 1], outer = first[k], n_inner = std::max(6 * (k - 1), 1);
    for (int sector = 0; sector < 6; ++sector)
      for (int j = 0; j < k; ++j) {
        int a = inner + (sector * (k - 1) + j) % n_inner, b = outer + sector * k + j;
        int c = outer + (sector * k + j + 1) % (6 * k);
        triangle(a, b, c);
        if (j + 1 < k) triangle(a, c, inner + (sector * (k - 1) + j + 1) % n_inner);
      }
  }
  return first;
}

}  // namespace

TriangleMesh ellipsoid_mesh(const Vector3d& semi_axes) {
  // An icosahedron whose faces are cut into n^2 parts; a vertex is known by its face's corners and weights.
  const double g = 0.5 * (1 + std::sqrt(5.0));
  const std::array<Vector3d, 12> corner{{{-1, g, 0},
                                         {1, g, 0},
                                         {-1, -g, 0},
                                         {1, -g, 0},
                                         {0, -1, g},
                                         {0, 1, g},
                                         {0, -1, -g},
                                         {0, 1, -g},
                                         {g, 0, -1},
                                         {g, 0, 1},
                                         {-g, 0, -1},
                                         {-g, 0, 1}}};
  const std::array<std::array<int, 3>, 20> faces{
      {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
       {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
       {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
  TriangleMesh mesh;
  int n = parts(1.1 * semi_axes.maxCoeff(), kEdge, 6, 60);
  std::map<std::array<std::array<int, 2>, 3>, int> known;
  for (const auto& face : faces) {
    auto vertex = [&](int i, int j) {
      std::array<int, 3> w{n - i - j, i, j};
      std::array<std::array<int, 2>, 3>
          key;  // (corner, weight) by corner; a corner without weight does not count
      for (int k = 0; k < 3; ++k)
        key[k] = w[k] > 0 ? std::array<int, 2>{face[k], w[k]} : std::array<int, 2>{-1, 0};
      std::sort(key.begin(), key.end());
      auto [it, is_new] = known.try_emplace(key, static_cast<int>(mesh.vertices.size()));
      if (is_new) {
        Vector3d p = Vector3d::Zero();
        for (const auto& [c, weight] : key)
          if (weight > 0) p += weight * corner[c];
        mesh.vertices.push_back(p.normalized().cwiseProduct(semi_axes));
      }
      return it->second;
    };
    for (int i = 0; i < n; ++i)
      for (int j = 0; i + j < n; ++j) {
        mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i, j + 1)});
        if (i + j + 1 < n)
          mesh.triangles.push_back({vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
      }
  }
  return mesh;
}

TriangleMesh cylinder_mesh(double radius, double height) {
  TriangleMesh mesh;
  double rounding = std::min({kRounding, radius / 3, height / 3});
  int n = parts(radius, 0.008, 3, 80);
  int around = 6 * n;
  int bottom = add_disc(mesh, radius - rounding, 0, n, false).back();
  // Rings from the rim of the bottom to the rim of the top: half a quarter circle, the wall, half a quarter
  // circle.
  std::vector<Vector2d> profile;  // (radius, y)
  double half = rounding * std::sqrt(0.5);
  profile.push_back({radius - rounding + half, rounding - half});
  int rows = parts(height - 2 * rounding, 2 * portable::kPi * radius / around, 1, 400);
  for (int k = 0; k <= rows; ++k) profile.push_back({radius, rounding + (height - 2 * rounding) * k / rows});
  profile.push_back({radius - rounding + half, height - rounding + half});
  std::vector<int> rings{bottom};
  for (const Vector2d& p : profile) {
    rings.push_back(static_cast<int>(mesh.vertices.size()));
    for (int i = 0; i < around; ++i) {
      double angle = 2 * portable::kPi * i / around;
      mesh.vertices.push_back({p.x() * portable::cos(angle), p.y(), p.x() * portable::sin(angle)});
    }
  }
  rings.push_back(add_disc(mesh, radius - rounding, height, n, true).back());
  for (std::size_t k = 0; k + 1 < rings.size(); ++k)
    for (int i = 0; i < around; ++i) {
      int j = (i + 1) % around;
      int a = rings[k] + i, b = rings[k] + j, c = rings[k + 1] + j, d = rings[k + 1] + i;
      mesh.triangles.push_back({a, c, b});
      mesh.triangles.push_back({a, d, c});
    }
  return mesh;
}

TriangleMesh box_mesh(const Vector3d& size) {
  double edge = std::max(kEdge, size.maxCoeff() / 150);
  return rounded_box(size, std::min(kRounding, size.minCoeff() / 3), edge);
}

TriangleMesh floor_mesh() {
  TriangleMesh mesh = rounded_box({kFloorWidth, kFloorDepth, kFloorWidth}, kFloorRounding, kFloorEdge);
  for (Vector3d& p : mesh.vertices) p.y() -= 0.5 * kFloorDepth;
  return mesh;
}

double signed_volume(const TriangleMesh& mesh) {
  if (mesh.vertices.empty()) return 0;
  const Vector3d& o = mesh.vertices.front();
  double sum = 0;
  for (const auto& t : mesh.triangles)
    sum += (mesh.vertices[t[0]] - o).dot((mesh.vertices[t[1]] - o).cross(mesh.vertices[t[2]] - o));
  return sum / 6;
}

}  // namespace garment::body
