#include "runtime/io/dxf_panel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "runtime/base/portable_math.hpp"
#include "runtime/io/outline_fit.hpp"
#include "runtime/io/pattern_names.hpp"

namespace garment::io {
namespace {

using design::Panel;

constexpr std::size_t kMostPoints = 20000;  // of one piece's outline
constexpr std::size_t kMostInside = 4096;   // lines, holes and points of one piece
constexpr double kOnFold = 5e-4;            // m
constexpr double kAtFold = 1e-6;            // m
constexpr double kSquare = 0.0436;          // sine of 2.5 degrees off the square, 5 degrees of corner
constexpr double kNotchReach = 5e-3;        // m from the outline, beside the allowance
constexpr double kNotchCorner = 5e-4;       // m; nearer to an edge's end it says nothing
constexpr double kInside = 1.5e-4;          // m; lines keep this far from the outline but for their ends
constexpr double kLeastPieceArea = 1e-6;    // m^2

/// The line through a and b, and mirroring in it.
struct Fold {
  Point2 a, along;
  double side(const Point2& p) const { return along.x() * (p.y() - a.y()) - along.y() * (p.x() - a.x()); }
  Point2 image(const Point2& p) const { return p + 2 * side(p) * Point2(along.y(), -along.x()); }
};

/// One piece of the chosen size, metres.
class PieceReader {
 public:
  PieceReader(DxfPiece piece, PatternReport& report) : piece_(std::move(piece)), report_(report) {
    where_ = fmt::format("line {}: piece {}", piece_.line, in_ticks(piece_.name));
  }

  std::optional<Panel> read() {
    if (!find_outline()) return std::nullopt;
    unfold();
    Panel panel;
    const DxfCourse& stitch = sew_ ? *sew_ : cut_;
    panel.edges =
        outline_of(stitch, piece_.points[DxfLayer::turn_points], piece_.points[DxfLayer::curve_points]);
    double area = 0;
    for (const design::Edge& edge : panel.edges) area += edge.curve.area_term();
    if (panel.edges.size() < 2 || !std::isfinite(area) || area < kLeastPieceArea) {
      skip("encloses no area");
      return std::nullopt;
    }
    for (std::size_t i = 0; i < panel.edges.size(); ++i) {
      panel.edges[i].name = fmt::format("edge_{}", i + 1);
      panel.edges[i].free = true;
      taken_.insert(panel.edges[i].name);
    }
    polygon_ = sampled(stitch);
    if (sew_) read_allowances(panel);
    read_grain(panel);
    read_notches(panel);
    read_inside(panel);
    return panel;
  }

 private:
  void skip(const std::string& why) {
    report_.warning("G0965", fmt::format("{}: its outline {}, so it is left out", where_, why),
                    "the boundary on layer 1 is one closed line, or lines that meet end to end");
  }

  /// The largest closed course of a layer, its ends up to `gap` apart; the other closed ones go into `rest`.
  std::optional<DxfCourse> largest(DxfLayer layer, double gap, std::vector<DxfCourse>* rest) {
    std::vector<DxfCourse> all = chained(piece_.courses[layer]);
    // Rounded to hundredths of an inch, ends lie a quarter of a millimetre apart.
    if (std::none_of(all.begin(), all.end(), [](const DxfCourse& c) { return c.closed; }))
      all = chained(all, 1e-3);
    std::size_t best = all.size();
    double most = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      DxfCourse& c = all[i];
      if (!c.closed && c.points.size() > 2 && (c.points.front().point - c.points.back().point).norm() <= gap)
        c.closed = true;
      if (!c.closed || c.points.size() > kMostPoints) continue;
      if (const double area = std::fabs(course_area(c)); area > most) most = area, best = i;
    }
    if (best == all.size()) return std::nullopt;
    if (rest)
      for (std::size_t i = 0; i < all.size(); ++i)
        if (i != best) rest->push_back(all[i]);
    return all[best];
  }

