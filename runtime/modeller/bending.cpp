#include "runtime/modeller/bending.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <queue>

#include "runtime/base/parallel.hpp"
#include "runtime/modeller/chart.hpp"
#include "runtime/modeller/folding.hpp"
#include "runtime/modeller/inner_friction.hpp"
#include "runtime/modeller/layered_cloth.hpp"

namespace garment::modeller {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using model::Index;

constexpr double kResidualShare = 1;  // of the mean bending rigidity, against what no quadratic describes

/// Area that a stencil answers for, by the panel it comes from.
struct PanelArea {
  Index panel;
  double area;
};
using Areas = std::vector<PanelArea>;

void add_area(Areas& areas, Index panel, double area) {
  for (PanelArea& a : areas) {
    if (a.panel == panel) {
      a.area += area;
      return;
    }
  }
  areas.push_back({panel, area});
}

double total(const Areas& areas) {
  double sum = 0;
  for (const PanelArea& a : areas) sum += a.area;
  return sum;
}

/// Grid neighbours of a vertex whose four cells are full: west, east (weft), south, north (warp).
struct GridStencil {
  std::array<Index, 4> cell{-1, -1, -1, -1};  // cell in which the vertex is corner k
  bool complete() const { return *std::min_element(cell.begin(), cell.end()) >= 0; }
};

std::vector<GridStencil> grid_stencils(const model::Model& model) {
  std::vector<GridStencil> stencils(model.n_particles());
  std::vector<char> twice(model.n_particles(), 0);
  for (std::size_t c = 0; c < model.cell.size(); ++c)
    for (int k = 0; k < 4; ++k) {
      Index& slot = stencils[model.cell[c][k]].cell[k];
      if (slot >= 0) twice[model.cell[c][k]] = 1;
      slot = static_cast<Index>(c);
    }
  std::vector<Index> panel(model.n_particles(),
                           -1);  // merged particles have vertices in several places: no grid there
  for (std::size_t v = 0; v < model.n_vertices(); ++v) {
    Index& seen = panel[model.vertex_particle[v]];
    if (seen >= 0) twice[model.vertex_particle[v]] = 1;
    seen = model.vertex_panel[v];
  }
  for (std::size_t i = 0; i < stencils.size(); ++i)
    if (twice[i]) stencils[i] = {};
  return stencils;
}

/// Plate matrix, in (11, 22, 12), of the cloth about a place of a panel, in axes in which its warp runs along the unit vector
/// `warp`.
Matrix3d plate_at(const std::vector<MeshedPanel>& panels, const ClothFields& fields, Index panel, const Point2& at,
                  const Vector2d& warp) {
  const MeshedPanel& p = panels[panel];
  const Matrix3d turn = seen_along(warp);
  if (fields.plain(panel)) {
    const Eigen::Vector3d own(p.fabric->bending_rigidity[0], p.fabric->bending_rigidity[1], 4 * twist_rigidity(*p.fabric));
    return turn.transpose() * own.asDiagonal() * turn;
  }
  return turn.transpose() * ClothAt(fields, panel, p.frame, at, std::max(p.frame.hp, p.frame.hq)).plate() * turn;
}

/// A seam that is sewn stiffer or softer than its cloth, at one of its particles: who comes before and after along it, and by
/// how much more (of the cloth's rigidity, times a width, m) it resists bending along itself.
struct Stiffened {
  Index before = -1, after = -1;
  double more = 0;
  double factor = 1;
};

/// How a panel slides in a fitted stencil: its warp in the chart and HB along warp and weft.
struct FitSlip {
  Vector2d warp{0, 0}, friction{0, 0};
};

/// A fitted stencil with the plate matrix of each panel that meets at its particle.
struct Fit {
  CurvatureFit curvature;
  std::vector<std::pair<Index, Matrix3d>> plate;
  std::vector<FitSlip> slip{};          // of the same panels
  Stiffened seam{};
  Vector2d along{0, 0};  // the seam in the chart
  std::vector<model::Vector3d> rest{};  // places at rest, where they are folded
};

/// Adds the plate matrices of the panels in the chart's fan: the area mean over each panel's triangles.
void add_plates(const Sheet& sheet, const std::vector<MeshedPanel>& panels, const ClothFields& fields,
                const model::Model& model, const Chart& chart, Fit& fit) {
  std::vector<double> area;
  const bool sliding = slides(fields.garment());
  for (std::size_t k = 0; k < chart.fan.size(); ++k) {
    const FanTriangle& f = chart.fan[k];
    const model::Indices<3>& v = sheet.vertex[f.triangle];
    Index panel = model.triangle_panel[f.triangle];
    Vector2d o = model.vertex_uv[v[f.centre]];
    Eigen::Matrix2d rest, laid;
    rest << model.vertex_uv[v[f.here]] - o, model.vertex_uv[v[f.ahead]] - o;
    laid << chart.fan_at[k][0], chart.fan_at[k][1];
    Vector2d warp = (laid * rest.inverse() * panels[panel].frame.warp()).normalized();
    double weight = std::abs(rest.determinant());
    std::size_t slot = 0;
    while (slot < fit.plate.size() && fit.plate[slot].first != panel) ++slot;
    if (slot == fit.plate.size()) {
      fit.plate.emplace_back(panel, Matrix3d::Zero());
      fit.slip.emplace_back();
      area.push_back(0);
    }
    const Point2 middle = (model.vertex_uv[v[0]] + model.vertex_uv[v[1]] + model.vertex_uv[v[2]]) / 3;
    fit.plate[slot].second += weight * plate_at(panels, fields, panel, middle, warp);
    area[slot] += weight;
    fit.slip[slot].warp += weight * warp;
    if (sliding) fit.slip[slot].friction += weight * bending_friction_at(panels, fields, panel, middle);
  }
  for (std::size_t slot = 0; slot < area.size(); ++slot) {
    fit.plate[slot].second /= area[slot];
    fit.slip[slot].friction /= area[slot];
    fit.slip[slot].warp.normalize();
  }
}

/// The stiffened seam at each particle.
std::vector<Stiffened> stiffened_seams(const design::Garment& garment, const model::Model& model) {
  std::vector<Stiffened> at(model.n_particles());
  for (const design::Seam& seam : garment.seams) {
    if (seam.finish.stiffness == 1) continue;
    double width = 0;  // of the allowances on both sides
    for (const design::SeamSide& side : seam.sides)
      if (!side.parts.empty()) width += sewn_allowance(garment, seam, side.parts[0]);
    for (const model::SeamChain& chain : model.seams) {
      if (chain.name != seam.name) continue;
      const std::vector<Index>& p = chain.particles;
      const bool ring = p.size() > 3 && p.front() == p.back();
      for (std::size_t k = 0; k + (ring ? 1 : 0) < p.size(); ++k)
        at[p[k]] = {k > 0 ? p[k - 1] : ring ? p[p.size() - 2] : p[k], p[std::min(k + 1, p.size() - 1)],
                    (seam.finish.stiffness - 1) * width, seam.finish.stiffness};
    }
  }
  return at;
}

/// Where the seam runs in the chart, as long as it is from the particle before to the one after.
Vector2d seam_in(const Chart& chart, const Stiffened& seam) {
  Vector2d along(0, 0);
  for (const Chart::Point& p : chart.points) {
    if (p.particle == seam.after) along += p.at;
    if (p.particle == seam.before) along -= p.at;
  }
  return along;
}

/// What the seam adds to the plate of a stencil of this area, m^2: spread over it, the same on any grid.
void stiffen(const Stiffened& seam, const Vector2d& along, double area, Matrix3d& plate) {
  if (seam.more == 0 || !(along.norm() > 0)) return;
  const Vector2d t = along.normalized();
  const Eigen::Vector3d bent(t.x() * t.x(), t.y() * t.y(), t.x() * t.y());  // curvature 1 along the seam
  const double rigidity = bent.dot(plate * bent), length = along.norm() / 2;
  const Eigen::Vector3d row = seen_along(t).row(0);
  // A softer seam leaves its share, or the plate would push the cloth out of shape.
  const double more = seam.factor < 1 ? std::max(seam.more * length / area, seam.factor - 1) : seam.more * length / area;
  plate += more * rigidity * row * row.transpose();
}

std::vector<Fit> make_fits(const Sheet& sheet, const std::vector<MeshedPanel>& panels,
                           const ClothFields& fields, const Folds& folds, const model::Model& model,
                           const std::vector<Index>& at, const std::vector<char>& joined) {
  const std::vector<Stiffened> seams = stiffened_seams(fields.garment(), model);
  std::vector<Fit> fits(at.size());
  parallel_for(at.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      std::optional<Chart> chart = develop(sheet, model, at[k], 2);
      if (!chart) continue;
      fits[k].curvature = fit_curvature(*chart, at[k], joined[at[k]] != 0);
      if (!fits[k].curvature.complete) {
        chart = develop(sheet, model, at[k], 3);
        fits[k].curvature = fit_curvature(*chart, at[k], joined[at[k]] != 0);
      }
      add_plates(sheet, panels, fields, model, *chart, fits[k]);
      fits[k].seam = seams[at[k]];
      fits[k].along = seam_in(*chart, fits[k].seam);
      fits[k].rest = folds.rest_places(*chart, at[k], model);
    }
  });
  return fits;
}

