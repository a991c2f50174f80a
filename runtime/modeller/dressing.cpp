#include "runtime/modeller/dressing.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string_view>

namespace garment::modeller {
namespace {

using design::Placement;
using Eigen::Vector3d;
using model::Index;

constexpr double kSearchReach = 0.35;    // m, how far from the surface it is looked for
constexpr double kPanelGap = 5e-3;       // m
constexpr double kPanelStep = 5e-3;      // m
constexpr double kMostPanelMove = 0.12;  // m
constexpr double kHoodGap = 0.01;        // m
constexpr double kMostSlide = 0.3;       // m
constexpr double kMostHoodMove = 0.15;   // m

bool contains_no_case(std::string_view text, std::string_view part) {
  auto same = [](char a, char b) { return (a | 0x20) == b; };  // `part` is lower case
  return std::search(text.begin(), text.end(), part.begin(), part.end(), same) != text.end();
}

/// The smallest turn that brings `from` to the direction of `to`, which is not the opposite one. Eigen's FromTwoVectors knows
/// that one too, by a singular value decomposition that takes as long to compile as the rest of this file four times.
Eigen::Matrix3d turn_to(const Vector3d& from, const Vector3d& to) {
  const Vector3d a = from.normalized(), b = to.normalized();
  const double s = std::sqrt((1 + b.dot(a)) * 2);
  const Vector3d axis = a.cross(b) * (1 / s);
  return Eigen::Quaterniond(s * 0.5, axis.x(), axis.y(), axis.z()).toRotationMatrix();
}

bool is_rigid(const design::Panel& panel) { return panel.placement.kind == Placement::Kind::rigid; }

template <class F>
void for_vertices(const model::Model& model, std::size_t panel, const F& f) {
  const model::PanelRange& range = model.panels[panel];
  for (Index v = range.first_vertex; v < range.first_vertex + range.n_vertices; ++v) f(v);
}

Vector3d mean_place(const model::Model& model, std::size_t panel, const std::vector<Vector3d>& place) {
  Vector3d sum = Vector3d::Zero();
  int n = 0;
  for_vertices(model, panel, [&](Index v) { sum += place[v], ++n; });
  return n > 0 ? Vector3d(sum / n) : sum;
}

/// Distance from the body, at most kSearchReach.
double distance(const body::Body& body, const Vector3d& p) {
  auto hit = body.closest(p, kSearchReach);
  return hit ? hit->distance : kSearchReach;
}

/// Point of a chain of sections at arc length `s` from its start, carried on straight at the end.
Vector3d along(const body::Part& part, double s) {
  const auto& sections = part.sections;
  for (std::size_t i = 1; i < sections.size(); ++i) {
    Vector3d d = sections[i].center - sections[i - 1].center;
    double length = d.norm();
    if (s <= length || i + 1 == sections.size())
      return sections[i - 1].center + (length > 0 ? s / length : 0.0) * d;
    s -= length;
  }
  return sections.front().center;
}

/// Middle of the part of the body that a point lies beside: of the arm for sleeves, else of the torso or the
/// leg.
Vector3d middle_beside(const body::Body& body, const Vector3d& p, bool sleeve) {
  const body::Section* best = nullptr;
  double least = 1e300;
  for (const auto& [name, part] : body.parts) {
    if (name.starts_with("arm") != sleeve) continue;
    for (const body::Section& s : part.sections) {
      // Torso and legs: by height; the side matters less, a long panel hangs beside both legs.
      double gap = sleeve ? (p - s.center).norm()
                          : std::abs(p.y() - s.center.y()) + 0.01 * std::abs(p.x() - s.center.x());
      if (gap < least) least = gap, best = &s;
    }
  }
  return best ? best->center : Vector3d::Zero();
}

struct Sleeve {
  std::vector<std::size_t> panels;
  Vector3d root = Vector3d::Zero(), middle = Vector3d::Zero(), axis = Vector3d::Zero();
  double length = 0;
};

/// Root: mean of what is sewn to other panels; axis: from there to the mean of the farthest seventh.
bool measure(const model::Model& model, const std::vector<Vector3d>& place,
             const std::vector<bool>& sewn_outside, Sleeve& sleeve) {
  Vector3d root = Vector3d::Zero(), all = Vector3d::Zero(), far = Vector3d::Zero();
  int n_root = 0, n_all = 0, n_far = 0;
  auto each = [&](const auto& f) {
    for (std::size_t p : sleeve.panels) for_vertices(model, p, f);
  };
  each([&](Index v) {
    all += place[v], ++n_all;
    if (sewn_outside[model.vertex_particle[v]]) root += place[v], ++n_root;
  });
  if (n_root == 0 || n_all == 0) return false;
  root /= n_root, all /= n_all;
  Vector3d guess = all - root;
  if (guess.norm() < 1e-3) return false;
  guess.normalize();
  double reach = 0;
  each([&](Index v) { reach = std::max(reach, guess.dot(place[v] - root)); });
  each([&](Index v) {
    if (guess.dot(place[v] - root) > 0.85 * reach) far += place[v], ++n_far;
  });
  far /= n_far;
  sleeve.root = root;
  sleeve.middle = (root + far) / 2;
  sleeve.length = (far - root).norm();
  sleeve.axis = (far - root).normalized();
  return sleeve.length > 0.02;
}

/// Slides a sleeve outwards until every point of its cap lies outside the point of the armhole that it is
/// sewn to: a cap that overlaps the bodice would cut it.
void slide_out(const model::Model& model, const std::vector<std::size_t>& panels,
               const std::vector<bool>& in_sleeve, const Vector3d& axis, std::vector<Vector3d>& place) {
  std::vector<double> armhole(model.n_particles(), -1e300);
  for (std::size_t v = 0; v < model.n_vertices(); ++v)
    if (!in_sleeve[model.vertex_panel[v]])
      armhole[model.vertex_particle[v]] = std::max(armhole[model.vertex_particle[v]], axis.dot(place[v]));
  double slide = 0;
  for (std::size_t p : panels)
    for_vertices(model, p, [&](Index v) {
      slide = std::max(slide, armhole[model.vertex_particle[v]] - axis.dot(place[v]));
    });
  if (slide > kMostSlide) return;
  for (std::size_t p : panels) for_vertices(model, p, [&](Index v) { place[v] += slide * axis; });
}

}  // namespace

bool is_sleeve(const design::Panel& panel) {
  return panel.label == "arm" || contains_no_case(panel.name, "sleeve");
}

void follow_arms(const design::Garment& garment, const body::Body& body, const model::Model& model,
                 std::vector<Vector3d>& place) {
  for (const char* name : {"arm.left", "arm.right"}) {
    auto arm = body.parts.find(name);
    if (arm == body.parts.end() || arm->second.sections.size() < 2) continue;
    const std::vector<body::Section>& sections = arm->second.sections;
    double side = sections.back().center.x() > sections.front().center.x() ? 1 : -1;
    Sleeve sleeve;
    std::vector<bool> in_sleeve(garment.panels.size(), false), outside(model.n_particles(), false);
    for (std::size_t p = 0; p < garment.panels.size(); ++p)
      if (is_rigid(garment.panels[p]) && is_sleeve(garment.panels[p]) &&
          side * mean_place(model, p, place).x() > 0)
        sleeve.panels.push_back(p), in_sleeve[p] = true;
    for (std::size_t v = 0; v < model.n_vertices(); ++v)
      if (!in_sleeve[model.vertex_panel[v]]) outside[model.vertex_particle[v]] = true;
    if (sleeve.panels.empty() || !measure(model, place, outside, sleeve)) continue;
    // The stretch of the arm that the sleeve covers begins as far from the shoulder as the sleeve does now.
    Vector3d shoulder = sections.front().center;
    Vector3d whole = (sections.back().center - shoulder).normalized();
    double begin = std::max(0.0, whole.dot(sleeve.root - shoulder));
    Vector3d from = along(arm->second, begin), to = along(arm->second, begin + sleeve.length);
    Vector3d axis = (to - from).normalized(), middle = (from + to) / 2;
    if (axis.dot(sleeve.axis) < -0.5) continue;  // drawn the wrong way round: nothing to follow
    const Eigen::Matrix3d turn = turn_to(sleeve.axis, axis);
    for (std::size_t p : sleeve.panels)
      for_vertices(model, p, [&](Index v) { place[v] = middle + turn * (place[v] - sleeve.middle); });
    slide_out(model, sleeve.panels, in_sleeve, axis, place);
  }
}

void follow_head(const design::Garment& garment, const body::Body& body, const model::Model& model,
                 std::vector<Vector3d>& place) {
  auto neck = body.levels.find("neck");
  if (neck == body.levels.end()) return;
  std::vector<bool> hood(garment.panels.size(), false);
  std::vector<int> count(model.n_particles(), 0);
  std::vector<Vector3d> sum(model.n_particles(), Vector3d::Zero());
  for (std::size_t p = 0; p < garment.panels.size(); ++p) {
    const design::Panel& panel = garment.panels[p];
    if (!is_rigid(panel) || std::abs(panel.placement.rotation(0, 2)) < 0.8) continue;
    if (mean_place(model, p, place).y() < neck->second.height - 0.02) continue;
    hood[p] = true;
    for_vertices(model, p, [&](Index v) {
      sum[model.vertex_particle[v]] += place[v];
      ++count[model.vertex_particle[v]];
    });
  }
  for (std::size_t v = 0; v < model.n_vertices(); ++v)  // what others hold, too, is the neck's seam
    if (!hood[model.vertex_panel[v]]) count[model.vertex_particle[v]] = 0;
  double move = 0;
  auto pierces = [&](std::size_t i) {
    return count[i] > 1 && distance(body, sum[i] / count[i] - Vector3d(0, 0, move)) < kHoodGap;
  };
  for (std::size_t i = 0; i < model.n_particles(); ++i)
    while (move < kMostHoodMove && pierces(i)) move += 5e-3;
  for (std::size_t v = 0; v < model.n_vertices(); ++v)
    if (hood[model.vertex_panel[v]]) place[v].z() -= move;
}

void clear_panels(const design::Garment& garment, const body::Body& body, const model::Model& model,
                  std::vector<Vector3d>& place) {
  if (body.parts.empty()) return;
  std::vector<int> count(model.n_particles(), 0);
  for (Index i : model.vertex_particle) ++count[i];
  for (std::size_t p = 0; p < garment.panels.size(); ++p) {
    if (!is_rigid(garment.panels[p])) continue;
    std::vector<Index> own;
    for_vertices(model, p, [&](Index v) {
      if (count[model.vertex_particle[v]] == 1) own.push_back(v);
    });
    Vector3d mean = mean_place(model, p, place);
    Vector3d normal = garment.panels[p].placement.rotation.col(2);
    if (normal.dot(mean - middle_beside(body, mean, is_sleeve(garment.panels[p]))) < 0) normal = -normal;
    // Small parts of the body (an ear) could stand between particles: the gap grows with their spacing.
    double gap = kPanelGap + 0.35 * garment.panels[p].resolution;
    double move = 0;
    for (Index v : own)
      while (move <= kMostPanelMove && distance(body, place[v] + move * normal) < gap) move += kPanelStep;
    if (move > 0 && move <= kMostPanelMove)
      for_vertices(model, p, [&](Index v) { place[v] += move * normal; });
  }
}

}  // namespace garment::modeller
