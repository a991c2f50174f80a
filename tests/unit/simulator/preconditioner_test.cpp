// Aggregates, the sparse Cholesky of the coarse matrix, and the two-level preconditioner.
#include "runtime/simulator/preconditioner.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

#include "runtime/base/parallel.hpp"
#include "tests/support/dense_algebra.hpp"
#include "tests/support/linear_case.hpp"

namespace {

using namespace garment;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::Vector3f;
using Eigen::VectorXd;
using simulator::Aggregates;
using simulator::BlockCholesky;
using simulator::Preconditioner;
using test::hanging;
using test::LinearCase;
using test::Noise;

/// The preconditioner as a matrix, column by column.
MatrixXd dense(Preconditioner& p, std::size_t n) {
  MatrixXd out(3 * n, 3 * n);
  std::vector<Vector3f> r(n), z;
  for (std::size_t k = 0; k < 3 * n; ++k) {
    std::fill(r.begin(), r.end(), Vector3f::Zero());
    r[k / 3][static_cast<Eigen::Index>(k % 3)] = 1;
    p.apply(r, z);
    for (std::size_t i = 0; i < n; ++i)
      out.block<3, 1>(static_cast<Eigen::Index>(3 * i), static_cast<Eigen::Index>(k)) = z[i].cast<double>();
  }
  return out;
}

/// Every particle that is not fixed is in one group, lists agree, groups hang together in the pattern.
void check_partition(const Aggregates& groups, const simulator::BlockPattern& pattern,
                     const simulator::Holds& holds) {
  std::size_t counted = 0;
  for (std::size_t a = 0; a < groups.size(); ++a) {
    REQUIRE(groups.begin[a] < groups.begin[a + 1]);
    const std::set<model::Index> members(groups.member.begin() + groups.begin[a],
                                         groups.member.begin() + groups.begin[a + 1]);
    counted += members.size();
    std::vector<model::Index> reached{*members.begin()};
    std::set<model::Index> seen(reached.begin(), reached.end());
    for (std::size_t q = 0; q < reached.size(); ++q) {
      REQUIRE(groups.of[reached[q]] == static_cast<model::Index>(a));
      for (auto k = pattern.row_begin[reached[q]]; k < pattern.row_begin[reached[q] + 1]; ++k)
        if (members.count(pattern.column[k]) && seen.insert(pattern.column[k]).second)
          reached.push_back(pattern.column[k]);
    }
    REQUIRE(reached.size() == members.size());
  }
  REQUIRE(counted == groups.member.size());
  for (std::size_t i = 0; i < pattern.n_rows(); ++i) REQUIRE((groups.of[i] < 0) == holds.is_fixed(i));
}

}  // namespace

TEST_CASE("aggregates are compact and cover what is free") {
  const LinearCase c(hanging(40, 30), 1);
  const auto& pattern = c.matrix.pattern();
  check_partition(simulator::group_particles(pattern, c.holds, nullptr, 16), pattern, c.holds);
  const Aggregates groups = simulator::group_particles(pattern, c.holds, &c.model.start, 20);
  check_partition(groups, pattern, c.holds);
  CHECK(groups.size() >= 50);
  CHECK(groups.size() <= 75);
  double square =
      0;  // over a compact patch of 20 particles the mean square distance from the middle is 3.3 h^2
  for (std::size_t a = 0; a < groups.size(); ++a) {
    Vector3d middle = Vector3d::Zero();
    const auto size = groups.begin[a + 1] - groups.begin[a];
    CHECK(size <= 45);
    for (auto m = groups.begin[a]; m < groups.begin[a + 1]; ++m)
      middle += c.model.start[groups.member[m]] / size;
    for (auto m = groups.begin[a]; m < groups.begin[a + 1]; ++m)
      square += (c.model.start[groups.member[m]] - middle).squaredNorm();
  }
  CHECK(square / static_cast<double>(groups.member.size()) < 4.5e-4);
  // The shape of the cloth does not matter, only its pattern and the middles do.
  const Aggregates again = simulator::group_particles(pattern, c.holds, &c.model.start, 20);
  CHECK(again.of == groups.of);
}

TEST_CASE("particles without links, or with fixed ones only, get a group of their own") {
  model::Model m;
  m.mass.assign(5, 1.0);
  test::SheetSpec spec;
  m.start.assign(5, Vector3d::Zero());
  m.hold_particle = {1};
  m.hold_kind = {model::HoldKind::point};
  m.hold_point = {Vector3d::Zero()};
  m.hold_normal = {Vector3d::Zero()};
  const simulator::Holds holds(m);
  const auto pattern = simulator::BlockPattern::from_pairs(5, {{0, 1}, {2, 3}});
  for (const auto* x : {static_cast<const std::vector<Vector3d>*>(nullptr), &std::as_const(m.start)}) {
    const Aggregates groups = simulator::group_particles(pattern, holds, x, 16);
    check_partition(groups, pattern, holds);
    CHECK(groups.size() == 3);
    CHECK(groups.of[2] == groups.of[3]);
  }
}

