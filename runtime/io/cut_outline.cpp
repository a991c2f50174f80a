#include "runtime/io/cut_outline.hpp"

#include <algorithm>
#include <cmath>

namespace garment::io {
namespace {

using design::EdgePart;
using design::Panel;
using design::Point2;

constexpr double kSamePosition = 1e-6;  // m along an edge
constexpr int kRounds = 8;              // divisions carried from seam to seam

using Marks = std::vector<double>;  // ascending arc lengths

void add_mark(Marks& marks, double at) {
  const auto next = std::lower_bound(marks.begin(), marks.end(), at);
  if (next != marks.end() && *next - at < kSamePosition) return;
  if (next != marks.begin() && at - *std::prev(next) < kSamePosition) return;
  marks.insert(next, at);
}

/// Several pieces that formats know only as edges of their own.
bool is_chain(const geometry::Curve& curve) {
  return std::holds_alternative<geometry::Through>(curve.shape()) ||
         std::holds_alternative<geometry::Chain>(curve.shape());
}

/// The stretch as one line, arc or Bezier curve.
geometry::Curve simple_part(const geometry::Curve& curve, double from, double to) {
  const geometry::Curve part = curve.part(from, to);
  if (!is_chain(part)) return part;
  const std::vector<geometry::Curve> links = part.elements();
  const auto longest = std::max_element(links.begin(), links.end(),
                                        [](const auto& a, const auto& b) { return a.length() < b.length(); });
  if (longest == links.end()) return {part.start(), part.end()};
  return {part.start(), part.end(), longest->shape()};  // the others are no longer than a mark is wide
}

struct Mouth {
  double from, to;
  int dart;
};

/// A stretch of an edge in sewing order, and how much of the side it takes.
struct Stretch {
  int panel, edge;
  double from, to;  // from > to walks the edge backwards
  double sewn;      // m
};

class Divider {
 public:
  explicit Divider(const design::Garment& garment) : garment_(garment) {
    for (const Panel& panel : garment.panels) start_panel(panel);
  }

  CutGarment divide() {
    for (const design::Seam& seam : garment_.seams)
      for (const design::SeamSide& side : seam.sides)
        for (const EdgePart& part : side.parts)
          if (known(part))
            for (double at : {part.from, part.to}) add_mark(marks(part.panel, part.edge), at);
    for (int round = 0; round < kRounds && carry_marks(); ++round) {
    }
    CutGarment out;
    for (std::size_t p = 0; p < garment_.panels.size(); ++p) out.panels.push_back(cut_panel(p));
    for (std::size_t s = 0; s < garment_.seams.size(); ++s)
      if (!sew(static_cast<int>(s), out)) out.left_out.push_back(static_cast<int>(s));
    sew_darts(out);
    return out;
  }

 private:
  void start_panel(const Panel& panel) {
    auto& marks = marks_.emplace_back();
    auto& mouths = mouths_.emplace_back(panel.edges.size());
    for (const design::Edge& edge : panel.edges) {
      Marks& of_edge = marks.emplace_back(Marks{0, edge.curve.length()});
      if (is_chain(edge.curve)) {
        double at = 0;
        for (const geometry::Curve& link : edge.curve.elements()) add_mark(of_edge, at += link.length());
      }
    }
    for (std::size_t d = 0; d < panel.darts.size(); ++d) {
      const design::EdgeDart& dart = panel.darts[d];
      const int edge = outline_edge(panel, dart.edge);
      if (edge < 0 || dart.width <= kSamePosition) continue;
      const auto e = static_cast<std::size_t>(edge);
      mouths[e].push_back({std::max(0.0, dart.at - dart.width / 2),
                           std::min(panel.edges[e].curve.length(), dart.at + dart.width / 2),
                           static_cast<int>(d)});
      for (double at : {mouths[e].back().from, mouths[e].back().to}) add_mark(marks[e], at);
    }
    for (auto& list : mouths)
      std::sort(list.begin(), list.end(), [](const Mouth& a, const Mouth& b) { return a.from < b.from; });
  }

  Marks& marks(int panel, int edge) {
    return marks_[static_cast<std::size_t>(panel)][static_cast<std::size_t>(edge)];
  }
  const std::vector<Mouth>& mouths(int panel, int edge) const {
    return mouths_[static_cast<std::size_t>(panel)][static_cast<std::size_t>(edge)];
  }

