#include "runtime/simulator/untangle.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "runtime/base/parallel.hpp"
#include "runtime/simulator/closest_point.hpp"
#include "runtime/simulator/contours.hpp"

namespace garment::simulator {
namespace {

constexpr double kSharp = 0.05;  // least |E . N|: an edge that runs along a triangle tells no direction

Vector3d unit(const Vector3d& v) {
  const double n = v.norm();
  return n > 0 ? Vector3d(v / n) : Vector3d::Zero();
}

Vector3d capped(const Vector3d& v, double most) {
  const double n = v.norm();
  return n > most ? Vector3d(v * (most / n)) : v;
}

/// Displacements that are asked of a particle from several sides: the mean counts.
class Wishes {
 public:
  explicit Wishes(std::size_t n) : sum_(n, Vector3d::Zero()), weight_(n, 0) {}
  void add(Index i, const Vector3d& displacement, double weight = 1) {
    sum_[i] += weight * displacement;
    weight_[i] += weight;
  }
  bool any(Index i) const { return weight_[i] > 0; }
  Vector3d mean(Index i) const { return any(i) ? Vector3d(sum_[i] / weight_[i]) : Vector3d::Zero(); }

 private:
  std::vector<Vector3d> sum_;
  std::vector<double> weight_;
};

class Untangler {
 public:
  Untangler(const ContactMesh& mesh, const std::vector<body::Body>& bodies, const std::vector<Vector3d>& x,
            const Tangle& tangle, const UntangleOptions& options)
      : mesh_(mesh),
        bodies_(bodies),
        x_(x),
        tangle_(tangle),
        o_(options),
        cloth_(x.size()),
        body_(x.size()),
        went_back_(x.size(), 0) {}

  void run(std::vector<Vector3d>& dx) {
    leave_bodies();
    const Contours contours = find_contours(mesh_, x_, tangle_);
    std::vector<Vector3d> way_back(contours.n,
                                   Vector3d::Zero());  // by contour: sum over its edges that go back
    for (std::size_t k = 0; k < tangle_.hits.size(); ++k) {
      const EdgeHit& hit = tangle_.hits[k];
      if (hit.edge >= mesh_.n_cloth_edges)
        pierced_by_body(hit);
      else if (hit.triangle >= mesh_.n_cloth_triangles)
        cuts_body(hit);
      else if (contours.astray[k] >= 0)
        way_back[contours.contour[k]] += retreat(hit, contours.astray[k]);
      else
        shorten_contour(hit);
    }
    dx.assign(x_.size(), Vector3d::Zero());
    for (std::size_t k = 0; k < x_.size(); ++k) {
      const auto i = static_cast<Index>(k);
      // Out of the body comes first: cloth can only be put in order outside.
      if (body_.any(i))
        dx[i] = capped(body_.mean(i), o_.step);
      else if (contours.region[i] >= 0 && !went_back_[i])
        dx[i] = o_.step * unit(way_back[contours.region[i]]);
      else if (cloth_.any(i))
        dx[i] = capped(cloth_.mean(i), o_.step);
    }
  }

 private:
  const Vector3d& at(Index point) const { return mesh_.at(x_, point); }

  std::optional<body::SurfacePoint> closest(const Vector3d& p) const {
    std::optional<body::SurfacePoint> best;
    for (const body::Body& body : bodies_) {
      const std::optional<body::SurfacePoint> s =
          body.closest(p, best ? std::min(o_.search, std::fabs(best->distance)) : o_.search);
      if (s && (!best || s->distance < best->distance)) best = s;
    }
    return best;
  }

  void leave_bodies() {
    std::vector<Vector3d> way(x_.size(), Vector3d::Zero());
    parallel_for(x_.size(), 256, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        if (tangle_.inside[i]) way[i] = way_out(x_[i]);
    });
    for (std::size_t i = 0; i < x_.size(); ++i)
      if (tangle_.inside[i]) body_.add(static_cast<Index>(i), way[i]);
  }

  /// To the offset outside the nearest surface; zero where p is farther out already.
  Vector3d way_out(const Vector3d& p) const {
    const std::optional<body::SurfacePoint> s = closest(p);
    if (!s || s->distance >= o_.body_offset) return Vector3d::Zero();
    return s->point + o_.body_offset * s->normal - p;
  }

  /// A cloth edge through a body's surface: its ends go out to the offset; where both are out already and the
  /// middle is not, both follow the middle.
  void cuts_body(const EdgeHit& hit) {
    const Indices<2>& e = mesh_.edge[hit.edge];
    bool moved = false;
    for (Index end : e) {
      const Vector3d way = way_out(x_[end]);
      if (way.squaredNorm() <= 0) continue;
      body_.add(end, way);
      moved = true;
    }
    if (moved) return;
    for (double t : {0.25, 0.5, 0.75}) {
      const Vector3d way = way_out((1 - t) * x_[e[0]] + t * x_[e[1]]);
      body_.add(e[0], way, 1 - t);
      body_.add(e[1], way, t);
    }
  }

