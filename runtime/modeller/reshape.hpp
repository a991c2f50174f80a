#pragma once
// A shape that was carried over to a garment of other measures, with every part of the cloth at its own size again.
#include <vector>

#include "runtime/body/body.hpp"
#include "runtime/modeller/transfer.hpp"

namespace garment::modeller {

/// `laid` is the shape that `transfer` gives: the changed cloth lies squeezed or stretched on the old surface. Each of its
/// triangles is turned as it lies there and stretched as the cloth was at that place before; positions are sought whose
/// gradients come nearest to that in least squares (Poisson reconstruction: Sumner and Popovic, "Deformation transfer for
/// triangle meshes", 2004). Held particles go to their holds, cloth that rests on top of a body keeps its height, all else
/// is held where it lies by a very weak spring. A garment that was not changed keeps its positions bit for bit. May start
/// intersections.
std::vector<model::Vector3d> reshape(const ModelledGarment& before, const std::vector<model::Vector3d>& position,
                                     const ModelledGarment& now, const Transferred& laid,
                                     const std::vector<body::Body>& bodies);

}  // namespace garment::modeller
