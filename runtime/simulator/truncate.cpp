#include "runtime/simulator/truncate.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "runtime/base/parallel.hpp"
#include "runtime/simulator/closest_point.hpp"
#include "runtime/simulator/relative_motion.hpp"

namespace garment::simulator {
namespace {

constexpr double kLeastGap = 1e-8;  // m: gaps below do not close further; far above all rounding errors here
constexpr double kLeastShareOfGap = 0.1;  // share of a gap that each side has at least
constexpr int kRounds = 8;          // after which a wall that leaves a particle behind stands
constexpr int kMostRounds = 40;      // after which all do
constexpr int kSearches = 4;        // for pairs that the cut ones may meet, before walls stand between all that may ever meet
constexpr int kWallSweeps = 4;          // over the walls of a particle before its displacement shrinks as a whole

/// A plane between two parts, in its two sides. It moves along its normal n by `motion` during the step, and a particle i of
/// the first side keeps n . d_i >= motion - room_i, one of the second n . d_i <= motion + room_i: then the sides stay apart.
struct Wall {
  Vector3d normal{0, 0, 0};
  Indices<4> particle{-1, -1, -1, -1};  ///< -1: does not move (of a body)
  std::array<float, 4> room{};          ///< m, what a particle may use of its distance to the wall
  int n_first = 0, n = 0;
  double motion = 0;  ///< m
  double gap = 0;     ///< m
  bool stands = false;  ///< does not move any more, whatever its particles wish

  double sign(int k) const { return k < n_first ? -1 : 1; }
  /// How much farther towards the wall than allowed `d` takes its particle k, m.
  double excess(int k, const Vector3d& d) const { return sign(k) * (normal.dot(d) - motion) - room[k]; }
  /// Whether the wall comes on to particle k faster than its room bears: it has to go on before it.
  bool drives(int k) const { return room[k] + sign(k) * motion < 0; }
};

/// How far the nearer of each side's particles go along the normal: the least of the first side, the most of the second.
struct Sweep {
  double first = std::numeric_limits<double>::infinity(), second = -std::numeric_limits<double>::infinity();
  Sweep(const Wall& wall, const std::vector<Vector3d>& dx) {
    for (int k = 0; k < wall.n; ++k) {
      const double along = wall.particle[k] < 0 ? 0 : wall.normal.dot(dx[wall.particle[k]]);
      if (k < wall.n_first)
        first = std::min(first, along);
      else
        second = std::max(second, along);
    }
  }
};

/// The wall goes as far as both sides do, or the slower of them: parts that move together are free, however near they are,
/// and nobody is driven farther than it wishes. Where they go against each other it stands.
double common_motion(const Wall& wall, const std::vector<Vector3d>& dx) {
  if (wall.stands) return 0;
  const Sweep go(wall, dx);
  return std::max(std::min(go.first, go.second), std::min(std::max(go.first, go.second), 0.0));
}

/// Puts the wall, which stands midway, where the sides would meet, so that one that only waits leaves its room to the other.
void divide(Wall& wall, double fraction, const std::vector<Vector3d>& dx) {
  const Sweep go(wall, dx);
  wall.motion = common_motion(wall, dx);
  const double first = std::max(0.0, wall.motion - go.first), second = std::max(0.0, go.second - wall.motion);
  if (first + second <= 0) return;
  const double share = std::clamp(first / (first + second), kLeastShareOfGap, 1 - kLeastShareOfGap);  // of the gap, for the first side
  const auto shift = static_cast<float>(fraction * (share - 0.5) * wall.gap * (1 - 1e-6));
  for (int k = 0; k < wall.n; ++k) wall.room[k] = std::max(0.0F, wall.room[k] + (k < wall.n_first ? shift : -shift));
}

class WallFinder {
 public:
  WallFinder(const ContactMesh& mesh, const std::vector<Vector3d>& x, const std::vector<Vector3d>& dx,
             const std::vector<float>& length, double fraction, std::vector<Wall>& out)
      : mesh_(mesh), x_(x), dx_(dx), length_(length), fraction_(fraction), out_(out) {}

  void vt(Index v, Index t) {
    const Indices<3>& c = mesh_.triangle[t];
    const Vector3d &p = at(v), &a = at(c[0]), &b = at(c[1]), &d = at(c[2]);
    const TrianglePoint s = closest_on_triangle(p, a, b, d);
    const Vector3d q = s.weights[0] * a + s.weights[1] * b + s.weights[2] * d;
    const Vector3d motion =
        move(v) - s.weights[0] * move(c[0]) - s.weights[1] * move(c[1]) - s.weights[2] * move(c[2]);
    const Index first[1] = {v};
    walls(p, q, (b - a).cross(d - a), mesh_.is_body(c[0]), motion, first, c);
  }

