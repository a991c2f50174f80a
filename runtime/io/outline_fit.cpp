#include "runtime/io/outline_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "runtime/base/portable_math.hpp"

namespace garment::io {
namespace {

using design::Point2;
using geometry::cross;

constexpr double kMeet = 1e-4;                               // m; ends as near are one
constexpr double kDouble = 1e-6;                             // m; nearer points are drawn twice
constexpr double kShortest = 1.01e-4;                        // m; an edge of a script is longer
constexpr double kStraight = 2e-5;                           // m
constexpr double kMatch = 3e-4;                              // m, of a turn point and its vertex
constexpr double kCorner = 20, kSharp = 75, kUnmarked = 30;  // degrees
constexpr double kLong = 0.025;                              // m; a straight of its own within a run
constexpr double kLonger = 3;                                // times its neighbours
constexpr std::size_t kMostThrough = 64;
constexpr double kAreaAgrees = 2e-3;
constexpr std::size_t kMostPairs = 50'000'000;

DxfCourse turned(const DxfCourse& course) {
  DxfCourse out{{}, course.closed};
  const std::size_t n = course.points.size();
  for (std::size_t i = n; i-- > 0;) {
    // The arc that led here from the vertex before now leads on from here to it.
    const double bulge = i > 0 ? course.points[i - 1].bulge : course.closed ? course.points[n - 1].bulge : 0;
    out.points.push_back({course.points[i].point, -bulge});
  }
  return out;
}

/// Without points drawn twice; a loop without its repeated start.
DxfCourse cleaned(const DxfCourse& course, double apart = kDouble) {
  DxfCourse out{{}, course.closed};
  for (const DxfVertex& v : course.points) {
    if (!out.points.empty() && (out.points.back().point - v.point).norm() < apart)
      out.points.back().bulge = v.bulge;
    else
      out.points.push_back(v);
  }
  if (!out.closed && out.points.size() > 3 &&
      (out.points.front().point - out.points.back().point).norm() < kMeet) {
    out.points.pop_back();
    out.closed = true;
  }
  while (out.closed && out.points.size() > 1 &&
         (out.points.front().point - out.points.back().point).norm() < apart)
    out.points.pop_back();
  return out;
}

double segment_distance(const Point2& a, const Point2& b, const Point2& p) {
  const Point2 d = b - a;
  const double square = d.squaredNorm();
  const double t = square > 0 ? std::clamp((p - a).dot(d) / square, 0.0, 1.0) : 0;
  return (a + t * d - p).norm();
}

/// Sagitta in our sense (left of the way walked) of an arc with a bulge of the drawing's.
double sagitta(const Point2& a, const Point2& b, double bulge) { return -bulge * (b - a).norm() / 2; }

void append(std::vector<Point2>& out, const Point2& a, const Point2& b, double bulge) {
  if (bulge == 0) {
    out.push_back(b);
    return;
  }
  const std::vector<Point2> arc =
      geometry::Curve(a, b, geometry::Arc{sagitta(a, b, bulge)}).polyline(kStraight);
  out.insert(out.end(), arc.begin() + (arc.size() > 1 ? 1 : 0), arc.end());
}

/// Angle by which the way turns at b, degrees.
double turn_at(const Point2& a, const Point2& b, const Point2& c) {
  const Point2 u = b - a, v = c - b;
  return std::fabs(portable::atan2(cross(u, v), u.dot(v))) * (180 / portable::kPi);
}

/// Douglas-Peucker: the points that a polyline within kStraight needs.
void keep_needed(const std::vector<Point2>& p, std::size_t first, std::size_t last, std::vector<char>& kept) {
  std::vector<std::pair<std::size_t, std::size_t>> open{{first, last}};
  while (!open.empty()) {
    const auto [a, b] = open.back();
    open.pop_back();
    double worst = kStraight;
    std::size_t at = a;
    for (std::size_t i = a + 1; i < b; ++i)
      if (const double d = segment_distance(p[a], p[b], p[i]); d > worst) worst = d, at = i;
    if (at == a) continue;
    kept[at] = 1;
    open.push_back({a, at});
    open.push_back({at, b});
  }
}

bool is_straight(const std::vector<Point2>& p) {
  for (const Point2& q : p)
    if (segment_distance(p.front(), p.back(), q) > kStraight) return false;
  return true;
}

/// One edge through all points of a run.
geometry::Curve fitted(const std::vector<Point2>& p) {
  if (p.size() < 3 || is_straight(p)) return {p.front(), p.back()};
  std::vector<char> kept(p.size(), 1);
  if (p.size() > kMostThrough + 2) {
    std::fill(kept.begin(), kept.end(), 0);
    keep_needed(p, 0, p.size() - 1, kept);
  }
  geometry::Through through;
  for (std::size_t i = 1; i + 1 < p.size(); ++i)
    if (kept[i]) through.points.push_back(p[i]);
  return {p.front(), p.back(), std::move(through)};
}

geometry::Curve polygonal(const std::vector<Point2>& p) {
  std::vector<char> kept(p.size(), 0);
  kept.front() = kept.back() = 1;
  keep_needed(p, 0, p.size() - 1, kept);
  std::vector<geometry::Curve> links;
  Point2 from = p.front();
  for (std::size_t i = 1; i < p.size(); ++i)
    if (kept[i]) links.emplace_back(from, p[i]), from = p[i];
  return links.size() == 1 ? links.front() : geometry::chain(links);
}

class Outline {
 public:
  Outline(const DxfCourse& loop, const std::vector<Point2>& turns, const std::vector<Point2>& curves)
      : v_(loop.points), corner_(loop.points.size(), 0) {
    mark(turns, curves);
    split_long();
  }

