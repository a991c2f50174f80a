#include "runtime/design/unfold.hpp"

#include <cmath>

#include "runtime/base/number.hpp"
#include "runtime/base/portable_math.hpp"
#include "runtime/design/unfold_interior.hpp"

namespace garment::design {
namespace {

constexpr double kStraight = 1e-6;  // m
constexpr double kSquare = 1.0;     // deg
constexpr double kBeyond = 1e-5;    // m

std::string degrees(double value) { return format_number(std::round(10 * value) / 10, 4) + " deg"; }

Finding finding(const char* code, std::string message, OriginId where, std::string label, std::string help) {
  return {code, Severity::error, std::move(message), {{where, std::move(label)}}, std::move(help)};
}

/// Angle between the fold (along y) and a tangent, 0 .. 90 deg.
double angle_to_fold(const Point2& tangent) {
  return portable::atan2(std::fabs(tangent.x()), std::fabs(tangent.y())) * 180 / portable::kPi;
}

void check_square(const Panel& half, const Edge& neighbour, bool at_its_start, Findings& findings) {
  const double s = at_its_start ? 0 : neighbour.curve.length();
  const double angle = angle_to_fold(neighbour.curve.tangent_at(s));
  if (std::fabs(angle - 90) <= kSquare) return;
  findings.push_back(finding("G0405",
                             "edge `" + neighbour.name + "` of `" + half.name + "` meets the fold at " +
                                 degrees(angle) + "; it must meet it squarely, at 90 deg",
                             neighbour.origin, degrees(angle),
                             at_its_start ? "add `tangents start +x`, or start it level with the fold's end"
                                          : "add `tangents end -x`, or end it level with the fold's start"));
}

double side_of_fold(const Panel& half, std::size_t fold_edge, double fold_x, Findings& findings) {
  double least = 0, most = 0;
  const Edge* low = nullptr;
  const Edge* high = nullptr;
  for (std::size_t k = 0; k < half.edges.size(); ++k) {
    if (k == fold_edge) continue;
    for (const Point2& p : half.edges[k].curve.polyline(1e-4)) {
      if (p.x() - fold_x < least) least = p.x() - fold_x, low = &half.edges[k];
      if (p.x() - fold_x > most) most = p.x() - fold_x, high = &half.edges[k];
    }
  }
  if (least < -kBeyond && most > kBeyond) {
    const Edge* wrong = -least < most ? low : high;
    findings.push_back(finding("G0406", "edge `" + wrong->name + "` of `" + half.name + "` crosses the fold",
                               wrong->origin, "", "a half must lie on one side of its fold"));
  }
  return most > -least ? 1 : -1;
}

/// Marks of one half; `mirror` walks the edges the other way.
void add_marks(const Panel& half, const std::string& prefix, bool mirror, double fold_x, Panel& whole) {
  auto along = [&](const std::string& edge, double at) {
    if (!mirror) return at;
    for (const Edge& e : half.edges)
      if (e.name == edge) return e.curve.length() - at;
    for (const Edge& e : half.hole_edges)
      if (e.name == edge && in_joined_hole(half, edge, fold_x)) return e.curve.length() - at;
    return at;
  };
  auto once = [&](const std::string& edge) {
    for (const Edge& line : half.lines)
      if (line.name == edge) return on_fold(line.curve, fold_x);
    return false;
  };
  for (Notch notch : half.notches) {
    if (once(notch.edge)) {
      if (!mirror) whole.notches.push_back(notch);
      continue;
    }
    notch.at = along(notch.edge, notch.at);
    notch.name = prefix + notch.name;
    notch.edge = prefix + notch.edge;
    whole.notches.push_back(notch);
  }
  for (EdgeDart dart : half.darts) {
    dart.at = along(dart.edge, dart.at);
    if (mirror && dart.apex) dart.apex = Point2(2 * fold_x - dart.apex->x(), dart.apex->y());
    dart.name = prefix + dart.name;
    dart.edge = prefix + dart.edge;
    whole.darts.push_back(dart);
  }
  for (LegDart dart : half.leg_darts) {
    dart.name = prefix + dart.name;
    dart.leg_a = prefix + dart.leg_a;
    dart.leg_b = prefix + dart.leg_b;
    whole.leg_darts.push_back(dart);
  }
  for (Pleat pleat : half.pleats) {
    if (mirror) {  // the image of the edge is walked the other way
      pleat.at = along(pleat.edge, pleat.at) - (pleat.count - 1) * pleat.spacing;
      pleat.toward = -pleat.toward;
    }
    pleat.name = prefix + pleat.name;
    pleat.edge = prefix + pleat.edge;
    whole.pleats.push_back(pleat);
  }
}

}  // namespace

UnfoldResult unfold(const Panel& half, std::size_t fold_edge, bool drawn_is_left) {
  UnfoldResult result;
  const std::size_t n = half.edges.size();
  const Edge& fold = half.edges[fold_edge];
  const double fold_x = fold.curve.start().x();
  double off = 0;
  for (const Point2& p : fold.curve.polyline(1e-5)) off = std::max(off, std::fabs(p.x() - fold_x));
  if (off > kStraight) {
    result.findings.push_back(finding("G0404",
                                      "the fold `" + fold.name + "` of `" + half.name +
                                          "` must be straight along y; it leaves that line by " +
                                          format_number(1000 * off, 3) + " mm",
                                      fold.origin, "", "draw it straight, with the same x at both ends"));
    return result;
  }
  if (n < 3) {
    result.findings.push_back(
        finding("G0404", "`" + half.name + "` needs two edges and its fold at least", fold.origin, "", ""));
    return result;
  }
  check_square(half, half.edges[(fold_edge + 1) % n], true, result.findings);
  check_square(half, half.edges[(fold_edge + n - 1) % n], false, result.findings);
  side_of_fold(half, fold_edge, fold_x, result.findings);
  if (has_errors(result.findings)) return result;

  Panel whole = half;
  whole.edges.clear();
  whole.hole_edges.clear();
  whole.holes.clear();
  whole.lines.clear();
  whole.points.clear();
  whole.slits.clear();
  whole.notches.clear();
  whole.darts.clear();
  whole.inside_darts.clear();
  whole.leg_darts.clear();
  whole.pleats.clear();
  whole.fold_x = fold_x;
  const std::string drawn = drawn_is_left ? "left." : "right.", mirrored = drawn_is_left ? "right." : "left.";
  for (std::size_t k = 1; k < n; ++k) {
    Edge edge = half.edges[(fold_edge + k) % n];
    edge.name = drawn + edge.name;
    whole.edges.push_back(edge);
  }
  for (std::size_t k = n - 1; k > 0; --k) {
    Edge edge = half.edges[(fold_edge + k) % n];
    edge.name = mirrored + edge.name;
    edge.curve = edge.curve.mirrored_x(fold_x).reversed();
    whole.edges.push_back(edge);
  }
  add_marks(half, drawn, false, fold_x, whole);
  add_marks(half, mirrored, true, fold_x, whole);
  unfold_interior(half, drawn, mirrored, fold_x, whole);
  result.panel = std::move(whole);
  return result;
}

}  // namespace garment::design