  void ee(Index e, Index f) {
    const Indices<2>&i = mesh_.edge[e], &j = mesh_.edge[f];
    const Vector3d &a = at(i[0]), &b = at(i[1]), &c = at(j[0]), &d = at(j[1]);
    const SegmentPair s = closest_of_segments(a, b, c, d);
    const Vector3d p = a + s.s * (b - a), q = c + s.t * (d - c);
    const Vector3d motion =
        (1 - s.s) * move(i[0]) + s.s * move(i[1]) - (1 - s.t) * move(j[0]) - s.t * move(j[1]);
    walls(p, q, (b - a).cross(d - c), false, motion, i, j);
  }

 private:
  const Vector3d& at(Index point) const { return mesh_.at(x_, point); }
  Vector3d move(Index point) const { return mesh_.is_body(point) ? Vector3d::Zero() : dx_[point]; }

  /// p, q: closest points of the first and the second part. When they coincide, `without_gap` is the wall's
  /// normal: towards the first part if `oriented`, else the side to which they are going to part.
  template <class First, class Second>
  void walls(const Vector3d& p, const Vector3d& q, const Vector3d& without_gap, bool oriented,
             const Vector3d& motion, const First& first, const Second& second) {
    Vector3d normal = p - q;
    double gap = normal.norm();
    const bool gap_known = gap >= kZeroGap;
    if (!gap_known) {
      gap = without_gap.norm();
      normal = gap > 0 ? without_gap : Vector3d(0, 1, 0);
      if (gap <= 0) gap = 1;
      if (!oriented && normal.dot(motion) < 0) normal = -normal;
    }
    normal /= gap;
    const bool first_moves = !mesh_.is_body(first[0]), second_moves = !mesh_.is_body(second[0]);
    const Vector3d at_rest = !first_moves ? p : (second_moves ? Vector3d(0.5 * (p + q)) : q);
    Wall wall;
    wall.normal = normal;
    bool near = false;
    for (Index i : first) near |= add(wall, first_moves ? i : -1, normal.dot(at(i) - at_rest));
    wall.n_first = wall.n;
    for (Index i : second) near |= add(wall, second_moves ? i : -1, normal.dot(at_rest - at(i)));
    if (!near) return;
    wall.gap = first_moves && second_moves && gap_known ? std::max(0.0, gap - 2 * kLeastGap) : 0;
    out_.push_back(wall);
  }

  /// True where the particle's displacement is long enough to reach the wall.
  bool add(Wall& wall, Index particle, double distance) const {
    const double room = fraction_ * std::max(0.0, distance - kLeastGap);
    wall.particle[wall.n] = particle;
    wall.room[wall.n++] = static_cast<float>(room * (1 - 1e-6));
    return particle >= 0 && length_[particle] > room;
  }

