#include "runtime/io/pattern_place.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "runtime/io/pattern_panel.hpp"

namespace garment::io {
namespace {

using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

PanelPlace panel_place(const design::Panel& panel) {
  PanelPlace place;
  place.low = Vector3d::Constant(kInfinity);
  place.high = -place.low;
  for (const design::Edge& edge : panel.edges) {
    EdgePlace e;
    e.length = edge.curve.length();
    e.start = placed(panel, edge.curve.start());
    e.end = placed(panel, edge.curve.end());
    e.middle = placed(panel, edge.curve.point_at(e.length / 2));
    for (double fraction : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      Vector3d p = placed(panel, edge.curve.point_at(fraction * e.length));
      place.low = place.low.cwiseMin(p);
      place.high = place.high.cwiseMax(p);
    }
    place.edges.push_back(e);
  }
  return place;
}

int root_of(std::vector<int>& parent, int i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

}  // namespace

bool EdgePlace::upright() const {
  Vector3d d = end - start;
  return std::abs(d.y()) > std::sqrt(d.x() * d.x() + d.z() * d.z());
}

GarmentPlace garment_place(const design::Garment& garment) {
  GarmentPlace place;
  for (const design::Panel& panel : garment.panels) place.panels.push_back(panel_place(panel));

  std::vector<int> parent(garment.panels.size());
  std::iota(parent.begin(), parent.end(), 0);
  for (const design::Seam& seam : garment.seams) {
    const design::EdgePart& a = seam.sides[0].parts[0];
    const design::EdgePart& b = seam.sides[1].parts[0];
    EdgePlace& ea = place.panels[a.panel].edges[a.edge];
    EdgePlace& eb = place.panels[b.panel].edges[b.edge];
    if (!ea.sewn()) ea.partner_panel = b.panel, ea.partner_edge = b.edge;
    if (!eb.sewn()) eb.partner_panel = a.panel, eb.partner_edge = a.edge;
    parent[root_of(parent, a.panel)] = root_of(parent, b.panel);
  }
  std::vector<int> piece_of(parent.size(), -1);
  for (std::size_t i = 0; i < parent.size(); ++i) {
    int root = root_of(parent, static_cast<int>(i));
    if (piece_of[root] < 0) {
      piece_of[root] = static_cast<int>(place.piece_low.size());
      place.piece_low.push_back(kInfinity);
      place.piece_high.push_back(-kInfinity);
    }
    PanelPlace& panel = place.panels[i];
    panel.piece = piece_of[root];
    place.piece_low[panel.piece] = std::min(place.piece_low[panel.piece], panel.low.y());
    place.piece_high[panel.piece] = std::max(place.piece_high[panel.piece], panel.high.y());
  }
  return place;
}

}  // namespace garment::io
