#include "runtime/simulator/contact_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace garment::simulator {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
// A path along edges is longer than the straight one; on grid-like meshes with angles above 20 degrees by
// less than 1 / 0.6.
constexpr double kPathToStraight = 0.6;

/// Rows of the pairs (row, item), items ascending.
Rows make_rows(std::size_t n_rows, std::vector<std::pair<Index, Index>>& pairs) {
  std::sort(pairs.begin(), pairs.end());
  Rows rows;
  rows.begin.assign(n_rows + 1, 0);
  rows.item.reserve(pairs.size());
  for (const auto& [row, item] : pairs) {
    ++rows.begin[row + 1];
    rows.item.push_back(item);
  }
  for (std::size_t i = 0; i < n_rows; ++i) rows.begin[i + 1] += rows.begin[i];
  return rows;
}

bool degenerate(const Indices<3>& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

template <std::size_t N>
double thickest(const std::vector<double>& half, const std::array<Index, N>& points) {
  double out = 0;
  for (Index p : points) out = std::max(out, half[p]);
  return out;
}

struct EdgeUse {
  Index a, b, triangle, slot;
  friend auto operator<=>(const EdgeUse&, const EdgeUse&) = default;
};

}  // namespace

ContactMesh::ContactMesh(const model::Model& model, const std::vector<body::Body>& bodies,
                         const ContactOptions& o)
    : n_particles(static_cast<Index>(model.n_particles())), options(o) {
  for (std::size_t t = 0; t < model.n_triangles(); ++t)
    if (!degenerate(model.corners(t))) triangle.push_back(model.corners(t));
  n_cloth_triangles = static_cast<Index>(triangle.size());
  half_thickness.reserve(model.thickness.size());
  for (double t : model.thickness) half_thickness.push_back(0.5 * t);
  friction = model.friction;
  add_bodies(bodies);
  connect();
  const double half =
      half_thickness.empty() ? 0 : *std::max_element(half_thickness.begin(), half_thickness.end());
  if (options.self) largest_contact_distance = std::max(2 * half, options.self_minimum);
  if (!body_point.empty())
    largest_contact_distance = std::max({largest_contact_distance, half, options.body_minimum});
  measure_rest(model);
  plant_trees(model);
}

void ContactMesh::add_bodies(const std::vector<body::Body>& bodies) {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const auto first = static_cast<Index>(n_points());
    for (const Vector3d& v : bodies[b].mesh.vertices) {
      body_point.push_back(v);
      body_of_point.push_back(static_cast<Index>(b));
      friction.push_back(bodies[b].friction);
    }
    for (const std::array<int, 3>& t : bodies[b].mesh.triangles) {
      const Indices<3> corners{first + t[0], first + t[1], first + t[2]};
      if (!degenerate(corners)) triangle.push_back(corners);
    }
  }
}

void ContactMesh::connect() {
  std::vector<EdgeUse> uses;
  std::vector<std::pair<Index, Index>> at_point;
  for (std::size_t t = 0; t < triangle.size(); ++t)
    for (Index k = 0; k < 3; ++k) {
      const Index u = triangle[t][k], w = triangle[t][(k + 1) % 3];
      uses.push_back({std::min(u, w), std::max(u, w), static_cast<Index>(t), k});
      at_point.emplace_back(u, static_cast<Index>(t));
    }
  point_triangles = make_rows(n_points(), at_point);
  std::sort(uses.begin(), uses.end());
  triangle_edges.assign(triangle.size(), {-1, -1, -1});
  std::vector<std::pair<Index, Index>> at_edge, edges_at_point;
  for (const EdgeUse& use : uses) {
    if (edge.empty() || edge.back() != Indices<2>{use.a, use.b}) {
      edge.push_back({use.a, use.b});
      if (use.a < n_particles) ++n_cloth_edges;
      edges_at_point.emplace_back(use.a, static_cast<Index>(edge.size()) - 1);
      edges_at_point.emplace_back(use.b, static_cast<Index>(edge.size()) - 1);
    }
    triangle_edges[use.triangle][use.slot] = static_cast<Index>(edge.size()) - 1;
    at_edge.emplace_back(static_cast<Index>(edge.size()) - 1, use.triangle);
  }
  point_edges = make_rows(n_points(), edges_at_point);
  edge_triangles = make_rows(edge.size(), at_edge);
}

void ContactMesh::plant_trees(const model::Model& model) {
  std::vector<FloatBox> boxes(triangle.size() - n_cloth_triangles);
  const std::vector<Vector3d> none;
  for (std::size_t t = 0; t < boxes.size(); ++t)
    for (Index p : triangle[n_cloth_triangles + t]) boxes[t].grow(at(none, p));
  body_triangle_tree.build(boxes);
  boxes.assign(edge.size() - n_cloth_edges, {});
  for (std::size_t e = 0; e < boxes.size(); ++e)
    for (Index p : edge[n_cloth_edges + e]) boxes[e].grow(at(none, p));
  body_edge_tree.build(boxes);

  // Panels lie flat, one far above the other.
  constexpr double kApart = 100;  // m
  boxes.assign(n_cloth_triangles, {});
  std::vector<FloatBox> edge_boxes(n_cloth_edges);
  std::size_t kept = 0;
  for (std::size_t t = 0; t < model.n_triangles(); ++t) {
    if (degenerate(model.corners(t))) continue;
    std::array<Vector3d, 3> flat;
    for (int k = 0; k < 3; ++k) {
      const Index v = model.triangle[t][k];
      flat[k] = {model.vertex_uv[v][0], model.vertex_uv[v][1], kApart * model.vertex_panel[v]};
      boxes[kept].grow(flat[k]);
    }
    for (int k = 0; k < 3; ++k) {
      const Index e = triangle_edges[kept][k];
      if (edge_triangles[e].front() != static_cast<Index>(kept)) continue;  // one panel of a seam is enough
      edge_boxes[e].grow(flat[k]);
      edge_boxes[e].grow(flat[(k + 1) % 3]);
    }
    ++kept;
  }
  cloth_triangle_tree.build(boxes);
  cloth_edge_tree.build(edge_boxes);
}