  bool find_outline() {
    find_fold();
    std::vector<DxfCourse> others;
    auto boundary = largest(DxfLayer::boundary, 2e-3, &others);
    if (!boundary && fold_) boundary = closed_by_fold();
    if (!boundary) boundary = largest(DxfLayer::boundary, 2e-2, &others);
    auto sew = largest(DxfLayer::sew, 1e-3, nullptr);
    if (!boundary && sew) std::swap(boundary, sew);
    if (!boundary) {
      skip(piece_.courses[DxfLayer::boundary].empty() ? "is missing" : "is not closed");
      return false;
    }
    for (DxfCourse& c : others)  // as large ones are other sizes, nested
      if (c.closed && std::fabs(course_area(c)) < 0.3 * std::fabs(course_area(*boundary)))
        piece_.courses[DxfLayer::cutout].push_back(std::move(c));
    cut_ = *boundary;
    // Stitch line and cut line come on either layer; the cloth is cut along the outer one.
    if (sew && std::fabs(course_area(*sew)) > 0.3 * std::fabs(course_area(cut_))) {
      sew_ = *sew;
      if (std::fabs(course_area(*sew_)) > std::fabs(course_area(cut_))) std::swap(*sew_, cut_);
    } else if (sew) {
      piece_.courses[DxfLayer::internal].push_back(*sew);
    }
    return true;
  }

  void find_fold() {
    for (const DxfCourse& c : piece_.courses[DxfLayer::mirror]) {
      if (c.points.size() < 2) continue;
      const Point2 d = c.points.back().point - c.points.front().point;
      if (d.norm() < 5e-3) continue;
      fold_ = Fold{c.points.front().point, d.normalized()};
      return;
    }
  }

  /// A half whose boundary is drawn from one end of the fold to the other.
  std::optional<DxfCourse> closed_by_fold() {
    for (DxfCourse c : chained(piece_.courses[DxfLayer::boundary])) {
      if (c.closed || c.points.size() < 3 || c.points.size() > kMostPoints) continue;
      if (std::fabs(fold_->side(c.points.front().point)) > 2 * kOnFold ||
          std::fabs(fold_->side(c.points.back().point)) > 2 * kOnFold)
        continue;
      c.closed = true;
      return c;
    }
    return std::nullopt;
  }

  /// The loop with its image; nothing where it is no half.
  std::optional<DxfCourse> opened(const DxfCourse& half) const {
    double low = 0, high = 0;
    const std::size_t n = half.points.size();
    std::vector<char> on(n);
    for (std::size_t i = 0; i < n; ++i) {
      const double s = fold_->side(half.points[i].point);
      low = std::min(low, s), high = std::max(high, s);
      on[i] = std::fabs(s) <= kOnFold;
    }
    if (low < -2 * kOnFold && high > 2 * kOnFold) return std::nullopt;
    std::size_t begin = n;  // the last vertex of the fold, from which the way leaves it
    for (std::size_t i = 0; i < n; ++i)
      if (on[i] && !on[(i + 1) % n] && on[(i + n - 1) % n]) begin = i;
    if (begin == n) return std::nullopt;
    DxfCourse whole{{}, true};
    std::size_t count = 0;
    do {
      whole.points.push_back(half.points[(begin + count) % n]);
    } while (!on[(begin + ++count) % n]);
    const Point2 end = half.points[(begin + count) % n].point;
    auto snapped = [&](const Point2& p) { return Point2((p + fold_->image(p)) / 2); };
    whole.points[0].point = snapped(whole.points[0].point);
    const std::size_t drawn = whole.points.size();
    whole.points.push_back({snapped(end), whole.points[drawn - 1].bulge});
    // Walked back in the mirror the sense of an arc stays: both turns of sense cancel.
    for (std::size_t k = drawn; k-- > 1;)
      whole.points.push_back({fold_->image(whole.points[k].point), whole.points[k - 1].bulge});
    return whole;
  }

  void unfold() {
    if (!fold_) return;
    auto whole = opened(cut_);
    if (!whole) return;
    cut_ = std::move(*whole);
    if (sew_) {
      if (auto stitched = opened(*sew_))
        sew_ = std::move(*stitched);
      else
        sew_.reset();
    }
    for (auto& [layer, list] : piece_.points) {
      const std::size_t n = list.size();
      for (std::size_t i = 0; i < n; ++i)
        if (std::fabs(fold_->side(list[i])) > kOnFold) list.push_back(fold_->image(list[i]));
    }
    // On the fold the way mostly goes straight on: only the angle says whether there is a corner.
    std::erase_if(piece_.points[DxfLayer::turn_points],
                  [&](const Point2& p) { return std::fabs(fold_->side(p)) <= kOnFold; });
    for (std::size_t i = 0, n = cut_.points.size(); i < n; ++i) {
      const Point2& p = cut_.points[i].point;
      const Point2 on = cut_.points[(i + 1) % n].point - p;
      // Square to the fold on one side is straight on to the other.
      if (std::fabs(fold_->side(p)) <= kAtFold && std::fabs(on.normalized().dot(fold_->along)) > kSquare)
        piece_.points[DxfLayer::turn_points].push_back(p);
    }
    for (DxfLayer layer : {DxfLayer::internal, DxfLayer::cutout, DxfLayer::drill, DxfLayer::notches}) {
      auto& list = piece_.courses[layer];
      const std::size_t n = list.size();
      for (std::size_t i = 0; i < n; ++i) {
        DxfCourse image = list[i];
        bool aside = false;
        for (DxfVertex& v : image.points) {
          aside = aside || std::fabs(fold_->side(v.point)) > kOnFold;
          v = {fold_->image(v.point), -v.bulge};
        }
        if (aside) list.push_back(std::move(image));
      }
    }
    report_.note(fmt::format("{}: drawn as a half, opened about its mirror line", in_ticks(piece_.name)));
  }

