// Cloth of figures that no cloth has, in winds that no one goes out in: every drape and every motion ends at rest or in a coded
// error that names a culprit, within its steps, and no position is ever anything but a number.
#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "runtime/base/host.hpp"
#include "runtime/modeller/modeller.hpp"
#include "runtime/simulator/drape.hpp"
#include "runtime/simulator/motion.hpp"
#include "tests/support/grid_model.hpp"
#include "tests/support/two_sheets.hpp"
#include "tests/unit/modeller/garments.hpp"

namespace {

using namespace garment;
using model::Vector3d;
using simulator::DrapeReport;
using simulator::DrapeStatus;

/// What is done to the cloth.
struct Stress {
  double stiffness = 1, density = 1, gravity = 1;  // factors
  double thickness = 0.5e-3;                       // m
  double wind = 0;                                 // m/s
  double step = 1;                                 // factor on 1/240 s, of motions
  simulator::MotionMethod method = simulator::MotionMethod::implicit;
};

enum class Scene { hanging, on_a_ball, layers };
constexpr Scene kScenes[] = {Scene::hanging, Scene::on_a_ball, Scene::layers};

constexpr int kMostSteps = 400;

body::Body body_of(design::Body declared) {
  body::BodyResult built = body::build_body(declared, system_host(), "");
  REQUIRE(built.body);
  return std::move(*built.body);
}

const std::vector<body::Body>& bodies_of(Scene scene) {
  static const std::vector<body::Body> none, ball{body_of({"ball", {}, design::Sphere{0.05}, {0.06, -0.053, -0.06}, 0.3})},
      ground{body_of({"ground", {}, design::Floor{}, {0, -0.01, 0}, 0.3})};
  return scene == Scene::hanging ? none : scene == Scene::on_a_ball ? ball : ground;
}

model::Model cloth(Scene scene, const Stress& s) {
  test::SheetSpec spec;
  spec.nx = spec.ny = 9;
  spec.h = 0.015;
  for (double* k : {&spec.stretch, &spec.shear, &spec.bend, &spec.twist}) *k *= s.stiffness;
  spec.density *= s.density;
  spec.thickness = s.thickness;
  if (scene != Scene::hanging) spec.plane = test::SheetPlane::horizontal;
  model::Model m = test::make_sheet(spec);
  if (scene == Scene::hanging) test::hold_upper_corners(m, spec);
  if (scene == Scene::layers) {
    model::Model above = test::make_sheet(spec);
    for (Vector3d& p : above.start) p += Vector3d(0.02, 0.025, 0.01);
    above.panels[0].name = "upper";
    m = test::together(m, above);
  }
  m.gravity *= s.gravity;
  if (s.wind > 0) m.air = {Vector3d(0, 0, s.wind), 0, 1.2};
  return m;
}

/// Everything that may be said of an end, whatever the cloth.
void check_end(const model::Model& m, const model::State& state, const DrapeReport& report) {
  for (const Vector3d& p : state.position) REQUIRE(p.allFinite());
  for (const Vector3d& v : state.velocity) REQUIRE(v.allFinite());
  REQUIRE(state.position.size() == m.n_particles());
  CHECK_FALSE(std::isnan(report.residual));
  CHECK_FALSE(std::isnan(report.energy));
  CHECK(report.status != DrapeStatus::not_resumed);
  if (report.status == DrapeStatus::at_rest) CHECK(report.self_intersections + report.body_intersections + report.inside_body == 0);
  if (report.status == DrapeStatus::at_rest || report.status == DrapeStatus::ran) return;
  REQUIRE(has_errors(report.findings));
  for (const Finding& f : report.findings) {
    INFO(f.code << ": " << f.message);
    CHECK(f.code.starts_with("G08"));
    CHECK_FALSE(f.help.empty());
    if (f.severity != Severity::error) continue;
    bool named = f.code == "G0806" || f.code == "G0805";  // the step, and what is open in all
    for (const model::PanelRange& panel : m.panels) named = named || f.message.find("`" + panel.name + "`") != std::string::npos;
    CHECK(named);
  }
}

std::string say(Scene scene, const Stress& s) {
  static const char* const name[] = {"hanging", "on a ball", "layers"};
  return std::string(name[static_cast<int>(scene)]) + ", stiffness x " + std::to_string(s.stiffness) + ", density x " +
         std::to_string(s.density) + ", gravity x " + std::to_string(s.gravity) + ", thickness " + std::to_string(s.thickness) +
         " m, wind " + std::to_string(s.wind) + " m/s, step x " + std::to_string(s.step);
}

void drape(Scene scene, const Stress& s) {
  INFO(say(scene, s));
  const model::Model m = cloth(scene, s);
  model::State state;
  state.position = m.start;
  simulator::DrapeSettings settings;
  settings.max_steps = kMostSteps;
  const DrapeReport report = simulator::drape(m, bodies_of(scene), state, settings);
  CHECK(report.steps <= kMostSteps);
  check_end(m, state, report);
}

void move(Scene scene, const Stress& s) {
  INFO(say(scene, s));
  const model::Model m = cloth(scene, s);
  model::State state;
  state.position = m.start;
  simulator::MotionSettings settings;
  settings.duration = 0.05;
  settings.method = s.method;
  if (s.method == simulator::MotionMethod::implicit) settings.step = s.step / 240;
  settings.max_steps = kMostSteps;
  const DrapeReport report = simulator::move_on(m, bodies_of(scene), state, settings);
  CHECK(report.steps <= kMostSteps + 1);
  check_end(m, state, report);
}

constexpr double kStiffness[] = {1e-3, 1e-2, 0.1, 1, 10, 100, 1e3};
constexpr double kThickness[] = {5e-5, 5e-4, 1e-2};

}  // namespace

