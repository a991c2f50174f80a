#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

namespace garment::modeller {

/// Two sides of a closed polygon that meet without being neighbours, and where.
struct Crossing {
  std::size_t first = 0, second = 0;  ///< side k runs from point k to point k + 1
  Eigen::Vector2d point;
};

/// The first place (in the order of the sides) where the closed polygon crosses or touches itself. Signs are
/// exact.
std::optional<Crossing> find_crossing(const std::vector<Eigen::Vector2d>& loop);

}  // namespace garment::modeller
