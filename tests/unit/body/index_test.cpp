#include "runtime/body/index.hpp"

#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <limits>
#include <random>

#include "runtime/body/shapes.hpp"
#include "tests/unit/body/meshes.hpp"

using namespace garment::body;

namespace {

struct Random {
  std::mt19937_64 engine{11};
  double operator()(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine() >> 11) * 0x1p-53);
  }
  Vector3d point(double size) { return {(*this)(-size, size), (*this)(-size, size), (*this)(-size, size)}; }
};

double brute_distance(const TriangleMesh& mesh, const Vector3d& p) {
  double best = std::numeric_limits<double>::infinity();
  for (const auto& t : mesh.triangles)
    best = std::min(
        best,
        (closest_on_triangle(p, mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]).point - p)
            .norm());
  return best;
}

}  // namespace

TEST_CASE("the closest point of a triangle beats every sample of it") {
  Random random;
  for (int i = 0; i < 200; ++i) {
    Vector3d a = random.point(1), b = random.point(1), c = i % 5 == 0 ? Vector3d(2 * b - a) : random.point(1);
    Vector3d p = random.point(1.5);
    double found = (closest_on_triangle(p, a, b, c).point - p).norm();
    for (int u = 0; u <= 20; ++u)
      for (int v = 0; u + v <= 20; ++v)
        CHECK(found <= (a + u / 20.0 * (b - a) + v / 20.0 * (c - a) - p).norm() + 1e-12);
  }
}

TEST_CASE("signed distances of a box agree with its formula") {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.push_back({i & 1 ? 0.3 : -0.3, i & 2 ? 0.2 : -0.2, i & 4 ? 0.1 : -0.1});
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  REQUIRE(signed_volume(mesh) == Approx(0.6 * 0.4 * 0.2));
  Body body = body_of(mesh);
  Random random;
  for (int i = 0; i < 3000; ++i) {
    Vector3d p = random.point(0.6);
    Vector3d q = p.cwiseAbs() - Vector3d(0.3, 0.2, 0.1);
    double expected = q.cwiseMax(0).norm() + std::min(q.maxCoeff(), 0.0);
    auto hit = body.closest(p, 10);
    REQUIRE(hit);
    CHECK(hit->distance == Approx(expected).margin(1e-12));
    CHECK(hit->normal.norm() == Approx(1));
    CHECK((hit->point - p).norm() == Approx(std::fabs(hit->distance)).margin(1e-12));
    CHECK(body.inside(p) == (expected < 0));
    CHECK(body.winding(p) == Approx(expected < 0 ? 1 : 0).margin(0.02));
    CHECK(body.closest(p, std::fabs(expected) * 1.0001 + 1e-12).has_value());
    CHECK_FALSE(body.closest(p, std::fabs(expected) * 0.9999 - 1e-12).has_value());
  }
}

TEST_CASE("closest points agree with FCL's distance and collision") {
  Body body = body_of(ellipsoid_mesh({0.15, 0.25, 0.1}));
  // FCL measures distances of meshes only with OBBRSS (and kin) boxes.
  auto oracle = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
  std::vector<fcl::Vector3d> points(body.mesh.vertices.begin(), body.mesh.vertices.end());
  std::vector<fcl::Triangle> triangles;
  for (const auto& t : body.mesh.triangles) triangles.emplace_back(t[0], t[1], t[2]);
  oracle->beginModel();
  oracle->addSubModel(points, triangles);
  oracle->endModel();
  fcl::CollisionObjectd mesh_object(oracle);
  Random random;
  for (int i = 0; i < 200; ++i) {
    Vector3d p = random.point(0.4);
    auto hit = body.closest(p, 10);
    REQUIRE(hit);
    CHECK(std::fabs(hit->distance) == Approx(brute_distance(body.mesh, p)).margin(1e-12));
    if (hit->distance < 0.01) continue;
    double radius = 0.005;
    fcl::CollisionObjectd ball(std::make_shared<fcl::Sphered>(radius),
                               fcl::Transform3d(Eigen::Translation3d(p)));
    fcl::DistanceRequestd request;
    fcl::DistanceResultd result;
    double distance = fcl::distance(&mesh_object, &ball, request, result);
    CHECK(distance + radius == Approx(hit->distance).epsilon(1e-4).margin(1e-5));
    for (double factor : {0.99, 1.01}) {
      fcl::CollisionObjectd probe(std::make_shared<fcl::Sphered>(hit->distance * factor),
                                  fcl::Transform3d(Eigen::Translation3d(p)));
      fcl::CollisionRequestd collide_request;
      fcl::CollisionResultd collide_result;
      CHECK((fcl::collide(&mesh_object, &probe, collide_request, collide_result) > 0) == (factor > 1));
    }
  }
}

