// The example scripts, as they stand in examples/.
#include <cmath>

#include "interpreter/language/edges.hpp"
#include "interpreter/language/program.hpp"
#include "tests/unit/interpreter/support.hpp"

using namespace garment;
using namespace garment::interpreter;
using namespace garment::interpreter::test;

namespace {

std::string example(const std::string& name) {
  const auto text = system_host().read_file(std::string(GARMENT_SOURCE_DIR) + "/examples/" + name, 1 << 20);
  REQUIRE(text);
  return *text.value;
}

}  // namespace

TEST_CASE("the skirt is what its script says") {
  const Trial trial(example("skirt.garment"));
  INFO(trial.text());
  REQUIRE(trial.result.diagnostics.empty());
  const design::Garment& g = trial.result.garment;
  CHECK(g.title == "darted skirt");
  REQUIRE(g.panels.size() == 2);
  REQUIRE(g.seams.size() == 2);
  REQUIRE(g.attachments.size() == 1);
  REQUIRE(g.bodies.size() == 1);
  REQUIRE(g.fabrics.size() == 1);
  CHECK(g.fabrics[0].name == "shell");
  CHECK(g.fabrics[0].areal_density == Approx(0.2635));

  const design::Panel& front = g.panels[0];
  CHECK(front.name == "front");
  REQUIRE(front.edges.size() == 6);
  CHECK(front.edges[0].name == "left.hem");
  CHECK(front.edges[3].name == "right.waist");
  for (std::size_t k = 0; k < 6; ++k)
    CHECK((front.edges[k].curve.end() - front.edges[(k + 1) % 6].curve.start()).norm() < 1e-12);
  REQUIRE(front.fold_x.has_value());
  CHECK(*front.fold_x == 0);
  CHECK(front.darts.size() == 2);
  CHECK(front.notches.size() == 2);
  CHECK(front.darts[0].depth == Approx(0.09));
  CHECK(g.panels[1].darts[0].depth == Approx(0.12));
  CHECK(front.placement.kind == design::Placement::Kind::on_part);
  CHECK(front.placement.part == "front");
  CHECK(front.placement.level == "waist");

  // The wearer's left is at +x on the front and at -x on the back.
  const design::Panel& back = g.panels[1];
  for (const design::Edge& edge : front.edges)
    if (edge.name == "left.side") CHECK(edge.curve.start().x() > 0);
  for (const design::Edge& edge : back.edges)
    if (edge.name == "left.side") CHECK(edge.curve.start().x() < 0);

  // Both sides of the side seams run the same way: hem to waist, or waist to hem.
  for (const design::Seam& seam : g.seams) {
    double from[2], to[2];
    for (std::size_t k = 0; k < 2; ++k) {
      REQUIRE(seam.sides[k].parts.size() == 1);
      const design::EdgePart& part = seam.sides[k].parts[0];
      const auto& curve =
          g.panels[static_cast<std::size_t>(part.panel)].edges[static_cast<std::size_t>(part.edge)].curve;
      from[k] = curve.point_at(part.from).y();
      to[k] = curve.point_at(part.to).y();
      const bool left = seam.name == "side.left", is_front = part.panel == 0;
      CHECK((curve.start().x() > 0) == (left == is_front));
    }
    CHECK(std::fabs(from[0] - from[1]) < 1e-9);
    CHECK(std::fabs(to[0] - to[1]) < 1e-9);
    CHECK(std::fabs(to[0] - from[0]) > 0.5);
  }
  CHECK(g.attachments[0].parts.size() == 4);
  CHECK(g.attachments[0].slide);

  REQUIRE(trial.result.measures.size() == 2);
  CHECK(*trial.result.measures[0].value == Approx(0.76).margin(0.01));  // size 40: waist 76 cm
  REQUIRE(trial.result.acts.size() == 4);
  CHECK(std::holds_alternative<DrapeAct>(trial.result.acts[0].act));
  CHECK(std::get<ExpectAct>(trial.result.acts[1].act).text == "strain(all) < 8%");
  CHECK(std::get<SaveAct>(trial.result.acts[3].act).paths.size() == 4);
  REQUIRE(trial.result.parameters.size() == 3);
  CHECK(trial.result.parameters[1].name == "long");
  CHECK(trial.result.parameters[1].doc == "waist to hem");
}

TEST_CASE("parameters reach the skirt") {
  InterpretOptions options;
  options.params = {{"long", "70cm"}, {"size", "38"}};
  const Trial trial(example("skirt.garment"), options);
  INFO(trial.text());
  REQUIRE(trial.result.ok());
  CHECK(*trial.result.measures[0].value == Approx(0.72).margin(0.01));
  CHECK(trial.result.parameters[1].value == "70 cm");
  CHECK(trial.result.parameters[1].given);
  double top = 0;
  for (const design::Edge& edge : trial.result.garment.panels[0].edges)
    top = std::max(top, edge.curve.start().y());
  CHECK(top == Approx(0.71));
}

TEST_CASE("the tablecloth and the hanging square") {
  const Trial table(example("tablecloth.garment"));
  INFO(table.text());
  REQUIRE(table.result.diagnostics.empty());
  const design::Garment& g = table.result.garment;
  REQUIRE(g.panels.size() == 1);
  double area = 0;
  for (const design::Edge& edge : g.panels[0].edges) area += edge.curve.area_term();
  CHECK(area == Approx(M_PI * 0.49).epsilon(1e-12));
  CHECK(g.panels[0].edges[0].free);
  // Flat: panel y goes to -z, the face looks up.
  const Eigen::Matrix3d& R = g.panels[0].placement.rotation;
  CHECK((R * Eigen::Vector3d(0, 1, 0) - Eigen::Vector3d(0, 0, -1)).norm() == 0);
  CHECK((R * Eigen::Vector3d(0, 0, 1) - Eigen::Vector3d(0, 1, 0)).norm() == 0);
  CHECK(g.bodies[0].friction == 0.4);
  CHECK(std::get<design::Cylinder>(g.bodies[0].shape).height == Approx(0.72));

  const Trial hanging(example("hanging.garment"));
  INFO(hanging.text());
  REQUIRE(hanging.result.diagnostics.empty());
  REQUIRE(hanging.result.garment.pins.size() == 2);
  CHECK(hanging.result.garment.pins[0].point == design::Point2(0.6, 0.6));
  CHECK(hanging.result.garment.pins[1].point == design::Point2(0, 0.6));
}