/// Moves the area of particles without a stencil towards the nearest that have one, split evenly where ways
/// are equally short, so that symmetric garments stay symmetric.
void hand_over_areas(const Sheet& sheet, const model::Model& model, const std::vector<char>& has_stencil,
                     std::vector<Areas>& areas) {
  constexpr double kNever = 1e300;
  std::size_t n = sheet.n_particles();
  std::vector<double> distance(n, kNever);
  using Entry = std::pair<double, Index>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (std::size_t i = 0; i < n; ++i) {
    if (!has_stencil[i]) continue;
    distance[i] = 0;
    queue.push({0, static_cast<Index>(i)});
  }
  auto for_each_neighbour = [&](Index i, const auto& f) {
    for (Index c = sheet.first[i]; c < sheet.first[i + 1]; ++c) {
      auto [t, k] = sheet.corner[c];
      for (int other : {(k + 1) % 3, (k + 2) % 3}) {
        double length =
            (model.vertex_uv[sheet.vertex[t][k]] - model.vertex_uv[sheet.vertex[t][other]]).norm();
        f(sheet.particle[t][other], length);
      }
    }
  };
  std::vector<Index> order;
  while (!queue.empty()) {
    auto [d, i] = queue.top();
    queue.pop();
    if (d > distance[i]) continue;
    if (!has_stencil[i]) order.push_back(i);
    for_each_neighbour(i, [&](Index j, double length) {
      if (d + length >= distance[j]) return;
      distance[j] = d + length;
      queue.push({distance[j], j});
    });
  }
  for (std::size_t k = order.size(); k-- > 0;) {
    Index i = order[k];
    std::vector<Index> towards;
    for_each_neighbour(i, [&](Index j, double length) {
      if (distance[j] < distance[i] && distance[j] + length <= distance[i] * (1 + 1e-9) &&
          std::find(towards.begin(), towards.end(), j) == towards.end())
        towards.push_back(j);
    });
    for (Index j : towards)
      for (const PanelArea& a : areas[i])
        add_area(areas[j], a.panel, a.area / static_cast<double>(towards.size()));
    areas[i].clear();
  }
}

