#pragma once
// What tests of rest states share.
#include "runtime/simulator/drape.hpp"
#include "tests/support/grid_model.hpp"

namespace garment::test {

struct Draped {
  model::State state;
  simulator::DrapeReport report;
};

inline Draped drape(const model::Model& m, const std::vector<body::Body>& bodies = {},
                    simulator::Settle settle = simulator::Settle::exact, int max_steps = 4000) {
  Draped d;
  d.state.position = m.start;
  simulator::DrapeSettings settings;
  settings.settle = settle;
  settings.max_steps = max_steps;
  d.report = simulator::drape(m, bodies, d.state, settings);
  return d;
}

}  // namespace garment::test
