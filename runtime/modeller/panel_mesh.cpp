#include "runtime/modeller/panel_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runtime/base/number.hpp"
#include "runtime/design/fineness.hpp"
#include "runtime/modeller/corner_fans.hpp"
#include "runtime/modeller/crossing.hpp"
#include "runtime/modeller/slits.hpp"

namespace garment::modeller {
namespace {

using Eigen::Vector2d;

/// Particles on the fold from its upper end down to its lower end, both left out.
std::vector<Vector2d> fold_nodes(const std::vector<Vector2d>& half, const GridFrame& frame) {
  double top = half.back().y(), bottom = half.front().y(), clear = 0.45 * std::min(frame.hp, frame.hq);
  std::vector<Vector2d> nodes;
  for (int j = static_cast<int>(std::ceil(top / frame.hq));
       j >= static_cast<int>(std::floor(bottom / frame.hq)); --j) {
    Vector2d x(0, j * frame.hq);
    if (x.y() > top - clear || x.y() < bottom + clear) continue;
    bool near = false;
    for (std::size_t k = 0; k + 1 < half.size() && !near; ++k) {
      Vector2d d = half[k + 1] - half[k];
      double t = std::clamp((x - half[k]).dot(d) / d.squaredNorm(), 0.0, 1.0);
      near = (half[k] + t * d - x).norm() < clear;
    }
    if (!near) nodes.push_back(x);
  }
  return nodes;
}

/// Joins a half and its mirror image. `n_half` border vertices run from the lower to the upper fold point,
/// then come the particles on the fold, then those inside.
LoopMesh unfold(const LoopMesh& half, std::size_t n_right, std::size_t n_fold) {
  std::size_t n_border = 2 * (n_right - 1), n_inner = half.at.size() - n_right - n_fold;
  auto right = [&](int v) {
    auto u = static_cast<std::size_t>(v);
    return static_cast<int>(u < n_right ? u : n_border + (u - n_right));
  };
  auto left = [&](int v) {
    auto u = static_cast<std::size_t>(v);
    if (u < n_right) return static_cast<int>((n_border - u) % n_border);
    if (u < n_right + n_fold) return right(v);
    return static_cast<int>(n_border + (u - n_right) + n_inner);
  };
  LoopMesh whole;
  whole.ok = true;
  whole.at.resize(n_border + n_fold + 2 * n_inner);
  for (std::size_t u = 0; u < half.at.size(); ++u) {
    whole.at[left(static_cast<int>(u))] = {-half.at[u].x(), half.at[u].y()};
    whole.at[right(static_cast<int>(u))] = half.at[u];
  }
  for (const auto& c : half.cells) {
    whole.cells.push_back({right(c[0]), right(c[1]), right(c[2]), right(c[3])});
    whole.cells.push_back({left(c[1]), left(c[0]), left(c[3]), left(c[2])});
  }
  for (const auto& t : half.cut) {
    whole.cut.push_back({right(t[0]), right(t[1]), right(t[2])});
    whole.cut.push_back({left(t[0]), left(t[2]), left(t[1])});
  }
  for (std::size_t k = 0; k < half.cell_halves.size(); k += 2) {
    const auto &s = half.cell_halves[k], &t = half.cell_halves[k + 1];
    whole.cell_halves.push_back({right(s[0]), right(s[1]), right(s[2])});
    whole.cell_halves.push_back({right(t[0]), right(t[1]), right(t[2])});
    whole.cell_halves.push_back({left(s[0]), left(s[2]), left(s[1])});
    whole.cell_halves.push_back({left(t[0]), left(t[2]), left(t[1])});
  }
  return whole;
}

void report_coarse(const BorderPanel& panel, const std::string& what, double fits, Findings& findings) {
  findings.push_back(
      {"G0451",
       Severity::error,
       fmt::format("panel `{}` is too small for its grid of {} mm: {}", panel.panel->name,
                   format_number(panel.h * 1000, 3), what),
       {{panel.panel->origin, ""}},
       fits >= design::kFinestResolution ? fmt::format("state `{}.resolution = {} mm`", panel.panel->name, format_number(fits * 1000, 3))
                       : "widen the panel: it is narrower than two spacings of the finest resolution, 1 mm"});
}

}  // namespace

std::optional<PanelMesh> mesh_panel(const BorderPanel& panel, const GridFrame& frame, const Border& border,
                                    Findings& findings) {
  double perimeter = 0;
  for (const Piece& piece : panel.outline.pieces) perimeter += piece.length();
  double fits = design::fitting_resolution(panel.outline.area / perimeter, panel.h);
  if (border.at.size() < 3) {
    report_coarse(panel, "its border holds no three particles", fits, findings);
    return std::nullopt;
  }
  for (std::size_t l = 0; l < border.n_closed; ++l) {
    const auto begin = border.at.begin() + border.loops[l], end = border.at.begin() + border.end_of(l);
    const std::optional<Crossing> crossing = find_crossing({begin, end});
    if (!crossing) continue;
    report_coarse(panel,
                  fmt::format("the straight lines between its border particles cross at ({}, {}) mm",
                              format_number(crossing->point.x() * 1000, 4),
                              format_number(crossing->point.y() * 1000, 4)),
                  0.5 * panel.h, findings);
    return std::nullopt;
  }
  LoopBorder loop;
  std::size_t n_right = border.half > 0 ? border.half + 1 : border.at.size(), n_fold = 0;
  for (std::size_t k = 0; k < n_right; ++k) loop.at.push_back(frame.to_grid(border.at[k]));
  if (border.half > 0) {
    std::vector<Vector2d> fold = fold_nodes(loop.at, frame);
    n_fold = fold.size();
    loop.at.insert(loop.at.end(), fold.begin(), fold.end());
    for (std::size_t k = 0; k < loop.at.size(); ++k) loop.next.push_back(static_cast<int>((k + 1) % loop.at.size()));
  } else {
    loop.next = border.next;
    for (std::size_t k = border.n_outline(); k < border.at.size(); ++k) {
      loop.next[k] = -1;
      if (border.next[k] >= 0) loop.lines.push_back({border.same[k], border.same[border.next[k]]});
    }
  }
  LoopMesh mesh;
  if (loop.at.size() >= 3) mesh = mesh_loop(loop, frame.hp, frame.hq);
  if (!mesh.ok) {
    report_coarse(panel, "its border runs too close to itself", 0.5 * panel.h, findings);
    return std::nullopt;
  }
  fan_out_corners(loop, mesh);
  if (border.half > 0) mesh = unfold(mesh, n_right, n_fold);
  if (mesh.at.size() == border.at.size()) {
    report_coarse(panel, "no particle fits inside its border", fits, findings);
    return std::nullopt;
  }
  PanelMesh result;
  result.n_border = border.at.size();
  result.at = border.at;
  for (std::size_t v = border.at.size(); v < mesh.at.size(); ++v)
    result.at.push_back(frame.to_panel(mesh.at[v]));
  result.cell_size = frame.quarter % 2 == 0 ? Vector2d(frame.hp, frame.hq) : Vector2d(frame.hq, frame.hp);
  for (const auto& c : mesh.cells)
    result.cells.push_back({c[frame.quarter], c[(frame.quarter + 1) % 4], c[(frame.quarter + 2) % 4],
                            c[(frame.quarter + 3) % 4]});
  result.cut = std::move(mesh.cut);
  result.cell_halves = std::move(mesh.cell_halves);
  open_slits(panel, border, result);
  return result;
}

}  // namespace garment::modeller
