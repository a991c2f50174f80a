#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "runtime/model/dump.hpp"
#include "runtime/model/model_arrays.hpp"
#include "runtime/model/validate.hpp"

using namespace garment;
using model::Model;

namespace {

/// One cell of cloth, as two triangles, held at a corner.
Model one_cell() {
  Model m;
  m.mass.assign(4, 0.001);
  m.start = {{0, 0, 0}, {0.01, 0, 0}, {0.01, 0.01, 0}, {0, 0.01, 0}};
  m.thickness.assign(4, 0.0005);
  m.friction.assign(4, 0.3);
  m.vertex_particle = {0, 1, 2, 3};
  m.vertex_panel.assign(4, 0);
  m.vertex_uv = {{0, 0}, {0.01, 0}, {0.01, 0.01}, {0, 0.01}};
  m.triangle = {{0, 1, 2}, {2, 3, 0}};
  m.triangle_panel = {0, 0};
  m.spring = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
  m.spring_rest.assign(4, 0.01);
  m.spring_width.assign(4, 0.005);
  m.spring_law.assign(4, 0);
  m.spring_panel.assign(4, 0);
  m.cell = {{0, 1, 2, 3}};
  m.cell_size = {{0.01, 0.01}};
  m.cell_shear = {40};
  m.cell_twist = {0};
  m.fit_begin = {0};
  m.hold_particle = {0};
  m.hold_kind = {model::HoldKind::plane};
  m.hold_point = {{0, 0, 0}};
  m.hold_normal = {{0, 1, 0}};
  m.tie = {{0, 1, 2, 2, 3, 0}};
  m.tie_weights = {{0.5, 0.25, 0.25, 1, 0, 0}};
  m.tie_length = {0.001};
  m.tie_stiffness = {1000};
  m.tie_closure = {0};
  m.closures = {{"top", {}, 0.001}};
  m.laws = {{{0, 0.1}, {0, 10}, {100, 100}}};
  m.panels = {{"square \"a\"", {}, 0, 4, 0, 2, 1e-4, 0.004, {0.5, 0.5, 0.5}}};
  m.seams = {{"s", {}, {0, 1}, 0.01}};
  return m;
}

}  // namespace

TEST_CASE("a sound model validates, and each kind of fault is found") {
  REQUIRE(model::validate(one_cell()).empty());
  auto fails = [](auto&& spoil) {
    Model m = one_cell();
    spoil(m);
    Findings f = model::validate(m);
    return !f.empty() && f[0].code == "G0490";
  };
  CHECK(fails([](Model& m) { m.mass[2] = 0; }));
  CHECK(fails([](Model& m) { m.mass[2] = NAN; }));
  CHECK(fails([](Model& m) { m.start.pop_back(); }));
  CHECK(fails([](Model& m) { m.start[1].y() = INFINITY; }));
  CHECK(fails([](Model& m) { m.triangle[1][2] = 4; }));
  CHECK(fails([](Model& m) { m.triangle[1][2] = -1; }));
  CHECK(fails([](Model& m) { m.spring_law[0] = 1; }));
  CHECK(fails([](Model& m) { m.cell_size[0].y() = 0; }));
  CHECK(fails([](Model& m) { m.fit_begin = {0, 0}; }));
  CHECK(fails([](Model& m) { m.fit_begin.clear(); }));
  CHECK(fails([](Model& m) { m.panels[0].n_triangles = 1; }));
  CHECK(fails([](Model& m) { m.laws[0].force[1] = 0; }));
  CHECK(fails([](Model& m) { m.seams[0].particles[0] = 9; }));
  CHECK(fails([](Model& m) { m.hold_normal.clear(); }));
  CHECK(fails([](Model& m) { m.tie_weights[0][1] = 0.3; }));
  CHECK(fails([](Model& m) { m.tie_weights.clear(); }));
  CHECK(fails([](Model& m) { m.tie_closure[0] = 1; }));
  CHECK(fails([](Model& m) { m.closures[0].mass = NAN; }));
}

TEST_CASE("findings about a broken model are few") {
  Model m = one_cell();
  m.mass.resize(40, -1);
  CHECK(model::validate(m).size() <= 10);
}

TEST_CASE("hashes tell bits apart") {
  model::State a;
  a.position = {{1, 2, 3}, {4, 5, 6}};
  model::State b = a;
  CHECK(model::state_hash(a) == model::state_hash(b));
  b.position[1].z() = std::nextafter(6.0, 7.0);
  CHECK(model::state_hash(a) != model::state_hash(b));
  CHECK(model::hash_text(model::state_hash({})) == "cbf29ce484222325");
  CHECK(model::model_hash(one_cell()) == model::model_hash(one_cell()));
#define SPOIL(name, rows, refers_to, sign, unit)                  \
  {                                                               \
    Model m = one_cell();                                         \
    m.name.emplace_back();                                        \
    CHECK(model::model_hash(m) != model::model_hash(one_cell())); \
  }
  GARMENT_MODEL_ARRAYS(SPOIL)
#undef SPOIL
}

TEST_CASE("the dump is JSON that holds every array to the bit") {
  Model m = one_cell();
  m.start[2].x() = 0.1 + 0.2;
  nlohmann::json j = nlohmann::json::parse(model::dump_json(m));
#define DUMPED(name, rows, refers_to, sign, unit) CHECK(j.at(#name).size() == m.name.size());
  GARMENT_MODEL_ARRAYS(DUMPED)
#undef DUMPED
  CHECK(j["start"][2][0].get<double>() == 0.1 + 0.2);
  CHECK(j["triangle"][1] == nlohmann::json({2, 3, 0}));
  CHECK(j["panels"][0]["name"] == "square \"a\"");
  CHECK(j["laws"][0]["force"][1] == 10);
}

TEST_CASE("the summary names panels, seams and closures") {
  std::string text = model::summary_text(one_cell());
  CHECK(text.find("particles 4, vertices 4, triangles 2\n") != std::string::npos);
  CHECK(text.find("mass 5 g, area 1 cm^2\n") != std::string::npos);  // with the button
  CHECK(text.find("seam s: 2 particles, 10 mm\n") != std::string::npos);
  CHECK(text.find("closure top: 1 tie\n") != std::string::npos);
  CHECK(text.find("hash ") != std::string::npos);
}
