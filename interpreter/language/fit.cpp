#include "interpreter/language/fit.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "interpreter/language/edges.hpp"
#include "interpreter/language/parts.hpp"

namespace garment::interpreter {
namespace {

using design::Point2;

constexpr double kWindow = 0.03;     // m, how far up or down cloth may lie from where it is placed
constexpr int kRows = 7;             // heights tried in the window
constexpr double kLeastLack = 5e-3;  // m, a lack that is not worth a word
constexpr double kFlat = 2e-3;       // m, of an outline's polyline
constexpr const char* kLevels[] = {"bust", "underbust", "waist", "hip"};

/// Where an outline crosses a height: the edge, and how far along it.
struct HeightCrossing {
  int edge = -1;
  double at = 0, x = 0;
};

std::vector<HeightCrossing> crossings(const design::Panel& panel, double y) {
  std::vector<HeightCrossing> found;
  for (std::size_t e = 0; e < panel.edges.size(); ++e) {
    const auto& curve = panel.edges[e].curve;
    const double length = curve.length();
    const int n = std::clamp(static_cast<int>(length / 5e-3), 1, 400);
    for (int k = 0; k < n; ++k) {
      const double s = length * k / n, t = length * (k + 1) / n;
      const Point2 a = curve.point_at(s), b = curve.point_at(t);
      if ((a.y() < y) == (b.y() < y)) continue;
      const double share = (y - a.y()) / (b.y() - a.y());
      found.push_back({static_cast<int>(e), s + share * (t - s), a.x() + share * (b.x() - a.x())});
    }
  }
  std::sort(found.begin(), found.end(), [](const HeightCrossing& a, const HeightCrossing& b) { return a.x < b.x; });
  return found;
}

/// What the darts of a panel take out of its width at height y.
double taken_by_darts(const design::Panel& panel, double y) {
  double taken = 0;
  for (const design::EdgeDart& dart : panel.darts)
    for (const design::Edge& edge : panel.edges) {
      if (edge.name != dart.edge) continue;
      const Point2 mouth = edge.curve.point_at(dart.at);
      const double depth = dart.apex ? mouth.y() - dart.apex->y() : dart.depth;
      const double below = mouth.y() - y;
      if (std::fabs(depth) < 1e-6 || below / depth < 0 || below / depth > 1) continue;
      taken += dart.width * (1 - below / depth);
    }
  return taken;
}

double mean_height(const design::Panel& panel, const std::string& name) {
  double sum = 0, length = 0;
  for (const design::Edge& edge : panel.edges) {
    const bool half = edge.name.size() > name.size() && edge.name.ends_with("." + name);
    if (edge.name != name && !half) continue;
    constexpr int kPoints = 16;
    for (int k = 0; k <= kPoints; ++k)
      sum += edge.curve.point_at(edge.curve.length() * k / kPoints).y() * edge.curve.length() / (kPoints + 1);
    length += edge.curve.length();
  }
  return length > 0 ? sum / length : 0;
}

class BodyRing {
 public:
  BodyRing(Program& program, int body) : program_(program), body_(body) {}

  struct Level {
    const char* name;
    double height = 0, girth = 0;
  };

  void judge(const Level& level) {
    std::set<int> done;
    for (int p = 0; p < static_cast<int>(program_.panels.size()); ++p) {
      if (done.contains(p) || !is_placed(p)) continue;
      std::vector<int> panels;
      double widest = 0, stretch = 0;
      for (int row = 0; row < kRows; ++row) {
        const double offset = kWindow * (2.0 * row / (kRows - 1) - 1);
        std::vector<int> ring;
        double allowed = 0;
        const double width = round(p, level.height + offset, ring, allowed);
        if (ring.size() < 2) continue;
        if (width > widest) panels = ring, widest = width, stretch = allowed;
      }
      if (panels.empty()) continue;
      done.insert(panels.begin(), panels.end());
      const double most = widest * (1 + stretch);
      if (most >= level.girth - kLeastLack) continue;
      tell(level, panels, widest, stretch);
    }
  }

 private:
  const design::Panel& panel(int p) const { return program_.panels[static_cast<std::size_t>(p)].panel; }

  bool is_placed(int p) const {
    const PanelInfo& info = program_.panels[static_cast<std::size_t>(p)];
    const design::Placement& place = info.panel.placement;
    const std::string& name = program_.garment.bodies[static_cast<std::size_t>(body_)].name;
    const bool side =
        place.part == "front" || place.part == "back" || place.part == "left" || place.part == "right";
    return info.ready && place.kind == design::Placement::Kind::on_part && place.body == name && side &&
           !place.edge.empty() && heights_.contains(place.level);
  }

  /// The panel's own y at a height of the body.
  double own_y(int p, double height) const {
    const design::Placement& place = panel(p).placement;
    return height - heights_.at(place.level) + mean_height(panel(p), place.edge);
  }

