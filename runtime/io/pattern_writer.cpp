#include "runtime/io/pattern_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "runtime/io/cut_outline.hpp"
#include "runtime/io/pattern_curve.hpp"
#include "runtime/io/pattern_document.hpp"
#include "runtime/io/pattern_extension.hpp"
#include "runtime/io/pattern_layout.hpp"
#include "runtime/io/pattern_rotation.hpp"

namespace garment::io {
namespace {

using geometry::Curve;
using geometry::Point2;
using nlohmann::json;
using nlohmann::ordered_json;

constexpr double kSameVertex = 2e-6;  // m; the reader takes vertices within 1e-6 m as one
constexpr double kLeftOut = 2e-4;     // m, of vertices of edges that it leaves out: they moved together
constexpr double kSamePlace = 1e-7;   // m, of control points, sagittas and places

/// Ten decimals of the file's unit: what is a round number there prints as one.
double rounded(double value) {
  const double scaled = std::round(value * 1e10);
  return std::fabs(scaled) < 9e15 ? scaled / 1e10 : value;
}

/// The curve's shape with control points and sagitta within kSamePlace.
bool same_shape(const Curve::Shape& a, const Curve::Shape& b) {
  if (a.index() != b.index()) return false;
  auto near = [](const Point2& p, const Point2& q) { return (p - q).norm() < kSamePlace; };
  if (const auto* q = std::get_if<geometry::Quadratic>(&a))
    return near(q->control, std::get<geometry::Quadratic>(b).control);
  if (const auto* c = std::get_if<geometry::Cubic>(&a)) {
    const auto& d = std::get<geometry::Cubic>(b);
    return near(c->control_1, d.control_1) && near(c->control_2, d.control_2);
  }
  if (const auto* arc = std::get_if<geometry::Arc>(&a))
    return std::fabs(arc->bulge - std::get<geometry::Arc>(b).bulge) < kSamePlace;
  return std::holds_alternative<geometry::Line>(a);
}

class PanelWriter {
 public:
  PanelWriter(const design::Panel& panel, const CutPanel& cut, const PanelLayout* layout,
              const PatternLayout* file, WrittenPanel& written)
      : panel_(panel), cut_(cut), written_(written) {
    if (file) units_ = file->units, pairs_ = file->pairs, raised_ = file->raised;
    written.key = layout ? layout->key : panel.name;
    written.back = layout && layout->back;
    if (layout) own_ = *layout;
    if (!layout || !fits()) forget_numbers();
    count_vertices();
    written.edges.assign(cut.edges.size(), -1);
    written.turned.assign(cut.edges.size(), false);
    for (std::size_t i = 0; i < own_.edges.size(); ++i)
      if (const int k = own_.edges[i].outline; k >= 0) {
        written.edges[static_cast<std::size_t>(k)] = static_cast<int>(i);
        written.turned[static_cast<std::size_t>(k)] = own_.edges[i].turned;
      }
  }

  ordered_json write() {
    ordered_json out;
    make_vertices();
    ordered_json edges = ordered_json::array();
    for (std::size_t i = 0; i < own_.edges.size(); ++i) edges.push_back(edge(i));
    ordered_json vertices = ordered_json::array();
    for (const Point2& v : vertices_) vertices.push_back({v.x(), v.y()});
    place(out);
    out["vertices"] = std::move(vertices);
    out["edges"] = std::move(edges);
    if (!own_.rest.contains("label") && !panel_.label.empty()) out["label"] = panel_.label;
    for (const auto& [key, value] : own_.rest.items())
      if (!out.contains(key) && !(value.is_null() && (key == "translation" || key == "rotation")))
        out[key] = value;
    return out;
  }

 private:
  /// True if the layout's edges are this outline's.
  bool fits() const {
    for (std::size_t i = 0; i < cut_.edges.size(); ++i)
      if (cut_.edges[i].edge != static_cast<int>(i) || cut_.edges[i].dart >= 0) return false;
    if (own_.edges.empty()) return true;
    std::vector<int> seen(cut_.edges.size(), 0);
    for (const EdgeLayout& e : own_.edges)
      if (e.outline >= static_cast<int>(seen.size()) ||
          (e.outline >= 0 && ++seen[static_cast<std::size_t>(e.outline)] > 1))
        return false;
    return std::count(seen.begin(), seen.end(), 1) == static_cast<std::ptrdiff_t>(seen.size());
  }

  void forget_numbers() {
    own_.edges.clear();
    own_.vertices = nullptr;
    own_.words = nullptr;
  }

  void count_vertices() {
    if (!own_.edges.empty()) return;
    const int n = static_cast<int>(cut_.edges.size());
    for (int i = 0; i < n; ++i) own_.edges.push_back({i, (i + 1) % n, i, false});
  }

