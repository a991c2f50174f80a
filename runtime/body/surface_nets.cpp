#include "runtime/body/surface_nets.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/base/parallel.hpp"

namespace garment::body {
namespace {

constexpr int kBlock = 5;             // corners along the edge of a block that is skipped or evaluated as one
constexpr int kSmoothing = 6;         // rounds
constexpr double kDifference = 1e-4;  // m, of the gradient's differences

/// The corners of all cubes, x fastest. The first cubes lie astride the plane x = 0, so that the surface
/// meets the plane in vertices and never in the middle of a quad.
struct Grid {
  std::array<int, 3> n;  // corners
  Vector3d origin;
  double cell;
  std::vector<double> value;

  std::size_t at(int i, int j, int k) const { return (static_cast<std::size_t>(k) * n[1] + j) * n[0] + i; }
  Vector3d corner(int i, int j, int k) const { return origin + cell * Vector3d(i, j, k); }
};

double sample(const Field& field, Vector3d p) {
  p.x() = std::fabs(p.x());
  return field(p);
}

/// Values at all corners near the surface; elsewhere only the sign is right.
void fill(Grid& grid, const Field& field) {
  std::array<int, 3> blocks;
  for (int k = 0; k < 3; ++k) blocks[k] = (grid.n[k] + kBlock - 1) / kBlock;
  std::size_t n_blocks = static_cast<std::size_t>(blocks[0]) * blocks[1] * blocks[2];
  double reach = 2 * 0.5 * std::sqrt(3.0) * grid.cell * (kBlock + 1);
  parallel_for(n_blocks, 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      std::array<int, 3> first{static_cast<int>(b % blocks[0]) * kBlock,
                               static_cast<int>(b / blocks[0] % blocks[1]) * kBlock,
                               static_cast<int>(b / blocks[0] / blocks[1]) * kBlock};
      double middle = sample(field, grid.origin + grid.cell * (Vector3d(first[0], first[1], first[2]) +
                                                               Vector3d::Constant(0.5 * (kBlock - 1))));
      for (int k = first[2]; k < std::min(first[2] + kBlock, grid.n[2]); ++k)
        for (int j = first[1]; j < std::min(first[1] + kBlock, grid.n[1]); ++j)
          for (int i = first[0]; i < std::min(first[0] + kBlock, grid.n[0]); ++i)
            grid.value[grid.at(i, j, k)] =
                std::fabs(middle) > reach ? middle : sample(field, grid.corner(i, j, k));
    }
  });
}

/// The twelve edges of a cube: along `axis`, at (u, w) on the two axes that follow it cyclically.
int edge_index(int axis, int u, int w) { return 4 * axis + u + 2 * w; }

/// The cube's corner values cut into sheets: edges of the cube that the same sheet crosses carry the same
/// number. Following the crossed edges from face to face gives closed rings, one a sheet; where the four
/// corners of a face alternate, the sign of the bilinear saddle says which edges belong together, for both
/// cubes of the face alike (Nielson 2004, "Dual marching cubes"). One vertex a sheet keeps the mesh from
/// touching itself.
int find_sheets(const std::array<double, 8>& v, std::array<int, 12>& sheet) {
  std::array<std::array<int, 2>, 12> link;
  link.fill({-1, -1});
  auto join = [&](int e, int f) {
    link[e][link[e][0] >= 0] = f;
    link[f][link[f][0] >= 0] = e;
  };
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side) {
      int u = (axis + 1) % 3, w = (axis + 2) % 3;
      auto value = [&](int a, int b) { return v[(side << axis) | (a << u) | (b << w)]; };
      // Edges of the face in the order round it: along u at w = 0, along w at u = 1, along u at w = 1, along
      // w at u = 0.
      std::array<int, 4> edge{edge_index(u, 0, side), edge_index(w, side, 1), edge_index(u, 1, side),
                              edge_index(w, side, 0)};
      std::array<double, 4> corner{value(0, 0), value(1, 0), value(1, 1), value(0, 1)};
      std::array<int, 4> crossed{};
      int n = 0;
      for (int k = 0; k < 4; ++k)
        if ((corner[k] < 0) != (corner[(k + 1) % 4] < 0)) crossed[n++] = edge[k];
      if (n == 2) join(crossed[0], crossed[1]);
      if (n == 4) {
        // Corner k lies between edges k - 1 and k. A saddle inside the body joins the two inner corners.
        bool saddle_inside = (corner[0] * corner[2] - corner[1] * corner[3] < 0) ==
                             (corner[0] + corner[2] > corner[1] + corner[3]);
        bool cut_even = (corner[0] < 0) != saddle_inside;  // the corners 0 and 2 are cut off
        int shift = cut_even ? 3 : 0;
        join(edge[shift], edge[(shift + 1) % 4]);
        join(edge[(shift + 2) % 4], edge[(shift + 3) % 4]);
      }
    }
  sheet.fill(-1);
  int n_sheets = 0;
  for (int e = 0; e < 12; ++e) {
    if (link[e][0] < 0 || sheet[e] >= 0) continue;
    for (int at = e, from = -1; sheet[at] < 0;) {
      sheet[at] = n_sheets;
      int next = link[at][0] == from && link[at][1] >= 0 ? link[at][1] : link[at][0];
      from = at;
      at = next;
    }
    ++n_sheets;
  }
  return n_sheets;
}

