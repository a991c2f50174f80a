// What seams, attachments, hems and zips leave of the edges, and what two seams sew.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "interpreter/language/edges.hpp"
#include "interpreter/language/parts.hpp"
#include "interpreter/language/seams.hpp"
#include "interpreter/language/word_lists.hpp"

namespace garment::interpreter {
namespace {

using design::EdgePart;

constexpr double kUnsewn = 2e-3;        // m of an edge that may stay unsewn unsaid
constexpr std::size_t kMostLabels = 6;  // edges of one panel that are shown in the text

struct Interval {
  double from, to;
  int seam;
};

/// By panel, kind of edge and index there.
using Cover = std::map<std::array<int, 3>, std::vector<Interval>>;

std::array<int, 3> key_of(const EdgePart& part) { return {part.panel, static_cast<int>(part.on), part.edge}; }

void cover(Cover& all, const EdgePart& part, int seam) {
  all[key_of(part)].push_back({std::min(part.from, part.to), std::max(part.from, part.to), seam});
}

/// Length of an edge that nothing covers; the mouths of darts count as covered.
double uncovered(const PanelInfo& info, const EdgePart& part, std::vector<Interval> covers) {
  const design::Edge& e = design::edge_of(info.panel, part);
  for (const design::EdgeDart& dart : info.panel.darts)
    if (dart.edge == e.name) covers.push_back({dart.at - dart.width / 2, dart.at + dart.width / 2, -1});
  for (const design::LegDart& dart : info.panel.leg_darts)
    if (dart.leg_a == e.name || dart.leg_b == e.name) covers.push_back({0, e.curve.length(), -1});
  std::sort(covers.begin(), covers.end(),
            [](const Interval& a, const Interval& b) { return a.from < b.from; });
  double open = 0, reached = 0;
  for (const Interval& c : covers) {
    open += std::max(0.0, c.from - reached);
    reached = std::max(reached, c.to);
  }
  return open + std::max(0.0, e.curve.length() - reached);
}

void warn_sewn_twice(Program& program, const Cover& all) {
  for (const auto& [key, covers] : all)
    for (std::size_t i = 0; i < covers.size(); ++i)
      for (std::size_t j = i + 1; j < covers.size(); ++j) {
        const Interval &a = covers[i], &b = covers[j];
        if (a.seam < 0 || b.seam < 0 || a.seam == b.seam) continue;
        if (std::min(a.to, b.to) - std::max(a.from, b.from) < kUnsewn) continue;
        const SeamInfo &one = program.seams[static_cast<std::size_t>(a.seam)],
                       &two = program.seams[static_cast<std::size_t>(b.seam)];
        const std::string edge =
            name_of_part(program, {key[0], key[2], 0, 0, static_cast<EdgePart::On>(key[1])});
        PartGuard guard(program, two.part);
        report(program, Message("G0508",
                                "edge `" + edge + "` is sewn by seam `" + one.seam.name + "` and by seam `" +
                                    two.seam.name + "`",
                                two.spans[0])
                            .also(one.spans[0], "first here")
                            .help("one seam may have more than two sides: `seam NAME: A to B to C`")
                            .warning());
      }
}

Cover cover_of(const Program& program) {
  Cover all;
  for (std::size_t k = 0; k < program.seams.size(); ++k)
    for (const design::SeamSide& side : program.seams[k].seam.sides)
      for (const EdgePart& part : side.parts) cover(all, part, static_cast<int>(k));
  return all;
}

/// Adds what holds an edge without sewing it to another one.
void cover_held(const Program& program, Cover& all) {
  for (const design::Attachment& attachment : program.garment.attachments)
    for (const EdgePart& part : attachment.parts) cover(all, part, -1);
  for (const design::Hem& hem : program.garment.hems)
    for (const EdgePart& part : hem.parts) cover(all, part, -1);
  for (const design::Zip& zip : program.garment.zips)
    for (const std::vector<EdgePart>& side : zip.sides)
      for (const EdgePart& part : side) cover(all, part, -1);
}

/// An edge with a stretch that nothing sews.
struct OpenEdge {
  std::string name;  ///< in the panel, "left.side"
  Span span;
  double open = 0;   ///< m
  bool whole = false;

  std::string text(const std::string& prefix) const {
    return (whole ? "" : format_quantity(open, kLength) + " of ") + "`" + prefix + name + "`";
  }
};

class OpenEdges {
 public:
  OpenEdges(const PanelInfo& info, const Cover& all) : info_(info), all_(all) {}

  /// In drawn order; both halves of an edge that are open alike are one.
  std::vector<OpenEdge> find() {
    for (const NamedEdge& edge : info_.edges) {
      if (edge.half == "right" || (edge.half.empty() && info_.folded)) continue;
      const double open = open_length(edge);
      const NamedEdge* twin = edge.half.empty() ? nullptr : find_edge(info_, "right", edge.name);
      const double other = twin == nullptr ? 0 : open_length(*twin);
      if (twin != nullptr && is_whole(edge, open) && is_whole(*twin, other)) {
        add(edge, "", open);
        continue;
      }
      add(edge, edge.half, open);
      if (twin != nullptr) add(*twin, "right", other);
    }
    return std::move(found_);
  }

 private:
  double open_length(const NamedEdge& edge) const {
    double open = 0;
    for (const EdgePart& part : edge.parts) {
      if (part.on == EdgePart::On::line || design::edge_of(info_.panel, part).free) continue;
      const auto covers = all_.find(key_of(part));
      open += uncovered(info_, part, covers == all_.end() ? std::vector<Interval>{} : covers->second);
    }
    return open;
  }

  static bool is_whole(const NamedEdge& edge, double open) {
    double length = 0;
    for (const EdgePart& part : edge.parts) length += std::fabs(part.to - part.from);
    return open > length - kUnsewn;
  }

  void add(const NamedEdge& edge, const std::string& half, double open) {
    if (open > kUnsewn)
      found_.push_back({(half.empty() ? "" : half + '.') + edge.name, edge.span, open, is_whole(edge, open)});
  }

  const PanelInfo& info_;
  const Cover& all_;
  std::vector<OpenEdge> found_;
};

/// One warning for a panel, however many of its edges are open.
void warn_of(Program& program, const design::Panel& panel, const std::vector<OpenEdge>& open) {
  if (open.empty()) return;
  if (open.size() == 1) {
    const OpenEdge& edge = open[0];
    const std::string name = "`" + panel.name + '.' + edge.name + "`";
    return report(program, Message("G0505",
                                   (edge.whole ? "edge " : format_quantity(edge.open, kLength) + " of edge ") + name +
                                       " is neither sewn nor attached",
                                   edge.span)
                               .warning()
                               .help("sew it, attach it, or mark it `free`"));
  }
  std::vector<std::string> names;
  for (const OpenEdge& edge : open) names.push_back(edge.text(""));
  Message message("G0505", "edges of panel `" + panel.name + "` are neither sewn nor attached: " + enumerated(names),
                  open[0].span);
  for (std::size_t k = 1; k < std::min(open.size(), kMostLabels); ++k) message.also(open[k].span, "");
  report(program, message.warning().help("sew them, attach them, or mark each `free`"));
}

}  // namespace

void check_unsewn(Program& program) {
  Cover all = cover_of(program);
  warn_sewn_twice(program, all);
  cover_held(program, all);
  for (const PanelInfo& info : program.panels) {
    PartGuard guard(program, info.part);
    warn_of(program, info.panel, OpenEdges(info, all).find());
  }
}

}  // namespace garment::interpreter
