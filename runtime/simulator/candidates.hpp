#pragma once
// Pairs that are near enough to matter: kept over several steps, until somebody has moved too far.
#include <array>
#include <cstdint>
#include <vector>

#include "runtime/simulator/bvh.hpp"
#include "runtime/simulator/contact_mesh.hpp"

namespace garment::simulator {

struct Tangle;

/// Kinds of pairs, in the order in which they are listed. v a point, t a triangle, e an edge.
enum class PairKind : std::uint8_t { cloth_vt, cloth_ee, cloth_v_body_t, body_v_cloth_t, cloth_e_body_e };
inline constexpr std::size_t kPairKinds = 5;
inline bool is_vt(PairKind k) { return k != PairKind::cloth_ee && k != PairKind::cloth_e_body_e; }
inline bool is_body(PairKind k) { return k > PairKind::cloth_ee; }

inline constexpr std::size_t kPairGrain = 4096;  ///< pairs of one chunk of a parallel loop

/// Two parts that do not share a point.
struct Pair {
  Index a = -1;                ///< point (VT) or edge (EE); with bodies the cloth's edge
  Index b = -1;                ///< triangle (VT) or edge (EE)
  float contact_distance = 0;  ///< m
  float distance = 0;          ///< m, at the reference positions, rounded down
};

class Candidates {
 public:
  /// Lists all pairs closer than `radius` (m) at positions `x` [n_particles], which become the reference. The
  /// order depends on nothing but the input. Forgets what was exempt.
  void rebuild(const ContactMesh& mesh, const std::vector<Vector3d>& x, double radius);

  /// True while cloth that the list leaves out cannot be nearer than `least` (m), at x nor, with `dx`, on the way from x to
  /// x + dx: where parts have come near each other they have moved by less than radius() - least against each other since the
  /// reference. It bears cloth that moves on together, however far. Bodies are not looked at.
  bool complete(const ContactMesh& mesh, const std::vector<Vector3d>& x, const std::vector<Vector3d>* dx, double least) const;
  double reach() const { return reach_; }  ///< within it of the reference nothing meets what the list leaves out, m
  double radius() const { return radius_; }

  /// Takes the pairs that cut each other now out of contact and truncation, and puts all others back: the
  /// edges and corners of every hit, between cloth and cloth the triangles around the one that is cut as
  /// well, and everything of particles inside a body against bodies.
  void exempt(const ContactMesh& mesh, const Tangle& tangle);

  const std::vector<Pair>& pairs() const { return pairs_; }
  bool is_exempt(std::size_t pair) const { return !exempt_.empty() && exempt_[pair] != 0; }
  std::size_t begin(PairKind k) const { return first_[static_cast<std::size_t>(k)]; }
  std::size_t end(PairKind k) const { return first_[static_cast<std::size_t>(k) + 1]; }
  const std::vector<Vector3d>& reference() const { return reference_; }

 private:
  std::vector<Pair> pairs_;
  std::array<std::size_t, kPairKinds + 1> first_{};
  std::vector<std::uint8_t> exempt_;  // empty: none
  std::vector<Vector3d> reference_;
  double radius_ = 0, reach_ = 0;
  Bvh triangle_tree_, edge_tree_;  // of the cloth, at the reference
};

}  // namespace garment::simulator
