#pragma once
// Every place where the model states a strain, with its panel and the area it stands for.
#include <vector>

#include "runtime/model/model.hpp"

namespace garment::results {

enum class Direction : std::uint8_t { warp, weft };

/// One spring, or one direction of one cut cell.
struct StrainSample {
  model::Index panel = -1;
  Direction direction = Direction::warp;
  double strain = 0;
  double area = 0;  ///< m^2
  int n = 0;        ///< vertices it touches, 2 or 3
  model::Indices<3> vertex{-1, -1, -1};
};

struct ShearSample {
  model::Index panel = -1;
  double angle = 0;  ///< rad, >= 0
};

/// Vertices of each particle, as CSR.
class VertexTable {
 public:
  explicit VertexTable(const model::Model& model);

  /// Vertices of the two particles in `panel`, chosen so that their flat distance comes nearest to `length`
  /// (a dart gives one particle two places in the same panel). -1 where a particle has none.
  std::array<model::Index, 2> pair(model::Index panel, const model::Indices<2>& particles,
                                   double length) const;

  /// First vertex of the particle in `panel`; -1 where it has none.
  model::Index find(model::Index panel, model::Index particle) const;

  const model::Index* begin(model::Index particle) const { return vertex_.data() + begin_[particle]; }
  const model::Index* end(model::Index particle) const { return vertex_.data() + begin_[particle + 1]; }

 private:
  const model::Model& model_;
  std::vector<std::size_t> begin_;
  std::vector<model::Index> vertex_;
};

std::vector<StrainSample> strain_samples(const model::Model& model, const model::State& state,
                                         const VertexTable& table);
std::vector<ShearSample> shear_samples(const model::Model& model, const model::State& state,
                                       const VertexTable& table);

}  // namespace garment::results
