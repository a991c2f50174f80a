#include "runtime/modeller/elements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "runtime/base/number.hpp"
#include "runtime/modeller/inner_friction.hpp"
#include "runtime/modeller/layered_cloth.hpp"
#include "runtime/modeller/tensile_law.hpp"

namespace garment::modeller {
namespace {

using geometry::cross;
using model::Index;

double triangle_area(const PanelMesh& mesh, const std::array<int, 3>& t) {
  return 0.5 * cross(mesh.at[t[1]] - mesh.at[t[0]], mesh.at[t[2]] - mesh.at[t[0]]);
}

/// Width of a square about a place that one element answers for, m.
double cell_width(const MeshedPanel& p) { return std::max(p.frame.hp, p.frame.hq); }

/// The tensile laws of all fabrics, warp and weft, then those of layers and of cloth that regions make stiffer or softer.
class Laws {
 public:
  Laws(const design::Garment& garment, model::Model& model) : model_(model), sliding_(slides(garment)) {
    for (const design::Fabric& fabric : garment.fabrics)
      for (const design::Tensile& tensile : fabric.tensile) {
        model.laws.push_back(make_tensile_law(tensile));
        if (sliding_) model.law_slip.push_back(tensile_slip(tensile, model.laws.back()));
      }
  }
  Index law_of(const ClothAt& cloth, int direction) {
    std::vector<LayeredCloth::Tensile> parts = cloth.tensile(direction);
    const double linear = cloth.linear(direction);
    if (parts.size() == 1 && linear == 0) return scaled(parts[0].law, parts[0].factor);
    std::vector<double> key{linear};
    std::vector<std::pair<const model::TensileLaw*, double>> laws;
    for (const LayeredCloth::Tensile& part : parts) {
      key.insert(key.end(), {static_cast<double>(part.law), part.factor});
      laws.emplace_back(&model_.laws[part.law], part.factor);
    }
    const auto [known, fresh] = made_.emplace(std::move(key), static_cast<Index>(model_.laws.size()));
    if (fresh) {
      model::TensileLaw sum = add_laws(laws, linear);
      model_.laws.push_back(std::move(sum));
      if (sliding_) model_.law_slip.push_back(mean_slip(parts));
    }
    return known->second;
  }

 private:
  /// Of laws together the share that is friction: the mean by what each bears at its recorded load.
  double mean_slip(const std::vector<LayeredCloth::Tensile>& parts) const {
    double sum = 0, all = 0;
    for (const LayeredCloth::Tensile& part : parts) {
      const double force = part.factor * model_.laws[part.law].force.back();
      sum += force * model_.law_slip[part.law];
      all += force;
    }
    return all > 0 ? sum / all : 0;
  }

  Index scaled(int law, double factor) {
    if (factor == 1) return law;
    const auto [known, fresh] = made_.emplace(std::vector<double>{0, static_cast<double>(law), factor},
                                              static_cast<Index>(model_.laws.size()));
    if (!fresh) return known->second;
    model::TensileLaw copy = model_.laws[law];
    for (double& force : copy.force) force *= factor;
    for (double& slope : copy.slope) slope *= factor;
    model_.laws.push_back(std::move(copy));
    if (sliding_) model_.law_slip.push_back(model_.law_slip[law]);
    return known->second;
  }

  model::Model& model_;
  bool sliding_;
  std::map<std::vector<double>, Index> made_;  // by linear part, then law and factor of each
};

/// A panel's elements with the cloth they are made of.
struct PanelElements {
  const MeshedPanel& panel;
  Index index, warp_law;
  const ClothFields& fields;
  Laws& laws;

