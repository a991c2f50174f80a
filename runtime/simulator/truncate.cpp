#include "runtime/simulator/truncate.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "runtime/base/parallel.hpp"
#include "runtime/simulator/closest_point.hpp"

namespace garment::simulator {
namespace {

constexpr std::size_t kGrain = 4096;
constexpr double kZeroGap = 1e-12;  // m: below this the gap has no direction
constexpr double kLeastGap = 1e-8;  // m: gaps below do not close further; far above all rounding errors here
constexpr int kSweeps = 4;          // over the walls of a particle before its displacement shrinks as a whole

/// A particle may move by at most `bound` along `normal`.
struct Wall {
  Index particle;
  float normal[3];
  float bound;
};

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
    if (gap < kZeroGap) {
      gap = without_gap.norm();
      normal = gap > 0 ? without_gap : Vector3d(0, 1, 0);
      if (gap <= 0) gap = 1;
      if (!oriented && normal.dot(motion) < 0) normal = -normal;
    }
    normal /= gap;
    const bool first_moves = !mesh_.is_body(first[0]), second_moves = !mesh_.is_body(second[0]);
    const Vector3d wall = !first_moves ? p : (second_moves ? Vector3d(0.5 * (p + q)) : q);
    if (first_moves)
      for (Index i : first) add(i, -normal, normal.dot(at(i) - wall));
    if (second_moves)
      for (Index i : second) add(i, normal, normal.dot(wall - at(i)));
  }

  void add(Index particle, const Vector3d& towards, double distance) {
    const double bound = fraction_ * std::max(0.0, distance - kLeastGap);
    if (length_[particle] <= bound) return;
    out_.push_back(
        {particle,
         {static_cast<float>(towards[0]), static_cast<float>(towards[1]), static_cast<float>(towards[2])},
         static_cast<float>(bound * (1 - 1e-6))});
  }

  const ContactMesh& mesh_;
  const std::vector<Vector3d>& x_;
  const std::vector<Vector3d>& dx_;
  const std::vector<float>& length_;
  double fraction_;
  std::vector<Wall>& out_;
};

std::vector<std::vector<Wall>> find_walls(const ContactMesh& mesh, const Candidates& candidates,
                                          const std::vector<Vector3d>& x, const std::vector<Vector3d>& dx,
                                          double fraction) {
  const PartMotion moved = motion_since(mesh, candidates, x, &dx);
  std::vector<float> length(dx.size());
  for (std::size_t i = 0; i < dx.size(); ++i) length[i] = static_cast<float>(dx[i].norm() * (1 + 1e-6));
  const std::vector<Pair>& pairs = candidates.pairs();
  std::vector<std::vector<Wall>> found;
  for (std::size_t k = 0; k < kPairKinds; ++k) {
    const auto kind = static_cast<PairKind>(k);
    const std::size_t first = candidates.begin(kind), n = candidates.end(kind) - first;
    const std::size_t before = found.size();
    found.resize(before + (n + kGrain - 1) / kGrain);
    const float* of_a = kind == PairKind::body_v_cloth_t ? nullptr
                        : is_vt(kind)                    ? moved.point.data()
                                                         : moved.edge.data();
    const float* of_b = kind == PairKind::cloth_v_body_t || kind == PairKind::cloth_e_body_e ? nullptr
                        : is_vt(kind) ? moved.triangle.data()
                                      : moved.edge.data();
    parallel_for(n, kGrain, [&](std::size_t begin, std::size_t end) {
      WallFinder finder(mesh, x, dx, length, fraction, found[before + begin / kGrain]);
      for (std::size_t i = first + begin; i < first + end; ++i) {
        const Pair& pair = pairs[i];
        const float motion = (of_a ? of_a[pair.a] : 0) + (of_b ? of_b[pair.b] : 0);
        // Parts whose motion cannot bring them together need no wall.
        if (pair.distance - motion > static_cast<float>(kLeastGap) || candidates.is_exempt(i)) continue;
        is_vt(kind) ? finder.vt(pair.a, pair.b) : finder.ee(pair.a, pair.b);
      }
    });
  }
  return found;
}

/// The largest s in [0, 1] with |u + s d| <= reach; 0 when u lies outside already and d leads no way back.
double share_within(const Vector3d& u, const Vector3d& d, double reach) {
  const double dd = d.squaredNorm();
  if (dd <= 0 || (u + d).squaredNorm() <= reach * reach) return 1;
  const double b = u.dot(d), c = u.squaredNorm() - reach * reach;
  if (c > 0) return 0;
  return std::max(0.0, (std::sqrt(b * b - dd * c) - b) / dd * (1 - 1e-9));
}

double along(const Wall& w, const Vector3d& d) {
  return w.normal[0] * d[0] + w.normal[1] * d[1] + w.normal[2] * d[2];
}

/// Takes the parts of d beyond the walls off, then shrinks what still goes too far.
Vector3d hold_back(const Wall* begin, const Wall* end, Vector3d d) {
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    bool all_kept = true;
    for (const Wall* w = begin; w != end; ++w) {
      const double excess = along(*w, d) - w->bound;
      if (excess <= 0) continue;
      d -= excess * Vector3d(w->normal[0], w->normal[1], w->normal[2]);
      all_kept = false;
    }
    if (all_kept) return d;
  }
  double share = 1;
  for (const Wall* w = begin; w != end; ++w) {
    const double a = along(*w, d);
    if (a > w->bound) share = std::min(share, w->bound / a);
  }
  return share * d;
}

}  // namespace

TruncateStats truncate(const ContactMesh& mesh, const Candidates& candidates, const std::vector<Vector3d>& x,
                       std::vector<Vector3d>& dx, const TruncateOptions& options) {
  const std::vector<Vector3d>& x0 = candidates.reference();
  const std::vector<Vector3d> wish = dx;
  for (std::size_t i = 0; i < dx.size(); ++i) {
    // Longer ones cannot end within reach; what is not finite does not move.
    const double length = dx[i].norm(), most = candidates.reach() + (x[i] - x0[i]).norm();
    if (!(length < 1e300))
      dx[i].setZero();
    else if (length > most)
      dx[i] *= most / length;
  }
  const std::vector<std::vector<Wall>> found = find_walls(mesh, candidates, x, dx, options.fraction);

  std::vector<Index> begin(dx.size() + 1, 0);
  TruncateStats stats;
  for (const auto& chunk : found)
    for (const Wall& w : chunk) ++begin[w.particle + 1];
  for (std::size_t i = 0; i < dx.size(); ++i) begin[i + 1] += begin[i];
  std::vector<Wall> wall(begin.back());
  std::vector<Index> next(begin.begin(), begin.end() - 1);
  for (const auto& chunk : found)
    for (const Wall& w : chunk) {
      wall[next[w.particle]++] = w;
      if (along(w, dx[w.particle]) > w.bound) ++stats.walls;
    }

  parallel_for(dx.size(), 1024, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      dx[i] = hold_back(wall.data() + begin[i], wall.data() + begin[i + 1], dx[i]);
  });
  for (std::size_t i = 0; i < dx.size(); ++i) {
    const double share = share_within(x[i] - x0[i], dx[i], candidates.reach());
    if (share < 1) {
      dx[i] *= share;
      ++stats.out_of_reach;
    }
    const double cut = (wish[i] - dx[i]).norm();
    if (cut != 0) ++stats.limited;
    if (cut > stats.largest_cut) stats.largest_cut = cut;
  }
  return stats;
}

}  // namespace garment::simulator
