// Every energy alone: hand-computed values, force = -gradient, sums of forces and torques, rigid motion,
// matrix.
#include "runtime/simulator/elastic.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "runtime/base/parallel.hpp"
#include "runtime/simulator/elastic_kernels.hpp"
#include "tests/support/dense_algebra.hpp"
#include "tests/support/elastic_cases.hpp"
#include "tests/support/grid_model.hpp"

namespace {

using namespace garment;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using simulator::ElasticModel;
using test::ElasticCase;
using Positions = std::vector<Vector3d>;

double norm(const Positions& f) {
  double sum = 0;
  for (const Vector3d& v : f) sum += v.squaredNorm();
  return std::sqrt(sum);
}

/// Places the particles of `m` so that `place(u, v)` is where the pattern's point (u, v) goes.
template <class Place>
Positions placed(const model::Model& m, const Place& place) {
  Positions x;
  for (const auto& uv : m.vertex_uv) x.push_back(place(uv[0], uv[1]));
  return x;
}

Matrix3d some_rotation() {
  return (Eigen::AngleAxisd(0.7, Vector3d(1, 2, -0.5).normalized()) *
          Eigen::AngleAxisd(2.1, Vector3d::UnitY()))
      .matrix();
}

}  // namespace

TEST_CASE("a stretched spring") {
  model::Model m;
  m.mass = {1, 1};
  m.spring = {{0, 1}};
  m.spring_rest = {0.01};
  m.spring_width = {0.005};
  m.spring_law = {0};
  m.spring_panel = {0};
  m.fit_begin = {0};
  m.laws = {test::linear_law(800)};
  const ElasticModel elastic(m);
  Positions f;
  auto hessian = elastic.make_matrix();
  // Strain 0.2: N = 160 N/m, force 0.8 N, energy 800 / 2 * 0.2^2 * 0.01 * 0.005 J.
  CHECK(elastic.energy_force_hessian({{0, 0, 0}, {0, 0.012, 0}}, f, hessian) == Approx(8e-4).epsilon(1e-12));
  CHECK((f[0] - Vector3d(0, 0.8, 0)).norm() < 1e-12);
  CHECK((f[1] - Vector3d(0, -0.8, 0)).norm() < 1e-12);
  const Matrix3d along = Vector3d(0.8 / 0.012, 800 * 0.005 / 0.01, 0.8 / 0.012).asDiagonal();
  CHECK((hessian.diagonal(0) - along).norm() < 1e-6 * along.norm());
  // Compressed: the transversal part would be negative and is dropped.
  elastic.energy_force_hessian({{0, 0, 0}, {0, 0.008, 0}}, f, hessian);
  CHECK((f[0] - Vector3d(0, -0.8, 0)).norm() < 1e-12);
  CHECK((hessian.diagonal(0) - Matrix3d(Vector3d(0, 400, 0).asDiagonal())).norm() < 1e-3);
}

TEST_CASE("a sheared cell") {
  test::SheetSpec spec;
  spec.stretch = 1e-12;
  spec.twist = 0;
  spec.shear = 40;
  const model::Model m = test::make_sheet(spec);
  const double phi = 0.3;
  const auto x =
      placed(m, [&](double u, double v) { return Vector3d(u + v * std::sin(phi), v * std::cos(phi), 0); });
  Positions f;
  CHECK(ElasticModel(m).energy_and_force(x, f) == Approx(0.5 * 40 * phi * phi * 1e-4).epsilon(1e-10));
  // The upper side is pushed across the warp threads: its force times h is dE/dphi.
  const Vector3d across(std::cos(phi), -std::sin(phi), 0);
  CHECK((f[2] + f[3] + 40 * phi * 0.01 * across).norm() < 1e-10);
}

TEST_CASE("a bent line") {
  model::Model m;
  m.mass = {1, 1, 1};
  m.bend = {{0, 1, 2}};
  m.bend_lengths = {{0.01, 0.02}};
  m.bend_width = {0.005};
  m.bend_rigidity = {1e-5};
  m.fit_begin = {0};
  const ElasticModel elastic(m);
  const double k = 0.005 * 1e-5 / 0.015;
  auto energy_at = [&](double theta) {
    return elastic.energy({{-0.01, 0, 0}, {0, 0, 0}, {0.02 * std::cos(theta), 0.02 * std::sin(theta), 0}});
  };
  for (double degrees : {0.01, 1.0, 30.0, 90.0, 120.0, 150.0, 179.0}) {
    const double theta = degrees * M_PI / 180;
    CHECK(energy_at(theta) == Approx(0.5 * k * theta * theta).epsilon(1e-9));
    CHECK(energy_at(-theta) == Approx(0.5 * k * theta * theta).epsilon(1e-9));
  }
}

