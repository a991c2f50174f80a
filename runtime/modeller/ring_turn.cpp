#include "runtime/modeller/ring_turn.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>

#include "runtime/base/number.hpp"

namespace garment::modeller {
namespace {

using model::Index;
using model::Vector3d;

constexpr std::size_t kSamples = 64;
constexpr double kFits = 0.5;             // correlation of rings that lie to each other as they should
constexpr double kMisses = -0.25;         // correlation of flat rings a good quarter of a turn off
constexpr double kLeastPlaced = 0.5;      // of the ring
constexpr double kMeets = 0.08;           // of the ring: ends of seams that are about at one place

/// One side of a seam as a ring: its vertices, and how far along the ring each is, 0 .. 1.
struct SewnRing {
  const std::vector<Index>& vertices;
  std::vector<double> at;
  double length = 0;  ///< as cut, m
};

SewnRing ring_of(const std::vector<Index>& vertices, const model::Model& model) {
  SewnRing ring{vertices, {0}};
  for (std::size_t k = 1; k < vertices.size(); ++k) {
    const Index a = vertices[k - 1], b = vertices[k];
    // Where one link ends and the next begins, the seam goes on at the same particle.
    const bool on = model.vertex_panel[a] == model.vertex_panel[b] && model.vertex_particle[a] != model.vertex_particle[b];
    ring.length += on ? (model.vertex_uv[b] - model.vertex_uv[a]).norm() : 0;
    ring.at.push_back(ring.length);
  }
  for (double& at : ring.at) at /= ring.length;
  return ring;
}

RingPlaces sampled(const SewnRing& ring, const model::Model& model, const std::vector<bool>& done, const std::vector<Vector3d>& place) {
  RingPlaces samples;
  std::size_t k = 1;
  for (std::size_t i = 0; i < kSamples; ++i) {
    const double at = static_cast<double>(i) / kSamples;
    while (k + 1 < ring.at.size() && ring.at[k] < at) ++k;
    const Index before = ring.vertices[k - 1], after = ring.vertices[k];
    const double step = ring.at[k] - ring.at[k - 1], share = step > 0 ? std::clamp((at - ring.at[k - 1]) / step, 0.0, 1.0) : 0;
    const bool placed = done[model.vertex_panel[before]] && done[model.vertex_panel[after]];
    samples.push_back(placed ? std::optional<Vector3d>((1 - share) * place[before] + share * place[after]) : std::nullopt);
  }
  return samples;
}

/// The ring with what has no place laid straight between what has; empty where that is too little.
std::vector<Vector3d> closed(const RingPlaces& ring) {
  const std::size_t n = ring.size();
  const auto placed = static_cast<std::size_t>(std::count_if(ring.begin(), ring.end(), [](const auto& place) { return place.has_value(); }));
  if (n == 0 || static_cast<double>(placed) < kLeastPlaced * static_cast<double>(n)) return {};
  std::vector<Vector3d> points;
  for (std::size_t i = 0; i < n; ++i) {
    std::size_t back = 0, on = 0;
    while (!ring[(i + n - back) % n]) ++back;
    while (!ring[(i + on) % n]) ++on;
    const double share = back + on > 0 ? static_cast<double>(back) / static_cast<double>(back + on) : 0;
    points.push_back((1 - share) * *ring[(i + n - back) % n] + share * *ring[(i + on) % n]);
  }
  return points;
}

void bring_to_middle(std::vector<Vector3d>& points) {
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d& p : points) middle += p;
  middle /= static_cast<double>(std::max<std::size_t>(points.size(), 1));
  for (Vector3d& p : points) p -= middle;
}

double square_sum(const std::vector<Vector3d>& points) {
  double sum = 0;
  for (const Vector3d& p : points) sum += p.squaredNorm();
  return sum;
}

/// Another seam that ends on a ring.
struct SeamEnd {
  std::string name;
  double at;  ///< of the ring, 0 .. 1
};

double round_distance(double a, double b) {
  const double d = std::abs(a - b);
  return std::min(d - std::floor(d), 1 - (d - std::floor(d)));
}

/// Seams that end on this ring and whose cloth is that of the ring, not of the one that it is sewn to.
std::vector<SeamEnd> ends_on(const SewnRing& ring, const std::string& own, const model::Model& model) {
  std::set<Index> panels;
  for (Index v : ring.vertices) panels.insert(model.vertex_panel[v]);
  auto is_of_ring = [&](Index particle) {
    for (std::size_t v = 0; v < model.n_vertices(); ++v)
      if (model.vertex_particle[v] == particle && panels.contains(model.vertex_panel[v])) return true;
    return false;
  };
  std::vector<SeamEnd> ends;
  for (const model::SeamChain& chain : model.seams) {
    if (chain.name == own || chain.particles.size() < 3 || !is_of_ring(chain.particles[chain.particles.size() / 2])) continue;
    for (Index end : {chain.particles.front(), chain.particles.back()})
      for (std::size_t k = 0; k < ring.vertices.size(); ++k)
        if (model.vertex_particle[ring.vertices[k]] == end) {
          ends.push_back({chain.name, ring.at[k]});
          break;
        }
  }
  return ends;
}

const SeamEnd* nearest(const std::vector<SeamEnd>& ends, double at) {
  const auto found = std::min_element(ends.begin(), ends.end(), [&](const SeamEnd& a, const SeamEnd& b) {
    return round_distance(a.at, at) < round_distance(b.at, at);
  });
  return found == ends.end() ? nullptr : &*found;
}

/// ": `under` meets `shoulder`, and `side`, beside which it is placed, is 24 cm further on"; empty where no seams tell it.
std::string told_by_seams(const SewnRing& a, const SewnRing& b, const std::string& own, double turned, const model::Model& model) {
  const std::vector<SeamEnd> here = ends_on(a, own, model), there = ends_on(b, own, model);
  for (const SeamEnd& end : here) {
    const SeamEnd *meets = nearest(there, end.at), *wanted = nearest(there, end.at + turned);
    if (meets == nullptr || meets->name == wanted->name || round_distance(wanted->at, end.at + turned) > 2 * kMeets) continue;
    const std::string away = format_number(100 * round_distance(wanted->at, end.at) * b.length, 2) + " cm";
    if (round_distance(meets->at, end.at) < kMeets)
      return fmt::format(": `{}` meets `{}`, and `{}`, beside which it is placed, is {} away", end.name, meets->name, wanted->name, away);
    return fmt::format(": `{}` is placed beside `{}`, which is {} away", end.name, wanted->name, away);
  }
  return "";
}

}  // namespace

