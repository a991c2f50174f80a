#pragma once
// What the linear system knows of a contact.
#include <Eigen/Core>

#include "runtime/model/model.hpp"

namespace garment::simulator {

inline constexpr double kForeseenDepth = 5e-6;  ///< m: contacts that a step would press by less cost no energy worth a second solution

/// The second derivative of one contact's energy: stiffness * g gT with g = (w_0 n, ..., w_3 n). Kept apart
/// from the matrix because contacts come and go. Particles with id -1 do not move (they belong to a body).
struct ContactStiffness {
  model::Index particle[4];
  float weight[4];
  Eigen::Vector3f normal;
  float stiffness = 0;  ///< N/m
};

}  // namespace garment::simulator
