#include "runtime/simulator/certificate.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/base/parallel.hpp"
#include "runtime/geometry/box_tree.hpp"
#include "runtime/geometry/exact_sign.hpp"
#include "runtime/geometry/self_crossings.hpp"
#include "runtime/geometry/triangle_hit.hpp"

namespace garment::simulator {
namespace {

using geometry::BoxTree;
using geometry::ClosedBox;
using geometry::Triangle3;
using model::Index;
using model::Indices;
using model::Vector3d;

constexpr std::size_t kTriangleGrain = 256;  // triangles of one chunk

Triangle3 corners(const Indices<3>& t, const std::vector<Vector3d>& x) { return {x[t[0]], x[t[1]], x[t[2]]}; }

ClosedBox box_of(const Triangle3& t) {
  ClosedBox box;
  for (const Vector3d& p : t) box.grow(p);
  return box;
}

template <class T>
std::vector<ClosedBox> boxes_of(const std::vector<T>& triangles, const std::vector<Vector3d>& x) {
  std::vector<ClosedBox> boxes;
  boxes.reserve(triangles.size());
  for (const auto& t : triangles) boxes.push_back(box_of({x[t[0]], x[t[1]], x[t[2]]}));
  return boxes;
}

/// What one chunk of the parallel loop found; chunks are joined in their order, which keeps the lists sorted.
template <class Hit>
struct Found {
  std::size_t count = 0;
  std::vector<Hit> hits;

  void add(const Hit& hit) {
    ++count;
    if (hits.size() < Certificate::kMaxListed) hits.push_back(hit);
  }
};

template <class Hit, class Test>
void collect_hits(std::size_t n, std::size_t& count, std::vector<Hit>& hits, const Test& test) {
  std::vector<Found<Hit>> found((n + kTriangleGrain - 1) / kTriangleGrain);
  parallel_for(n, kTriangleGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) test(static_cast<Index>(i), found[begin / kTriangleGrain]);
  });
  for (const Found<Hit>& f : found) {
    count += f.count;
    for (const Hit& hit : f.hits)
      if (hits.size() < Certificate::kMaxListed) hits.push_back(hit);
  }
}

/// Sign of orient_2d(a, b, p) when p is moved by (e, e^2) for an endless small e: never 0 unless a equals b,
/// and opposite for (b, a), so that a ray through an edge or a corner crosses exactly one of the triangles
/// around it.
int perturbed_side(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& p) {
  const int side = geometry::orient_2d(a, b, p);
  if (side != 0) return side;
  if (a[1] != b[1]) return a[1] > b[1] ? 1 : -1;
  return (b[0] > a[0]) - (b[0] < a[0]);
}

/// Signed crossings of the ray from p along +x with the closed surface: its winding number about p.
class WindingTest {
 public:
  WindingTest(const body::TriangleMesh& mesh, const BoxTree& tree, const ClosedBox& bounds)
      : mesh_(mesh), tree_(tree), bounds_(bounds) {}

  bool inside(const Vector3d& p) const {
    if (!(p.array() >= bounds_.low.array()).all() || !(p.array() <= bounds_.high.array()).all()) return false;
    int winding = 0;
    bool on_surface = false;
    tree_.visit(
        [&](const ClosedBox& b) {
          return b.high[0] >= p[0] && b.low[1] <= p[1] && p[1] <= b.high[1] && b.low[2] <= p[2] &&
                 p[2] <= b.high[2];
        },
        [&](std::int32_t t) { cross(mesh_.triangles[t], p, winding, on_surface); });
    return on_surface || winding > 0;
  }

 private:
  void cross(const std::array<int, 3>& t, const Vector3d& p, int& winding, bool& on_surface) const {
    const auto &a = mesh_.vertices[t[0]], &b = mesh_.vertices[t[1]], &c = mesh_.vertices[t[2]];
    const Eigen::Vector2d u(a[1], a[2]), v(b[1], b[2]), w(c[1], c[2]), q(p[1], p[2]);
    const int i = perturbed_side(u, v, q), j = perturbed_side(v, w, q), k = perturbed_side(w, u, q);
    if (i == 0 || i != j || j != k) return;
    const int side = geometry::orient_3d(a, b, c, p);
    if (side == 0) on_surface = true;
    if (side * i < 0) winding += i;  // the ray leaves through an outward face (i = 1) that p sees from behind
  }

  const body::TriangleMesh& mesh_;
  const BoxTree& tree_;
  const ClosedBox& bounds_;
};

void test_body(int id, const body::TriangleMesh& mesh, const std::vector<Indices<3>>& triangles,
               const std::vector<ClosedBox>& boxes, const std::vector<Vector3d>& x, Certificate& out) {
  const std::vector<ClosedBox> body_boxes = boxes_of(mesh.triangles, mesh.vertices);
  const BoxTree tree(body_boxes);
  collect_hits(triangles.size(), out.body_intersections, out.body_hits, [&](Index i, Found<BodyHit>& found) {
    const Triangle3 cloth = corners(triangles[i], x);
    const std::size_t first = found.hits.size();
    tree.visit([&](const ClosedBox& b) { return b.meets(boxes[i]); },
               [&](std::int32_t j) {
                 const std::array<int, 3>& t = mesh.triangles[j];
                 const Triangle3 skin{mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
                 if (geometry::triangles_hit(cloth, skin)) found.add({id, i, j});
               });
    std::sort(found.hits.begin() + static_cast<std::ptrdiff_t>(first), found.hits.end(),
              [](const BodyHit& p, const BodyHit& q) { return p.body_triangle < q.body_triangle; });
  });
  ClosedBox bounds;
  for (const ClosedBox& b : body_boxes) bounds.grow(b);
  const WindingTest winding(mesh, tree, bounds);
  collect_hits(x.size(), out.inside_body, out.inside_hits, [&](Index i, Found<InsideHit>& found) {
    if (winding.inside(x[i])) found.add({id, i});
  });
}

}  // namespace

Certificate certify(const std::vector<Indices<3>>& triangles, const std::vector<Vector3d>& positions,
                    const std::vector<const body::TriangleMesh*>& bodies) {
  Certificate out;
  for (const Vector3d& p : positions) out.finite = out.finite && p.allFinite();
  if (!out.finite) return out;
  const geometry::SelfCrossings self = geometry::self_crossings(triangles, positions, Certificate::kMaxListed);
  out.self_intersections = self.count;
  for (const geometry::TrianglePair& pair : self.pairs) out.self_hits.push_back({pair.first, pair.second});
  const std::vector<ClosedBox> boxes = boxes_of(triangles, positions);
  for (std::size_t k = 0; k < bodies.size(); ++k)
    test_body(static_cast<int>(k), *bodies[k], triangles, boxes, positions, out);
  return out;
}

Certificate certify(const model::Model& model, const model::State& state,
                    const std::vector<body::Body>& bodies) {
  std::vector<Indices<3>> triangles;
  triangles.reserve(model.n_triangles());
  for (std::size_t t = 0; t < model.n_triangles(); ++t) triangles.push_back(model.corners(t));
  std::vector<const body::TriangleMesh*> meshes;
  for (const body::Body& b : bodies) meshes.push_back(&b.mesh);
  return certify(triangles, state.position, meshes);
}

}  // namespace garment::simulator
