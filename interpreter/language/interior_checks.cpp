// The laws of a panel's inside: holes, lines, points and slits lie in its cloth.
#include "interpreter/language/outline.hpp"
#include "interpreter/language/panel_interior.hpp"
#include "interpreter/language/segments.hpp"
#include "runtime/geometry/curve_map.hpp"

namespace garment::interpreter {
namespace {

using design::Point2;

constexpr double kOnBorder = 1e-4;  // m; what lies on an edge lies this near to its segments
constexpr double kSlitEnd = 1e-3;   // m; a slit ends this far inside at least

class InteriorChecker {
 public:
  explicit InteriorChecker(Drawing& drawing)
      : drawing_(drawing),
        program_(drawing.program),
        panel_(drawing.panel),
        outline_(segments_of(drawing.panel.edges)) {}

  bool run() {
    for (std::size_t k = 0; k < panel_.holes.size(); ++k) guarded([&] { check_hole(k); });
    if (!good_) return false;  // lines and points would be held against holes that are wrong
    hole_segments_ = segments_of(panel_.hole_edges);
    for (const design::Edge& line : panel_.lines) guarded([&] { check_line(line); });
    for (const design::InteriorPoint& point : panel_.points) guarded([&] { check_point(point); });
    for (const design::Slit& slit : panel_.slits) guarded([&] { check_slit(slit); });
    return good_;
  }

 private:
  template <class F>
  void guarded(const F& run) {
    try {
      run();
    } catch (const Stop&) {
      good_ = false;
    }
  }

  Span span_of(const std::string& name) const { return drawing_.info.spans[name]; }

  std::vector<design::Edge> edges_of(const design::Hole& hole) const {
    const auto first = panel_.hole_edges.begin() + hole.first;
    return {first, first + hole.count};
  }

  void check_hole(std::size_t index) {
    const design::Hole& hole = panel_.holes[index];
    const std::vector<design::Edge> edges = edges_of(hole);
    std::vector<Span> spans;
    for (const design::Edge& edge : edges) spans.push_back(span_of(edge.name));
    check_crossings(program_, "hole `" + hole.name + "`", edges, spans);
    const std::vector<Segment> ring = segments_of(edges);
    if (const auto met = first_crossing(program_, span_of(hole.name), ring, outline_))
      fail(program_, Message("G0419",
                             "hole `" + hole.name + "` crosses edge `" + panel_.edges[met->edge_b].name + "` of `" +
                                 panel_.name + "` at " + format_point(met->at),
                             span_of(hole.name))
                         .also(span_of(panel_.edges[met->edge_b].name), "")
                         .help("a hole lies inside; what is open to the edge is drawn with the outline"));
    if (!contains(outline_, inner_point(ring), kOnBorder))
      fail(program_, Message("G0419",
                             "hole `" + hole.name + "` lies outside of `" + panel_.name + "`: at " +
                                 format_point(ring.front().a) + " there is no cloth",
                             span_of(hole.name))
                         .help("its points are coordinates of the panel, as those of the outline"));
    check_against_others(index, ring);
  }

  /// A point of the ring that is not on the outline, if there is one.
  Point2 inner_point(const std::vector<Segment>& ring) const {
    for (const Segment& s : ring)
      if (distance_to(outline_, s.a) > kOnBorder) return s.a;
    return ring.front().a;
  }

  void check_against_others(std::size_t index, const std::vector<Segment>& ring) {
    const design::Hole& hole = panel_.holes[index];
    for (std::size_t k = 0; k < index; ++k) {
      const std::vector<Segment> other = segments_of(edges_of(panel_.holes[k]));
      const auto met = first_crossing(program_, span_of(hole.name), ring, other);
      const bool within = contains(other, ring.front().a, 0) || contains(ring, other.front().a, 0);
      if (!met && !within) continue;
      fail(program_, Message("G0420",
                             "hole `" + hole.name + "` " +
                                 (met ? "crosses hole `" + panel_.holes[k].name + "` at " + format_point(met->at)
                                      : "and hole `" + panel_.holes[k].name + "` lie one in the other"),
                             span_of(hole.name))
                         .also(span_of(panel_.holes[k].name), "")
                         .help("move them apart, or draw them as one hole"));
    }
  }

