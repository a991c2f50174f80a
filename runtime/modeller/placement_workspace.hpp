#pragma once
// What the steps of a placement share.
#include <vector>

#include "runtime/base/finding.hpp"
#include "runtime/body/body.hpp"
#include "runtime/design/garment.hpp"
#include "runtime/model/model.hpp"
#include "runtime/modeller/placement_hinge.hpp"

namespace garment::modeller {

/// `place` holds a position per vertex; `done` says per panel whether it has one.
struct Workspace {
  const design::Garment& garment;
  const std::vector<body::Body>& bodies;
  const model::Model& model;
  Findings& findings;
  std::vector<Eigen::Vector3d> place;
  std::vector<bool> done;
  std::vector<Eigen::Vector3d> flat;  ///< of every vertex: where it lies in its panel when the pleats are folded, and above it, m
  std::vector<HingedPanel> turned{};  ///< in the order in which they were laid
};

template <class F>
void for_each_vertex(const model::Model& model, std::size_t panel, const F& f) {
  const model::PanelRange& range = model.panels[panel];
  for (model::Index v = range.first_vertex; v < range.first_vertex + range.n_vertices; ++v) f(v);
}

}  // namespace garment::modeller