void ContactMesh::measure_rest(const model::Model& model) {
  point_star.assign(n_particles, kInfinite);
  edge_star.assign(n_cloth_edges, kInfinite);
  std::vector<double> edge_rest(n_cloth_edges, kInfinite);
  std::size_t kept = 0;
  std::vector<std::array<double, 3>> height(n_cloth_triangles);  // of each corner over the opposite edge
  for (std::size_t t = 0; t < model.n_triangles(); ++t) {
    if (degenerate(model.corners(t))) continue;
    std::array<model::Vector2d, 3> uv;
    for (int k = 0; k < 3; ++k) uv[k] = model.vertex_uv[model.triangle[t][k]];
    const model::Vector2d ab = uv[1] - uv[0], ac = uv[2] - uv[0];
    const double twice_area = std::fabs(ab[0] * ac[1] - ab[1] * ac[0]);
    for (int k = 0; k < 3; ++k) {
      const double length = (uv[(k + 2) % 3] - uv[(k + 1) % 3]).norm();
      height[kept][k] = length > 0 ? twice_area / length : kInfinite;
      double& star = point_star[triangle[kept][k]];
      star = std::min(star, height[kept][k]);
      double& rest = edge_rest[triangle_edges[kept][(k + 1) % 3]];
      rest = std::min(rest, length);
    }
    ++kept;
  }
  for (Index e = 0; e < n_cloth_edges; ++e)
    for (Index end : edge[e])
      for (Index t : point_triangles[end]) {
        int at_end = 0, opposite = -1;
        for (int k = 0; k < 3; ++k) {
          if (triangle[t][k] == end) at_end = k;
          if (triangle[t][k] != edge[e][0] && triangle[t][k] != edge[e][1]) opposite = opposite < 0 ? k : 3;
        }
        edge_star[e] = std::min(edge_star[e], height[t][opposite < 3 ? opposite : at_end]);
      }
  // Dijkstra along the edges, as far as it can limit a contact distance.
  const double reach = options.self ? 2 * largest_contact_distance / kPathToStraight : 0;
  std::vector<double> distance(n_particles, kInfinite);
  std::vector<Index> touched;
  using Item = std::pair<double, Index>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
  near_.begin.assign(1, 0);
  for (Index source = 0; source < n_particles; ++source) {
    distance[source] = 0;
    touched.assign(1, source);
    queue.emplace(0.0, source);
    while (!queue.empty()) {
      const auto [d, i] = queue.top();
      queue.pop();
      if (d > distance[i]) continue;
      for (Index e : point_edges[i]) {
        const Index j = edge[e][0] == i ? edge[e][1] : edge[e][0];
        const double to_j = d + edge_rest[e];
        if (to_j > reach || to_j >= distance[j]) continue;
        if (distance[j] == kInfinite) touched.push_back(j);
        distance[j] = to_j;
        queue.emplace(to_j, j);
      }
    }
    std::sort(touched.begin(), touched.end());
    for (Index j : touched) {
      if (j != source) {
        near_.item.push_back(j);
        near_rest_.push_back(distance[j]);
      }
      distance[j] = kInfinite;
    }
    near_.begin.push_back(static_cast<Index>(near_.item.size()));
  }
}

double ContactMesh::graph_distance(Index i, Index j) const {
  if (i == j) return 0;
  const std::span<const Index> row = near_[i];
  const auto found = std::lower_bound(row.begin(), row.end(), j);
  if (found == row.end() || *found != j) return kInfinite;
  return near_rest_[near_.begin[i] + (found - row.begin())];
}

bool ContactMesh::joined(Index i, Index j) const {
  for (Index e : point_edges[i])
    if (edge[e][0] == j || edge[e][1] == j) return true;
  return false;
}

template <std::size_t M, std::size_t N>
double ContactMesh::cloth_distance(const std::array<Index, M>& a, const std::array<Index, N>& b,
                                   double star) const {
  const double free =
      std::max(thickest(half_thickness, a) + thickest(half_thickness, b), options.self_minimum);
  double path = kInfinite;
  bool neighbours = false;
  for (Index i : a)
    for (Index j : b) {
      path = std::min(path, graph_distance(i, j));
      // Beside a flat triangle the path along the edges says little: there the star alone is a bound.
      neighbours = neighbours || (0.5 * star < free && joined(i, j));
    }
  return std::min(free, 0.5 * (neighbours ? star : std::max(star, kPathToStraight * path)));
}

double ContactMesh::contact_distance_vt(Index point, Index triangle_id) const {
  const Indices<3>& t = triangle[triangle_id];
  if (is_body(point)) return std::max(thickest(half_thickness, t), options.body_minimum);
  if (is_body(t[0])) return std::max(half_thickness[point], options.body_minimum);
  return cloth_distance(Indices<1>{point}, t, point_star[point]);
}

double ContactMesh::contact_distance_ee(Index edge_a, Index edge_b) const {
  const Indices<2>&a = edge[edge_a], &b = edge[edge_b];
  if (is_body(b[0])) return std::max(thickest(half_thickness, a), options.body_minimum);
  return cloth_distance(a, b, std::max(edge_star[edge_a], edge_star[edge_b]));
}

}  // namespace garment::simulator
