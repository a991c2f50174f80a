// Truncated steps never start an intersection.
#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "runtime/base/parallel.hpp"
#include "runtime/simulator/kept_candidates.hpp"
#include "runtime/simulator/truncate.hpp"
#include "runtime/simulator/untangle.hpp"
#include "tests/unit/simulator/collision_support.hpp"

using namespace garment;
using namespace garment::simulator;
using garment::test::Random;

namespace {

/// A sheet folded into layers `gap` apart around half circles.
void fold(std::vector<Vector3d>& x, std::size_t first, std::size_t n, double length, double gap) {
  for (std::size_t i = first; i < first + n; ++i) {
    const double s = x[i][0], arc = std::numbers::pi * gap / 2;
    const double period = length + arc;
    const int layer = static_cast<int>(s / period);
    const double along = s - layer * period;
    const double y = layer * gap, sign = layer % 2 == 0 ? 1 : -1;
    double u = std::min(along, length), v = 0;
    if (along > length) {
      const double angle = (along - length) / (gap / 2);
      u = length + gap / 2 * std::sin(angle);
      v = gap / 2 * (1 - std::cos(angle));
    }
    x[i][0] = sign > 0 ? u : length - u;
    x[i][1] += y + v;
  }
}

/// Two sheets in layers, the second over the first.
std::vector<Vector3d> folded(const model::Model& m, std::size_t n_first) {
  std::vector<Vector3d> x = m.start;
  fold(x, 0, n_first, 0.03, 0.006);
  fold(x, n_first, x.size() - n_first, 0.035, 0.005);
  for (std::size_t i = n_first; i < x.size(); ++i) x[i] += Vector3d(0.004, 0.05, 0.003);
  return x;
}

Vector3d random_step(Random& random, int step, std::size_t i, double size) {
  // Noise, common drift, and squeezing towards the middle, by turns.
  switch (step % 4) {
    case 0:
      return random.vector(size);
    case 1:
      return Vector3d(0, i % 2 == 0 ? size : -size, 0) + random.vector(0.1 * size);
    case 2:
      return random.vector(0.01 * size) + Vector3d(0, -size, 0);
    default:
      return random.vector(0.2 * size);
  }
}

}  // namespace

