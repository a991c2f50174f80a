// Panels drawn flat in space for another pose: sleeves come to the arms, trousers to the legs, nothing
// pierces the body.
#include <catch2/catch.hpp>

#include "runtime/base/portable_math.hpp"
#include "runtime/modeller/dressing.hpp"
#include "runtime/modeller/modeller.hpp"
#include "tests/unit/modeller/garments.hpp"
#include "tests/unit/modeller/placement_person.hpp"

using namespace garment;
using Eigen::Vector3d;
using test::build_on_woman;

namespace {

std::vector<Vector3d> points_of(const model::Model& m, const std::vector<std::string>& panels) {
  std::vector<Vector3d> points;
  for (const std::string& name : panels) {
    int p = test::panel_index(m, name);
    REQUIRE(p >= 0);
    for (std::size_t v = 0; v < m.n_vertices(); ++v)
      if (m.vertex_panel[v] == p) points.push_back(m.start[m.vertex_particle[v]]);
  }
  return points;
}

void lay(design::Panel& panel, const Vector3d& translation) {
  panel.placement = {};
  panel.placement.kind = design::Placement::Kind::rigid;
  panel.placement.translation = translation;
}

/// Front and back with sleeves that stick out level, as in a T-pose, on a woman whose arms hang.
design::Garment tee() {
  const body::Body& body = test::woman()[0];
  double shoulder = body.levels.at("shoulder").height, y0 = shoulder + 0.03 - 0.6;
  design::Garment g;
  g.fabrics = {test::cloth()};
  g.panels = {test::rectangle("front", 0.56, 0.6, 0.02, {-0.28, 0}),
              test::rectangle("back", 0.56, 0.6, 0.02, {-0.28, 0}),
              test::rectangle("sleeve_f", 0.3, 0.24, 0.02), test::rectangle("sleeve_b", 0.3, 0.24, 0.02)};
  for (int k : {0, 1}) {  // sides: below the armhole, the armhole
    design::Panel& p = g.panels[k];
    auto a = p.edges[1].curve.start(), b = p.edges[1].curve.end();
    design::Point2 m(a.x(), b.y() - 0.24);
    p.edges[1] = test::edge("side", a, m);
    p.edges.insert(p.edges.begin() + 2, test::edge("armhole", m, b));
    lay(p, {0, y0, k == 0 ? 0.2 : -0.2});
    lay(g.panels[2 + k], {0.3, shoulder + 0.03 - 0.24, k == 0 ? 0.12 : -0.12});
  }
  g.seams = {test::seam("side", {test::whole(g, 0, 1)}, {test::whole(g, 1, 1)}),
             test::seam("cap_f", {test::whole(g, 0, 2)}, {test::whole(g, 2, 3, true)}),
             test::seam("cap_b", {test::whole(g, 1, 2)}, {test::whole(g, 3, 3, true)}),
             test::seam("over", {test::whole(g, 2, 2)}, {test::whole(g, 3, 2)}),
             test::seam("under", {test::whole(g, 2, 0)}, {test::whole(g, 3, 0)})};
  return g;
}

/// Trousers of four straight panels, their crotch 5 cm too high, each leg turned outwards by `spread` (rad).
design::Garment trousers(double spread, double inseam = 0.55) {
  const body::Body& body = test::woman()[0];
  double crotch = body.levels.at("crotch").height + 0.05;
  design::Garment g;
  g.fabrics = {test::cloth()};
  for (int side : {1, -1})
    for (int z : {1, -1}) {
      double w = 0.32;
      design::Panel p =
          test::rectangle((std::string(side > 0 ? "left" : "right") + (z > 0 ? "_front" : "_back")).c_str(),
                          w, 0.25 + inseam, 0.02, {side > 0 ? 0 : -w, -inseam});
      int inner = side > 0 ? 3 : 1;  // inseam below y = 0, rise above
      auto a = p.edges[inner].curve.start(), b = p.edges[inner].curve.end();
      p.edges[inner] = test::edge("first", a, {a.x(), 0});
      p.edges.insert(p.edges.begin() + inner + 1, test::edge("second", {a.x(), 0}, b));
      lay(p, {0, crotch, z > 0 ? 0.19 : -0.19});
      double c = portable::cos(side * spread), s = portable::sin(side * spread);
      p.placement.rotation << c, -s, 0, s, c, 0, 0, 0, 1;
      g.panels.push_back(p);
    }
  // panels: left front 0, left back 1, right front 2, right back 3
  // left: bottom 0, right side 1, top 2, rise 3 (downwards), inseam 4; right: bottom 0, inseam 1, rise 2, top
  // 3, side 4
  g.seams = {test::seam("inseam_l", {test::whole(g, 0, 4)}, {test::whole(g, 1, 4)}),
             test::seam("inseam_r", {test::whole(g, 2, 1)}, {test::whole(g, 3, 1)}),
             test::seam("side_l", {test::whole(g, 0, 1)}, {test::whole(g, 1, 1)}),
             test::seam("side_r", {test::whole(g, 2, 4)}, {test::whole(g, 3, 4)}),
             test::seam("rise_f", {test::whole(g, 0, 3)}, {test::whole(g, 2, 2, true)}),
             test::seam("rise_b", {test::whole(g, 1, 3)}, {test::whole(g, 3, 2, true)})};
  return g;
}

}  // namespace

