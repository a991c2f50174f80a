// Panels that are declared over or under others: on which side they start, and on which they come to rest.
#include <catch2/catch.hpp>

#include "runtime/modeller/layer_order.hpp"
#include "tests/unit/modeller/built.hpp"

using namespace garment;
using Eigen::Vector3d;

namespace {

/// A lining of 20 x 20 cm, `ahead` of a front of 30 x 30 cm whose face is turned to +z, or with `turned` to -z.
design::Garment lined(double ahead, bool over, bool turned = false, double aside = 0.05) {
  design::Garment g = test::single(test::rectangle("front", 0.3, 0.3, 0.02));
  g.panels.push_back(test::rectangle("lining", 0.2, 0.2, 0.02));
  g.panels[1].placement = test::flat(aside, ahead);
  if (turned) {
    g.panels[0].placement.rotation = Eigen::AngleAxisd(3.141592653589793, Vector3d::UnitY()).toRotationMatrix();
    g.panels[0].placement.translation = {0.3, 0, 0};
  }
  g.stackings = {{{}, 1, 0, over}};
  return g;
}

std::string codes_of(const Findings& findings) {
  std::string codes;
  for (const Finding& f : findings) codes += f.code + " ";
  return codes;
}

std::string started(const design::Garment& g) { return codes_of(modeller::build_model(g, {}).findings); }

/// What is said where the garment rests as it starts, with the part of the lining that lies lower than `crossed` on the other side.
std::string rested(const design::Garment& g, double crossed = 0) {
  const modeller::ModelResult built = modeller::build_model(g, {});
  REQUIRE(built.model);
  std::vector<Vector3d> x = built.model->start;
  for (std::size_t v = 0; v < built.model->n_vertices(); ++v)
    if (built.model->vertex_panel[v] == 1 && built.model->vertex_uv[v].y() < crossed) x[built.model->vertex_particle[v]].z() *= -1;
  return codes_of(modeller::rested_out_of_order(g, *built.model, x));
}

}  // namespace

TEST_CASE("what is declared under a panel starts on the side of its back") {
  CHECK(started(lined(-0.01, false)) == "");
  CHECK(started(lined(0.01, false)) == "G0609 ");
  CHECK(started(lined(0.01, true)) == "");
  CHECK(started(lined(-0.01, true)) == "G0609 ");
  CHECK(started(lined(0.01, false, true)) == "");  // the front is turned round: before it is its back
  CHECK(started(lined(-0.01, false, true)) == "G0609 ");
}

TEST_CASE("a layer at rest on the wrong side is an error that names both panels") {
  CHECK(rested(lined(-0.01, false)) == "");
  CHECK(rested(lined(0.01, false)) == "G0811 ");
  const design::Garment g = lined(0.01, false);
  const model::Model m = *modeller::build_model(g, {}).model;
  const Findings found = modeller::rested_out_of_order(g, m, m.start);
  REQUIRE(found.size() == 1);
  CHECK(found[0].severity == Severity::error);
  CHECK(found[0].message == "`lining` is declared under `front`, but came to rest over it: 100% of where the two lie together");
  CHECK(found[0].help.find("back of `front`") != std::string::npos);
}

TEST_CASE("a hem that crossed over is no layer on the wrong side") {
  CHECK(rested(lined(-0.01, false), 0.08) == "");
  CHECK(rested(lined(-0.01, false), 0.13) == "G0811 ");
}

TEST_CASE("panels that lie apart, or beside each other, are in no order") {
  CHECK(rested(lined(0.05, false)) == "");                // farther than worn layers hang
  CHECK(rested(lined(0.01, false, false, 0.305)) == "");  // beside the border
  CHECK(rested(lined(0.01, false, false, 0.29)) == "");   // a strip of 1 cm overlaps
  CHECK(rested(lined(0.01, false, false, 0.25)) == "G0811 ");
}

TEST_CASE("the order of layers is measured by area as cut") {
  const design::Garment g = lined(0.01, false);
  const model::Model m = *modeller::build_model(g, {}).model;
  const modeller::LayerOrder order = modeller::layer_order(m, m.start, g.stackings[0], 0.03);
  CHECK(order.together == Approx(0.04).epsilon(1e-9));
  CHECK(order.wrong == Approx(0.04).epsilon(1e-9));
}
