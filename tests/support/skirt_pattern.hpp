#pragma once
// A darted skirt as declared: front and back unfolded, two side seams, notches and four darts.
#include "runtime/design/garment.hpp"

namespace garment::test {

inline design::Panel make_skirt_panel(const std::string& name, double dart_depth) {
  using design::Point2;
  const double w = 0.18, h = 0.235, flare = 0.03, length = 0.58, take = 0.025;
  design::Panel p;
  p.name = name;
  auto edge = [&](const char* edge_name, Point2 a, Point2 b,
                  geometry::Curve::Shape shape = geometry::Line{}) {
    p.edges.push_back({edge_name, {}, geometry::Curve(a, b, std::move(shape)), false});
  };
  const Point2 hem_end(h + flare, 0.01), waist_end(w + take, length + 0.01);
  edge("right.hem", {-hem_end[0], hem_end[1]}, {0, 0}, geometry::Cubic{{-0.18, 0.003}, {-0.08, 0}});
  edge("left.hem", {0, 0}, hem_end, geometry::Cubic{{0.08, 0}, {0.18, 0.003}});
  edge("left.side", hem_end, waist_end, geometry::Through{{{h, length - 0.2}}});
  edge("left.waist", waist_end, {0, length}, geometry::Cubic{{0.12, length + 0.003}, {0.06, length}});
  edge("right.waist", {0, length}, {-waist_end[0], waist_end[1]},
       geometry::Cubic{{-0.06, length}, {-0.12, length + 0.003}});
  edge("right.side", {-waist_end[0], waist_end[1]}, {-hem_end[0], hem_end[1]},
       geometry::Through{{{-h, length - 0.2}}});
  const double waist = p.edges[3].curve.length(), side = p.edges[2].curve.length();
  p.darts = {{"left.waist_dart", {}, "left.waist", 0.5 * waist, take, dart_depth, {}},
             {"right.waist_dart", {}, "right.waist", 0.5 * waist, take, dart_depth, {}}};
  p.notches = {{"left.hip", {}, "left.side", side - 0.2}, {"right.hip", {}, "right.side", 0.2}};
  p.fold_x = 0;
  return p;
}

inline design::Garment make_skirt_pattern() {
  design::Garment g;
  g.title = "darted skirt";
  g.fabrics.emplace_back();
  g.fabrics[0].name = "wool suiting";
  g.fabrics[0].color = {0.25, 0.35, 0.6};
  g.panels = {make_skirt_panel("front", 0.09), make_skirt_panel("back", 0.12)};
  const double side = g.panels[0].edges[2].curve.length();
  g.seams = {
      {"side.left", {}, {{{}, {{0, 2, 0, side}}, false}, {{}, {{1, 5, side, 0}}, false}}, {1, 1}},
      {"side.right", {}, {{{}, {{0, 5, 0, side - 0.1}}, false}, {{}, {{1, 2, side, 0.1}}, false}}, {1, 1}}};
  return g;
}

}  // namespace garment::test
