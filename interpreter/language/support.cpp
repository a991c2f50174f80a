#include "interpreter/language/support.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include "interpreter/language/edges.hpp"
#include "runtime/body/frame.hpp"

namespace garment::interpreter {
namespace {

using design::Placement;

constexpr double kShoulder = 0.04;  // m below the shoulder level that count as shoulders

/// Panels that are joined, by the smallest index of each group.
class Groups {
 public:
  explicit Groups(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
  std::size_t of(std::size_t k) const {
    while (parent_[k] != k) k = parent_[k];
    return k;
  }
  void join(int a, int b) {
    if (a < 0 || b < 0) return;
    const std::size_t x = of(static_cast<std::size_t>(a)), y = of(static_cast<std::size_t>(b));
    parent_[std::max(x, y)] = std::min(x, y);
  }

 private:
  std::vector<std::size_t> parent_;
};

Groups joined_panels(const Program& program) {
  Groups groups(program.panels.size());
  for (const SeamInfo& info : program.seams)
    for (const design::SeamSide& side : info.seam.sides)
      for (const design::EdgePart& part : side.parts)
        groups.join(info.seam.sides[0].parts[0].panel, part.panel);
  for (const design::Zip& zip : program.garment.zips)
    for (const auto& side : zip.sides)
      for (const design::EdgePart& part : side) groups.join(zip.sides[0][0].panel, part.panel);
  for (const design::Button& button : program.garment.buttons)
    for (const design::ButtonHole& hole : button.holes) groups.join(button.panel, hole.panel);
  for (const design::Tack& tack : program.garment.tacks) groups.join(tack.panel[0], tack.panel[1]);
  return groups;
}

/// The edges of a panel that lie at its level, both halves where there are two; m.
double level_length(const PanelInfo& info, const std::string& edge) {
  double longest = 0;
  for (const NamedEdge& named : info.edges) {
    const bool holds = std::any_of(named.parts.begin(), named.parts.end(), [&](const design::EdgePart& part) {
      return part.on == design::EdgePart::On::outline &&
             info.panel.edges[static_cast<std::size_t>(part.edge)].name == edge;
    });
    if (!holds) continue;
    double length = 0;
    for (const NamedEdge& other : info.edges)
      if (other.name == named.name && other.half.empty() == named.half.empty())
        for (const design::EdgePart& part : other.parts) length += std::fabs(part.to - part.from);
    longest = std::max(longest, length);
  }
  return longest;
}

/// How far a placed panel reaches above the level of its edge, m.
double reach_above(const PanelInfo& info, const std::string& edge) {
  double top = -1e300, sum = 0;
  int n = 0;
  for (const design::Edge& e : info.panel.edges)
    for (const design::Point2& p : e.curve.polyline(1e-3)) {
      top = std::max(top, p.y());
      if (e.name == edge) sum += p.y(), ++n;
    }
  return n > 0 ? top - sum / n : 0;
}

struct TopRing {
  double height = -1e300, length = 0;
  std::string level;
  Span span;
  int body = -1;
};

int body_index(const Program& program, const std::string& name) {
  for (std::size_t k = 0; k < program.garment.bodies.size(); ++k)
    if (program.garment.bodies[k].name == name) return static_cast<int>(k);
  return -1;
}

class SupportCheck {
 public:
  explicit SupportCheck(Program& program) : program_(program), groups_(joined_panels(program)) {}

  void run() {
    held_.assign(program_.panels.size(), 0);
    for (const design::Attachment& attachment : program_.garment.attachments)
      for (const design::EdgePart& part : attachment.parts) hold(part.panel);
    for (const design::Pin& pin : program_.garment.pins) hold(pin.panel);
    for (const Declaration& declaration : program_.declarations) hold_by_clamps(declaration);
    for (std::size_t p = 0; p < program_.panels.size(); ++p)
      if (groups_.of(p) == p && !held_[p]) check_group(p);
  }

 private:
  void hold(int panel) {
    if (panel >= 0) held_[groups_.of(static_cast<std::size_t>(panel))] = 1;
  }

