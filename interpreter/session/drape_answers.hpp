#pragma once
// Answers what `expect` and `measure` ask of a finished drape.
#include "interpreter/language/interpret.hpp"
#include "runtime/model/model.hpp"
#include "runtime/results/measures.hpp"
#include "runtime/results/strain.hpp"

namespace garment::session {

class Recorder;

class DrapeAnswers final : public interpreter::DrapeMeasures {
 public:
  DrapeAnswers(const design::Garment& garment, const std::vector<body::Body>& bodies,
               const model::Model& model, const model::State& state, const simulator::DrapeReport& report,
               const Recorder* recorder = nullptr);

  std::optional<double> strain(const std::string& panel) const override;
  std::optional<double> shear(const std::string& panel) const override;
  std::optional<double> stress(const std::string& panel) const override;
  std::optional<double> length(const std::vector<design::EdgePart>& parts) const override;
  std::optional<double> area(const std::string& panel) const override;
  std::optional<double> mass(const std::string& panel) const override;
  std::optional<double> clearance(const std::string& panel) const override;
  std::optional<double> energy() const override { return report_.energy; }
  std::optional<double> penetrations() const override;
  std::optional<Eigen::Vector3d> reaction(const std::string& holder) const override;
  std::optional<Eigen::Vector3d> moment(const std::string& holder) const override;
  const interpreter::CurvePoints* curve(const std::string& path) const override;
  std::optional<double> elapsed() const override { return state_.time; }
  std::optional<double> drape_coefficient(int panel) const override;
  std::optional<double> nodes(int panel) const override;
  std::optional<Eigen::Vector3d> position(int pin) const override;
  std::optional<Eigen::Vector3d> position(int panel, const design::Point2& point) const override;

 private:
  const results::StrainReport& strains() const;
  const results::Measures& measures() const;
  const results::PanelStrain* strain_of(const std::string& panel) const;
  const results::PanelMeasure* measure_of(const std::string& panel) const;

  const design::Garment& garment_;
  const std::vector<body::Body>& bodies_;
  const model::Model& model_;
  const model::State& state_;
  const simulator::DrapeReport& report_;
  const Recorder* recorder_;
  mutable std::optional<results::StrainReport> strain_;  ///< made when first asked
  mutable std::optional<results::Measures> measures_;
};

}  // namespace garment::session
