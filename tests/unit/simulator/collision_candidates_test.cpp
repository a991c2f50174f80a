// Candidate pairs against all pairs.
#include <catch2/catch.hpp>
#include <map>

#include "runtime/base/parallel.hpp"
#include "runtime/simulator/candidates.hpp"
#include "runtime/simulator/closest_point.hpp"
#include "runtime/simulator/untangle.hpp"
#include "tests/unit/simulator/collision_support.hpp"

using namespace garment;
using namespace garment::simulator;
using garment::test::Random;

namespace {

double vt_distance(const ContactMesh& mesh, const std::vector<Vector3d>& x, Index v, Index t) {
  const Indices<3>& c = mesh.triangle[t];
  const Vector3d &a = mesh.at(x, c[0]), &b = mesh.at(x, c[1]), &d = mesh.at(x, c[2]);
  const TrianglePoint q = closest_on_triangle(mesh.at(x, v), a, b, d);
  return (mesh.at(x, v) - q.weights[0] * a - q.weights[1] * b - q.weights[2] * d).norm();
}

double ee_distance(const ContactMesh& mesh, const std::vector<Vector3d>& x, Index e, Index f) {
  const Indices<2>&i = mesh.edge[e], &j = mesh.edge[f];
  const Vector3d &a = mesh.at(x, i[0]), &b = mesh.at(x, i[1]), &c = mesh.at(x, j[0]), &d = mesh.at(x, j[1]);
  const SegmentPair s = closest_of_segments(a, b, c, d);
  return (a + s.s * (b - a) - c - s.t * (d - c)).norm();
}

using Key = std::array<Index, 3>;  // kind, a, b

std::map<Key, double> all_pairs(const ContactMesh& mesh, const std::vector<Vector3d>& x, double radius) {
  std::map<Key, double> out;
  auto add = [&](PairKind kind, Index a, Index b, double d) {
    if (d < radius) out[{static_cast<Index>(kind), a, b}] = d;
  };
  for (Index v = 0; v < static_cast<Index>(mesh.n_points()); ++v)
    for (Index t = 0; t < static_cast<Index>(mesh.triangle.size()); ++t) {
      const Indices<3>& c = mesh.triangle[t];
      if (c[0] == v || c[1] == v || c[2] == v || (mesh.is_body(v) && mesh.is_body(c[0]))) continue;
      const PairKind kind = mesh.is_body(v)      ? PairKind::body_v_cloth_t
                            : mesh.is_body(c[0]) ? PairKind::cloth_v_body_t
                                                 : PairKind::cloth_vt;
      add(kind, v, t, vt_distance(mesh, x, v, t));
    }
  for (Index e = 0; e < mesh.n_cloth_edges; ++e)
    for (Index f = e + 1; f < static_cast<Index>(mesh.edge.size()); ++f) {
      const Indices<2>&i = mesh.edge[e], &j = mesh.edge[f];
      if (i[0] == j[0] || i[0] == j[1] || i[1] == j[0] || i[1] == j[1]) continue;
      add(mesh.is_body(j[0]) ? PairKind::cloth_e_body_e : PairKind::cloth_ee, e, f,
          ee_distance(mesh, x, e, f));
    }
  return out;
}

}  // namespace

TEST_CASE("no near pair is missing and none is listed twice", "[collision]") {
  Random random(5);
  for (int trial = 0; trial < 4; ++trial) {
    const model::Model m = test::join(test::sheet(9, 8, 0.01), test::sheet(7, 9, 0.012));
    const std::vector<body::Body> bodies{test::ball(0.03, {0.04, -0.03, -0.03}, 6, 8)};
    const ContactMesh mesh(m, bodies);
    std::vector<Vector3d> x = m.start;
    for (Vector3d& p : x) p += random.vector(0.004 * trial);
    for (double radius : {0.002, 0.006, 0.012}) {
      Candidates candidates;
      candidates.rebuild(mesh, x, radius);
      std::map<Key, double> expected = all_pairs(mesh, x, radius);
      for (std::size_t k = 0; k < kPairKinds; ++k)
        for (std::size_t i = candidates.begin(PairKind(k)); i < candidates.end(PairKind(k)); ++i) {
          const Pair& pair = candidates.pairs()[i];
          const auto found = expected.find({static_cast<Index>(k), pair.a, pair.b});
          REQUIRE(found != expected.end());
          CHECK(pair.distance <= found->second + 1e-15);
          CHECK(pair.distance >= found->second * (1 - 3e-6) - 2e-12);
          expected.erase(found);
        }
      CHECK(expected.empty());
    }
  }
}

