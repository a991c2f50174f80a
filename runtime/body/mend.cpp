#include "runtime/body/mend.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>

namespace garment::body {
namespace {

struct Side {
  int low, high;  ///< vertices
  int triangle;
  bool upwards;  ///< the triangle walks from `low` to `high`
  bool operator<(const Side& o) const {
    return std::tie(low, high, triangle) < std::tie(o.low, o.high, o.triangle);
  }
};

std::vector<Side> sides_of(const TriangleMesh& mesh) {
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const int a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), static_cast<int>(t), a < b});
    }
  std::sort(sides.begin(), sides.end());
  return sides;
}

/// Where the run of sides on one edge ends that begins at `begin`.
std::size_t run_end(const std::vector<Side>& sides, std::size_t begin) {
  std::size_t end = begin;
  while (end < sides.size() && sides[end].low == sides[begin].low && sides[end].high == sides[begin].high)
    ++end;
  return end;
}

struct Neighbour {
  int triangle;
  bool agrees;
};

/// Triangles that meet at an edge of two.
std::vector<std::vector<Neighbour>> neighbours_of(const TriangleMesh& mesh) {
  const std::vector<Side> sides = sides_of(mesh);
  std::vector<std::vector<Neighbour>> out(mesh.triangles.size());
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    end = run_end(sides, begin);
    if (end - begin != 2) continue;
    const bool agrees = sides[begin].upwards != sides[begin + 1].upwards;
    out[sides[begin].triangle].push_back({sides[begin + 1].triangle, agrees});
    out[sides[begin + 1].triangle].push_back({sides[begin].triangle, agrees});
  }
  return out;
}

/// Six times the signed volume under a triangle, from `about`.
double volume_under(const TriangleMesh& mesh, int t, const Vector3d& about) {
  const auto& [a, b, c] = mesh.triangles[t];
  return (mesh.vertices[a] - about).dot((mesh.vertices[b] - about).cross(mesh.vertices[c] - about));
}

std::size_t agree(TriangleMesh& mesh) {
  const auto neighbours = neighbours_of(mesh);
  std::vector<signed char> flip(mesh.triangles.size(), -1);
  std::size_t turned = 0;
  for (std::size_t seed = 0; seed < flip.size(); ++seed) {
    if (flip[seed] >= 0) continue;
    std::vector<int> component{static_cast<int>(seed)};
    flip[seed] = 0;
    const Vector3d about = mesh.vertices[mesh.triangles[seed][0]];
    double volume = 0;
    for (std::size_t k = 0; k < component.size(); ++k) {
      const int t = component[k];
      volume += (flip[t] ? -1 : 1) * volume_under(mesh, t, about);
      for (const Neighbour& n : neighbours[t])
        if (flip[n.triangle] < 0) {
          flip[n.triangle] = n.agrees ? flip[t] : static_cast<signed char>(1 - flip[t]);
          component.push_back(n.triangle);
        }
    }
    for (int t : component) {
      if ((flip[t] == 1) == (volume < 0)) continue;
      std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
      ++turned;
    }
  }
  return turned;
}

std::size_t close_rims(TriangleMesh& mesh) {
  const std::vector<Side> sides = sides_of(mesh);
  std::multimap<int, int> rim;  // walked against the triangles
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    end = run_end(sides, begin);
    if (end - begin == 1)
      rim.emplace(sides[begin].upwards ? sides[begin].high : sides[begin].low,
                  sides[begin].upwards ? sides[begin].low : sides[begin].high);
  }
  std::size_t holes = 0;
  while (!rim.empty()) {
    std::vector<int> loop;
    for (auto at = rim.begin(); at != rim.end();) {
      loop.push_back(at->first);
      const int next = at->second;
      rim.erase(at);
      at = rim.find(next);
    }
    if (loop.size() < 3) continue;
    Vector3d middle = Vector3d::Zero();
    for (int v : loop) middle += mesh.vertices[v] / static_cast<double>(loop.size());
    const int center = static_cast<int>(mesh.vertices.size());
    mesh.vertices.push_back(middle);
    for (std::size_t k = 0; k < loop.size(); ++k)
      mesh.triangles.push_back({loop[k], loop[(k + 1) % loop.size()], center});
    ++holes;
  }
  return holes;
}

}  // namespace

Mended mend(TriangleMesh& mesh) {
  Mended done;
  done.turned = agree(mesh);
  done.holes = close_rims(mesh);
  return done;
}

}  // namespace garment::body
