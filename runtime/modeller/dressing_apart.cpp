// Cloth that crosses cloth at the start is smoothed until it does not.
#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <utility>

#include "runtime/geometry/self_crossings.hpp"
#include "runtime/modeller/clearing.hpp"
#include "runtime/modeller/dressing.hpp"

namespace garment::modeller {
namespace {

using Eigen::Vector3d;
using geometry::SelfCrossings;
using model::Index;

constexpr int kMostRounds = 40;
constexpr int kMostFruitless = 12;      // rounds without fewer crossings, after which it is given up
constexpr int kLeastRings = 2;          // of particles round a crossing that are smoothed
constexpr int kRoundsARing = 4;         // after which the neighbourhood grows by one ring
constexpr int kSmoothings = 6;          // Jacobi sweeps of a round
constexpr int kWidenings = 2;           // after each of them
constexpr double kKeptLength = 0.7;    // that edges keep in the first round, of their length at rest
constexpr double kRoundsOfLength = 24;  // over which that falls to nothing: what does not come apart otherwise may shrink
constexpr double kNoLength = 1e-9;      // m, an edge without a direction
constexpr double kHardlyShort = 0.01;   // of its length
constexpr std::size_t kMostPairs = 20'000;

/// Triangles of the panels that are not left out, by vertices and by particles.
struct Surface {
  std::vector<model::Indices<3>> vertices, particles;

  Surface(const model::Model& model, const std::vector<bool>& left_out) {
    for (std::size_t t = 0; t < model.n_triangles(); ++t) {
      if (left_out[model.triangle_panel[t]]) continue;
      vertices.push_back(model.triangle[t]);
      particles.push_back(model.corners(t));
    }
  }
  SelfCrossings crossings(const std::vector<Vector3d>& x) const { return geometry::self_crossings(particles, x, kMostPairs); }
};

class Smoothing {
 public:
  Smoothing(const model::Model& model, const Surface& surface) : surface_(surface), neighbours_(model.n_particles()) {
    std::map<std::array<Index, 2>, Edge> edges;
    for (std::size_t t = 0; t < surface.particles.size(); ++t)
      for (int k = 0; k < 3; ++k) {
        const Index i = surface.particles[t][k], j = surface.particles[t][(k + 1) % 3];
        if (i == j) continue;
        const Index v = surface.vertices[t][k], w = surface.vertices[t][(k + 1) % 3];
        Edge& edge = edges[{std::min(i, j), std::max(i, j)}];
        ++edge.triangles;
        edge.rest = std::min(edge.rest, (model.vertex_uv[v] - model.vertex_uv[w]).norm());
      }
    std::vector<std::vector<Index>> border(neighbours_.size());
    rest_.resize(neighbours_.size());
    for (const auto& [ends, edge] : edges)
      for (auto [i, j] : {std::pair{ends[0], ends[1]}, std::pair{ends[1], ends[0]}}) {
        neighbours_[i].push_back(j);
        rest_[i].push_back(edge.rest);
        if (edge.triangles == 1) border[i].push_back(j);
      }
    // A particle at a free border follows the border: the mean of all its neighbours lies inside the cloth.
    followed_ = neighbours_;
    for (std::size_t i = 0; i < border.size(); ++i)
      if (border[i].size() > 1) followed_[i] = std::move(border[i]);
  }

  /// Particles of triangles that cross, and those at most `rings` edges away.
  std::vector<Index> around(const SelfCrossings& crossings, int rings) const {
    std::vector<int> ring(neighbours_.size(), -1);
    std::vector<Index> found;
    for (const geometry::TrianglePair& pair : crossings.pairs)
      for (std::int32_t t : {pair.first, pair.second})
        for (Index i : surface_.particles[t])
          if (ring[i] < 0) ring[i] = 0, found.push_back(i);
    for (std::size_t k = 0; k < found.size(); ++k) {
      if (ring[found[k]] >= rings) continue;
      for (Index j : neighbours_[found[k]])
        if (ring[j] < 0) ring[j] = ring[found[k]] + 1, found.push_back(j);
    }
    return found;
  }

