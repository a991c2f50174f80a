#pragma once
// What a drape to rest and cloth in motion share: the numbers of cloth against cloth, and its forces.
#include <Eigen/Core>
#include <vector>

#include "runtime/body/body.hpp"
#include "runtime/model/model.hpp"
#include "runtime/simulator/block_matrix.hpp"
#include "runtime/simulator/contact.hpp"
#include "runtime/simulator/contact_stiffness.hpp"

namespace garment::simulator {

inline constexpr double kStandardGravity = 9.80665;  ///< m/s^2
inline constexpr double kSelfOffset = 1.2e-3;        ///< m, least contact distance of cloth with cloth
inline constexpr double kContactStiffness = 100;     ///< N/m, of contact_energy

/// For what is between cloth and cloth alone.
const std::vector<body::Body>& no_bodies();

/// Mean length of the triangles' edges in the flat pattern, m (in space the start may be stretched).
double mean_edge(const model::Model& model);

/// Largest strain of springs and of the threads in cut cells at x [n_particles], where open seams stretch the cloth.
double largest_thread_strain(const model::Model& model, const std::vector<Eigen::Vector3d>& x);

/// Adds the forces (N) of `contacts` to `force` [n_particles]; with a matrix their diagonal blocks to it, and the contacts to
/// `rows`, which is overwritten.
void add_contact_forces(const std::vector<Contact>& contacts, double stiffness, std::vector<Eigen::Vector3d>& force,
                        BlockMatrix* matrix, std::vector<ContactStiffness>& rows);

}  // namespace garment::simulator
