#include "runtime/modeller/mesh_quality.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace garment::modeller {

double least_sine(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  double area2 = (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
  double ab = (b - a).norm(), bc = (c - b).norm(), ca = (a - c).norm();
  return area2 /
         std::max({ab * bc, bc * ca, ca * ab, 1e-300});  // the smallest angle lies between the longest sides
}

void open_ears(LoopMesh& mesh, const LoopBorder& border) {
  constexpr double kLeastSine = 0.35;  // about 20 deg
  int n = static_cast<int>(border.next.size());
  auto on_loop = [&](int u, int v) { return u < n && v == border.next[u]; };
  std::set<std::array<int, 2>> lines;
  for (const auto& [a, b] : border.lines) lines.insert({{a, b}, {b, a}});
  std::map<std::array<int, 2>, std::size_t> side;  // directed side -> triangle
  for (std::size_t t = 0; t < mesh.cut.size(); ++t)
    for (int k = 0; k < 3; ++k) side[{mesh.cut[t][k], mesh.cut[t][(k + 1) % 3]}] = t;
  for (std::size_t t = 0; t < mesh.cut.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      int a = mesh.cut[t][k], b = mesh.cut[t][(k + 1) % 3], c = mesh.cut[t][(k + 2) % 3];
      if (!on_loop(a, b) || !on_loop(b, c) || lines.count({a, c}) > 0) continue;  // b is the ear's corner
      auto beyond = side.find({a, c});
      if (beyond == side.end()) break;
      std::size_t u = beyond->second;
      int d = -1;
      for (int v : mesh.cut[u])
        if (v != a && v != c) d = v;
      double now = std::min(least_sine(mesh.at[a], mesh.at[b], mesh.at[c]),
                            least_sine(mesh.at[a], mesh.at[c], mesh.at[d]));
      double then = std::min(least_sine(mesh.at[a], mesh.at[b], mesh.at[d]),
                             least_sine(mesh.at[b], mesh.at[c], mesh.at[d]));
      if (then < std::min(kLeastSine, 0.5 * now)) break;
      mesh.cut[t] = {a, b, d};
      mesh.cut[u] = {b, c, d};
      side.erase({c, a});
      side.erase({a, c});
      side[{a, b}] = side[{b, d}] = side[{d, a}] = t;
      side[{b, c}] = side[{c, d}] = side[{d, b}] = u;
      break;
    }
  }
}

}  // namespace garment::modeller
