// A drape that goes on from a checkpoint ends in the bits of one that was never cut off. Checkpoints that are no such thing are
// refused.
#include "runtime/simulator/checkpoints.hpp"

#include <random>

#include "tests/support/checkpoint_cases.hpp"

namespace garment {
namespace {

using namespace test;
using simulator::MotionMethod;

/// Two squares, one above the other, that fall on a ball and on the ground: all kinds of contact, with friction of cloth on cloth.
model::Model pair_of_squares() {
  model::Model m = together(square(0.12, 10, 0.002), square(0.1, 8, 0.006));
  m.rub_panels = {{0, 1}};
  m.rub_panels_factor = {0.5};
  return m;
}

/// A strip held at both ends, one of which goes away by 4 mm and comes back.
model::Model pulled_strip() {
  SheetSpec spec;
  spec.nx = 6;
  spec.ny = 9;
  spec.h = 5e-3;
  model::Model m = make_sheet(spec);
  hold_row(m, spec, 0);
  hold_row(m, spec, spec.ny - 1);
  m.holders.push_back({"top", {}, {m.hold_particle.begin(), m.hold_particle.begin() + spec.nx}});
  m.motions.push_back({"pull", {}, -1, {0, 0, 0}, {{0, {0, 0, 0}, {0, 0, 0}}, {0.5, {0, 4e-3, 1e-3}, {0, 0, 0}}, {1, {0, 0, 0}, {0, 0, 0}}}});
  for (model::Index h = 0; h < spec.nx; ++h) {
    m.moved_hold.push_back(spec.nx + h);
    m.moved_by.push_back(0);
  }
  return m;
}

simulator::MotionSettings lasting(double seconds, double step, MotionMethod method) {
  simulator::MotionSettings s;
  s.duration = seconds;
  s.step = step;
  s.method = method;
  s.next_frame = [](double after) { return (std::floor(after / 0.013 + 1e-6) + 1) * 0.013; };
  return s;
}

/// A ball that turns and drifts under the cloth.
model::Model on_a_turning_ball(model::Model m) {
  m.motions.push_back({"turn", {}, 0, {0, 0, 0}, {{0, {0, 0, 0}, {0, 0, 0}}, {0.5, {0.02, 0, 0}, {0, 1.5, 0}}}});
  return m;
}

}  // namespace

TEST_CASE("checkpoint: a drape from coarse to fine goes on in the same bits") {
  check_resumes(to_rest({square(0.2, 8), square(0.2, 12)}, square(0.2, 18), {ball(0.05)}, 300), 7, 8);
}

TEST_CASE("checkpoint: layers with friction on two bodies go on in the same bits") {
  check_resumes(to_rest({}, pair_of_squares(), {ball(0.03), ground(-0.025)}, 120), 5, 8);
}

TEST_CASE("checkpoint: cloth that begins tangled goes on in the same bits") {
  model::Model m = together(square(0.08, 8), square(0.06, 6));
  for (std::size_t i = 81; i < m.n_particles(); ++i) m.start[i].y() += 0.3 * m.start[i].x() + 1e-4;
  check_resumes(to_rest({}, m, {ground(-0.02)}, 60), 3, 8);
}

TEST_CASE("checkpoint: motions go on in the same bits") {
  const model::Model layers = on_a_turning_ball(pair_of_squares());
  const std::vector<body::Body> bodies{ball(0.03), ground(-0.03)};
  check_resumes(for_a_time(layers, bodies, lasting(0.12, 1.0 / 240, MotionMethod::implicit)), 3, 8);
  // What was found at the last position serves the next step, where no body moves.
  for (const MotionMethod method : {MotionMethod::implicit, MotionMethod::semi_implicit})
    check_resumes(for_a_time(pair_of_squares(), bodies, lasting(0.12, method == MotionMethod::implicit ? 1.0 / 240 : 1.0 / 60, method)), 1, 6);
  model::Model stiff = on_a_turning_ball(square(0.08, 6, 1e-3));
  stiff.damping.assign(stiff.n_particles(), 1e-4);
  check_resumes(for_a_time(stiff, bodies, lasting(0.05, 0, MotionMethod::explicit_steps)), 100, 4);
  check_resumes(for_a_time(stiff, bodies, lasting(0.05, 0, MotionMethod::dynamic_constraints)), 100, 4);
  check_resumes(for_a_time(pulled_strip(), {}, lasting(0.3, 1.0 / 240, MotionMethod::implicit)), 11, 4);
}

TEST_CASE("checkpoint: paths that are followed at rest go on in the same bits") {
  check_resumes(for_a_time(pulled_strip(), {}, lasting(1, 0, MotionMethod::quasi_static)), 3, 8);
  check_resumes(for_a_time(on_a_turning_ball(square(0.08, 8)), {ball(0.03)}, lasting(0.1, 0, MotionMethod::quasi_static)), 5, 8);
}

TEST_CASE("checkpoint: what holds no state of the drape is refused, and does no harm") {
  const std::vector<Drape> drapes{
      to_rest({square(0.1, 6)}, square(0.1, 9), {ball(0.03)}, 40),
      for_a_time(on_a_turning_ball(pair_of_squares()), {ball(0.03), ground(-0.03)}, lasting(0.02, 1.0 / 240, MotionMethod::implicit)),
      for_a_time(pulled_strip(), {}, lasting(0.1, 0, MotionMethod::quasi_static)),
  };
  std::mt19937 random(5);
  for (const Drape& drape : drapes) {
    std::vector<std::string> kept = kept_by(drape, 3, drape({}));
    REQUIRE(kept.size() > 1);
    const std::string state = kept[kept.size() / 2];
    for (std::size_t n : {std::size_t{1}, std::size_t{9}, state.size() / 2, state.size() - 1})
      CHECK(resumed(drape, state.substr(0, n)).report.status == simulator::DrapeStatus::not_resumed);
    CHECK(resumed(drape, state + "x").report.status == simulator::DrapeStatus::not_resumed);
    int refused = 0;
    for (int k = 0; k < 60; ++k) {
      std::string bad = state;
      for (int n = k % 4; n >= 0; --n) bad[random() % bad.size()] = static_cast<char>(random());
      const Outcome o = resumed(drape, bad);
      refused += o.report.status == simulator::DrapeStatus::not_resumed ? 1 : 0;
      if (o.report.status != simulator::DrapeStatus::not_resumed) continue;
      REQUIRE(o.report.findings.size() == 1);
      CHECK(o.report.findings[0].code == "G0810");
    }
    CAPTURE(refused);  // most flipped bits are digits of positions, which may be anything
    std::string garbage(state.size(), '\0');
    for (char& c : garbage) c = static_cast<char>(random());
    CHECK(resumed(drape, garbage).report.status == simulator::DrapeStatus::not_resumed);
  }
}

}  // namespace garment
