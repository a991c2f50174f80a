#include "runtime/io/svg_import.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <pugixml.hpp>
#include <set>

#include "runtime/base/number.hpp"
#include "runtime/io/flat_layout.hpp"
#include "runtime/io/outline_fit.hpp"
#include "runtime/io/pattern_names.hpp"
#include "runtime/io/pattern_panel.hpp"
#include "runtime/io/pattern_report.hpp"
#include "runtime/io/svg_path.hpp"

namespace garment::io {
namespace {

constexpr double kInch = 0.0254, kPixel = kInch / 96;  // m
constexpr std::size_t kFlattened = 24;                 // straight pieces of what was a curve

/// Where a fault stands: the offset of the parser as a line.
std::size_t line_at(std::string_view text, std::ptrdiff_t offset) {
  const auto end =
      text.begin() + std::clamp<std::ptrdiff_t>(offset, 0, static_cast<std::ptrdiff_t>(text.size()));
  return 1 + static_cast<std::size_t>(std::count(text.begin(), end, '\n'));
}

std::string_view local_name(const pugi::xml_node& node) {
  std::string_view name = node.name();
  if (const std::size_t colon = name.find(':'); colon != std::string_view::npos)
    name.remove_prefix(colon + 1);
  return name;
}

/// Metres of a length; nothing for a percentage or what is none. A bare number is pixels.
std::optional<double> length_of(std::string_view text) {
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  std::size_t n = text.size();
  while (n > 0 && ((text[n - 1] >= 'a' && text[n - 1] <= 'z') || (text[n - 1] >= 'A' && text[n - 1] <= 'Z') ||
                   text[n - 1] == '%'))
    --n;
  const auto number = parse_number(text.substr(0, n));
  if (!number || !(*number > 0)) return std::nullopt;
  struct LengthUnit {
    const char* name;
    double metres;
  };
  constexpr LengthUnit kLengthUnits[] = {{"", kPixel},      {"px", kPixel}, {"mm", 1e-3},
                                         {"cm", 1e-2},      {"in", kInch},  {"pt", kInch / 72},
                                         {"pc", kInch / 6}, {"Q", 2.5e-4},  {"m", 1}};
  for (const LengthUnit& u : kLengthUnits)
    if (text.substr(n) == u.name) return *number * u.metres;
  return std::nullopt;
}

struct SvgShape {
  std::string name;
  std::vector<SvgRun> runs;        ///< closed, m, y up
  std::vector<std::string> edges;  ///< names, of our own drawings
  std::vector<int> counts;         ///< curves of each edge
};

class SvgReader {
 public:
  explicit SvgReader(const SvgOptions& options) : options_(options) {}

  SvgResult read(std::string_view bytes) {
    SvgResult result;
    result.garment = document(bytes);
    if (report_.errors() > 0) result.garment.reset();
    result.findings = report_.take_findings();
    result.notes = report_.take_notes();
    return result;
  }

 private:
  std::optional<design::Garment> document(std::string_view bytes) {
    if (bytes.size() > options_.limits.max_bytes) {
      report_.error("G0974",
                    fmt::format("the drawing has {} bytes, at most {} are read", bytes.size(),
                                options_.limits.max_bytes),
                    "is this the right file?");
      return std::nullopt;
    }
    pugi::xml_document xml;
    const pugi::xml_parse_result parsed = xml.load_buffer(bytes.data(), bytes.size());
    if (!parsed) {
      report_.error(
          "G0970", fmt::format("not XML at line {}: {}", line_at(bytes, parsed.offset), parsed.description()),
          "save the drawing as plain SVG, not compressed");
      return std::nullopt;
    }
    const pugi::xml_node root = xml.document_element();
    if (local_name(root) != "svg") {
      report_.error("G0970", fmt::format("the document is {}, expected <svg>", in_ticks(root.name())),
                    "save the drawing as plain SVG");
      return std::nullopt;
    }
    const SvgMotion page = page_motion(root);
    own_ = has_courses(root, 0);
    walk(root, page, "", 0);
    if (report_.errors() > 0) return std::nullopt;
    return garment_of();
  }

  /// User units to metres, y up.
  SvgMotion page_motion(const pugi::xml_node& root) {
    const auto width = length_of(root.attribute("width").value()),
               height = length_of(root.attribute("height").value());
    const std::vector<double> box = svg_numbers(root.attribute("viewBox").value(), 4);
    double scale = kPixel;
    if (box.size() == 4 && box[2] > 0 && box[3] > 0) {
      if (width && height)
        scale = std::min(*width / box[2], *height / box[3]);
      else if (width)
        scale = *width / box[2];
      else if (height)
        scale = *height / box[3];
      page_ = {box[2], box[3]};
    } else if (width && height) {
      page_ = {*width / kPixel, *height / kPixel};
    }
    if (!width && !height)
      report_.warning(
          "G0972",
          fmt::format("`width` of the drawing is {}, expected a length as `210mm`; a unit is taken as a "
                      "pixel, 1/96 inch",
                      root.attribute("width") ? in_ticks(root.attribute("width").value()) : "missing"),
          "state width, height and viewBox; check the size of a panel");
    else
      report_.note(fmt::format("a unit of the drawing is {} mm", format_number(scale * 1e3, 6)));
    SvgMotion motion;
    motion.linear << scale, 0, 0, -scale;
    return motion;
  }

