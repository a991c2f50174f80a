#include "runtime/modeller/modeller.hpp"

#include <catch2/catch.hpp>

#include "runtime/model/dump.hpp"
#include "runtime/model/validate.hpp"
#include "tests/unit/modeller/garments.hpp"

using namespace garment;
using test::whole;

namespace {

/// Codes and origins of what is found, "G0450@3 ".
std::string found(const design::Garment& g, const modeller::ModelOptions& options = {}) {
  modeller::ModelResult r = modeller::build_model(g, {}, options);
  std::string text;
  for (const Finding& f : r.findings) {
    CHECK_FALSE(f.message.empty());
    CHECK_FALSE(f.help.empty());
    text += f.code + "@" + std::to_string(f.labels.empty() ? 0 : f.labels[0].origin.value) + " ";
  }
  CHECK(r.model.has_value() == !has_errors(r.findings));
  return text;
}

design::Garment sheet(double w = 0.2, double l = 0.2, double h = 0.01) {
  design::Garment g = test::single(test::rectangle("sheet", w, l, h));
  g.panels[0].origin = {7};
  return g;
}

design::EdgeDart dart(double at, double width, double depth) {
  design::EdgeDart d;
  d.name = "d";
  d.origin = {9};
  d.edge = "top";
  d.at = at;
  d.width = width;
  d.depth = depth;
  return d;
}

}  // namespace

TEST_CASE("models that are built validate") {
  for (double h : {0.009, 0.02}) {
    modeller::ModelResult r = modeller::build_model(test::skirt(h), {});
    REQUIRE(r.model);
    CHECK(model::validate(*r.model).empty());
    CHECK(r.findings.empty());
  }
  for (int seed = 1; seed <= 20; ++seed) {
    modeller::ModelResult r = modeller::build_model(test::single(test::blob(seed, 0.02)), {});
    REQUIRE(r.model);
    CHECK(model::validate(*r.model).empty());
  }
}

TEST_CASE("drawing an outline the other way round changes neither area nor face") {
  design::Garment g = test::single(test::blob(4, 0.02));
  modeller::ModelResult a = modeller::build_model(g, {});
  for (design::Edge& e : g.panels[0].edges) e.curve = e.curve.reversed();
  std::reverse(g.panels[0].edges.begin(), g.panels[0].edges.end());
  modeller::ModelResult b = modeller::build_model(g, {});
  REQUIRE(a.model);
  REQUIRE(b.model);
  CHECK(a.model->panels[0].area == Approx(b.model->panels[0].area).epsilon(1e-13));
  CHECK(a.model->n_particles() == b.model->n_particles());
  for (const auto& t : b.model->triangle) {
    Eigen::Vector2d u = b.model->vertex_uv[t[1]] - b.model->vertex_uv[t[0]],
                    v = b.model->vertex_uv[t[2]] - b.model->vertex_uv[t[0]];
    REQUIRE(u.x() * v.y() - u.y() * v.x() > 0);
  }
}

TEST_CASE("outlines that cannot be cut are refused at their edge") {
  design::Garment g = sheet();
  std::swap(g.panels[0].edges[1].curve, g.panels[0].edges[2].curve);
  g.panels[0].edges[0].origin = {3};
  CHECK(found(g) == "G0454@3 ");
  g = sheet();
  g.panels[0].edges = {test::edge("a", {0, 0}, {0.3, 0.2}), test::edge("b", {0.3, 0.2}, {0.3, 0}),
                       test::edge("c", {0.3, 0}, {0, 0.3}), test::edge("d", {0, 0.3}, {0, 0})};
  g.panels[0].edges[0].origin = {4};
  CHECK(found(g) == "G0450@4 ");
  g = sheet();  // a curve that dips through the opposite edge
  g.panels[0].edges[0] = test::edge("bottom", {0, 0}, {0.2, 0}, geometry::Quadratic{{0.1, 0.5}});
  g.panels[0].edges[0].origin = {5};
  CHECK(found(g) == "G0450@5 ");
  g = sheet();
  g.panels[0].edges.clear();
  CHECK(found(g) == "G0454@7 ");
  g = sheet();
  g.panels[0].edges[2] = test::edge("top", {0.2, 0.2}, {0, NAN});
  CHECK(has_errors(modeller::build_model(g, {}).findings));
  g = sheet();  // there and back again
  g.panels[0].edges = {test::edge("a", {0, 0}, {0.3, 0}), test::edge("b", {0.3, 0}, {0, 0})};
  CHECK(found(g) == "G0454@7 ");
}

