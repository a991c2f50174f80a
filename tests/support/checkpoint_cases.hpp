#pragma once
// What tests of checkpoints share: a drape that is run through, one that keeps its state, and one that goes on from it.
#include <catch2/catch.hpp>
#include <functional>
#include <string>
#include <vector>

#include "runtime/base/host.hpp"
#include "runtime/body/body.hpp"
#include "runtime/model/dump.hpp"
#include "runtime/simulator/drape_levels.hpp"
#include "runtime/simulator/motion.hpp"
#include "tests/support/grid_model.hpp"
#include "tests/support/two_sheets.hpp"

namespace garment::test {

/// What a drape came to, to the bit.
struct Outcome {
  std::uint64_t hash = 0, velocity = 0;
  simulator::DrapeReport report;
  friend bool operator==(const Outcome& a, const Outcome& b) {
    const auto &m = a.report.motion, &n = b.report.motion;
    return a.hash == b.hash && a.velocity == b.velocity && a.report.status == b.report.status && a.report.steps == b.report.steps &&
           a.report.energy == b.report.energy && a.report.residual == b.report.residual && a.report.reactions == b.report.reactions &&
           a.report.findings.size() == b.report.findings.size() && m.seconds == n.seconds && m.iterations == n.iterations &&
           m.balance.work == n.balance.work && m.balance.numerical == n.balance.numerical && m.balance.friction == n.balance.friction;
  }
};

/// One drape, whatever its kind: with these checkpoints, interrupted where the function says so.
using Drape = std::function<Outcome(const simulator::Checkpoints&)>;

inline Outcome outcome_of(const model::State& state, simulator::DrapeReport report) {
  model::State v;
  v.position = state.velocity;
  return {model::state_hash(state), model::state_hash(v), std::move(report)};
}

inline Drape to_rest(std::vector<model::Model> coarse, model::Model fine, std::vector<body::Body> bodies, int max_steps) {
  return [=](const simulator::Checkpoints& checkpoints) {
    simulator::DrapeSettings s;
    s.max_steps = max_steps;
    s.checkpoints = checkpoints;
    model::State state;
    state.position = fine.start;
    simulator::DrapeReport r = simulator::drape_levels(coarse, fine, bodies, state, s);
    return outcome_of(state, std::move(r));
  };
}

inline Drape for_a_time(model::Model m, std::vector<body::Body> bodies, simulator::MotionSettings s) {
  return [=](const simulator::Checkpoints& checkpoints) {
    simulator::MotionSettings own = s;
    own.checkpoints = checkpoints;
    model::State state;
    state.position = m.start;
    simulator::DrapeReport r = simulator::move_on(m, bodies, state, own);
    return outcome_of(state, std::move(r));
  };
}

/// All that a drape keeps, every `every` steps; it must end as one that keeps nothing.
inline std::vector<std::string> kept_by(const Drape& drape, int every, const Outcome& plain) {
  std::vector<std::string> kept;
  int asked = 0;
  simulator::Checkpoints c;
  c.due = [&] { return ++asked % every == 0; };
  c.keep = [&](const std::string& state) { kept.push_back(state); };
  CHECK(drape(c) == plain);
  return kept;
}

inline Outcome resumed(const Drape& drape, const std::string& state) {
  simulator::Checkpoints c;
  c.resume = state;
  return drape(c);
}

/// From checkpoints all along its way the drape ends in the same bits; and what it keeps after it was resumed is what it kept before.
inline void check_resumes(const Drape& drape, int every, std::size_t least) {
  const Outcome plain = drape({});
  const std::vector<std::string> kept = kept_by(drape, every, plain);
  CAPTURE(kept.size(), plain.report.steps);
  REQUIRE(kept.size() >= least);
  const std::size_t stride = std::max<std::size_t>(1, (kept.size() - 1) / 4);
  for (std::size_t k = 0; k < kept.size(); k += stride) {
    CAPTURE(k);
    CHECK(resumed(drape, kept[k]) == plain);
  }
  std::vector<std::string> again;
  int asked = 0;
  simulator::Checkpoints c;
  c.resume = kept.front();
  c.due = [&] { return ++asked > 1 && (asked - 1) % every == 0; };  // it is asked at once, where it goes on
  c.keep = [&](const std::string& state) { again.push_back(state); };
  CHECK(drape(c) == plain);
  REQUIRE(again.size() == kept.size() - 1);
  for (std::size_t k = 0; k < again.size(); ++k) CHECK(again[k] == kept[k + 1]);
}

inline body::Body built(design::Body declared) {
  body::BodyResult result = body::build_body(declared, system_host(), "");
  REQUIRE(result.body);
  return std::move(*result.body);
}

/// A ball whose top lies `below` the origin.
inline body::Body ball(double radius, double below = 2e-3) {
  design::Body declared;
  declared.name = "ball";
  declared.shape = design::Sphere{radius};
  declared.position = {0, -radius - below, 0};
  declared.friction = 0.4;
  return built(declared);
}

inline body::Body ground(double height) {
  design::Body declared;
  declared.name = "ground";
  declared.shape = design::Floor{};
  declared.position = {0, height, 0};
  declared.friction = 0.4;
  return built(declared);
}

/// A flat square of side `size` about the origin, at the height `y`.
inline model::Model square(double size, int cells, double y = 0) {
  SheetSpec spec;
  spec.nx = spec.ny = cells + 1;
  spec.h = size / cells;
  spec.plane = SheetPlane::horizontal;
  model::Model m = make_sheet(spec);
  for (model::Vector3d& p : m.start) p += model::Vector3d(-size / 2, y, size / 2);
  return m;
}

}  // namespace garment::test