  void read_allowances(Panel& panel) const {
    const std::vector<Point2> outer = sampled(cut_);
    for (design::Edge& edge : panel.edges) {
      const double length = edge.curve.length();
      std::vector<double> widths;
      for (double at : {0.25, 0.4, 0.5, 0.6, 0.75})
        widths.push_back(border_distance(outer, edge.curve.point_at(at * length)));
      std::sort(widths.begin(), widths.end());
      const double width = std::round(widths[2] * 1e4) / 1e4;
      if (width >= 5e-4 && width <= 0.08) edge.allowance = width;
    }
  }

  void read_grain(Panel& panel) const {
    const auto found = piece_.courses.find(DxfLayer::grain);
    if (found == piece_.courses.end()) return;
    Point2 longest(0, 0);
    for (const DxfCourse& c : found->second)
      if (c.points.size() >= 2)
        if (const Point2 d = c.points.back().point - c.points.front().point; d.norm() > longest.norm() + 1e-6)
          longest = d;
    if (longest.norm() < 1e-3) return;
    if (longest.y() < -1e-9 * longest.norm() ||
        (std::fabs(longest.y()) <= 1e-9 * longest.norm() && longest.x() < 0))
      longest = -longest;
    const double angle = portable::atan2(-longest.x(), longest.y());  // from +y, counter-clockwise
    panel.grain_angle = std::fabs(angle) < 1e-6 ? 0 : angle;
  }

  void read_notches(Panel& panel) {
    std::vector<Point2> places = piece_.points[DxfLayer::notches];
    for (const DxfCourse& c : piece_.courses[DxfLayer::notches]) {
      if (c.points.empty()) continue;
      // Drawn as a stroke or a V: the end nearest to the outline is meant.
      const Point2 ends[] = {c.points.front().point, c.points.back().point};
      places.push_back(border_distance(polygon_, ends[0]) <= border_distance(polygon_, ends[1]) ? ends[0]
                                                                                                : ends[1]);
    }
    double reach = kNotchReach;
    for (const design::Edge& edge : panel.edges) reach = std::max(reach, kNotchReach + edge.allowance);
    std::size_t lost = 0;
    std::set<std::pair<std::size_t, long>> known;
    if (places.size() > kMostInside) lost = places.size() - kMostInside, places.resize(kMostInside);
    for (const Point2& p : places) {
      std::size_t best = 0;
      double at = 0, least = 1e300;
      for (std::size_t e = 0; e < panel.edges.size(); ++e) {
        const double s = panel.edges[e].curve.nearest(p), d = (panel.edges[e].curve.point_at(s) - p).norm();
        if (d < least) least = d, best = e, at = s;
      }
      const double length = panel.edges[best].curve.length();
      if (least > reach || at < kNotchCorner || at > length - kNotchCorner) {
        ++lost;
        continue;
      }
      if (!known.insert({best, std::lround(at * 2000)}).second) continue;  // drawn twice
      panel.notches.push_back({unique_name(fmt::format("notch_{}", panel.notches.size() + 1), taken_),
                               {},
                               panel.edges[best].name,
                               at});
    }
    if (lost > 0)
      report_.note(fmt::format("{}: notches at corners or off the outline are left out ({})",
                               in_ticks(piece_.name), lost));
  }

  bool lies_inside(const std::vector<Point2>& points, bool ends_may_touch) {
    if (points.size() * polygon_.size() > budget_) return false;
    budget_ -= points.size() * polygon_.size();
    for (std::size_t i = 0; i < points.size(); ++i) {
      const bool end = ends_may_touch && (i == 0 || i + 1 == points.size());
      const double off = border_distance(polygon_, points[i]);
      if (end ? off > 5e-5 && !within(polygon_, points[i]) : off < kInside || !within(polygon_, points[i]))
        return false;
    }
    return std::none_of(rings_.begin(), rings_.end(),
                        [&](const std::vector<Point2>& ring) { return touches(points, ring); });
  }

