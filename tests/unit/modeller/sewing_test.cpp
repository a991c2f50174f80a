#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "runtime/modeller/border.hpp"
#include "runtime/modeller/modeller.hpp"
#include "tests/unit/modeller/built.hpp"
#include "tests/unit/modeller/garments.hpp"

using namespace garment;
using test::build;
using test::whole;

namespace {

/// Number of free borders (closed loops of sides that only one triangle has), and Euler's characteristic.
struct Topology {
  int euler = 0, loops = 0, branching = 0;
};
Topology topology(const model::Model& m) {
  std::map<std::array<int, 2>, int> sides;
  for (std::size_t t = 0; t < m.n_triangles(); ++t) {
    auto c = m.corners(t);
    for (int k = 0; k < 3; ++k) ++sides[{std::min(c[k], c[(k + 1) % 3]), std::max(c[k], c[(k + 1) % 3])}];
  }
  Topology result;
  result.euler =
      static_cast<int>(m.n_particles()) - static_cast<int>(sides.size()) + static_cast<int>(m.n_triangles());
  std::vector<int> root(m.n_particles());
  for (std::size_t i = 0; i < root.size(); ++i) root[i] = static_cast<int>(i);
  auto find = [&](int i) {
    while (root[i] != i) i = root[i];
    return i;
  };
  std::vector<char> rim(m.n_particles(), 0);
  for (const auto& [s, n] : sides) {
    if (n > 2) ++result.branching;
    if (n != 1) continue;
    rim[s[0]] = rim[s[1]] = 1;
    root[find(s[0])] = find(s[1]);
  }
  for (std::size_t i = 0; i < root.size(); ++i) result.loops += rim[i] && root[i] == static_cast<int>(i);
  return result;
}

double total_mass(const model::Model& m) {
  double sum = 0;
  for (double x : m.mass) sum += x;
  return sum;
}

}  // namespace

TEST_CASE("a darted skirt with two side seams is one tube") {
  for (double h : {0.01, 0.02, 0.035}) {
    design::Garment g = test::skirt(h);
    model::Model m = build(g);
    Topology t = topology(m);
    CHECK(t.euler == 0);
    CHECK(t.loops == 2);
    CHECK(t.branching == 0);
    CHECK(m.seams.size() == 6);
    CHECK(m.seams[2].name == "front.left.dart");
    double declared = 0;
    for (const model::PanelRange& p : m.panels) declared += p.area;
    CHECK(total_mass(m) == Approx(0.2 * declared).epsilon(1e-12));
    // the dart's V is gone from the panel: 2.5 cm wide at a nearly straight waist, 9 cm deep
    double outline = 0;
    for (const design::Edge& e : g.panels[0].edges) outline += e.curve.area_term();
    CHECK(outline - m.panels[0].area == Approx(2 * 0.5 * 0.025 * 0.09).epsilon(0.01));
  }
}

TEST_CASE("merged particles lie at equal fractions of sewn length, darts closed") {
  // top of `a` has a dart in it: 0.3 m as drawn, 0.26 sewn; `b` is 0.26 wide
  design::Garment g;
  g.fabrics = {test::cloth()};
  g.panels = {test::rectangle("a", 0.3, 0.2, 0.01), test::rectangle("b", 0.26, 0.1, 0.013, {0, 0.5})};
  design::EdgeDart dart;
  dart.name = "dart";
  dart.edge = "top";
  dart.at = 0.1;
  dart.width = 0.04;
  dart.depth = 0.11;
  g.panels[0].darts = {dart};
  g.seams = {test::seam("s", {whole(g, 0, 2)}, {whole(g, 1, 0, true)})};
  model::Model m = build(g);
  std::map<int, double> fraction;
  int shared = 0;
  for (int v = 0; v < m.panels[0].n_vertices; ++v) {
    Eigen::Vector2d p = m.vertex_uv[v];
    if (std::abs(p.y() - 0.2) > 1e-9) continue;
    double s = 0.3 - p.x();  // the top is drawn leftwards
    double sewn = s <= 0.08 + 1e-9 ? s : s >= 0.12 - 1e-9 ? s - 0.04 : NAN;
    fraction[m.vertex_particle[v]] = sewn / 0.26;
  }
  for (int v = m.panels[1].first_vertex; v < m.panels[1].first_vertex + m.panels[1].n_vertices; ++v) {
    Eigen::Vector2d p = m.vertex_uv[v];
    if (std::abs(p.y() - 0.5) > 1e-9) continue;
    REQUIRE(fraction.count(m.vertex_particle[v]) == 1);
    CHECK(fraction[m.vertex_particle[v]] == Approx((0.26 - p.x()) / 0.26).margin(1e-9));
    ++shared;
  }
  CHECK(shared >= 20);
  CHECK(static_cast<int>(m.seams[0].particles.size()) == shared);
  CHECK(m.seams[0].length == Approx(0.26));
}

