#include "runtime/model/part.hpp"

#include <algorithm>

namespace garment::model {
namespace {

class Cut {
 public:
  Cut(const Model& whole, const std::vector<char>& free, const std::vector<char>& near, const std::vector<Vector3d>& x)
      : w_(whole), free_(free), near_(near), x_(x), in_(free) {}

  Part take() {
    mark();
    number();
    triangles();
    stencils();
    holds();
    loads();
    m_.laws = w_.laws;
    m_.air = w_.air;
    m_.gravity = w_.gravity;
    return std::move(out_);
  }

 private:
  template <std::size_t N>
  bool moves(const std::array<Index, N>& ids) const {
    return std::any_of(ids.begin(), ids.end(), [&](Index i) { return free_[i] != 0; });
  }
  bool fit_moves(std::size_t f) const {
    for (Index j = w_.fit_begin[f]; j < w_.fit_begin[f + 1]; ++j)
      if (free_[w_.fit_particle[j]] != 0) return true;
    return false;
  }
  bool shown(std::size_t t) const { return near_[t] != 0 || moves(w_.corners(t)); }
  template <std::size_t N>
  void take_in(const std::array<Index, N>& ids) {
    for (Index i : ids) in_[i] = 1;
  }
  template <class Items>
  void mark_of(const Items& items) {
    for (const auto& ids : items)
      if (moves(ids)) take_in(ids);
  }

  void mark() {
    for (std::size_t t = 0; t < w_.n_triangles(); ++t)
      if (shown(t)) take_in(w_.corners(t));
    mark_of(w_.spring);
    mark_of(w_.cell);
    mark_of(w_.membrane);
    mark_of(w_.bend);
    mark_of(w_.tie);
    for (std::size_t f = 0; f + 1 < w_.fit_begin.size(); ++f)
      if (fit_moves(f))
        for (Index j = w_.fit_begin[f]; j < w_.fit_begin[f + 1]; ++j) in_[w_.fit_particle[j]] = 1;
    for (std::size_t k = 0; k < w_.crease_bend.size(); ++k)
      if (moves(w_.bend[w_.crease_bend[k]])) take_in(w_.crease_axis[k]);
  }

  void number() {
    id_.assign(w_.n_particles(), -1);
    for (std::size_t i = 0; i < in_.size(); ++i) {
      if (in_[i] == 0) continue;
      id_[i] = static_cast<Index>(out_.particle.size());
      out_.particle.push_back(static_cast<Index>(i));
      out_.free.push_back(free_[i]);
      m_.mass.push_back(w_.mass[i]);
      m_.start.push_back(x_[i]);
      m_.thickness.push_back(w_.thickness[i]);
      m_.friction.push_back(w_.friction[i]);
      if (!w_.damping.empty()) m_.damping.push_back(w_.damping[i]);
    }
    for (std::size_t k = 0; k < w_.pad_particle.size(); ++k)
      if (const Index i = id_[w_.pad_particle[k]]; i >= 0) {
        m_.pad_particle.push_back(i);
        m_.pad_thickness.push_back(w_.pad_thickness[k]);
      }
    for (std::size_t k = 0; k < w_.rub_particle.size(); ++k)
      if (const Index i = id_[w_.rub_particle[k]]; i >= 0) {
        m_.rub_particle.push_back(i);
        m_.rub_body.push_back(w_.rub_body[k]);
        m_.rub_factor.push_back(w_.rub_factor[k]);
      }
  }

  template <std::size_t N>
  std::array<Index, N> renamed(std::array<Index, N> ids) const {
    for (Index& i : ids) i = id_[i];
    return ids;
  }

