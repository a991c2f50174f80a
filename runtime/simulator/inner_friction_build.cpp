// The sliders of a Model: how stiff each is, and when it slips.
#include <algorithm>

#include "runtime/simulator/elastic_stencils.hpp"
#include "runtime/simulator/inner_friction.hpp"

namespace garment::simulator {
namespace {

using model::Index;
using model::Indices;

constexpr double kBendPreSlip = 15;                           // of B
constexpr double kShearPreSlip = 0.1 * 0.017453292519943295;  // rad, by which the larger yield gives way
constexpr double kMostSoftening = 0.9;                        // of G, by which friction may lower the elastic slope of shear

/// The yield, with the elastic slope still above zero; its slider's stiffness.
ShearYield shear_yield(const model::Vector2d& slip, double rigidity) {
  ShearYield yield(slip[0], slip[1]);
  if (yield.rise > kMostSoftening * rigidity) {
    yield.rise = kMostSoftening * rigidity;
    yield.base = slip[0] - yield.rise * ShearYield::kFirst;
  }
  return yield;
}
double shear_stiffness(const model::Vector2d& slip) { return std::max(slip[0], slip[1]) / kShearPreSlip; }

}  // namespace

InnerFriction::InnerFriction(const model::Model& model, const ElasticModel& elastic) : stencils_(elastic.stencils()) {
  present_ = !model.law_slip.empty() || !model.cell_slip.empty() || !model.membrane_slip.empty() || !model.bend_slip.empty() ||
             !model.fit_slip.empty();
  if (!present_) return;
  normal_slot_.assign(model.n_particles(), -1);
  add_springs(model);
  add_cells(model);
  add_membranes(model);
  add_bends(model);
  add_fits(model);
  add_fans(model);
  reset();
  idle_ = false;
}

std::int32_t InnerFriction::place(Index a, Index b) const {
  return a == b ? -1 : 2 * stencils_.pattern->find(std::min(a, b), std::max(a, b)) + (a > b ? 1 : 0);
}

void InnerFriction::add_springs(const model::Model& m) {
  laws_.assign(m.laws.size(), {0, 0});
  if (m.law_slip.empty()) return;
  for (std::size_t l = 0; l < m.laws.size(); ++l)
    laws_[l] = {m.law_slip[l], model::kTensilePreSlip * *std::max_element(m.laws[l].slope.begin(), m.laws[l].slope.end())};
  for (std::size_t k = 0; k < m.spring.size(); ++k) {
    const auto& p = m.spring[k];
    springs_.push_back({p, m.spring_law[k], m.spring_rest[k], m.spring_width[k], place(p[0], p[1])});
  }
}

void InnerFriction::add_cells(const model::Model& m) {
  for (std::size_t k = 0; k < m.cell_slip.size(); ++k) {
    const auto& p = m.cell[k];
    cells_.push_back({p, 0.25 * m.cell_size[k][0] * m.cell_size[k][1], shear_stiffness(m.cell_slip[k]),
                      shear_yield(m.cell_slip[k], m.cell_shear[k]),
                      {place(p[0], p[1]), place(p[0], p[2]), place(p[0], p[3]), place(p[1], p[2]), place(p[1], p[3]),
                       place(p[2], p[3])}});
  }
}

void InnerFriction::add_membranes(const model::Model& m) {
  for (std::size_t k = 0; k < m.membrane_slip.size(); ++k) {
    const auto& p = m.membrane[k];
    membranes_.push_back({p, m.membrane_law[k], m.membrane_weights[k], m.membrane_area[k], shear_stiffness(m.membrane_slip[k]),
                          shear_yield(m.membrane_slip[k], m.membrane_shear[k]),
                          {place(p[0], p[1]), place(p[0], p[2]), place(p[1], p[2])}});
  }
}

void InnerFriction::add_bends(const model::Model& m) {
  std::vector<Index> crease(m.bend.size(), -1);
  for (std::size_t c = 0; c < m.crease_bend.size(); ++c) crease[static_cast<std::size_t>(m.crease_bend[c])] = static_cast<Index>(c);
  for (std::size_t k = 0; k < m.bend_slip.size(); ++k) {
    const auto& p = m.bend[k];
    const double hbar = 0.5 * (m.bend_lengths[k][0] + m.bend_lengths[k][1]);
    bends_.push_back({p, kBendPreSlip * m.bend_width[k] * m.bend_rigidity[k] / hbar, m.bend_width[k] * m.bend_slip[k], crease[k],
                      {place(p[0], p[1]), place(p[0], p[2]), place(p[1], p[2])}});
    normal_slot_[static_cast<std::size_t>(p[1])] = 0;
  }
}

void InnerFriction::add_fits(const model::Model& m) {
  for (std::size_t k = 0; k < m.fit_slip.size(); ++k) {
    const auto fit = static_cast<std::size_t>(m.fit_slip[k]);
    Fit s{fit_particle_.size(), 0, fit_place_.size(), m.fit_slip_particle[k], kBendPreSlip * m.fit_slip_rigidity[k],
          m.fit_slip_moment[k]};
    for (Index j = m.fit_begin[fit]; j < m.fit_begin[fit + 1]; ++j) {
      fit_particle_.push_back(m.fit_particle[static_cast<std::size_t>(j)]);
      fit_weight_.push_back(m.fit_weight[static_cast<std::size_t>(j)].dot(m.fit_slip_way[k]));
    }
    s.end = fit_particle_.size();
    for (std::size_t a = s.begin; a < s.end; ++a)
      for (std::size_t b = a + 1; b < s.end; ++b) fit_place_.push_back(place(fit_particle_[a], fit_particle_[b]));
    fits_.push_back(s);
    normal_slot_[static_cast<std::size_t>(s.particle)] = 0;
  }
}

void InnerFriction::add_fans(const model::Model& m) {
  for (std::size_t i = 0; i < normal_slot_.size(); ++i) {
    if (normal_slot_[i] < 0) continue;
    normal_slot_[i] = static_cast<std::int32_t>(normal_of_.size());
    normal_of_.push_back(static_cast<Index>(i));
  }
  std::vector<std::vector<Indices<2>>> fans(normal_of_.size());
  for (std::size_t t = 0; t < m.n_triangles(); ++t) {
    const Indices<3> c = m.corners(t);
    for (std::size_t k = 0; k < 3; ++k)
      if (const std::int32_t slot = normal_slot_[static_cast<std::size_t>(c[k])]; slot >= 0)
        fans[static_cast<std::size_t>(slot)].push_back({c[(k + 1) % 3], c[(k + 2) % 3]});
  }
  fan_begin_.push_back(0);
  for (const auto& fan : fans) {
    fan_.insert(fan_.end(), fan.begin(), fan.end());
    fan_begin_.push_back(fan_.size());
  }
}

/// Sets the sliders' reach about the anchors that they have.
void InnerFriction::reset() {
  const std::size_t sizes[] = {springs_.size(), 4 * cells_.size(), 3 * membranes_.size(), bends_.size(), fits_.size()};
  for (std::size_t list = 0; list < sliders_.size(); ++list) {
    sliders_[list].resize(sizes[list]);
    ahead_[list].assign(sizes[list], 0);
    slopes_[list].assign(sizes[list], 0);
  }
  auto pulls = [&](std::size_t list, std::size_t slot, Index law) {
    const auto l = static_cast<std::size_t>(law);
    set_reach(sliders_[list][slot], laws_[l].stiffness, TensileYield{stencils_.laws[l], laws_[l].share});
  };
  for (std::size_t k = 0; k < springs_.size(); ++k) pulls(kSprings, k, springs_[k].law);
  for (std::size_t k = 0; k < 4 * cells_.size(); ++k) set_reach(sliders_[kCells][k], cells_[k / 4].stiffness, cells_[k / 4].yield);
  for (std::size_t k = 0; k < membranes_.size(); ++k) {
    for (std::size_t d = 0; d < 2; ++d) pulls(kMembranes, 3 * k + d, membranes_[k].law[d]);
    set_reach(sliders_[kMembranes][3 * k + 2], membranes_[k].stiffness, membranes_[k].yield);
  }
  for (std::size_t k = 0; k < bends_.size(); ++k) set_reach(sliders_[kBends][k], bends_[k].stiffness, ConstantYield{bends_[k].yield});
  for (std::size_t k = 0; k < fits_.size(); ++k) set_reach(sliders_[kFits][k], fits_[k].stiffness, ConstantYield{fits_[k].yield});
}

}  // namespace garment::simulator
