// Shadows and folds of cloths whose figures are known.
#include "runtime/results/shadow.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace garment;
using model::Index;
using model::Vector3d;

namespace {

constexpr double kPi = 3.14159265358979323846;

/// A round cloth of radius 15 cm as a fan of rings; `height` gives y by radius and angle.
template <class Height>
void make_cloth(model::Model& model, model::State& state, const Height& height) {
  constexpr int kRings = 15, kSpokes = 180;
  auto add = [&](double r, double angle) {
    state.position.push_back({r * std::cos(angle), height(r, angle), r * std::sin(angle)});
    model.vertex_particle.push_back(static_cast<Index>(model.vertex_particle.size()));
    model.vertex_panel.push_back(0);
    model.vertex_uv.push_back({r * std::cos(angle), r * std::sin(angle)});
    model.mass.push_back(1e-4);
  };
  add(0, 0);
  for (int ring = 1; ring <= kRings; ++ring)
    for (int k = 0; k < kSpokes; ++k) add(0.01 * ring, 2 * kPi * k / kSpokes);
  auto at = [&](int ring, int k) { return static_cast<Index>(1 + (ring - 1) * kSpokes + (k + kSpokes) % kSpokes); };
  for (int k = 0; k < kSpokes; ++k) {
    model.triangle.push_back({0, at(1, k + 1), at(1, k)});
    for (int ring = 1; ring < kRings; ++ring) {
      model.triangle.push_back({at(ring, k), at(ring, k + 1), at(ring + 1, k)});
      model.triangle.push_back({at(ring, k + 1), at(ring + 1, k + 1), at(ring + 1, k)});
    }
  }
  model::PanelRange range;
  range.name = "cloth";
  range.n_vertices = static_cast<Index>(model.n_vertices());
  range.n_triangles = static_cast<Index>(model.n_triangles());
  range.area = kPi * 0.15 * 0.15;
  model.panels.push_back(range);
}

body::Body disc() {
  design::Body declared;
  declared.name = "disc";
  declared.shape = design::Cylinder{0.09, 0.3};
  return *body::build_body(declared, system_host(), "").body;
}

}  // namespace

TEST_CASE("a stiff cloth keeps all of its shadow, one that hangs straight none") {
  const std::vector<body::Body> bodies{disc()};
  model::Model flat_model;
  model::State flat;
  make_cloth(flat_model, flat, [](double, double) { return 0.301; });
  CHECK(results::shadow_area(flat_model, flat, 0) == Approx(kPi * 0.0225).epsilon(1e-3));
  CHECK(*results::drape_coefficient(flat_model, flat, bodies, 0) == Approx(1).margin(2e-3));
  CHECK(*results::count_nodes(flat_model, flat, 0) == 0);

  model::Model limp_model;
  model::State limp;
  make_cloth(limp_model, limp, [](double, double) { return 0.301; });
  for (std::size_t i = 0; i < limp.position.size(); ++i) {
    Vector3d& p = limp.position[i];
    const double r = std::hypot(p.x(), p.z());
    if (r <= 0.09) continue;
    p = Vector3d(p.x() * 0.09 / r, 0.301 - (r - 0.09), p.z() * 0.09 / r);
  }
  CHECK(*results::drape_coefficient(limp_model, limp, bodies, 0) == Approx(0).margin(2e-3));
}

TEST_CASE("folds of the rim are counted, ripples are not") {
  for (int folds : {2, 5, 9}) {
    model::Model model;
    model::State state;
    make_cloth(model, state, [folds](double r, double angle) {
      return 0.3 - (r > 0.09 ? (r - 0.09) * (0.5 + 0.4 * std::cos(folds * angle) + 0.01 * std::cos(31 * angle)) : 0);
    });
    CHECK(*results::count_nodes(model, state, 0) == folds);
  }
}

TEST_CASE("without a body below there is no drape coefficient") {
  model::Model model;
  model::State state;
  make_cloth(model, state, [](double, double) { return 1.0; });
  CHECK_FALSE(results::drape_coefficient(model, state, {}, 0));
  body::Body aside = disc();
  for (Vector3d& p : aside.mesh.vertices) p.x() += 1;
  CHECK_FALSE(results::drape_coefficient(model, state, {aside}, 0));
}
