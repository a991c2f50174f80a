// Slash and spread: the panel cut along a line from edge to edge, one part moved away from the other.
//
//        moving part         n
//     ------ P' ~~~~~ Q' -----      P' = P + at_start, Q' = Q + at_end, measured across the opening
//     gap    |         |            the cut edges are joined over the gap by straight pieces
//     ------ P =====> Q ------      the line stays with the part that stays
//        staying part
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "runtime/base/number.hpp"
#include "runtime/base/portable_math.hpp"
#include "runtime/design/alter.hpp"
#include "runtime/geometry/curve_map.hpp"

namespace garment::design {
namespace {

using detail::kOnEdge;
using geometry::Curve;

constexpr double kNothing = 1e-9;  // m

/// A place on the outline.
struct Place {
  std::size_t edge = 0;
  double at = 0;
};

std::optional<Place> place_of(const Panel& panel, const Point2& p) {
  std::optional<Place> best;
  double nearest = kOnEdge;
  for (std::size_t k = 0; k < panel.edges.size(); ++k) {
    const double s = panel.edges[k].curve.nearest(p), d = (panel.edges[k].curve.point_at(s) - p).norm();
    if (d < nearest) nearest = d, best = Place{k, s};
  }
  return best;
}

std::vector<Point2> polygon_of(const std::vector<Curve>& loop) {
  std::vector<Point2> out;
  for (const Curve& curve : loop) {
    const std::vector<Point2> line = curve.polyline(1e-4);
    out.insert(out.end(), line.begin(), line.end() - 1);
  }
  return out;
}

bool contains(const std::vector<Point2>& polygon, const Point2& p) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Point2 &a = polygon[j], &b = polygon[i];
    if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
      inside = !inside;
  }
  return inside;
}

