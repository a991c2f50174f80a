// Ties in a drape: what they carry, and over which distance they close.
#include <catch2/catch.hpp>
#include <cmath>

#include "runtime/simulator/drape.hpp"
#include "tests/support/grid_model.hpp"

namespace {

using namespace garment;
using Eigen::Vector3d;

/// A sheet held by its whole upper row, and `gap` below it another that nothing but a tie in the middle holds.
model::Model two_sheets(double gap, double length, double stiffness) {
  test::SheetSpec spec;
  spec.nx = 5;
  spec.ny = 8;
  model::Model m = test::make_sheet(spec), lower = test::make_sheet(spec);
  const auto n = static_cast<model::Index>(m.n_particles());
  auto join = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  auto shifted = [&](auto rows) {
    for (auto& row : rows)
      for (auto& i : row) i += n;
    return rows;
  };
  for (auto& p : lower.start) p.y() -= 0.07 + gap;
  join(m.start, lower.start);
  for (auto list : {&model::Model::mass, &model::Model::thickness, &model::Model::friction, &model::Model::spring_rest,
                    &model::Model::spring_width, &model::Model::cell_shear, &model::Model::cell_twist,
                    &model::Model::bend_width, &model::Model::bend_rigidity})
    join(m.*list, lower.*list);
  join(m.spring, shifted(lower.spring));
  join(m.cell, shifted(lower.cell));
  join(m.bend, shifted(lower.bend));
  join(m.triangle, shifted(lower.triangle));
  join(m.spring_law, lower.spring_law);
  join(m.spring_panel, std::vector<model::Index>(lower.spring.size(), 1));
  join(m.cell_size, lower.cell_size);
  join(m.bend_lengths, lower.bend_lengths);
  join(m.vertex_uv, lower.vertex_uv);
  for (model::Index i = 0; i < n; ++i) m.vertex_particle.push_back(n + i), m.vertex_panel.push_back(1);
  join(m.triangle_panel, std::vector<model::Index>(lower.triangle.size(), 1));
  model::PanelRange panel = lower.panels[0];
  panel.first_vertex = n;
  panel.first_triangle = panel.n_triangles;
  m.panels.push_back(panel);
  test::hold_row(m, spec, 7);
  const model::Index above = test::sheet_particle(spec, 2, 0), below = n + test::sheet_particle(spec, 2, 7);
  m.tie = {{above, above, above, below, below, below}};
  m.tie_weights = {{1, 0, 0, 1, 0, 0}};
  m.tie_length = {length};
  m.tie_stiffness = {stiffness};
  m.tie_closure = {0};
  m.closures = {{"button", {}, 0}};
  return m;
}

double lower_weight(const model::Model& m) { return 9.80665 * m.panels[1].mass; }

model::State draped(const model::Model& m) {
  model::State state;
  simulator::DrapeSettings settings;
  settings.settle = simulator::Settle::exact;
  const simulator::DrapeReport report = simulator::drape(m, {}, state, settings);
  CHECK(report.status == simulator::DrapeStatus::at_rest);
  return state;
}

}  // namespace

TEST_CASE("a weight hangs on a tie: it is longer by the weight over its stiffness") {
  for (const double stiffness : {20.0, 2000.0}) {
    const model::Model m = two_sheets(0.004, 0.004, stiffness);
    const model::State state = draped(m);
    CHECK(m.tie_span(0, state.position).norm() == Approx(0.004 + lower_weight(m) / stiffness).epsilon(1e-4));
  }
}

TEST_CASE("a tie that starts far apart closes") {
  const model::Model m = two_sheets(0.12, 0.004, 2000);
  const model::State state = draped(m);
  CHECK(m.tie_span(0, state.position).norm() == Approx(0.004 + lower_weight(m) / 2000).epsilon(1e-4));
}