  void check_line(const design::Edge& line) {
    const std::vector<Segment> segments = segments_of({without_ends(line)});
    const Span span = span_of(line.name);
    if (const auto met = first_crossing(program_, span, segments, outline_))
      fail(program_, Message("G0421",
                             "line `" + line.name + "` leaves `" + panel_.name + "` over edge `" +
                                 panel_.edges[met->edge_b].name + "` at " + format_point(met->at),
                             span)
                         .also(span_of(panel_.edges[met->edge_b].name), "")
                         .help("let it end on the edge or inside"));
    if (const auto met = first_crossing(program_, span, segments, hole_segments_))
      fail(program_, Message("G0421", "line `" + line.name + "` runs into a hole at " + format_point(met->at), span)
                         .also(span_of(panel_.hole_edges[met->edge_b].name), "")
                         .help("let it end at the hole, or lead it round"));
    for (const Segment& s : segments_of({line}))
      for (const Point2& p : {s.a, s.b}) {
        if (in_cloth(p)) continue;
        if (contains(outline_, p, kOnBorder))
          fail(program_, Message("G0421", "line `" + line.name + "` runs over a hole at " + format_point(p), span)
                             .help("let it end at the hole, or lead it round"));
        fail(program_, Message("G0421",
                               "line `" + line.name + "` lies outside of `" + panel_.name + "`: at " +
                                   format_point(p) + " there is no cloth",
                               span)
                           .help("its points are coordinates of the panel, as those of the outline"));
      }
  }

  /// The line but for its ends, which may lie on a curved edge, and so beside the segments that stand for it.
  static design::Edge without_ends(const design::Edge& line) {
    design::Edge inner = line;
    const double length = line.curve.length();
    if (length > 10 * kOnBorder) inner.curve = geometry::piece_of(line.curve, 2 * kOnBorder, length - 2 * kOnBorder);
    return inner;
  }

  bool in_cloth(const Point2& p) const {
    if (!contains(outline_, p, kOnBorder)) return false;
    return hole_segments_.empty() || !contains(hole_segments_, p, 0) || distance_to(hole_segments_, p) <= kOnBorder;
  }

  void check_point(const design::InteriorPoint& point) {
    if (in_cloth(point.point)) return;
    const double off = distance_to(outline_, point.point);
    const bool in_hole = contains(outline_, point.point, 0);
    fail(program_, Message("G0422",
                           "point `" + point.name + "` at " + format_point(point.point) +
                               (in_hole ? " lies in a hole of `" + panel_.name + "`"
                                        : " lies " + format_quantity(off, kLength) + " outside of `" + panel_.name + "`"),
                           span_of(point.name))
                       .help("a named point lies on the cloth"));
  }

  void check_slit(const design::Slit& slit) {
    const design::Edge& line = panel_.lines[static_cast<std::size_t>(slit.line)];
    for (const Point2& end : {line.curve.start(), line.curve.end()}) {
      const double room = std::min(distance_to(outline_, end), distance_to(hole_segments_, end));
      if (room >= kSlitEnd) continue;
      fail(program_, Message("G0423",
                             "slit `" + slit.name + "` ends " + format_mm(room) + " from an edge, at " +
                                 format_point(end) + "; its ends must lie 1 mm inside at least",
                             span_of(slit.name))
                         .help("a cut that is open to the edge is drawn with the outline: two edges down and up"));
    }
  }

  Drawing& drawing_;
  Program& program_;
  const design::Panel& panel_;
  std::vector<Segment> outline_, hole_segments_;
  bool good_ = true;
};

}  // namespace

bool check_interior(Drawing& drawing) { return InteriorChecker(drawing).run(); }

}  // namespace garment::interpreter