  /// Member i of what the file said of vertices or edges; null where it said nothing.
  static const json* said(const json& list, std::size_t i) {
    if (list.is_array()) return i < list.size() ? &list[i] : nullptr;
    return member(list, std::to_string(i).c_str());
  }

  /// The edge as the file draws it, metres.
  Curve drawn(const EdgeLayout& e) const {
    const Curve& curve = cut_.edges[static_cast<std::size_t>(e.outline)].curve;
    const Curve seen = written_.back ? curve.mirrored_x(0) : curve;
    return e.turned ? seen.reversed() : seen;
  }

  void make_vertices() {
    std::size_t n = own_.vertices.is_array() ? own_.vertices.size() : 0;
    for (const EdgeLayout& e : own_.edges)
      n = std::max<std::size_t>(
          {n, static_cast<std::size_t>(e.start) + 1, static_cast<std::size_t>(e.end) + 1});
    vertices_.assign(n, Point2(0, 0));
    std::vector<bool> known(n, false);
    auto put = [&](int v, const Point2& p) {
      const auto k = static_cast<std::size_t>(v);
      if (known[k]) return;
      known[k] = true;
      vertices_[k] = Point2(rounded(p.x() * units_.per_metre), rounded(p.y() * units_.per_metre));
    };
    for (const EdgeLayout& e : own_.edges)
      if (e.outline >= 0) {
        const Curve curve = drawn(e);
        put(e.start, curve.start());
        put(e.end, curve.end());
      }
    std::vector<double> reach(n, kSameVertex);
    for (const EdgeLayout& e : own_.edges)
      if (e.outline < 0)
        for (int v : {e.start, e.end}) reach[static_cast<std::size_t>(v)] = kLeftOut;
    for (std::size_t v = 0; v < n; ++v) {
      const json* words = said(own_.vertices, v);
      if (!words) continue;
      const auto x = number_at(*words, 0, 1e9), y = number_at(*words, 1, 1e9);
      if (!x || !y) continue;
      const Point2 stated(*x, *y);
      if (!known[v] || (stated - vertices_[v]).norm() <= reach[v] * units_.per_metre) vertices_[v] = stated;
    }
  }

  ordered_json edge(std::size_t i) const {
    const EdgeLayout& e = own_.edges[i];
    ordered_json out;
    out["endpoints"] = {e.start, e.end};
    const json* words = said(own_.words, i);
    const json* stated = words ? member(*words, "curvature") : nullptr;
    if (e.outline < 0) {
      if (stated) out["curvature"] = *stated;
    } else if (stated && means(*stated, e)) {
      out["curvature"] = *stated;
    } else if (const json written = curvature(e); !written.is_null()) {
      out["curvature"] = written;
    }
    if (words && words->is_object())
      for (const auto& [key, value] : words->items())
        if (!out.contains(key) && key != "curvature") out[key] = value;
    return out;
  }

  Point2 vertex(int v) const { return vertices_[static_cast<std::size_t>(v)] / units_.per_metre; }

  /// True if the file's words, read between its vertices, give the curve of the garment.
  bool means(const json& stated, const EdgeLayout& e) const {
    PatternReport ignored;
    const auto shape =
        read_pattern_curve(&stated, vertex(e.start), vertex(e.end), units_, PatternLimits{}, "", ignored);
    return shape && same_shape(*shape, drawn(e).shape());
  }

  json pair(const Curve& curve, const Point2& control) const {
    if (!units_.relative_curves)
      return {rounded(control.x() * units_.per_metre), rounded(control.y() * units_.per_metre)};
    const Point2 d = curve.end() - curve.start(), q(-d.y(), d.x()), c = control - curve.start();
    const double square = d.squaredNorm();
    return {c.dot(d) / square, c.dot(q) / square};
  }

  json curvature(const EdgeLayout& e) const {
    const Curve curve = drawn(e);
    if (const auto* q = std::get_if<geometry::Quadratic>(&curve.shape())) {
      const json control = pair(curve, q->control);
      return pairs_ ? control : json{{"type", "quadratic"}, {"params", json::array({control})}};
    }
    if (const auto* c = std::get_if<geometry::Cubic>(&curve.shape()))
      return {{"type", "cubic"},
              {"params", json::array({pair(curve, c->control_1), pair(curve, c->control_2)})}};
    if (const auto* arc = std::get_if<geometry::Arc>(&curve.shape()); arc && arc->bulge != 0) {
      const double half = (curve.end() - curve.start()).norm() / 2, sagitta = std::fabs(arc->bulge);
      const double radius = (half * half / sagitta + sagitta) / 2;
      return {{"type", "circle"},
              {"params", {radius * units_.per_metre, sagitta > half ? 1 : 0, arc->bulge < 0 ? 1 : 0}}};
    }
    return nullptr;
  }