namespace {

/// A cross of a warp and a weft line, both bending; the weft is ironed to the back by 0.8 rad, the warp to the face by 0.5.
model::Model creased_cross() {
  model::Model m;
  const double h = 0.01;
  m.mass.assign(5, 1);
  m.start = {{-h, 0, 0}, {0, 0, 0}, {h, 0, 0}, {0, -h, 0}, {0, h, 0}};
  m.bend = {{3, 1, 4}, {0, 1, 2}};
  m.bend_lengths = {{h, h}, {h, h}};
  m.bend_width = {h, h};
  m.bend_rigidity = {1e-5, 2e-5};
  m.crease_bend = {0, 1};
  m.crease_angle = {-0.5, 0.8};
  m.crease_axis = {{2, 0}, {3, 4}};
  m.fit_begin = {0};
  return m;
}

}  // namespace

TEST_CASE("a crease costs nothing where it is folded as ironed, and turns with the cloth") {
  const model::Model m = creased_cross();
  ElasticModel elastic(m);
  auto folded = [](double warp, double weft) {  // weft to the back of the face +z, warp to the face
    const double h = 0.01;
    return Positions{{-h, 0, 0}, {0, 0, 0}, {h * std::cos(weft), 0, -h * std::sin(weft)},
                     {0, -h, 0}, {0, h * std::cos(warp), h * std::sin(warp)}};
  };
  CHECK(elastic.energy(m.start) == Approx(0.5 * (1e-5 * 0.5 * 0.5 + 2e-5 * 0.8 * 0.8)));
  const double of_weft = 0.5 * 2e-5 * 0.8 * 0.8, flat = elastic.energy(m.start);
  Positions x = folded(0.5, 0);
  for (Vector3d& p : x) p = some_rotation() * p;
  elastic.follow(x);
  CHECK(elastic.energy(x) == Approx(of_weft).epsilon(1e-9));
  x = folded(0, 0.8);
  elastic.follow(x);
  CHECK(elastic.energy(x) == Approx(0.5 * 1e-5 * 0.5 * 0.5).epsilon(1e-9));
  x = folded(0, -0.8);
  elastic.follow(x);
  CHECK(elastic.energy(x) > 3 * flat);
}

TEST_CASE("the force of a crease is minus the gradient of the energy as long as its axis stands") {
  ElasticModel elastic(creased_cross());
  Positions x{{-0.011, 0.001, 0.002}, {0, 0, 0}, {0.008, -0.001, -0.004}, {0.001, -0.009, 0.001}, {0, 0.01, 0.003}}, f;
  elastic.follow(x);
  elastic.energy_and_force(x, f);
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 0; i < x.size(); ++i) {
    sum += f[i];
    for (int axis = 0; axis < 3; ++axis) {
      const double at = x[i][axis], d = 1e-6;
      x[i][axis] = at + d;
      const double up = elastic.energy(x);
      x[i][axis] = at - d;
      const double down = elastic.energy(x);
      x[i][axis] = at;
      CHECK(f[i][axis] == Approx(-(up - down) / (2 * d)).epsilon(1e-5).margin(1e-9));
    }
  }
  CHECK(sum.norm() < 1e-12);
}

TEST_CASE("a twisted cell") {
  test::SheetSpec spec;
  spec.stretch = 1e-12;
  spec.shear = 0;
  spec.twist = 5e-6;
  const model::Model m = test::make_sheet(spec);
  const double kappa = 7;
  const auto x = placed(m, [&](double u, double v) { return Vector3d(u, v, kappa * u * v); });
  CHECK(ElasticModel(m).energy(x) == Approx(2 * 5e-6 * kappa * kappa * 1e-4).epsilon(1e-9));
}

