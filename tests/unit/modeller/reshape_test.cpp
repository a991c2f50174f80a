#include "runtime/modeller/reshape.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "runtime/base/host.hpp"
#include "runtime/modeller/modeller.hpp"
#include "tests/unit/modeller/built.hpp"
#include "tests/unit/modeller/garments.hpp"

using namespace garment;
using model::Vector3d;
using Vectors = std::vector<Vector3d>;

namespace {

/// Largest stretch or squeeze of a spring.
double largest_strain(const model::Model& m, const Vectors& x) {
  double most = 0;
  for (std::size_t s = 0; s < m.spring.size(); ++s)
    most = std::max(most, std::abs((x[m.spring[s][0]] - x[m.spring[s][1]]).norm() / m.spring_rest[s] - 1));
  return most;
}

/// The sheet as part of a tube of radius 0.3 m.
Vectors rolled(const model::Model& m) {
  Vectors x(m.n_particles());
  for (std::size_t v = 0; v < m.n_vertices(); ++v) {
    const double angle = m.vertex_uv[v].x() / 0.3;
    x[m.vertex_particle[v]] = {0.3 * std::sin(angle), m.vertex_uv[v].y(), 0.3 * std::cos(angle)};
  }
  return x;
}

}  // namespace

TEST_CASE("reshape: a garment that was not changed keeps its positions bit for bit") {
  const design::Garment g = test::skirt(0.02);
  const model::Model m = test::build(g);
  const modeller::Transferred laid = modeller::transfer({g, m}, m.start, {g, m});
  CHECK(modeller::reshape({g, m}, m.start, {g, m}, laid, {}) == m.start);
}

TEST_CASE("reshape: a panel made larger hangs at its own size, as it was bent") {
  const design::Garment before = test::single(test::rectangle("sheet", 0.4, 0.3, 0.02));
  const design::Garment now = test::single(test::rectangle("sheet", 0.5, 0.4, 0.02));
  const model::Model was = test::build(before), is = test::build(now);
  const Vectors x = rolled(was);
  const modeller::Transferred laid = modeller::transfer({before, was}, x, {now, is});
  REQUIRE(largest_strain(is, laid.position) > 0.2);
  const Vectors reshaped = modeller::reshape({before, was}, x, {now, is}, laid, {});
  CHECK(largest_strain(is, reshaped) < 0.01);
  Vector3d middle = Vector3d::Zero(), middle_before = Vector3d::Zero();
  for (const Vector3d& p : reshaped) middle += p / static_cast<double>(reshaped.size());
  for (const Vector3d& p : laid.position) middle_before += p / static_cast<double>(reshaped.size());
  CHECK((middle - middle_before).norm() < 1e-3);
}

TEST_CASE("reshape: what is held goes to its hold, and the cloth with it") {
  design::Garment before = test::single(test::rectangle("sheet", 0.4, 0.3, 0.02));
  before.pins.push_back({"one", {}, 0, {0, 0.3}});
  design::Garment now = before;
  now.panels[0].placement.translation.y() += 0.5;
  const model::Model was = test::build(before), is = test::build(now);
  const modeller::Transferred laid = modeller::transfer({before, was}, was.start, {now, is});
  REQUIRE(laid.n_kept == is.n_particles());
  const Vectors reshaped = modeller::reshape({before, was}, was.start, {now, is}, laid, {});
  for (std::size_t i = 0; i < reshaped.size(); ++i)
    CHECK((reshaped[i] - was.start[i] - Vector3d(0, 0.5, 0)).norm() < 0.01);
}

TEST_CASE("reshape: cloth that lies on a body keeps its height") {
  design::Body declared;
  declared.name = "floor";
  declared.shape = design::Box{{2, 2, 2}};
  declared.position = {0, -1.001, 0};
  body::BodyResult body = body::build_body(declared, system_host(), "");
  REQUIRE(body.body);
  // A sheet whose upper part lies on the box and whose lower part hangs from it.
  auto hung = [](const model::Model& m) {
    Vectors x(m.n_particles());
    for (std::size_t v = 0; v < m.n_vertices(); ++v) {
      const double along = m.vertex_uv[v].y() - 0.15;
      x[m.vertex_particle[v]] = {m.vertex_uv[v].x(), std::min(0.0, along), along > 0 ? 1 - along : 1.002};
    }
    return x;
  };
  const design::Garment before = test::single(test::rectangle("sheet", 0.4, 0.3, 0.02));
  const design::Garment now = test::single(test::rectangle("sheet", 0.4, 0.4, 0.02));
  const model::Model was = test::build(before), is = test::build(now);
  const Vectors x = hung(was);
  const modeller::Transferred laid = modeller::transfer({before, was}, x, {now, is});
  const Vectors reshaped = modeller::reshape({before, was}, x, {now, is}, laid, {*body.body});
  double top = -1, low = 0;
  for (const Vector3d& p : reshaped) top = std::max(top, p.z() < 0.98 ? std::abs(p.y()) : 0), low = std::min(low, p.y());
  CHECK(top < 5e-3);
  CHECK(low < -0.18);
}
