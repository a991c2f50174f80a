#include "runtime/io/pattern_panel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "runtime/base/number.hpp"
#include "runtime/io/pattern_curve.hpp"
#include "runtime/io/pattern_document.hpp"
#include "runtime/io/pattern_rotation.hpp"

namespace garment::io {
namespace {

using geometry::Curve;
using geometry::Point2;
using nlohmann::json;

constexpr double kSamePoint = 1e-6;  ///< m; nearer points are one

struct Ends {
  int start = -1, end = -1;
};

struct Step {
  int edge = -1;
  bool turned = false;
};

class PanelReader {
 public:
  PanelReader(const std::string& file_name, const json& value, const PatternUnits& units,
              const PatternLimits& limits, PatternReport& report)
      : value_(value),
        units_(units),
        limits_(limits),
        report_(report),
        where_("panel " + in_ticks(file_name)) {
    out_.file_name = file_name;
  }

  std::optional<FilePanel> read() {
    int before = report_.errors();
    if (!read_vertices() || !read_edges()) return std::nullopt;
    auto walk = walk_loop();
    if (!walk) return std::nullopt;
    make_outline(*walk);
    read_placement();
    if (const json* label = member(value_, "label"); label && label->is_string())
      if (*label == "body" || *label == "leg" || *label == "arm")
        out_.panel.label = label->get<std::string>();
    if (report_.errors() != before) return std::nullopt;
    normalise();
    if (report_.errors() != before) return std::nullopt;
    return std::move(out_);
  }

 private:
  std::string edge_name(std::size_t i) const { return fmt::format("{}, edge {}", where_, i); }

  /// The list under `key`, within the limits; null and an error otherwise.
  const json* list_of(const char* key, std::size_t least) {
    const json* list = member(value_, key);
    if (!list || !list->is_array()) {
      report_.error(
          "G0943",
          fmt::format("{}: `{}` is {}, expected a list", where_, key, list ? describe(*list) : "missing"),
          "a panel needs `vertices` [[x, y], ...] and `edges` [{\"endpoints\": [i, j]}, ...]");
      return nullptr;
    }
    if (list->size() < least || list->size() > limits_.max_edges) {
      report_.error("G0944", fmt::format("{}: `{}` has {} items, expected {} to {}", where_, key,
                                         list->size(), least, limits_.max_edges));
      return nullptr;
    }
    return list;
  }

  bool read_vertices() {
    const json* list = list_of("vertices", 2);
    if (!list) return false;
    double limit = limits_.max_coordinate * units_.per_metre;
    for (std::size_t i = 0; i < list->size(); ++i) {
      const json& v = (*list)[i];
      auto x = number_at(v, 0, limit), y = number_at(v, 1, limit);
      if (!x || !y || v.size() != 2) {
        report_.error("G0944",
                      fmt::format("{}: vertex {} is {}, expected two finite numbers within {} m", where_, i,
                                  describe(v), format_number(limits_.max_coordinate)),
                      "check `properties.units_in_meter`: coordinates are divided by it");
        return false;
      }
      vertices_.emplace_back(*x / units_.per_metre, *y / units_.per_metre);
    }
    return true;
  }

  bool read_edges() {
    const json* list = list_of("edges", 1);
    if (!list) return false;
    bool good = true;
    for (std::size_t i = 0; i < list->size(); ++i) good = read_edge((*list)[i], i) && good;
    return good;
  }

  bool read_edge(const json& e, std::size_t i) {
    const json* pair = member(e, "endpoints");
    if (!pair || !pair->is_array() || pair->size() != 2) {
      report_.error("G0943", fmt::format("{}: `endpoints` is {}, expected two vertex numbers", edge_name(i),
                                         pair ? describe(*pair) : "missing"));
      return false;
    }
    auto a = index_below((*pair)[0], vertices_.size()), b = index_below((*pair)[1], vertices_.size());
    if (!a || !b) {
      report_.error(
          "G0945",
          fmt::format("{}: its endpoints are {} and {}, expected vertex numbers from 0 to {}", edge_name(i),
                      describe((*pair)[0]), describe((*pair)[1]), vertices_.size() - 1));
      return false;
    }
    FileEdge file_edge;
    if (const json* label = member(e, "label"); label && label->is_string())
      file_edge.label = label->get<std::string>();
    bool has_length = (vertices_[*a] - vertices_[*b]).norm() > kSamePoint;
    auto shape = has_length ? read_pattern_curve(member(e, "curvature"), vertices_[*a], vertices_[*b], units_,
                                                 limits_, edge_name(i), report_)
                            : Curve::Shape(geometry::Line{});
    if (!shape) return false;
    if (has_length && (vertices_[*a] - vertices_[*b]).norm() < kShortestEdge)
      has_length = Curve(vertices_[*a], vertices_[*b], *shape).length() >= kShortestEdge;
    if (!has_length)
      report_.warning("G0946", fmt::format("{}: is shorter than 0.1 mm; it is left out", edge_name(i)),
                      "give it two different vertices, or remove it");
    ends_.push_back({*a, *b});
    shapes_.push_back(std::move(*shape));
    dropped_.push_back(!has_length);
    out_.edges.push_back(std::move(file_edge));
    return true;
  }

