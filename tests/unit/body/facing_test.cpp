// What of a body faces a point, and which way it pushes.
#include <catch2/catch.hpp>
#include <cmath>

#include "runtime/body/body.hpp"
#include "runtime/body/shapes.hpp"
#include "tests/unit/body/meshes.hpp"

using namespace garment::body;

namespace {

/// Two balls of radius 0.1 m with `gap` between them at the origin, along x.
Body two_balls(double gap) {
  TriangleMesh mesh;
  const double x = 0.1 + gap / 2;
  append(mesh, ellipsoid_mesh({0.1, 0.1, 0.1}), {-x, 0, 0});
  append(mesh, ellipsoid_mesh({0.1, 0.1, 0.1}), {x, 0, 0});
  return body_of(std::move(mesh));
}

std::vector<SurfacePoint> facing(const Body& body, const Vector3d& p, double radius) {
  auto nearest = body.closest(p, radius);
  REQUIRE(nearest);
  std::vector<SurfacePoint> others;
  body.facing(p, radius, *nearest, others);
  return others;
}

}  // namespace

TEST_CASE("between two balls both face a point, beside one only it does") {
  const Body body = two_balls(0.004);
  const auto others = facing(body, {0.0005, 0, 0}, 0.01);
  REQUIRE(others.size() == 1);
  CHECK(others[0].distance == Approx(0.0025).margin(1e-4));
  CHECK(others[0].push.x() > 0.99);  // from the left ball
  CHECK(facing(body, {0, 0.03, 0}, 0.01).size() == 1);
  CHECK(facing(body, {0.204, 0, 0}, 0.01).empty());
  CHECK(facing(body, {0.1, 0.1005, 0}, 0.01).empty());
}

TEST_CASE("facets of a round body do not count as places of their own") {
  const Body ball = body_of(ellipsoid_mesh({0.1, 0.1, 0.1}));
  for (int k = 0; k < 200; ++k) {
    const double a = 0.7 * k, b = 0.31 * k;
    const Vector3d n(std::cos(a) * std::cos(b), std::sin(b), std::sin(a) * std::cos(b));
    CHECK(facing(ball, 0.102 * n, 0.01).empty());
  }
}

TEST_CASE("a ball pushes along its radius, whatever its facets") {
  const Body ball = body_of(ellipsoid_mesh({0.05, 0.05, 0.05}));
  double worst = 0, worst_facet = 0, largest_turn = 0;
  Vector3d last = Vector3d::Zero();
  for (int k = 0; k < 4000; ++k) {
    const double a = 0.0005 * k, b = 0.3 + 0.0002 * k;
    const Vector3d n(std::cos(a) * std::cos(b), std::sin(b), std::sin(a) * std::cos(b));
    const auto s = ball.closest(0.0515 * n, 0.01);
    REQUIRE(s);
    worst = std::max(worst, (s->push - n).norm());
    worst_facet = std::max(worst_facet, (s->normal - n).norm());
    if (k > 0) largest_turn = std::max(largest_turn, (s->push - last).norm());
    last = s->push;
  }
  CHECK(worst < 0.01);
  CHECK(worst < 0.2 * worst_facet);
  CHECK(largest_turn < 0.005);  // 0.5 mrad lie between two samples
}

TEST_CASE("sharp edges stay sharp: flat faces push straight, edges away from themselves") {
  TriangleMesh cube;
  for (int k = 0; k < 8; ++k)
    cube.vertices.emplace_back(k & 1 ? 0.1 : -0.1, k & 2 ? 0.1 : -0.1, k & 4 ? 0.1 : -0.1);
  cube.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  REQUIRE(signed_volume(cube) > 0);
  const Body body = body_of(std::move(cube));
  for (double x : {-0.099, -0.05, 0.0, 0.03, 0.0999}) {
    const auto s = body.closest({x, 0.102, 0.03}, 0.01);
    REQUIRE(s);
    CHECK((s->push - Vector3d(0, 1, 0)).norm() < 1e-12);
  }
  const auto edge = body.closest({0.101, 0.102, 0.03}, 0.01);
  REQUIRE(edge);
  CHECK((edge->push - Vector3d(1, 2, 0).normalized()).norm() < 1e-9);
  const auto inside = body.closest({0.099, 0.05, 0.03}, 0.01);
  REQUIRE(inside);
  CHECK(inside->distance == Approx(-0.001));
  CHECK((inside->push - Vector3d(1, 0, 0)).norm() < 1e-12);
}