  const ContactMesh& mesh_;
  const std::vector<Vector3d>& x_;
  const std::vector<Vector3d>& dx_;
  const std::vector<float>& length_;
  double fraction_;
  std::vector<Wall>& out_;
};

/// Lengths of displacements, rounded up, m.
std::vector<float> lengths(const std::vector<Vector3d>& dx) {
  std::vector<float> out(dx.size());
  for (std::size_t i = 0; i < dx.size(); ++i) out[i] = static_cast<float>(dx[i].norm() * (1 + 1e-6));
  return out;
}

/// How far the parts of a pair go towards each other at most, whatever shortens the way of the one or the other.
float summed_length(const ContactMesh& mesh, const Pair& pair, PairKind kind, const std::vector<float>& length) {
  auto longest = [&](const auto& points) {
    float most = 0;
    for (Index p : points)
      if (!mesh.is_body(p)) most = std::max(most, length[p]);
    return most;
  };
  if (is_vt(kind)) return longest(Indices<1>{pair.a}) + longest(mesh.triangle[pair.b]);
  return longest(mesh.edge[pair.a]) + longest(mesh.edge[pair.b]);
}

/// Walls between the pairs without one that dx may bring together, or with `length` those that any ways no longer than these
/// may. Marks these pairs in `walled`.
std::size_t add_walls(const ContactMesh& mesh, const Candidates& candidates, const std::vector<Vector3d>& x,
                      const std::vector<Vector3d>& dx, bool however_cut, double fraction, std::vector<char>& walled,
                      std::vector<Wall>& walls) {
  const RelativeMotion moved(candidates.reference(), x, however_cut ? nullptr : &dx);
  const std::vector<float> length = lengths(dx);
  const std::vector<Pair>& pairs = candidates.pairs();
  std::vector<std::vector<Wall>> found;
  std::vector<std::size_t> fresh;
  for (std::size_t k = 0; k < kPairKinds; ++k) {
    const auto kind = static_cast<PairKind>(k);
    const std::size_t first = candidates.begin(kind), n = candidates.end(kind) - first, before = found.size();
    found.resize(before + (n + kPairGrain - 1) / kPairGrain);
    fresh.resize(found.size(), 0);
    parallel_for(n, kPairGrain, [&](std::size_t begin, std::size_t end) {
      const std::size_t chunk = before + begin / kPairGrain;
      WallFinder finder(mesh, x, dx, length, fraction, found[chunk]);
      for (std::size_t i = first + begin; i < first + end; ++i) {
        const Pair& pair = pairs[i];
        if (walled[i]) continue;
        float motion = is_vt(kind) ? moved.of_point_and_triangle(mesh, pair.a, pair.b) : moved.of_edges(mesh, pair.a, pair.b);
        if (however_cut) motion += summed_length(mesh, pair, kind, length);
        // Parts whose motion cannot bring them together need no wall.
        if (pair.distance - motion > static_cast<float>(kLeastGap) || candidates.is_exempt(i)) continue;
        walled[i] = 1;
        ++fresh[chunk];
        is_vt(kind) ? finder.vt(pair.a, pair.b) : finder.ee(pair.a, pair.b);
      }
    });
  }
  for (const auto& chunk : found) walls.insert(walls.end(), chunk.begin(), chunk.end());
  std::size_t sum = 0;
  for (std::size_t n : fresh) sum += n;
  return sum;
}

/// The largest s in [0, 1] with |u + s d| <= reach; 0 when u lies outside already and d leads no way back.
double share_within(const Vector3d& u, const Vector3d& d, double reach) {
  const double dd = d.squaredNorm();
  if (dd <= 0 || (u + d).squaredNorm() <= reach * reach) return 1;
  const double b = u.dot(d), c = u.squaredNorm() - reach * reach;
  if (c > 0) return 0;
  return std::max(0.0, (std::sqrt(b * b - dd * c) - b) / dd * (1 - 1e-9));
}

/// Where each particle stands in the walls: [begin[i], begin[i + 1]) of `side`.
struct Sides {
  struct Side {
    Index wall;
    int slot;
  };
  std::vector<Index> begin;
  std::vector<Side> side;

  Sides(const std::vector<Wall>& walls, std::size_t n_particles) : begin(n_particles + 1, 0) {
    for (const Wall& w : walls)
      for (int k = 0; k < w.n; ++k)
        if (w.particle[k] >= 0) ++begin[w.particle[k] + 1];
    for (std::size_t i = 0; i < n_particles; ++i) begin[i + 1] += begin[i];
    side.resize(begin.back());
    std::vector<Index> next(begin.begin(), begin.end() - 1);
    for (std::size_t w = 0; w < walls.size(); ++w)
      for (int k = 0; k < walls[w].n; ++k)
        if (walls[w].particle[k] >= 0) side[next[walls[w].particle[k]]++] = {static_cast<Index>(w), k};
  }
};

/// Displacements between walls that move with them.
class Passage {
 public:
  /// With `reach`, displacements stay within it of the candidates' reference.
  Passage(std::vector<Wall> walls, const std::vector<Vector3d>& x, const Candidates* reach, std::vector<Vector3d>& dx)
      : walls_(std::move(walls)), sides_(walls_, dx.size()), x_(x), reach_(reach), dx_(dx) {}

  /// Cuts what goes beyond the walls. A particle cut back no longer goes on before the walls behind it: those slow down, and
  /// what follows them is cut in its turn, round by round; walls that find no speed stand in the end.
  /// Returns how often a displacement would have passed a wall.
  std::size_t go(double fraction) {
    std::vector<char> cut(dx_.size(), 1), next;
    std::size_t passed = 0;
    for (Wall& w : walls_) {
      divide(w, fraction, dx_);
      for (int k = 0; k < w.n; ++k) passed += w.particle[k] >= 0 && w.excess(k, dx_[w.particle[k]]) > 0 ? 1 : 0;
    }
    for (int round = 0; std::find(cut.begin(), cut.end(), 1) != cut.end(); ++round) {
      if (round == kMostRounds) stop_all(cut);
      parallel_for(dx_.size(), 1024, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
          if (cut[i]) dx_[i] = hold_back(i, dx_[i]);
      });
      next.assign(dx_.size(), 0);
      for (Wall& w : walls_)
        if (left_behind(w)) {
          w.stands = w.stands || round >= kRounds;
          w.motion = common_motion(w, dx_);
          for (int k = 0; k < w.n; ++k)
            if (w.particle[k] >= 0) next[w.particle[k]] = 1;
        }
      cut.swap(next);
    }
    return passed;
  }