TEST_CASE("2000 huge random steps of folded sheets do not cut", "[collision]") {
  const model::Model a = test::sheet(14, 6, 0.01), b = test::sheet(12, 5, 0.01);
  const model::Model m = test::join(a, b);
  const ContactMesh mesh(m, {});
  std::vector<Vector3d> x = folded(m, a.n_particles());
  REQUIRE(find_tangle(mesh, {}, x).empty());
  Random random(10);
  Candidates candidates;
  std::size_t limited = 0;
  double travelled = 0;
  for (int step = 0; step < 2000; ++step) {
    if (step % 3 == 0) candidates.rebuild(mesh, x, 0.006);
    std::vector<Vector3d> dx(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
      dx[i] = random_step(random, step, i, step % 7 == 0 ? 1.0 : 0.01);
    const std::vector<Vector3d> wish = dx;
    limited += truncate(mesh, candidates, x, dx).limited;
    for (std::size_t i = 0; i < x.size(); ++i) {
      REQUIRE(dx[i].norm() <= wish[i].norm() * (1 + 1e-12));
      x[i] += dx[i];
      travelled += dx[i].norm();
    }
    REQUIRE(find_tangle(mesh, {}, x).empty());
  }
  CHECK(limited > 10000);
  CHECK(travelled > 20);  // m over all particles: the walls did not freeze everything
}

TEST_CASE("folded sheets that fly and turn go their way, and do not cut", "[collision]") {
  const model::Model a = test::sheet(13, 9, 0.01), b = test::sheet(9, 11, 0.01);
  const model::Model m = test::join(a, b);
  const ContactMesh mesh(m, {});
  std::vector<Vector3d> x = folded(m, a.n_particles());
  Random random(12);
  KeptCandidates candidates(mesh, 0.01);
  double wished = 0, gone = 0;
  int lists = 0;
  const int steps = 300;
  for (int step = 0; step < steps; ++step) {
    if (candidates.refresh(x)) ++lists;
    Vector3d middle = Vector3d::Zero();
    for (const Vector3d& p : x) middle += p / static_cast<double>(x.size());
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.02, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    std::vector<Vector3d> dx(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
      dx[i] = Vector3d(0.3, -0.2, 0.1) + turn * (x[i] - middle) - (x[i] - middle) + random_step(random, step, i, 1e-4);
    const std::vector<Vector3d> wish = dx;
    if (truncate(mesh, candidates.list(), x, dx).out_of_reach > 0) {
      candidates.renew(x);
      ++lists;
      dx = wish;
      truncate(mesh, candidates.list(), x, dx);
    }
    for (std::size_t i = 0; i < x.size(); ++i) {
      wished += wish[i].norm();
      gone += dx[i].norm();
      x[i] += dx[i];
    }
    REQUIRE(find_tangle(mesh, {}, x).empty());
  }
  CHECK(gone > 0.95 * wished);
  CHECK(lists < steps / 2);  // what goes on together leaves the list as it is
}

TEST_CASE("where a list is too old for a step all stop, and that is told", "[collision]") {
  const model::Model a = test::sheet(9, 7, 0.01), b = test::sheet(9, 7, 0.01);
  const model::Model m = test::join(a, b);
  const ContactMesh mesh(m, {});
  std::vector<Vector3d> x = m.start;
  for (std::size_t i = a.n_particles(); i < x.size(); ++i) x[i][1] += 0.05;
  Candidates candidates;
  candidates.rebuild(mesh, x, 0.006);
  // The second sheet is far from where it was listed, just over the first; it wants back, then through it.
  for (std::size_t i = a.n_particles(); i < x.size(); ++i) x[i] += Vector3d(0.003, -0.045, 0.002);
  for (const double way : {0.045, -0.02}) {
    std::vector<Vector3d> dx(x.size(), Vector3d::Zero());
    for (std::size_t i = a.n_particles(); i < x.size(); ++i) dx[i][1] = way;
    CHECK(truncate(mesh, candidates, x, dx).out_of_reach == x.size());
    for (const Vector3d& d : dx) REQUIRE(d.norm() == 0);
  }
}

TEST_CASE("500 huge random steps of a sheet on a ball do not cut", "[collision]") {
  const std::vector<body::Body> bodies{test::ball(0.04, {0.06, -0.042, -0.06})};
  const model::Model m = test::sheet(13, 13, 0.01);
  const ContactMesh mesh(m, bodies);
  std::vector<Vector3d> x = m.start;
  REQUIRE(find_tangle(mesh, bodies, x).empty());
  Random random(11);
  Candidates candidates;
  for (int step = 0; step < 500; ++step) {
    if (step % 3 == 0) candidates.rebuild(mesh, x, 0.008);
    std::vector<Vector3d> dx(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
      dx[i] = random_step(random, step, i, step % 5 == 0 ? 0.5 : 0.005);
    truncate(mesh, candidates, x, dx);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += dx[i];
    REQUIRE(find_tangle(mesh, bodies, x).empty());
  }
}

TEST_CASE("motion along a wall is free, motion away too", "[collision]") {
  const std::vector<body::Body> bodies{
      test::ball(1.0, {0.02, -1.001, -0.02}, 4, 6)};  // its top lies 1 mm below
  model::Model m = test::sheet(3, 3, 0.01);
  std::vector<Vector3d> x = m.start;
  const ContactMesh mesh(m, bodies);
  Candidates candidates;
  candidates.rebuild(mesh, x, 0.02);
  std::vector<Vector3d> dx(x.size(), Vector3d(0, 0.005, 0));
  const TruncateStats away = truncate(mesh, candidates, x, dx);
  CHECK(away.limited == 0);
  CHECK(dx[4] == Vector3d(0, 0.005, 0));
}

TEST_CASE("who comes has the gap to itself, who comes too shares it", "[collision]") {
  model::Model m = test::join(test::sheet(3, 3, 0.01), test::sheet(3, 3, 0.01));
  std::vector<Vector3d> x = m.start;
  for (std::size_t i = 9; i < 18; ++i) x[i][1] = 0.002;
  const ContactMesh mesh(m, {});
  Candidates candidates;
  candidates.rebuild(mesh, x, 0.02);
  std::vector<Vector3d> dx(x.size(), Vector3d::Zero());
  for (std::size_t i = 9; i < 18; ++i) dx[i] = {0.003, -0.005, 0.001};
  truncate(mesh, candidates, x, dx, {.fraction = 0.8});
  for (std::size_t i = 9; i < 18; ++i) {  // towards a sheet that waits: which keeps a tenth of the gap
    CHECK(dx[i][1] == Approx(-0.8 * 0.9 * 0.002).epsilon(1e-4));
    CHECK(dx[i][0] == Approx(0.003).epsilon(1e-4));
    CHECK(dx[i][2] == Approx(0.001).epsilon(1e-4));
  }
  for (std::size_t i = 0; i < 18; ++i) dx[i] = {0, i < 9 ? 0.005 : -0.005, 0};
  truncate(mesh, candidates, x, dx, {.fraction = 0.8});
  for (std::size_t i = 0; i < 18; ++i) CHECK(dx[i][1] == Approx(i < 9 ? 0.8 * 0.001 : -0.8 * 0.001).epsilon(1e-4));
  // The ground: a big flat-topped body.
  body::Body ground;
  ground.mesh.vertices = {{-1, -0.002, -1}, {1, -0.002, -1}, {1, -0.002, 1}, {-1, -0.002, 1}, {0, -1, 0}};
  ground.mesh.triangles = {{0, 2, 1}, {0, 3, 2}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  body::build_index(ground);
  const model::Model one = test::sheet(3, 3, 0.01);
  const ContactMesh on_ground(one, {ground});
  candidates.rebuild(on_ground, one.start, 0.02);
  dx.assign(9, Vector3d(0.002, -0.005, 0));
  truncate(on_ground, candidates, one.start, dx, {.fraction = 0.8});
  for (const Vector3d& d : dx) {
    CHECK(d[1] == Approx(-0.8 * 0.002).epsilon(1e-4));
    CHECK(d[0] == Approx(0.002).epsilon(1e-4));
  }
}

TEST_CASE("sheets that go together are free, however near; one that is held holds the other back", "[collision]") {
  model::Model m = test::join(test::sheet(4, 4, 0.01), test::sheet(4, 4, 0.01));
  std::vector<Vector3d> x = m.start;
  for (std::size_t i = 16; i < 32; ++i) x[i][1] = 1e-4;
  const ContactMesh mesh(m, {});
  Candidates candidates;
  candidates.rebuild(mesh, x, 0.02);
  const std::vector<Vector3d> together(x.size(), Vector3d(0.001, 0.006, -0.002));
  std::vector<Vector3d> dx = together;
  CHECK(truncate(mesh, candidates, x, dx).limited == 0);
  CHECK(dx == together);
  for (std::size_t i = 16; i < 32; ++i) dx[i].setZero();  // the upper one stays
  truncate(mesh, candidates, x, dx);
  for (std::size_t i = 0; i < 16; ++i) CHECK(dx[i][1] < 1e-4);
  dx = together;
  for (std::size_t i = 16; i < 32; ++i) dx[i] *= 0.5;  // goes on half as far
  truncate(mesh, candidates, x, dx);
  for (std::size_t i = 0; i < 16; ++i) CHECK((dx[i][1] > 0.003 && dx[i][1] < 0.0031));
}

TEST_CASE("nobody leaves the reach of the candidates, broken numbers do not move", "[collision]") {
  const model::Model m = test::sheet(3, 3, 0.01);
  const ContactMesh mesh(m, {});
  Candidates candidates;
  candidates.rebuild(mesh, m.start, 0.01);
  std::vector<Vector3d> dx(9, Vector3d(0, 0.3, 0));
  dx[3] = {std::nan(""), 0, 0};
  dx[5] = {1e308, 1e308, 1e308};
  const TruncateStats stats = truncate(mesh, candidates, m.start, dx);
  CHECK(stats.limited == 9);
  for (const Vector3d& d : dx) {
    REQUIRE(d.allFinite());
    CHECK(d.norm() <= candidates.reach() * (1 + 1e-9));
  }
  CHECK(dx[0].norm() == Approx(candidates.reach()));
  CHECK(dx[3].norm() == 0);
}

TEST_CASE("truncation gives the same bits for any thread count", "[collision]") {
  const model::Model m = test::join(test::sheet(20, 20, 0.01), test::sheet(20, 20, 0.01));
  std::vector<Vector3d> x = m.start;
  for (std::size_t i = 400; i < 800; ++i) x[i] += Vector3d(0.0021, 0.0015, 0.0013);
  const ContactMesh mesh(m, {test::ball(0.08, {0.1, -0.081, -0.1})});
  Candidates candidates;
  candidates.rebuild(mesh, x, 0.008);
  Random random(12);
  std::vector<Vector3d> wish(x.size());
  for (Vector3d& d : wish) d = random.vector(0.004);
  const int before = thread_count();
  std::vector<std::vector<Vector3d>> results;
  for (int threads : {1, 2, 4}) {
    set_thread_count(threads);
    results.push_back(wish);
    truncate(mesh, candidates, x, results.back());
  }
  set_thread_count(before);
  CHECK(results[0] == results[1]);
  CHECK(results[0] == results[2]);
  CHECK(results[0] != wish);
}
