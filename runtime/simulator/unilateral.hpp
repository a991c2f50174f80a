#pragma once
// Contacts as unilateral constraints: impulses that part what meets, and rub (docs/physics.md, section 3.8).
#include <Eigen/Core>
#include <vector>

#include "runtime/simulator/moving_cloth.hpp"

namespace garment::simulator {

/// A contact: u = n . (sum w_k v_k - base) is the speed at which it opens.
struct Touching {
  Indices<4> particle{-1, -1, -1, -1};
  std::array<double, 4> weight{};
  Eigen::Vector3d normal{0, 0, 0};
  Eigen::Vector3d base{0, 0, 0};  ///< m/s, of the body there
  double gap = 0;                 ///< d, m; negative: too near
  double friction = 0;            ///< Coulomb
};

/// All contacts of cloth with bodies and with cloth that are closed, or may close within h.
std::vector<Touching> contacts_of(const MovingCloth& cloth, const std::vector<Eigen::Vector3d>& x, double h);

/// Changes `v` by impulses p >= 0 along the normals so that nothing comes nearer than it may: u' >= -d/h while open, and what is too
/// near parts with beta |d| / h; inelastic (e = 0). Across the normals impulses act against the slip, at most mu p. Projected
/// Gauss-Seidel on (Jc W JcT) p = -(u + beta d/h): rows whose p would be negative are zero. Held particles do not move. Returns
/// the heat of the slip, J.
double part(const model::Model& model, const Holds& holds, const std::vector<Touching>& contacts, double h,
            std::vector<Eigen::Vector3d>& v);

}  // namespace garment::simulator