TEST_CASE("darts that do not fit are refused at the dart") {
  for (const design::EdgeDart& d :
       {dart(0.1, 0.02, 0.25), dart(0.005, 0.02, 0.05), dart(0.1, 0.02, -0.05), dart(0.1, 0, 0.05),
        dart(0.1, NAN, 0.05), dart(0.1, 0.02, NAN), dart(0.195, 0.02, 0.05)}) {
    design::Garment g = sheet();
    g.panels[0].darts = {d};
    CHECK(found(g) == "G0453@9 ");
  }
  design::Garment g = sheet();
  g.panels[0].darts = {dart(0.1, 0.02, 0.05), dart(0.11, 0.02, 0.05)};
  CHECK(found(g) == "G0453@9 ");
  g.panels[0].darts = {dart(0.1, 0.02, 0.05)};
  CHECK(found(g) == "");
  g.panels[0].darts[0].edge = "nowhere";
  CHECK(found(g) == "G0453@9 ");
  g.panels[0].darts = {dart(0.1, 0.02, 0.05)};
  g.panels[0].darts[0].apex = design::Point2(0.1, 0.3);  // outside
  CHECK(found(g) == "G0453@9 ");
}

TEST_CASE("a grid too coarse says which resolution fits, and that one does") {
  design::Garment g = sheet(0.3, 0.02, 0.03);
  modeller::ModelResult r = modeller::build_model(g, {});
  REQUIRE(r.findings.size() == 1);
  CHECK(r.findings[0].code == "G0451");
  const std::string& help = r.findings[0].help;  // "state `sheet.resolution = 9.3 mm`"
  double fits = std::stod(help.substr(help.find("= ") + 2)) / 1000;
  CHECK(found(sheet(0.3, 0.02, fits)) == "");
}

TEST_CASE("too many particles are refused before they are made") {
  CHECK(found(sheet(2, 2, 0.0002)) == "G0452@7 ");
  modeller::ModelOptions few;
  few.max_particles = 100;
  CHECK(found(sheet(), few) == "G0452@7 ");
  design::Garment g = sheet();
  g.panels[0].edges = {test::edge("a", {0, 0}, {1e9, 0}), test::edge("b", {1e9, 0}, {0, 1e9}),
                       test::edge("c", {0, 1e9}, {0, 0})};
  CHECK(found(g) == "G0452@7 ");
}

TEST_CASE("values out of range are refused") {
  for (double h : {0.0, -1.0, 1e-9, 1e9, double(NAN)}) CHECK(found(sheet(0.2, 0.2, h)) == "G0452@7 ");
  design::Garment g = sheet();
  g.panels[0].fabric = 1;
  CHECK(found(g) == "G0452@7 ");
  g = sheet();
  g.fabrics[0].areal_density = 0;
  CHECK(found(g) == "G0452@0 ");
  g = sheet();
  g.fabrics[0].tensile[1].linearity = NAN;
  CHECK(found(g) == "G0452@0 ");
  CHECK(found({}) == "G0452@0 ");
}

TEST_CASE("seams that cannot be sewn are refused at the seam") {
  auto with = [](design::Seam s) {
    design::Garment g = sheet();
    s.origin = {11};
    g.seams = {std::move(s)};
    return g;
  };
  design::Garment g = sheet();
  CHECK(found(with(test::seam("s", {whole(g, 0, 0)}, {{5, 0, 0, 1}}))) == "G0550@11 ");
  CHECK(found(with(test::seam("s", {whole(g, 0, 0)}, {{0, 9, 0, 1}}))) == "G0550@11 ");
  CHECK(found(with(test::seam("s", {whole(g, 0, 0)}, {{0, 1, 0, NAN}}))) == "G0550@11 ");
  CHECK(found(with(test::seam("s", {whole(g, 0, 0)}, {}))) == "G0550@11 ");
  CHECK(found(with(test::seam("s", {whole(g, 0, 0)}, {{0, 1, 0.1, 0.1}}))) == "G0550@11 ");
  CHECK(found(with(test::seam("s", {whole(g, 0, 0)}, {whole(g, 0, 0, true)}))) == "G0550@11 ");
  design::Seam one = test::seam("s", {whole(g, 0, 0)}, {});
  one.sides.pop_back();
  CHECK(found(with(one)) == "G0550@11 ");
}

TEST_CASE("seams that close onto a triangle are refused") {
  design::Garment g = sheet();  // a wedge so sharp that no particle stands between its legs near the point
  g.panels[0].edges = {test::edge("a", {0, 0}, {0.3, -0.03}), test::edge("b", {0.3, -0.03}, {0.3, 0.03}),
                       test::edge("c", {0.3, 0.03}, {0, 0})};
  g.seams = {test::seam("s", {whole(g, 0, 0)}, {whole(g, 0, 2, true)})};
  CHECK(found(g) == "G0551@7 ");
}

