#pragma once
// Patterns drawn flat in space are brought nearer to the body they are worn on: sleeves to the arms, hoods
// behind the head, panels out of the body, and seams, which lie at the mean of the panels they join, off it.
#include <cmath>
#include <utility>
#include <vector>

#include "runtime/body/body.hpp"
#include "runtime/design/garment.hpp"
#include "runtime/model/model.hpp"

namespace garment::modeller {

/// A sleeve is what is labelled "arm" or has "sleeve" in its name.
bool is_sleeve(const design::Panel& panel);

/// Lifts a garment drawn for a shorter person, whole, until its shoulder seams (where fronts and backs meet above the bust,
/// nearer to the middle than the sides of the torso) lie 1 cm over the shoulders. Leaves alone what would have to go more than 40 cm. Never lowers: what is too high falls.
void lift_to_shoulders(const design::Garment& garment, const body::Body& body, const model::Model& model,
                       std::vector<Eigen::Vector3d>& place);

/// Turns and moves the rigidly placed sleeve panels of each side together so that their common axis lies on
/// the arm of a person; how far out they begin stays. `place` [n_vertices], m. Bodies without arms change
/// nothing.
void follow_arms(const design::Garment& garment, const body::Body& body, const model::Model& model,
                 std::vector<Eigen::Vector3d>& place);

/// Turns the legs of trousers that are drawn for another pose about their crotch onto the legs of a person,
/// and lowers them until the crotch lies 2 cm below the person's, at most 20 cm. Panels are legs when left
/// and right, front and back meet in one particle near the crotch.
void follow_legs(const design::Garment& garment, const body::Body& body, const model::Model& model,
                 std::vector<Eigen::Vector3d>& place);

/// Moves hoods (upright panels that face sideways beside the head, sewn to each other) back until the seam
/// between them lies behind the head, at most 15 cm.
void follow_head(const design::Garment& garment, const body::Body& body, const model::Model& model,
                 std::vector<Eigen::Vector3d>& place);

/// Moves rigidly placed panels along their normals, away from the middle of the part of the body they lie on,
/// until none of their own particles (those no seam shares) is less than 5 mm (and a third of the grid's
/// spacing) outside, at most 12 cm; a panel that this does not free stays where it was.
void clear_panels(const design::Garment& garment, const body::Body& body, const model::Model& model,
                  std::vector<Eigen::Vector3d>& place);

/// Moves rigidly placed panels that lie in one plane, touch, and are not sewn to each other (the fronts of an
/// open jacket) 1 cm apart each: edges that coincide would cut one another as soon as they move.
void part_panels(const design::Garment& garment, const model::Model& model,
                 std::vector<Eigen::Vector3d>& place);

/// Seams bring their particles to the mean of the places of their panels, here of those that are `placed` [n_panels]: so are their
/// vertices, and the rest of each rigidly placed panel follows, less the farther it lies from the seam (about 8 cm), so that no row
/// of cells takes the whole way. Panels wrapped round the torso follow near the seams with panels that have no place yet, which go
/// on from there: a neckline. Particles that are `wanted` elsewhere are brought there.
void spread_seams(const design::Garment& garment, const model::Model& model, const std::vector<bool>& placed,
                  const std::vector<std::pair<model::Index, Eigen::Vector3d>>& wanted, std::vector<Eigen::Vector3d>& place);

/// Rounds a place that was moved to 1e-9 m. Sums over neighbours follow the order in which panels are declared; what is decided by
/// their last bits must not.
inline void drop_last_bits(Eigen::Vector3d& place) {
  constexpr double kPlaces = 1 << 30;  // in a metre
  for (double& x : place) x = std::round(x * kPlaces) / kPlaces;
}

/// Moves particles and edges of `model.start` that pierce a person out of it (clearing.hpp). Returns how many places
/// still pierce it. Persons only: a body without parts changes nothing.
std::size_t clear_start(const body::Body& body, model::Model& model);

/// Does the start pierce a person?
bool starts_inside(const body::Body& body, model::Model& model);

/// Does cloth cross cloth in `model.start`, panels that are `left_out` [n_panels] apart?
bool crosses(const model::Model& model, const std::vector<bool>& left_out);

/// Takes apart cloth that crosses cloth in `model.start`: seams that pull panels together leave folds beside them that
/// cut one another. There, and in a growing neighbourhood, the cloth is smoothed like a membrane, which ends embedded
/// where the body stands between what must not meet, and kept off the bodies. Cloth that crosses nothing and
/// touches no body stays as it is. Panels that are `left_out` [n_panels] are not looked at; they move where others hold them and where
/// bodies push. Ends with the fewest
/// pairs of triangles that were seen to meet, and returns their number.
std::size_t take_apart(const std::vector<body::Body>& bodies, const std::vector<bool>& left_out, model::Model& model);

}  // namespace garment::modeller