  static std::optional<Eigen::Vector3d> triple(const json* list) {
    if (!list || !list->is_array() || list->size() != 3) return std::nullopt;
    Eigen::Vector3d v;
    for (int i = 0; i < 3; ++i) {
      auto number = number_at(*list, static_cast<std::size_t>(i), 1e9);
      if (!number) return std::nullopt;
      v[i] = *number;
    }
    return v;
  }

  void place(ordered_json& out) const {
    Eigen::Matrix3d R = panel_.placement.rotation;
    if (written_.back) {
      R.col(0) = -R.col(0);  // R Ry(180 deg) is its own inverse
      R.col(2) = -R.col(2);
    }
    const Eigen::Vector3d t =
        (panel_.placement.translation - Eigen::Vector3d(0, raised_, 0)) * units_.per_metre;
    const json *stated_t = member(own_.rest, "translation"), *stated_R = member(own_.rest, "rotation");
    const auto t0 = triple(stated_t), R0 = triple(stated_R);
    if (t0 && (*t0 - t).norm() < kSamePlace * units_.per_metre)
      out["translation"] = *stated_t;
    else if (!(stated_t && stated_t->is_null() && t.norm() < kSamePlace))
      out["translation"] = {rounded(t.x()), rounded(t.y()), rounded(t.z())};
    if (R0 && (rotation_zyx(*R0) - R).cwiseAbs().maxCoeff() < 1e-8) {
      out["rotation"] = *stated_R;
    } else if (!(stated_R && stated_R->is_null() && R.isIdentity(1e-12))) {
      const Eigen::Vector3d angles = angles_zyx(R);
      out["rotation"] = {rounded(angles.x()), rounded(angles.y()), rounded(angles.z())};
    }
  }

  const design::Panel& panel_;
  const CutPanel& cut_;
  WrittenPanel& written_;
  PanelLayout own_;
  PatternUnits units_;
  bool pairs_ = false;
  double raised_ = 0;
  std::vector<Point2> vertices_;  // units of the file
};

class PatternWriter {
 public:
  PatternWriter(const design::Garment& garment, const PatternLayout* layout)
      : garment_(garment), layout_(layout), cut_(cut_garment(garment)) {}

  PatternText write() {
    ordered_json pattern = ordered_json::object(), panels = ordered_json::object();
    written_.panels.resize(garment_.panels.size());
    for (std::size_t p = 0; p < garment_.panels.size(); ++p) {
      PanelWriter writer(garment_.panels[p], cut_.panels[p], layout_of(garment_.panels[p].name), layout_,
                         written_.panels[p]);
      panels[written_.panels[p].key] = writer.write();
    }
    pattern["panels"] = std::move(panels);
    const json* old = layout_ ? member(layout_->root, "pattern") : nullptr;
    ordered_json stitches = write_stitches();
    if (!old || member(*old, "stitches") || !stitches.empty()) pattern["stitches"] = std::move(stitches);
    if (!old) pattern["panel_order"] = order();
    if (old)
      for (const auto& [key, value] : old->items())
        if (!pattern.contains(key)) pattern[key] = value;
    ordered_json root;
    root["pattern"] = std::move(pattern);
    if (layout_ && layout_->root.is_object()) {
      for (const auto& [key, value] : layout_->root.items())
        if (key != "pattern" && key != kExtension) root[key] = value;
    } else {
      root["properties"] = {{"curvature_coords", "relative"},
                            {"normalize_panel_translation", false},
                            {"normalized_edge_loops", true},
                            {"units_in_meter", 100}};
    }
    const json* stated = layout_ ? member(layout_->root, kExtension) : nullptr;
    add_extension(root, garment_, cut_, written_, stated, layout_ != nullptr);
    PatternText out;
    out.text = root.dump(2, ' ', true) + "\n";
    tell_lost(out.findings);
    return out;
  }

 private:
  const PanelLayout* layout_of(const std::string& name) const {
    if (layout_)
      for (const PanelLayout& panel : layout_->panels)
        if (panel.panel == name) return &panel;
    return nullptr;
  }

  ordered_json order() const {
    ordered_json names = ordered_json::array();
    for (const WrittenPanel& panel : written_.panels) names.push_back(panel.key);
    return names;
  }

  ordered_json side(const CutStitch& stitch, int i) const {
    const WrittenPanel& panel = written_.panels[static_cast<std::size_t>(stitch.panel[i])];
    ordered_json out;
    out["panel"] = panel.key;
    out["edge"] = panel.edges[static_cast<std::size_t>(stitch.edge[i])];
    return out;
  }

