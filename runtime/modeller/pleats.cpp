#include "runtime/modeller/pleats.hpp"

#include <algorithm>
#include <cmath>

namespace garment::modeller {
namespace {

using design::Pleat;
using geometry::cross;

constexpr double kSamePlace = 1e-9;  // m
constexpr double kFreeFold = 0.02;   // m beyond the underlay
constexpr double kRamp = 0.02;       // m over which cloth beside a pleat comes back from the layer under it

/// A knife pleat whose outer fold looks to the edge's end (`end`) or start, lying at the back; or, as a tuck, at the
/// face - then its outer fold looks the other way.
void lay_knife(bool end, LaidPleat& p) {
  const double a = p.from, b = p.to, u = p.depth;
  if (end) {
    p.strips = {{a, a + u, true, 2 * a, 1}, {a + u, b, false, a - b, 2}};
    p.folds = {{a, p.side}, {a + u, -p.side}};
    p.layers = {{a, -1, {a, b}, a + u}};
    p.ramp = 1;
  } else {
    p.strips = {{a, a + u, false, 0, 2}, {a + u, b, true, a + b, 1}};
    p.folds = {{a + u, -p.side}, {b, p.side}};
    p.layers = {{b, 1, {b, a}, a + u}};
    p.ramp = -1;
  }
}

/// An inverted pleat, or a box pleat, which is one seen from the back.
void lay_box(LaidPleat& p) {
  const double a = p.from, b = p.to, u = p.depth;
  p.strips = {{a, a + u, true, 2 * a, 1}, {a + u, a + 3 * u, false, -2 * u, 2}, {a + 3 * u, b, true, a + b, 1}};
  p.folds = {{a, p.side}, {a + u, -p.side}, {a + 3 * u, -p.side}, {b, p.side}};
  p.layers = {{a, -1, {a, a + 2 * u}, a + u}, {b, 1, {b, a + 2 * u}, a + 3 * u}};
}

double arc_of(const LaidPleat& p, const Point2& flat) { return p.middle + (flat - p.origin).dot(p.along); }

/// Pleats whose stretch lies across the panel from that of another one, on another edge.
void find_opposites(std::vector<LaidPleat>& pleats) {
  constexpr double kParallel = 0.99;
  for (std::size_t k = 0; k < pleats.size(); ++k)
    for (std::size_t j = 0; j < k; ++j) {
      LaidPleat& p = pleats[k];
      const LaidPleat& before = pleats[j];
      const double off = std::abs(arc_of(before, p.origin) - before.middle);
      if (before.edge != p.edge && std::abs(before.along.dot(p.along)) > kParallel && off < 0.5 * std::min(before.take(), p.take()))
        p.opposite = true;
    }
}

/// Where the pleats of one edge close, and which reaches under which.
void stack(std::vector<LaidPleat>& pleats) {
  for (std::size_t k = 0; k < pleats.size(); ++k) {
    LaidPleat& p = pleats[k];
    p.sewn = p.from;
    for (const LaidPleat& other : pleats)
      if (other.edge == p.edge && other.to <= p.from + kSamePlace) p.sewn -= other.take();
    double nearest = 1e300;
    for (std::size_t j = 0; j < pleats.size(); ++j) {
      const LaidPleat& other = pleats[j];
      const double before = p.ramp * (p.from - other.from);
      if (j == k || p.ramp == 0 || other.ramp != p.ramp || other.side != p.side || other.edge != p.edge || before <= 0) continue;
      if (before < nearest) nearest = before, p.under = static_cast<int>(j);
    }
  }
}

/// How far down, in layers, the cloth beside the pleats and all that lies under it reach at the place x of the folded edge, as
/// far as pleat k and those that it reaches under go. Beyond a pleat its lowest layer comes up again.
double stacked(const std::vector<LaidPleat>& pleats, int k, double x) {
  if (k < 0) return 0;
  const LaidPleat& p = pleats[k];
  const double beyond = p.ramp * (x - p.sewn);
  if (beyond >= kRamp) return 0;
  if (beyond >= 0) return (2 + stacked(pleats, p.under, p.sewn)) * (1 - beyond / kRamp);
  return (beyond > -p.depth ? 2 : 0) + stacked(pleats, p.under, x);
}

/// How far it is from a point of the border into the cloth.
double depth_of(const design::Panel& panel, const Point2& from, const Point2& way) {
  constexpr double kHere = 1e-4;  // m
  double nearest = 1e9;
  for (const design::Edge& edge : panel.edges) {
    const std::vector<Point2> line = edge.curve.polyline(2e-5);
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      const Point2 d = line[k + 1] - line[k];
      const double det = cross(way, d);
      if (det == 0) continue;
      const double t = cross(line[k] - from, d) / det, u = cross(line[k] - from, way) / det;
      if (t > kHere && u >= 0 && u <= 1) nearest = std::min(nearest, t);
    }
  }
  return nearest;
}

/// The strip of the pleat at arc length s.
const LaidPleat::Strip* strip_at(const LaidPleat& p, double s) {
  for (const LaidPleat::Strip& strip : p.strips)
    if (s >= strip.from && s < strip.to) return &strip;
  return nullptr;
}

/// How far the cloth lies towards the face, in layers; `off` moves the place along the edges, m.
double layer_at(const std::vector<LaidPleat>& pleats, const Point2& flat, double off) {
  for (const LaidPleat& p : pleats) {
    if (p.opposite) continue;
    const double s = arc_of(p, flat) + off;
    const LaidPleat::Strip* strip = strip_at(p, s);
    if (strip == nullptr) continue;
    const double x = (strip->turned ? strip->shift - s : strip->shift + s) - p.from + p.sewn;
    return -p.side * (strip->layer + stacked(pleats, p.under, x));
  }
  double layer = 0;  // beside pleats: nearest to them on either side it still comes up
  for (int way : {1, -1}) {
    double nearest = kRamp;
    int k = -1;
    for (std::size_t j = 0; j < pleats.size(); ++j) {
      const double s = arc_of(pleats[j], flat) + off, beyond = way > 0 ? s - pleats[j].to : pleats[j].from - s;
      if (!pleats[j].opposite && pleats[j].ramp == way && beyond >= 0 && beyond < nearest) nearest = beyond, k = static_cast<int>(j);
    }
    if (k >= 0) layer -= pleats[k].side * stacked(pleats, k, pleats[k].sewn + way * nearest);
  }
  return layer;
}

}  // namespace

