#include "runtime/simulator/contact.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "runtime/base/parallel.hpp"
#include "runtime/base/portable_math.hpp"
#include "runtime/simulator/closest_point.hpp"

namespace garment::simulator {
namespace {

constexpr std::size_t kGrain = 4096;     // pairs of one chunk
constexpr double kZeroGap = 1e-12;       // m: below this the gap has no direction
constexpr double kLeastDistance = 1e-9;  // m: the energy goes no nearer to its pole

/// Builds the contacts of one chunk of pairs.
class Finder {
 public:
  Finder(const ContactMesh& mesh, const std::vector<Vector3d>& x, std::vector<Contact>& out)
      : mesh_(mesh), x_(x), out_(out) {}

  void vt(Index v, Index t, double r, Index pair) {
    const Indices<3>& c = mesh_.triangle[t];
    const Vector3d &p = at(v), &a = at(c[0]), &b = at(c[1]), &d = at(c[2]);
    const TrianglePoint q = closest_on_triangle(p, a, b, d);
    const Vector3d gap = p - q.weights[0] * a - q.weights[1] * b - q.weights[2] * d;
    if (!(gap.squaredNorm() < r * r)) return;
    if (q.feature == Feature::face) add_vt(v, t, q.weights, 1, r, pair);
    for (int k = 0; k < 3; ++k) {
      if (owner(mesh_.edge_triangles[mesh_.triangle_edges[t][k]], v) == t) edge_share(v, t, k, r, pair);
      if (owner(mesh_.point_triangles[c[k]], v) == t) corner_share(v, t, k, r, pair);
    }
  }

  /// Edges in the interior of both; the energy of the nearest end is taken off, since points against
  /// triangles count it, so the contact fades out towards the ends and where the edges become parallel.
  void ee(Index e, Index f, double r, Index pair) {
    const Indices<4> p{mesh_.edge[e][0], mesh_.edge[e][1], mesh_.edge[f][0], mesh_.edge[f][1]};
    const Vector3d &a = at(p[0]), &b = at(p[1]), &c = at(p[2]), &d = at(p[3]);
    const SegmentPair s = closest_of_segments(a, b, c, d);
    if (!((a - c + s.s * (b - a) - s.t * (d - c)).squaredNorm() < r * r)) return;
    if (s.s <= 0 || s.s >= 1 || s.t <= 0 || s.t >= 1) return;
    std::array<SegmentPair, 4> ends;
    for (int k = 0; k < 2; ++k) {
      ends[k] = {static_cast<double>(k), closest_on_segment(at(p[k]), c, d).t};
      ends[2 + k] = {closest_on_segment(at(p[2 + k]), a, b).t, static_cast<double>(k)};
    }
    std::size_t nearest = 0;
    double least = -1;
    for (std::size_t k = 0; k < ends.size(); ++k) {
      const double squared = (a - c + ends[k].s * (b - a) - ends[k].t * (d - c)).squaredNorm();
      if (least >= 0 && squared >= least) continue;
      least = squared;
      nearest = k;
    }
    add_ee(p, s, 1, r, pair, e, f);
    if (least < r * r) add_ee(p, ends[nearest], -1, r, pair, e, f);
  }

 private:
  const Vector3d& at(Index point) const { return mesh_.at(x_, point); }

  bool has(Index t, Index v) const {
    const Indices<3>& c = mesh_.triangle[t];
    return c[0] == v || c[1] == v || c[2] == v;
  }

  /// First of the triangles that do not contain v.
  Index owner(std::span<const Index> triangles, Index v) const {
    for (Index t : triangles)
      if (!has(t, v)) return t;
    return -1;
  }

  Index without(std::span<const Index> triangles, Index v) const {
    Index n = 0;
    for (Index t : triangles) n += has(t, v) ? 0 : 1;
    return n;
  }

  bool closest_is_edge(Index v, Index t, Index edge) const {
    const Indices<3>& c = mesh_.triangle[t];
    const Feature f = closest_on_triangle(at(v), at(c[0]), at(c[1]), at(c[2])).feature;
    if (f < Feature::edge_ab || f > Feature::edge_ca) return false;
    return mesh_.triangle_edges[t][static_cast<int>(f) - static_cast<int>(Feature::edge_ab)] == edge;
  }

  bool closest_is_corner(Index v, Index t, Index corner) const {
    const Indices<3>& c = mesh_.triangle[t];
    const Feature f = closest_on_triangle(at(v), at(c[0]), at(c[1]), at(c[2])).feature;
    return f >= Feature::corner_a && c[static_cast<int>(f) - static_cast<int>(Feature::corner_a)] == corner;
  }

  /// Triangles whose closest point is this edge, less those that the edge joins too often.
  void edge_share(Index v, Index t, int k, double r, Index pair) {
    const Index edge = mesh_.triangle_edges[t][k];
    const Indices<3>& c = mesh_.triangle[t];
    const SegmentPoint s = closest_on_segment(at(v), at(c[k]), at(c[(k + 1) % 3]));
    if (s.feature != Feature::edge_ab) return;
    const Vector3d gap = at(v) - (1 - s.t) * at(c[k]) - s.t * at(c[(k + 1) % 3]);
    if (!(gap.squaredNorm() < r * r)) return;
    int share = 1 - without(mesh_.edge_triangles[edge], v);
    for (Index other : mesh_.edge_triangles[edge])
      if (!has(other, v) && closest_is_edge(v, other, edge)) ++share;
    if (share == 0) return;
    std::array<double, 3> weights{};
    weights[k] = 1 - s.t;
    weights[(k + 1) % 3] = s.t;
    add_vt(v, t, weights, share, r, pair);
  }