 private:
  void stop_all(std::vector<char>& cut) {
    for (Wall& w : walls_) w.stands = true, w.motion = 0;
    cut.assign(cut.size(), 1);
  }

  bool left_behind(const Wall& w) const {
    if (w.motion == 0) return false;
    for (int k = 0; k < w.n; ++k)
      if (w.particle[k] >= 0 && w.drives(k) && w.excess(k, dx_[w.particle[k]]) > 0) return true;
    return false;
  }

  /// Takes the parts of d beyond the walls off, then shrinks what still goes too far. Never makes d longer.
  Vector3d hold_back(std::size_t i, Vector3d d) {
    bool all_kept = false;
    for (int sweep = 0; sweep < kWallSweeps && !all_kept; ++sweep) {
      all_kept = true;
      for (Index s = sides_.begin[i]; s < sides_.begin[i + 1]; ++s) {
        const auto [wall, k] = sides_.side[s];
        const Wall& w = walls_[wall];
        if (w.drives(k)) continue;
        const double excess = w.excess(k, d);
        if (excess <= 0) continue;
        d -= excess * w.sign(k) * w.normal;
        all_kept = false;
      }
    }
    double share = reach_ ? share_within(x_[i] - reach_->reference()[i], d, reach_->reach()) : 1;
    for (Index s = sides_.begin[i]; !all_kept && s < sides_.begin[i + 1]; ++s) {
      const auto [wall, k] = sides_.side[s];
      const Wall& w = walls_[wall];
      const double along = w.sign(k) * w.normal.dot(d), bound = w.room[k] + w.sign(k) * w.motion;
      if (bound >= 0 && along > bound) share = std::min(share, bound / along);
    }
    return share * d;
  }

  std::vector<Wall> walls_;
  Sides sides_;
  const std::vector<Vector3d>& x_;
  const Candidates* reach_;
  std::vector<Vector3d>& dx_;
};

/// Shortens what would leave the candidates' reach, where all stay who have moved less; else all stop. Returns how many.
std::size_t stay_within_reach(const Candidates& candidates, const std::vector<Vector3d>& x, std::vector<Vector3d>& dx) {
  const std::vector<Vector3d>& x0 = candidates.reference();
  std::vector<double> share(dx.size());
  bool all_in = true;
  std::size_t out = 0;
  for (std::size_t i = 0; i < dx.size(); ++i) {
    share[i] = share_within(x[i] - x0[i], dx[i], candidates.reach());
    all_in = all_in && (x[i] - x0[i]).norm() <= candidates.reach() * (1 + 1e-9);
    if (share[i] < 1) ++out;
  }
  for (std::size_t i = 0; i < dx.size(); ++i) dx[i] *= all_in ? share[i] : 0;
  return all_in ? out : dx.size();  // who is out already and wants back stops too: that has to be told
}

}  // namespace

TruncateStats truncate(const ContactMesh& mesh, const Candidates& candidates, const std::vector<Vector3d>& x,
                       std::vector<Vector3d>& dx, const TruncateOptions& options) {
  const std::vector<Vector3d> wish = dx;
  TruncateStats stats;
  for (Vector3d& d : dx)
    if (!(d.norm() < 1e300)) d.setZero();  // what is not finite does not move
  std::vector<Wall> walls;
  std::vector<char> walled(candidates.pairs().size(), 0);
  bool within_reach = false;
  if (!mesh.body_point.empty() || !candidates.complete(mesh, x, &dx, kLeastGap)) {
    stats.out_of_reach = stay_within_reach(candidates, x, dx);
    within_reach = true;
  }
  bool shortened = false;  // since the walls were last looked at
  for (int search = 0;; ++search) {
    if (add_walls(mesh, candidates, x, dx, search >= kSearches, options.fraction, walled, walls) > 0 || shortened) {
      Passage passage(walls, x, within_reach ? &candidates : nullptr, dx);
      stats.walls += passage.go(options.fraction);
      shortened = false;
    } else if (!within_reach && search > 0 && !candidates.complete(mesh, x, &dx, kLeastGap)) {
      stats.out_of_reach = stay_within_reach(candidates, x, dx);
      within_reach = shortened = true;
    } else {
      break;
    }
  }
  for (std::size_t i = 0; i < dx.size(); ++i) {
    const double cut = (wish[i] - dx[i]).norm();
    if (cut != 0) ++stats.limited;
    if (cut > stats.largest_cut) stats.largest_cut = cut;
  }
  return stats;
}

}  // namespace garment::simulator
