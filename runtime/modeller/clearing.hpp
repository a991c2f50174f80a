#pragma once
// Pushing the start off a body: particles and points of edges go out, the others follow.
#include <array>
#include <optional>
#include <vector>

#include "runtime/body/body.hpp"
#include "runtime/model/model.hpp"

namespace garment::modeller {

/// Pushes `model.start` off one body, as often as it is asked to. Refers to both.
class Clearing {
 public:
  Clearing(const body::Body& body, model::Model& model);

  /// Moves particles and edges that pierce the body out of it, along the normal of the closest point of its surface, or, in
  /// a leg, away from the leg's middle; neighbours follow smoothly. Returns how many places still pierce it.
  std::size_t go();

  /// How many places pierce the body as they lie.
  std::size_t pierced() { return find(0).size(); }

 private:
  /// A point of a triangle, by its weights, and the way it has to go.
  struct Push {
    model::Indices<3> corner;
    std::array<double, 3> weight;
    model::Vector3d way;
  };
  /// The last distance query at a place. Distance falls by no more than the way gone since, so most need not be asked again.
  struct Sounding {
    model::Vector3d at{0, 0, 0};
    double distance = -1e300;  ///< m, signed
    double least(const model::Vector3d& p) const { return distance - (p - at).norm(); }
  };

  std::vector<Push> find(double gap);
  void look_at(std::size_t t, double gap, std::vector<Push>& out);
  std::optional<body::SurfacePoint> sound(const model::Vector3d& p, Sounding& last) const;
  model::Vector3d way_out(const model::Vector3d& p, const body::SurfacePoint& hit) const;
  std::optional<model::Vector3d> out_of_leg(const model::Vector3d& p) const;
  void apply(const std::vector<Push>& pushes);
  void find_sides(const model::Model& model);
  void keep_side(std::size_t i);

  const body::Body& body_;
  std::vector<model::Vector3d>& x_;
  std::vector<model::Vector3d> moved_;  ///< since go() began, m
  std::vector<bool> pushed_;            ///< since go() began: what was pushed out does not follow others back in
  std::vector<std::vector<model::Index>> neighbours_;
  std::vector<model::Indices<3>> triangles_;
  std::vector<Sounding> middles_;               ///< of every triangle
  std::vector<std::vector<Sounding>> samples_;  ///< of the points looked at on every triangle
  std::vector<const body::Part*> legs_;
  std::vector<int> side_;             ///< whose leg's cloth a particle is: +1 left of the middle, -1 right, 0 neither
  double middle_ = 0, top_ = -1e300;  ///< x between the legs, y of their upper ends, m
};

}  // namespace garment::modeller