  /// Euler's count around a corner: triangles - edges + 1, each only where the corner is its closest point.
  void corner_share(Index v, Index t, int k, double r, Index pair) {
    const Index corner = mesh_.triangle[t][k];
    if (!((at(v) - at(corner)).squaredNorm() < r * r)) return;
    int share = 1;
    for (Index other : mesh_.point_triangles[corner])
      if (!has(other, v) && !closest_is_corner(v, other, corner)) --share;
    for (Index edge : mesh_.point_edges[corner]) {
      const Indices<2>& e = mesh_.edge[edge];
      if (e[0] == v || e[1] == v) continue;
      const Index joins = without(mesh_.edge_triangles[edge], v) - 1;
      const Vector3d& far = at(e[0] == corner ? e[1] : e[0]);
      if (joins > 0 && (far - at(corner)).dot(at(v) - at(corner)) > 0) share += joins;
    }
    if (share == 0) return;
    std::array<double, 3> weights{};
    weights[k] = 1;
    add_vt(v, t, weights, share, r, pair);
  }

  void add_vt(Index v, Index t, const std::array<double, 3>& w, int share, double r, Index pair) {
    const Indices<3>& c = mesh_.triangle[t];
    Contact contact;
    contact.p = {v, c[0], c[1], c[2]};
    contact.w = {1, -w[0], -w[1], -w[2]};
    const Vector3d gap = at(v) - w[0] * at(c[0]) - w[1] * at(c[1]) - w[2] * at(c[2]);
    const double other =
        w[0] * mesh_.friction[c[0]] + w[1] * mesh_.friction[c[1]] + w[2] * mesh_.friction[c[2]];
    contact.friction = std::sqrt(mesh_.friction[v] * other);
    contact.body = mesh_.is_body(v) || mesh_.is_body(c[0]);
    finish(contact, gap, (at(c[1]) - at(c[0])).cross(at(c[2]) - at(c[0])), share, r, pair);
  }

  void add_ee(const Indices<4>& p, const SegmentPair& s, int share, double r, Index pair, Index e, Index f) {
    Contact contact;
    contact.p = p;
    contact.w = {1 - s.s, s.s, s.t - 1, -s.t};
    const Vector3d u = at(p[1]) - at(p[0]), v = at(p[3]) - at(p[2]);
    const Vector3d gap = at(p[0]) - at(p[2]) + s.s * u - s.t * v;
    const auto &mu_a = mesh_.friction[mesh_.edge[e][0]], &mu_b = mesh_.friction[mesh_.edge[f][0]];
    contact.friction = std::sqrt(mu_a * mu_b);
    contact.body = mesh_.is_body(p[2]);
    finish(contact, gap, u.cross(v), share, r, pair);
  }

  void finish(Contact& contact, const Vector3d& gap, const Vector3d& without_gap, int share, double r,
              Index pair) {
    contact.distance = gap.norm();
    const Vector3d direction = contact.distance > kZeroGap ? gap : without_gap;
    const double length = direction.norm();
    contact.normal = length > 0 ? Vector3d(direction / length) : Vector3d(0, 1, 0);
    contact.contact_distance = r;
    contact.multiplicity = share;
    contact.pair = pair;
    out_.push_back(contact);
  }

  const ContactMesh& mesh_;
  const std::vector<Vector3d>& x_;
  std::vector<Contact>& out_;
};

}  // namespace

void active_contacts(const ContactMesh& mesh, const Candidates& candidates, const std::vector<Vector3d>& x,
                     std::vector<Contact>& out) {
  out.clear();
  const PartMotion moved = motion_since(mesh, candidates, x);
  const std::vector<Pair>& pairs = candidates.pairs();
  for (std::size_t k = 0; k < kPairKinds; ++k) {
    const auto kind = static_cast<PairKind>(k);
    const std::size_t first = candidates.begin(kind), n = candidates.end(kind) - first;
    std::vector<std::vector<Contact>> found((n + kGrain - 1) / kGrain);
    // How far the parts of a pair have come, of the cloth only.
    const float* of_a = kind == PairKind::body_v_cloth_t ? nullptr
                        : is_vt(kind)                    ? moved.point.data()
                                                         : moved.edge.data();
    const float* of_b = kind == PairKind::cloth_v_body_t || kind == PairKind::cloth_e_body_e ? nullptr
                        : is_vt(kind) ? moved.triangle.data()
                                      : moved.edge.data();
    parallel_for(n, kGrain, [&](std::size_t begin, std::size_t end) {
      Finder finder(mesh, x, found[begin / kGrain]);
      for (std::size_t i = first + begin; i < first + end; ++i) {
        const Pair& pair = pairs[i];
        const float motion = (of_a ? of_a[pair.a] : 0) + (of_b ? of_b[pair.b] : 0);
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

ContactEnergy contact_energy(double distance, double contact_distance, double stiffness) {
  const double r = contact_distance;
  if (distance >= r) return {};
  const double d = std::max(distance, kLeastDistance);
  if (d >= 0.5 * r) {
    const double depth = r - d;
    return {0.5 * stiffness * depth * depth, -stiffness * depth, stiffness};
  }
  const double c = 0.25 * stiffness * r * r;
  return {0.5 * c + c * portable::log(0.5 * r / d), -c / d, c / (d * d)};
}

}  // namespace garment::simulator
