#pragma once
// How far two near parts of the cloth have moved against each other since a list of pairs was made.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "runtime/simulator/contact_mesh.hpp"

namespace garment::simulator {

/// Upper bounds of the relative motion of two parts since the reference, m. The closest points of two parts are mixtures of
/// their corners, so their distance changes by no more than the largest difference of the motions of a corner of the one and
/// a corner of the other: nothing for what moves on together, however fast.
class RelativeMotion {
 public:
  /// Of positions x [n_particles] against `reference`; with `dx`, the larger of x and x + dx (and so of all between).
  RelativeMotion(const std::vector<Vector3d>& reference, const std::vector<Vector3d>& x, const std::vector<Vector3d>* dx = nullptr)
      : now_(x.size()), then_(dx ? x.size() : 0) {
    float largest = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const Vector3d moved = x[i] - reference[i];
      now_[i] = moved.cast<float>();
      largest = std::max(largest, now_[i].cwiseAbs().maxCoeff());
      if (!dx) continue;
      then_[i] = (moved + (*dx)[i]).cast<float>();
      largest = std::max(largest, then_[i].cwiseAbs().maxCoeff());
    }
    rounding_ = 1e-6F * largest + 1e-12F;
  }

  float of_point_and_triangle(const ContactMesh& mesh, Index v, Index t) const {
    const Indices<3>& c = mesh.triangle[t];
    float most = 0;
    for (Index corner : c) most = std::max(most, squared(mesh, v, corner));
    return bound(most);
  }
  float of_edges(const ContactMesh& mesh, Index e, Index f) const {
    const Indices<2>&i = mesh.edge[e], &j = mesh.edge[f];
    return bound(std::max(std::max(squared(mesh, i[0], j[0]), squared(mesh, i[0], j[1])),
                          std::max(squared(mesh, i[1], j[0]), squared(mesh, i[1], j[1]))));
  }

 private:
  static float difference(const std::vector<Eigen::Vector3f>& u, const ContactMesh& mesh, Index p, Index q) {
    if (mesh.is_body(p)) return u[q].squaredNorm();
    if (mesh.is_body(q)) return u[p].squaredNorm();
    return (u[p] - u[q]).squaredNorm();
  }
  float squared(const ContactMesh& mesh, Index p, Index q) const {
    const float now = difference(now_, mesh, p, q);
    return then_.empty() ? now : std::max(now, difference(then_, mesh, p, q));
  }
  float bound(float squared_difference) const { return std::sqrt(squared_difference) * 1.00001F + rounding_; }

  std::vector<Eigen::Vector3f> now_, then_;
  float rounding_ = 0;  // of single precision
};

}  // namespace garment::simulator