  bool plain() const { return fields.plain(index); }
  ClothAt cloth(const Point2& middle) const {
    return ClothAt(fields, index, panel.frame, middle, cell_width(panel));
  }
};

void add_springs(const PanelElements& e, model::Model& model) {
  const MeshedPanel& p = e.panel;
  struct HalfSide {
    int u, v;
    double rest, width;
    Index weft;
  };
  std::vector<HalfSide> sides;
  double h1 = p.mesh.cell_size.x(), h2 = p.mesh.cell_size.y();
  for (const auto& c : p.mesh.cells) {
    auto add = [&](int u, int v, double rest, double width, Index weft) {
      sides.push_back({std::min(u, v), std::max(u, v), rest, width, weft});
    };
    add(c[0], c[1], h1, h2 / 2, 1);
    add(c[3], c[2], h1, h2 / 2, 1);
    add(c[0], c[3], h2, h1 / 2, 0);
    add(c[1], c[2], h2, h1 / 2, 0);
  }
  std::sort(sides.begin(), sides.end(),
            [](const HalfSide& a, const HalfSide& b) { return a.u != b.u ? a.u < b.u : a.v < b.v; });
  const Index* particle = model.vertex_particle.data() + p.first_vertex;
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const HalfSide& s = sides[k];
    if (k > 0 && sides[k - 1].u == s.u && sides[k - 1].v == s.v) {
      model.spring_width.back() += s.width;
      continue;
    }
    model.spring.push_back({particle[s.u], particle[s.v]});
    model.spring_rest.push_back(s.rest);
    model.spring_width.push_back(s.width);
    model.spring_law.push_back(e.warp_law + s.weft);
    model.spring_panel.push_back(e.index);
    if (e.plain()) continue;
    const ClothAt cloth = e.cloth((p.mesh.at[s.u] + p.mesh.at[s.v]) / 2);
    model.spring_law.back() = e.laws.law_of(cloth, s.weft);
    model.spring_rest.back() *= cloth.rest(s.weft);
  }
}

void add_membranes(const PanelElements& e, model::Model& model) {
  const MeshedPanel& p = e.panel;
  const Index* particle = model.vertex_particle.data() + p.first_vertex;
  Point2 warp = p.frame.warp(), weft = p.frame.weft();
  for (const auto& t : p.mesh.cut) {
    double area = triangle_area(p.mesh, t);
    std::array<double, 6> weights{};
    for (int k = 0; k < 3; ++k) {
      Point2 opposite = p.mesh.at[t[(k + 2) % 3]] - p.mesh.at[t[(k + 1) % 3]];
      Point2 gradient = Point2(-opposite.y(), opposite.x()) / (2 * area);
      weights[k] = gradient.dot(warp);
      weights[3 + k] = gradient.dot(weft);
    }
    model.membrane.push_back({particle[t[0]], particle[t[1]], particle[t[2]]});
    model.membrane_area.push_back(area);
    model.membrane_law.push_back({e.warp_law, e.warp_law + 1});
    model.membrane_shear.push_back(p.fabric->shear_rigidity);
    model.membrane_panel.push_back(e.index);
    if (!e.plain()) {
      const ClothAt cloth = e.cloth((p.mesh.at[t[0]] + p.mesh.at[t[1]] + p.mesh.at[t[2]]) / 3);
      model.membrane_law.back() = {e.laws.law_of(cloth, 0), e.laws.law_of(cloth, 1)};
      model.membrane_shear.back() = cloth.shear();
      for (int k = 0; k < 3; ++k) {
        weights[k] /= cloth.rest(0);
        weights[3 + k] /= cloth.rest(1);
      }
    }
    model.membrane_weights.push_back(weights);
  }
}

}  // namespace

double twist_rigidity(const design::Fabric& fabric) {
  if (fabric.twist_rigidity > 0) return fabric.twist_rigidity;
  return 0.20 * (fabric.bending_rigidity[0] + fabric.bending_rigidity[1]);
}

std::vector<double> vertex_areas(const PanelMesh& mesh, const Border& border, double area) {
  std::vector<double> share(mesh.at.size(), 0);
  double sum = 0, perimeter = 0;
  for (const auto& t : mesh.cut) {
    double a = triangle_area(mesh, t);
    sum += a;
    for (int v : t) share[v] += a / 3;
  }
  double cell = mesh.cell_size.x() * mesh.cell_size.y();
  for (const auto& c : mesh.cells) {
    sum += cell;
    for (int v : c) share[v] += cell / 4;
  }
  std::size_t n = border.n_outline();
  auto length = [&](std::size_t k) { return (border.at[border.next[k]] - border.at[k]).norm(); };
  for (std::size_t k = 0; k < n; ++k) {
    sum += border.bulge[k];
    perimeter += length(k);
  }
  double rest = (area - sum) / perimeter;  // what quadrature and rounding left over
  for (std::size_t k = 0; k < n; ++k) {
    double part = border.bulge[k] + rest * length(k);
    share[k] += part / 2;
    share[border.next[k]] += part / 2;
  }
  return share;
}

