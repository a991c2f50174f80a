// Panels wrapped on a person: lengths kept, nothing in the body, left as right, front meets back.
#include <catch2/catch.hpp>

#include "runtime/modeller/modeller.hpp"
#include "runtime/modeller/wrap_curve.hpp"
#include "tests/unit/modeller/garments.hpp"
#include "tests/unit/modeller/placement_person.hpp"

using namespace garment;
using Eigen::Vector3d;
using modeller::Vector2d;
using test::build_on_woman;

namespace {

void wrap(design::Panel& panel, const char* part, const char* edge, const char* level) {
  panel.placement = {};
  panel.placement.kind = design::Placement::Kind::on_part;
  panel.placement.body = "form";
  panel.placement.part = part;
  panel.placement.edge = edge;
  panel.placement.level = level;
}

/// Largest relative change of the length of an edge of triangles, over all edges longer than 2 mm.
double worst_length(const model::Model& m) {
  double worst = 0;
  for (const auto& t : m.triangle)
    for (int k = 0; k < 3; ++k) {
      model::Index a = t[k], b = t[(k + 1) % 3];
      double flat = (m.vertex_uv[a] - m.vertex_uv[b]).norm();
      if (flat < 2e-3) continue;
      double now = (m.start[m.vertex_particle[a]] - m.start[m.vertex_particle[b]]).norm();
      worst = std::max(worst, std::abs(now / flat - 1));
    }
  return worst;
}

/// Skirt of two rectangles, sewn at both sides, wide enough for the hips.
design::Garment tube(double width) {
  design::Garment g;
  g.fabrics = {test::cloth()};
  g.panels = {test::rectangle("front", width, 0.4, 0.02), test::rectangle("back", width, 0.4, 0.02)};
  wrap(g.panels[0], "front", "top", "waist");
  wrap(g.panels[1], "back", "top", "waist");
  g.seams = {test::seam("side_l", {test::whole(g, 0, 1)}, {test::whole(g, 1, 3, true)}),
             test::seam("side_r", {test::whole(g, 0, 3)}, {test::whole(g, 1, 1, true)})};
  return g;
}

}  // namespace

TEST_CASE("the girth line is convex, symmetric, closed and measured by its length") {
  std::vector<Vector2d> points{{0.2, 0.1}, {-0.15, 0.12}, {0.1, -0.14}, {0.05, 0.13}, {-0.18, -0.02}};
  modeller::WrapCurve curve(points, 0.01, 0.02);
  double l = curve.length();
  CHECK((curve.at(0) - curve.at(l)).norm() < 1e-12);
  CHECK(curve.at(0).x() == Approx(0.01).margin(1e-9));
  for (int i = 0; i < 200; ++i) {
    double s = l * i / 200;
    Vector2d p = curve.at(s), q = curve.at(-s);
    CHECK(std::abs(p.x() + q.x() - 0.02) < 2e-4);
    CHECK(std::abs(p.y() - q.y()) < 2e-4);
    CHECK((curve.at(s + 0.001) - p).norm() <= 0.001 + 1e-12);
    Vector2d along = curve.at(s + 0.01) - p, next = curve.at(s + 0.02) - curve.at(s + 0.01);
    CHECK(along.x() * next.y() - along.y() * next.x() <= 1e-9);  // bends one way only
    CHECK(curve.normal_at(s).dot(p - Vector2d(0.01, 0)) > 0);
    for (const Vector2d& inner : points) CHECK((inner - p).norm() > 0.0199);
  }
}

TEST_CASE("wrapped panels keep lengths, stay off the body and mirror each other") {
  model::Model m = build_on_woman(tube(0.56));
  const body::Body& body = test::woman()[0];
  CHECK(test::least_distance(m, body) > 0.002);
  CHECK(worst_length(m) < 0.01);
  double top = -1e300;
  for (const Vector3d& p : m.start) top = std::max(top, p.y());
  CHECK(top == Approx(body.levels.at("waist").height).margin(1e-6));
  for (const Vector3d& p : m.start) {  // every particle has its mirror image
    double nearest = 1;
    for (const Vector3d& q : m.start)
      nearest = std::min(nearest, (Vector3d(-p.x(), p.y(), p.z()) - q).norm());
    CHECK(nearest < 2e-3);
  }
  double front = 0, back = 0;
  for (std::size_t v = 0; v < m.n_vertices(); ++v)
    (m.vertex_panel[v] == 0 ? front : back) += m.start[m.vertex_particle[v]].z();
  CHECK(front > back);
}

TEST_CASE("a tube wider than the body closes without a gap at the sides") {
  design::Garment g = tube(0.7);
  model::Model m = build_on_woman(g);
  CHECK(worst_length(m) < 0.01);  // the cells beside the seams, too: front and back meet where they are sewn
  g.panels[0].placement.offset = 0.05;
  CHECK(test::least_distance(build_on_woman(g), test::woman()[0]) > 0.002);
}

TEST_CASE("a panel without a place is carried on from the panels it is sewn to") {
  design::Garment g = tube(0.56);
  g.panels.push_back(test::rectangle("flounce", 0.56, 0.1, 0.02));
  g.panels[2].placement = {};
  g.seams.push_back(test::seam("hem", {test::whole(g, 0, 0)}, {test::whole(g, 2, 2, true)}));
  model::Model m = build_on_woman(g);
  CHECK(worst_length(m) < 0.05);
  double low = 1e300, above = 1e300;
  for (std::size_t v = 0; v < m.n_vertices(); ++v) {
    double& y = m.vertex_panel[v] == 2 ? low : above;
    y = std::min(y, m.start[m.vertex_particle[v]].y());
  }
  CHECK(low == Approx(above - 0.1).margin(2e-3));
}

TEST_CASE("a panel rolled round a limb surrounds it and no other") {
  for (const char* part : {"arm.left", "arm.right"}) {
    design::Garment g;
    g.fabrics = {test::cloth()};
    g.panels = {test::rectangle("sleeve", 0.42, 0.3, 0.02)};
    wrap(g.panels[0], part, "", "");
    g.panels[0].placement.kind = design::Placement::Kind::around;
    g.seams = {test::seam("underarm", {test::whole(g, 0, 1)}, {test::whole(g, 0, 3, true)})};
    model::Model m = build_on_woman(g);
    CHECK(worst_length(m) < 0.02);
    const body::Body& body = test::woman()[0];
    const auto& own = body.parts.at(part).sections;
    std::size_t k = own.size() / 3;
    CHECK(test::surrounds(m.start, own[k - 1].center, own[k + 1].center, 0.03));
    const auto& other = body.parts.at(part == std::string("arm.left") ? "arm.right" : "arm.left").sections;
    CHECK_FALSE(test::surrounds(m.start, other[k - 1].center, other[k + 1].center, 0.03));
  }
}
