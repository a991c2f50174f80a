#include "interpreter/session/drape_answers.hpp"

#include <algorithm>
#include <array>

#include "interpreter/session/recorder.hpp"
#include "runtime/model/flat_index.hpp"
#include "runtime/results/shadow.hpp"
#include "runtime/results/stress.hpp"

namespace garment::session {

DrapeAnswers::DrapeAnswers(const design::Garment& garment, const std::vector<body::Body>& bodies,
                           const model::Model& model, const model::State& state,
                           const simulator::DrapeReport& report, const Recorder* recorder)
    : garment_(garment), bodies_(bodies), model_(model), state_(state), report_(report), recorder_(recorder) {}

const results::StrainReport& DrapeAnswers::strains() const {
  if (!strain_) strain_ = results::measure_strain(model_, state_);
  return *strain_;
}

const results::Measures& DrapeAnswers::measures() const {
  if (!measures_) measures_ = results::measure(model_, state_, bodies_);
  return *measures_;
}

const results::PanelStrain* DrapeAnswers::strain_of(const std::string& panel) const {
  if (panel.empty()) return &strains().all;
  for (const results::PanelStrain& s : strains().panels)
    if (s.panel == panel) return &s;
  return nullptr;
}

const results::PanelMeasure* DrapeAnswers::measure_of(const std::string& panel) const {
  if (panel.empty()) return &measures().all;
  for (const results::PanelMeasure& m : measures().panels)
    if (m.panel == panel) return &m;
  return nullptr;
}

std::optional<double> DrapeAnswers::strain(const std::string& panel) const {
  const results::PanelStrain* s = strain_of(panel);
  return s ? std::optional(s->any.largest) : std::nullopt;
}

std::optional<double> DrapeAnswers::shear(const std::string& panel) const {
  const results::PanelStrain* s = strain_of(panel);
  return s ? std::optional(s->largest_shear) : std::nullopt;
}

std::optional<double> DrapeAnswers::stress(const std::string& panel) const {
  return results::largest_tension(model_, state_, panel);
}

std::optional<double> DrapeAnswers::length(const std::vector<design::EdgePart>& parts) const {
  double sum = 0;
  for (const design::EdgePart& p : parts) {
    const geometry::Curve& curve = design::edge_of(garment_.panels[p.panel], p).curve;
    auto length = results::draped_length(model_, state_, p.panel, curve, std::min(p.from, p.to),
                                         std::max(p.from, p.to));
    if (!length) return std::nullopt;
    sum += *length;
  }
  return sum;
}

std::optional<double> DrapeAnswers::area(const std::string& panel) const {
  const results::PanelMeasure* m = measure_of(panel);
  return m ? std::optional(m->draped_area) : std::nullopt;
}

std::optional<double> DrapeAnswers::mass(const std::string& panel) const {
  const results::PanelMeasure* m = measure_of(panel);
  return m ? std::optional(m->mass) : std::nullopt;
}

std::optional<double> DrapeAnswers::clearance(const std::string& panel) const {
  const results::PanelMeasure* m = measure_of(panel);
  if (!m || !m->clearance) return std::nullopt;
  return m->clearance->least;
}

std::optional<double> DrapeAnswers::drape_coefficient(int panel) const {
  return results::drape_coefficient(model_, state_, bodies_, panel);
}

std::optional<double> DrapeAnswers::nodes(int panel) const {
  const std::optional<int> folds = results::count_nodes(model_, state_, panel);
  return folds ? std::optional<double>(*folds) : std::nullopt;
}

std::optional<double> DrapeAnswers::penetrations() const {
  return static_cast<double>(report_.self_intersections + report_.body_intersections + report_.inside_body);
}

std::optional<Eigen::Vector3d> DrapeAnswers::reaction(const std::string& holder) const {
  for (std::size_t h = 0; h < std::min(model_.holders.size(), report_.reactions.size()); ++h)
    if (model_.holders[h].name == holder) return report_.reactions[h];
  return std::nullopt;
}

std::optional<Eigen::Vector3d> DrapeAnswers::moment(const std::string& holder) const {
  for (std::size_t h = 0; h < std::min(model_.holders.size(), report_.moments.size()); ++h)
    if (model_.holders[h].name == holder) return report_.moments[h];
  return std::nullopt;
}

const interpreter::CurvePoints* DrapeAnswers::curve(const std::string& path) const {
  return recorder_ == nullptr ? nullptr : recorder_->curve(path);
}

/// A pin holds the particle next to its point: that is where it is.
std::optional<Eigen::Vector3d> DrapeAnswers::position(int pin) const {
  if (pin < 0 || pin >= static_cast<int>(garment_.pins.size())) return std::nullopt;
  const design::Pin& held = garment_.pins[pin];
  if (held.panel < 0 || held.panel >= static_cast<int>(model_.panels.size())) return std::nullopt;
  const model::PanelRange& range = model_.panels[held.panel];
  model::Index best = -1;
  for (model::Index v = range.first_vertex; v < range.first_vertex + range.n_vertices; ++v)
    if (best < 0 ||
        (model_.vertex_uv[v] - held.point).squaredNorm() < (model_.vertex_uv[best] - held.point).squaredNorm())
      best = v;
  if (best < 0) return std::nullopt;
  return state_.position[model_.vertex_particle[best]];
}

/// On the triangle that holds the point; beyond the border at the border.
std::optional<Eigen::Vector3d> DrapeAnswers::position(int panel, const design::Point2& point) const {
  if (panel < 0 || panel >= static_cast<int>(model_.panels.size())) return std::nullopt;
  std::array<double, 3> weights{};
  const model::Index t = model::FlatIndex(model_, panel).locate(point, weights);
  if (t < 0) return std::nullopt;
  double sum = 0;
  for (double& w : weights) sum += w = std::max(w, 0.0);
  const model::Indices<3> corner = model_.corners(static_cast<std::size_t>(t));
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k) at += weights[k] / sum * state_.position[corner[k]];
  return at;
}

}  // namespace garment::session
