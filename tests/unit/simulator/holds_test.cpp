// What holds leave free.
#include "runtime/simulator/holds.hpp"

#include <catch2/catch.hpp>

namespace {

using namespace garment;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using model::HoldKind;
using simulator::Holds;

model::Model particles(int n) {
  model::Model m;
  m.mass.assign(static_cast<std::size_t>(n), 1.0);
  return m;
}

void hold(model::Model& m, model::Index i, HoldKind kind, const Vector3d& point, const Vector3d& normal) {
  m.hold_particle.push_back(i);
  m.hold_kind.push_back(kind);
  m.hold_point.push_back(point);
  m.hold_normal.push_back(normal);
}

}  // namespace

TEST_CASE("holds take away what they carry") {
  model::Model m = particles(6);
  const Vector3d any(1, -2, 3), slope = Vector3d(1, 1, 0);
  hold(m, 1, HoldKind::point, any, Vector3d::Zero());
  hold(m, 2, HoldKind::plane, any, 5 * Vector3d::UnitY());
  hold(m, 3, HoldKind::plane, any, Vector3d::UnitY());
  hold(m, 3, HoldKind::plane, any, slope);  // leaves the line along z
  hold(m, 4, HoldKind::plane, any, Vector3d::UnitX());
  hold(m, 4, HoldKind::plane, any, -Vector3d::UnitX());  // the same plane again
  hold(m, 5, HoldKind::plane, any, Vector3d::UnitX());
  hold(m, 5, HoldKind::plane, any, slope);
  hold(m, 5, HoldKind::plane, any, Vector3d(1, 1, 1));  // three planes: a point
  const Holds holds(m);

  CHECK(holds.is_free(0));
  CHECK(holds.filtered(0, any) == any);
  CHECK(holds.is_fixed(1));
  CHECK(holds.filtered(1, any) == Vector3d::Zero());
  CHECK(holds.projector(1) == Matrix3d::Zero());
  CHECK_FALSE(holds.is_free(2));
  CHECK_FALSE(holds.is_fixed(2));
  CHECK((holds.filtered(2, any) - Vector3d(1, 0, 3)).norm() < 1e-15);
  CHECK((holds.filtered(3, any) - Vector3d(0, 0, 3)).norm() < 1e-15);
  CHECK((holds.filtered(4, any) - Vector3d(0, -2, 3)).norm() < 1e-15);
  CHECK(holds.is_fixed(5));

  for (std::size_t i = 0; i < 6; ++i) {
    const Matrix3d p = holds.projector(i);
    CHECK((p * p - p).norm() < 1e-15);
    CHECK((p - p.transpose()).norm() < 1e-15);
    CHECK((p * any - holds.filtered(i, any)).norm() < 1e-15);
  }
  std::vector<Eigen::Vector3f> all(6, any.cast<float>());
  holds.filter(all);
  for (std::size_t i = 0; i < 6; ++i) CHECK((all[i].cast<double>() - holds.filtered(i, any)).norm() < 1e-6);
}

TEST_CASE("a point hold wins over planes in any order") {
  for (const bool point_first : {true, false}) {
    model::Model m = particles(1);
    if (point_first) hold(m, 0, HoldKind::point, Vector3d::Zero(), Vector3d::Zero());
    hold(m, 0, HoldKind::plane, Vector3d::Zero(), Vector3d::UnitZ());
    if (!point_first) hold(m, 0, HoldKind::point, Vector3d::Zero(), Vector3d::Zero());
    CHECK(Holds(m).is_fixed(0));
  }
}

TEST_CASE("the way back to a hold") {
  model::Model m = particles(2);
  hold(m, 0, HoldKind::point, {1, 2, 3}, Vector3d::Zero());
  hold(m, 1, HoldKind::plane, {1, 2, 3}, 2 * Vector3d::UnitY());
  const Holds holds(m);
  CHECK(holds.error(m, 0, {1, 1, 1}) == Vector3d(0, 1, 2));
  CHECK(holds.error(m, 1, {7, 1, 8}) == Vector3d(0, 1, 0));
  CHECK(holds.error(m, 1, {7, 2, 8}) == Vector3d::Zero());
}