void add_grid_bending(const std::vector<MeshedPanel>& panels, const ClothFields& fields,
                      const std::vector<GridStencil>& stencils, const std::vector<Areas>& areas,
                      model::Model& model) {
  std::vector<Index> vertex(model.n_particles(), 0);  // grid particles have one each
  for (std::size_t v = 0; v < model.n_vertices(); ++v)
    vertex[model.vertex_particle[v]] = static_cast<Index>(v);
  const bool sliding = slides(fields.garment());
  for (std::size_t i = 0; i < stencils.size(); ++i) {
    const GridStencil& s = stencils[i];
    if (!s.complete()) continue;
    const auto &ahead = model.cell[s.cell[0]], &behind = model.cell[s.cell[2]];
    Vector2d h = model.cell_size[s.cell[0]];
    double area = total(areas[i]);
    const Index panel = areas[i].front().panel;
    const Matrix3d plate = plate_at(panels, fields, panel, model.vertex_uv[vertex[i]], Vector2d(1, 0));
    auto at = static_cast<Index>(i);
    model.bend.push_back({behind[1], at, ahead[3]});
    model.bend_lengths.emplace_back(h.y(), h.y());
    model.bend_width.push_back(area / h.y());
    model.bend_rigidity.push_back(plate(0, 0));
    model.bend.push_back({behind[3], at, ahead[1]});
    model.bend_lengths.emplace_back(h.x(), h.x());
    model.bend_width.push_back(area / h.x());
    model.bend_rigidity.push_back(plate(1, 1));
    if (sliding) {
      const Vector2d friction = bending_friction_at(panels, fields, panel, model.vertex_uv[vertex[i]]);
      model.bend_slip.insert(model.bend_slip.end(), {friction[0], friction[1]});
    }
    for (Index c : s.cell)
      model.cell_twist[c] += plate(2, 2) / 4 * area / (4 * h.x() * h.y());
  }
}