  static bool is_shown(const pugi::xml_node& node) {
    if (std::strcmp(node.attribute("display").value(), "none") == 0) return false;
    return std::string_view(node.attribute("style").value()).find("display:none") == std::string_view::npos;
  }

  /// A drawing of ours says what its outlines are; all else on the paper is explanation.
  bool has_courses(const pugi::xml_node& node, int depth) const {
    if (node.attribute("data-course")) return true;
    if (depth < options_.limits.max_depth)
      for (const pugi::xml_node& child : node.children())
        if (has_courses(child, depth + 1)) return true;
    return false;
  }

  void walk(const pugi::xml_node& parent, const SvgMotion& motion, const std::string& group, int depth) {
    if (depth > options_.limits.max_depth) {
      report_.error("G0974", fmt::format("groups are nested more than {} deep", options_.limits.max_depth),
                    "ungroup some of them");
      return;
    }
    for (const pugi::xml_node& node : parent.children()) {
      if (report_.errors() > 0) return;
      const std::string_view kind = local_name(node);
      if (node.type() != pugi::node_element || !is_shown(node)) continue;
      SvgMotion here = motion;
      if (const pugi::xml_attribute transform = node.attribute("transform")) {
        const auto own = svg_transform(transform.value());
        if (!own) {
          report_.warning("G0971",
                          fmt::format("{}: its transform {} is none, it is left out", called(node, group),
                                      in_ticks(transform.value())),
                          "known are matrix, translate, scale, rotate, skewX and skewY");
          continue;
        }
        here = motion * *own;
      }
      if (kind == "g" || kind == "svg" || kind == "a" || kind == "switch") {
        const std::string own = name_of(node);
        walk(node, here, own.empty() ? group : own, depth + 1);
      } else {
        shape(node, kind, here, group);
      }
    }
  }

  static std::string name_of(const pugi::xml_node& node) {
    for (const char* key : {"inkscape:label", "id"})
      if (const char* value = node.attribute(key).value(); *value != 0) return value;
    return {};
  }

  static std::string called(const pugi::xml_node& node, const std::string& group) {
    const std::string own = name_of(node);
    return own.empty() ? group.empty() ? std::string(node.name()) : "a shape in " + in_ticks(group)
                       : in_ticks(own);
  }

  void shape(const pugi::xml_node& node, std::string_view kind, const SvgMotion& motion,
             const std::string& group) {
    std::vector<SvgRun> runs;
    auto value = [&](const char* key) {
      const std::vector<double> list = svg_numbers(node.attribute(key).value(), 1);
      return list.empty() ? 0 : list[0];
    };
    if (own_ && !node.attribute("data-course")) return;
    if (kind == "path") {
      bool good = true;
      runs = svg_path(node.attribute(own_ ? "data-course" : "d").value(), options_.limits.max_curves, good);
      if (!good)
        report_.warning("G0971",
                        fmt::format("{}: its path data are read up to the first fault", called(node, group)),
                        "write the path again");
    } else if (kind == "polygon" || kind == "polyline") {
      const std::vector<double> list =
          svg_numbers(node.attribute("points").value(), 2 * options_.limits.max_curves);
      SvgRun run{{}, kind == "polygon"};
      for (std::size_t i = 2; i + 1 < list.size(); i += 2)
        run.curves.emplace_back(Point2(list[i - 2], list[i - 1]), Point2(list[i], list[i + 1]));
      if (!run.curves.empty()) {
        if (run.closed && (run.curves.back().end() - run.curves.front().start()).norm() > 0)
          run.curves.emplace_back(run.curves.back().end(), run.curves.front().start());
        runs.push_back(std::move(run));
      }
    } else if (kind == "rect") {
      const Point2 low(value("x"), value("y")), size(value("width"), value("height"));
      if (!(size.minCoeff() > 0) || (size - page_).norm() <= 1e-6 * page_.norm()) return;  // the paper itself
      const Point2 at[] = {low, low + Point2(size.x(), 0), low + size, low + Point2(0, size.y())};
      SvgRun run{{}, true};
      for (int k = 0; k < 4; ++k) run.curves.emplace_back(at[k], at[(k + 1) % 4]);
      if (value("rx") > 0 || value("ry") > 0)
        report_.note(called(node, group) + ": its rounded corners are taken as square");
      runs.push_back(std::move(run));
    } else if (kind == "circle" || kind == "ellipse") {
      const double rx = kind == "circle" ? value("r") : value("rx"), ry = kind == "circle" ? rx : value("ry");
      if (rx > 0 && ry > 0) runs.push_back(svg_ellipse({value("cx"), value("cy")}, rx, ry));
    } else {
      return;
    }
    add(node, runs, motion, group);
  }

