#pragma once
// Which triangle of a panel holds a point of its flat pattern.
#include <array>
#include <vector>

#include "runtime/model/model.hpp"

namespace garment::model {

/// Triangles of one panel in square bins over its flat pattern. Keeps a reference to the model.
class FlatIndex {
 public:
  FlatIndex(const Model& model, Index panel);

  /// Triangle that holds `p` (panel coordinates, m), or the one it is least outside of; -1 for a panel
  /// without triangles. `weights` are p's barycentric coordinates there: negative ones carry on beyond the
  /// border.
  Index locate(const Vector2d& p, std::array<double, 3>& weights) const;

 private:
  int column(double x) const;
  int row(double y) const;
  std::array<double, 3> barycentric(Index t, const Vector2d& p) const;

  const Model& model_;
  Index first_ = 0, end_ = 0;
  Vector2d low_{1e300, 1e300}, high_{-1e300, -1e300};
  double bin_ = 1;
  int nx_ = 1, ny_ = 1;
  std::vector<std::vector<Index>> bins_;
};

}  // namespace garment::model
