#pragma once
// Sleeping regions: where little of a garment still moves, that is settled alone.
#include <vector>

#include "runtime/body/body.hpp"
#include "runtime/model/model.hpp"
#include "runtime/simulator/relaxation.hpp"

namespace garment::simulator {

/// Near rest a garment hangs still but for some buckles that move on, a few millimetres in a hundred steps. What moved more than
/// 0.03 mm in the last step, and two rings of particles about it, is a garment of its own then (model::part_of): all else sleeps,
/// held where it is. Some steps of that, at a small share of the price, and the whole garment is looked at again; only
/// the whole garment is ever judged to be at rest.
class Awake {
 public:
  /// Keeps references to all four.
  Awake(const model::Model& model, const std::vector<body::Body>& bodies, const Mirror& mirror, const Relaxation& whole);

  /// Settles what moved on the way from `before` to x [n_particles], where that is little: at most 30 steps, fewer where its share
  /// of the residual falls well under `target`. Returns the steps made. Starts no intersection. Precondition: a step of
  /// `whole` ended at x, nothing is tangled, and neither cloth rubs on cloth nor within itself.
  int settle(Relaxation& whole, const std::vector<Eigen::Vector3d>& before, double target, std::vector<Eigen::Vector3d>& x) const;

 private:
  std::vector<char> moving(const std::vector<Eigen::Vector3d>& before, const std::vector<Eigen::Vector3d>& x) const;
  std::vector<char> near(const std::vector<char>& free, const std::vector<Eigen::Vector3d>& x, double leash) const;

  const model::Model& model_;
  const std::vector<body::Body>& bodies_;
  const Mirror& mirror_;
  const ContactMesh& mesh_;
  std::vector<std::size_t> triangle_;  // of the model, by triangle of the mesh
};

}  // namespace garment::simulator
