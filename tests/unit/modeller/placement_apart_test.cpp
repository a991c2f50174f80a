// Cloth that crosses cloth at the start is taken apart.
#include <catch2/catch.hpp>

#include "runtime/geometry/self_crossings.hpp"
#include "runtime/modeller/dressing.hpp"
#include "runtime/modeller/modeller.hpp"
#include "tests/unit/modeller/garments.hpp"
#include "tests/unit/modeller/placement_person.hpp"

using namespace garment;
using Eigen::Vector3d;

namespace {

/// A cloth of 60 cm hung before a woman, and a smaller one farther off.
design::Garment two_cloths() {
  const double high = test::woman()[0].levels.at("hip").height;
  design::Garment g;
  g.fabrics = {test::cloth()};
  g.panels = {test::rectangle("near", 0.6, 0.6, 0.02, {-0.3, 0}), test::rectangle("far", 0.2, 0.2, 0.02, {-0.1, 0})};
  for (int k : {0, 1}) {
    g.panels[k].placement = {};
    g.panels[k].placement.kind = design::Placement::Kind::rigid;
    g.panels[k].placement.translation = {0, high, k == 0 ? 0.25 : 0.5};
  }
  return g;
}

/// Pulls what lies within 3 cm of a point of the panel through the cloth beside it.
void fold_through(model::Model& m, const Vector3d& about) {
  std::size_t moved = 0;
  for (Vector3d& x : m.start) {
    if ((x - about).norm() > 0.03) continue;
    x += Vector3d(0.09, 0.01, x.x() > about.x() ? -0.02 : 0.02);
    ++moved;
  }
  REQUIRE(moved > 3);
}

std::size_t crossings(const model::Model& m) {
  std::vector<model::Indices<3>> triangles;
  for (std::size_t t = 0; t < m.n_triangles(); ++t) triangles.push_back(m.corners(t));
  return geometry::self_crossings(triangles, m.start, 0).count;
}

}  // namespace

TEST_CASE("a fold that cuts through its own cloth is smoothed, the rest stays") {
  model::Model m = test::build_on_woman(two_cloths());
  const std::vector<bool> none(2, false);
  REQUIRE_FALSE(modeller::crosses(m, none));
  const std::vector<Vector3d> before = m.start;
  const Vector3d about(0, test::woman()[0].levels.at("hip").height + 0.3, m.start[0].z());
  fold_through(m, about);
  REQUIRE(modeller::crosses(m, none));
  CHECK(modeller::take_apart(test::woman(), none, m) == 0);
  CHECK_FALSE(modeller::crosses(m, none));
  CHECK(test::least_distance(m, test::woman()[0]) > 0);
  std::size_t far = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if ((before[i] - about).norm() < 0.28) continue;
    ++far;
    CHECK(m.start[i] == before[i]);
  }
  CHECK(far > before.size() / 4);
}

TEST_CASE("panels that are left out are neither looked at nor moved") {
  model::Model m = test::build_on_woman(two_cloths());
  fold_through(m, {0, test::woman()[0].levels.at("hip").height + 0.3, m.start[0].z()});
  const std::vector<Vector3d> before = m.start;
  const std::vector<bool> near_left_out{true, false};
  CHECK_FALSE(modeller::crosses(m, near_left_out));
  CHECK(modeller::take_apart(test::woman(), near_left_out, m) == 0);
  CHECK(m.start == before);
}

TEST_CASE("where one cloth stands through another the start does not get worse, and the body stays clear") {
  model::Model m = test::build_on_woman(two_cloths());
  const model::PanelRange& far = m.panels[1];
  const double z = m.start[m.vertex_particle[0]].z();
  for (model::Index v = far.first_vertex; v < far.first_vertex + far.n_vertices; ++v) {
    Vector3d& x = m.start[m.vertex_particle[v]];
    x = {0.003, x.y() + 0.1, z + m.vertex_uv[v].x()};
  }
  const std::vector<bool> none(2, false);
  const std::size_t before = crossings(m);
  REQUIRE(before > 0);
  const std::size_t left = modeller::take_apart(test::woman(), none, m);
  INFO(before << " pairs of triangles crossed, " << left << " do");
  CHECK(left <= before);
  CHECK(crossings(m) == left);
  CHECK(test::least_distance(m, test::woman()[0]) > 0);
}