TEST_CASE("a sleeve drawn for another pose comes round its own arm") {
  model::Model m = build_on_woman(tee());
  const body::Body& body = test::woman()[0];
  CHECK(test::least_distance(m, body) > 0);
  const auto& arm = body.parts.at("arm.left").sections;
  std::vector<Vector3d> sleeve = points_of(m, {"sleeve_f", "sleeve_b"});
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d& p : sleeve) middle += p / static_cast<double>(sleeve.size());
  std::size_t k = 1;
  for (std::size_t i = 1; i + 1 < arm.size(); ++i)
    if ((arm[i].center - middle).norm() < (arm[k].center - middle).norm()) k = i;
  CHECK((arm[k].center - middle).norm() < 0.05);
  CHECK(test::surrounds(sleeve, arm[k - 1].center, arm[k + 1].center, 0.03));
}

TEST_CASE("what was drawn for a shorter person is lifted onto the shoulders, what lies on them stays") {
  design::Garment right = tee(), low = tee();
  right.panels.resize(2);  // without sleeves
  low.panels.resize(2);
  for (design::Garment* g : {&right, &low}) {
    for (design::Panel& p : g->panels) {  // shoulder seams beside the neck
      auto a = p.edges[3].curve.start(), b = p.edges[3].curve.end();
      p.edges[3] = test::edge("shoulder_r", a, {0.09, a.y()});
      p.edges.insert(p.edges.begin() + 4, test::edge("neck", {0.09, a.y()}, {-0.09, a.y()}));
      p.edges.insert(p.edges.begin() + 5, test::edge("shoulder_l", {-0.09, a.y()}, b));
    }
    g->seams = {test::seam("side", {test::whole(*g, 0, 1)}, {test::whole(*g, 1, 1)}),
                test::seam("shoulder_r", {test::whole(*g, 0, 3)}, {test::whole(*g, 1, 3)}),
                test::seam("shoulder_l", {test::whole(*g, 0, 5)}, {test::whole(*g, 1, 5)})};
  }
  for (design::Panel& p : low.panels) p.placement.translation.y() -= 0.15;
  auto top = [](const model::Model& m) {
    double y = -1e300;
    for (const Vector3d& p : m.start) y = std::max(y, p.y());
    return y;
  };
  const double drawn = top(build_on_woman(right)), lifted = top(build_on_woman(low));
  CHECK(lifted > drawn - 0.06);
  CHECK(lifted < drawn + 0.03);
}

TEST_CASE("trousers drawn too high or astride come round their own legs") {
  for (double spread : {0.0, 0.35}) {
    model::Model m = build_on_woman(trousers(spread));
    const body::Body& body = test::woman()[0];
    CHECK(test::least_distance(m, body) > 0);
    for (std::string side : {"left", "right"}) {
      std::vector<Vector3d> cloth = points_of(m, {side + "_front", side + "_back"});
      for (std::string leg : {"left", "right"}) {
        const auto& sections = body.parts.at("leg." + leg).sections;
        std::size_t k = 0;  // 25 cm below the crotch
        while (k + 1 < sections.size() && sections[k].center.y() > sections[0].center.y() - 0.25) ++k;
        CHECK(test::surrounds(cloth, sections[k - 1].center, sections[k].center, 0.02) == (side == leg));
      }
    }
  }
}

