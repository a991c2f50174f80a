#include "runtime/body/mesh_repair.hpp"

#include <algorithm>
#include <numeric>

namespace garment::body {

int clean_mesh(TriangleMesh& mesh) {
  std::vector<int> order(mesh.vertices.size());
  std::iota(order.begin(), order.end(), 0);
  auto key = [&](int i) {
    const Vector3d& p = mesh.vertices[i];
    return std::array<double, 3>{p.x(), p.y(), p.z()};
  };
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return key(a) != key(b) ? key(a) < key(b) : a < b; });
  std::vector<int> first(order.size());  // the first vertex of the file at the same place
  for (std::size_t k = 0; k < order.size(); ++k)
    first[order[k]] = k > 0 && key(order[k]) == key(order[k - 1]) ? first[order[k - 1]] : order[k];
  std::vector<std::array<int, 3>> kept;
  for (const auto& t : mesh.triangles) {
    std::array<int, 3> c{first[t[0]], first[t[1]], first[t[2]]};
    // A thin triangle with three different corners stays: without it the surface would be open.
    if (c[0] != c[1] && c[1] != c[2] && c[2] != c[0]) kept.push_back(c);
  }
  int dropped = static_cast<int>(mesh.triangles.size() - kept.size());
  std::vector<int> renumbered(mesh.vertices.size(), -1);
  for (const auto& t : kept)
    for (int i : t) renumbered[i] = 0;
  std::vector<Vector3d> vertices;
  for (std::size_t i = 0; i < renumbered.size(); ++i)
    if (renumbered[i] == 0) {
      renumbered[i] = static_cast<int>(vertices.size());
      vertices.push_back(mesh.vertices[i]);
    }
  for (auto& t : kept)
    for (int& i : t) i = renumbered[i];
  mesh.vertices = std::move(vertices);
  mesh.triangles = std::move(kept);
  return dropped;
}

SurfaceCheck check_surface(const TriangleMesh& mesh) {
  std::vector<std::array<int, 3>> edges;  // low vertex, high vertex, direction
  edges.reserve(3 * mesh.triangles.size());
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      int a = t[k], b = t[(k + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), a < b ? 1 : -1});
    }
  std::sort(edges.begin(), edges.end());
  SurfaceCheck check;
  auto middle = [&](const std::array<int, 3>& e) -> Vector3d {
    return 0.5 * (mesh.vertices[e[0]] + mesh.vertices[e[1]]);
  };
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    int sum = 0;
    for (end = begin;
         end < edges.size() && edges[end][0] == edges[begin][0] && edges[end][1] == edges[begin][1]; ++end)
      sum += edges[end][2];
    if (end - begin > 2) ++check.crowded_edges;
    if ((end - begin) % 2 == 1) {
      if (check.open_edges++ == 0) check.place = middle(edges[begin]);
    } else if (sum != 0) {
      if (check.twisted_edges++ == 0 && check.open_edges == 0) check.place = middle(edges[begin]);
    }
  }
  return check;
}

}  // namespace garment::body
