#pragma once
// Proof that finished cloth neither cuts itself nor a body, on the coordinates as they are written to the
// file.
#include <cstdint>
#include <vector>

#include "runtime/body/body.hpp"
#include "runtime/model/model.hpp"

namespace garment::simulator {

/// Two cloth triangles that meet, a < b.
struct SelfHit {
  model::Index a = -1, b = -1;
  friend bool operator==(const SelfHit&, const SelfHit&) = default;
};

/// A cloth triangle that meets a triangle of a body.
struct BodyHit {
  int body = -1;
  model::Index triangle = -1;
  int body_triangle = -1;
  friend bool operator==(const BodyHit&, const BodyHit&) = default;
};

/// A particle inside a body (or exactly on its surface).
struct InsideHit {
  int body = -1;
  model::Index particle = -1;
  friend bool operator==(const InsideHit&, const InsideHit&) = default;
};

/// What `certify` found. The lists are sorted and hold at most kMaxListed entries each; the counts are
/// complete.
struct Certificate {
  static constexpr std::size_t kMaxListed = 10000;

  bool finite = true;  ///< every coordinate is a finite number; otherwise nothing else was tested
  std::size_t self_intersections = 0;  ///< triangle pairs
  std::size_t body_intersections = 0;  ///< triangle pairs, all bodies
  std::size_t inside_body = 0;         ///< particles, once per body that contains them
  std::vector<SelfHit> self_hits;
  std::vector<BodyHit> body_hits;
  std::vector<InsideHit> inside_hits;

  bool clean() const { return finite && self_intersections + body_intersections + inside_body == 0; }
};

/// Tests triangles (particle ids) at `positions` [n_particles], metres, against themselves and against
/// `bodies`.
///
/// Signs of determinants are exact. Touching counts. Particles with one id or closer than 1e-9 m are one
/// point: pairs that share two or three points are not tested, pairs that share one are tested by their
/// opposite edges. Inside means a winding number of 1/2 or more, counted by the signed crossings of a ray,
/// which is the same on a closed mesh; where a body overlaps itself it says nothing against the garment. Same
/// result for any thread count.
Certificate certify(const std::vector<model::Indices<3>>& triangles,
                    const std::vector<model::Vector3d>& positions,
                    const std::vector<const body::TriangleMesh*>& bodies = {});

/// The triangles of `model` at the positions of `state` against all `bodies`.
Certificate certify(const model::Model& model, const model::State& state,
                    const std::vector<body::Body>& bodies);

}  // namespace garment::simulator
