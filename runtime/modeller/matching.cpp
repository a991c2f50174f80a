#include "runtime/modeller/matching.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace garment::modeller {
namespace {

constexpr int kMaxRounds = 60;
constexpr std::size_t kMaxBreaks = 20000;

/// A break as a side meets it. Where two segments join it is the end of the one before `segment`, too.
struct Stop {
  double fraction;
  std::size_t segment;  ///< the segment that starts here or contains it; the last one at the end
  double t;
};

std::vector<Stop> stops_of(const Side& side, const std::vector<BorderPanel>& panels) {
  std::vector<Stop> stops;
  for (std::size_t k = 0; k < side.segments.size(); ++k) {
    const SideSegment& s = side.segments[k];
    const std::vector<double>& breaks = panels[s.panel].outline.pieces[s.piece].breaks;
    double low = std::min(s.t0, s.t1), high = std::max(s.t0, s.t1);
    std::vector<Stop> inside;
    for (double b : breaks)
      if (b >= low && b < high) inside.push_back({0, k, b});
    if (s.t0 > s.t1) {  // walked backwards: from t0 = high down, without t1 = low
      inside.clear();
      for (double b : breaks)
        if (b > low && b <= high) inside.push_back({0, k, b});
      std::reverse(inside.begin(), inside.end());
    }
    for (Stop& stop : inside) {
      stop.fraction = (s.begin + std::abs(stop.t - s.t0) / s.fullness) / side.length;
      stops.push_back(stop);
    }
  }
  stops.push_back({1, side.segments.size() - 1, side.segments.back().t1});
  return stops;
}

/// Stops of several sides taken for one place; index into each side's stops, -1 where a side has none.
struct Cluster {
  double fraction;
  std::vector<int> stop;
};

std::vector<Cluster> cluster(const std::vector<std::vector<Stop>>& stops, double tolerance) {
  struct Entry {
    double fraction;
    int side, index;
  };
  std::vector<Entry> entries;
  int n = static_cast<int>(stops.size());
  for (int s = 0; s < n; ++s)
    for (int i = 1; i + 1 < static_cast<int>(stops[s].size()); ++i)
      entries.push_back({stops[s][i].fraction, s, i});
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    if (a.fraction != b.fraction) return a.fraction < b.fraction;
    return a.side != b.side ? a.side < b.side : a.index < b.index;
  });
  std::vector<Cluster> result{{0, std::vector<int>(n, 0)}};
  for (const Entry& e : entries) {
    bool fits = result.size() > 1 && result.back().stop[e.side] < 0 &&
                e.fraction - result.back().fraction <= tolerance;
    if (!fits) result.push_back({e.fraction, std::vector<int>(n, -1)});
    result.back().stop[e.side] = e.index;
  }
  Cluster last{1, {}};
  for (const auto& s : stops) last.stop.push_back(static_cast<int>(s.size()) - 1);
  result.push_back(std::move(last));
  return result;
}

double tolerance_of(const Matching& m, const std::vector<BorderPanel>& panels) {
  double most = 0;
  for (const Side& side : m.sides)
    for (const SideSegment& s : side.segments) most = std::max(most, side.length / panels[s.panel].h);
  return kSnap / most;
}

/// Adds a break to `side` at `fraction`; false if there is one already.
bool add_break(const Side& side, double fraction, std::vector<BorderPanel>& panels) {
  double along = fraction * side.length;
  std::size_t k = 0;
  while (k + 1 < side.segments.size() && along >= side.segments[k + 1].begin) ++k;
  const SideSegment& s = side.segments[k];
  double ahead = std::clamp((along - s.begin) * s.fullness, 0.0, s.length());
  double t = s.t0 < s.t1 ? s.t0 + ahead : s.t0 - ahead;
  std::vector<double>& breaks = panels[s.panel].outline.pieces[s.piece].breaks;
  auto next = std::lower_bound(breaks.begin(), breaks.end(), t);
  double least = 1e-7 * panels[s.panel].h;
  if ((next != breaks.end() && *next - t < least) || (next != breaks.begin() && t - *(next - 1) < least))
    return false;
  breaks.insert(next, t);
  return true;
}

enum class Round { settled, added, stuck };

Round carry_breaks(const Matching& m, std::vector<BorderPanel>& panels) {
  std::vector<std::vector<Stop>> stops;
  for (const Side& side : m.sides) stops.push_back(stops_of(side, panels));
  std::vector<Cluster> clusters = cluster(stops, tolerance_of(m, panels));
  Round outcome = Round::settled;
  for (std::size_t s = 0; s < m.sides.size(); ++s) {
    std::size_t before = 0;  // the last cluster that this side has
    for (std::size_t c = 1; c < clusters.size(); ++c) {
      if (clusters[c].stop[s] < 0) continue;
      double f0 = stops[s][clusters[before].stop[s]].fraction, f1 = stops[s][clusters[c].stop[s]].fraction;
      double g0 = clusters[before].fraction, g1 = clusters[c].fraction;
      for (std::size_t missing = before + 1; missing < c; ++missing) {
        double share = g1 > g0 ? (clusters[missing].fraction - g0) / (g1 - g0) : 0.5;
        if (!add_break(m.sides[s], f0 + share * (f1 - f0), panels)) return Round::stuck;
        outcome = Round::added;
      }
      before = c;
    }
  }
  return outcome;
}

