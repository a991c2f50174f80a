#include "runtime/body/shapes.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "runtime/base/portable_math.hpp"
#include "runtime/body/mesh_repair.hpp"
#include "runtime/body/slice.hpp"
#include "tests/unit/body/meshes.hpp"

using namespace garment::body;

namespace {

constexpr double kPi = garment::portable::kPi;

void check_sound(const TriangleMesh& mesh, double volume, double tolerance, double angle) {
  SurfaceCheck check = check_surface(mesh);
  CHECK(check.open_edges == 0);
  CHECK(check.twisted_edges == 0);
  CHECK(signed_volume(mesh) == Approx(volume).epsilon(tolerance));
  CHECK(smallest_angle(mesh) > angle);
  // Euler: a closed surface without handles.
  CHECK(mesh.vertices.size() * 2 == mesh.triangles.size() + 4);
}

}  // namespace

TEST_CASE("plain shapes are watertight, outward, of the right volume, and without slivers") {
  check_sound(ellipsoid_mesh({0.1, 0.1, 0.1}), 4 * kPi / 3 * 1e-3, 0.01, 35);
  check_sound(ellipsoid_mesh({0.2, 0.1, 0.15}), 4 * kPi / 3 * 3e-3, 0.01, 20);
  check_sound(cylinder_mesh(0.09, 0.3), kPi * 0.0081 * 0.3, 0.01, 12);
  check_sound(cylinder_mesh(0.45, 0.74), kPi * 0.2025 * 0.74, 0.01, 12);
  check_sound(cylinder_mesh(0.01, 0.002), kPi * 1e-4 * 0.002, 0.2, 3);
  check_sound(box_mesh({0.4, 0.3, 0.2}), 0.4 * 0.3 * 0.2, 0.01, 12);
  check_sound(box_mesh({0.4, 0.3, 0.01}), 0.4 * 0.3 * 0.01, 0.05, 10);
  check_sound(floor_mesh(), 64, 0.01, 10);
}

TEST_CASE("shapes lie where they should") {
  Loop ring = slice(cylinder_mesh(0.09, 0.3), horizontal(0.15)).front();
  CHECK(perimeter(ring) == Approx(2 * kPi * 0.09).epsilon(1e-3));
  CHECK(loop_area(ring) > 0);
  double low = 1, high = -1;
  for (const Vector3d& p : cylinder_mesh(0.09, 0.3).vertices)
    low = std::min(low, p.y()), high = std::max(high, p.y());
  CHECK(low == 0);
  CHECK(high == Approx(0.3));
  high = -1;
  for (const Vector3d& p : floor_mesh().vertices) high = std::max(high, p.y());
  CHECK(high == Approx(0).margin(1e-12));
}

TEST_CASE("slices are closed, counter-clockwise, and hulls enclose them") {
  TriangleMesh mesh = box_mesh({0.4, 0.3, 0.2});
  for (double y : {-0.1, 0.0, 0.07}) {
    std::vector<Loop> loops = slice(mesh, horizontal(y));
    REQUIRE(loops.size() == 1);
    CHECK(loop_area(loops[0]) == Approx(0.08).epsilon(0.01));
    Loop hull = convex_hull(loops[0]);
    CHECK(loop_area(hull) >= loop_area(loops[0]) - 1e-12);
    CHECK(perimeter(hull) <= perimeter(loops[0]) + 1e-12);
    CHECK(loop_centroid(hull).norm() < 1e-9);
  }
  CHECK(slice(mesh, horizontal(0.2)).empty());
  Loop clipped = clip_x(slice(mesh, horizontal(0.0))[0], -0.1, 0.05);
  CHECK(loop_low(clipped).x() == Approx(-0.1));
  CHECK(loop_high(clipped).x() == Approx(0.05));
}

TEST_CASE("hulls of few points") {
  CHECK(convex_hull({}).empty());
  CHECK(convex_hull({{0, 0}, {0, 0}}).size() == 1);
  CHECK(convex_hull({{0, 0}, {1, 0}, {0.5, 0}, {1, 1}, {0, 1}, {0.5, 0.5}}).size() == 4);
  CHECK(perimeter(convex_hull({{0, 0}, {1, 0}, {1, 1}, {0, 1}})) == Approx(4));
}