  ordered_json stitch_of(const CutStitch& stitch, bool swapped) const {
    bool turned = false;
    for (int i = 0; i < 2; ++i)
      turned = turned != written_.panels[static_cast<std::size_t>(stitch.panel[i])]
                             .turned[static_cast<std::size_t>(stitch.edge[i])];
    ordered_json out = ordered_json::array({side(stitch, swapped ? 1 : 0), side(stitch, swapped ? 0 : 1)});
    if (stitch.start_to_start != turned) out.push_back("right_wrong");
    return out;
  }

  /// The file's own words where they are the stitch, else the garment's.
  ordered_json worded(ordered_json made, const json& words) const {
    if (!words.is_array() || words.size() != made.size()) return made;
    for (int i = 0; i < 2; ++i)
      for (const char* key : {"panel", "edge"})
        if (!words[static_cast<std::size_t>(i)].is_object() ||
            !words[static_cast<std::size_t>(i)].contains(key) ||
            words[static_cast<std::size_t>(i)][key] != json(made[static_cast<std::size_t>(i)][key]))
          return made;
    return ordered_json(words);
  }

  ordered_json write_stitches() {
    ordered_json out = ordered_json::array();
    std::vector<bool> done(cut_.stitches.size(), false);
    written_.stitches.assign(garment_.seams.size(), {});
    auto add = [&](std::size_t k, bool swapped, const json& words) {
      done[k] = true;
      if (cut_.stitches[k].seam >= 0)
        written_.stitches[static_cast<std::size_t>(cut_.stitches[k].seam)].push_back(
            static_cast<int>(out.size()));
      out.push_back(worded(stitch_of(cut_.stitches[k], swapped), words));
    };
    std::map<std::string, std::vector<std::size_t>> of_seam;
    for (std::size_t k = 0; k < cut_.stitches.size(); ++k)
      if (const int s = cut_.stitches[k].seam; s >= 0)
        of_seam[garment_.seams[static_cast<std::size_t>(s)].name].push_back(k);
    if (layout_)
      for (const StitchLayout& stitch : layout_->stitches) {
        if (stitch.seam.empty()) {
          if (!stitch.words.is_null()) out.push_back(ordered_json(stitch.words));
          continue;
        }
        const auto found = of_seam.find(stitch.seam);
        if (found == of_seam.end()) continue;
        for (std::size_t k : found->second)
          if (!done[k]) add(k, stitch.swapped, found->second.size() == 1 ? stitch.words : json());
      }
    for (std::size_t k = 0; k < cut_.stitches.size(); ++k)
      if (!done[k]) add(k, false, json());
    return out;
  }

  void tell_lost(Findings& findings) const {
    const std::vector<std::string> lost = not_written(garment_, cut_);
    if (lost.empty()) return;
    std::string names;
    for (std::size_t i = 0; i < lost.size() && i < 6; ++i) names += (i > 0 ? ", " : "") + lost[i];
    if (lost.size() > 6) names += fmt::format(" and {} more", lost.size() - 6);
    findings.push_back({"G0906",
                        Severity::warning,
                        "a sewing-pattern specification cannot hold " + names,
                        {},
                        "keep the script beside it: it alone says these things"});
  }

  const design::Garment& garment_;
  const PatternLayout* layout_;
  CutGarment cut_;
  WrittenPattern written_;
};

}  // namespace

PatternText write_pattern_json(const design::Garment& garment, const PatternLayout* layout) {
  return PatternWriter(garment, layout).write();
}

bool same_numbers(const json& a, const json& b, double tolerance) {
  auto number = [](const json& v) { return v.is_boolean() ? (v.get<bool>() ? 1.0 : 0.0) : v.get<double>(); };
  auto counts = [](const json& v) { return v.is_number() || v.is_boolean(); };
  if (counts(a) && counts(b)) return std::fabs(number(a) - number(b)) <= tolerance;
  if (a.type() != b.type()) return false;
  if (a.is_array()) {
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i)
      if (!same_numbers(a[i], b[i], tolerance)) return false;
    return true;
  }
  if (!a.is_object()) return a == b;
  if (a.size() != b.size()) return false;
  for (const auto& [key, value] : a.items())
    if (!b.contains(key) || !same_numbers(value, b[key], tolerance)) return false;
  return true;
}

bool is_circle(const json& edge) {
  const json* curvature = member(edge, "curvature");
  const json* type = curvature ? member(*curvature, "type") : nullptr;
  return type && *type == "circle";
}

}  // namespace garment::io