TEST_CASE("a sheet bent into a paraboloid has the plate's energy per area") {
  test::SheetSpec spec;
  spec.nx = 5;
  spec.ny = 4;
  spec.shear = 0;
  model::Model m = test::make_sheet(spec);
  m.spring.clear();
  // Flat and strained without gradient: neither bending nor twist may see it.
  const auto strained = placed(m, [](double u, double v) { return Vector3d(1.2 * u + 0.3 * v, 0.8 * v, 0); });
  CHECK(ElasticModel(m).energy(strained) < 1e-25);
  const double eps = 1e-4, k12 = 0.3;
  const auto twisted = placed(m, [&](double u, double v) { return Vector3d(u, v, eps * k12 * u * v); });
  CHECK(ElasticModel(m).energy(twisted) ==
        Approx(2 * spec.twist * eps * eps * k12 * k12 * 12 * 1e-4).epsilon(1e-6));
}

TEST_CASE("a cut cell under uniform strain") {
  const ElasticCase c = test::membrane_case();
  const auto& m = c.model;
  // U = (0.1, 1.05, 0), V = (0.97, 0, 0): strains and shear angle are the same in every triangle.
  const auto x = placed(m, [](double u, double v) { return Vector3d(0.97 * u + 0.1 * v, 1.05 * v, 0); });
  const double length = std::hypot(0.1, 1.05), e1 = length - 1, e2 = -0.03, phi = std::asin(0.1 / length);
  double expected = 0;
  for (double a : m.membrane_area) expected += a * (450 * e1 * e1 + 450 * e2 * e2 + 25 * phi * phi);
  CHECK(ElasticModel(m).energy(x) == Approx(expected).epsilon(1e-10));
}

TEST_CASE("a tie pulls beyond its length only, and beyond its reach no harder") {
  model::Model m;
  m.mass = {1, 1, 1, 1};
  m.fit_begin = {0};
  // From particle 0 to the middle between 1 and 2.
  m.tie = {{0, 0, 0, 1, 2, 1}};
  m.tie_weights = {{0.2, 0.3, 0.5, 0.25, 0.5, 0.25}};
  m.tie_length = {0.01};
  m.tie_stiffness = {400};
  m.tie_closure = {0};
  const ElasticModel elastic(m);
  auto at = [](double distance) { return Positions{{0, 0, 0}, {-1, distance, 0}, {1, distance, 0}, {5, 5, 5}}; };
  Positions f;
  auto hessian = elastic.make_matrix();
  CHECK(elastic.energy_force_hessian(at(0.009), f, hessian) == 0);
  CHECK(norm(f) == 0);
  CHECK(hessian.to_dense().norm() == 0);
  // Too long by 2 mm: 0.8 N and 0.8 mJ.
  CHECK(elastic.energy_force_hessian(at(0.012), f, hessian) == Approx(8e-4).epsilon(1e-12));
  CHECK((f[0] - Vector3d(0, 0.8, 0)).norm() < 1e-12);
  CHECK((f[1] - Vector3d(0, -0.4, 0)).norm() < 1e-12);
  CHECK((f[2] - f[1]).norm() < 1e-12);
  CHECK(f[3] == Vector3d::Zero());
  const Matrix3d whole = Vector3d(0.8 / 0.012, 400, 0.8 / 0.012).asDiagonal();
  CHECK((hessian.diagonal(0) - whole).norm() < 1e-6 * whole.norm());
  CHECK((hessian.diagonal(1) - whole / 4).norm() < 1e-6 * whole.norm());
  // Too long by three times its reach of 5 mm: 2 N, and 2 N * (15 mm - 2.5 mm).
  CHECK(elastic.energy_and_force(at(0.025), f) == Approx(0.025).epsilon(1e-12));
  CHECK((f[0] - Vector3d(0, 2, 0)).norm() < 1e-12);
}

TEST_CASE("forces and torques of every term sum to zero") {
  for (const ElasticCase& c : test::elastic_cases())
    for (const Positions& x : c.states) {
      INFO(c.name);
      Positions f;
      const double energy = ElasticModel(c.model).energy_and_force(x, f);
      CHECK(energy > 0);
      Vector3d sum = Vector3d::Zero(), torque = Vector3d::Zero();
      double size = 0;
      for (std::size_t i = 0; i < f.size(); ++i) {
        sum += f[i];
        torque += x[i].cross(f[i]);
        size += f[i].norm();
      }
      REQUIRE(size > 0);
      CHECK(sum.norm() < 1e-12 * size);
      CHECK(torque.norm() < 1e-12 * size * 0.1);  // 0.1 m: the extent of the models
    }
}

