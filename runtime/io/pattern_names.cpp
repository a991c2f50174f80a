#include "runtime/io/pattern_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "runtime/io/pattern_place.hpp"

namespace garment::io {
namespace {

bool contains(std::string_view text, std::string_view part) {
  auto same = [](char a, char b) { return (a | 0x20) == b; };  // `part` is lower case
  return std::search(text.begin(), text.end(), part.begin(), part.end(), same) != text.end();
}

enum class PanelKind { body, sleeve, hood, band };

PanelKind kind_of(const design::Panel& panel) {
  if (panel.label == "arm" || contains(panel.name, "sleeve")) return PanelKind::sleeve;
  if (contains(panel.name, "hood") || contains(panel.name, "collar")) return PanelKind::hood;
  if (contains(panel.name, "band") || contains(panel.name, "cuff") || panel.name.starts_with("wb"))
    return PanelKind::band;
  return PanelKind::body;
}

class Namer {
 public:
  Namer(design::Garment& garment, const EdgeLabels& labels)
      : garment_(garment), labels_(labels), place_(garment_place(garment)) {
    for (const design::Panel& panel : garment.panels) kinds_.push_back(kind_of(panel));
    hangs_.resize(place_.piece_low.size());
    for (std::size_t p = 0; p < place_.panels.size(); ++p)
      for (const EdgePlace& e : place_.panels[p].edges)
        if (e.sewn() && e.partner_panel != static_cast<int>(p) && is_shoulder(static_cast<int>(p), e))
          hangs_[place_.panels[p].piece] = true;
  }

  void name_edges() {
    base_.resize(garment_.panels.size());
    for (std::size_t p = 0; p < garment_.panels.size(); ++p) {
      std::vector<design::Edge>& edges = garment_.panels[p].edges;
      for (std::size_t e = 0; e < edges.size(); ++e) {
        base_[p].push_back(base_name(static_cast<int>(p), static_cast<int>(e)));
        edges[e].free = !place_.panels[p].edges[e].sewn();
      }
      name_darts(static_cast<int>(p));
      number(edges, base_[p]);
    }
  }

  void name_seams(std::set<std::string>& taken) {
    std::vector<std::string> bases;
    std::map<std::string, int> count;
    for (const design::Seam& seam : garment_.seams) ++count[bases.emplace_back(seam_base(seam))];
    std::map<std::string, int> next;
    for (std::size_t i = 0; i < bases.size(); ++i) {
      const std::string& base = bases[i];
      garment_.seams[i].name =
          unique_name(count[base] > 1 ? fmt::format("{}_{}", base, ++next[base]) : base, taken);
    }
  }

 private:
  const std::string& panel_name(int p) const { return garment_.panels[p].name; }

  /// Next to each other in the outline and sewn to each other: the legs of a dart.
  bool is_dart(int p, int e) const {
    const EdgePlace& edge = place_.panels[p].edges[e];
    int n = static_cast<int>(garment_.panels[p].edges.size());
    return edge.partner_panel == p && ((e + 1) % n == edge.partner_edge || (edge.partner_edge + 1) % n == e);
  }

  std::string base_name(int p, int e) const {
    const EdgePlace& edge = place_.panels[p].edges[e];
    std::string name = is_dart(p, e) ? "dart" : from_label(labels_[p][e]);
    if (name.empty()) name = edge.sewn() ? sewn_name(p, edge) : free_name(p, edge);
    bool sided = name == "side" || name == "shoulder" || name == "armhole" || name == "inseam";
    if (sided && place_.panels[p].spans_middle()) name += edge.middle.x() > 0 ? "_left" : "_right";
    return name;
  }

  static std::string from_label(const std::string& label) {
    if (label.empty()) return {};
    if (label == "lower_interface") return "waist";
    if (label == "strapless_top") return "top";
    if (contains(label, "collar")) return "neck";
    if (contains(label, "armhole")) return "armhole";
    return identifier(label, "edge");
  }

