// What every mesh must be, on 300 outlines.
#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "runtime/base/parallel.hpp"
#include "runtime/modeller/modeller.hpp"
#include "tests/unit/modeller/garments.hpp"

using namespace garment;
using Eigen::Vector2d;
using design::Point2;

namespace {

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

struct Quality {
  double least_angle = 180;  ///< deg, away from corners of the outline sharper than 45 deg
  double shortest = 1e9;     ///< side, m
  bool turned_over = false;
  int euler = 0;
  std::set<int> used;
};

/// Points of the outline where it turns by more than 135 deg.
std::vector<Vector2d> sharp_corners(const design::Panel& p) {
  std::vector<Vector2d> result;
  for (std::size_t e = 0; e < p.edges.size(); ++e) {
    const geometry::Curve &next = p.edges[e].curve,
                          &last = p.edges[(e + p.edges.size() - 1) % p.edges.size()].curve;
    Vector2d out = next.tangent_at(0), back = -last.tangent_at(last.length());
    double angle = std::atan2(cross(out, back), out.dot(back)) * 57.29577951308232;
    if (angle >= 0 && angle < 45) result.push_back(next.start());
  }
  return result;
}

Quality quality_of(const model::Model& m, const design::Panel& panel) {
  Quality q;
  std::vector<Vector2d> sharp = sharp_corners(panel);
  std::set<std::array<int, 2>> sides;
  for (const auto& t : m.triangle) {
    bool at_sharp = false;
    for (int v : t)
      for (const Vector2d& s : sharp) at_sharp = at_sharp || (s - m.vertex_uv[v]).norm() < 1e-9;
    for (int k = 0; k < 3; ++k) {
      Vector2d a = m.vertex_uv[t[(k + 1) % 3]] - m.vertex_uv[t[k]],
               b = m.vertex_uv[t[(k + 2) % 3]] - m.vertex_uv[t[k]];
      q.turned_over = q.turned_over || !(cross(a, b) > 0);
      if (!at_sharp)
        q.least_angle = std::min(q.least_angle, std::atan2(cross(a, b), a.dot(b)) * 57.29577951308232);
      q.shortest = std::min(q.shortest, a.norm());
      sides.insert({std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])});
      q.used.insert(t[k]);
    }
  }
  q.euler =
      static_cast<int>(m.n_vertices()) - static_cast<int>(sides.size()) + static_cast<int>(m.n_triangles());
  return q;
}

}  // namespace

TEST_CASE("3,000 outlines of all kinds of curves give sound meshes of exact mass") {
  for (int seed = 1; seed <= 3000; ++seed) {
    double h = 0.012 + 0.003 * (seed * 7 % 10);
    design::Garment g = test::single(test::blob(seed, h));
    INFO("seed " << seed << " h " << h);
    modeller::ModelResult result = modeller::build_model(g, {});
    REQUIRE(result.model);
    const model::Model& m = *result.model;
    Quality q = quality_of(m, g.panels[0]);
    REQUIRE_FALSE(q.turned_over);
    REQUIRE(q.least_angle > 15);
    REQUIRE(q.shortest > h / 4);
    REQUIRE(q.euler == 1);
    REQUIRE(q.used.size() == m.n_vertices());
    double exact = 0, mass = 0, stencils = 0, weft = 0;
    for (const design::Edge& e : g.panels[0].edges) exact += e.curve.area_term();
    for (double x : m.mass) {
      REQUIRE(x > 0);
      mass += x;
    }
    CHECK(m.panels[0].area == Approx(exact).epsilon(1e-12));
    CHECK(mass == Approx(0.2 * exact).epsilon(1e-12));
    // warp, weft and fitted weights add up to the area
    for (std::size_t b = 0; b < m.bend.size(); b += 2) {
      stencils += m.bend_width[b] * m.bend_lengths[b].x();
      weft += m.bend_width[b + 1] * m.bend_lengths[b + 1].x();
    }
    double fits = 0;
    for (double a : m.fit_area) fits += a;
    CHECK(stencils + fits == Approx(exact).epsilon(1e-12));
    CHECK(weft == Approx(stencils).epsilon(1e-12));
  }
}