  void add(const pugi::xml_node& node, const std::vector<SvgRun>& runs, const SvgMotion& motion,
           const std::string& group) {
    SvgShape shape;
    shape.name = name_of(node);
    if (shape.name.empty() || own_) shape.name = group.empty() ? shape.name : group;
    for (const SvgRun& run : runs) {
      curves_ += run.curves.size();
      if (curves_ > options_.limits.max_curves) {
        report_.error("G0974", fmt::format("more than {} curves", options_.limits.max_curves),
                      "is this the right file?");
        return;
      }
      SvgRun placed = moved(run, motion);
      const Point2 gap = placed.curves.back().end() - placed.curves.front().start();
      if (!placed.closed && gap.norm() > kShortestEdge) {
        ++open_;
        continue;
      }
      shape.runs.push_back(std::move(placed));
    }
    if (own_) edge_names(node.attribute("data-edges").value(), shape);
    if (!shape.runs.empty()) shapes_.push_back(std::move(shape));
  }

  /// "hem 1 side 5": names of edges and of how many curves each is made.
  static void edge_names(std::string_view text, SvgShape& shape) {
    while (shape.edges.size() < 4096) {
      const std::size_t start = text.find_first_not_of(' ');
      if (start == std::string_view::npos) return;
      text.remove_prefix(start);
      const std::size_t end = text.find(' ');
      if (end == std::string_view::npos) return;
      const std::vector<double> count = svg_numbers(text.substr(end), 1);
      if (count.empty() || count[0] < 1 || count[0] > 1e6) return;
      shape.edges.emplace_back(text.substr(0, end));
      shape.counts.push_back(static_cast<int>(count[0]));
      const std::size_t next = text.find(' ', end + 1);
      if (next == std::string_view::npos) return;
      text.remove_prefix(next);
    }
  }

  /// The run without what is shorter than an edge may be; its ends meet.
  static std::vector<Curve> cleaned(const SvgRun& run) {
    std::vector<Curve> out;
    const Point2 first = run.curves.front().start();
    Point2 from = first;
    for (std::size_t i = 0; i < run.curves.size(); ++i) {
      const Curve& curve = run.curves[i];
      Point2 to = curve.end();
      if ((to - first).norm() < kShortestEdge && i + 1 == run.curves.size()) to = first;
      const Curve next(from, to, curve.shape());
      if (next.length() < kShortestEdge) continue;
      out.push_back(next);
      from = to;
    }
    if (!out.empty() && out.back().end() != first) {
      if ((out.back().end() - first).norm() < kShortestEdge)
        out.back() = Curve(out.back().start(), first, out.back().shape());
      else
        out.emplace_back(out.back().end(), first);
    }
    return out;
  }

  static std::vector<design::Edge> edges_of(const SvgRun& run, const SvgShape& shape) {
    const std::vector<Curve> curves = cleaned(run);
    std::vector<design::Edge> edges;
    std::size_t sum = 0;
    for (int n : shape.counts) sum += static_cast<std::size_t>(n);
    const bool named = !shape.edges.empty() && sum == curves.size();
    const bool straight = std::all_of(curves.begin(), curves.end(), [](const Curve& c) {
      return std::holds_alternative<geometry::Line>(c.shape());
    });
    if (named) {
      std::size_t k = 0;
      for (std::size_t e = 0; e < shape.edges.size(); ++e) {
        const auto n = static_cast<std::size_t>(shape.counts[e]);
        design::Edge edge;
        edge.name = shape.edges[e];
        edge.curve = n == 1 ? curves[k]
                            : geometry::chain({curves.begin() + static_cast<std::ptrdiff_t>(k),
                                               curves.begin() + static_cast<std::ptrdiff_t>(k + n)});
        edges.push_back(std::move(edge));
        k += n;
      }
    } else if (straight && curves.size() > kFlattened) {
      DxfCourse loop{{}, true};
      for (const Curve& c : curves) loop.points.push_back({c.start(), 0});
      return outline_of(loop, {}, {});
    } else {
      for (const Curve& c : curves) edges.emplace_back().curve = c;
    }
    if (edges.size() == 1) {  // one curve from a point round to it
      const Curve whole = edges[0].curve;
      edges[0].curve = whole.part(0, whole.length() / 2);
      edges.emplace_back().curve = whole.part(whole.length() / 2, whole.length());
    }
    if (signed_area(edges) < 0) {
      std::reverse(edges.begin(), edges.end());
      for (design::Edge& edge : edges) edge.curve = edge.curve.reversed();
    }
    return edges;
  }