  void triangles() {
    std::vector<Index> vertex(w_.n_vertices(), -1);
    triangle_.assign(w_.n_triangles(), -1);
    for (std::size_t t = 0; t < w_.n_triangles(); ++t)
      if (shown(t))
        for (Index v : w_.triangle[t]) vertex[v] = 0;
    for (const PanelRange& range : w_.panels) {
      PanelRange part = range;
      part.first_vertex = static_cast<Index>(m_.vertex_particle.size());
      for (Index v = range.first_vertex; v < range.first_vertex + range.n_vertices; ++v) {
        if (vertex[v] < 0) continue;
        vertex[v] = static_cast<Index>(m_.vertex_particle.size());
        m_.vertex_particle.push_back(id_[w_.vertex_particle[v]]);
        m_.vertex_panel.push_back(w_.vertex_panel[v]);
        m_.vertex_uv.push_back(w_.vertex_uv[v]);
      }
      part.n_vertices = static_cast<Index>(m_.vertex_particle.size()) - part.first_vertex;
      part.first_triangle = static_cast<Index>(m_.triangle.size());
      for (auto t = static_cast<std::size_t>(range.first_triangle); t < static_cast<std::size_t>(range.first_triangle + range.n_triangles); ++t) {
        if (!shown(t)) continue;
        triangle_[t] = static_cast<Index>(m_.triangle.size());
        Indices<3> corner = w_.triangle[t];
        for (Index& v : corner) v = vertex[v];
        m_.triangle.push_back(corner);
        m_.triangle_panel.push_back(w_.triangle_panel[t]);
      }
      part.n_triangles = static_cast<Index>(m_.triangle.size()) - part.first_triangle;
      m_.panels.push_back(part);
    }
    m_.rub_panels = w_.rub_panels;
    m_.rub_panels_factor = w_.rub_panels_factor;
  }

  void stencils() {
    for (std::size_t s = 0; s < w_.spring.size(); ++s) {
      if (!moves(w_.spring[s])) continue;
      m_.spring.push_back(renamed(w_.spring[s]));
      m_.spring_rest.push_back(w_.spring_rest[s]);
      m_.spring_width.push_back(w_.spring_width[s]);
      m_.spring_law.push_back(w_.spring_law[s]);
      m_.spring_panel.push_back(w_.spring_panel[s]);
    }
    std::vector<Index> cell(w_.cell.size(), -1);
    for (std::size_t c = 0; c < w_.cell.size(); ++c) {
      if (!moves(w_.cell[c])) continue;
      cell[c] = static_cast<Index>(m_.cell.size());
      m_.cell.push_back(renamed(w_.cell[c]));
      m_.cell_size.push_back(w_.cell_size[c]);
      m_.cell_shear.push_back(w_.cell_shear[c]);
      m_.cell_twist.push_back(w_.cell_twist[c]);
    }
    for (std::size_t k = 0; k < w_.twist_cell.size(); ++k)
      if (const Index c = cell[w_.twist_cell[k]]; c >= 0) {
        m_.twist_cell.push_back(c);
        m_.twist_rest.push_back(w_.twist_rest[k]);
      }
    for (std::size_t c = 0; c < w_.membrane.size(); ++c) {
      if (!moves(w_.membrane[c])) continue;
      m_.membrane.push_back(renamed(w_.membrane[c]));
      m_.membrane_weights.push_back(w_.membrane_weights[c]);
      m_.membrane_area.push_back(w_.membrane_area[c]);
      m_.membrane_law.push_back(w_.membrane_law[c]);
      m_.membrane_shear.push_back(w_.membrane_shear[c]);
      m_.membrane_panel.push_back(w_.membrane_panel[c]);
    }
    bends();
    fits();
    ties();
  }

  void bends() {
    std::vector<Index> bend(w_.bend.size(), -1);
    for (std::size_t b = 0; b < w_.bend.size(); ++b) {
      if (!moves(w_.bend[b])) continue;
      bend[b] = static_cast<Index>(m_.bend.size());
      m_.bend.push_back(renamed(w_.bend[b]));
      m_.bend_lengths.push_back(w_.bend_lengths[b]);
      m_.bend_width.push_back(w_.bend_width[b]);
      m_.bend_rigidity.push_back(w_.bend_rigidity[b]);
    }
    for (std::size_t k = 0; k < w_.crease_bend.size(); ++k)
      if (const Index b = bend[w_.crease_bend[k]]; b >= 0) {
        m_.crease_bend.push_back(b);
        m_.crease_angle.push_back(w_.crease_angle[k]);
        m_.crease_axis.push_back(renamed(w_.crease_axis[k]));
      }
  }