  bool known(const EdgePart& part) const {
    return part.on == EdgePart::On::outline && part.panel >= 0 &&
           part.panel < static_cast<int>(garment_.panels.size()) && part.edge >= 0 &&
           part.edge < static_cast<int>(garment_.panels[static_cast<std::size_t>(part.panel)].edges.size());
  }

  bool in_mouth(int panel, int edge, double at) const {
    for (const Mouth& m : mouths(panel, edge))
      if (at > m.from && at < m.to) return true;
    return false;
  }

  /// The side as stretches between marks, mouths left out, in sewing order.
  std::vector<Stretch> stretches(const design::SeamSide& side) {
    std::vector<Stretch> out;
    for (std::size_t k = 0; k < side.parts.size(); ++k) {
      const EdgePart& part = side.parts[k];
      if (!known(part)) return {};
      const double low = std::min(part.from, part.to), high = std::max(part.from, part.to);
      std::vector<Stretch> of_part;
      const Marks& at = marks(part.panel, part.edge);
      for (std::size_t i = 0; i + 1 < at.size(); ++i) {
        if (at[i] < low - kSamePosition || at[i + 1] > high + kSamePosition) continue;
        if (in_mouth(part.panel, part.edge, (at[i] + at[i + 1]) / 2)) continue;
        of_part.push_back(
            {part.panel, part.edge, at[i], at[i + 1], (at[i + 1] - at[i]) / side.fullness_of(k)});
      }
      if (part.from > part.to) {
        std::reverse(of_part.begin(), of_part.end());
        for (Stretch& s : of_part) std::swap(s.from, s.to);
      }
      out.insert(out.end(), of_part.begin(), of_part.end());
    }
    return out;
  }

  static double sum(const std::vector<Stretch>& side) {
    double all = 0;
    for (const Stretch& s : side) all += s.sewn;
    return all;
  }

  /// Marks on `to` where `from` has corners; true if there were new ones.
  bool carry(const std::vector<Stretch>& from, const std::vector<Stretch>& to) {
    const double scale = sum(to) / sum(from);
    bool news = false;
    double at = 0;
    for (std::size_t i = 0; i + 1 < from.size(); ++i) {
      at += from[i].sewn * scale;
      double start = 0;
      for (const Stretch& s : to) {
        if (at > start + kSamePosition && at < start + s.sewn - kSamePosition) {
          Marks& list = marks(s.panel, s.edge);
          const std::size_t before = list.size();
          add_mark(list, s.from + (s.to - s.from) * (at - start) / s.sewn);
          news = news || list.size() > before;
          break;
        }
        start += s.sewn;
      }
    }
    return news;
  }

  bool carry_marks() {
    bool news = false;
    for (const design::Seam& seam : garment_.seams)
      for (std::size_t i = 0; i + 1 < seam.sides.size(); ++i) {
        const std::vector<Stretch> a = stretches(seam.sides[i]), b = stretches(seam.sides.back());
        if (a.empty() || b.empty()) continue;
        news = carry(a, b) || news;
        news = carry(stretches(seam.sides.back()), stretches(seam.sides[i])) || news;
      }
    return news;
  }

  CutPanel cut_panel(std::size_t p) const {
    const Panel& panel = garment_.panels[p];
    CutPanel out;
    for (std::size_t e = 0; e < panel.edges.size(); ++e) {
      const Marks& at = marks_[p][e];
      const geometry::Curve& curve = panel.edges[e].curve;
      for (std::size_t i = 0; i + 1 < at.size(); ++i) {
        const Mouth* mouth = nullptr;
        for (const Mouth& m : mouths_[p][e])
          if ((at[i] + at[i + 1]) / 2 > m.from && (at[i] + at[i + 1]) / 2 < m.to) mouth = &m;
        if (!mouth) {
          out.edges.push_back({static_cast<int>(e), at[i], at[i + 1], -1,
                               at.size() == 2 ? curve : simple_part(curve, at[i], at[i + 1])});
        } else if (out.edges.empty() || out.edges.back().dart != mouth->dart) {
          const Point2 tip = dart_tip(panel, panel.darts[static_cast<std::size_t>(mouth->dart)]);
          for (const geometry::Curve& leg : {geometry::Curve(curve.point_at(mouth->from), tip),
                                             geometry::Curve(tip, curve.point_at(mouth->to))})
            out.edges.push_back({static_cast<int>(e), 0, leg.length(), mouth->dart, leg});
        }
      }
    }
    return out;
  }