  /// Clamps and constraints hold what they speak of; which panels these are is theirs to know.
  void hold_by_clamps(const Declaration& declaration) {
    if (declaration.statement == nullptr) return;
    const std::string& keyword = declaration.statement->keyword.text;
    if (keyword == "clamp") std::fill(held_.begin(), held_.end(), 1);
  }

  /// The measures of a mannequin; nothing for other bodies.
  const body::Frame* frame_of(int index) {
    const auto [found, inserted] = frames_.try_emplace(index);
    if (inserted)
      found->second = body::make_frame(program_.garment.bodies[static_cast<std::size_t>(index)]).frame;
    return found->second ? &*found->second : nullptr;
  }

  void check_group(std::size_t group) {
    std::vector<std::size_t> members;
    for (std::size_t p = 0; p < program_.panels.size(); ++p)
      if (groups_.of(p) == group) members.push_back(p);
    if (program_.garment.bodies.empty()) return fall_freely(members);
    const auto ring = top_ring(members);
    if (!ring) return;
    double widest = 0;
    std::string name;
    for (const auto& [key, level] : frame_of(ring->body)->levels)
      if (level.height && level.girth && *level.height <= ring->height + 0.01 && *level.girth > widest)
        widest = *level.girth, name = key;
    if (widest == 0 || ring->length < widest) return;
    report(program_, Message("G0515",
                             "nothing holds these pieces up: their ring at the " + ring->level + " is " +
                                 format_quantity(ring->length, kLength) +
                                 ", and the body below is nowhere wider than " +
                                 format_quantity(widest, kLength) + " (" + name + ")",
                             ring->span)
                         .warning()
                         .help("attach an edge: `attach PANEL.EDGE to BODY." + ring->level +
                               " slide`; or pin it, or make the ring narrower"));
  }

  void fall_freely(const std::vector<std::size_t>& members) {
    const PanelInfo& info = program_.panels[members[0]];
    if (info.panel.placement.kind == Placement::Kind::none) return;
    report(program_,
           Message("G0515",
                   "nothing holds `" + info.panel.name +
                       "` up: it is neither attached nor pinned, and there is "
                       "no body to lie on",
                   program_.origins[info.panel.placement.origin.value])
               .warning()
               .help("pin it, `pin NAME on " + info.panel.name + " at POINT`, or declare a body below it"));
  }

  /// The topmost ring of the pieces; nothing where they are held by what can be told, or too little is said.
  std::optional<TopRing> top_ring(const std::vector<std::size_t>& members) {
    TopRing ring;
    for (std::size_t p : members) {
      const PanelInfo& info = program_.panels[p];
      const Placement& place = info.panel.placement;
      if (place.kind == Placement::Kind::none) continue;
      const int index = body_index(program_, place.body);
      if (place.edge.empty() || index < 0) return std::nullopt;
      if (place.part.find('.') != std::string::npos || place.part == "neck" || place.part == "head")
        return std::nullopt;
      const Span span = program_.origins[place.origin.value];
      const body::Frame* person = frame_of(index);
      if (person == nullptr) return std::nullopt;
      const auto level = person->levels.find(place.level), shoulder = person->levels.find("shoulder");
      if (level == person->levels.end() || !level->second.height || shoulder == person->levels.end() ||
          !shoulder->second.height)
        return std::nullopt;
      const double height = *level->second.height;
      if (height + reach_above(info, place.edge) > *shoulder->second.height - kShoulder) return std::nullopt;
      if (height > ring.height + 1e-6) ring = {height, 0, place.level, span, index};
      if (height > ring.height - 1e-6) ring.length += level_length(info, place.edge);
    }
    if (ring.body < 0) return std::nullopt;
    return ring;
  }

  Program& program_;
  Groups groups_;
  std::vector<char> held_;
  std::map<int, std::optional<body::Frame>> frames_;
};

}  // namespace

void check_support(Program& program) {
  // What is let fall for a time may fall.
  const bool drapes = std::any_of(program.acts.begin(), program.acts.end(), [](const Act& act) {
    const auto* drape = std::get_if<DrapeAct>(&act.act);
    return drape != nullptr && drape->until_rest;
  });
  if (!drapes || program.garment.gravity.norm() == 0) return;
  SupportCheck(program).run();
}

}  // namespace garment::interpreter