/// Union-find with parity: `reversed` tells whether an element runs against its root.
class Groups {
 public:
  explicit Groups(std::size_t n) : parent_(n), flip_(n, 0) {
    for (std::size_t i = 0; i < n; ++i) parent_[i] = static_cast<int>(i);
  }
  std::pair<int, bool> root(int i) const {
    bool flip = false;
    while (parent_[i] != i) {
      flip ^= flip_[i] != 0;
      i = parent_[i];
    }
    return {i, flip};
  }
  /// False where the two are known to run the other way.
  bool join(int a, int b, bool opposite) {
    auto [ra, fa] = root(a);
    auto [rb, fb] = root(b);
    bool flip = fa ^ fb ^ opposite;
    if (ra == rb) return !flip;
    if (ra > rb) std::swap(ra, rb);
    parent_[rb] = ra;  // the smallest index is the root: numbering does not depend on the order of joins
    flip_[rb] = flip;
    return true;
  }

 private:
  std::vector<int> parent_;
  std::vector<char> flip_;
};

void report_unmatched(const Matching& m, const char* why, Findings& findings) {
  findings.push_back({"G0550",
                      Severity::error,
                      fmt::format("the sides of seam `{}` cannot be matched: {}", m.name, why),
                      {{m.origin, ""}},
                      "check which parts of which edges the seams sew, and in which direction"});
}

}  // namespace

bool match_stretches(const std::vector<Matching>& matchings, std::vector<BorderPanel>& panels,
                     Matched& matched, Findings& findings) {
  for (int round = 0;; ++round) {
    bool added = false;
    for (const Matching& m : matchings) {
      Round outcome = carry_breaks(m, panels);
      std::size_t breaks = 0;
      for (const SideSegment& s : m.sides[0].segments)
        breaks += panels[s.panel].outline.pieces[s.piece].breaks.size();
      if (outcome == Round::stuck || breaks > kMaxBreaks || round == kMaxRounds) {
        report_unmatched(m, "seams divide the edges without end", findings);
        return false;
      }
      added = added || outcome == Round::added;
    }
    if (!added) break;
  }
  std::vector<std::vector<int>> first(panels.size());
  for (std::size_t p = 0; p < panels.size(); ++p) {
    const std::vector<Piece>& pieces = panels[p].outline.pieces;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      first[p].push_back(static_cast<int>(matched.stretches.size()));
      for (std::size_t b = 0; b + 1 < pieces[k].breaks.size(); ++b)
        matched.stretches.push_back({static_cast<int>(p), static_cast<int>(k), b, -1, false});
    }
  }
  Groups groups(matched.stretches.size());
  for (const Matching& m : matchings) {
    std::vector<StretchTuple> tuples;
    for (std::size_t s = 0; s < m.sides.size(); ++s) {
      std::vector<Stop> stops = stops_of(m.sides[s], panels);
      tuples.resize(stops.size() - 1);
      for (std::size_t k = 0; k + 1 < stops.size(); ++k) {
        const SideSegment& segment = m.sides[s].segments[stops[k].segment];
        const std::vector<double>& breaks = panels[segment.panel].outline.pieces[segment.piece].breaks;
        auto at = std::lower_bound(breaks.begin(), breaks.end(), stops[k].t) - breaks.begin();
        bool forward = segment.t0 < segment.t1;
        tuples[k].stretch.push_back(first[segment.panel][segment.piece] +
                                    static_cast<int>(forward ? at : at - 1));
        tuples[k].forward.push_back(forward);
      }
    }
    for (const StretchTuple& tuple : tuples) {
      for (std::size_t s = 1; s < m.sides.size(); ++s) {
        if (groups.join(tuple.stretch[0], tuple.stretch[s], tuple.forward[0] != tuple.forward[s])) continue;
        report_unmatched(m, "an edge is sewn to itself back to front", findings);
        return false;
      }
    }
    matched.tuples.push_back(std::move(tuples));
  }
  std::vector<int> number(matched.stretches.size(), -1);
  for (std::size_t i = 0; i < matched.stretches.size(); ++i) {
    auto [root, flip] = groups.root(static_cast<int>(i));
    if (number[root] < 0) number[root] = matched.n_groups++;
    matched.stretches[i].group = number[root];
    matched.stretches[i].reversed = flip;
  }
  return true;
}

}  // namespace garment::modeller