TEST_CASE("force is minus the gradient of the energy") {
  for (const ElasticCase& c : test::elastic_cases())
    for (const Positions& start : c.states) {
      INFO(c.name);
      const ElasticModel elastic(c.model);
      Positions x = start, f, difference(x.size());
      elastic.energy_and_force(x, f);
      for (std::size_t i = 0; i < x.size(); ++i)
        for (int axis = 0; axis < 3; ++axis) {
          // Fourth order: two central differences at 1e-6 and 2e-6 m.
          const double at = start[i][axis], d = 1e-6;
          auto energy_at = [&](double offset) {
            x[i][axis] = at + offset;
            return elastic.energy(x);
          };
          const double near = energy_at(d) - energy_at(-d), far = energy_at(2 * d) - energy_at(-2 * d);
          x[i][axis] = at;
          difference[i][axis] = f[i][axis] + (8 * near - far) / (12 * d);
        }
      CHECK(norm(difference) < 1e-6 * norm(f));
    }
}

TEST_CASE("a rigid motion changes neither energy nor, turned along, the forces") {
  const Matrix3d turn = some_rotation();
  for (const ElasticCase& c : test::elastic_cases())
    for (const Positions& x : c.states) {
      INFO(c.name);
      const ElasticModel elastic(c.model);
      Positions moved = x, f, g;
      for (Vector3d& p : moved) p = turn * p + Vector3d(0.03, -0.02, 0.05);
      const double energy = elastic.energy_and_force(x, f), again = elastic.energy_and_force(moved, g);
      CHECK(std::abs(energy - again) < 1e-12 * energy);
      for (std::size_t i = 0; i < g.size(); ++i) g[i] -= turn * f[i];
      CHECK(norm(g) < 1e-11 * norm(f));
    }
}

TEST_CASE("the matrix is symmetric, positive semidefinite and costs translations nothing") {
  for (const ElasticCase& c : test::elastic_cases())
    for (const Positions& x : c.states) {
      INFO(c.name);
      const ElasticModel elastic(c.model);
      auto matrix = elastic.make_matrix();
      Positions f;
      elastic.energy_force_hessian(x, f, matrix);
      const Eigen::MatrixXd dense = matrix.to_dense();
      CHECK((dense - dense.transpose()).norm() < 1e-14 * dense.norm());
      const Eigen::VectorXd values = test::eigenvalues(dense);
      CHECK(values.minCoeff() > -1e-6 * values.maxCoeff());
      CHECK(values.maxCoeff() > 0);
      std::vector<Eigen::Vector3f> shift(x.size(), Eigen::Vector3f(1, -2, 3)), y;
      matrix.multiply(shift, y);
      for (const auto& v : y) CHECK(v == Eigen::Vector3f::Zero());
    }
}

TEST_CASE("the matrix is the exact Hessian where nothing was dropped") {
  // Rest and uniform stretch (springs), rest (trellis, bends), anything (twist, fits).
  for (const ElasticCase& c : test::elastic_cases()) {
    INFO(c.name);
    const ElasticModel elastic(c.model);
    auto matrix = elastic.make_matrix();
    Positions x = c.exact, f, forward, backward;
    elastic.energy_force_hessian(x, f, matrix);
    const Eigen::MatrixXd dense = matrix.to_dense();
    Eigen::MatrixXd differences = Eigen::MatrixXd::Zero(dense.rows(), dense.cols());
    const double d = 1e-7;
    for (std::size_t i = 0; i < x.size(); ++i)
      for (int axis = 0; axis < 3; ++axis) {
        const double at = x[i][axis];
        x[i][axis] = at + d;
        elastic.energy_and_force(x, forward);
        x[i][axis] = at - d;
        elastic.energy_and_force(x, backward);
        x[i][axis] = at;
        for (std::size_t j = 0; j < x.size(); ++j)
          differences.block<3, 1>(3 * j, 3 * i + axis) = (backward[j] - forward[j]) / (2 * d);
      }
    if (c.only_normal)  // the bends' matrix adds a stiffness along the line: compare what moves out of the
                        // sheet
      for (Eigen::Index r = 0; r < dense.rows(); ++r)
        for (Eigen::Index k = 0; k < dense.cols(); ++k)
          if (r % 3 == 2 && k % 3 == 2)
            CHECK(std::abs(dense(r, k) - differences(r, k)) < 1e-5 * dense.norm());
    if (!c.only_normal) CHECK((dense - differences).norm() < 1e-5 * dense.norm());
  }
}

