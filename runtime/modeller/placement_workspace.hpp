#pragma once
// What the steps of a placement share.
#include <optional>
#include <string>
#include <utility>
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

/// The other one of a pair ("front.left", "front_right") on the same part of the same body.
inline std::optional<std::size_t> image_of(const design::Garment& garment, std::size_t panel) {
  const design::Panel& p = garment.panels[panel];
  for (const char* joint : {".", "_"})
    for (const auto& [own, other] : {std::pair{"left", "right"}, std::pair{"right", "left"}}) {
      const std::string end = std::string(joint) + own;
      if (!p.name.ends_with(end)) continue;
      const std::string name = p.name.substr(0, p.name.size() - end.size()) + joint + other;
      for (std::size_t k = 0; k < garment.panels.size(); ++k) {
        const design::Panel& q = garment.panels[k];
        if (q.name == name && q.placement.kind == p.placement.kind && q.placement.part == p.placement.part && q.placement.body == p.placement.body)
          return k;
      }
    }
  return std::nullopt;
}

}  // namespace garment::modeller
