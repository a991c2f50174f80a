#pragma once
// What touches what: points, edges and triangles of the cloth and, behind them, of the bodies, in one
// numbering.
//
//   points     0 .. n_particles-1 the cloth's particles, then the vertices of body 0, body 1, ... (these
//   never move) edges      0 .. n_cloth_edges-1, then those of the bodies triangles  0 ..
//   n_cloth_triangles-1, then those of the bodies
#include <Eigen/Core>
#include <span>
#include <vector>

#include "runtime/body/body.hpp"
#include "runtime/model/model.hpp"
#include "runtime/simulator/bvh.hpp"

namespace garment::simulator {

using Eigen::Vector3d;
using model::Index;
using model::Indices;

struct ContactOptions {
  bool self = true;  ///< cloth against cloth
  double self_minimum =
      0;  ///< m: contact distances of cloth with cloth are at least this, where the rest shape allows
  double body_minimum = 0;  ///< m: contact distances of cloth with a body are at least this
};

/// Lists of integers by row, one after the other.
struct Rows {
  std::vector<Index> begin;  ///< [n_rows + 1]
  std::vector<Index> item;
  std::span<const Index> operator[](std::size_t row) const {
    return {item.data() + begin[row], static_cast<std::size_t>(begin[row + 1] - begin[row])};
  }
};

/// Built once from the Model and the bodies; const afterwards.
class ContactMesh {
 public:
  ContactMesh(const model::Model& model, const std::vector<body::Body>& bodies,
              const ContactOptions& options = {});

  Index n_particles = 0, n_cloth_edges = 0, n_cloth_triangles = 0;
  std::vector<Indices<3>> triangle;        ///< points; degenerate ones (two equal points) are left out
  std::vector<Indices<2>> edge;            ///< points, ascending; each edge once
  std::vector<Indices<3>> triangle_edges;  ///< edges ab, bc, ca of each triangle
  std::vector<Vector3d> body_point;        ///< m, point n_particles + k
  std::vector<Index> body_of_point;        ///< body of body point k
  Rows point_triangles, point_edges, edge_triangles;  ///< what meets at a point or an edge, ascending
  std::vector<double> half_thickness;                 ///< m, of cloth points
  std::vector<double> friction;                       ///< Coulomb, of all points
  ContactOptions options;
  double largest_contact_distance = 0;  ///< m, over all pairs that can occur

  bool is_body(Index point) const { return point >= n_particles; }
  std::size_t n_points() const { return static_cast<std::size_t>(n_particles) + body_point.size(); }
  const Vector3d& at(const std::vector<Vector3d>& x, Index point) const {
    return point < n_particles ? x[point] : body_point[point - n_particles];
  }

  /// Distance below which a point and a triangle (or two edges) repel each other, m: half the thickness of
  /// both, at least the minimum of the options; of cloth with cloth at most half a lower bound of their
  /// distance along the sewn garment at rest, so that cloth never repels itself for being woven together.
  double contact_distance_vt(Index point, Index triangle_id) const;
  double contact_distance_ee(Index edge_a, Index edge_b) const;

  /// Lower bound of the distance from the point (or edge) to all triangles and edges that do not touch it,
  /// measured inside the cloth at rest, m: the smallest height of the triangles around it (gradient of the
  /// hat function).
  std::vector<double> point_star, edge_star;

  /// Trees over the parts of the bodies, which stay; item i is part n_cloth + i.
  Bvh body_triangle_tree, body_edge_tree;
  /// Trees over the parts of the cloth as it lies in the flat pattern: cloth that is near there stays near,
  /// so their shape serves all positions (refit a copy) and never depends on what happened before.
  Bvh cloth_triangle_tree, cloth_edge_tree;

 private:
  double graph_distance(Index i, Index j) const;  // infinite when not near neighbours
  bool joined(Index i, Index j) const;            // by an edge
  template <std::size_t M, std::size_t N>
  double cloth_distance(const std::array<Index, M>& a, const std::array<Index, N>& b, double star) const;
  void add_bodies(const std::vector<body::Body>& bodies);
  void connect();
  void measure_rest(const model::Model& model);
  void plant_trees(const model::Model& model);

  Rows near_;                      // per particle: particles within reach along the edges at rest, ascending
  std::vector<double> near_rest_;  // m, parallel to near_.item
};

}  // namespace garment::simulator