TEST_CASE("the product with the matrix is the dense product, and what was added counts") {
  const ElasticCase c = test::elastic_cases().back();
  const ElasticModel elastic(c.model);
  auto matrix = elastic.make_matrix();
  Positions f;
  elastic.energy_force_hessian(c.states[0], f, matrix);
  const auto elastic_part = matrix.to_dense();
  matrix.add_diagonal(3, 2.5);
  Matrix3d contact = Matrix3d::Zero();
  contact(1, 1) = 40;
  contact(0, 1) = contact(1, 0) = 3;
  matrix.add_diagonal(c.states[0].size() - 1, contact);
  const auto dense = matrix.to_dense();
  CHECK((dense - elastic_part).sum() == Approx(3 * 2.5 + 46).epsilon(1e-5));
  std::vector<Eigen::Vector3f> x, y;
  Eigen::VectorXd flat(dense.rows());
  for (std::size_t i = 0; i < c.states[0].size(); ++i) {
    x.push_back(c.states[1][i].cast<float>());
    flat.segment<3>(3 * i) = x[i].cast<double>();
  }
  const double dot = matrix.multiply_and_dot(x, y);
  const Eigen::VectorXd expected = dense * flat;
  for (std::size_t i = 0; i < y.size(); ++i)
    CHECK((y[i].cast<double>() - expected.segment<3>(3 * i)).norm() <
          1e-5 * dense.norm() * flat.lpNorm<Eigen::Infinity>());
  CHECK(dot == Approx(flat.dot(expected)).epsilon(1e-4));
  matrix.clear_added();
  CHECK(matrix.to_dense() == elastic_part);
}

TEST_CASE("the number of threads does not change a bit") {
  test::SheetSpec spec;
  spec.nx = 61;
  spec.ny = 47;
  const model::Model m = test::make_sheet(spec);
  const Positions x = test::crumpled(m, 0.4 * spec.h, 5);
  const ElasticModel elastic(m);
  auto run = [&](int threads) {
    set_thread_count(threads);
    Positions f;
    auto matrix = elastic.make_matrix();
    std::vector<double> bits{elastic.energy(x), elastic.energy_and_force(x, f)};
    bits.push_back(elastic.energy_force_hessian(x, f, matrix));
    for (const Vector3d& v : f) bits.insert(bits.end(), v.data(), v.data() + 3);
    std::vector<Eigen::Vector3f> p, y;
    for (const Vector3d& v : x) p.push_back(v.cast<float>());
    bits.push_back(matrix.multiply_and_dot(p, y));
    for (const auto& v : y) bits.insert(bits.end(), v.data(), v.data() + 3);
    for (std::size_t i = 0; i < x.size(); ++i) {
      const Matrix3d d = matrix.diagonal(i);
      bits.insert(bits.end(), d.data(), d.data() + 9);
    }
    set_thread_count(2);
    return bits;
  };
  const auto one = run(1);
  CHECK(one[0] == one[1]);
  CHECK(one[0] == one[2]);
  CHECK(one == run(2));
  CHECK(one == run(4));
}

TEST_CASE("the numbering of the particles changes results only by rounding") {
  test::SheetSpec spec;
  spec.nx = 31;
  spec.ny = 40;
  model::Model m = test::make_sheet(spec);
  const Positions x = test::crumpled(m, 0.2 * spec.h, 9);
  std::vector<model::Index> to(x.size());
  for (std::size_t i = 0; i < x.size(); ++i)
    to[i] = static_cast<model::Index>((i * 377) % x.size());  // 1240, 377 coprime
  Positions f, g, y(x.size());
  const double energy = ElasticModel(m).energy_and_force(x, f);
  auto renumber = [&](auto& stencils) {
    for (auto& s : stencils)
      for (auto& p : s) p = to[p];
  };
  renumber(m.spring);
  renumber(m.cell);
  renumber(m.bend);
  for (std::size_t i = 0; i < x.size(); ++i) y[to[i]] = x[i];
  CHECK(ElasticModel(m).energy_and_force(y, g) == Approx(energy).epsilon(1e-13));
  Positions difference;
  for (std::size_t i = 0; i < x.size(); ++i) difference.push_back(g[to[i]] - f[i]);
  CHECK(norm(difference) < 1e-13 * norm(f));
}