TEST_CASE("the point of a dart may lie anywhere between the grid lines") {
  for (int i = 0; i <= 10; ++i) {
    for (int j = 0; j <= 10; ++j) {
      design::Garment g = test::single(test::rectangle("sheet", 0.2, 0.2, 0.01));
      design::EdgeDart dart;
      dart.name = "dart";
      dart.edge = "top";
      dart.at = 0.1 + 0.001 * i;
      dart.width = 0.03;
      dart.depth = 0.09 + 0.001 * j;
      g.panels[0].darts = {dart};
      modeller::ModelResult r = modeller::build_model(g, {});
      REQUIRE(r.model);
      INFO("point at " << i << ", " << j << " tenths of a spacing");
      // the outline itself has angles of about 80 deg at the mouth and none sharper
      Quality q = quality_of(*r.model, g.panels[0]);
      CHECK(q.least_angle > 14);
      CHECK(q.shortest > 0.0025);
    }
  }
}

TEST_CASE("200 outlines with holes, drawn either way round, give sound meshes of exact mass") {
  for (int seed = 1; seed <= 200; ++seed) {
    const double h = 0.012 + 0.003 * (seed * 7 % 10);
    test::Random random(static_cast<std::uint64_t>(seed) + 1000);
    design::Panel panel = test::blob(seed, h);
    double exact = 0;
    for (const design::Edge& e : panel.edges) exact += e.curve.area_term();
    // Two round holes near the middle of the blob, each of two arcs: r at least a spacing, as far apart.
    const int n_holes = 1 + seed % 2;
    const double radius = std::min(0.03, 0.02 + 0.5 * h * random());
    for (int k = 0; k < n_holes; ++k) {
      const Point2 c = Point2(0.05, -0.1) + (n_holes == 1 ? Point2(0, 0) : Point2((k == 0 ? -1 : 1) * (radius + 0.75 * h), 0));
      const Point2 a = c - Point2(radius, 0), b = c + Point2(radius, 0);
      const double sagitta = random() < 0.5 ? radius : -radius;
      panel.holes.push_back({k == 0 ? "first" : "second", {}, 2 * k, 2});
      panel.hole_edges.push_back(test::edge(k == 0 ? "a" : "c", a, b, geometry::Arc{sagitta}));
      panel.hole_edges.push_back(test::edge(k == 0 ? "b" : "d", b, a, geometry::Arc{sagitta}));
      exact -= 3.14159265358979 * radius * radius;
    }
    design::Garment g = test::single(panel);
    INFO("seed " << seed << " h " << h << " radius " << radius);
    modeller::ModelResult result = modeller::build_model(g, {});
    REQUIRE(result.model);
    const model::Model& m = *result.model;
    const Quality q = quality_of(m, g.panels[0]);
    REQUIRE_FALSE(q.turned_over);
    REQUIRE(q.least_angle > 13);
    REQUIRE(q.shortest > h / 4);
    REQUIRE(q.euler == 1 - n_holes);
    REQUIRE(q.used.size() == m.n_vertices());
    double mass = 0;
    for (double x : m.mass) mass += x;
    CHECK(m.panels[0].area == Approx(exact).epsilon(1e-9));
    CHECK(mass == Approx(0.2 * exact).epsilon(1e-9));
    for (const auto& t : m.triangle) {
      const Vector2d middle = (m.vertex_uv[t[0]] + m.vertex_uv[t[1]] + m.vertex_uv[t[2]]) / 3;
      for (int k = 0; k < n_holes; ++k)
        REQUIRE((middle - 0.5 * (panel.hole_edges[2 * k].curve.start() + panel.hole_edges[2 * k].curve.end())).norm() > 0.85 * radius);
    }
  }
}