TEST_CASE("chains of several parts divide each other") {
  // the top of one wide panel to the bottoms of three narrow ones of other lengths: an eased 1:3 seam
  design::Garment g;
  g.fabrics = {test::cloth()};
  g.panels = {test::rectangle("wide", 0.5, 0.2, 0.012)};
  double x = 0, widths[3] = {0.11, 0.2, 0.16};
  std::vector<design::EdgePart> chain;
  for (int k = 0; k < 3; ++k) {
    g.panels.push_back(test::rectangle(("n" + std::to_string(k)).c_str(), widths[k], 0.15, 0.012, {x, 0.3}));
    x += widths[k];
  }
  for (int k = 0; k < 3; ++k) chain.push_back(whole(g, k + 1, 0));
  g.seams = {test::seam("yoke", {whole(g, 0, 2, true)}, chain),
             test::seam("n01", {whole(g, 1, 1)}, {whole(g, 2, 3, true)}),
             test::seam("n12", {whole(g, 2, 1)}, {whole(g, 3, 3, true)})};
  Topology t = topology(build(g));
  CHECK(t.euler == 1);
  CHECK(t.loops == 1);
  CHECK(t.branching == 0);
}

TEST_CASE("gathers, ease and very different grids merge one to one") {
  for (double ratio : {1.06, 1.8, 4.2}) {
    design::Garment g;
    g.fabrics = {test::cloth()};
    g.panels = {test::rectangle("frill", 0.2 * ratio, 0.1, 0.01),
                test::rectangle("band", 0.2, 0.08, 0.02, {0, 0.2})};
    g.seams = {test::seam("gather", {whole(g, 0, 2)}, {whole(g, 1, 0, true)})};
    model::Model m = build(g);
    Topology t = topology(m);
    INFO("ratio " << ratio);
    CHECK(t.euler == 1);
    CHECK(t.loops == 1);
    CHECK(m.seams[0].particles.size() >= 20 * ratio);
    CHECK(total_mass(m) == Approx(0.2 * (0.02 * ratio + 0.016)).epsilon(1e-12));
  }
}

TEST_CASE("three sides merge into one line, and the sheet branches there") {
  design::Garment g;
  g.fabrics = {test::cloth()};
  g.panels = {test::rectangle("a", 0.2, 0.1, 0.01), test::rectangle("b", 0.2, 0.1, 0.01),
              test::rectangle("c", 0.203, 0.1, 0.015)};
  design::Seam s = test::seam("s", {whole(g, 0, 0)}, {whole(g, 1, 0)});
  s.sides.push_back(s.sides[1]);
  s.sides[2].parts = {whole(g, 2, 0)};
  g.seams = {s};
  model::Model m = build(g);
  CHECK(topology(m).branching == static_cast<int>(m.seams[0].particles.size()) - 1);
  for (int i : m.seams[0].particles) {
    int seen = 0;
    for (int j : m.vertex_particle) seen += j == i;
    CHECK(seen == 3);
  }
}

