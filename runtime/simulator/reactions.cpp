#include "runtime/simulator/reactions.hpp"

namespace garment::simulator {

std::vector<Eigen::Vector3d> reactions(const model::Model& model, const Holds& holds, const std::vector<Eigen::Vector3d>& force) {
  std::vector<Eigen::Vector3d> sums(model.holders.size(), Eigen::Vector3d::Zero());
  for (std::size_t h = 0; h < sums.size(); ++h)
    for (const model::Index p : model.holders[h].particles) {
      const auto i = static_cast<std::size_t>(p);
      sums[h] -= force[i] - holds.filtered(i, force[i]);
    }
  return sums;
}

std::vector<Eigen::Vector3d> moments(const model::Model& model, const Holds& holds, const std::vector<Eigen::Vector3d>& force,
                                     const std::vector<Eigen::Vector3d>& x) {
  std::vector<Eigen::Vector3d> sums(model.holders.size(), Eigen::Vector3d::Zero());
  for (std::size_t h = 0; h < sums.size(); ++h) {
    const std::vector<model::Index>& held = model.holders[h].particles;
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const model::Index p : held) middle += x[static_cast<std::size_t>(p)] / static_cast<double>(held.size());
    for (const model::Index p : held) {
      const auto i = static_cast<std::size_t>(p);
      sums[h] += (x[i] - middle).cross(holds.filtered(i, force[i]) - force[i]);
    }
  }
  return sums;
}

}  // namespace garment::simulator
