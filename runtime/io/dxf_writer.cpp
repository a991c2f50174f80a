#include "runtime/io/dxf_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "runtime/base/number.hpp"
#include "runtime/base/portable_math.hpp"
#include "runtime/io/cut_lines.hpp"
#include "runtime/io/cut_outline.hpp"
#include "runtime/io/dxf_piece.hpp"
#include "runtime/io/outline_fit.hpp"

namespace garment::io {
namespace {

using design::Panel;
using Polyline = std::vector<Point2>;

constexpr double kDxfChord = 3e-6;  // m
constexpr double kText = 8;         // mm
constexpr double kPieceGap = 30;    // mm between the pieces as inserted
constexpr double kCutCorner = 20;   // degrees, of a cut line
constexpr const char* kSize = "BASE";

/// ASCII of one line: other characters as \U+XXXX, or ? beyond the first plane.
std::string dxf_text(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size() && out.size() < 240; ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    if (c < 0x80) {
      out += c < 0x20 || c == 0x7F ? ' ' : static_cast<char>(c);
      continue;
    }
    const int more = c >= 0xF0 ? 3 : c >= 0xE0 ? 2 : c >= 0xC0 ? 1 : 0;
    unsigned code = more == 3 ? c & 7u : more == 2 ? c & 15u : c & 31u;
    for (int k = 0; k < more && i + 1 < text.size(); ++k)
      code = (code << 6) | (static_cast<unsigned char>(text[++i]) & 63u);
    out += more == 0 || code > 0xFFFF ? "?" : fmt::format("\\U+{:04X}", code);
  }
  return out;
}

class Writer {
 public:
  std::string take() { return std::move(out_); }

  void pair(int code, const std::string& value) { out_ += fmt::format("{:3}\n{}\n", code, value); }
  void number(int code, double value) { pair(code, format_number(std::round(value * 1e4) / 1e4)); }
  void whole(int code, int value) { pair(code, fmt::format("{}", value)); }
  void record(const char* type, DxfLayer layer) {
    pair(0, type);
    whole(8, static_cast<int>(layer));
  }
  void point(int code, const Point2& p) {  // m
    number(code, p.x() * 1000);
    number(code + 10, p.y() * 1000);
  }
  void text(DxfLayer layer, const Point2& at, const std::string& words) {
    record("TEXT", layer);
    point(10, at);
    number(40, kText);
    pair(1, dxf_text(words));
  }
  void mark(DxfLayer layer, const Point2& at) {
    record("POINT", layer);
    point(10, at);
  }
  void line(DxfLayer layer, const Point2& a, const Point2& b) {
    record("LINE", layer);
    point(10, a);
    point(11, b);
  }
  void polyline(DxfLayer layer, const Polyline& points, bool closed) {
    record("POLYLINE", layer);
    whole(66, 1);
    whole(70, closed ? 1 : 0);
    for (const Point2& p : points) {
      record("VERTEX", layer);
      point(10, p);
    }
    record("SEQEND", layer);
  }

 private:
  std::string out_;
};

/// A closed line as drawn, and which of its points are corners.
struct Drawn {
  Polyline points;
  std::vector<char> corner;
};

Drawn drawn(const std::vector<design::Edge>& edges) {
  Drawn out;
  for (const design::Edge& edge : edges) {
    const Polyline points = edge.curve.polyline(kDxfChord);
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      out.points.push_back(points[i]);
      out.corner.push_back(i == 0);
    }
  }
  return out;
}

Drawn drawn(const CutLine& line) {
  Drawn out;
  for (const Point2& p : line)
    if (out.points.empty() || (out.points.back() - p).norm() > 1e-7) out.points.push_back(p);
  while (out.points.size() > 1 && (out.points.front() - out.points.back()).norm() <= 1e-7)
    out.points.pop_back();
  const std::size_t n = out.points.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Point2 u = out.points[i] - out.points[(i + n - 1) % n], v = out.points[(i + 1) % n] - out.points[i];
    const double angle = portable::atan2(u.x() * v.y() - u.y() * v.x(), u.dot(v)) * (180 / portable::kPi);
    out.corner.push_back(std::fabs(angle) > kCutCorner);
  }
  return out;
}

