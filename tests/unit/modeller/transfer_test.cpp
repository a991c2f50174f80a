#include "runtime/modeller/transfer.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "runtime/modeller/modeller.hpp"
#include "runtime/modeller/pattern_warp.hpp"
#include "tests/unit/modeller/built.hpp"
#include "tests/unit/modeller/garments.hpp"

using namespace garment;
using design::Point2;
using model::Vector3d;

namespace {

/// A smooth shape in space, by place in the flat pattern.
Vector3d roof(const Point2& p) { return {p.x(), p.y() - p.y() * p.y(), 0.3 * p.x() * p.x()}; }

std::vector<Vector3d> shaped(const model::Model& m) {
  std::vector<Vector3d> x(m.n_particles());
  for (std::size_t v = 0; v < m.n_vertices(); ++v) x[m.vertex_particle[v]] = roof(m.vertex_uv[v]);
  return x;
}

}  // namespace

TEST_CASE("a garment that was not changed keeps its positions bit for bit") {
  const design::Garment g = test::skirt(0.02);
  const model::Model m = test::build(g);
  std::vector<Vector3d> x = m.start;
  test::Random random(3);
  for (Vector3d& p : x) p += Vector3d(random(-0.1, 0.1), random(-0.1, 0.1), random(-0.1, 0.1));
  const modeller::Transferred t = modeller::transfer({g, m}, x, {g, m});
  CHECK(t.position == x);
  CHECK(t.n_kept == m.n_particles());
  CHECK(t.n_fresh == 0);
}

TEST_CASE("the panel that was not changed keeps its positions beside one that was") {
  const design::Garment before = test::skirt(0.02);
  design::Garment now = before;
  now.panels[0].darts[0].depth = 0.11;
  const model::Model was = test::build(before), is = test::build(now);
  const std::vector<Vector3d> x = was.start;
  const modeller::Transferred t = modeller::transfer({before, was}, x, {now, is});
  const model::PanelRange &a = was.panels[1], &b = is.panels[1];
  REQUIRE(a.n_vertices == b.n_vertices);
  std::size_t inside = 0;
  for (model::Index k = 0; k < b.n_vertices; ++k) {
    const Vector3d from = x[was.vertex_particle[a.first_vertex + k]],
                   to = t.position[is.vertex_particle[b.first_vertex + k]];
    inside += from == to ? 1 : 0;
    CHECK((from - to).norm() < 0.02);  // particles of a seam take the mean with the other panel
  }
  CHECK(inside > 0.8 * b.n_vertices);
}

TEST_CASE("a finer grid of the same panel takes the shape between the particles") {
  const design::Garment before = test::single(test::rectangle("sheet", 0.4, 0.3, 0.02));
  const design::Garment now = test::single(test::rectangle("sheet", 0.4, 0.3, 0.013));
  const model::Model was = test::build(before), is = test::build(now);
  const modeller::Transferred t = modeller::transfer({before, was}, shaped(was), {now, is});
  const std::vector<Vector3d> want = shaped(is);
  for (std::size_t i = 0; i < want.size(); ++i) CHECK((t.position[i] - want[i]).norm() < 2e-4);
}

TEST_CASE("a panel made larger keeps its shape, edge on edge") {
  const design::Garment before = test::single(test::rectangle("sheet", 0.4, 0.3, 0.02));
  const design::Garment now = test::single(test::rectangle("sheet", 0.5, 0.36, 0.02));
  const model::Model was = test::build(before), is = test::build(now);
  const modeller::Transferred t = modeller::transfer({before, was}, shaped(was), {now, is});
  for (std::size_t v = 0; v < is.n_vertices(); ++v) {
    const Point2 back(is.vertex_uv[v].x() * 0.4 / 0.5, is.vertex_uv[v].y() * 0.3 / 0.36);
    CHECK((t.position[is.vertex_particle[v]] - roof(back)).norm() < 5e-4);
  }
}

TEST_CASE("a new panel comes to where its seams hang") {
  design::Garment before = test::single(test::rectangle("sheet", 0.2, 0.2, 0.02));
  design::Garment now = before;
  now.panels.push_back(test::rectangle("frill", 0.2, 0.1, 0.02));
  now.seams = {test::seam("s", {test::whole(now, 0, 0)}, {test::whole(now, 1, 2, true)})};
  const model::Model was = test::build(before), is = test::build(now);
  std::vector<Vector3d> x = was.start;
  for (Vector3d& p : x) p += Vector3d(1, 2, 3);
  const modeller::Transferred t = modeller::transfer({before, was}, x, {now, is});
  const model::PanelRange& frill = is.panels[1];
  CHECK(t.n_fresh > 0);
  Vector3d low(1e9, 1e9, 1e9);
  for (model::Index k = 0; k < frill.n_vertices; ++k)
    low = low.cwiseMin(t.position[is.vertex_particle[frill.first_vertex + k]]);
  CHECK(low.y() > 1.7);
  CHECK(low.z() > 2.7);
}

TEST_CASE("the way back of a redrawn outline") {
  const design::Panel before = test::rectangle("p", 0.4, 0.3, 0.02),
                      now = test::rectangle("p", 0.8, 0.3, 0.02);
  const modeller::PatternWarp warp(before, now);
  CHECK_FALSE(warp.identity());
  CHECK((warp({0, 0}) - Point2(0, 0)).norm() < 1e-12);
  CHECK((warp({0.8, 0.3}) - Point2(0.4, 0.3)).norm() < 1e-12);
  CHECK((warp({0.3, 0.3}) - Point2(0.15, 0.3)).norm() < 1e-12);  // on an edge
  CHECK((warp({0.4, 0.15}) - Point2(0.2, 0.15)).norm() < 1e-9);  // linear maps come out exactly
  CHECK((warp({0.61, 0.07}) - Point2(0.305, 0.07)).norm() < 1e-9);
  CHECK(modeller::PatternWarp(before, before).identity());
  design::Panel other = now;
  other.edges[1].name = "renamed";
  CHECK(modeller::PatternWarp(before, other).identity());  // nothing to go by: material places stay
}

TEST_CASE("a line inside that was moved takes what lies about it along") {
  auto with_line = [](double height) {
    design::Panel panel = test::rectangle("p", 0.4, 0.3, 0.02);
    panel.lines.push_back(test::edge("pocket", {0.1, height}, {0.3, height}));
    return panel;
  };
  const design::Panel before = with_line(0.1), now = with_line(0.16);
  const modeller::PatternWarp warp(before, now);
  CHECK_FALSE(warp.identity());
  CHECK((warp({0.1, 0.16}) - Point2(0.1, 0.1)).norm() < 1e-9);
  CHECK((warp({0.2, 0.16}) - Point2(0.2, 0.1)).norm() < 1e-3);  // between two samples
  CHECK((warp({0.213, 0.16}) - Point2(0.213, 0.1)).norm() < 1e-3);
  CHECK((warp({0.2, 0}) - Point2(0.2, 0)).norm() < 1e-9);           // the outline stays
  CHECK((warp({0.137, 0.3}) - Point2(0.137, 0.3)).norm() < 2e-3);
  // Above and below the cloth gives way by less and less, and is not turned over.
  double last = -1;
  for (double y = 0; y <= 0.3001; y += 0.01) {
    const double there = warp({0.2, y}).y();
    CHECK(there > last);
    last = there;
  }
  CHECK(modeller::PatternWarp(before, before).identity());
}