TEST_CASE(
    "an edge of a panel sewn to another edge of it makes a tube, and its ends a ring for the next seam") {
  design::Garment g;
  g.fabrics = {test::cloth()};
  g.panels = {test::rectangle("sleeve", 0.3, 0.4, 0.013), test::rectangle("cuff", 0.2, 0.06, 0.01)};
  g.seams = {test::seam("sleeve", {whole(g, 0, 1)}, {whole(g, 0, 3, true)}),
             test::seam("cuff", {whole(g, 1, 1)}, {whole(g, 1, 3, true)}),
             test::seam("wrist", {whole(g, 0, 0)}, {whole(g, 1, 2, true)})};
  g.seams[2].sides[0].closed = g.seams[2].sides[1].closed = true;
  model::Model m = build(g);
  Topology t = topology(m);
  CHECK(t.euler == 0);
  CHECK(t.loops == 2);
  CHECK(m.seams[2].particles.front() == m.seams[2].particles.back());
}

TEST_CASE("an edge folded onto itself closes like a dart") {
  design::Garment g = test::single(test::rectangle("a", 0.3, 0.2, 0.01));
  g.seams = {test::seam("fold", {{0, 2, 0, 0.15}}, {{0, 2, 0.3, 0.15}})};
  Topology t = topology(build(g));
  CHECK(t.euler == 1);
  CHECK(t.loops == 1);
}

TEST_CASE("a disc sewn round its rim to a ring of two parts") {
  design::Garment g;
  g.fabrics = {test::cloth()};
  design::Panel disc;
  disc.name = "disc";
  disc.resolution = 0.012;
  disc.placement = test::flat();
  double r = 0.1;
  disc.edges = {test::edge("rim", {r, 0}, {-r, 0}, geometry::Arc{-r}),
                test::edge("rim2", {-r, 0}, {r, 0}, geometry::Arc{-r})};
  double round = disc.edges[0].curve.length() * 2;
  g.panels = {disc, test::rectangle("wall", round, 0.08, 0.01, {0, 0.3})};
  g.seams = {
      test::seam("side", {whole(g, 1, 1)}, {whole(g, 1, 3, true)}),
      test::seam("rim", {{0, 0, 0.05, round / 2}, {0, 1, 0, round / 2}, {0, 0, 0, 0.05}}, {whole(g, 1, 0)})};
  model::Model m = build(g);
  Topology t = topology(m);
  CHECK(t.euler == 1);
  CHECK(t.loops == 1);
  CHECK(m.panels[0].area == Approx(3.14159265358979323846 * r * r).epsilon(1e-12));
}

TEST_CASE("two panels sewn all round share no triangle") {
  design::Garment g;
  g.fabrics = {test::cloth()};
  g.panels = {test::rectangle("front", 0.2, 0.2, 0.013), test::rectangle("back", 0.2, 0.2, 0.013)};
  for (int e = 0; e < 4; ++e) g.seams.push_back(test::seam("s", {whole(g, 0, e)}, {whole(g, 1, e)}));
  model::Model m = build(g);
  CHECK(topology(m).euler == 2);
  std::set<std::set<int>> seen;
  for (std::size_t t = 0; t < m.n_triangles(); ++t) {
    auto c = m.corners(t);
    CHECK(seen.insert({c.begin(), c.end()}).second);
  }
}

TEST_CASE("seams that end a hair beside a corner end at the corner") {
  design::Garment g = test::skirt(0.02);
  g.seams[0].sides[0].parts[0].to -= 0.001;
  Topology t = topology(build(g));
  CHECK(t.euler == 0);
  CHECK(t.loops == 2);
}

TEST_CASE("border particles keep between half and one and a third of a spacing") {
  test::Random random(5);
  for (int run = 0; run < 500; ++run) {
    double length = random(1.2, 40);
    std::vector<std::array<double, 2>> candidates;
    int n = static_cast<int>(random(0, 60));
    for (int i = 0; i < n; ++i) candidates.push_back({random(), random()});
    std::vector<double> f = modeller::choose_fractions(candidates, length);
    REQUIRE(f.front() == 0);
    REQUIRE(f.back() == 1);
    for (std::size_t k = 1; k < f.size(); ++k) {
      REQUIRE((f[k] - f[k - 1]) * length > 0.5);
      REQUIRE((f[k] - f[k - 1]) * length < 1.45);
    }
  }
  CHECK(modeller::choose_fractions({{0.5, 1}}, 0.4) == std::vector<double>{0, 1});
}