TEST_CASE("500 outlines with lines that the mesh follows give sound meshes of exact mass") {
  for (int seed = 1; seed <= 500; ++seed) {
    const double h = 0.008 + 0.002 * (seed * 7 % 10);
    design::Garment g = test::single(test::blob(seed, h));
    design::Panel& panel = g.panels[0];
    test::Random random(static_cast<std::uint64_t>(seed) + 900);
    auto inside = [&] {  // the blob holds all within 10 cm of its middle
      const double a = random(0, 6.28), r = 0.1 * std::sqrt(random());
      return Vector2d(0.05 + r * std::cos(a), -0.1 + r * std::sin(a));
    };
    const int n = 1 + seed % 3;
    for (int k = 0; k < n; ++k) {
      Vector2d from = inside(), to = inside();
      while ((to - from).norm() < 0.03) to = inside();
      if (k == 1) {  // one that reaches the border; from the middle it stays inside
        from = {0.05, -0.1};
        to = panel.edges[0].curve.point_at(0.4 * panel.edges[0].curve.length());
      }
      panel.lines.push_back(test::edge("fold", from, to));
      design::Press press;
      press.name = "crease";
      press.line = {{0, k, 0, (to - from).norm(), design::EdgePart::On::line}};
      press.angle = 1;
      g.presses.push_back(press);
    }
    INFO("seed " << seed << " h " << h);
    modeller::ModelResult result = modeller::build_model(g, {});
    if (!result.model) {  // a line along the border, nearer to it than the grid can tell apart, is refused
      CHECK(result.findings[0].code == "G0451");
      CHECK(n > 1);
      continue;
    }
    const model::Model& m = *result.model;
    const Quality q = quality_of(m, panel);
    REQUIRE_FALSE(q.turned_over);
    double exact = 0, mass = 0;
    for (const design::Edge& e : panel.edges) exact += e.curve.area_term();
    for (double x : m.mass) mass += x;
    CHECK(mass == Approx(0.2 * exact).epsilon(1e-12));
    // Sides of triangles lie along the whole of every line.
    std::set<std::pair<int, int>> sides;
    for (const auto& t : m.triangle)
      for (int k = 0; k < 3; ++k) sides.insert(std::minmax({m.vertex_particle[t[k]], m.vertex_particle[t[(k + 1) % 3]]}));
    for (const design::Edge& line : panel.lines) {
      const Vector2d a = line.curve.start(), way = (line.curve.end() - a).normalized();
      double along = 0;
      for (const auto& [i, j] : sides) {
        const Vector2d p = m.start[i].head<2>() - a, r = m.start[j].head<2>() - a;
        if (std::abs(cross(way, p)) > 1e-7 || std::abs(cross(way, r)) > 1e-7) continue;
        const double length = (line.curve.end() - a).norm();
        const double low = std::clamp(std::min(p.dot(way), r.dot(way)), 0.0, length),
                     high = std::clamp(std::max(p.dot(way), r.dot(way)), 0.0, length);
        along += high - low;
      }
      // An end may move to a particle of the border, and take its last side with it.
      CHECK(along == Approx(line.curve.length()).margin(&line == &panel.lines[0] ? 0.05 * h : 2 * h));
    }
  }
}