bool add_particles(const design::Garment& garment, const std::vector<MeshedPanel>& panels,
                   const std::vector<double>& areas, const std::vector<Index>& particle,
                   const ClothFields& fields, model::Model& model, Findings& findings) {
  bool ok = true;
  std::size_t n_particles = 0;
  for (Index i : particle) n_particles = std::max(n_particles, static_cast<std::size_t>(i) + 1);
  model.vertex_particle = particle;
  model.mass.assign(n_particles, 0);
  model.thickness.assign(n_particles, 0);
  model.friction.assign(n_particles, 0);
  std::vector<int> shared(n_particles, 0);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const MeshedPanel& p = panels[i];
    model::PanelRange range;
    range.name = p.panel->name;
    range.origin = p.panel->origin;
    range.first_vertex = p.first_vertex;
    range.n_vertices = static_cast<Index>(p.mesh.at.size());
    range.first_triangle = static_cast<Index>(model.triangle.size());
    range.area = areas[i];
    range.mass = p.fabric->areal_density * areas[i];
    range.color = p.fabric->color;
    for (std::size_t v = 0; v < p.mesh.at.size(); ++v) {
      Index at = particle[p.first_vertex + v];
      model.vertex_panel.push_back(static_cast<Index>(i));
      model.vertex_uv.push_back(p.mesh.at[v]);
      double density = p.fabric->areal_density, thickness = p.fabric->thickness, friction = p.fabric->friction;
      if (!fields.plain(i)) {
        const ClothAt cloth(fields, i, p.frame, p.mesh.at[v], cell_width(p));
        density = cloth.areal_density();
        thickness = cloth.thickness();
        friction = cloth.friction();
        range.mass += (density - p.fabric->areal_density) * p.vertex_area[v];
      }
      model.mass[at] += density * p.vertex_area[v];
      model.thickness[at] = std::max(model.thickness[at], thickness);
      model.friction[at] += friction;
      ++shared[at];
    }
    std::size_t folded = 0;
    for (const auto* part : {&p.mesh.cell_halves, &p.mesh.cut}) {
      for (const auto& t : *part) {
        model.triangle.push_back({p.first_vertex + t[0], p.first_vertex + t[1], p.first_vertex + t[2]});
        model.triangle_panel.push_back(static_cast<Index>(i));
        model::Indices<3> c = model.corners(model.triangle.size() - 1);
        folded += c[0] == c[1] || c[1] == c[2] || c[2] == c[0];
      }
    }
    range.n_triangles = static_cast<Index>(model.triangle.size()) - range.first_triangle;
    if (folded > 0) {
      ok = false;
      findings.push_back(
          {"G0551",
           Severity::error,
           fmt::format("the seams of panel `{}` close onto {} of its triangles at a grid of {} mm",
                       p.panel->name, folded, format_number(std::max(p.frame.hp, p.frame.hq) * 1000, 3)),
           {{p.panel->origin, ""}},
           "give the panel a finer resolution, or check that the seams sew different edges together"});
    }
    model.panels.push_back(std::move(range));
  }
  for (std::size_t k = 0; k < n_particles; ++k) model.friction[k] /= shared[k];
  model.gravity = garment.gravity;
  return ok;
}

void add_elements(const design::Garment& garment, const std::vector<MeshedPanel>& panels,
                  const ClothFields& fields, model::Model& model) {
  Laws laws(garment, model);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const MeshedPanel& p = panels[i];
    const PanelElements e{p, static_cast<Index>(i), static_cast<Index>(2 * p.panel->fabric), fields, laws};
    const Index* particle = model.vertex_particle.data() + p.first_vertex;
    for (const auto& c : p.mesh.cells) {
      model.cell.push_back({particle[c[0]], particle[c[1]], particle[c[2]], particle[c[3]]});
      model.cell_size.push_back(p.mesh.cell_size);
      model.cell_shear.push_back(e.plain() ? p.fabric->shear_rigidity
                                           : e.cloth((p.mesh.at[c[0]] + p.mesh.at[c[2]]) / 2).shear());
      model.cell_twist.push_back(0);
    }
    add_springs(e, model);
    add_membranes(e, model);
  }
  if (slides(garment)) add_shear_slip(panels, fields, model);
}

}  // namespace garment::modeller
