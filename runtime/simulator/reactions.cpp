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

}  // namespace garment::simulator
