#include "runtime/simulator/contact.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "runtime/base/parallel.hpp"
#include "runtime/base/portable_math.hpp"
#include "runtime/simulator/closest_point.hpp"
#include "runtime/simulator/contact_stiffness.hpp"
#include "runtime/simulator/relative_motion.hpp"

namespace garment::simulator {
namespace {

constexpr double kCrossing = 0.01;       // sin^2 of the angle from which edges count as crossing
constexpr double kNear = 0.5, kVeryNear = 0.15;  // shares of the contact distance between which edges come to count whole
constexpr double kLeastShare = 1e-4;
constexpr double kLeastDistance = 1e-9;  // m: the energy goes no nearer to its pole

/// From 0 at 0 to 1 at `full` and beyond, without kinks.
double rise(double x, double full) {
  const double y = std::clamp(x / full, 0.0, 1.0);
  return y * y * (3 - 2 * y);
}

/// Builds the contacts of one chunk of pairs.
class Finder {
 public:
  /// With `dx`: not the contacts of x, but what x + dx would add to them.
  Finder(const ContactMesh& mesh, const std::vector<Vector3d>& x, const std::vector<float>* shares,
         const std::vector<Vector3d>* dx, std::vector<Contact>& out)
      : mesh_(mesh), x_(x), shares_(shares), dx_(dx), out_(out) {}

  void vt(Index v, Index t, double r, Index pair) {
    const Indices<3>& c = mesh_.triangle[t];
    const Vector3d &p = at(v), &a = at(c[0]), &b = at(c[1]), &d = at(c[2]);
    const TrianglePoint q = closest_on_triangle(p, a, b, d);
    const Vector3d gap = p - q.weights[0] * a - q.weights[1] * b - q.weights[2] * d;
    Contact contact;
    contact.p = {v, c[0], c[1], c[2]};
    contact.w = {1, -q.weights[0], -q.weights[1], -q.weights[2]};
    if (!touches(contact, gap, r)) return;
    const double other = q.weights[0] * mesh_.friction[c[0]] + q.weights[1] * mesh_.friction[c[1]] +
                         q.weights[2] * mesh_.friction[c[2]];
    contact.friction = std::sqrt(mesh_.friction[v] * other);
    contact.body = mesh_.is_body(v) || mesh_.is_body(c[0]);
    finish(contact, gap, (b - a).cross(d - a), 1, r, pair);
  }

  /// Edges; where they run side by side points against triangles take over.
  void ee(Index e, Index f, double r, Index pair) {
    const Indices<4> p{mesh_.edge[e][0], mesh_.edge[e][1], mesh_.edge[f][0], mesh_.edge[f][1]};
    const Vector3d &a = at(p[0]), &b = at(p[1]), &c = at(p[2]), &d = at(p[3]);
    const SegmentPair s = closest_of_segments(a, b, c, d);
    const Vector3d u = b - a, v = d - c, gap = a - c + s.s * u - s.t * v;
    Contact contact;
    contact.p = p;
    contact.w = {1 - s.s, s.s, s.t - 1, -s.t};
    if (!touches(contact, gap, r)) return;
    const Vector3d across = u.cross(v);
    double share = shares_ ? (*shares_)[pair] : 0;
    if (share == 0) {
      share = rise(across.squaredNorm() / std::max(u.squaredNorm() * v.squaredNorm(), 1e-300), kCrossing);
      // What has come very near counts whole: a faint contact would let edges close up, and throw them apart as it grows.
      share = std::max(share, rise(kNear - gap.norm() / r, kNear - kVeryNear));
    }
    share = std::max(share, kLeastShare);  // never nothing: what is known to be near keeps its weight through the step
    contact.friction = std::sqrt(mesh_.friction[p[0]] * mesh_.friction[p[2]]);
    contact.body = mesh_.is_body(p[2]);
    finish(contact, gap, across, share, r, pair);
  }