  /// Brings each of the particles halfway to the mean of its neighbours, some times. Edges that get shorter than `least` of
  /// their length at rest are widened, so that borders do not draw together.
  void smooth(const std::vector<Index>& particles, double least, std::vector<Vector3d>& x) const {
    for (int sweep = 0; sweep < kSmoothings; ++sweep) {
      move(particles, x, [&](Index i) {
        Vector3d mean = Vector3d::Zero();
        for (Index j : followed_[i]) mean += x[j];
        return Vector3d(0.5 * (mean / static_cast<double>(followed_[i].size()) - x[i]));
      });
      for (int k = 0; k < kWidenings; ++k) move(particles, x, [&](Index i) { return widening(i, least, x); });
    }
  }

 private:
  struct Edge {
    int triangles = 0;
    double rest = std::numeric_limits<double>::infinity();  ///< m, the least of its panels
  };

  /// Adds `step(i)` to all of the particles at once.
  template <class Step>
  static void move(const std::vector<Index>& particles, std::vector<Vector3d>& x, const Step& step) {
    std::vector<Vector3d> steps(particles.size());
    for (std::size_t k = 0; k < particles.size(); ++k) steps[k] = step(particles[k]);
    for (std::size_t k = 0; k < particles.size(); ++k) x[particles[k]] += steps[k];
  }

  /// The mean of what its short edges ask for; edges that are hardly short count less, so that it does not jump.
  Vector3d widening(Index i, double least, const std::vector<Vector3d>& x) const {
    Vector3d sum = Vector3d::Zero();
    double weights = 0;
    for (std::size_t e = 0; e < neighbours_[i].size(); ++e) {
      const Vector3d edge = x[i] - x[neighbours_[i][e]];
      const double length = edge.norm(), wanted = least * rest_[i][e];
      if (length >= wanted || length < kNoLength) continue;
      const double weight = std::min(1.0, (wanted / length - 1) / kHardlyShort);
      sum += weight * 0.5 * (wanted / length - 1) * edge;
      weights += weight;
    }
    return weights > 0 ? Vector3d(sum / weights) : sum;
  }

  const Surface& surface_;
  std::vector<std::vector<Index>> neighbours_, followed_;  ///< of each particle: all, and those whose mean it is brought to
  std::vector<std::vector<double>> rest_;                  ///< lengths of the edges to the neighbours, m
};

}  // namespace

bool crosses(const model::Model& model, const std::vector<bool>& left_out) {
  return Surface(model, left_out).crossings(model.start).count > 0;
}

std::size_t take_apart(const std::vector<body::Body>& bodies, const std::vector<bool>& left_out, model::Model& model) {
  const Surface surface(model, left_out);
  SelfCrossings crossings = surface.crossings(model.start);
  if (crossings.count == 0) return 0;
  const Smoothing smoothing(model, surface);
  std::vector<Clearing> clearings;
  for (const body::Body& b : bodies)
    if (!b.mesh.triangles.empty()) clearings.emplace_back(b, model);
  // Places that nothing could free before, in the folds of a collar say, must not keep all else from coming apart.
  const std::vector<Vector3d> as_placed = model.start;
  std::size_t least_pierced = 0;
  for (Clearing& clearing : clearings) least_pierced += clearing.go();
  model.start = as_placed;
  std::size_t fewest = crossings.count;
  std::vector<Vector3d> best = model.start;
  for (int round = 0, fruitless = 0; fewest > 0 && round < kMostRounds && fruitless < kMostFruitless; ++round) {
    const std::vector<Index> particles = smoothing.around(crossings, kLeastRings + round / kRoundsARing);
    smoothing.smooth(particles, kKeptLength * std::max(0.0, 1 - round / kRoundsOfLength), model.start);
    for (Index i : particles) drop_last_bits(model.start[i]);
    std::size_t pierced = 0;
    for (Clearing& clearing : clearings) pierced += clearing.go();
    crossings = surface.crossings(model.start);
    ++fruitless;
    if (pierced > least_pierced || crossings.count >= fewest) continue;
    fewest = crossings.count;
    best = model.start;
    fruitless = 0;
  }
  model.start = std::move(best);
  return fewest;
}

}  // namespace garment::modeller