/// `rest` holds the places of the particles at rest; empty where they are flat.
void add_stencil(const std::vector<Index>& particles, const std::vector<Eigen::Vector3d>& weights,
                 const std::vector<model::Vector3d>& rest, double area, const Matrix3d& rigidity, model::Model& model) {
  const Matrix3d& d = rigidity;
  if (!rest.empty()) {
    if (model.fold_begin.empty()) model.fold_begin.push_back(0);
    model.fold_fit.push_back(static_cast<Index>(model.fit_area.size()));
    model.fold_place.insert(model.fold_place.end(), rest.begin(), rest.end());
    model.fold_begin.push_back(static_cast<Index>(model.fold_place.size()));
  }
  model.fit_particle.insert(model.fit_particle.end(), particles.begin(), particles.end());
  model.fit_weight.insert(model.fit_weight.end(), weights.begin(), weights.end());
  model.fit_begin.push_back(static_cast<Index>(model.fit_particle.size()));
  model.fit_area.push_back(area);
  model.fit_rigidity.push_back({d(0, 0), d(1, 1), d(2, 2), d(0, 1), d(0, 2), d(1, 2)});
}

void add_fit(const Fit& fit, const Areas& areas, model::Model& model) {
  Matrix3d sum = Matrix3d::Zero(), mean = Matrix3d::Zero();
  for (const auto& [panel, plate] : fit.plate) mean += plate / static_cast<double>(fit.plate.size());
  double area = total(areas);
  for (const PanelArea& a : areas) {
    const Matrix3d* own = &mean;  // handed over from a panel that does not meet here
    for (const auto& [panel, plate] : fit.plate)
      if (panel == a.panel) own = &plate;
    sum += a.area * *own;
  }
  sum /= area;
  Matrix3d sewn = sum;
  stiffen(fit.seam, fit.along, area, sewn);
  add_stencil(fit.curvature.particle, fit.curvature.weight, fit.rest, area, sewn, model);
  if (fit.rest.empty())
    for (const PanelArea& a : areas)
      for (std::size_t slot = 0; slot < fit.plate.size(); ++slot)
        if (fit.plate[slot].first == a.panel)
          add_fit_slip(fit.slip[slot].warp, fit.slip[slot].friction, a.area, fit.plate[slot].second, model);
  const Matrix3d stiff = Matrix3d::Identity() * (kResidualShare * (sum(0, 0) + sum(1, 1)) / 2);
  for (const auto& group : fit.curvature.residual)
    add_stencil(fit.curvature.particle, group, fit.rest, area, stiff, model);
}

}  // namespace

void add_bending(const std::vector<MeshedPanel>& panels, const ClothFields& fields, const Folds& folds,
                 model::Model& model) {
  Sheet sheet = make_sheet(model);
  std::vector<GridStencil> grid = grid_stencils(model);
  std::vector<char> has_stencil(model.n_particles(), 0);
  std::vector<Index> others;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    has_stencil[i] = grid[i].complete();
    if (!has_stencil[i]) others.push_back(static_cast<Index>(i));
  }
  // Several panels, or the legs of a dart, meet at a particle.
  std::vector<char> joined(model.n_particles(), 0);
  std::vector<int> vertices(model.n_particles(), 0);
  for (Index i : model.vertex_particle) joined[i] = ++vertices[i] > 1;
  std::vector<Fit> fits = make_fits(sheet, panels, fields, folds, model, others, joined);
  for (std::size_t k = 0; k < others.size(); ++k) has_stencil[others[k]] = !fits[k].plate.empty();
  std::vector<Areas> areas(model.n_particles());
  for (std::size_t p = 0; p < panels.size(); ++p)
    for (std::size_t v = 0; v < panels[p].vertex_area.size(); ++v)
      add_area(areas[model.vertex_particle[panels[p].first_vertex + v]], static_cast<Index>(p),
               panels[p].vertex_area[v]);
  hand_over_areas(sheet, model, has_stencil, areas);
  add_grid_bending(panels, fields, grid, areas, model);
  model.fit_begin.assign(1, 0);
  for (std::size_t k = 0; k < others.size(); ++k)
    if (has_stencil[others[k]]) add_fit(fits[k], areas[others[k]], model);
}

}  // namespace garment::modeller