  std::string free_name(int p, const EdgePlace& edge) const {
    const PanelPlace& panel = place_.panels[p];
    if (kinds_[p] == PanelKind::sleeve) return "cuff";
    if (kinds_[p] == PanelKind::hood) return "opening";
    double height = (edge.middle.y() - panel.low.y()) / std::max(panel.high.y() - panel.low.y(), 1e-9);
    if (kinds_[p] == PanelKind::band) return height > 0.5 ? "upper" : "lower";
    if (height < 0.3 && !edge.upright()) return "hem";
    if (height < 0.6) return "opening";
    if (!hangs_[place_.panels[p].piece]) return edge.upright() ? "opening" : "waist";
    return std::abs(edge.middle.x()) < 0.5 * panel.widest() ? "neck" : "armhole";
  }

  /// Sewn, upper, lying, front to back.
  bool is_shoulder(int p, const EdgePlace& edge) const {
    const PanelPlace& a = place_.panels[p];
    double height = (edge.middle.y() - a.low.y()) / std::max(a.high.y() - a.low.y(), 1e-9);
    return kinds_[p] == PanelKind::body && kinds_[edge.partner_panel] == PanelKind::body && !edge.upright() &&
           height > 0.7 && front_and_back(p, edge.partner_panel);
  }

  bool front_and_back(int p, int q) const {
    double a = place_.panels[p].center().z(), b = place_.panels[q].center().z();
    return a * b < 0 && std::abs(a) > 0.03 && std::abs(b) > 0.03;
  }

  std::string sewn_name(int p, const EdgePlace& edge) const {
    const PanelPlace& panel = place_.panels[p];
    int q = edge.partner_panel;
    if (q == p) return "tube";
    PanelKind a = kinds_[p], b = kinds_[q];
    bool upper = edge.middle.y() > panel.center().y();
    if (a == PanelKind::sleeve && b == PanelKind::sleeve) return upper ? "overarm" : "underarm";
    if (a == PanelKind::sleeve) return b == PanelKind::band ? "cuff" : "cap";
    if (b == PanelKind::sleeve) return a == PanelKind::band ? (upper ? "upper" : "lower") : "armhole";
    if (a == PanelKind::hood && b == PanelKind::hood) return "center";
    if (a == PanelKind::hood || b == PanelKind::hood) return "neck";
    if (a == PanelKind::band && b == PanelKind::band) return "side";
    if (a == PanelKind::band) return upper ? "upper" : "lower";
    if (b == PanelKind::band) return upper || joins_below(q) ? "waist" : "hem";
    return between_bodies(p, q, edge);
  }

  /// True where the lower edge of a band is sewn too: it lies between two pieces, at the waist and not at the
  /// hem.
  bool joins_below(int band) const {
    const PanelPlace& place = place_.panels[band];
    return std::any_of(place.edges.begin(), place.edges.end(), [&](const EdgePlace& e) {
      return e.sewn() && kinds_[e.partner_panel] == PanelKind::body && e.middle.y() < place.center().y();
    });
  }

  std::string between_bodies(int p, int q, const EdgePlace& edge) const {
    const PanelPlace& a = place_.panels[p];
    const PanelPlace& b = place_.panels[q];
    double half_heights = (a.high.y() - a.low.y() + b.high.y() - b.low.y()) / 2;
    if (std::abs(a.center().y() - b.center().y()) > 0.6 * half_heights) return "waist";
    if (is_shoulder(p, edge)) return "shoulder";
    if (front_and_back(p, q)) {
      bool outer = a.spans_middle() || std::abs(edge.middle.x()) > std::abs(a.center().x());
      return outer ? "side" : "inseam";
    }
    if (a.center().z() * b.center().z() > 1e-3 && a.center().x() * b.center().x() < -1e-3 &&
        !a.spans_middle())
      return a.center().z() > 0 ? "center_front" : "center_back";
    return "to_" + panel_name(q);
  }

