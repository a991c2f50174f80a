#pragma once
// Small garments for the modeller's tests.
#include <cmath>
#include <cstdint>

#include "runtime/design/garment.hpp"

namespace garment::test {

using design::Point2;

/// The same sequence everywhere.
struct Random {
  explicit Random(std::uint64_t seed) : state(seed * 0x9E3779B97F4A7C15ull + 88172645463325252ull) {
    for (int i = 0; i < 8; ++i) (*this)();
  }
  std::uint64_t state;
  double operator()() {
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return static_cast<double>(state >> 11) / 9007199254740992.0;
  }
  double operator()(double low, double high) { return low + (high - low) * (*this)(); }
};

inline double sum(const std::vector<double>& values) {
  double total = 0;
  for (double x : values) total += x;
  return total;
}

inline design::Fabric cloth() {
  design::Fabric f;
  f.name = "cloth";
  f.areal_density = 0.2;
  f.bending_rigidity = {1.3e-5, 0.7e-5};
  f.twist_rigidity = 0.5e-5;
  return f;
}

inline design::Edge edge(const char* name, Point2 a, Point2 b,
                         geometry::Curve::Shape shape = geometry::Line{}) {
  design::Edge e;
  e.name = name;
  e.curve = geometry::Curve(a, b, std::move(shape));
  return e;
}

inline design::Placement flat(double x = 0, double z = 0) {
  design::Placement p;
  p.kind = design::Placement::Kind::rigid;
  p.translation = {x, 0, z};
  return p;
}

inline design::Panel rectangle(const char* name, double w, double l, double h, Point2 at = {0, 0}) {
  design::Panel p;
  p.name = name;
  p.resolution = h;
  p.placement = flat();
  Point2 a = at, b = at + Point2(w, 0), c = at + Point2(w, l), d = at + Point2(0, l);
  p.edges = {edge("bottom", a, b), edge("right", b, c), edge("top", c, d), edge("left", d, a)};
  return p;
}

/// A wavy closed outline of 3 to 9 edges of all shapes; star-shaped, so it never crosses itself.
inline design::Panel blob(int seed, double h) {
  Random random(static_cast<std::uint64_t>(seed));
  design::Panel p;
  p.name = "blob";
  p.resolution = h;
  p.placement = flat();
  int n = 4 + static_cast<int>(random() * 6);
  std::vector<Point2> at;
  for (int i = 0; i < n; ++i) {
    double a = 6.283185307179586 * (i + random(-0.25, 0.25)) / n, r = random(0.14, 0.3);
    at.emplace_back(1.3 * r * std::cos(a) + 0.05, r * std::sin(a) - 0.1);
  }
  for (int i = 0; i < n; ++i) {
    Point2 a = at[i], b = at[(i + 1) % n], d = b - a, q(-d.y(), d.x());
    auto near = [&](double t, double s) { return Point2(a + t * d - s * q); };
    geometry::Curve::Shape shape = geometry::Line{};
    switch (static_cast<int>(random() * 5)) {
      case 1:
        shape = geometry::Quadratic{near(random(0.3, 0.7), random(-0.12, 0.3))};
        break;
      case 2:
        shape = geometry::Cubic{near(0.3, random(-0.1, 0.25)), near(0.7, random(-0.1, 0.25))};
        break;
      case 3:
        shape = geometry::Arc{-random(-0.1, 0.25) * d.norm()};
        break;
      case 4:
        shape = geometry::Through{{near(0.35, random(-0.05, 0.15)), near(0.65, random(-0.05, 0.15))}};
        break;
      default:
        break;
    }
    p.edges.push_back(edge(("e" + std::to_string(i)).c_str(), a, b, shape));
  }
  p.grain_angle = random() < 0.5 ? 0 : random(-0.8, 0.8);
  return p;
}

inline design::Garment single(design::Panel panel) {
  design::Garment g;
  g.fabrics = {cloth()};
  g.panels = {std::move(panel)};
  return g;
}

inline design::EdgePart whole(const design::Garment& g, int panel, int e, bool backwards = false) {
  double l = g.panels[panel].edges[e].curve.length();
  return backwards ? design::EdgePart{panel, e, l, 0} : design::EdgePart{panel, e, 0, l};
}

inline design::Seam seam(const char* name, std::vector<design::EdgePart> a, std::vector<design::EdgePart> b) {
  design::Seam s;
  s.name = name;
  s.sides.resize(2);
  s.sides[0].parts = std::move(a);
  s.sides[1].parts = std::move(b);
  s.ratio = {1, 1};
  return s;
}

/// Half a skirt panel, unfolded about x = 0: hem, left side, waist in two halves with a dart each, right
/// side.
inline design::Panel skirt_panel(const char* name, double h, double depth) {
  design::Panel p;
  p.name = name;
  p.resolution = h;
  p.fold_x = 0;
  double w = 0.19, hip = 0.25, hem = 0.28, length = 0.59, take = 0.025;
  Point2 m0(0, 0), m1(hem, 0.01), m2(w + take, length + 0.01), m3(0, length);
  p.edges.push_back(edge("left.hem", m0, m1, geometry::Quadratic{{hem / 2, 0}}));
  p.edges.push_back(edge("left.side", m1, m2, geometry::Through{{{hip, length - 0.2}}}));
  p.edges.push_back(edge("left.waist", m2, m3, geometry::Quadratic{{w / 2, length}}));
  for (int k = 2; k >= 0; --k) {
    design::Edge e = p.edges[k];
    e.name = "right" + e.name.substr(4);
    e.curve = e.curve.mirrored_x(0).reversed();
    p.edges.push_back(e);
  }
  double waist = p.edges[2].curve.length();
  design::EdgeDart dart;
  dart.name = "left.dart";
  dart.edge = "left.waist";
  dart.at = waist / 2;
  dart.width = take;
  dart.depth = depth;
  p.darts.push_back(dart);
  dart.name = "right.dart";
  dart.edge = "right.waist";
  p.darts.push_back(dart);
  p.placement = flat();
  return p;
}

/// Front and back, whole side seams.
inline design::Garment skirt(double h) {
  design::Garment g;
  g.fabrics = {cloth()};
  g.panels = {skirt_panel("front", h, 0.09), skirt_panel("back", h, 0.12)};
  g.panels[1].placement = flat(0, -0.3);
  g.seams = {seam("side.left", {whole(g, 0, 1)}, {whole(g, 1, 1)}),
             seam("side.right", {whole(g, 0, 4)}, {whole(g, 1, 4)})};
  return g;
}

}  // namespace garment::test