TEST_CASE("a dart inside and one between drawn legs close: one seam each, mass and area exact, one sheet") {
  design::Garment g = test::single(test::rectangle("sheet", 0.3, 0.4, 0.01));
  design::Panel& p = g.panels[0];
  p.edges = {test::edge("bottom", {0, 0}, {0.3, 0}),        test::edge("right", {0.3, 0}, {0.3, 0.4}),
             test::edge("top_a", {0.3, 0.4}, {0.18, 0.4}),  test::edge("leg_a", {0.18, 0.4}, {0.15, 0.28}),
             test::edge("leg_b", {0.15, 0.28}, {0.12, 0.4}), test::edge("top_b", {0.12, 0.4}, {0, 0.4}),
             test::edge("left", {0, 0.4}, {0, 0})};
  p.leg_darts = {{"drawn", {}, "leg_a", "leg_b"}};
  p.inside_darts = {{"eye", {}, {0.14, 0.04}, {0.16, 0.24}, 0.02, 0.4}};
  for (const bool turned : {false, true}) {  // the legs may be named either way round
    if (turned) std::swap(p.leg_darts[0].leg_a, p.leg_darts[0].leg_b);
    modeller::ModelResult r = modeller::build_model(g, {});
    REQUIRE(r.model);
    const model::Model& m = *r.model;
    const double length = std::hypot(0.02, 0.2), exact = 0.12 - 0.5 * 0.06 * 0.12 - 0.5 * 0.02 * length;
    CHECK(m.panels[0].area == Approx(exact).epsilon(1e-12));
    double mass = 0;
    for (double x : m.mass) mass += x;
    CHECK(mass == Approx(0.2 * exact).epsilon(1e-12));
    REQUIRE(m.seams.size() == 2);
    CHECK(m.seams[0].name == "sheet.drawn");
    CHECK(m.seams[0].length == Approx(std::hypot(0.03, 0.12)).epsilon(1e-12));
    CHECK(m.seams[1].name == "sheet.eye");
    CHECK(m.seams[1].length == Approx(std::hypot(0.4 * length, 0.01) + std::hypot(0.6 * length, 0.01)).epsilon(1e-12));
    // Of each seam all particles but its tips carry two vertices; the rest of the sheet carries one each.
    const std::size_t doubled = m.seams[0].particles.size() - 1 + m.seams[1].particles.size() - 2;
    CHECK(m.n_vertices() - m.n_particles() == doubled);
    // The sheet of particles is a disc again.
    std::set<std::array<int, 2>> sides;
    for (const auto& t : m.triangle)
      for (int k = 0; k < 3; ++k) {
        const int a = m.vertex_particle[t[k]], b = m.vertex_particle[t[(k + 1) % 3]];
        REQUIRE(a != b);
        sides.insert({std::min(a, b), std::max(a, b)});
      }
    CHECK(static_cast<int>(m.n_particles()) - static_cast<int>(sides.size()) + static_cast<int>(m.n_triangles()) == 1);
  }
}

TEST_CASE("edges far shorter than the grid draw together to a point, and the mass stays exact") {
  design::Garment g = test::single(test::rectangle("sheet", 0.2, 0.2, 0.01));
  std::vector<design::Edge>& e = g.panels[0].edges;
  e = {test::edge("bottom", {0, 0}, {0.2, 0}), test::edge("right", {0.2, 0}, {0.2, 0.2}),
       test::edge("nick", {0.2, 0.2}, {0.1992, 0.2004}), test::edge("top", {0.1992, 0.2004}, {0, 0.2}),
       test::edge("left", {0, 0.2}, {0, 0})};
  modeller::ModelResult r = modeller::build_model(g, {});
  REQUIRE(r.model);
  CHECK(quality_of(*r.model, g.panels[0]).shortest > 0.004);
  double exact = 0, mass = 0;
  for (const design::Edge& x : e) exact += x.curve.area_term();
  for (double x : r.model->mass) mass += x;
  CHECK(mass == Approx(0.2 * exact).epsilon(1e-12));
}

TEST_CASE("a rectangle along the grain is all full cells") {
  modeller::ModelResult r = modeller::build_model(test::single(test::rectangle("sheet", 0.2, 0.3, 0.01)), {});
  REQUIRE(r.model);
  CHECK(r.model->n_particles() == 21 * 31);
  CHECK(r.model->cell.size() == 600);
  CHECK(r.model->membrane.empty());
  CHECK(r.model->spring.size() == 20 * 31 + 21 * 30);
  CHECK(r.model->bend.size() == 2 * 19 * 29);
  // the extent need not be a multiple of the resolution
  r = modeller::build_model(test::single(test::rectangle("sheet", 0.2037, 0.2962, 0.01)), {});
  REQUIRE(r.model);
  CHECK(r.model->cell.size() == 600);
  CHECK(r.model->cell_size[0].x() == Approx(0.2037 / 20));
}

