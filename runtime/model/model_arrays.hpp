#pragma once
// The one list of the Model's arrays. Checking, hashing and dumping are expanded from it; a new array of the
// Model gets a line here and nothing else.
#include <cstddef>

#include "runtime/model/model.hpp"

namespace garment::model {

/// What an array has one row for, and what its indices refer to.
enum class Rows {
  particle,
  vertex,
  triangle,
  spring,
  cell,
  membrane,
  bend,
  fit,
  fit_bound,
  fit_entry,
  hold,
  tie,
  crease,
  fold,
  fold_bound,
  fold_entry,
  twist,
  pad,
  rod,
  load,
  pressed,
  rub,
  rub_panels,
  damped,
  slid_law,
  slid_cell,
  slid_membrane,
  slid_bend,
  slid_fit,
  moved,
  motion,
  panel,
  law,
  closure,
  none
};

/// Rows that most garments have none of.
inline bool is_rare(Rows rows) {
  switch (rows) {
    case Rows::tie:
    case Rows::crease:
    case Rows::fold:
    case Rows::fold_bound:
    case Rows::fold_entry:
    case Rows::twist:
    case Rows::pad:
    case Rows::rod:
    case Rows::load:
    case Rows::pressed:
    case Rows::rub:
    case Rows::rub_panels:
    case Rows::damped:
    case Rows::slid_law:
    case Rows::slid_cell:
    case Rows::slid_membrane:
    case Rows::slid_bend:
    case Rows::slid_fit:
    case Rows::moved:
      return true;
    default:
      return false;
  }
}

/// Number of rows of that kind.
inline std::size_t row_count(const Model& m, Rows rows) {
  switch (rows) {
    case Rows::particle:
      return m.mass.size();
    case Rows::vertex:
      return m.vertex_particle.size();
    case Rows::triangle:
      return m.triangle.size();
    case Rows::spring:
      return m.spring.size();
    case Rows::cell:
      return m.cell.size();
    case Rows::membrane:
      return m.membrane.size();
    case Rows::bend:
      return m.bend.size();
    case Rows::fit:
      return m.fit_area.size();
    case Rows::fit_bound:
      return m.fit_area.size() + 1;
    case Rows::fit_entry:
      return m.fit_particle.size();
    case Rows::hold:
      return m.hold_particle.size();
    case Rows::tie:
      return m.tie.size();
    case Rows::crease:
      return m.crease_bend.size();
    case Rows::fold:
      return m.fold_fit.size();
    case Rows::fold_bound:
      return m.fold_fit.empty() ? m.fold_begin.size() : m.fold_fit.size() + 1;
    case Rows::fold_entry:
      return m.fold_place.size();
    case Rows::twist:
      return m.twist_cell.size();
    case Rows::pad:
      return m.pad_particle.size();
    case Rows::rod:
      return m.rod_tie.size();
    case Rows::load:
      return m.load_particle.size();
    case Rows::pressed:
      return m.pressed_triangle.size();
    case Rows::rub:
      return m.rub_particle.size();
    case Rows::rub_panels:
      return m.rub_panels.size();
    case Rows::damped:
      return m.damping.empty() ? 0 : m.mass.size();
    case Rows::slid_law:
      return m.law_slip.empty() ? 0 : m.laws.size();
    case Rows::slid_cell:
      return m.cell_slip.empty() ? 0 : m.cell.size();
    case Rows::slid_membrane:
      return m.membrane_slip.empty() ? 0 : m.membrane.size();
    case Rows::slid_bend:
      return m.bend_slip.empty() ? 0 : m.bend.size();
    case Rows::slid_fit:
      return m.fit_slip.size();
    case Rows::moved:
      return m.moved_hold.size();
    case Rows::motion:
      return m.motions.size();
    case Rows::panel:
      return m.panels.size();
    case Rows::law:
      return m.laws.size();
    case Rows::closure:
      return m.closures.size();
    case Rows::none:
      break;
  }
  return 0;
}

}  // namespace garment::model

