#pragma once
// Particles that are held: which of their motions are free.
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "runtime/model/model.hpp"

namespace garment::simulator {

/// Projects displacements and forces onto what the holds leave free: nothing for a held point, a plane for one that
/// slides. A particle with several holds keeps only what all of them allow.
class Holds {
 public:
  explicit Holds(const model::Model& model);

  bool is_free(std::size_t i) const { return kind_[i] == Kind::free; }
  bool is_fixed(std::size_t i) const { return kind_[i] == Kind::fixed; }

  /// Free part of a vector at particle i.
  template <class Vector>
  Vector filtered(std::size_t i, const Vector& v) const {
    if (kind_[i] == Kind::free) return v;
    if (kind_[i] == Kind::fixed) return Vector::Zero();
    return projector_[slot_[i]].template cast<typename Vector::Scalar>() * v;
  }
  Eigen::Matrix3d projector(std::size_t i) const {
    if (kind_[i] == Kind::free) return Eigen::Matrix3d::Identity();
    if (kind_[i] == Kind::fixed) return Eigen::Matrix3d::Zero();
    return projector_[slot_[i]];
  }
  template <class Vector>
  void filter(std::vector<Vector>& v) const {
    for (std::size_t i : held_) v[i] = filtered(i, v[i]);
  }

  /// How far particle i is from where its hold wants it, m (zero for free particles).
  Eigen::Vector3d error(const model::Model& model, std::size_t hold, const Eigen::Vector3d& x) const;

 private:
  enum class Kind : std::uint8_t { free, sliding, fixed };
  std::vector<Kind> kind_;
  std::vector<std::uint32_t> slot_;
  std::vector<std::size_t> held_;
  std::vector<Eigen::Matrix3d> projector_;
};

}  // namespace garment::simulator