TEST_CASE("random seams never crash and never hang") {
  test::Random random(77);
  int built = 0;
  for (int run = 0; run < 200; ++run) {
    design::Garment g;
    g.fabrics = {test::cloth()};
    int n = 1 + static_cast<int>(random(0, 3));
    for (int p = 0; p < n; ++p) g.panels.push_back(test::blob(run * 4 + p, random(0.02, 0.06)));
    auto part = [&] {
      int p = static_cast<int>(random(0, n)),
          e = static_cast<int>(random(0, static_cast<double>(g.panels[p].edges.size())));
      double l = g.panels[p].edges[e].curve.length();
      return random() < 0.5 ? whole(g, p, e, random() < 0.5)
                            : design::EdgePart{p, e, random(-0.01, l), random(0, l + 0.01)};
    };
    int seams = static_cast<int>(random(0, 6));
    for (int s = 0; s < seams; ++s) {
      std::vector<design::EdgePart> a{part()}, b{part()};
      if (random() < 0.3) b.push_back(part());
      g.seams.push_back(test::seam("s", a, b));
      if (random() < 0.2) {
        g.seams.back().sides.push_back(g.seams.back().sides[0]);
        g.seams.back().sides.back().parts = {part()};
      }
    }
    modeller::ModelResult r = modeller::build_model(g, {});
    CHECK(r.model.has_value() == !has_errors(r.findings));
    if (r.model) {
      ++built;
      CHECK(model::validate(*r.model).empty());
    }
  }
  CHECK(built > 20);
}

TEST_CASE("pins hold the nearest particle, attachments the particles on their edges") {
  design::Garment g = sheet();
  g.pins.push_back({"p", {1}, 0, {0.2, 0.2}});
  g.pins.push_back({"q", {1}, 0, {0.052, 0.049}});
  modeller::ModelResult r = modeller::build_model(g, {});
  REQUIRE(r.model);
  REQUIRE(r.model->hold_particle.size() == 2);
  CHECK(r.model->hold_kind[0] == model::HoldKind::point);
  CHECK((r.model->hold_point[0] - Eigen::Vector3d(0.2, 0.2, 0)).norm() < 1e-12);
  CHECK((r.model->hold_point[1] - Eigen::Vector3d(0.05, 0.05, 0)).norm() < 1e-12);

  design::Attachment a;
  a.name = "a";
  a.origin = {12};
  a.body = "form";
  a.level = "waist";
  a.parts = {whole(g, 0, 2), {0, 1, 0.1, 0.2}};
  g.pins.clear();
  g.attachments = {a};
  CHECK(found(g) == "G0650@12 ");
  body::Body form;
  form.name = "form";
  form.levels["waist"] = {0.197, 0.7};
  r = modeller::build_model(g, {form});
  REQUIRE(r.model);
  CHECK(r.model->hold_particle.size() == 21 + 10);
  for (std::size_t k = 0; k < r.model->hold_particle.size(); ++k) {
    CHECK(r.model->hold_kind[k] == model::HoldKind::plane);
    CHECK(r.model->hold_point[k].y() == 0.197);
    CHECK(r.model->hold_normal[k] == Eigen::Vector3d(0, 1, 0));
  }
  g.attachments[0].level = "wrist";
  r = modeller::build_model(g, {form});
  CHECK_FALSE(r.model);
  g.attachments[0].slide = false;
  r = modeller::build_model(g, {form});
  REQUIRE(r.model);
  CHECK(r.model->hold_kind[0] == model::HoldKind::point);
  CHECK(r.model->hold_point[0] == r.model->start[r.model->hold_particle[0]]);
  g.attachments.clear();
  g.pins.push_back({"lost", {13}, 4, {0, 0}});
  CHECK(found(g) == "G0651@13 ");
}

TEST_CASE("the resolution of the options overrides that of the panels") {
  modeller::ModelOptions coarse;
  coarse.resolution = 0.04;
  modeller::ModelResult r = modeller::build_model(sheet(), {}, coarse);
  REQUIRE(r.model);
  CHECK(r.model->n_particles() == 36);
}

TEST_CASE("a coarse grid keeps narrow panels fine enough") {
  design::Garment g = test::single(test::rectangle("strip", 0.4, 0.03, 0.01));
  g.panels.push_back(test::rectangle("sheet", 0.4, 0.4, 0.01, {0, 0.1}));
  modeller::ModelOptions coarse;
  coarse.coarsen = 4;
  modeller::ModelResult r = modeller::build_model(g, {}, coarse);
  REQUIRE(r.model);
  CHECK(r.model->panels[1].n_vertices == 11 * 11);
  CHECK(r.model->panels[0].n_vertices > 3 * 20);
}

TEST_CASE("what is declared and cannot be modelled yet is refused at its place") {
  design::Garment g = sheet();
  design::Pad pad;
  pad.name = "outside";
  pad.origin = {8};
  pad.panel = 0;
  pad.side = design::Facing::face;
  g.pads.push_back(pad);
  CHECK(found(g) == "G0460@8 ");
}