  std::vector<design::Edge> edges(bool smooth) const {
    const std::size_t n = v_.size();
    std::size_t first = 0;
    while (first < n && !corner_[first]) ++first;
    std::vector<design::Edge> out;
    for (std::size_t from = first, walked = 0; walked < n;) {
      std::size_t steps = 1;
      while (!corner_[(from + steps) % n]) ++steps;
      design::Edge edge;
      edge.curve = run(from, steps, smooth);
      out.push_back(std::move(edge));
      from = (from + steps) % n;
      walked += steps;
    }
    return out;
  }

 private:
  const DxfVertex& at(std::size_t i) const { return v_[i % v_.size()]; }
  double length(std::size_t i) const { return (at(i + 1).point - at(i).point).norm(); }

  /// Angle of the way at vertex i, on arcs by their tangents (half the arc's angle off the chord).
  double turn(std::size_t i) const {
    const std::size_t n = v_.size();
    const DxfVertex &a = at(i + n - 1), &b = at(i), &c = at(i + 1);
    if (a.bulge == 0 && b.bulge == 0) return turn_at(a.point, b.point, c.point);
    auto end = [](const Point2& p, const Point2& q, double bulge, bool last) {
      if (bulge == 0) return Point2((q - p).normalized());
      const geometry::Curve arc(p, q, geometry::Arc{sagitta(p, q, bulge)});
      return arc.tangent_at(last ? arc.length() : 0);
    };
    const Point2 u = end(a.point, b.point, a.bulge, true), w = end(b.point, c.point, b.bulge, false);
    return std::fabs(portable::atan2(cross(u, w), u.dot(w))) * (180 / portable::kPi);
  }

  static double nearest(const std::vector<Point2>& points, const Point2& p) {
    double best = std::numeric_limits<double>::infinity();
    for (const Point2& q : points) best = std::min(best, (q - p).squaredNorm());
    return std::sqrt(best);
  }

  void mark(const std::vector<Point2>& turns, const std::vector<Point2>& curves) {
    const std::size_t n = v_.size();
    bool any = false;
    const bool few = (turns.size() + curves.size()) * n < kMostPairs;  // else the angles must do
    for (const Point2& t : few ? turns : std::vector<Point2>{}) {
      std::size_t best = n;
      double least = kMatch;
      for (std::size_t i = 0; i < n; ++i)
        if (const double d = (v_[i].point - t).norm(); d < least) least = d, best = i;
      if (best < n) corner_[best] = 1, any = true;
    }
    for (std::size_t i = 0; i < n; ++i) {
      if (corner_[i]) continue;
      const double angle = turn(i);
      const bool marked = few && angle > kCorner && nearest(curves, v_[i].point) < kMatch;
      corner_[i] = angle > (marked ? kSharp : any ? kUnmarked : kCorner);
    }
    if (std::count(corner_.begin(), corner_.end(), 1) == 0) corner_[0] = 1;
    if (std::count(corner_.begin(), corner_.end(), 1) == 1) {
      const auto only =
          static_cast<std::size_t>(std::find(corner_.begin(), corner_.end(), 1) - corner_.begin());
      corner_[(only + n / 2) % n] = 1;
    }
  }

  /// A long segment among short ones is a straight with curves beside it.
  void split_long() {
    const std::size_t n = v_.size();
    std::vector<char> more(n, 0);
    for (std::size_t i = 0; i < n; ++i) {
      if (corner_[i] && corner_[(i + 1) % n]) continue;
      const double own = length(i);
      const bool before = corner_[i] || own > kLonger * length(i + n - 1);
      const bool after = corner_[(i + 1) % n] || own > kLonger * length(i + 1);
      if (own > kLong && before && after && v_[i].bulge == 0) more[i] = more[(i + 1) % n] = 1;
    }
    for (std::size_t i = 0; i < n; ++i) corner_[i] = corner_[i] || more[i];
  }