/// X(name, rows, refers_to, sign, unit): `sign` is what each number must be: positive, not_negative, any.
// clang-format off
#define GARMENT_MODEL_ARRAYS(X)                                    \
  X(mass,             particle,  none,      positive,     "kg")    \
  X(start,            particle,  none,      any,          "m")     \
  X(thickness,        particle,  none,      not_negative, "m")     \
  X(friction,         particle,  none,      not_negative, "")      \
  X(vertex_particle,  vertex,    particle,  any,          "")      \
  X(vertex_panel,     vertex,    panel,     any,          "")      \
  X(vertex_uv,        vertex,    none,      any,          "m")     \
  X(triangle,         triangle,  vertex,    any,          "")      \
  X(triangle_panel,   triangle,  panel,     any,          "")      \
  X(spring,           spring,    particle,  any,          "")      \
  X(spring_rest,      spring,    none,      positive,     "m")     \
  X(spring_width,     spring,    none,      positive,     "m")     \
  X(spring_law,       spring,    law,       any,          "")      \
  X(spring_panel,     spring,    panel,     any,          "")      \
  X(cell,             cell,      particle,  any,          "")      \
  X(cell_size,        cell,      none,      positive,     "m")     \
  X(cell_shear,       cell,      none,      not_negative, "N/m")   \
  X(cell_twist,       cell,      none,      not_negative, "N m")   \
  X(membrane,         membrane,  particle,  any,          "")      \
  X(membrane_weights, membrane,  none,      any,          "1/m")   \
  X(membrane_area,    membrane,  none,      positive,     "m^2")   \
  X(membrane_law,     membrane,  law,       any,          "")      \
  X(membrane_shear,   membrane,  none,      not_negative, "N/m")   \
  X(membrane_panel,   membrane,  panel,     any,          "")      \
  X(bend,             bend,      particle,  any,          "")      \
  X(bend_lengths,     bend,      none,      positive,     "m")     \
  X(bend_width,       bend,      none,      positive,     "m")     \
  X(bend_rigidity,    bend,      none,      not_negative, "N m")   \
  X(fit_begin,        fit_bound, fit_entry, any,          "")      \
  X(fit_particle,     fit_entry, particle,  any,          "")      \
  X(fit_weight,       fit_entry, none,      any,          "1/m^2") \
  X(fit_area,         fit,       none,      positive,     "m^2")   \
  X(fit_rigidity,     fit,       none,      any,          "N m")   \
  X(hold_particle,    hold,      particle,  any,          "")      \
  X(hold_kind,        hold,      none,      any,          "")      \
  X(hold_point,       hold,      none,      any,          "m")     \
  X(hold_normal,      hold,      none,      any,          "")      \
  X(tie,              tie,       particle,  any,          "")      \
  X(tie_weights,      tie,       none,      not_negative, "")      \
  X(tie_length,       tie,       none,      not_negative, "m")     \
  X(tie_stiffness,    tie,       none,      positive,     "N/m")   \
  X(tie_closure,      tie,       closure,   any,          "")      \
  X(crease_bend,      crease,    bend,      any,          "")      \
  X(crease_angle,     crease,    none,      any,          "rad")   \
  X(crease_axis,      crease,    particle,  any,          "")      \
  X(fold_fit,         fold,      fit,       any,          "")      \
  X(fold_begin,       fold_bound, fold_entry, any,        "")      \
  X(fold_place,       fold_entry, none,     any,          "m")     \
  X(twist_cell,       twist,     cell,      any,          "")      \
  X(twist_rest,       twist,     none,      any,          "1/m")   \
  X(pad_particle,     pad,       particle,  any,          "")      \
  X(pad_thickness,    pad,       none,      positive,     "m")     \
  X(rod_tie,          rod,       tie,       any,          "")      \
  X(load_particle,    load,      particle,  any,          "")      \
  X(load_force,       load,      none,      any,          "N")     \
  X(pressed_triangle, pressed,   triangle,  any,          "")      \
  X(pressed_pascals,  pressed,   none,      any,          "Pa")    \
  X(rub_particle,     rub,       particle,  any,          "")      \
  X(rub_body,         rub,       none,      any,          "")      \
  X(rub_factor,       rub,       none,      not_negative, "")      \
  X(rub_panels,       rub_panels, panel,    any,          "")      \
  X(rub_panels_factor, rub_panels, none,    not_negative, "")      \
  X(damping,          damped,    none,      not_negative, "s")     \
  X(law_slip,         slid_law,  none,      not_negative, "")      \
  X(cell_slip,        slid_cell, none,      not_negative, "N/m")   \
  X(membrane_slip,    slid_membrane, none,  not_negative, "N/m")   \
  X(bend_slip,        slid_bend, none,      not_negative, "N")     \
  X(fit_slip,         slid_fit,  fit,       any,          "")      \
  X(fit_slip_particle, slid_fit, particle,  any,          "")      \
  X(fit_slip_way,     slid_fit,  none,      any,          "")      \
  X(fit_slip_moment,  slid_fit,  none,      not_negative, "N m^2") \
  X(fit_slip_rigidity, slid_fit, none,      not_negative, "N m^3") \
  X(moved_hold,       moved,     hold,      any,          "")      \
  X(moved_by,         moved,     motion,    any,          "")
// clang-format on
