#include "runtime/io/cut_lines.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace garment::io {
namespace {

using design::Point2;
using geometry::cross;

constexpr double kCutChord = 5e-5;  // m
constexpr double kMitre = 2;        // widths

/// The edge moved outwards; `side` is 1 where outwards is left.
CutLine moved(const design::Edge& edge, double side) {
  std::vector<double> at;
  CutLine line = edge.curve.polyline(kCutChord, &at);
  for (std::size_t k = 0; k < line.size(); ++k) {
    const Point2 t = edge.curve.tangent_at(at[k]);
    line[k] += side * edge.allowance * Point2(-t.y(), t.x());
  }
  return line;
}

struct Meeting {
  std::size_t a, b;  ///< segments
  Point2 at;
};

/// Where the end of `a` crosses the beginning of `b`.
std::optional<Meeting> crossing(const CutLine& a, const CutLine& b) {
  for (std::size_t i = a.size() - 1; i-- > 0;)
    for (std::size_t j = 0; j + 1 < b.size(); ++j) {
      const Point2 u = a[i + 1] - a[i], v = b[j + 1] - b[j], w = b[j] - a[i];
      const double det = cross(u, v);
      if (det == 0) continue;
      const double s = cross(w, v) / det, t = cross(w, u) / det;
      if (s >= 0 && s <= 1 && t >= 0 && t <= 1) return Meeting{i, j, a[i] + s * u};
    }
  return std::nullopt;
}

/// The point where both prolonged meet, if it is near.
std::optional<Point2> mitre(const CutLine& a, const CutLine& b, double reach) {
  if (a.size() < 2 || b.size() < 2) return std::nullopt;
  const Point2 u = a.back() - a[a.size() - 2], v = b[1] - b[0], w = b.front() - a.back();
  const double det = cross(u, v);
  if (std::fabs(det) < 1e-9 * u.norm() * v.norm()) return std::nullopt;
  const double s = cross(w, v) / det, t = cross(w, u) / det;
  const Point2 p = a.back() + s * u;
  const bool ahead = s >= -1e-9 && t <= 1e-9;
  if (!ahead || (p - a.back()).norm() > reach || (p - b.front()).norm() > reach) return std::nullopt;
  return p;
}

CutLine joined(const std::vector<design::Edge>& edges, double side) {
  std::vector<CutLine> lines;
  for (const design::Edge& edge : edges) lines.push_back(moved(edge, side));
  const std::size_t n = edges.size();
  std::vector<std::optional<Point2>> corner(n);  // after edge k
  for (std::size_t k = 0; k < n; ++k) {
    CutLine &a = lines[k], &b = lines[(k + 1) % n];
    const double wide = std::max(edges[k].allowance, edges[(k + 1) % n].allowance);
    if (const auto met = crossing(a, b); met && n > 1) {
      a.resize(met->a + 1);
      a.push_back(met->at);
      b.erase(b.begin(), b.begin() + static_cast<std::ptrdiff_t>(met->b) + 1);
      b.insert(b.begin(), met->at);
    } else {
      corner[k] = mitre(a, b, kMitre * wide + 1e-6);
    }
  }
  CutLine out;
  for (std::size_t k = 0; k < n; ++k) {
    out.insert(out.end(), lines[k].begin(), lines[k].end());
    if (corner[k]) out.push_back(*corner[k]);
  }
  return out;
}

void add(std::vector<CutLine>& out, const std::vector<design::Edge>& edges, bool hole) {
  double area = 0, widest = 0;
  for (const design::Edge& edge : edges) area += edge.curve.area_term(), widest = std::max(widest, edge.allowance);
  if (widest > 0) out.push_back(joined(edges, (area > 0) == hole ? 1 : -1));
}

}  // namespace

std::vector<CutLine> cut_lines(const design::Panel& panel) {
  std::vector<CutLine> out;
  add(out, panel.edges, false);
  for (const design::Hole& hole : panel.holes) {
    const auto first = panel.hole_edges.begin() + hole.first;
    add(out, {first, first + hole.count}, true);
  }
  return out;
}

}  // namespace garment::io