  void name_darts(int p) {
    int n = 0;
    for (std::size_t e = 0; e < base_[p].size(); ++e) {
      int other = place_.panels[p].edges[e].partner_edge;
      if (base_[p][e] != "dart" || !is_dart(p, static_cast<int>(e)) || base_[p][other] != "dart") continue;
      ++n;
      base_[p][e] = fmt::format("dart_{}_a", n);
      base_[p][other] = fmt::format("dart_{}_b", n);
    }
  }

  /// Gives names that stand more than once a number each, in the order of the outline.
  static void number(std::vector<design::Edge>& edges, const std::vector<std::string>& bases) {
    std::map<std::string, int> count, next;
    for (const std::string& base : bases) ++count[base];
    std::set<std::string> taken;
    for (std::size_t e = 0; e < edges.size(); ++e)
      if (count[bases[e]] == 1) edges[e].name = unique_name(bases[e], taken);
    for (std::size_t e = 0; e < edges.size(); ++e)
      if (count[bases[e]] > 1)
        edges[e].name = unique_name(fmt::format("{}_{}", bases[e], ++next[bases[e]]), taken);
  }

  std::string seam_base(const design::Seam& seam) const {
    const design::EdgePart& a = seam.sides[0].parts[0];
    const design::EdgePart& b = seam.sides[1].parts[0];
    std::string first = base_[a.panel][a.edge], second = base_[b.panel][b.edge];
    if (first.starts_with("dart_") && a.panel == b.panel)
      return fmt::format("{}_{}", panel_name(a.panel), first.substr(0, first.size() - 2));
    auto strip = [](std::string& name) {
      for (std::string_view side : {"_left", "_right"})
        if (name.ends_with(side)) name.resize(name.size() - side.size());
    };
    strip(first);
    strip(second);
    if (first == "cap" || second == "cap") first = second = "armhole";
    if (first == "upper" || first == "lower") first = second;
    if (second == "upper" || second == "lower") second = first;
    if (first == "upper" || first == "lower" || first != second || first == "tube")
      return fmt::format("{}_{}", panel_name(a.panel), panel_name(b.panel));
    double x = side_of(a) + side_of(b);
    if (!first.starts_with("center") && std::abs(x) > 0.04) return first + (x > 0 ? "_left" : "_right");
    return first.ends_with("seam") ? first : first + "_seam";
  }

  /// How far left of the wearer's middle an edge lies, m; on a panel of one half, how far the panel does.
  double side_of(const design::EdgePart& part) const {
    const PanelPlace& panel = place_.panels[part.panel];
    return panel.spans_middle() ? panel.edges[part.edge].middle.x() : panel.center().x();
  }

  design::Garment& garment_;
  const EdgeLabels& labels_;
  GarmentPlace place_;
  std::vector<PanelKind> kinds_;
  std::vector<bool> hangs_;  ///< by piece: it has edges that can only be shoulders
  std::vector<std::vector<std::string>> base_;
};

}  // namespace

std::string identifier(std::string_view name, std::string_view fallback) {
  std::string out;
  for (char c : name) {
    bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    bool digit = c >= '0' && c <= '9';
    if (letter || digit)
      out += c;
    else if (!out.empty() && out.back() != '_')
      out += '_';
  }
  while (!out.empty() && out.back() == '_') out.pop_back();
  if (out.size() > 60) out.resize(60);
  if (out.empty()) return std::string(fallback);
  if (out[0] >= '0' && out[0] <= '9') return std::string(fallback) + "_" + out;
  return out;
}

std::string unique_name(const std::string& base, std::set<std::string>& taken) {
  if (taken.insert(base).second) return base;
  for (int n = 2;; ++n) {
    std::string name = fmt::format("{}_{}", base, n);
    if (taken.insert(name).second) return name;
  }
}

void name_edges_and_seams(design::Garment& garment, const EdgeLabels& labels, std::set<std::string>& taken) {
  Namer namer(garment, labels);
  namer.name_edges();
  namer.name_seams(taken);
}

}  // namespace garment::io