  /// The panel and edge that the point of an edge is sewn to.
  std::optional<std::pair<int, int>> partner(int p, const HeightCrossing& at) const {
    for (const SeamInfo& info : program_.seams) {
      if (!info.ready) continue;
      for (std::size_t s = 0; s < info.seam.sides.size(); ++s)
        for (const design::EdgePart& part : info.seam.sides[s].parts) {
          if (part.on != design::EdgePart::On::outline || part.panel != p || part.edge != at.edge) continue;
          if (at.at < std::min(part.from, part.to) - 1e-3 || at.at > std::max(part.from, part.to) + 1e-3)
            continue;
          for (std::size_t other = 0; other < info.seam.sides.size(); ++other)
            for (const design::EdgePart& meets : info.seam.sides[other].parts)
              if (other != s && meets.on == design::EdgePart::On::outline) return {{meets.panel, meets.edge}};
        }
    }
    return std::nullopt;
  }

  /// Walks round from panel to panel over the seams at one height. The sum of widths; an empty ring where it
  /// does not close.
  double round(int start, double height, std::vector<int>& ring, double& stretch) const {
    double width = 0, weighed = 0;
    int at = start, entered = -1;
    for (std::size_t k = 0; k <= program_.panels.size(); ++k) {
      if (!is_placed(at)) break;
      const std::vector<HeightCrossing> cut = crossings(panel(at), own_y(at, height));
      if (cut.size() != 2 || cut[0].edge == cut[1].edge) break;
      const HeightCrossing& leave = entered < 0 || cut[0].edge == entered ? cut[1] : cut[0];
      if (entered >= 0 && cut[0].edge != entered && cut[1].edge != entered) break;
      const double own = cut[1].x - cut[0].x - taken_by_darts(panel(at), own_y(at, height));
      width += own;
      weighed += own * stretch_of(at);
      ring.push_back(at);
      const auto next = partner(at, leave);
      if (!next) break;
      at = next->first;
      entered = next->second;
      if (at == start) {
        stretch = width > 0 ? weighed / width : 0;
        return width;
      }
      if (std::find(ring.begin(), ring.end(), at) != ring.end()) break;
    }
    ring.clear();
    return 0;
  }

  /// How far the cloth goes across the panel at the load of EM.
  double stretch_of(int p) const {
    const int fabric = panel(p).fabric;
    if (fabric < 0 || fabric >= static_cast<int>(program_.garment.fabrics.size())) return 0;
    const design::Fabric& cloth = program_.garment.fabrics[static_cast<std::size_t>(fabric)];
    return std::max(cloth.tensile[0].max_strain, cloth.tensile[1].max_strain);
  }

  void tell(const Level& level, const std::vector<int>& panels, double width, double stretch) {
    std::string names;
    for (int p : panels) names += (names.empty() ? "`" : ", `") + panel(p).name + '`';
    const std::string body = program_.garment.bodies[static_cast<std::size_t>(body_)].name;
    PartGuard guard(program_, program_.panels[static_cast<std::size_t>(panels[0])].part);
    Message message("G0660",
                    "at the " + std::string(level.name) + " the garment is " +
                        format_quantity(width, kLength, false, 3) + " round; `" + body + "` is " +
                        format_quantity(level.girth, kLength, false, 3) + " there",
                    program_.origins[panel(panels[0]).origin.value], names + " together");
    message.warning().help("it lacks " + format_quantity(level.girth - width, kLength, false, 2) +
                           "; the cloth stretches by " + format_quantity(stretch, kNumber, true, 2) +
                           " at most: make the panels wider, or the size smaller");
    report(program_, message);
  }

 public:
  std::map<std::string, double> heights_;  ///< of the body's levels

 private:
  Program& program_;
  int body_;
};

}  // namespace

void check_fit(Program& program) {
  for (std::size_t b = 0; b < program.garment.bodies.size(); ++b) {
    const auto frame = program.frames.find(static_cast<int>(b));
    BodyRing ring(program, static_cast<int>(b));
    std::vector<BodyRing::Level> levels;
    auto add = [&](const std::string& name, std::optional<double> height, std::optional<double> girth) {
      if (!height) return;
      ring.heights_[name] = *height;
      for (const char* wanted : kLevels)
        if (name == wanted && girth) levels.push_back({wanted, *height, *girth});
    };
    if (frame != program.frames.end()) {
      for (const auto& [name, level] : frame->second.levels) add(name, level.height, level.girth);
    } else if (program.built[b] != nullptr) {
      for (const auto& [name, level] : program.built[b]->levels) add(name, level.height, level.girth);
    }
    for (const BodyRing::Level& level : levels) ring.judge(level);
  }
}

}  // namespace garment::interpreter
