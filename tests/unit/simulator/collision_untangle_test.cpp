// Tangles are found and taken apart.
#include <catch2/catch.hpp>

#include "runtime/base/parallel.hpp"
#include "runtime/simulator/truncate.hpp"
#include "runtime/simulator/untangle.hpp"
#include "tests/unit/simulator/collision_support.hpp"

using namespace garment;
using namespace garment::simulator;
using garment::test::Random;

namespace {

/// Pulls the springs of the sheet back towards their rest lengths: stands in for the solver between two
/// calls.
void smooth(const model::Model& m, const ContactMesh& mesh, const std::vector<Vector3d>& x,
            std::vector<Vector3d>& dx) {
  std::vector<Vector3d> y = x;
  for (std::size_t i = 0; i < y.size(); ++i) y[i] += dx[i];
  for (int sweep = 0; sweep < 4; ++sweep)
    for (Index e = 0; e < mesh.n_cloth_edges; ++e) {
      const auto [i, j] = mesh.edge[e];
      const double rest = (m.vertex_uv[i] - m.vertex_uv[j]).norm(), now = (y[i] - y[j]).norm();
      const Vector3d move = 0.25 * (now - rest) / std::max(now, 1e-9) * (y[j] - y[i]);
      y[i] += move;
      y[j] -= move;
    }
  for (std::size_t i = 0; i < y.size(); ++i) dx[i] = y[i] - x[i];
}

/// Steps until nothing is tangled; returns the number of steps, or -1.
int untangle(const model::Model& m, const std::vector<body::Body>& bodies, std::vector<Vector3d>& x,
             int most) {
  const ContactMesh mesh(m, bodies);
  Candidates candidates;
  for (int step = 0; step < most; ++step) {
    const Tangle tangle = find_tangle(mesh, bodies, x);
    if (tangle.empty()) return step;
    candidates.rebuild(mesh, x, 0.008);
    candidates.exempt(mesh, tangle);
    std::vector<Vector3d> dx;
    untangle_displacements(mesh, bodies, x, tangle, dx);
    smooth(m, mesh, x, dx);
    truncate(mesh, candidates, x, dx);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += dx[i];
  }
  return -1;
}

}  // namespace

TEST_CASE("hits are those of all edges with all triangles", "[collision]") {
  Random random(13);
  const model::Model m = test::join(test::sheet(8, 8, 0.01), test::sheet(8, 8, 0.01));
  const std::vector<body::Body> bodies{test::ball(0.02, {0.03, 0.01, -0.03}, 6, 8)};
  const ContactMesh mesh(m, bodies);
  std::vector<Vector3d> x = m.start;
  for (Vector3d& p : x) p += random.vector(0.008);
  const Tangle one = find_tangle(mesh, bodies, x);
  CHECK(one.hits.size() > 50);
  CHECK(one.n_inside > 0);
  CHECK(std::is_sorted(one.hits.begin(), one.hits.end()));
  // Slow and different: solve for the crossing point.
  std::vector<EdgeHit> expected;
  for (Index e = 0; e < static_cast<Index>(mesh.edge.size()); ++e)
    for (Index t = 0; t < static_cast<Index>(mesh.triangle.size()); ++t) {
      const Indices<2>& i = mesh.edge[e];
      const Indices<3>& c = mesh.triangle[t];
      if (mesh.is_body(i[0]) && mesh.is_body(c[0])) continue;
      if (c[0] == i[0] || c[1] == i[0] || c[2] == i[0] || c[0] == i[1] || c[1] == i[1] || c[2] == i[1])
        continue;
      Eigen::Matrix3d a;
      a.col(0) = mesh.at(x, c[1]) - mesh.at(x, c[0]);
      a.col(1) = mesh.at(x, c[2]) - mesh.at(x, c[0]);
      a.col(2) = mesh.at(x, i[0]) - mesh.at(x, i[1]);
      const Vector3d s = a.partialPivLu().solve(mesh.at(x, i[0]) - mesh.at(x, c[0]));
      if (s[0] >= 0 && s[1] >= 0 && s[0] + s[1] <= 1 && s[2] >= 0 && s[2] <= 1) expected.push_back({e, t});
    }
  CHECK(one.hits == expected);
  const int before = thread_count();
  set_thread_count(4);
  const Tangle four = find_tangle(mesh, bodies, x);
  set_thread_count(before);
  CHECK(four.hits == one.hits);
  CHECK(four.inside == one.inside);
}