  void fits() {
    const std::size_t n = w_.fit_begin.empty() ? 0 : w_.fit_begin.size() - 1;
    std::vector<Index> fit(n, -1);
    m_.fit_begin.push_back(0);
    for (std::size_t f = 0; f < n; ++f) {
      if (!fit_moves(f)) continue;
      fit[f] = static_cast<Index>(m_.fit_area.size());
      for (Index j = w_.fit_begin[f]; j < w_.fit_begin[f + 1]; ++j) {
        m_.fit_particle.push_back(id_[w_.fit_particle[j]]);
        m_.fit_weight.push_back(w_.fit_weight[j]);
      }
      m_.fit_begin.push_back(static_cast<Index>(m_.fit_particle.size()));
      m_.fit_area.push_back(w_.fit_area[f]);
      m_.fit_rigidity.push_back(w_.fit_rigidity[f]);
    }
    if (w_.fold_fit.empty()) return;
    m_.fold_begin.push_back(0);
    for (std::size_t k = 0; k < w_.fold_fit.size(); ++k) {
      if (fit[w_.fold_fit[k]] < 0) continue;
      m_.fold_fit.push_back(fit[w_.fold_fit[k]]);
      for (Index j = w_.fold_begin[k]; j < w_.fold_begin[k + 1]; ++j) m_.fold_place.push_back(w_.fold_place[j]);
      m_.fold_begin.push_back(static_cast<Index>(m_.fold_place.size()));
    }
  }

  void ties() {
    std::vector<Index> tie(w_.tie.size(), -1);
    for (std::size_t t = 0; t < w_.tie.size(); ++t) {
      if (!moves(w_.tie[t])) continue;
      tie[t] = static_cast<Index>(m_.tie.size());
      m_.tie.push_back(renamed(w_.tie[t]));
      m_.tie_weights.push_back(w_.tie_weights[t]);
      m_.tie_length.push_back(w_.tie_length[t]);
      m_.tie_stiffness.push_back(w_.tie_stiffness[t]);
      m_.tie_closure.push_back(w_.tie_closure[t]);
    }
    for (Index t : w_.rod_tie)
      if (tie[t] >= 0) m_.rod_tie.push_back(tie[t]);
    m_.closures = w_.closures;
  }

  void holds() {
    for (std::size_t h = 0; h < w_.hold_particle.size(); ++h) {
      const Index i = w_.hold_particle[h];
      if (free_[i] == 0) continue;
      m_.hold_particle.push_back(id_[i]);
      m_.hold_kind.push_back(w_.hold_kind[h]);
      m_.hold_point.push_back(w_.hold_point[h]);
      m_.hold_normal.push_back(w_.hold_normal[h]);
    }
    for (std::size_t k = 0; k < out_.particle.size(); ++k) {
      if (out_.free[k] != 0) continue;
      m_.hold_particle.push_back(static_cast<Index>(k));
      m_.hold_kind.push_back(HoldKind::point);
      m_.hold_point.push_back(x_[out_.particle[k]]);
      m_.hold_normal.push_back(Vector3d::UnitY());
    }
  }

  void loads() {
    for (std::size_t k = 0; k < w_.load_particle.size(); ++k)
      if (const Index i = id_[w_.load_particle[k]]; i >= 0) {
        m_.load_particle.push_back(i);
        m_.load_force.push_back(w_.load_force[k]);
      }
    for (std::size_t k = 0; k < w_.pressed_triangle.size(); ++k)
      if (const Index t = triangle_[w_.pressed_triangle[k]]; t >= 0) {
        m_.pressed_triangle.push_back(t);
        m_.pressed_pascals.push_back(w_.pressed_pascals[k]);
      }
  }

  const Model& w_;
  const std::vector<char>& free_;
  const std::vector<char>& near_;
  const std::vector<Vector3d>& x_;
  std::vector<char> in_;
  std::vector<Index> id_, triangle_;
  Part out_;
  Model& m_ = out_.model;
};

}  // namespace

Part part_of(const Model& whole, const std::vector<char>& free, const std::vector<char>& near, const std::vector<Vector3d>& x) {
  return Cut(whole, free, near, x).take();
}

}  // namespace garment::model
