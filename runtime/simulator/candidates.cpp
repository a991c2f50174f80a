#include "runtime/simulator/candidates.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "runtime/base/parallel.hpp"
#include "runtime/simulator/closest_point.hpp"
#include "runtime/simulator/untangle.hpp"

namespace garment::simulator {
namespace {

constexpr std::size_t kQueryGrain = 128;  // queries of one chunk

template <class Part>
std::vector<FloatBox> boxes_of(const ContactMesh& mesh, const std::vector<Vector3d>& x,
                               const std::vector<Part>& parts, Index n) {
  std::vector<FloatBox> boxes(n);
  parallel_for(boxes.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      for (Index p : parts[i]) boxes[i].grow(mesh.at(x, p));
  });
  return boxes;
}

float below(double distance) { return static_cast<float>(std::max(0.0, distance * (1 - 1e-6) - 1e-12)); }

/// Where parts (or nodes of a tree) are, how far from the reference, and how far they go in a step.
struct BoxesOfMotion {
  std::vector<FloatBox> at, moved, step;  // the last is empty where there is no step

  /// Two that have moved by no more than `most` against each other, or that do not come nearer than `least`.
  bool apart(std::int32_t a, std::int32_t b, float most, double least) const {
    const float going = step.empty() ? 0.0F : step[a].largest_difference(step[b]);
    if (moved[a].largest_difference(moved[b]) + going <= most) return true;
    return !at[a].inflated(least + going).meets(at[b]);
  }
};

/// The search for pairs at one set of positions.
struct Search {
  const ContactMesh& mesh;
  const std::vector<Vector3d>& x;
  double radius;

  void vt(Index v, Index t, std::vector<Pair>& out) const {
    const Indices<3>& c = mesh.triangle[t];
    if (c[0] == v || c[1] == v || c[2] == v) return;
    const Vector3d &p = mesh.at(x, v), &a = mesh.at(x, c[0]), &b = mesh.at(x, c[1]), &d = mesh.at(x, c[2]);
    const TrianglePoint q = closest_on_triangle(p, a, b, d);
    const double squared = (p - q.weights[0] * a - q.weights[1] * b - q.weights[2] * d).squaredNorm();
    if (!(squared < radius * radius)) return;  // nor when a position is not a number
    out.push_back({v, t, static_cast<float>(mesh.contact_distance_vt(v, t)), below(std::sqrt(squared))});
  }

  void ee(Index e, Index f, std::vector<Pair>& out) const {
    const Indices<2>&i = mesh.edge[e], &j = mesh.edge[f];
    if (i[0] == j[0] || i[0] == j[1] || i[1] == j[0] || i[1] == j[1]) return;
    const Vector3d &a = mesh.at(x, i[0]), &b = mesh.at(x, i[1]), &c = mesh.at(x, j[0]), &d = mesh.at(x, j[1]);
    const SegmentPair s = closest_of_segments(a, b, c, d);
    const double squared = (a - c + s.s * (b - a) - s.t * (d - c)).squaredNorm();
    if (!(squared < radius * radius)) return;  // nor when a position is not a number
    out.push_back({e, f, static_cast<float>(mesh.contact_distance_ee(e, f)), below(std::sqrt(squared))});
  }

  FloatBox around(Index point) const {
    FloatBox box;
    box.grow(mesh.at(x, point));
    return box.inflated(radius);
  }
};

}  // namespace

void Candidates::rebuild(const ContactMesh& mesh, const std::vector<Vector3d>& x, double radius) {
  reference_ = x;
  radius_ = radius;
  reach_ = 0.495 * radius;
  pairs_.clear();
  exempt_.clear();
  const std::vector<FloatBox> edge_boxes = boxes_of(mesh, x, mesh.edge, mesh.n_cloth_edges);
  triangle_tree_ = mesh.cloth_triangle_tree;
  triangle_tree_.refit(boxes_of(mesh, x, mesh.triangle, mesh.n_cloth_triangles));
  edge_tree_ = mesh.cloth_edge_tree;
  edge_tree_.refit(edge_boxes);
  const Search search{mesh, x, radius};
  const auto n_particles = static_cast<std::size_t>(mesh.n_particles);

  if (mesh.options.self)
    parallel_collect(n_particles, kQueryGrain, pairs_, [&](std::size_t v, std::vector<Pair>& out) {
      const auto point = static_cast<Index>(v);
      triangle_tree_.query(search.around(point), [&](std::int32_t t) { search.vt(point, t, out); });
    });
  first_[1] = pairs_.size();
  if (mesh.options.self)
    parallel_collect(edge_tree_.n_leaves(), kQueryGrain, pairs_,
                     [&](std::size_t leaf, std::vector<Pair>& out) {
                       edge_tree_.query_pairs(leaf, radius, [&](std::int32_t e, std::int32_t f) {
                         search.ee(std::min(e, f), std::max(e, f), out);
                       });
                     });
  first_[2] = pairs_.size();
  parallel_collect(mesh.body_triangle_tree.empty() ? 0 : n_particles, kQueryGrain, pairs_,
                   [&](std::size_t v, std::vector<Pair>& out) {
                     const auto point = static_cast<Index>(v);
                     mesh.body_triangle_tree.query(search.around(point), [&](std::int32_t t) {
                       search.vt(point, t + mesh.n_cloth_triangles, out);
                     });
                   });
  first_[3] = pairs_.size();
  parallel_collect(triangle_tree_.empty() ? 0 : mesh.body_point.size(), kQueryGrain, pairs_,
                   [&](std::size_t v, std::vector<Pair>& out) {
                     const Index point = mesh.n_particles + static_cast<Index>(v);
                     if (mesh.point_triangles[point].empty()) return;  // no part of the surface
                     triangle_tree_.query(search.around(point),
                                          [&](std::int32_t t) { search.vt(point, t, out); });
                   });
  first_[4] = pairs_.size();
  parallel_collect(mesh.body_edge_tree.empty() ? 0 : edge_boxes.size(), kQueryGrain, pairs_,
                   [&](std::size_t e, std::vector<Pair>& out) {
                     mesh.body_edge_tree.query(edge_boxes[e].inflated(radius), [&](std::int32_t f) {
                       search.ee(static_cast<Index>(e), f + mesh.n_cloth_edges, out);
                     });
                   });
  first_[5] = pairs_.size();
}

