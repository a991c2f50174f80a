#include "runtime/simulator/moved_bodies.hpp"

#include "runtime/model/motion.hpp"

namespace garment::simulator {
namespace {

void move(body::Body& body, const model::Placement& p) {
  for (Eigen::Vector3d& v : body.mesh.vertices) v = p.apply(v);
  for (auto& [name, level] : body.levels) level.height += p.apply({0, level.height, 0}).y() - level.height;
  for (auto& [name, part] : body.parts)
    for (body::Section& s : part.sections) {
      s.center = p.apply(s.center);
      for (Eigen::Vector3d* way : {&s.axis, &s.u, &s.v}) *way = p.turn * *way;
    }
  body::build_index(body);
}

}  // namespace

std::vector<body::Body> bodies_at(const std::vector<body::Body>& bodies, const model::Model& model, double time) {
  std::vector<body::Body> moved = bodies;
  for (const model::Motion& m : model.motions) {
    if (m.body < 0 || static_cast<std::size_t>(m.body) >= moved.size()) continue;
    const model::Placement p = model::placement_at(m, time);
    if (!p.is_identity()) move(moved[static_cast<std::size_t>(m.body)], p);
  }
  return moved;
}

}  // namespace garment::simulator
