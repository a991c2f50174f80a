#pragma once
// Contacts that act now, and the energy by which they repel.
#include <vector>

#include "runtime/simulator/candidates.hpp"
#include "runtime/simulator/contact_mesh.hpp"

namespace garment::simulator {

/// One contact. Gap vector g = sum_k w[k] x(p[k]); distance d = |g|; normal n = g / d.
///   energy              share * E(d)
///   force on point k   -share * E'(d) w[k] n     (E' < 0: repulsion; bodies take no force)
///   Hessian block k,l   share * E''(d) w[k] w[l] n nT   (SPD part)
///
/// share: 1 for a point against a triangle, whichever part of the triangle is nearest, so that nothing jumps where that
/// changes; from 0 to 1 for edges, less where they are parallel and their closest points jump. Shares are kept through one step: its energy is
/// then smooth, and its forces are the energy's gradient.
struct Contact {
  Indices<4> p{-1, -1, -1,
               -1};           ///< points; VT: v, a, b, c; EE: a, b, c, d; -1 with w = 0 where fewer take part
  std::array<double, 4> w{};  ///< sums to 0; positive side first
  Vector3d normal{0, 0, 0};   ///< unit, from the second part towards the first
  double distance = 0;        ///< m
  double contact_distance = 0;  ///< m, > distance
  double friction = 0;          ///< Coulomb: geometric mean of both sides
  double share = 1;             ///< (0, 1]
  bool body = false;  ///< one side is a body (its points have ids >= n_particles)
  Index pair = -1;    ///< in Candidates::pairs()
};

/// All contacts with distance < contact distance among the pairs that are not exempt; sorted by pair.
/// Complete while `candidates.complete(mesh, x, nullptr, mesh.largest_contact_distance)`. Same result for any thread count. Overwrites `out`, keeps its
/// memory. `shares` [candidates.pairs(), 0: not active], when given, stand for those that x would ask for.
void active_contacts(const ContactMesh& mesh, const Candidates& candidates, const std::vector<Vector3d>& x,
                     std::vector<Contact>& out, const std::vector<float>* shares = nullptr);

/// Contacts that do not act at x, but would after the step dx as its linear picture has it: the gap's closest points and
/// direction stay those of x. Sorted by pair; same result for any thread count. Overwrites `out`.
void coming_contacts(const ContactMesh& mesh, const Candidates& candidates, const std::vector<Vector3d>& x,
                     const std::vector<Vector3d>& dx, std::vector<Contact>& out);

/// Contact energy E and derivatives at distance d for contact distance r and stiffness k (N/m):
///   0 < d < r   k/3 (r - d)^2 ln(r / d)
/// near r that is k/3 (r - d)^3 / r: cloth that only lies on cloth is met softly and does not rattle between touching and not
/// touching. Twice differentiable at r; infinite at 0. d is held above 1e-9 m. Source: Li et al. 2020, Incremental potential
/// contact, eq. 6.
struct ContactEnergy {
  double value = 0;   ///< J
  double first = 0;   ///< dE/dd, N, <= 0
  double second = 0;  ///< d2E/dd2, N/m, >= 0
};
ContactEnergy contact_energy(double distance, double contact_distance, double stiffness);

}  // namespace garment::simulator