  /// True if a point lies in the ring or near it; also where that would take too long to say.
  bool touches(const std::vector<Point2>& points, const std::vector<Point2>& ring) {
    if (points.size() * ring.size() > budget_) return true;
    budget_ -= points.size() * ring.size();
    return std::any_of(points.begin(), points.end(), [&](const Point2& p) {
      return within(ring, p) || border_distance(ring, p) < kInside;
    });
  }

  /// With a point on every millimetre: what is tried by its points leaves the cloth nowhere between them by
  /// more.
  static std::vector<Point2> dense(const std::vector<Point2>& points, bool closed) {
    std::vector<Point2> out;
    for (std::size_t i = 0; i + (closed ? 0 : 1) < points.size() && out.size() < 1'000'000; ++i) {
      const Point2 &a = points[i], d = points[(i + 1) % points.size()] - a;
      const int n = std::clamp(static_cast<int>(d.norm() / 1e-3), 1, 10000);
      for (int k = 0; k < n; ++k) out.push_back(a + d * (static_cast<double>(k) / n));
    }
    if (!closed && !points.empty()) out.push_back(points.back());
    return out;
  }

  void read_inside(Panel& panel) {
    std::size_t lost = 0, taken = 0;
    for (DxfCourse c : chained(piece_.courses[DxfLayer::cutout])) {
      const std::vector<Point2> ring = dense(sampled(c), c.closed);
      const bool apart = std::none_of(rings_.begin(), rings_.end(), [&](const std::vector<Point2>& other) {
        return touches(ring, other) || touches(other, ring);
      });
      if (!c.closed || ++taken > kMostInside || !apart || !lies_inside(ring, false) ||
          std::fabs(course_area(c)) < kLeastPieceArea) {
        ++lost;
        continue;
      }
      rings_.push_back(ring);
      std::vector<design::Edge> edges = outline_of(c, {}, {});
      if (edges.size() < 2) continue;
      design::Hole hole{unique_name(fmt::format("hole_{}", panel.holes.size() + 1), taken_),
                        {},
                        static_cast<int>(panel.hole_edges.size()),
                        static_cast<int>(edges.size())};
      for (std::size_t i = 0; i < edges.size(); ++i) {
        edges[i].name = unique_name(fmt::format("{}_{}", hole.name, i + 1), taken_);
        edges[i].free = true;
        panel.hole_edges.push_back(std::move(edges[i]));
      }
      panel.holes.push_back(std::move(hole));
    }
    for (const DxfCourse& c : chained(piece_.courses[DxfLayer::internal])) {
      const geometry::Curve curve =
          ++taken > kMostInside || c.points.size() > kMostPoints ? geometry::Curve() : curve_of(c);
      if (curve.length() < 1e-3 || c.closed || !lies_inside(dense(curve.polyline(1e-4), false), true)) {
        ++lost;
        continue;
      }
      design::Edge line;
      line.name = unique_name(fmt::format("line_{}", panel.lines.size() + 1), taken_);
      line.curve = curve;
      panel.lines.push_back(std::move(line));
    }
    std::vector<Point2> drills = piece_.points[DxfLayer::drill];
    for (const DxfCourse& c : piece_.courses[DxfLayer::drill]) {
      Point2 middle(0, 0);  // of a small circle or cross
      for (const DxfVertex& v : c.points) middle += v.point / static_cast<double>(c.points.size());
      drills.push_back(middle);
    }
    for (const Point2& p : drills) {
      if (++taken > kMostInside || !lies_inside({p}, false)) {
        ++lost;
        continue;
      }
      panel.points.push_back({unique_name(fmt::format("drill_{}", panel.points.size() + 1), taken_), {}, p});
    }
    if (lost > 0)
      report_.note(
          fmt::format("{}: {} left out: closed lines, and what crosses or touches the outline or a hole",
                      in_ticks(piece_.name),
                      lost == 1 ? "1 inner line, hole or drill hole is"
                                : fmt::format("{} inner lines, holes and drill holes are", lost)));
  }

  DxfPiece piece_;
  PatternReport& report_;
  std::string where_;
  std::optional<Fold> fold_;
  DxfCourse cut_;
  std::optional<DxfCourse> sew_;
  std::vector<Point2> polygon_;             // of the stitch line
  std::vector<std::vector<Point2>> rings_;  // of the holes
  std::set<std::string> taken_;
  std::size_t budget_ = 100'000'000;
};

}  // namespace

std::optional<Panel> read_dxf_piece(DxfPiece piece, PatternReport& report) {
  return PieceReader(std::move(piece), report).read();
}

}  // namespace garment::io