  std::optional<design::Garment> garment_of() {
    design::Garment garment;
    garment.title = options_.title;
    garment.fabrics.push_back(options_.fabric);
    std::set<std::string> taken{options_.fabric.name};
    std::size_t small = 0;
    for (const SvgShape& shape : shapes_) {
      std::vector<std::vector<design::Edge>> loops;
      for (const SvgRun& run : shape.runs) {
        std::vector<design::Edge> edges = edges_of(run, shape);
        const double area = signed_area(edges);
        if (edges.size() < 2 || edges.size() > options_.limits.max_edges || !std::isfinite(area) ||
            area < kLeastPanelArea)
          ++small;
        else
          loops.push_back(std::move(edges));
      }
      std::stable_sort(loops.begin(), loops.end(),
                       [](const auto& a, const auto& b) { return signed_area(a) > signed_area(b); });
      std::vector<design::Panel> made;
      for (std::vector<design::Edge>& loop : loops) place(std::move(loop), made);
      for (design::Panel& panel : made) {
        if (garment.panels.size() >= options_.limits.max_panels) {
          report_.error("G0974", fmt::format("more than {} closed paths", options_.limits.max_panels),
                        "is this the right file?");
          return std::nullopt;
        }
        panel.name = unique_name(identifier(shape.name, "panel"), taken);
        if (panel.name != shape.name)
          report_.note(fmt::format("{} is called `{}`",
                                   shape.name.empty() ? "a path without a name" : in_ticks(shape.name),
                                   panel.name));
        panel.resolution = options_.resolution;
        garment.panels.push_back(std::move(panel));
      }
    }
    if (small > 0)
      report_.note(fmt::format(
          "{} closed paths of less than a square millimetre or of too many edges are left out", small));
    if (open_ > 0) report_.note(fmt::format("{} open paths are left out", open_));
    if (garment.panels.empty()) {
      report_.error(
          "G0973",
          fmt::format("no closed path in the drawing ({} open ones), expected one for each panel", open_),
          "close the paths, and turn text and copies (<use>) into paths");
      return std::nullopt;
    }
    lay_flat(garment);
    return garment;
  }

  /// A loop within a panel of the same path is its hole, else a panel of its own.
  void place(std::vector<design::Edge> loop, std::vector<design::Panel>& made) {
    auto points = [](const std::vector<design::Edge>& edges) {
      std::vector<Point2> out;
      for (const design::Edge& edge : edges) {
        const std::vector<Point2> p = edge.curve.polyline(1e-4);
        out.insert(out.end(), p.begin(), p.end() - 1);
      }
      return out;
    };
    const std::vector<Point2> own = points(loop);
    std::set<std::string> taken;
    auto name = [&taken](std::vector<design::Edge>& edges, const std::string& base) {
      int k = 0;
      for (design::Edge& edge : edges) {
        edge.name = unique_name(
            edge.name.empty() ? fmt::format("{}_{}", base, ++k) : identifier(edge.name, "edge"), taken);
        edge.free = true;
      }
    };
    for (design::Panel& panel : made) {
      const std::vector<Point2> polygon = points(panel.edges);
      if (own.size() * polygon.size() > 100'000'000) continue;
      if (!std::all_of(own.begin(), own.end(), [&](const Point2& p) {
            return within(polygon, p) && border_distance(polygon, p) > 1.5e-4;
          }))
        continue;
      for (const auto* list : {&panel.edges, &panel.hole_edges})
        for (const design::Edge& edge : *list) taken.insert(edge.name);
      design::Hole hole{fmt::format("hole_{}", panel.holes.size() + 1),
                        {},
                        static_cast<int>(panel.hole_edges.size()),
                        static_cast<int>(loop.size())};
      name(loop, hole.name);
      panel.hole_edges.insert(panel.hole_edges.end(), loop.begin(), loop.end());
      panel.holes.push_back(std::move(hole));
      return;
    }
    name(loop, "edge");
    made.emplace_back().edges = std::move(loop);
  }

  const SvgOptions& options_;
  PatternReport report_;
  std::vector<SvgShape> shapes_;
  Point2 page_{0, 0};
  std::size_t curves_ = 0, open_ = 0;
  bool own_ = false;
};

}  // namespace

SvgResult read_svg(std::string_view bytes, const SvgOptions& options) {
  return SvgReader(options).read(bytes);
}

}  // namespace garment::io