std::vector<design::Edge> hole_edges(const Panel& panel, const design::Hole& hole) {
  const auto first = panel.hole_edges.begin() + hole.first;
  return {first, first + hole.count};
}

class PieceWriter {
 public:
  PieceWriter(const design::Garment& garment, const Panel& panel, Writer& out)
      : garment_(garment), panel_(panel), out_(out) {}

  void write() {
    const bool allowed =
        std::any_of(panel_.edges.begin(), panel_.edges.end(), [](const auto& e) { return e.allowance > 0; });
    const Drawn stitch = drawn(panel_.edges);
    boundary_ = allowed ? drawn(cut_lines(panel_).front()) : stitch;
    for (const Point2& p : boundary_.points) low_ = low_.cwiseMin(p), high_ = high_.cwiseMax(p);
    write_texts();
    out_.polyline(DxfLayer::boundary, boundary_.points, true);
    for (std::size_t i = 0; i < boundary_.points.size(); ++i)
      out_.mark(boundary_.corner[i] ? DxfLayer::turn_points : DxfLayer::curve_points, boundary_.points[i]);
    if (allowed) out_.polyline(DxfLayer::sew, stitch.points, true);
    write_notches();
    write_grain();
    for (const design::Edge& line : panel_.lines)
      out_.polyline(DxfLayer::internal, line.curve.polyline(kDxfChord), false);
    write_darts();
    for (const design::Hole& hole : panel_.holes)
      out_.polyline(DxfLayer::cutout, drawn(hole_edges(panel_, hole)).points, true);
    for (const design::InteriorPoint& point : panel_.points) out_.mark(DxfLayer::drill, point.point);
  }

  Point2 size() const { return high_ - low_; }
  Point2 low() const { return low_; }

 private:
  void write_texts() {
    Point2 at = (low_ + high_) / 2;
    auto say = [&](const std::string& words) {
      out_.text(DxfLayer::boundary, at, words);
      at.y() -= 1.5e-3 * kText;
    };
    say("Piece Name: " + panel_.name);
    say(fmt::format("Size: {}", kSize));
    say("Quantity: 1");
    if (panel_.fabric >= 0 && panel_.fabric < static_cast<int>(garment_.fabrics.size()))
      say("Fabric: " + garment_.fabrics[static_cast<std::size_t>(panel_.fabric)].name);
    if (!panel_.label.empty()) say("Annotation: " + panel_.label);
  }

  /// On the boundary: where there is an allowance, at the nearest place of the cut line.
  void write_notches() {
    for (const design::Notch& notch : panel_.notches) {
      const int edge = outline_edge(panel_, notch.edge);
      if (edge < 0) continue;
      const design::Edge& on = panel_.edges[static_cast<std::size_t>(edge)];
      Point2 p = on.curve.point_at(notch.at);
      if (on.allowance > 0) p = nearest(p);
      out_.mark(DxfLayer::notches, p);
    }
  }

  Point2 nearest(const Point2& p) const {
    Point2 best = p;
    double least = 1e300;
    const std::size_t n = boundary_.points.size();
    for (std::size_t i = 0; i < n; ++i) {
      const Point2 &a = boundary_.points[i], d = boundary_.points[(i + 1) % n] - a;
      const double t = d.squaredNorm() > 0 ? std::clamp((p - a).dot(d) / d.squaredNorm(), 0.0, 1.0) : 0;
      if (const Point2 q = a + t * d; (q - p).norm() < least) least = (q - p).norm(), best = q;
    }
    return best;
  }

  void write_grain() {
    const double a = panel_.grain_angle;
    const Point2 along(-portable::sin(a), portable::cos(a)), middle = (low_ + high_) / 2;
    const double half = 0.25 * (high_ - low_).minCoeff();
    out_.line(DxfLayer::grain, middle - half * along, middle + half * along);
  }