TEST_CASE("a sheet at rest is not tangled and gets no displacement", "[collision]") {
  const model::Model m = test::sheet(6, 6, 0.01);
  const ContactMesh mesh(m, {});
  std::vector<Vector3d> dx;
  CHECK(untangle_displacements(mesh, {}, m.start, dx) == 0);
  for (const Vector3d& d : dx) CHECK(d.norm() == 0);
}

TEST_CASE("a sheet whose border has gone through another comes back", "[collision]") {
  for (double depth : {0.005, 0.0075, 0.010}) {
    const model::Model a = test::sheet(9, 9, 0.01), b = test::sheet(6, 6, 0.01);
    const model::Model m = test::join(a, b);
    std::vector<Vector3d> x = m.start;
    for (std::size_t i = a.n_particles(); i < x.size(); ++i) {  // upright, its lower border through the other
      const Vector3d p = m.start[i];
      x[i] = {0.0153 + p[0], -p[2] - depth, -0.0417 + 0.1 * p[0]};
    }
    INFO("depth " << depth);
    CHECK(untangle(m, {}, x, 400) >= 0);
  }
}

TEST_CASE("a bump through a sheet comes back", "[collision]") {
  const model::Model a = test::sheet(12, 12, 0.01);
  const model::Model m = test::join(a, a);
  std::vector<Vector3d> x = m.start;
  for (std::size_t i = a.n_particles(); i < x.size(); ++i) {
    const double u = x[i][0] - 0.052, v = x[i][2] + 0.057;
    x[i] += Vector3d(0.0013, 0.004 - 0.012 * std::exp(-(u * u + v * v) / (2 * 0.02 * 0.02)), 0.0017);
  }
  const ContactMesh mesh(m, {});
  REQUIRE_FALSE(find_tangle(mesh, {}, x).empty());
  CHECK(untangle(m, {}, x, 400) >= 0);
}

TEST_CASE("sheets that cross at an angle are separated", "[collision]") {
  const model::Model a = test::sheet(12, 12, 0.01);
  const model::Model m = test::join(a, a);
  std::vector<Vector3d> x = m.start;
  for (std::size_t i = a.n_particles(); i < x.size(); ++i)
    x[i] += Vector3d(0.0013, 0.2 * (x[i][0] - 0.036) + 0.03 * (x[i][2] + 0.05), 0.0017);
  CHECK(untangle(m, {}, x, 400) >= 0);
}

TEST_CASE("a sheet partly inside a ball comes out", "[collision]") {
  const model::Model m = test::sheet(14, 14, 0.01);
  for (double depth : {0.002, 0.010, 0.025}) {
    const std::vector<body::Body> bodies{test::ball(0.05, {0.065, -0.05 + depth, -0.065})};
    std::vector<Vector3d> x = m.start;
    INFO("depth " << depth);
    CHECK(untangle(m, bodies, x, 400) >= 0);
  }
}

TEST_CASE("a sheet stretched through a thin rod comes off", "[collision]") {
  const model::Model m = test::sheet(6, 6, 0.03);
  body::Body rod = test::ball(0.004, {0, 0, 0}, 8, 10);
  for (Vector3d& v : rod.mesh.vertices) v = Vector3d(0.0773 + 20 * v[0], v[1], -0.0712 + v[2]);
  body::build_index(rod);
  std::vector<Vector3d> x = m.start;
  for (Vector3d& p : x) p[1] += 0.0003;
  const ContactMesh mesh(m, {rod});
  REQUIRE_FALSE(find_tangle(mesh, {rod}, x).hits.empty());
  CHECK(untangle(m, {rod}, x, 400) >= 0);
}