TEST_CASE("the block Cholesky solves like the dense one") {
  Noise noise(3);
  for (const int n : {1, 2, 9, 40}) {
    std::vector<std::array<int, 2>> places;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j <= i; ++j)
        if (i == j || (7 * i + 3 * j) % 11 == 0 || i - j == 1) places.push_back({i, j});
    MatrixXd a = MatrixXd::Zero(6 * n, 6 * n);
    std::vector<BlockCholesky::Block> blocks;
    for (const auto& [i, j] : places) {
      BlockCholesky::Block b;
      for (int k = 0; k < 36; ++k) b(k / 6, k % 6) = noise();
      if (i == j) b = BlockCholesky::Block(b + b.transpose()) + 20.0 * BlockCholesky::Block::Identity();
      blocks.push_back(b);
      a.block<6, 6>(6 * i, 6 * j) = b;
      a.block<6, 6>(6 * j, 6 * i) = b.transpose();
    }
    BlockCholesky cholesky;
    cholesky.analyze(n, places);
    for (int round = 0; round < 2; ++round) {  // the second run must not see the first
      REQUIRE(cholesky.factor(blocks) == 0);
      std::vector<BlockCholesky::Vector> b(static_cast<std::size_t>(n));
      VectorXd rhs(6 * n);
      for (int k = 0; k < 6 * n; ++k) b[k / 6][k % 6] = rhs[k] = noise();
      cholesky.solve(b);
      const VectorXd expected = test::solved(a, rhs);
      for (int k = 0; k < 6 * n; ++k) CHECK(b[k / 6][k % 6] == Approx(expected[k]).margin(1e-13));
    }
  }
}

TEST_CASE("an unknown without stiffness stays at zero") {
  BlockCholesky cholesky;
  cholesky.analyze(2, {{0, 0}, {1, 0}, {1, 1}});
  BlockCholesky::Block d = BlockCholesky::Block::Identity(), off = BlockCholesky::Block::Zero();
  BlockCholesky::Block singular = d;
  singular(4, 4) = 0;
  singular(5, 5) = -1;
  CHECK(cholesky.factor({d, off, singular}) == 2);
  std::vector<BlockCholesky::Vector> b(2, BlockCholesky::Vector::Ones());
  cholesky.solve(b);
  CHECK(b[0] == BlockCholesky::Vector::Ones());
  CHECK(b[1].head<4>() == Eigen::Vector4d::Ones());
  CHECK(b[1].tail<2>().norm() < 1e-100);
  cholesky.analyze(0, {});
  CHECK(cholesky.factor({}) == 0);
}

TEST_CASE("the preconditioner is symmetric positive definite on what is free") {
  model::Model m = hanging(9, 8);
  m.hold_particle.push_back(5);
  m.hold_kind.push_back(model::HoldKind::plane);
  m.hold_point.push_back(m.start[5]);
  m.hold_normal.emplace_back(1, 2, -0.5);
  LinearCase c(m, 2);
  c.add_contact({{0, 60, 61, 52}, {1, -0.5F, -0.3F, -0.2F}, Vector3f::UnitZ(), 100});
  c.add_contact({{5, 6, 20, -1}, {0.4F, 0.6F, -1, 0}, Vector3f(1, 1, 1).normalized(), 50});
  for (const bool with_positions : {false, true}) {
    Preconditioner p(c.matrix.pattern(), c.holds);
    p.factor(c.matrix, with_positions ? &c.x : nullptr, c.contacts);
    MatrixXd z = dense(p, c.x.size());
    MatrixXd projector = MatrixXd::Zero(z.rows(), z.cols());
    for (std::size_t i = 0; i < c.x.size(); ++i)
      projector.block<3, 3>(static_cast<Eigen::Index>(3 * i), static_cast<Eigen::Index>(3 * i)) =
          c.holds.projector(i);
    z = MatrixXd(z * projector);  // the argument of `apply` has to be filtered
    const double scale = z.cwiseAbs().maxCoeff();
    CHECK((z - z.transpose()).cwiseAbs().maxCoeff() < 1e-5 * scale);
    const VectorXd eigenvalues = test::eigenvalues((z + z.transpose()) / 2);
    // Seven directions are held; the others are positive.
    CHECK(eigenvalues.head<7>().cwiseAbs().maxCoeff() < 1e-6 * scale);
    CHECK(eigenvalues[7] > 1e-8 * scale);
  }
}

TEST_CASE("rigid pieces bring the condition number down") {
  const LinearCase c(hanging(16, 16), 2);
  const MatrixXd a = c.matrix.to_dense();
  std::vector<Eigen::Index> free;
  for (std::size_t i = 0; i < c.x.size(); ++i)
    if (!c.holds.is_fixed(i))
      for (int k = 0; k < 3; ++k) free.push_back(static_cast<Eigen::Index>(3 * i) + k);
  const Eigen::LLT<MatrixXd> root(MatrixXd(a(free, free)));
  double condition[2];
  for (const bool with_positions : {false, true}) {
    Preconditioner p(c.matrix.pattern(), c.holds);
    p.factor(c.matrix, with_positions ? &c.x : nullptr);
    const MatrixXd z = dense(p, c.x.size())(free, free);
    const MatrixXd similar = root.matrixL().transpose() * z * MatrixXd(root.matrixL());
    const VectorXd e = test::eigenvalues((similar + similar.transpose()) / 2);
    condition[with_positions] = e[e.size() - 1] / e[0];
  }
  CAPTURE(condition[0], condition[1]);
  CHECK(condition[1] < 150);
  CHECK(condition[1] < condition[0] / 2);
}

TEST_CASE("the preconditioner gives the same bits for any number of threads") {
  const LinearCase c(hanging(60, 50), 1);
  std::vector<Vector3f> r, first, z;
  for (std::size_t i = 0; i < c.x.size(); ++i) r.push_back(c.holds.filtered(i, c.force[i]).cast<float>());
  double first_product = 0;
  for (const int threads : {1, 2, 4}) {
    set_thread_count(threads);
    Preconditioner p(c.matrix.pattern(), c.holds);
    p.factor(c.matrix, &c.x);
    const double product = p.apply(r, z);
    if (threads == 1) {
      first = z;
      first_product = product;
    }
    CHECK(product == first_product);
    CHECK(z == first);
  }
  set_thread_count(2);
}
