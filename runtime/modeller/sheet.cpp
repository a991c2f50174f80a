#include "runtime/modeller/sheet.hpp"

#include <algorithm>

namespace garment::modeller {

using model::Index;

namespace {

/// The vertices of the side opposite corner k, the smaller first.
std::pair<Index, Index> vertices_of(const Sheet& sheet, Index triangle, int k) {
  return std::minmax({sheet.vertex[triangle][(k + 1) % 3], sheet.vertex[triangle][(k + 2) % 3]});
}

/// The closed fan that triangle `start` belongs to; empty where it runs into a border.
std::vector<FanTriangle> fan_from(const Sheet& sheet, Index particle, Index start, int centre) {
  std::vector<FanTriangle> fan;
  auto corner_of = [&](Index t, Index p) {
    return sheet.particle[t][0] == p ? 0 : sheet.particle[t][1] == p ? 1 : 2;
  };
  Index t = start;
  int here = (centre + 1) % 3, ahead = (centre + 2) % 3;
  for (Index count = sheet.first[particle]; count < sheet.first[particle + 1]; ++count) {
    fan.push_back({t, centre, here, ahead});
    Index beyond = sheet.next[t][here];  // across the side centre-ahead, which lies opposite `here`
    if (beyond < 0) return {};
    Index joint = sheet.particle[t][ahead];
    if (beyond == start)
      return joint == sheet.particle[start][fan.front().here] ? fan : std::vector<FanTriangle>{};
    t = beyond;
    centre = corner_of(t, particle);
    here = corner_of(t, joint);
    ahead = 3 - centre - here;
  }
  return {};
}

}  // namespace

Sheet make_sheet(const model::Model& model) {
  Sheet sheet;
  std::size_t n = model.n_triangles();
  sheet.vertex = model.triangle;
  sheet.next.assign(n, {-1, -1, -1});
  struct HalfSide {
    Index low, high, triangle;
    int k;
  };
  std::vector<HalfSide> sides;
  sides.reserve(3 * n);
  sheet.first.assign(model.n_particles() + 1, 0);
  for (std::size_t t = 0; t < n; ++t) {
    model::Indices<3> c = model.corners(t);
    sheet.particle.push_back(c);
    for (int k = 0; k < 3; ++k) {
      Index a = c[(k + 1) % 3], b = c[(k + 2) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), static_cast<Index>(t), k});
      ++sheet.first[c[k] + 1];
    }
  }
  for (std::size_t i = 0; i < model.n_particles(); ++i) sheet.first[i + 1] += sheet.first[i];
  sheet.corner.resize(3 * n);
  std::vector<Index> fill(sheet.first.begin(), sheet.first.end() - 1);
  for (std::size_t t = 0; t < n; ++t)
    for (int k = 0; k < 3; ++k) sheet.corner[fill[sheet.particle[t][k]]++] = {static_cast<Index>(t), k};
  std::sort(sides.begin(), sides.end(), [](const HalfSide& a, const HalfSide& b) {
    if (a.low != b.low) return a.low < b.low;
    if (a.high != b.high) return a.high < b.high;
    return a.triangle != b.triangle ? a.triangle < b.triangle : a.k < b.k;
  });
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t j = i + 1;
    while (j < sides.size() && sides[j].low == sides[i].low && sides[j].high == sides[i].high) ++j;
    auto link = [&](std::size_t a, std::size_t b) {
      sheet.next[sides[a].triangle][sides[a].k] = sides[b].triangle;
      sheet.next[sides[b].triangle][sides[b].k] = sides[a].triangle;
    };
    if (j - i == 2) link(i, i + 1);
    if (j - i > 2)  // a panel is sewn on along a line of another: that one goes on beneath the seam
      for (std::size_t a = i; a < j; ++a)
        for (std::size_t b = a + 1; b < j; ++b)
          if (vertices_of(sheet, sides[a].triangle, sides[a].k) == vertices_of(sheet, sides[b].triangle, sides[b].k)) link(a, b);
    i = j;
  }
  return sheet;
}

std::vector<FanTriangle> closed_fan(const Sheet& sheet, Index particle) {
  for (Index k = sheet.first[particle]; k < sheet.first[particle + 1]; ++k) {
    const auto [triangle, centre] = sheet.corner[k];
    std::vector<FanTriangle> fan = fan_from(sheet, particle, triangle, centre);
    if (!fan.empty()) return fan;
  }
  return {};
}

}  // namespace garment::modeller
