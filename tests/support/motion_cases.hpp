#pragma once
// What tests of motion share.
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "runtime/base/host.hpp"
#include "runtime/body/body.hpp"
#include "runtime/model/validate.hpp"
#include "runtime/simulator/motion.hpp"
#include "tests/support/grid_model.hpp"

namespace garment::test {

using Vectors = std::vector<Eigen::Vector3d>;

struct Moved {
  model::State state;
  simulator::DrapeReport report;
};

inline Moved move(const model::Model& m, const simulator::MotionSettings& settings, const std::vector<body::Body>& bodies = {},
                  const Vectors& velocity = {}) {
  REQUIRE(model::validate(m).empty());
  Moved out;
  out.state.position = m.start;
  out.state.velocity = velocity;
  out.report = simulator::move_on(m, bodies, out.state, settings);
  return out;
}

inline simulator::MotionSettings lasting(double seconds, double step,
                                         simulator::MotionMethod method = simulator::MotionMethod::implicit) {
  simulator::MotionSettings s;
  s.duration = seconds;
  s.step = step;
  s.method = method;
  s.tolerance = 1e-6;
  return s;
}

/// Calls `look` after every `every` seconds.
inline void watch(simulator::MotionSettings& s, double every,
                  std::function<void(const model::State&, const simulator::DrapeReport&)> look) {
  s.next_frame = [every](double after) { return (std::floor(after / every + 1e-6) + 1) * every; };
  s.frame = std::move(look);
}

inline body::Body floor_of(double friction) {
  design::Body declared;
  declared.name = "floor";
  declared.shape = design::Floor{};
  declared.friction = friction;
  body::BodyResult built = body::build_body(declared, system_host(), "");
  REQUIRE(built.body);
  return std::move(*built.body);
}

inline Eigen::Vector3d mean(const Vectors& x) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : x) sum += p / static_cast<double>(x.size());
  return sum;
}

/// Two particles, the first held, the second `length` below it.
inline model::Model bead(double mass, double length) {
  model::Model m;
  m.mass = {mass, mass};
  m.start = {Eigen::Vector3d::Zero(), Eigen::Vector3d(0, -length, 0)};
  m.thickness = {5e-4, 5e-4};
  m.friction = {0.3, 0.3};
  m.vertex_particle = {0, 1};
  m.vertex_panel = {0, 0};
  m.vertex_uv = {{0, 0}, {0, -length}};
  m.fit_begin = {0};
  m.laws = {linear_law(100)};
  model::PanelRange panel;
  panel.name = "bead";
  panel.n_vertices = 2;
  m.panels.push_back(panel);
  hold_point(m, 0);
  return m;
}

/// A rod of that length from the first to the second.
inline void add_link(model::Model& m, double length) {
  m.closures.push_back({"link", {}, 0});
  m.rod_tie.push_back(static_cast<model::Index>(m.tie.size()));
  m.tie.push_back({0, 0, 0, 1, 1, 1});
  m.tie_weights.push_back({1, 0, 0, 1, 0, 0});
  m.tie_length.push_back(length);
  m.tie_stiffness.push_back(5e4);
  m.tie_closure.push_back(static_cast<model::Index>(m.closures.size() - 1));
}

/// Period of the bead, s: twice the time between two passages through x = 0.
inline double period(const model::Model& m, simulator::MotionSettings s, double every) {
  std::vector<double> crossings;
  double before = m.start[1].x(), t_before = 0;
  watch(s, every, [&](const model::State& now, const simulator::DrapeReport&) {
    const double x = now.position[1].x();
    if (before * x < 0) crossings.push_back(t_before + (now.time - t_before) * before / (before - x));
    before = x;
    t_before = now.time;
  });
  const Moved moved = move(m, s);
  REQUIRE(moved.report.status == simulator::DrapeStatus::ran);
  REQUIRE(crossings.size() >= 2);
  return 2 * (crossings[1] - crossings[0]);
}

}  // namespace garment::test