RingTurn ring_turn(const RingPlaces& a, const RingPlaces& b) {
  std::vector<Vector3d> p = closed(a), q = closed(b);
  bring_to_middle(p);
  bring_to_middle(q);
  const double size = std::sqrt(square_sum(p) * square_sum(q));
  RingTurn found;
  if (!(size > 0)) return found;
  const std::size_t n = p.size();
  for (std::size_t turn = 0; turn < n; ++turn) {
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) sum += p[i].dot(q[(i + turn) % n]);
    const double fit = sum / size;
    if (turn == 0) found.sewn = found.best = fit;
    if (fit > found.best) found.best = fit, found.turned = static_cast<double>(turn) / static_cast<double>(n);
  }
  return found;
}

Findings turned_rings(const std::vector<SewnSides>& sides, const model::Model& model, const std::vector<bool>& done,
                      const std::vector<Vector3d>& place) {
  Findings findings;
  for (const SewnSides& sewn : sides) {
    if (!sewn.seam->rings) continue;
    if (std::any_of(sewn.side.begin(), sewn.side.end(), [](const std::vector<Index>& side) { return side.size() < 4; })) continue;
    const SewnRing last = ring_of(sewn.side.back(), model);
    for (std::size_t s = 0; s + 1 < sewn.side.size(); ++s) {
      const SewnRing ring = ring_of(sewn.side[s], model);
      if (!(ring.length > 0) || !(last.length > 0)) continue;
      const RingTurn turn = ring_turn(sampled(ring, model, done, place), sampled(last, model, done, place));
      if (turn.sewn > kMisses || turn.best < kFits) continue;
      findings.push_back({"G0552",
                          Severity::warning,
                          fmt::format("seam `{}` joins two rings {}% of the way round from how they are placed{}", sewn.seam->name,
                                      format_number(100 * std::min(turn.turned, 1 - turn.turned), 2),
                                      told_by_seams(ring, last, sewn.seam->name, turn.turned, model)),
                          {{sewn.seam->origin, ""}},
                          "let both rings begin at places that belong together: exchange the links of one side (`b + a` for `a + b`), or name "
                          "the seam or notch in `start at`"});
      break;
    }
  }
  return findings;
}

}  // namespace garment::modeller