  geometry::Curve run(std::size_t from, std::size_t steps, bool smooth) const {
    const DxfVertex &a = at(from), &b = at(from + steps);
    if (steps == 1) {
      if (a.bulge == 0) return {a.point, b.point};
      return {a.point, b.point, geometry::Arc{sagitta(a.point, b.point, a.bulge)}};
    }
    std::vector<Point2> points{a.point};
    for (std::size_t k = 0; k < steps; ++k)
      append(points, at(from + k).point, at(from + k + 1).point, at(from + k).bulge);
    return smooth ? fitted(points) : polygonal(points);
  }

  std::vector<DxfVertex> v_;
  std::vector<char> corner_;
};

}  // namespace

std::vector<DxfCourse> chained(std::vector<DxfCourse> courses, double meet, std::size_t most) {
  std::vector<DxfCourse> out, open;
  for (const DxfCourse& raw : courses) {
    DxfCourse c = cleaned(raw);
    if (c.closed || c.points.size() < 2 || open.size() >= most) {
      if (c.points.size() >= 2) out.push_back(std::move(c));
    } else {
      open.push_back(std::move(c));
    }
  }
  std::vector<char> used(open.size(), 0);
  for (std::size_t i = 0; i < open.size(); ++i) {
    if (used[i]) continue;
    used[i] = 1;
    DxfCourse way = open[i];
    for (int end = 0; end < 2; ++end) {  // on from the end, then from the start
      for (bool longer = true;
           longer &&
           !(way.points.size() > 2 && (way.points.front().point - way.points.back().point).norm() < meet);) {
        longer = false;
        const Point2 at = way.points.back().point;
        for (std::size_t k = 0; k < open.size() && !longer; ++k) {
          if (used[k]) continue;
          const bool starts = (open[k].points.front().point - at).norm() < meet;
          if (!starts && (open[k].points.back().point - at).norm() >= meet) continue;
          const DxfCourse next = starts ? open[k] : turned(open[k]);
          way.points.back().bulge = next.points.front().bulge;
          way.points.insert(way.points.end(), next.points.begin() + 1, next.points.end());
          used[k] = 1;
          longer = true;
        }
      }
      way = turned(way);
    }
    out.push_back(cleaned(way));
  }
  return out;
}

std::vector<Point2> sampled(const DxfCourse& course) {
  std::vector<Point2> out;
  if (course.points.empty()) return out;
  out.push_back(course.points[0].point);
  const std::size_t n = course.points.size();
  for (std::size_t i = 0; i + (course.closed ? 0 : 1) < n; ++i)
    append(out, course.points[i].point, course.points[(i + 1) % n].point, course.points[i].bulge);
  if (course.closed && out.size() > 1) out.pop_back();
  return out;
}

double course_area(const DxfCourse& course) {
  const std::vector<Point2> p = sampled(course);
  double area = 0;
  for (std::size_t i = 0; i < p.size(); ++i) area += cross(p[i] - p[0], p[(i + 1) % p.size()] - p[0]) / 2;
  return area;
}

std::vector<design::Edge> outline_of(DxfCourse loop, const std::vector<Point2>& turns,
                                     const std::vector<Point2>& curves) {
  loop = cleaned(loop, kShortest);
  if (loop.points.size() < 2) return {};
  double area = course_area(loop);
  if (area < 0) loop = turned(loop), area = -area;
  const Outline outline(loop, turns, curves);
  std::vector<design::Edge> edges = outline.edges(true);
  double fitted_area = 0;
  for (const design::Edge& edge : edges) fitted_area += edge.curve.area_term();
  if (std::fabs(fitted_area - area) > kAreaAgrees * area) edges = outline.edges(false);
  return edges;
}

geometry::Curve curve_of(const DxfCourse& course) {
  if (course.points.size() == 2 && !course.closed && course.points[0].bulge != 0)
    return {course.points[0].point, course.points[1].point,
            geometry::Arc{sagitta(course.points[0].point, course.points[1].point, course.points[0].bulge)}};
  std::vector<Point2> points = sampled(course);
  if (course.closed) points.push_back(points.front());
  bool corners = course.closed;
  for (std::size_t i = 1; i + 1 < points.size(); ++i)
    corners = corners || turn_at(points[i - 1], points[i], points[i + 1]) > kUnmarked;
  return corners ? polygonal(points) : fitted(points);
}

bool within(const std::vector<Point2>& polygon, const Point2& p) {
  bool in = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Point2 &a = polygon[i], &b = polygon[j];
    if ((a.y() > p.y()) != (b.y() > p.y()) &&
        p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
      in = !in;
  }
  return in;
}

double border_distance(const std::vector<Point2>& polygon, const Point2& p) {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i)
    best = std::min(best, segment_distance(polygon[i], polygon[(i + 1) % polygon.size()], p));
  return best;
}

}  // namespace garment::io