TEST_CASE("candidates are complete until parts that the list leaves out may be near", "[collision]") {
  const model::Model lower = test::sheet(5, 5, 0.01, 1e-3);
  const double radius = 0.005, least = 0.001;
  const auto sheets = [&](double gap) {
    model::Model m = test::join(lower, lower);
    for (std::size_t i = lower.n_particles(); i < m.n_particles(); ++i) m.start[i] += Vector3d(0.003, gap, 0.002);
    return m;
  };
  const auto lowered = [&](std::vector<Vector3d> x, double by) {
    for (std::size_t i = lower.n_particles(); i < x.size(); ++i) x[i].y() -= by;
    return x;
  };
  const model::Model far = sheets(0.02), near = sheets(0.004);
  const ContactMesh mesh(far, {});
  Candidates candidates;
  candidates.rebuild(mesh, far.start, radius);
  CHECK(candidates.complete(mesh, far.start, nullptr, least));
  CHECK(candidates.complete(mesh, lowered(far.start, 0.015), nullptr, least));
  CHECK_FALSE(candidates.complete(mesh, lowered(far.start, 0.0195), nullptr, least));
  std::vector<Vector3d> carried = far.start;
  for (Vector3d& p : carried) p += Vector3d(0.5, -0.3, 0.1);
  CHECK(candidates.complete(mesh, carried, nullptr, least));
  carried.pop_back();
  CHECK_FALSE(candidates.complete(mesh, carried, nullptr, least));
  // On the way of a step.
  const std::vector<Vector3d> none(far.n_particles(), Vector3d::Zero()), step = lowered(none, 0.0195);
  CHECK(candidates.complete(mesh, far.start, &none, least));
  CHECK_FALSE(candidates.complete(mesh, far.start, &step, least));
  // What the list has may come as near as it will, if it moved by less than the list reaches beyond `least`.
  candidates.rebuild(mesh, near.start, radius);
  CHECK(candidates.complete(mesh, lowered(near.start, 0.0035), nullptr, least));
  CHECK_FALSE(candidates.complete(mesh, lowered(near.start, 0.0045), nullptr, least));
}

TEST_CASE("the order of pairs does not depend on history or threads", "[collision]") {
  Random random(6);
  const model::Model m = test::sheet(20, 20, 0.01);
  const ContactMesh mesh(m, {test::ball(0.05, {0.1, -0.06, -0.1})});
  std::vector<Vector3d> x = m.start;
  for (Vector3d& p : x) p += random.vector(0.005);
  Candidates fresh, used;
  used.rebuild(mesh, m.start, 0.01);
  const int before = thread_count();
  set_thread_count(1);
  fresh.rebuild(mesh, x, 0.012);
  set_thread_count(4);
  used.rebuild(mesh, x, 0.012);
  set_thread_count(before);
  REQUIRE(fresh.pairs().size() == used.pairs().size());
  for (std::size_t i = 0; i < fresh.pairs().size(); ++i) {
    REQUIRE(fresh.pairs()[i].a == used.pairs()[i].a);
    REQUIRE(fresh.pairs()[i].b == used.pairs()[i].b);
  }
}

TEST_CASE("what is woven together has its contact distance cut, what is far has not", "[collision]") {
  const double h = 0.002, thickness = 0.003;
  const ContactMesh mesh(test::sheet(30, 3, h, thickness), {});
  // Particle 0 and the triangles of the strip: near ones less than half the flat distance, far ones the
  // thickness.
  for (Index t = 0; t < mesh.n_cloth_triangles; ++t) {
    const Indices<3>& c = mesh.triangle[t];
    if (c[0] == 0 || c[1] == 0 || c[2] == 0) continue;
    const double flat = vt_distance(mesh, test::sheet(30, 3, h, thickness).start, 0, t);
    CHECK(mesh.contact_distance_vt(0, t) < flat);
    if (flat > 6 * thickness) CHECK(mesh.contact_distance_vt(0, t) == Approx(thickness));
  }
}

TEST_CASE("pairs that cut each other are exempt, the others are not", "[collision]") {
  // A vertical sheet through a horizontal one.
  const model::Model a = test::sheet(6, 6, 0.01), b = test::sheet(4, 4, 0.01);
  model::Model m = test::join(a, b);
  for (std::size_t i = a.n_particles(); i < m.n_particles(); ++i) {
    const Vector3d p = m.start[i];
    m.start[i] = {0.0253, p[2] + 0.0151, -0.012 - p[0]};
  }
  const ContactMesh mesh(m, {});
  const Tangle tangle = find_tangle(mesh, {}, m.start);
  REQUIRE(tangle.hits.size() > 3);
  Candidates candidates;
  candidates.rebuild(mesh, m.start, 0.012);
  candidates.exempt(mesh, tangle);
  std::size_t exempt = 0;
  for (std::size_t i = 0; i < candidates.pairs().size(); ++i) exempt += candidates.is_exempt(i);
  CHECK(exempt > 0);
  for (std::size_t i = candidates.begin(PairKind::cloth_vt); i < candidates.end(PairKind::cloth_vt); ++i) {
    const Pair& pair = candidates.pairs()[i];
    bool expected = false;
    for (const EdgeHit& hit : tangle.hits)
      for (Index end : mesh.edge[hit.edge])
        for (Index c : mesh.triangle[hit.triangle])
          for (Index d : mesh.triangle[pair.b]) expected = expected || (c == d && end == pair.a);
    CHECK(candidates.is_exempt(i) == expected);
  }
  candidates.exempt(mesh, {});
  for (std::size_t i = 0; i < candidates.pairs().size(); ++i) CHECK_FALSE(candidates.is_exempt(i));
}

TEST_CASE("positions that are not numbers make no pairs", "[collision]") {
  const model::Model m = test::sheet(6, 6, 0.01);
  const std::vector<body::Body> bodies{test::ball(0.03, {0.025, -0.03, -0.025}, 6, 8)};
  const ContactMesh mesh(m, bodies);
  std::vector<Vector3d> x(m.start.size(), Vector3d::Constant(std::nan("")));
  Candidates candidates;
  candidates.rebuild(mesh, x, 0.02);
  CHECK(candidates.pairs().empty());
  x = m.start;
  x[14][1] = std::nan("");
  candidates.rebuild(mesh, x, 0.02);
  CHECK(candidates.pairs().size() > 100);
  for (const Pair& pair : candidates.pairs()) CHECK(std::isfinite(pair.distance));
}