  /// Vertices that lie on each other become one number, so that loops closed by place and not by number close
  /// too.
  std::vector<int> merged_vertices() const {
    std::vector<int> order(vertices_.size()), same(vertices_.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
    std::sort(order.begin(), order.end(), [&](int a, int b) {
      if (vertices_[a].x() != vertices_[b].x()) return vertices_[a].x() < vertices_[b].x();
      return a < b;
    });
    for (std::size_t i = 0; i < order.size(); ++i) {
      same[order[i]] = order[i];
      for (std::size_t j = i; j-- > 0;) {
        if (vertices_[order[i]].x() - vertices_[order[j]].x() > kSamePoint) break;
        if ((vertices_[order[i]] - vertices_[order[j]]).norm() <= kSamePoint) {
          same[order[i]] = same[order[j]];
          break;
        }
      }
    }
    for (std::size_t i = 0; i < ends_.size(); ++i) {  // what is left out has both ends in one place
      const int from = same[ends_[i].start], to = same[ends_[i].end];
      if (dropped_[i] && from != to) std::replace(same.begin(), same.end(), to, from);
    }
    return same;
  }

  /// The edges in the order walked: as they stand if that is a loop, else put in order; nothing if they are
  /// none.
  std::optional<std::vector<Step>> walk_loop() {
    std::vector<Step> steps;
    std::vector<int> same = merged_vertices();
    for (Ends& e : ends_) e = {same[e.start], same[e.end]};
    for (std::size_t i = 0; i < ends_.size(); ++i)
      if (!dropped_[i] && ends_[i].start != ends_[i].end) steps.push_back({static_cast<int>(i), false});
    if (steps.size() < 2) {
      report_.error("G0947",
                    fmt::format("{}: {} edges of some length, expected at least 2", where_, steps.size()));
      return std::nullopt;
    }
    bool in_order = true;
    for (std::size_t k = 0; k < steps.size(); ++k)
      in_order = in_order && ends_[steps[k].edge].end == ends_[steps[(k + 1) % steps.size()].edge].start;
    return in_order ? std::optional(std::move(steps)) : reorder(std::move(steps));
  }

  std::optional<std::vector<Step>> reorder(std::vector<Step> steps) {
    std::vector<std::vector<int>> at(vertices_.size());
    for (const Step& s : steps) {
      at[ends_[s.edge].start].push_back(s.edge);
      at[ends_[s.edge].end].push_back(s.edge);
    }
    for (std::size_t v = 0; v < at.size(); ++v) {
      if (at[v].empty() || at[v].size() == 2) continue;
      report_.error(
          "G0947",
          fmt::format("{}: {} edges meet at vertex {}, expected two: the outline is not one closed loop",
                      where_, at[v].size(), v),
          "each edge must start where the one before ends, and the last end where the first starts");
      return std::nullopt;
    }
    std::vector<Step> walk{steps.front()};
    int vertex = ends_[walk[0].edge].end;
    while (vertex != ends_[walk[0].edge].start) {
      int next = at[vertex][0] == walk.back().edge ? at[vertex][1] : at[vertex][0];
      bool turned = ends_[next].start != vertex;
      walk.push_back({next, turned});
      vertex = turned ? ends_[next].start : ends_[next].end;
    }
    if (walk.size() != steps.size()) {
      report_.error("G0947",
                    fmt::format("{}: its edges make several loops; the first has {} of {} edges", where_,
                                walk.size(), steps.size()),
                    "a panel has one outline; holes and islands are not read");
      return std::nullopt;
    }
    report_.warning(
        "G0949", fmt::format("{}: its edges do not stand in the order of the outline; put in order", where_),
        "stitches keep the file's edge numbers and directions");
    return walk;
  }

  void make_outline(const std::vector<Step>& walk) {
    auto vertex = [&](const Step& s, bool at_end) {
      const Ends& e = ends_[s.edge];
      return vertices_[at_end != s.turned ? e.end : e.start];
    };
    for (const Step& s : walk) {
      design::Edge edge;
      edge.curve = Curve(vertex(s, false), vertex(s, true), turned_shape(shapes_[s.edge], s.turned));
      out_.edges[s.edge].edge = static_cast<int>(out_.panel.edges.size());
      out_.edges[s.edge].turned = s.turned;
      out_.panel.edges.push_back(std::move(edge));
    }
  }

  static Curve::Shape turned_shape(Curve::Shape shape, bool turned) {
    if (!turned) return shape;
    if (auto* arc = std::get_if<geometry::Arc>(&shape)) arc->bulge = -arc->bulge;
    if (auto* cubic = std::get_if<geometry::Cubic>(&shape)) std::swap(cubic->control_1, cubic->control_2);
    return shape;
  }

  /// Three numbers under `key`; zero where the key is missing, with a warning.
  Eigen::Vector3d triple(const char* key, double limit, const char* expected) {
    const json* list = member(value_, key);
    if (!list) {
      report_.warning("G0943", fmt::format("{}: `{}` is missing, zero is taken", where_, key));
      return Eigen::Vector3d::Zero();
    }
    Eigen::Vector3d v = Eigen::Vector3d::Zero();
    for (int i = 0; i < 3; ++i) {
      auto number = number_at(*list, static_cast<std::size_t>(i), limit);
      if (!number || list->size() != 3) {
        report_.error("G0944", fmt::format("{}: `{}` is {}, expected {}", where_, key,
                                           list->dump(-1, ' ', true).substr(0, 80), expected));
        return Eigen::Vector3d::Zero();
      }
      v[i] = *number;
    }
    return v;
  }

  void read_placement() {
    std::string metres =
        fmt::format("three finite numbers within {} m", format_number(limits_.max_coordinate));
    design::Placement& place = out_.panel.placement;
    place.kind = design::Placement::Kind::rigid;
    place.translation =
        triple("translation", limits_.max_coordinate * units_.per_metre, metres.c_str()) / units_.per_metre;
    Eigen::Vector3d angles = triple("rotation", 1e6, "three finite angles in degrees");
    place.rotation = rotation_zyx(angles);
    if ((place.rotation - rotation_xyz(angles)).cwiseAbs().maxCoeff() > 1e-9)
      report_.warning(
          "G0951",
          fmt::format("{}: turned by ({}, {}, {}) deg, read as Rz Ry Rx; a writer that means Rx Ry Rz would "
                      "have it elsewhere",
                      where_, format_number(angles.x(), 6), format_number(angles.y(), 6),
                      format_number(angles.z(), 6)),
          "look at the panel's place before draping; state it with `place ... at ... turn ...`");
  }

  /// Counter-clockwise, face up: a clockwise panel is seen from its back.
  void normalise() {
    double area = signed_area(out_.panel.edges);
    if (!std::isfinite(area) || std::abs(area) < kLeastPanelArea) {
      report_.error("G0952",
                    fmt::format("{}: its outline encloses {} cm^2, expected at least {} cm^2", where_,
                                format_number(std::abs(area) * 1e4, 3), format_number(kLeastPanelArea * 1e4)),
                    "check the vertices and `properties.units_in_meter`");
      return;
    }
    if (area > 0) return;
    out_.back = true;
    for (design::Edge& edge : out_.panel.edges) edge.curve = edge.curve.mirrored_x(0);
    Eigen::Matrix3d& R = out_.panel.placement.rotation;
    R.col(0) = -R.col(0);  // R Ry(180 deg)
    R.col(2) = -R.col(2);
    report_.note(
        fmt::format("{}: drawn clockwise, so seen from its back; mirrored, so that its face is up", where_));
  }

  const json& value_;
  const PatternUnits& units_;
  const PatternLimits& limits_;
  PatternReport& report_;
  std::string where_;
  std::vector<Point2> vertices_;
  std::vector<Ends> ends_;
  std::vector<Curve::Shape> shapes_;
  std::vector<bool> dropped_;
  FilePanel out_;
};

}  // namespace

double signed_area(const std::vector<design::Edge>& edges) {
  double area = 0;
  for (const design::Edge& edge : edges) area += edge.curve.area_term();
  return area;
}

std::optional<FilePanel> read_pattern_panel(const std::string& file_name, const json& value,
                                            const PatternUnits& units, const PatternLimits& limits,
                                            PatternReport& report) {
  return PanelReader(file_name, value, units, limits, report).read();
}

}  // namespace garment::io