/// Angle by which the moving part turns about the end that opens less, by `b`, so that the other one opens by `a` >= b.
double opening_angle(double a, double b, double length) {
  auto excess = [&](double angle) {
    const double half = portable::sin(angle / 2);
    return 4 * length * length * half * half + 2 * b * length * portable::sin(angle) + b * b - a * a;
  };
  double low = 0, high = portable::kPi / 2;
  for (int k = 0; k < 100; ++k) {
    const double middle = 0.5 * (low + high);
    (excess(middle) < 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

class Slasher {
 public:
  Slasher(Panel& panel, const Edge& line) : panel_(panel), line_(line), p_(line.curve.start()), q_(line.curve.end()) {}

  Findings run(double at_start, double at_end, const std::string& fixed) {
    const auto start = place_of(panel_, p_), end = place_of(panel_, q_);
    if (!start || !end) return {not_from_edge_to_edge(!start ? p_ : q_)};
    start_ = *start;
    end_ = *end;
    choose_parts(fixed);
    find_motion(at_start, at_end);
    move_inside();
    if (has_errors(findings_)) return findings_;
    move_outline();
    return findings_;
  }

 private:
  Finding not_from_edge_to_edge(const Point2& p) const {
    auto mm = [](double x) { return format_number(std::round(x * 1e4) / 100, 6) + " cm"; };
    return {"G0434",
            Severity::error,
            "line `" + line_.name + "` ends at (" + mm(p.x()) + ", " + mm(p.y()) + "), inside `" + panel_.name +
                "`; a panel is slashed from edge to edge",
            {{line_.origin, ""}},
            "let the line begin and end on the outline, as in `from side.at(20 cm)`"};
  }

  /// The outline from the line's start round to its end is one part, the rest the other. Which one moves?
  void choose_parts(const std::string& fixed) {
    const std::size_t n = panel_.edges.size();
    auto after = [&](const Place& place) { return static_cast<double>(place.edge) + 1e-12 + share(place); };
    // Position of what stays, along the outline in edges.
    double stays = 0;
    for (std::size_t k = 0; k < n; ++k)
      if (panel_.edges[k].name == fixed && k != start_.edge && k != end_.edge) stays = static_cast<double>(k) + 0.5;
    const double a = after(start_), b = after(end_);
    const bool between = a < b ? stays > a && stays < b : stays > a || stays < b;
    first_ = between ? end_ : start_;  // the moving part runs from first_ to last_
    last_ = between ? start_ : end_;
    std::vector<Curve> loop = pieces(first_, last_);
    loop.push_back(between ? line_.curve : line_.curve.reversed());
    moving_ = polygon_of(loop);
  }

  double share(const Place& place) const {
    const double length = panel_.edges[place.edge].curve.length();
    return length > 0 ? place.at / length : 0;
  }

  /// The outline from one place to another, walked as drawn.
  std::vector<Curve> pieces(const Place& from, const Place& to) const {
    std::vector<Curve> out;
    const std::size_t n = panel_.edges.size();
    auto add = [&](std::size_t k, double a, double b) {
      if (b - a > kNothing) out.push_back(geometry::piece_of(panel_.edges[k].curve, a, b));
    };
    if (from.edge == to.edge && from.at < to.at) {
      add(from.edge, from.at, to.at);
      return out;
    }
    add(from.edge, from.at, panel_.edges[from.edge].curve.length());
    for (std::size_t k = (from.edge + 1) % n; k != to.edge; k = (k + 1) % n) add(k, 0, panel_.edges[k].curve.length());
    add(to.edge, 0, to.at);
    return out;
  }

  void find_motion(double at_start, double at_end) {
    const Point2 along = (q_ - p_).normalized(), left(-along.y(), along.x());
    // The moving part lies on the side of the line where its polygon is.
    const Point2 middle = line_.curve.point_at(line_.curve.length() / 2), t = line_.curve.tangent_at(line_.curve.length() / 2);
    const bool on_left = contains(moving_, middle + 1e-4 * Point2(-t.y(), t.x()));
    const Point2 away = on_left ? left : Point2(-left);
    const double more = std::max(at_start, at_end), less = std::min(at_start, at_end);
    const double angle = opening_angle(more, less, (q_ - p_).norm());
    // P opens by turning about Q: away from the line on its left is clockwise. Q about P is the other way.
    const bool about_q = at_start >= at_end;
    const double turn = on_left == about_q ? -angle : angle;
    const Point2 pivot = about_q ? q_ : p_;
    Eigen::Matrix2d rotation;
    rotation << portable::cos(turn), -portable::sin(turn), portable::sin(turn), portable::cos(turn);
    motion_ = Eigen::Isometry2d::Identity();
    motion_.linear() = rotation;
    motion_.translation() = pivot + less * away - rotation * pivot;
  }

  bool moves(const Point2& p) const { return contains(moving_, p); }

  void refuse(const std::string& what, OriginId origin) {
    findings_.push_back({"G0435",
                         Severity::error,
                         what + " lies across `" + line_.name + "`, along which `" + panel_.name + "` is slashed",
                         {{origin, ""}},
                         "lead the line round it, or move it to one side"});
  }

  /// True where the curve lies on the moving part; reports where it is on both.
  bool moves_whole(const Curve& curve, const std::string& what, OriginId origin) {
    const double length = curve.length();
    const bool middle = moves(curve.point_at(length / 2));
    for (const double share : {0.02, 0.25, 0.75, 0.98})
      if (moves(curve.point_at(share * length)) != middle) {
        refuse(what, origin);
        break;
      }
    return middle;
  }

  void move_inside() {
    for (Edge& line : panel_.lines)
      if (line.name != line_.name && moves_whole(line.curve, "line `" + line.name + "`", line.origin))
        line.curve = line.curve.transformed(motion_);
    for (const Hole& hole : panel_.holes) {
      int on = 0;
      for (int k = hole.first; k < hole.first + hole.count; ++k)
        on += moves_whole(panel_.hole_edges[static_cast<std::size_t>(k)].curve, "hole `" + hole.name + "`", hole.origin);
      if (on != 0 && on != hole.count && !has_errors(findings_)) refuse("hole `" + hole.name + "`", hole.origin);
      for (int k = hole.first; k < hole.first + hole.count && on == hole.count; ++k) {
        Curve& curve = panel_.hole_edges[static_cast<std::size_t>(k)].curve;
        curve = curve.transformed(motion_);
      }
    }
    for (InteriorPoint& point : panel_.points)
      if (moves(point.point)) point.point = motion_ * point.point;
    for (InsideDart& dart : panel_.inside_darts) {
      if (moves(dart.from) != moves(dart.to)) refuse("dart `" + dart.name + "`", dart.origin);
      if (!moves(dart.from)) continue;
      dart.from = motion_ * dart.from;
      dart.to = motion_ * dart.to;
    }
    for (EdgeDart& dart : panel_.darts) {
      const Edge* edge = nullptr;
      for (const Edge& e : panel_.edges)
        if (e.name == dart.edge) edge = &e;
      if (edge == nullptr) continue;
      const bool moved = moves_whole(geometry::piece_of(edge->curve, dart.at - dart.width / 2, dart.at + dart.width / 2),
                                     "dart `" + dart.name + "`", dart.origin);
      if (dart.apex && moved) dart.apex = motion_ * *dart.apex;
    }
  }

  void move_outline() {
    const std::size_t n = panel_.edges.size();
    const bool one_edge = first_.edge == last_.edge;
    for (std::size_t k = 0; k < n; ++k) {
      const double length = panel_.edges[k].curve.length();
      if (k == first_.edge && one_edge && first_.at < last_.at) {
        redraw(k, {{0, first_.at, false}, {first_.at, last_.at, true}, {last_.at, length, false}});
      } else if (k == first_.edge && one_edge) {
        redraw(k, {{0, last_.at, true}, {last_.at, first_.at, false}, {first_.at, length, true}});
      } else if (k == first_.edge) {
        redraw(k, {{0, first_.at, false}, {first_.at, length, true}});
      } else if (k == last_.edge) {
        redraw(k, {{0, last_.at, true}, {last_.at, length, false}});
      } else if (in_moving_run(k)) {
        redraw(k, {{0, length, true}});
      }
    }
  }

  bool in_moving_run(std::size_t k) const {
    const std::size_t n = panel_.edges.size();
    if (first_.edge == last_.edge && first_.at < last_.at) return false;
    const std::size_t steps = (k + n - first_.edge) % n, all = (last_.edge + n - first_.edge) % n;
    return steps < (all == 0 ? n : all);
  }

  struct Stretch {
    double from, to;
    bool moving;
  };

  /// The edge made of stretches of itself, some moved, joined straight.
  void redraw(std::size_t k, const std::vector<Stretch>& stretches) {
    const Curve before = panel_.edges[k].curve;
    std::vector<Curve> links;
    std::vector<std::array<double, 3>> places;  // old from, old to, new from
    double done = 0;
    auto add = [&](const Curve& link) {
      done += link.length();
      links.push_back(link);
    };
    for (const Stretch& s : stretches) {
      const Point2 at = before.point_at(s.from), start = s.moving ? Point2(motion_ * at) : at;
      if (!links.empty() && (links.back().end() - start).norm() > kNothing) add(Curve(links.back().end(), start));
      if (links.empty() && s.to - s.from <= kNothing && stretches.size() > 1) {
        pending_ = start;
        continue;
      }
      if (pending_ && links.empty() && (*pending_ - start).norm() > kNothing) add(Curve(*pending_, start));
      pending_.reset();
      places.push_back({s.from, s.to, done});
      if (s.to - s.from > kNothing) {
        const Curve part = geometry::piece_of(before, s.from, s.to);
        add(s.moving ? part.transformed(motion_) : part);
      }
    }
    auto place = [places](double s) {
      for (const auto& [from, to, at] : places)
        if (s <= to + 1e-12) return at + std::max(0.0, s - from);
      return places.empty() ? s : places.back()[2] + (places.back()[1] - places.back()[0]);
    };
    detail::redraw(panel_, panel_.edges[k], geometry::joined(links), place);
  }

  Panel& panel_;
  const Edge line_;
  Point2 p_, q_;
  Place start_, end_, first_, last_;
  std::vector<Point2> moving_;
  Eigen::Isometry2d motion_;
  std::optional<Point2> pending_;
  Findings findings_;
};

}  // namespace

Findings slash(Panel& panel, const std::string& line, double at_start, double at_end, const std::string& fixed) {
  for (const Edge& edge : panel.lines)
    if (edge.name == line) return Slasher(panel, edge).run(at_start, at_end, fixed);
  return {};
}

}  // namespace garment::design
