#include "runtime/simulator/holds.hpp"

#include <Eigen/Dense>
#include <map>

namespace garment::simulator {

Holds::Holds(const model::Model& model)
    : kind_(model.n_particles(), Kind::free), slot_(model.n_particles(), 0) {
  std::map<model::Index, std::vector<Eigen::Vector3d>> normals;
  for (std::size_t h = 0; h < model.hold_particle.size(); ++h) {
    model::Index i = model.hold_particle[h];
    auto& list = normals[i];
    if (model.hold_kind[h] == model::HoldKind::point)
      kind_[i] = Kind::fixed;
    else
      list.push_back(model.hold_normal[h].normalized());
  }
  for (const auto& [i, list] : normals) {
    held_.push_back(static_cast<std::size_t>(i));
    if (kind_[i] == Kind::fixed) continue;
    Eigen::Matrix3d p = Eigen::Matrix3d::Identity();
    for (const Eigen::Vector3d& n : list) {  // Gram-Schmidt: take away what is left of each normal
      Eigen::Vector3d rest = p * n;
      if (rest.norm() < 1e-6) continue;
      rest.normalize();
      p -= rest * rest.transpose();
    }
    if (p.norm() < 1e-6) {
      kind_[i] = Kind::fixed;
      continue;
    }
    kind_[i] = Kind::sliding;
    slot_[i] = static_cast<std::uint32_t>(projector_.size());
    projector_.push_back(p);
  }
}

Eigen::Vector3d Holds::error(const model::Model& model, std::size_t hold, const Eigen::Vector3d& x) const {
  Eigen::Vector3d off = model.hold_point[hold] - x;
  if (model.hold_kind[hold] == model::HoldKind::point) return off;
  Eigen::Vector3d n = model.hold_normal[hold].normalized();
  return n * n.dot(off);
}

}  // namespace garment::simulator