/// Vertices by cube and crossed edge.
struct CubeVertices {
  std::vector<int> first;  ///< [cubes]: vertex of the only sheet, or ~k for `several[k]`, or kNone
  std::vector<std::array<int, 12>> several;  ///< vertex by edge
  static constexpr int kNone = 1 << 30;

  int at(std::size_t cube, int edge) const {
    return first[cube] >= 0 ? first[cube] : several[~first[cube]][edge];
  }
};

/// One vertex a sheet in the middle of its crossings.
CubeVertices place_vertices(const Grid& grid, HalfSurface& half) {
  CubeVertices vertices{std::vector<int>(grid.value.size(), CubeVertices::kNone), {}};
  for (int k = 0; k + 1 < grid.n[2]; ++k)
    for (int j = 0; j + 1 < grid.n[1]; ++j)
      for (int i = 0; i + 1 < grid.n[0]; ++i) {
        std::array<double, 8> v;
        int inside = 0;
        for (int c = 0; c < 8; ++c) {
          v[c] = grid.value[grid.at(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2))];
          inside += v[c] < 0;
        }
        if (inside == 0 || inside == 8) continue;
        std::array<int, 12> sheet;
        int n_sheets = find_sheets(v, sheet), base = static_cast<int>(half.vertices.size());
        std::array<Vector3d, 4> sum;
        std::array<int, 4> crossings{};
        sum.fill(Vector3d::Zero());
        for (int axis = 0; axis < 3; ++axis)
          for (int bits = 0; bits < 4; ++bits) {
            int s = sheet[edge_index(axis, bits & 1, bits >> 1)];
            if (s < 0) continue;
            Vector3d p = Vector3d::Zero();
            p[(axis + 1) % 3] = bits & 1;
            p[(axis + 2) % 3] = bits >> 1;
            int c = (bits & 1) << (axis + 1) % 3 | (bits >> 1) << (axis + 2) % 3, d = c | 1 << axis;
            p[axis] = v[c] / (v[c] - v[d]);
            sum[s] += p;
            ++crossings[s];
          }
        for (int s = 0; s < n_sheets; ++s) {
          Vector3d p = grid.corner(i, j, k) + grid.cell * (sum[s] / crossings[s]);
          if (i == 0) p.x() = 0;
          half.vertices.push_back(p);
        }
        int& first = vertices.first[grid.at(i, j, k)];
        first = base;
        if (n_sheets > 1) {
          first = ~static_cast<int>(vertices.several.size());
          for (int& s : sheet) s = s >= 0 ? base + s : -1;
          vertices.several.push_back(sheet);
        }
      }
  return vertices;
}

/// A quad round every edge of the grid that the surface crosses.
void add_quads(const Grid& grid, const CubeVertices& vertices, HalfSurface& half) {
  for (int k = 1; k + 1 < grid.n[2]; ++k)
    for (int j = 1; j + 1 < grid.n[1]; ++j)
      for (int i = 1; i + 1 < grid.n[0]; ++i)
        for (int axis = 0; axis < 3; ++axis) {
          std::array<int, 3> a{i, j, k}, b = a;
          ++b[axis];
          bool inside_a = grid.value[grid.at(a[0], a[1], a[2])] < 0,
               inside_b = grid.value[grid.at(b[0], b[1], b[2])] < 0;
          if (inside_a == inside_b) continue;
          int u = (axis + 1) % 3, w = (axis + 2) % 3;
          auto cube = [&](int du, int dw) {
            std::array<int, 3> c = a;
            c[u] -= du;
            c[w] -= dw;
            return vertices.at(grid.at(c[0], c[1], c[2]), edge_index(axis, du, dw));
          };
          std::array<int, 4> quad{cube(1, 1), cube(0, 1), cube(0, 0), cube(1, 0)};
          if (inside_b) std::swap(quad[1], quad[3]);
          half.quads.push_back(quad);
        }
}

Vector3d gradient(const Field& field, const Vector3d& p, double value) {
  Vector3d g;
  for (int k = 0; k < 3; ++k) {
    Vector3d q = p;
    q[k] += kDifference;
    g[k] = (sample(field, q) - value) / kDifference;
  }
  return g;
}