TEST_CASE("trousers that reach the floor begin above the feet") {
  const body::Body& body = test::woman()[0];
  model::Model m = build_on_woman(trousers(0, 0.95));
  CHECK(test::least_distance(m, body) > 0);
  double low = 1e300, high = -1e300;
  for (const Vector3d& p : m.start) low = std::min(low, p.y()), high = std::max(high, p.y());
  CHECK(low > body.levels.at("ankle").height + 0.02);
  CHECK(low < body.levels.at("ankle").height + 0.08);
  CHECK(high > body.levels.at("crotch").height + 0.1);  // above the knees they stay as they were drawn
}

TEST_CASE("panels that stand in the body move out of it, each to its own side") {
  const body::Body& body = test::woman()[0];
  double waist = body.levels.at("waist").height;
  design::Garment g;
  g.fabrics = {test::cloth()};
  g.panels = {test::rectangle("front", 0.5, 0.3, 0.02, {-0.25, 0}),
              test::rectangle("back", 0.5, 0.3, 0.02, {-0.25, 0})};
  lay(g.panels[0], {0, waist - 0.25, 0.08});
  lay(g.panels[1], {0, waist - 0.25, -0.06});
  model::Model m = build_on_woman(g);
  CHECK(test::least_distance(m, body) > 0);
  for (const Vector3d& p : points_of(m, {"front"})) CHECK(p.z() > 0.08);
  for (const Vector3d& p : points_of(m, {"back"})) CHECK(p.z() < -0.06);
}

TEST_CASE("what is clear of the body stays where it was put") {
  design::Garment g;
  g.fabrics = {test::cloth()};
  g.panels = {test::rectangle("front", 0.3, 0.3, 0.02), test::rectangle("sleeve", 0.2, 0.3, 0.02)};
  lay(g.panels[0], {-0.15, 1, 0.4});
  lay(g.panels[1], {0.3, 1, 0.4});  // sewn to nothing: no sleeve to bring anywhere
  modeller::ModelResult with = modeller::build_model(g, test::woman()),
                        without = modeller::build_model(g, {});
  REQUIRE(with.model);
  REQUIRE(without.model);
  for (std::size_t i = 0; i < with.model->n_particles(); ++i)
    CHECK(with.model->start[i] == without.model->start[i]);
}

TEST_CASE("fronts drawn edge to edge move apart, sewn ones stay together") {
  design::Garment g;
  g.fabrics = {test::cloth()};
  g.panels = {test::rectangle("left", 0.2, 0.3, 0.02), test::rectangle("right", 0.2, 0.3, 0.02, {-0.2, 0})};
  for (design::Panel& p : g.panels) lay(p, {0, 1, 0.5});
  auto inner = [&](const model::Model& m) {
    double right = -1, left = 1;
    for (const Vector3d& p : points_of(m, {"right"})) right = std::max(right, p.x());
    for (const Vector3d& p : points_of(m, {"left"})) left = std::min(left, p.x());
    return left - right;
  };
  CHECK(inner(build_on_woman(g)) == Approx(0.02));
  g.seams = {test::seam("middle", {test::whole(g, 0, 3)}, {test::whole(g, 1, 1, true)})};
  CHECK(inner(build_on_woman(g)) == Approx(0).margin(1e-12));
}

TEST_CASE("a start in the body is cleared the same way on any number of threads, and counted") {
  model::Model m = build_on_woman(tee());
  const body::Body& body = test::woman()[0];
  for (Vector3d& p : m.start) p.z() *= 0.6;
  model::Model again = m;
  CHECK(modeller::clear_start(body, m) == modeller::clear_start(body, again));
  for (std::size_t i = 0; i < m.n_particles(); ++i) CHECK(m.start[i] == again.start[i]);
  CHECK(modeller::clear_start(body, m) == 0);
}
