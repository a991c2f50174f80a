#include "runtime/body/measure.hpp"

#include <algorithm>
#include <limits>

#include "runtime/body/anatomy.hpp"

namespace garment::body {
namespace {

/// The landmarks as far as levels and parts tell them.
Landmarks known_landmarks(const Body& body) {
  Landmarks marks;
  const Heights e = heights_of(body.mesh);
  marks.base = e.low;
  marks.top = e.high;
  marks.stature = e.high - e.low;
  marks.crotch = body.levels.at("crotch").height;
  marks.armpit = body.levels.at("armpit").height;
  const auto& left = body.parts.at("leg.left").sections;
  const auto& right = body.parts.at("leg.right").sections;
  if (!left.empty() && !right.empty())
    marks.center_x = 0.5 * (left.front().center.x() + right.front().center.x());
  Loop hull = torso_hull(body.mesh, marks, marks.armpit);
  for (const Vector2d& p : hull) marks.reach = std::max(marks.reach, std::abs(p.x() - marks.center_x));
  return marks;
}

bool is_person(const Body& body) {
  return body.levels.count("crotch") && body.levels.count("armpit") && body.parts.count("leg.left") &&
         body.parts.count("leg.right");
}

}  // namespace

Loop hull_section(const Body& body, double y) {
  if (is_person(body)) {
    Landmarks marks = known_landmarks(body);
    return y < marks.crotch ? leg_hull(body.mesh, marks, y, +1) : torso_hull(body.mesh, marks, y);
  }
  Loop all;
  for (const Loop& loop : slice(body.mesh, horizontal(y))) all.insert(all.end(), loop.begin(), loop.end());
  return convex_hull(std::move(all));
}

double girth(const Body& body, double y) { return perimeter(hull_section(body, y)); }

MeasureTable measure(const Body& body) {
  MeasureTable table;
  if (body.mesh.vertices.empty()) return table;
  const Heights e = heights_of(body.mesh);
  for (const auto& [name, level] : body.levels) table.push_back({name, level.height - e.low, level.girth});
  if (table.empty()) table.push_back({"whole", 0.5 * (e.high - e.low), girth(body, 0.5 * (e.low + e.high))});
  std::stable_sort(table.begin(), table.end(),
                   [](const MeasureRow& a, const MeasureRow& b) { return a.height > b.height; });
  return table;
}

}  // namespace garment::body