/// Even spacing: every vertex goes halfway to the mean of its neighbours, within the surface only.
void smooth(HalfSurface& half, const Field& field) {
  std::size_t n = half.vertices.size();
  std::vector<std::array<int, 2>> links;
  for (const auto& q : half.quads)
    for (int c = 0; c < 4; ++c) {
      links.push_back({q[c], q[(c + 1) % 4]});
      links.push_back({q[(c + 1) % 4], q[c]});
    }
  std::sort(links.begin(), links.end());
  links.erase(std::unique(links.begin(), links.end()), links.end());
  std::vector<std::size_t> first(n + 1, links.size());
  for (std::size_t l = links.size(); l-- > 0;) first[links[l][0]] = l;
  for (std::size_t i = n; i-- > 0;) first[i] = std::min(first[i], first[i + 1]);
  for (int round = 0; round < kSmoothing; ++round) {
    std::vector<Vector3d> moved(n);
    parallel_for(n, 512, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const Vector3d& p = half.vertices[i];
        moved[i] = p;
        if (first[i] == first[i + 1]) continue;
        Vector3d mean = Vector3d::Zero();
        double weight = 0;
        for (std::size_t l = first[i]; l < first[i + 1]; ++l) {
          const Vector3d& q = half.vertices[links[l][1]];
          // On the plane of symmetry the other side has the same neighbours, mirrored.
          double w = p.x() == 0 && q.x() > 0 ? 2 : 1;
          mean += w * (p.x() == 0 ? Vector3d(0, q.y(), q.z()) : q);
          weight += w;
        }
        Vector3d step = 0.5 * (mean / weight - p);
        Vector3d normal = gradient(field, p, sample(field, p));
        normal.x() = p.x() == 0 ? 0 : normal.x();
        if (normal.norm() > 0) step -= step.dot(normal) / normal.squaredNorm() * normal;
        moved[i] = p + step;
      }
    });
    half.vertices = std::move(moved);
    project(half, field, 1);
  }
}

}  // namespace

void project(HalfSurface& half, const Field& field, int steps) {
  constexpr double kLongest = 0.01;  // m, of one step: far from the surface the gradient may mislead
  parallel_for(half.vertices.size(), 512, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Vector3d& p = half.vertices[i];
      bool on_plane = p.x() == 0;
      for (int step = 0; step < steps; ++step) {
        double value = sample(field, p);
        Vector3d g = gradient(field, p, value);
        if (on_plane) g.x() = 0;
        if (!(g.squaredNorm() > 1e-4)) break;
        Vector3d move = -value / g.squaredNorm() * g;
        if (move.norm() > kLongest) move *= kLongest / move.norm();
        p += move;
        if (!on_plane) p.x() = std::max(p.x(), 1e-5);  // the halves must not pass through each other
      }
    }
  });
}

HalfSurface surface_nets(const Field& field, double low_y, double low_z, const Vector3d& high, double cell) {
  Grid grid;
  grid.cell = cell;
  grid.origin = {-0.5 * cell, low_y, low_z};
  for (int k = 0; k < 3; ++k) grid.n[k] = static_cast<int>((high[k] - grid.origin[k]) / cell) + 2;
  grid.value.assign(static_cast<std::size_t>(grid.n[0]) * grid.n[1] * grid.n[2], 1);
  fill(grid, field);
  HalfSurface half;
  CubeVertices vertices = place_vertices(grid, half);
  add_quads(grid, vertices, half);
  project(half, field, 2);
  smooth(half, field);
  project(half, field, 2);
  return half;
}

TriangleMesh mirror(const HalfSurface& half) {
  TriangleMesh mesh;
  mesh.vertices = half.vertices;
  std::vector<int> twin(half.vertices.size());
  for (std::size_t i = 0; i < twin.size(); ++i) {
    const Vector3d& p = half.vertices[i];
    twin[i] = static_cast<int>(p.x() == 0 ? i : mesh.vertices.size());
    if (p.x() != 0) mesh.vertices.push_back({-p.x(), p.y(), p.z()});
  }
  for (std::array<int, 4> q : half.quads) {
    auto length2 = [&](int a, int b) { return (half.vertices[q[a]] - half.vertices[q[b]]).squaredNorm(); };
    if (length2(1, 3) < length2(0, 2)) std::rotate(q.begin(), q.begin() + 1, q.end());
    for (const std::array<int, 3>& t :
         {std::array<int, 3>{q[0], q[1], q[2]}, std::array<int, 3>{q[0], q[2], q[3]}}) {
      mesh.triangles.push_back(t);
      mesh.triangles.push_back({twin[t[0]], twin[t[2]], twin[t[1]]});
    }
  }
  return mesh;
}

}  // namespace garment::body