TEST_CASE("stress: one figure at a time", "[quick]") {
  for (const Scene scene : kScenes) {
    for (const double k : {1e-3, 1e3}) drape(scene, {.stiffness = k}), move(scene, {.stiffness = k});
    for (const double k : {1e-2, 1e2}) drape(scene, {.density = k}), move(scene, {.density = k});
    for (const double t : kThickness) drape(scene, {.thickness = t});
    drape(scene, {.gravity = 10});
    drape(scene, {.wind = 100});
    for (const double k : {0.1, 10.0}) move(scene, {.step = k});
    move(scene, {.wind = 100});
  }
}

TEST_CASE("stress: gravity beyond all numbers", "[quick]") {
  for (const Scene scene : kScenes)
    for (const double g : {1e9, 1e150, 1e306}) drape(scene, {.gravity = g}), move(scene, {.gravity = g});
}

TEST_CASE("stress: slivers", "[quick]") {
  using design::Point2;
  const auto triangle = [](const char* name, double length, double height, double h) {
    design::Panel p = test::rectangle(name, 0.2, 0.2, h);
    p.edges = {test::edge("a", {0, 0}, {length, 0}), test::edge("b", {length, 0}, {0, height}), test::edge("c", {0, height}, {0, 0})};
    return p;
  };
  int modelled = 0;
  for (const design::Panel& panel :
       {triangle("hair", 0.3, 0.01, 0.01), triangle("spike", 0.3, 0.03, 0.005), triangle("kite", 0.3, 0.06, 0.01),
        test::rectangle("thread", 0.003, 0.25, 0.02), test::rectangle("ribbon", 0.0201, 0.25, 0.01), test::rectangle("tape", 0.25, 0.0102, 0.005)})
    for (const double k : {1e-2, 1.0, 1e2}) {
      design::Garment g = test::single(panel);
      g.fabrics[0].shear_rigidity *= k;
      for (double& b : g.fabrics[0].bending_rigidity) b *= k;
      g.pins.push_back({"peg", {}, 0, {0.001, 0.0005}});
      const modeller::ModelResult built = modeller::build_model(g, {});
      INFO(panel.name << ", stiffness x " << k);
      if (!built.model) {
        REQUIRE(has_errors(built.findings));
        CHECK(built.findings[0].message.find("`" + panel.name + "`") != std::string::npos);
        continue;
      }
      ++modelled;
      model::State state;
      state.position = built.model->start;
      simulator::DrapeSettings settings;
      settings.max_steps = kMostSteps;
      check_end(*built.model, state, simulator::drape(*built.model, {}, state, settings));
    }
  CHECK(modelled >= 9);
}

/// Cloth that begins as no cloth can lie: drawn to a thread, to a point, its rows exchanged.
TEST_CASE("stress: starts that are no cloth", "[quick]") {
  for (const Scene scene : kScenes)
    for (int kind = 0; kind < 4; ++kind) {
      model::Model m = cloth(scene, {});
      for (std::size_t i = 0; i < m.start.size(); ++i) {
        Vector3d& p = m.start[i];
        if (kind == 0) p = Vector3d(1e-9 * p.x(), p.y(), p.z());
        if (kind == 1) p = Vector3d::Zero();
        if (kind == 2 && i % 2 == 0) p = m.start[(7 * i + 3) % m.start.size()];
        if (kind == 3) p *= 1e-12;
      }
      model::State state;
      state.position = m.start;
      simulator::DrapeSettings settings;
      settings.max_steps = 30;  // every part is near every other: the steps are slow
      INFO("scene " << static_cast<int>(scene) << ", start " << kind);
      check_end(m, state, simulator::drape(m, bodies_of(scene), state, settings));
    }
}

TEST_CASE("stress: explicit steps", "[quick]") {
  for (const auto method : {simulator::MotionMethod::explicit_steps, simulator::MotionMethod::dynamic_constraints})
    for (const Scene scene : kScenes)
      for (const double k : {1e-3, 1.0, 1e3}) move(scene, {.stiffness = k, .method = method});
}

TEST_CASE("stress: the grid at rest", "[deep]") {
  for (const Scene scene : kScenes)
    for (const double stiffness : kStiffness)
      for (const double density : {0.01, 1.0, 100.0})
        for (const double thickness : kThickness)
          for (const double gravity : {1.0, 10.0})
            for (const double wind : {0.0, 100.0})
              drape(scene, {.stiffness = stiffness, .density = density, .gravity = gravity, .thickness = thickness, .wind = wind});
}

TEST_CASE("stress: the grid in motion", "[deep]") {
  for (const Scene scene : kScenes)
    for (const double stiffness : kStiffness)
      for (const double density : {0.01, 1.0, 100.0})
        for (const double step : {0.1, 1.0, 10.0})
          for (const double gravity : {1.0, 10.0})
            for (const double wind : {0.0, 100.0})
              move(scene, {.stiffness = stiffness, .density = density, .gravity = gravity, .wind = wind, .step = step});
}
