#pragma once
// Garments that are their own mirror image on a body that is: they are kept so on their way to rest.
#include <Eigen/Core>
#include <vector>

#include "runtime/base/archive.hpp"
#include "runtime/body/body.hpp"
#include "runtime/model/model.hpp"

namespace garment::simulator {

inline constexpr double kEven = 1e-5;  ///< m, from its image: a pair of particles lies evenly

/// Left and right of a garment: its images in the plane x = 0. Folds buckle to the one side or the other by the last bits of the
/// numbers, and differ on the two halves of a garment that was cut on the fold. A tailor who cuts it so means it to hang alike.
/// Forces on a garment that lies as its own image are images too, so one that rests so rests.
class Mirror {
 public:
  Mirror() = default;
  /// The images of the model's particles, by the flat panels. Empty where the garment is not its own image: thickness, friction, pads and
  /// holds of all particles are compared, mass, stiffness, rigidity and folds of most, and of each panel as a whole, and forces
  /// where it lies evenly but no longer flat; or where a body is not, or something moves, or wind blows from a side.
  Mirror(const model::Model& model, const std::vector<body::Body>& bodies);

  bool empty() const { return image_.empty(); }
  /// Of each particle [n_particles], itself in the middle; -1: none.
  const std::vector<model::Index>& image() const { return image_; }
  /// Of a part that consists of the whole's `particle`, of which those marked `free` may move.
  Mirror of_part(const std::vector<model::Index>& particle, const std::vector<char>& free) const;
  /// Less the pairs that lie unevenly at x, by more than `most`, m.
  Mirror where_even(const std::vector<Eigen::Vector3d>& x, double most) const;
  /// Particles that have an image.
  std::size_t n_paired() const;
  /// In a checkpoint.
  void keep(Archive& a, std::size_t n_particles);
  /// Marks the images of what is marked [n_particles].
  void spread(std::vector<char>& marks) const;
  /// Of forces on a garment that lies as its own image, the mean of both sides: where the triangles of the two sides differ, that
  /// of the cloth and of its image.
  void even(std::vector<Eigen::Vector3d>& force) const;
  /// How far x is at most from lying so, m.
  double unevenness(const std::vector<Eigen::Vector3d>& x) const;
  /// Changes dx (m) so that x + dx lies as its own image, halfway between the two sides.
  void even(const std::vector<Eigen::Vector3d>& x, std::vector<Eigen::Vector3d>& dx) const;

 private:
  std::vector<model::Index> image_;
};

}  // namespace garment::simulator