TEST_CASE("grain turned by right angles swaps warp and weft, and corners stay as drawn") {
  for (int quarter = -1; quarter <= 2; ++quarter) {
    design::Panel p = test::rectangle("sheet", 0.2, 0.3, 0.01);
    p.grain_angle = quarter * 1.5707963267948966;
    modeller::ModelResult r = modeller::build_model(test::single(p), {});
    REQUIRE(r.model);
    const model::Model& m = *r.model;
    REQUIRE(m.cell.size() == 600);
    Vector2d warp(-std::sin(p.grain_angle), std::cos(p.grain_angle)), weft(warp.y(), -warp.x());
    for (std::size_t c = 0; c < m.cell.size(); ++c) {
      Vector2d o = m.start[m.cell[c][0]].head<2>(), a = m.start[m.cell[c][1]].head<2>() - o,
               b = m.start[m.cell[c][3]].head<2>() - o;
      REQUIRE((a - m.cell_size[c].x() * weft).norm() < 1e-12);
      REQUIRE((b - m.cell_size[c].y() * warp).norm() < 1e-12);
    }
    for (std::size_t s = 0; s < m.spring.size(); ++s) {
      Vector2d d = (m.start[m.spring[s][1]] - m.start[m.spring[s][0]]).head<2>();
      bool along_warp = std::abs(d.dot(warp)) > std::abs(d.dot(weft));
      REQUIRE(m.spring_law[s] == (along_warp ? 0 : 1));
      REQUIRE(d.norm() == Approx(m.spring_rest[s]));
    }
  }
}

TEST_CASE("panels on the fold are mirror images to the bit, for every grid") {
  for (double h : {0.007, 0.0101, 0.02, 0.033}) {
    design::Garment g = test::skirt(h);
    modeller::ModelResult r = modeller::build_model(g, {});
    for (const Finding& f : r.findings) UNSCOPED_INFO(f.message);
    REQUIRE(r.model);
    const model::Model& m = *r.model;
    INFO("h " << h);
    for (const model::PanelRange& p : m.panels) {
      std::map<std::array<double, 2>, int> at;
      for (int v = p.first_vertex; v < p.first_vertex + p.n_vertices; ++v)
        at[{m.vertex_uv[v].x(), m.vertex_uv[v].y()}] = v;
      std::vector<int> mirror(m.n_vertices(), -1);
      for (const auto& [x, v] : at) {
        auto other = at.find({0 - x[0], x[1]});
        REQUIRE(other != at.end());
        mirror[v] = other->second;
        // mass lies on merged particles: mirror images of merged particles are merged
        REQUIRE(m.mass[m.vertex_particle[v]] == Approx(m.mass[m.vertex_particle[mirror[v]]]).epsilon(1e-12));
      }
      std::set<std::set<int>> triangles;
      for (int t = p.first_triangle; t < p.first_triangle + p.n_triangles; ++t)
        triangles.insert({m.triangle[t].begin(), m.triangle[t].end()});
      for (const auto& t : triangles) {
        std::set<int> other;
        for (int v : t) other.insert(mirror[v]);
        REQUIRE(triangles.count(other) == 1);
      }
    }
  }
}

TEST_CASE("the model does not depend on the number of threads") {
  design::Garment g = test::skirt(0.012);
  set_thread_count(1);
  modeller::ModelResult one = modeller::build_model(g, {});
  set_thread_count(4);
  modeller::ModelResult four = modeller::build_model(g, {});
  set_thread_count(2);
  REQUIRE(one.model);
  REQUIRE(four.model);
  CHECK(one.model->vertex_uv == four.model->vertex_uv);
  CHECK(one.model->mass == four.model->mass);
  CHECK(one.model->fit_weight == four.model->fit_weight);
  CHECK(one.model->triangle == four.model->triangle);
}