TEST_CASE("winding numbers count overlapping parts") {
  TriangleMesh mesh = ellipsoid_mesh({0.1, 0.1, 0.1});
  append(mesh, ellipsoid_mesh({0.1, 0.1, 0.1}), {0.12, 0, 0});
  Body body = body_of(mesh);
  CHECK(body.winding({0.06, 0, 0}) == Approx(2).margin(0.02));
  CHECK(body.winding({-0.05, 0, 0}) == Approx(1).margin(0.02));
  CHECK(body.winding({0.17, 0.01, 0}) == Approx(1).margin(0.02));
  CHECK(body.winding({0.06, 0.09, 0}) == Approx(0).margin(0.02));
  CHECK(body.winding({0, 5, 0}) == Approx(0).margin(1e-4));
  // The faces of each ball inside the other are no surface: the way out of the overlap leads past both.
  auto hit = body.closest({0.03, 0, 0}, 1);
  REQUIRE(hit);
  CHECK(hit->distance < -0.07);
  // Where the exact sum decides: on the surface itself.
  const auto& t = body.mesh.triangles.front();
  Vector3d middle = (body.mesh.vertices[t[0]] + body.mesh.vertices[t[1]] + body.mesh.vertices[t[2]]) / 3;
  Vector3d out = (body.mesh.vertices[t[1]] - body.mesh.vertices[t[0]])
                     .cross(body.mesh.vertices[t[2]] - body.mesh.vertices[t[0]])
                     .normalized();
  CHECK_FALSE(body.inside(middle + 1e-7 * out));
  CHECK(body.inside(middle - 1e-7 * out));
}

TEST_CASE("fast winding numbers stay close to the exact sum") {
  TriangleMesh mesh = cylinder_mesh(0.09, 0.4);
  append(mesh, box_mesh({0.3, 0.2, 0.1}), {0.05, 0.3, 0});
  Body body = body_of(mesh);
  Random random;
  for (int i = 0; i < 500; ++i) {
    Vector3d p = random.point(0.4);
    double exact = 0;
    for (const auto& t : mesh.triangles)
      exact += solid_angle(p, mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]);
    CHECK(body.winding(p) == Approx(exact).margin(0.02));
  }
}

TEST_CASE("an empty or one-triangle body and unsound points answer") {
  Body empty = body_of({});
  CHECK_FALSE(empty.closest({0, 0, 0}, 1));
  CHECK(empty.winding({0, 0, 0}) == 0);
  Body none;
  CHECK_FALSE(none.closest({0, 0, 0}, 1));
  TriangleMesh one;
  one.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  one.triangles = {{0, 1, 2}};
  Body single = body_of(one);
  auto hit = single.closest({0.2, 0.2, 0.5}, 1);
  REQUIRE(hit);
  CHECK(hit->distance == Approx(0.5));
  double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(single.closest({nan, 0, 0}, 1));
  CHECK_FALSE(single.closest({0, 0, 0}, nan));
  CHECK(single.winding({nan, 0, 0}) == 0);
}

TEST_CASE("ten thousand closest points take milliseconds") {
  Body body = body_of(ellipsoid_mesh({0.3, 0.6, 0.2}));
  REQUIRE(body.mesh.triangles.size() > 20000);
  Random random;
  std::vector<Vector3d> points;
  for (int i = 0; i < 10000; ++i) {
    Vector3d d = random.point(1).normalized();
    points.push_back(1.02 * d.cwiseProduct(Vector3d(0.3, 0.6, 0.2)));
  }
  int found = 0;
  auto start = std::chrono::steady_clock::now();
  for (const Vector3d& p : points) found += body.closest(p, 0.05).has_value();
  double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  CHECK(found == 10000);
  INFO(seconds * 1e2 << " us a point");
  CHECK(seconds < 0.3);  // about 2 us each on an idle machine; the bound only catches a broken tree
}
