// How bodies push cloth.
#include "runtime/simulator/body_contact.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "runtime/body/shapes.hpp"
#include "runtime/simulator/elastic.hpp"
#include "tests/support/grid_model.hpp"

namespace {

using namespace garment;
using namespace garment::simulator;
using Eigen::Vector3d;
using Positions = std::vector<Vector3d>;

body::Body body_of(body::TriangleMesh mesh, const Vector3d& shift) {
  body::Body body;
  body.mesh = std::move(mesh);
  for (Vector3d& p : body.mesh.vertices) p += shift;
  body::build_index(body);
  return body;
}

/// A sheet whose first particle is the one that is looked at; the others lie far away.
model::Model one_particle() {
  test::SheetSpec spec;
  spec.nx = spec.ny = 2;
  spec.h = 0.01;
  spec.thickness = 0.4e-3;
  return test::make_sheet(spec);
}

/// Net push on a particle at `at`, N.
Vector3d push_at(BodyContact& contact, const ElasticModel& elastic, const Vector3d& at) {
  Positions x(4, Vector3d(5, 5, 5)), force(4, Vector3d::Zero());
  x[0] = at;
  BlockMatrix matrix = elastic.make_matrix();
  contact.find(x);
  contact.add_forces(x, force, matrix);
  return force[0];
}

}  // namespace

TEST_CASE("the law of a push: force and stiffness are the derivatives of its energy, and never jump back") {
  const double k = 1000, offset = 1.7e-3;
  double last = 0;
  for (double depth : {1e-6, 5e-5, 0.99e-4, 1.01e-4, 5e-4, 1.39e-3, 1.41e-3, 1.7e-3, 1.99e-3, 2.01e-3, 5e-3, 0.05}) {
    const double step = 1e-5 * depth;
    const PushLaw law(depth, offset, k), plus(depth + step, offset, k), minus(depth - step, offset, k);
    CHECK(law.force == Approx((plus.energy - minus.energy) / (2 * step)).epsilon(1e-4));
    CHECK(law.stiffness == Approx((plus.force - minus.force) / (2 * step)).epsilon(1e-4));
    CHECK(law.force > last);
    last = law.force;
  }
  CHECK(PushLaw(0, offset, k).force == 0);
  CHECK(PushLaw(-1e-3, offset, k).energy == 0);
  CHECK(PushLaw(1e-3, offset, k).stiffness == k);
  CHECK(PushLaw(1.6e-3, offset, k).stiffness > 10 * k);  // hard at the surface
  CHECK(PushLaw(0.05, offset, k).stiffness == k);        // deep inside it only leads out
}

TEST_CASE("a ball pushes what lies nearer than its offset, and nothing else") {
  const model::Model m = one_particle();
  const ElasticModel elastic(m);
  const std::vector<body::Body> bodies{body_of(body::ellipsoid_mesh({0.1, 0.1, 0.1}), {0, 0, 0})};
  BodyContact contact(m, bodies, 0.01, {});
  CHECK(push_at(contact, elastic, {0, 0.1018, 0}).norm() == 0);
  const Vector3d f = push_at(contact, elastic, {0, 0.101, 0});
  CHECK(f.y() == Approx(1000 * (0.7e-3 - 0.05e-3)).epsilon(0.05));
  CHECK(std::hypot(f.x(), f.z()) < 0.02 * f.y());
  contact.extra_offset()[0] = 1e-3;
  CHECK(push_at(contact, elastic, {0, 0.1018, 0}).y() > 0);
}

TEST_CASE("between parts that nearly touch nothing is jammed, and cloth is led to where there is room") {
  const model::Model m = one_particle();
  const ElasticModel elastic(m);
  for (double gap : {1.2e-3, 0.8e-3, 0.2e-3})
    for (bool one_body : {true, false}) {
      INFO("gap " << gap << (one_body ? ", one body" : ", two bodies"));
      const double x = 0.1 + gap / 2;
      body::TriangleMesh both = body::ellipsoid_mesh({0.1, 0.1, 0.1});
      const auto n = static_cast<int>(both.vertices.size());
      for (int i = 0; i < n; ++i) both.vertices.push_back(both.vertices[i] + Vector3d(x, 0, 0));
      for (int i = 0; i < n; ++i) both.vertices[i].x() -= x;
      for (std::size_t t = both.triangles.size(); t-- > 0;)
        both.triangles.push_back({both.triangles[t][0] + n, both.triangles[t][1] + n, both.triangles[t][2] + n});
      std::vector<body::Body> bodies;
      if (one_body)
        bodies.push_back(body_of(both, {0, 0, 0}));
      else
        bodies = {body_of(body::ellipsoid_mesh({0.1, 0.1, 0.1}), {-x, 0, 0}),
                  body_of(body::ellipsoid_mesh({0.1, 0.1, 0.1}), {x, 0, 0})};
      BodyContact contact(m, bodies, 0.01, {});
      // 1 cm over the narrowest place: 1 mm more room. The push leads on, away from it, and to neither side.
      const Vector3d out = push_at(contact, elastic, {0, 0.01, 0});
      CHECK(out.y() > 0.1);
      CHECK(std::abs(out.x()) < 0.2 * out.y());
      // Far out nothing acts.
      CHECK(push_at(contact, elastic, {0, 0.03, 0}).norm() == 0);
    }
}

TEST_CASE("who is about to be pressed is counted once") {
  const model::Model m = one_particle();
  const ElasticModel elastic(m);
  const std::vector<body::Body> bodies{body_of(body::ellipsoid_mesh({0.1, 0.1, 0.1}), {0, 0, 0})};
  BodyContact contact(m, bodies, 0.01, {});
  Positions x(4, Vector3d(5, 5, 5)), dx(4, Vector3d::Zero()), force(4, Vector3d::Zero());
  x[0] = {0, 0.102, 0};
  BlockMatrix matrix = elastic.make_matrix();
  const Holds holds(m);
  contact.find(x);
  CHECK(contact.foresee(x, dx, holds, force, matrix) == 0);
  dx[0] = {0, -1e-3, 0};
  CHECK(contact.foresee(x, dx, holds, force, matrix) == 1);
  CHECK(contact.foresee(x, dx, holds, force, matrix) == 0);
  CHECK(force[0].y() < 0);  // as a spring that is long enough already: it acts once the step has closed the gap
  CHECK(matrix.diagonal(0)(1, 1) == Approx(contact.stiffness()).epsilon(1e-3));
}