bool Candidates::complete(const ContactMesh& mesh, const std::vector<Vector3d>& x, const std::vector<Vector3d>* dx,
                          double least) const {
  if (x.size() != reference_.size()) return false;
  if (!mesh.options.self) return true;
  const Bvh& tree = mesh.cloth_triangle_tree;
  std::vector<FloatBox> at(mesh.n_cloth_triangles), moved(at.size()), step(dx ? at.size() : 0);
  parallel_for(at.size(), 2048, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t)
      for (Index p : mesh.triangle[t]) {
        at[t].grow(x[p]);
        moved[t].grow(x[p] - reference_[p]);
        if (dx) step[t].grow((*dx)[p]);
      }
  });
  const auto most = static_cast<float>((radius_ - least) * (1 - 1e-5));
  const BoxesOfMotion node{tree.node_boxes(at), tree.node_boxes(moved), tree.node_boxes(step)};
  const BoxesOfMotion part{std::move(at), std::move(moved), std::move(step)};
  return !tree.any_pair([&](std::int32_t a, std::int32_t b) { return node.apart(a, b, most, least); },
                        [&](std::int32_t a, std::int32_t b) { return !part.apart(a, b, most, least); });
}

void Candidates::exempt(const ContactMesh& mesh, const Tangle& tangle) {
  exempt_.clear();
  if (tangle.empty()) return;
  // Keys (triangle, point) and (edge, edge) of every hit, sorted.
  auto key = [](Index i, Index j) {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(i)) << 32 | static_cast<std::uint32_t>(j);
  };
  std::vector<std::uint64_t> vt, ee;
  for (const EdgeHit& hit : tangle.hits) {
    const bool in_cloth = hit.edge < mesh.n_cloth_edges && hit.triangle < mesh.n_cloth_triangles;
    for (Index end : mesh.edge[hit.edge]) {
      vt.push_back(key(hit.triangle, end));
      // Where sheets cross at a small angle an end goes back through a neighbour of the triangle that its
      // edge cuts.
      if (!in_cloth) continue;
      for (Index corner : mesh.triangle[hit.triangle])
        for (Index t : mesh.point_triangles[corner]) vt.push_back(key(t, end));
    }
    for (Index e : mesh.triangle_edges[hit.triangle])
      ee.push_back(key(std::min(e, hit.edge), std::max(e, hit.edge)));
  }
  std::sort(vt.begin(), vt.end());
  std::sort(ee.begin(), ee.end());
  auto inside = [&](Index point) { return point < mesh.n_particles && tangle.inside[point] != 0; };
  exempt_.assign(pairs_.size(), 0);
  for (std::size_t k = 0; k < kPairKinds; ++k) {
    const auto kind = static_cast<PairKind>(k);
    parallel_for(end(kind) - begin(kind), 8192, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = begin(kind) + first; i < begin(kind) + last; ++i) {
        const Pair& pair = pairs_[i];
        bool out = false;
        if (is_vt(kind)) {
          out = std::binary_search(vt.begin(), vt.end(), key(pair.b, pair.a));
          if (is_body(kind)) {
            out = out || inside(pair.a);
            for (Index p : mesh.triangle[pair.b]) out = out || inside(p);
          }
        } else {
          out = std::binary_search(ee.begin(), ee.end(), key(pair.a, pair.b));
          if (is_body(kind))
            for (Index p : mesh.edge[pair.a]) out = out || inside(p);
        }
        exempt_[i] = out ? 1 : 0;
      }
    });
  }
}

}  // namespace garment::simulator