TEST_CASE("collapsed stencils and merged corners stay finite") {
  test::SheetSpec spec;
  spec.nx = spec.ny = 3;
  model::Model m = test::make_sheet(spec);
  auto check_finite = [](const model::Model& model, const Positions& x) {
    const ElasticModel elastic(model);
    auto matrix = elastic.make_matrix();
    Positions f;
    CHECK(std::isfinite(elastic.energy_force_hessian(x, f, matrix)));
    CHECK(std::isfinite(norm(f)));
    CHECK(matrix.to_dense().allFinite());
  };
  check_finite(m, Positions(9, Vector3d(1, 2, 3)));                                      // a point
  check_finite(m, placed(m, [](double u, double v) { return Vector3d(u + v, 0, 0); }));  // a line
  check_finite(
      m, placed(m, [](double u, double) { return Vector3d(u < 0.015 ? u : 0.0, 0, 0); }));  // folded back
  m.cell[0][3] = m.cell[0][0];  // a seam has merged two corners of one cell
  check_finite(m, test::crumpled(m, 0.003, 2));
}

TEST_CASE("models without particles, or with particles alone, have no energy") {
  model::Model m;
  Positions f{Vector3d(1, 2, 3)};
  const ElasticModel nothing(m);
  auto empty = nothing.make_matrix();
  CHECK(nothing.energy_force_hessian({}, f, empty) == 0);
  CHECK(f.empty());
  m.mass = {1, 1};
  m.fit_begin = {0, 0};  // one fit, of no particle
  m.fit_area = {1e-4};
  m.fit_rigidity = {{1e-5, 1e-5, 1e-5, 0, 0, 0}};
  const ElasticModel alone(m);
  auto matrix = alone.make_matrix();
  CHECK(alone.energy_force_hessian({{0, 0, 0}, {1, 0, 0}}, f, matrix) == 0);
  CHECK(f == Positions(2, Vector3d::Zero()));
  matrix.add_diagonal(1, 3);
  std::vector<Eigen::Vector3f> y;
  matrix.multiply({{1, 2, 3}, {4, 5, 6}}, y);
  CHECK(y[1] == Eigen::Vector3f(12, 15, 18));
}

TEST_CASE("the tensile scale acts on springs, cut cells and ties only") {
  for (const ElasticCase& c : test::elastic_cases()) {
    INFO(c.name);
    ElasticModel elastic(c.model);
    const double before = elastic.energy(c.states[0]);
    elastic.set_tensile_scale(0.1);
    const double after = elastic.energy(c.states[0]);
    if (c.name == "springs" || c.name == "ties") CHECK(after == Approx(0.1 * before).epsilon(1e-12));
    if (c.name == "trellis" || c.name == "bends" || c.name == "twist" || c.name == "fits")
      CHECK(after == before);
  }
}

TEST_CASE("the tensile table follows the law, its slope and its integral") {
  const model::TensileLaw law = test::curved_law();
  const simulator::TensileTable table(law);
  for (std::size_t k = 0; k < law.strain.size(); ++k) {
    CHECK(table.at(law.strain[k]).force == Approx(law.force[k]).margin(1e-9));
    CHECK(table.at(law.strain[k]).slope == Approx(law.slope[k]).epsilon(1e-9));
  }
  CHECK(table.at(0).psi == Approx(0).margin(1e-15));
  for (double e = -0.6; e < 0.6; e += 0.00371) {
    const double d = 1e-6;
    INFO(e);
    CHECK((table.at(e + d).psi - table.at(e - d).psi) / (2 * d) ==
          Approx(table.at(e).force).epsilon(1e-5).margin(1e-4));
    CHECK((table.at(e + d).force - table.at(e - d).force) / (2 * d) ==
          Approx(table.at(e).slope).epsilon(1e-3));
  }
  CHECK(table.at(0.9).force == Approx(law.force.back() + law.slope.back() * (0.9 - law.strain.back())));
  const simulator::TensileTable line(model::TensileLaw{{0}, {0}, {500}});  // one knot is enough
  CHECK(line.at(0.1).psi == Approx(2.5));
  CHECK(line.at(-0.1).force == Approx(-50));
}

TEST_CASE("arc sine within two units of the last place") {
  for (double x = -1; x <= 1; x += 1.0 / 4096) {
    const auto exact = static_cast<double>(std::asin(static_cast<long double>(x)));
    CHECK(std::abs(simulator::arc_sine(x) - exact) <= 4.5e-16 * std::max(std::abs(exact), 1e-300));
  }
  CHECK(simulator::arc_sine(1.0000001) == simulator::arc_sine(1.0));
}
