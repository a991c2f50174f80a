#pragma once
// Small models with one kind of elastic term each, and states that strain them: for the tests of forces.
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "tests/support/grid_model.hpp"

namespace garment::test {

struct ElasticCase {
  std::string name;
  model::Model model;
  std::vector<std::vector<model::Vector3d>>
      states;                          ///< lightly crumpled, heavily crumpled, compressed, folded
  std::vector<model::Vector3d> exact;  ///< a state at which the solver's matrix is the exact Hessian
  bool only_normal = false;            ///< ... in the components normal to the sheet (z)
};

/// The start positions, each coordinate moved by up to `amplitude` m; the same on every machine.
inline std::vector<model::Vector3d> crumpled(const model::Model& m, double amplitude, unsigned seed) {
  std::mt19937 random(seed);
  auto noise = [&] { return amplitude * (static_cast<double>(random()) / 2147483647.5 - 1); };
  std::vector<model::Vector3d> x;
  for (const auto& p : m.start) {
    const double dx = noise(), dy = noise(), dz = noise();
    x.push_back(p + model::Vector3d(dx, dy, dz));
  }
  return x;
}

/// A stiffening law with knots at uneven strains.
inline model::TensileLaw curved_law() {
  return {{-0.3, -0.05, 0, 0.02, 0.05, 0.2}, {-30, -5, 0, 6, 30, 400}, {100, 100, 150, 500, 1100, 3000}};
}

/// A square cut into uneven triangles around a point off the centre; law K = 900 both ways, G = 50.
inline ElasticCase membrane_case() {
  ElasticCase c;
  c.name = "cut cells";
  auto& m = c.model;
  const std::vector<model::Vector2d> uv{{0, 0}, {0.011, 0}, {0.012, 0.009}, {-0.001, 0.01}, {0.004, 0.006}};
  for (const auto& p : uv) {
    m.mass.push_back(1e-5);
    m.start.emplace_back(p[0], p[1], 0);
    m.vertex_particle.push_back(static_cast<model::Index>(m.vertex_particle.size()));
    m.vertex_uv.push_back(p);
  }
  m.laws = {linear_law(900), linear_law(900)};
  m.fit_begin = {0};
  for (model::Index k = 0; k < 4; ++k) {
    const model::Indices<3> t{k, (k + 1) % 4, 4};
    const model::Vector2d a = uv[t[0]], e1 = uv[t[1]] - a, e2 = uv[t[2]] - a;
    const double twice = e1[0] * e2[1] - e1[1] * e2[0];
    // dx/du = (e2.v (x1 - x0) - e1.v (x2 - x0)) / twice, dx/dv = (e1.u (x2 - x0) - e2.u (x1 - x0)) / twice
    const double u1 = e2[1] / twice, u2 = -e1[1] / twice, v1 = -e2[0] / twice, v2 = e1[0] / twice;
    m.membrane.push_back(t);
    m.membrane_weights.push_back({-v1 - v2, v1, v2, -u1 - u2, u1, u2});  // U along warp (v), V along weft (u)
    m.membrane_area.push_back(0.5 * twice);
    m.membrane_law.push_back({0, 1});
    m.membrane_shear.push_back(50);
    m.membrane_panel.push_back(0);
  }
  for (auto& p : m.start) c.exact.push_back(p);
  return c;
}

/// Two least-squares curvature stencils on the particles of a 4 x 4 sheet, with a full rigidity matrix.
inline void add_fits(model::Model& m) {
  std::mt19937 random(3);
  auto noise = [&] { return static_cast<double>(random()) / 2147483647.5 - 1; };
  m.fit_begin = {0};
  for (model::Index first : {0, 5}) {
    model::Vector3d sum = model::Vector3d::Zero();
    for (model::Index k = 0; k < 9; ++k) {
      const model::Index p = (first + k * 7) % 16;  // 7 and 16 coprime: nine different particles, unsorted
      model::Vector3d w = 1e4 * model::Vector3d(noise(), noise(), noise());
      if (k == 8) w = -sum;
      sum += w;
      m.fit_particle.push_back(p);
      m.fit_weight.push_back(w);
    }
    m.fit_begin.push_back(static_cast<model::Index>(m.fit_particle.size()));
    m.fit_area.push_back(1e-4);
    m.fit_rigidity.push_back({1e-5, 2e-5, 1.5e-5, 2e-6, -1e-6, 3e-6});
  }
}

/// Ties between places of a 4 x 4 sheet: particle to particle, within triangles, two places with a common particle, one that
/// is slack, one longer than its reach.
inline void add_ties(model::Model& m) {
  auto tie = [&](const model::Indices<6>& particles, const std::array<double, 6>& weights, double length) {
    m.tie.push_back(particles);
    m.tie_weights.push_back(weights);
    m.tie_length.push_back(length);
    m.tie_stiffness.push_back(300 + 50 * static_cast<double>(m.tie.size()));
    m.tie_closure.push_back(0);
  };
  const std::array<double, 6> ends{1, 0, 0, 1, 0, 0};
  tie({1, 1, 1, 2, 2, 2}, ends, 0.007);
  tie({0, 1, 5, 10, 11, 15}, {0.2, 0.3, 0.5, 0.1, 0.6, 0.3}, 0.019);
  tie({4, 5, 9, 5, 9, 10}, {0.25, 0.25, 0.5, 0.3, 0.3, 0.4}, 0.001);
  tie({8, 8, 8, 12, 12, 12}, ends, 0.2);
  tie({3, 3, 3, 12, 12, 12}, ends, 0.004);
  m.closures = {{"button", {}, 0}};
}

/// Every term alone, and all together at the end.
inline std::vector<ElasticCase> elastic_cases() {
  SheetSpec spec;
  spec.nx = spec.ny = 4;
  const model::Model all = [&] {
    model::Model m = make_sheet(spec);
    m.laws = {curved_law(), linear_law(800)};
    add_fits(m);
    return m;
  }();
  auto without = [&](bool springs, bool trellis, bool twist, bool bends, bool fits) {
    model::Model m = all;
    if (!springs) m.spring.clear();
    if (!trellis) m.cell_shear.assign(m.cell.size(), 0.0);
    if (!twist) m.cell_twist.assign(m.cell.size(), 0.0);
    if (!trellis && !twist) m.cell.clear();
    if (!bends) m.bend.clear();
    if (!fits) m.fit_begin = {0};
    return m;
  };
  std::vector<ElasticCase> cases(8);
  cases[0] = {"springs", without(true, false, false, false, false), {}, {}, false};
  cases[1] = {"trellis", without(false, true, false, false, false), {}, {}, false};
  cases[2] = {"twist", without(false, false, true, false, false), {}, {}, false};
  cases[3] = {"bends", without(false, false, false, true, false), {}, {}, true};
  cases[4] = {"fits", without(false, false, false, false, true), {}, {}, false};
  cases[5] = membrane_case();
  cases[6] = {"ties", without(false, false, false, false, false), {}, {}, false};
  add_ties(cases[6].model);
  cases[7] = {"all", all, {}, {}, true};
  add_ties(cases[7].model);
  for (ElasticCase& c : cases) {
    auto compressed = crumpled(c.model, 0.0015, 3), folded = crumpled(c.model, 0.001, 4);
    for (auto& p : compressed) p = model::Vector3d(0.5 * p.x(), 0.4 * p.y(), p.z());
    for (auto& p : folded)  // at x = 0.015 by 150 degrees
      if (p.x() > 0.015)
        p = model::Vector3d(0.015, 0, 0) + model::Vector3d(-0.87 * (p.x() - 0.015) - 0.5 * p.z(), p.y(),
                                                           0.5 * (p.x() - 0.015) - 0.87 * p.z());
    c.states = {crumpled(c.model, 0.0005, 1), crumpled(c.model, 0.006, 2), compressed, folded};
    c.exact = c.model.start;
  }
  for (auto& p : cases[0].exact)
    p = 1.03 * p;  // springs: with tension, so that the transversal part is there too
  cases[2].exact = cases[4].exact = cases[2].states[1];
  return cases;
}

}  // namespace garment::test