  /// A body's edge through a cloth triangle: the triangle goes out along the surface, its corners by how near
  /// they are.
  void pierced_by_body(const EdgeHit& hit) {
    const Indices<2>& e = mesh_.edge[hit.edge];
    const Indices<3>& c = mesh_.triangle[hit.triangle];
    Vector3d normal = Vector3d::Zero();
    for (Index t : mesh_.edge_triangles[hit.edge]) {
      const Indices<3>& b = mesh_.triangle[t];
      normal += (at(b[1]) - at(b[0])).cross(at(b[2]) - at(b[0]));
    }
    normal = unit(normal);
    double depth = 0;  // of the triangle below the edge's farther end
    for (Index end : e) {
      const TrianglePoint q = closest_on_triangle(at(end), at(c[0]), at(c[1]), at(c[2]));
      const Vector3d on = q.weights[0] * at(c[0]) + q.weights[1] * at(c[1]) + q.weights[2] * at(c[2]);
      depth = std::max(depth, normal.dot(at(end) - on));
    }
    for (Index corner : c) body_.add(corner, (depth + 0.5 * o_.body_offset) * normal);
  }

  /// The end of an edge that has gone through a triangle goes back, the triangle gives way. Returns the
  /// direction.
  Vector3d retreat(const EdgeHit& hit, Index astray) {
    const Indices<2>& e = mesh_.edge[hit.edge];
    const Index stays = e[0] == astray ? e[1] : e[0];
    const Vector3d normal = normal_of(hit.triangle);
    const Vector3d direction = normal.dot(at(stays) - at(astray)) < 0 ? Vector3d(-normal) : normal;
    cloth_.add(astray, o_.step * direction);
    went_back_[astray] = 1;
    for (Index corner : mesh_.triangle[hit.triangle]) cloth_.add(corner, -0.5 * o_.step * direction);
    return direction;
  }

  Vector3d normal_of(Index t) const {
    const Indices<3>& c = mesh_.triangle[t];
    return unit((at(c[1]) - at(c[0])).cross(at(c[2]) - at(c[0])));
  }

  /// Where edge E pierces the triangle with normal N, the contour runs on along R in each triangle beside the
  /// edge:
  ///   G = sum over those of R - (E . R)/(E . N) N
  /// is the direction in which moving the edge shortens the contour fastest.
  void shorten_contour(const EdgeHit& hit) {
    const Indices<2>& e = mesh_.edge[hit.edge];
    const Indices<3>& c = mesh_.triangle[hit.triangle];
    const Vector3d along = unit(at(e[1]) - at(e[0])), normal = normal_of(hit.triangle);
    const double sharp = along.dot(normal);
    if (std::fabs(sharp) < kSharp) return;
    Vector3d gradient = Vector3d::Zero();
    for (Index t : mesh_.edge_triangles[hit.edge]) {
      Vector3d r = unit(normal.cross(normal_of(t)));
      Index apex = -1;
      for (Index p : mesh_.triangle[t])
        if (p != e[0] && p != e[1]) apex = p;
      const Vector3d inwards = at(apex) - at(e[0]) - along * along.dot(at(apex) - at(e[0]));
      if (r.dot(inwards) < 0) r = -r;
      gradient += r - along.dot(r) / sharp * normal;
    }
    const double size = gradient.norm();
    if (size <= 0) return;
    // Saturates at one step; small gradients (smooth contours through flat cloth) move little.
    const Vector3d move = o_.step / std::sqrt(size * size + 0.01) * gradient;
    const double t = std::clamp(normal.dot(at(c[0]) - at(e[0])) / normal.dot(at(e[1]) - at(e[0])), 0.0, 1.0);
    cloth_.add(e[0], move, 1 - t);
    cloth_.add(e[1], move, t);
    const TrianglePoint q =
        closest_on_triangle((1 - t) * at(e[0]) + t * at(e[1]), at(c[0]), at(c[1]), at(c[2]));
    for (int k = 0; k < 3; ++k) cloth_.add(c[k], -move, q.weights[k]);
  }

  const ContactMesh& mesh_;
  const std::vector<body::Body>& bodies_;
  const std::vector<Vector3d>& x_;
  const Tangle& tangle_;
  const UntangleOptions& o_;
  Wishes cloth_, body_;
  std::vector<std::uint8_t> went_back_;  // per particle: an end that retreats
};

}  // namespace

std::size_t untangle_displacements(const ContactMesh& mesh, const std::vector<body::Body>& bodies,
                                   const std::vector<Vector3d>& x, const Tangle& tangle,
                                   std::vector<Vector3d>& dx, const UntangleOptions& options) {
  if (tangle.empty()) {
    dx.assign(x.size(), Vector3d::Zero());
    return 0;
  }
  Untangler(mesh, bodies, x, tangle, options).run(dx);
  return tangle.size();
}

std::size_t untangle_displacements(const ContactMesh& mesh, const std::vector<body::Body>& bodies,
                                   const std::vector<Vector3d>& x, std::vector<Vector3d>& dx) {
  return untangle_displacements(mesh, bodies, x, find_tangle(mesh, bodies, x), dx);
}

}  // namespace garment::simulator