  static int find(const CutPanel& panel, const Stretch& s) {
    const double low = std::min(s.from, s.to), high = std::max(s.from, s.to);
    for (std::size_t i = 0; i < panel.edges.size(); ++i) {
      const CutEdge& e = panel.edges[i];
      if (e.edge == s.edge && e.dart < 0 && std::fabs(e.from - low) < kSamePosition &&
          std::fabs(e.to - high) < kSamePosition)
        return static_cast<int>(i);
    }
    return -1;
  }

  bool sew(int number, CutGarment& out) {
    const design::Seam& seam = garment_.seams[static_cast<std::size_t>(number)];
    bool whole = seam.sides.size() >= 2;
    for (std::size_t side = 0; side + 1 < seam.sides.size(); ++side) {
      const std::vector<Stretch> a = stretches(seam.sides[side]), b = stretches(seam.sides.back());
      if (a.empty() || a.size() != b.size()) {
        whole = false;
        continue;
      }
      for (std::size_t k = 0; k < a.size(); ++k) {
        CutStitch stitch;
        stitch.seam = number;
        stitch.start_to_start = (a[k].from < a[k].to) == (b[k].from < b[k].to);
        const Stretch* both[2] = {&a[k], &b[k]};
        for (int i = 0; i < 2; ++i) {
          stitch.panel[i] = both[i]->panel;
          stitch.edge[i] = find(out.panels[static_cast<std::size_t>(both[i]->panel)], *both[i]);
        }
        if (stitch.edge[0] >= 0 && stitch.edge[1] >= 0)
          out.stitches.push_back(stitch);
        else
          whole = false;
      }
    }
    return whole;
  }

  void sew_darts(CutGarment& out) const {
    for (std::size_t p = 0; p < out.panels.size(); ++p) {
      const int panel = static_cast<int>(p);
      const std::vector<CutEdge>& edges = out.panels[p].edges;
      for (std::size_t e = 0; e + 1 < edges.size(); ++e)
        if (edges[e].dart >= 0 && edges[e + 1].dart == edges[e].dart) {
          out.stitches.push_back({{panel, panel}, {static_cast<int>(e), static_cast<int>(e + 1)}, false, -1});
          ++e;
        }
      for (const design::LegDart& dart : garment_.panels[p].leg_darts) {
        CutStitch stitch{{panel, panel}, {-1, -1}, false, -1};
        for (std::size_t e = 0; e < edges.size(); ++e)
          for (int i = 0; i < 2; ++i)
            if (edges[e].edge == outline_edge(garment_.panels[p], i == 0 ? dart.leg_a : dart.leg_b))
              stitch.edge[i] = static_cast<int>(e);
        if (stitch.edge[0] >= 0 && stitch.edge[1] >= 0) out.stitches.push_back(stitch);
      }
    }
  }

  const design::Garment& garment_;
  std::vector<std::vector<Marks>> marks_;                // [panel][edge]
  std::vector<std::vector<std::vector<Mouth>>> mouths_;  // [panel][edge], in order
};

}  // namespace

CutGarment cut_garment(const design::Garment& garment) { return Divider(garment).divide(); }

Point2 dart_tip(const Panel& panel, const design::EdgeDart& dart) {
  if (dart.apex) return *dart.apex;
  const int edge = outline_edge(panel, dart.edge);
  if (edge < 0) return {0, 0};
  double area = 0;
  for (const design::Edge& e : panel.edges) area += e.curve.area_term();
  const geometry::Curve& curve = panel.edges[static_cast<std::size_t>(edge)].curve;
  const Point2 t = curve.tangent_at(dart.at);
  return curve.point_at(dart.at) + (area < 0 ? -dart.depth : dart.depth) * Point2(-t.y(), t.x());
}

int outline_edge(const Panel& panel, const std::string& name) {
  for (std::size_t e = 0; e < panel.edges.size(); ++e)
    if (panel.edges[e].name == name) return static_cast<int>(e);
  return -1;
}

}  // namespace garment::io