 private:
  const Vector3d& at(Index point) const { return mesh_.at(x_, point); }

  bool touches(const Contact& contact, const Vector3d& gap, double r) const {
    const double squared = gap.squaredNorm();
    if (!dx_) return squared < r * r;
    if (!(squared >= r * r)) return false;
    const double distance = std::sqrt(squared);
    double closing = 0;
    for (int k = 0; k < 4; ++k)
      if (!mesh_.is_body(contact.p[k])) closing -= contact.w[k] * gap.dot((*dx_)[contact.p[k]]);
    return distance - closing / distance < r - kForeseenDepth;
  }

  void finish(Contact& contact, const Vector3d& gap, const Vector3d& without_gap, double share, double r,
              Index pair) {
    contact.distance = gap.norm();
    const Vector3d direction = contact.distance > kZeroGap ? gap : without_gap;
    const double length = direction.norm();
    contact.normal = length > 0 ? Vector3d(direction / length) : Vector3d(0, 1, 0);
    contact.contact_distance = r;
    contact.share = share;
    contact.pair = pair;
    out_.push_back(contact);
  }

  const ContactMesh& mesh_;
  const std::vector<Vector3d>& x_;
  const std::vector<float>* shares_;
  const std::vector<Vector3d>* dx_;
  std::vector<Contact>& out_;
};

/// Contacts of x, or with `dx` those that the step adds.
void find(const ContactMesh& mesh, const Candidates& candidates, const std::vector<Vector3d>& x,
          const std::vector<float>* shares, const std::vector<Vector3d>* dx, std::vector<Contact>& out) {
  out.clear();
  const RelativeMotion moved(candidates.reference(), x, dx);
  const std::vector<Pair>& pairs = candidates.pairs();
  for (std::size_t k = 0; k < kPairKinds; ++k) {
    const auto kind = static_cast<PairKind>(k);
    const std::size_t first = candidates.begin(kind), n = candidates.end(kind) - first;
    std::vector<std::vector<Contact>> found((n + kPairGrain - 1) / kPairGrain);
    parallel_for(n, kPairGrain, [&](std::size_t begin, std::size_t end) {
      Finder finder(mesh, x, shares, dx, found[begin / kPairGrain]);
      for (std::size_t i = first + begin; i < first + end; ++i) {
        const Pair& pair = pairs[i];
        const float motion =
            is_vt(kind) ? moved.of_point_and_triangle(mesh, pair.a, pair.b) : moved.of_edges(mesh, pair.a, pair.b);
        if (pair.distance - motion > pair.contact_distance || candidates.is_exempt(i)) continue;
        if (is_vt(kind))
          finder.vt(pair.a, pair.b, pair.contact_distance, static_cast<Index>(i));
        else
          finder.ee(pair.a, pair.b, pair.contact_distance, static_cast<Index>(i));
      }
    });
    for (const auto& f : found) out.insert(out.end(), f.begin(), f.end());
  }
}

}  // namespace

void active_contacts(const ContactMesh& mesh, const Candidates& candidates, const std::vector<Vector3d>& x,
                     std::vector<Contact>& out, const std::vector<float>* shares) {
  find(mesh, candidates, x, shares, nullptr, out);
}

void coming_contacts(const ContactMesh& mesh, const Candidates& candidates, const std::vector<Vector3d>& x,
                     const std::vector<Vector3d>& dx, std::vector<Contact>& out) {
  find(mesh, candidates, x, nullptr, &dx, out);
}

ContactEnergy contact_energy(double distance, double contact_distance, double stiffness) {
  const double r = contact_distance;
  if (distance >= r) return {};
  const double d = std::max(distance, kLeastDistance);
  const double depth = r - d, log = portable::log(r / d), k = stiffness / 3;
  return {k * depth * depth * log, -k * depth * (2 * log + depth / d), k * (2 * log + depth / d * (4 + depth / d))};
}

}  // namespace garment::simulator
