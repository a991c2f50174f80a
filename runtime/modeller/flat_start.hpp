#pragma once
// The shape in which a panel begins before it is laid onto a body: flat, with its pleats folded, folded in half, and off its
// plane where other panels lie under it.
#include "runtime/design/garment.hpp"
#include "runtime/model/model.hpp"

namespace garment::modeller {

/// Between layers of cloth at the start, m: of a panel against what lies on it.
double layer_gap(const design::Garment& garment, int panel);

/// Of every vertex [n_vertices]: its place (x, y) in the panel's plane and its distance from it towards the face, m. Pleated
/// panels start folded: drawn together from the flat they would be a heap. `start folded` folds in half to the back: along the
/// first line inside the panel that is ironed to a fold, else along the panel's fold, else across its longer extent.
/// Panels that lie over or under others, and have a place of their own on a body, start clear of those and of their pleats.
std::vector<model::Vector3d> flat_start(const design::Garment& garment, const model::Model& model);

}  // namespace garment::modeller
