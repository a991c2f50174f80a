#include "runtime/simulator/approach.hpp"

#include <algorithm>

#include "runtime/simulator/cloth_contact.hpp"
#include "runtime/simulator/kept_candidates.hpp"
#include "runtime/simulator/truncate.hpp"
#include "runtime/simulator/untangle.hpp"

namespace garment::simulator {
namespace {

using model::Vector3d;
using Vectors = std::vector<Vector3d>;

constexpr int kMostStrides = 50;
constexpr double kArrived = 1e-5;  // m

double largest(const Vectors& v) {
  double best = 0;
  for (const Vector3d& d : v) best = std::max(best, d.squaredNorm());
  return std::sqrt(best);
}

}  // namespace

Vectors approach(const model::Model& model, const Vectors& from, const Vectors& to) {
  const double spacing = mean_edge(model);
  const ContactMesh mesh(model, no_bodies(), ContactOptions{});
  KeptCandidates candidates(mesh, spacing);
  Tangle tangle = find_tangle(mesh, no_bodies(), from);
  Vectors x = from, way(x.size());
  for (int stride = 0; stride < kMostStrides; ++stride) {
    for (std::size_t i = 0; i < x.size(); ++i) way[i] = to[i] - x[i];
    const double far = largest(way);
    const double share = std::min(1.0, spacing / std::max(far, 1e-12));
    for (Vector3d& d : way) d *= share;
    if (candidates.refresh(x) && !tangle.empty()) {
      tangle = find_tangle(mesh, no_bodies(), x);
      candidates.list().exempt(mesh, tangle);
    }
    const Vectors whole = way;
    if (truncate(mesh, candidates.list(), x, way).out_of_reach > 0) {
      candidates.renew(x);
      if (!tangle.empty()) candidates.list().exempt(mesh, tangle = find_tangle(mesh, no_bodies(), x));
      way = whole;
      truncate(mesh, candidates.list(), x, way);
    }
    const double went = largest(way);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += way[i];
    if (went < kArrived) break;
  }
  return x;
}

}  // namespace garment::simulator