  void write_darts() {
    for (const design::EdgeDart& dart : panel_.darts) {
      const int edge = outline_edge(panel_, dart.edge);
      if (edge < 0) continue;
      const geometry::Curve& curve = panel_.edges[static_cast<std::size_t>(edge)].curve;
      const Point2 tip = dart_tip(panel_, dart);
      out_.polyline(DxfLayer::internal,
                    {curve.point_at(dart.at - dart.width / 2), tip, curve.point_at(dart.at + dart.width / 2)},
                    false);
      out_.mark(DxfLayer::drill, tip);
    }
    for (const design::InsideDart& dart : panel_.inside_darts) {
      const Point2 d = dart.to - dart.from, across = Point2(-d.y(), d.x()).normalized() * (dart.width / 2),
                   wide = dart.from + dart.at * d;
      out_.polyline(DxfLayer::internal, {dart.from, wide + across, dart.to, wide - across}, true);
      for (const Point2& tip : {dart.from, dart.to}) out_.mark(DxfLayer::drill, tip);
    }
  }

  const design::Garment& garment_;
  const Panel& panel_;
  Writer& out_;
  Drawn boundary_;
  Point2 low_{1e300, 1e300}, high_{-1e300, -1e300};
};

/// Letters, digits and underscores, unique, at most 31 of them as R12 has it.
std::string block_name(const std::string& name, std::set<std::string>& taken) {
  std::string base;
  for (char c : name.substr(0, 24))
    base += (c >= 'a' && c <= 'z')                             ? static_cast<char>(c - 'a' + 'A')
            : (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ? c
                                                               : '_';
  std::string candidate = base;
  for (int n = 2; !taken.insert(candidate).second; ++n) candidate = fmt::format("{}_{}", base, n);
  return candidate;
}

Findings lost(const design::Garment& garment) {
  std::string names;
  auto add = [&](const std::string& what) { names += (names.empty() ? "" : ", ") + what; };
  if (!garment.seams.empty())
    add(garment.seams.size() == 1 ? "the seam" : fmt::format("the {} seams", garment.seams.size()));
  for (const Panel& panel : garment.panels)
    if (!panel.pleats.empty()) {
      add("pleats");
      break;
    }
  if (!garment.hems.empty()) add("hems");
  if (!garment.layers.empty() || !garment.pads.empty()) add("layers and pads");
  if (!garment.buttons.empty() || !garment.zips.empty()) add("buttons and zips");
  if (names.empty()) return {};
  return {{"G0906",
           Severity::warning,
           "a DXF pattern cannot hold " + names,
           {},
           "keep the script beside it: it alone says these things"}};
}

}  // namespace

DxfText write_dxf(const design::Garment& garment) {
  Writer out;
  auto section = [&](const char* name) {
    out.pair(0, "SECTION");
    out.pair(2, name);
  };
  section("HEADER");
  out.pair(9, "$ACADVER");
  out.pair(1, "AC1009");
  out.pair(0, "ENDSEC");
  section("BLOCKS");
  struct Placed {
    std::string name;
    Point2 low, size;
  };
  std::vector<Placed> placed;
  std::set<std::string> taken;
  for (const Panel& panel : garment.panels) {
    if (panel.edges.empty()) continue;
    const std::string name = block_name(panel.name, taken);
    out.record("BLOCK", DxfLayer::boundary);
    out.pair(2, name);
    out.whole(70, 0);
    out.point(10, {0, 0});
    PieceWriter piece(garment, panel, out);
    piece.write();
    out.record("ENDBLK", DxfLayer::boundary);
    placed.push_back({name, piece.low(), piece.size()});
  }
  out.pair(0, "ENDSEC");
  section("ENTITIES");
  const std::string facts[] = {"Style Name: " + garment.title,
                               fmt::format("Sample Size: {}", kSize),
                               "Units: METRIC",
                               "Author: garment",
                               std::string("Product: garment ") + GARMENT_VERSION,
                               "Version: ASTM D6673"};
  double y = -0.02;
  for (const std::string& fact : facts) {
    out.text(DxfLayer::boundary, {0, y}, fact);
    y -= 1.5e-3 * kText;
  }
  double x = 0;
  for (const Placed& piece : placed) {
    out.record("INSERT", DxfLayer::boundary);
    out.pair(2, piece.name);
    out.point(10, Point2(x, 0) - piece.low);
    x += piece.size.x() + 1e-3 * kPieceGap;
  }
  out.pair(0, "ENDSEC");
  out.pair(0, "EOF");
  return {out.take(), lost(garment)};
}

}  // namespace garment::io