std::vector<LaidPleat> laid_pleats(const design::Panel& panel) {
  double area = 0;
  for (const design::Edge& edge : panel.edges) area += edge.curve.area_term();
  std::vector<LaidPleat> result;
  for (std::size_t k = 0; k < panel.pleats.size(); ++k) {
    const Pleat& pleat = panel.pleats[k];
    std::size_t e = 0;
    while (e < panel.edges.size() && panel.edges[e].name != pleat.edge) ++e;
    if (e == panel.edges.size() || !(pleat.underlay > 0)) continue;
    const geometry::Curve& curve = panel.edges[e].curve;
    for (int j = 0; j < pleat.count; ++j) {
      LaidPleat p;
      p.pleat = static_cast<int>(k);
      p.edge = static_cast<int>(e);
      p.depth = pleat.underlay;
      p.middle = pleat.at + j * pleat.spacing;
      p.from = std::max(0.0, p.middle - pleat.take() / 2);
      p.to = std::min(curve.length(), p.middle + pleat.take() / 2);
      p.origin = curve.point_at(p.middle);
      const Point2 chord = curve.point_at(p.to) - curve.point_at(p.from);
      p.along = chord.norm() > 0 ? Point2(chord.normalized()) : curve.tangent_at(p.middle);
      p.in = (area < 0 ? -1 : 1) * Point2(-p.along.y(), p.along.x());
      switch (pleat.kind) {
        case Pleat::Kind::knife:
          lay_knife(pleat.toward > 0, p);
          break;
        case Pleat::Kind::tuck:
          p.side = -1;
          lay_knife(pleat.toward < 0, p);
          break;
        case Pleat::Kind::inverted:
          lay_box(p);
          break;
        case Pleat::Kind::box:
          p.side = -1;
          lay_box(p);
          break;
      }
      result.push_back(std::move(p));
    }
  }
  find_opposites(result);
  stack(result);
  return result;
}

std::vector<InnerLine> pleat_lines(const design::Panel& panel) {
  std::vector<InnerLine> lines;
  const std::vector<LaidPleat> laid = laid_pleats(panel);
  for (std::size_t k = 0; k < laid.size(); ++k) {
    const LaidPleat& p = laid[k];
    const Pleat& pleat = panel.pleats[p.pleat];
    std::vector<std::pair<double, double>> wanted;  // arc length on the edge, length into the cloth; 0: all through it
    if (pleat.length > 0) wanted = {{p.from, pleat.length}, {p.to, pleat.length}};
    // Where it hangs free nothing says where it folds; near the edge it must fold where it starts folded.
    const double folded = pleat.ironed ? 0 : std::max(pleat.length, 2 * pleat.underlay + kFreeFold);
    for (const LaidPleat::Fold& fold : p.folds) {
      if (p.opposite) break;  // the lines of the other end are its own
      const auto known = std::find_if(wanted.begin(), wanted.end(), [&](const auto& w) { return same_place(w.first, fold.at); });
      if (known == wanted.end()) wanted.emplace_back(fold.at, folded);
      else known->second = folded;
    }
    std::sort(wanted.begin(), wanted.end());
    for (const auto& [at, length] : wanted) {
      if (at < kSamePlace || at > panel.edges[p.edge].curve.length() - kSamePlace) continue;  // the next edge runs there
      const Point2 start = panel.edges[p.edge].curve.point_at(at);
      const double room = depth_of(panel, start, p.in);
      if (room > 1e8) continue;
      InnerLine line;
      line.curve = geometry::Curve(start, Point2(start + (length > 0 ? std::min(length, room) : room) * p.in));
      line.pleat = static_cast<int>(k);
      line.at = at;
      lines.push_back(line);
    }
  }
  return lines;
}

Eigen::Vector3d fold_pleats(const std::vector<LaidPleat>& pleats, const Point2& flat, double gap) {
  Eigen::Vector3d at(flat.x(), flat.y(), 0);
  for (const LaidPleat& p : pleats) {
    if (p.opposite) continue;
    const double s = arc_of(p, flat);
    double moved = s >= p.to ? -p.take() : 0;
    if (const LaidPleat::Strip* strip = strip_at(p, s)) moved = (strip->turned ? strip->shift - s : strip->shift + s) - s;
    moved += p.take() / 2;
    at.x() += moved * p.along.x();
    at.y() += moved * p.along.y();
  }
  constexpr double kOnFold = 1e-6;  // m: what lies on a fold lies between its layers
  if (!pleats.empty()) at.z() = gap / 2 * (layer_at(pleats, flat, -kOnFold) + layer_at(pleats, flat, kOnFold));
  return at;
}

}  // namespace garment::modeller
