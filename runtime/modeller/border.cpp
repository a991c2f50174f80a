#include "runtime/modeller/border.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "runtime/base/parallel.hpp"
#include "runtime/base/portable_math.hpp"

namespace garment::modeller {
namespace {

using Eigen::Vector2d;

constexpr double kLeastSpacing = 0.55;    // of h: least distance of border particles
constexpr double kLargestSpacing = 1.35;  // of h: largest one
constexpr double kFarthestTried = 3.2;    // of h: farthest candidate looked at
constexpr double kCollapse = 0.2;         // of h: a stretch shorter than this on all its sides becomes a point
constexpr double kReward = 0.15;          // of a particle on a grid line, in the cost's own measure
constexpr double kPenalty = 1e4;          // of a step under kLeastSpacing

/// Where a piece crosses the grid lines: position on the piece, and how squarely (square of the sine).
std::vector<std::array<double, 2>> grid_crossings(const Piece& piece, const GridFrame& frame) {
  double h = std::min(frame.hp, frame.hq), length = piece.length();
  int n = std::max(2, static_cast<int>(std::ceil(length / (h / 8))));
  auto lines = [&](double t) {
    Vector2d g = frame.to_grid(piece.at(t));
    return Vector2d(g.x() / frame.hp, g.y() / frame.hq);
  };
  std::vector<std::array<double, 2>> result;
  for (int axis = 0; axis < 2; ++axis) {
    double t_before = 0, g_before = std::numeric_limits<double>::quiet_NaN();
    for (int i = 0; i <= n; ++i) {
      double t = length * i / n, g = lines(t)[axis];
      if (std::abs(g - std::floor(g + 0.5)) < 1e-6)
        continue;  // on a line: a crossing only if it goes on beyond
      if (!std::isnan(g_before)) {
        int low = static_cast<int>(std::floor(std::min(g, g_before))),
            high = static_cast<int>(std::floor(std::max(g, g_before)));
        for (int line = low + 1; line <= high; ++line) {
          double a = t_before, b = t, fa = g_before - line, fb = g - line, x = b;
          for (int step = 0; step < 60 && b - a > 1e-15 * length; ++step) {  // Illinois
            x = b - fb * (b - a) / (fb - fa);
            double fx = lines(x)[axis] - line;
            if (std::abs(fx) < 1e-14) break;
            if ((fx > 0) == (fb > 0)) {
              fb = fx;
              b = x;
              fa *= 0.5;
            } else {
              fa = fx;
              a = x;
              fb *= 0.5;
            }
          }
          Vector2d chord = frame.to_grid(piece.at(t)) - frame.to_grid(piece.at(t_before));
          double square = chord[axis] * chord[axis] / std::max(1e-300, chord.squaredNorm());
          result.push_back({x, square});
        }
      }
      t_before = t;
      g_before = g;
    }
  }
  std::sort(result.begin(), result.end());
  return result;
}

/// Cheapest way to cross a gap of x spacings: number of equal steps.
int steps_for(double x, double& cost) {
  cost = std::numeric_limits<double>::infinity();
  int best = 1;
  for (int k = std::max(1, static_cast<int>(x)); k <= static_cast<int>(x) + 1; ++k) {
    double step = x / k, c = k * (step - 1) * (step - 1) / step;
    if (step < kLeastSpacing) c += kPenalty * (1 + kLeastSpacing - step);
    if (step > kLargestSpacing) c += 10 * (step - kLargestSpacing);
    if (c < cost) {
      cost = c;
      best = k;
    }
  }
  return best;
}

/// Who follows whom: the next vertex, and after the last of a loop its first, of a line nobody.
void close_loops(Border& border) {
  const auto n = static_cast<int>(border.at.size());
  border.next.resize(border.at.size());
  for (int k = 0; k < n; ++k) border.next[k] = k + 1;
  for (std::size_t l = 0; l < border.loops.size(); ++l)
    if (border.end_of(l) > border.loops[l]) border.next[border.end_of(l) - 1] = l < border.n_closed ? border.loops[l] : -1;
}

/// Vertices of one place become one.
void join_vertices(const Outline& outline, const std::vector<std::vector<int>>& vertex_at_break, Border& border) {
  border.same.resize(border.at.size());
  for (std::size_t k = 0; k < border.same.size(); ++k) border.same[k] = static_cast<int>(k);
  auto root = [&](int v) {
    while (border.same[v] != v) v = border.same[v];
    return v;
  };
  for (const Joint& joint : outline.joints) {
    int v[2];
    for (int e = 0; e < 2; ++e) {
      const std::vector<double>& breaks = outline.pieces[joint.piece[e]].breaks;
      const auto at = std::lower_bound(breaks.begin(), breaks.end(), joint.t[e] - 1e-12) - breaks.begin();
      v[e] = root(vertex_at_break[joint.piece[e]][std::min<std::size_t>(static_cast<std::size_t>(at), breaks.size() - 1)]);
    }
    border.same[std::max(v[0], v[1])] = std::min(v[0], v[1]);
  }
  for (std::size_t k = 0; k < border.same.size(); ++k) border.same[k] = root(static_cast<int>(k));
  for (std::size_t k = 0; k < border.same.size(); ++k) border.at[k] = border.at[border.same[k]];
}

}  // namespace

std::vector<double> choose_fractions(std::vector<std::array<double, 2>> candidates, double length) {
  std::sort(candidates.begin(), candidates.end());
  std::vector<std::array<double, 2>> nodes{{0, 0}};
  double least = 1e-4 / std::max(1.0, length);
  for (const auto& c : candidates)
    if (c[0] > nodes.back()[0] + least && c[0] < 1 - least) nodes.push_back(c);
  nodes.push_back({1, 0});
  std::size_t n = nodes.size();
  std::vector<double> best(n, std::numeric_limits<double>::infinity());
  std::vector<std::size_t> from(n, 0);
  best[0] = 0;
  for (std::size_t j = 1; j < n; ++j) {
    bool reached = false;  // without any gap under the least
    for (std::size_t i = j; i-- > 0;) {
      double x = (nodes[j][0] - nodes[i][0]) * length, cost;
      if (x > kFarthestTried && reached) break;
      reached = reached || (x >= kLeastSpacing && best[i] < kPenalty / 2);
      steps_for(x, cost);
      cost += best[i] - kReward * nodes[j][1];
      if (cost < best[j]) {
        best[j] = cost;
        from[j] = i;
      }
    }
  }
  std::vector<double> result{1};
  for (std::size_t j = n - 1; j > 0; j = from[j]) {
    double a = nodes[from[j]][0], b = nodes[j][0], cost;
    int steps = steps_for((b - a) * length, cost);
    for (int k = steps - 1; k >= 0; --k) result.push_back(k == 0 ? a : a + (b - a) * k / steps);
  }
  std::reverse(result.begin(), result.end());
  return result;
}

Point2 GridFrame::weft() const {
  switch (quarter) {
    case 1:
      return {-sin, cos};
    case 2:
      return {-cos, -sin};
    case 3:
      return {sin, -cos};
    default:
      return {cos, sin};
  }
}

GridFrame make_frame(const design::Panel& panel, const Outline& outline, double h) {
  constexpr double kRight = portable::kPi / 2;
  GridFrame frame;
  double turns = panel.grain_angle / kRight, nearest = std::floor(turns + 0.5);
  if (std::abs(turns - nearest) < 1e-9) {
    frame.quarter = static_cast<int>(nearest - 4 * std::floor(nearest / 4));
  } else {
    frame.cos = portable::cos(panel.grain_angle);
    frame.sin = portable::sin(panel.grain_angle);
  }
  frame.symmetric = outline.n_half > 0 && frame.cos == 1;
  if (frame.symmetric) frame.origin = {*panel.fold_x, 0};
  Vector2d low(1e300, 1e300), high(-1e300, -1e300);
  for (const Piece& piece : outline.pieces) {
    int n = piece.straight() ? 1 : std::max(8, static_cast<int>(std::ceil(piece.length() / (h / 4))));
    for (int i = 0; i < n; ++i) {
      Vector2d g = frame.to_grid(piece.at(piece.length() * i / n));
      low = low.cwiseMin(g);
      high = high.cwiseMax(g);
    }
  }
  auto divide = [&](double extent) { return extent / std::max(1.0, std::floor(extent / h + 0.5)); };
  frame.hp = divide(frame.symmetric ? high.x() : high.x() - low.x());
  frame.hq = divide(high.y() - low.y());
  Vector2d start(frame.symmetric ? 0.0 : low.x(), low.y());
  frame.origin = frame.to_panel(start);
  return frame;
}

std::vector<int> vertices_on(const design::EdgePart& part, const BorderPanel& outline, const Border& border) {
  std::vector<int> result;
  double low = std::min(part.from, part.to), high = std::max(part.from, part.to), slack = 0.2 * outline.h;
  auto n = static_cast<int>(border.at.size());
  for (int k = 0; k < n; ++k) {
    const Piece& piece = outline.outline.pieces[border.piece[k]];
    if (piece.edge != part.edge || piece.on != part.on) continue;
    auto inside = [&](double arc) { return arc >= low - slack && arc <= high + slack; };
    if (inside(border.arc_from[k]) && (result.empty() || result.back() != k)) result.push_back(k);
    if (border.next[k] >= 0 && inside(border.arc_to[k])) result.push_back(border.next[k]);
  }
  return result;
}

Borders make_borders(const std::vector<BorderPanel>& panels, const std::vector<GridFrame>& frames,
                     const Matched& matched) {
  std::vector<std::vector<std::vector<std::array<double, 2>>>> crossings(panels.size());
  parallel_for(panels.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p)
      for (const Piece& piece : panels[p].outline.pieces)
        crossings[p].push_back(grid_crossings(piece, frames[p]));
  });
  std::vector<std::vector<std::array<double, 2>>> candidates(matched.n_groups);
  std::vector<double> spacings(matched.n_groups, 0);
  for (const Stretch& s : matched.stretches) {
    const Piece& piece = panels[s.panel].outline.pieces[s.piece];
    double t0 = piece.breaks[s.lower], t1 = piece.breaks[s.lower + 1];
    for (const auto& [t, weight] : crossings[s.panel][s.piece]) {
      if (t <= t0 || t >= t1) continue;
      double f = (t - t0) / (t1 - t0);
      candidates[s.group].push_back({s.reversed ? 1 - f : f, weight});
    }
    double spacing = std::min(panels[s.panel].h, std::max(frames[s.panel].hp, frames[s.panel].hq));
    spacings[s.group] = std::max(spacings[s.group], (t1 - t0) / spacing);
  }
  std::vector<std::vector<double>> fractions(matched.n_groups);
  for (int g = 0; g < matched.n_groups; ++g)
    fractions[g] = spacings[g] < kCollapse ? std::vector<double>{0}
                                           : choose_fractions(std::move(candidates[g]), spacings[g]);

  Borders borders;
  borders.panels.resize(panels.size());
  std::vector<std::vector<std::vector<int>>> vertex_at_break(panels.size());  // panel, piece, break
  for (std::size_t p = 0; p < panels.size(); ++p) vertex_at_break[p].resize(panels[p].outline.pieces.size());
  for (const Stretch& s : matched.stretches) {
    const Piece& piece = panels[s.panel].outline.pieces[s.piece];
    Border& border = borders.panels[s.panel];
    const std::vector<double>& f = fractions[s.group];
    double t0 = piece.breaks[s.lower], t1 = piece.breaks[s.lower + 1];
    std::size_t m = f.size() - 1;
    auto position = [&](std::size_t k) {
      if (k == m) return t1;
      return t0 + (t1 - t0) * (s.reversed ? 1 - f[m - k] : f[k]);
    };
    const Outline& outline = panels[s.panel].outline;
    const std::size_t loop = outline.loop_of(static_cast<std::size_t>(s.piece));
    while (border.loops.size() <= loop) border.loops.push_back(static_cast<int>(border.at.size()));
    vertex_at_break[s.panel][s.piece].push_back(static_cast<int>(border.at.size()));
    borders.stretch_first.push_back(static_cast<int>(border.at.size()));
    borders.stretch_count.push_back(static_cast<int>(m));
    borders.stretch_loop.push_back(static_cast<int>(loop));
    if (frames[s.panel].symmetric && static_cast<std::size_t>(s.piece) == outline.n_half && s.lower == 0)
      border.half = border.at.size();
    for (std::size_t k = 0; k < m; ++k) {
      border.at.push_back(piece.at(position(k)));
      border.bulge.push_back(loop < outline.n_closed ? piece.bulge(position(k), position(k + 1)) : 0);
      border.piece.push_back(s.piece);
      border.arc_from.push_back(piece.arc(position(k)));
      border.arc_to.push_back(piece.arc(position(k + 1)));
    }
    if (loop >= outline.n_closed && s.lower + 2 == piece.breaks.size()) {  // a line ends with a vertex of its own
      border.at.push_back(piece.at(t1));
      border.bulge.push_back(0);
      border.piece.push_back(s.piece);
      border.arc_from.push_back(piece.arc(t1));
      border.arc_to.push_back(piece.arc(t1));
    }
  }
  for (std::size_t p = 0; p < panels.size(); ++p) {
    Border& border = borders.panels[p];
    const Outline& outline = panels[p].outline;
    border.n_closed = outline.n_closed;
    close_loops(border);
    for (std::size_t k = 0; k < outline.pieces.size(); ++k) {  // the end of a piece is the start of what follows
      const std::size_t loop = outline.loop_of(k);
      const bool last = k + 1 == outline.end_of(loop);
      vertex_at_break[p][k].push_back(loop >= outline.n_closed ? border.end_of(loop) - 1
                                      : last                   ? border.loops[loop]
                                                               : vertex_at_break[p][k + 1].front());
    }
    join_vertices(outline, vertex_at_break[p], border);
  }
  for (std::size_t p = 0; p < panels.size(); ++p) {  // halves: mirror images to the bit
    Border& border = borders.panels[p];
    if (border.half == 0) continue;
    double fold = frames[p].origin.x();
    std::size_t n = border.at.size();
    border.at[0].x() = border.at[border.half].x() = fold;
    for (std::size_t k = 1; k < border.half; ++k)
      border.at[n - k] = {2 * fold - border.at[k].x(), border.at[k].y()};
    for (std::size_t k = 0; k < border.half; ++k) border.bulge[n - 1 - k] = border.bulge[k];
  }
  return borders;
}

}  // namespace garment::modeller
