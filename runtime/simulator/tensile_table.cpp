#include "runtime/simulator/tensile_table.hpp"

#include <cmath>

namespace garment::simulator {

TensileTable::TensileTable(const model::TensileLaw& law) {
  const std::size_t n = law.strain.size();
  first_ = law.strain.front();
  last_ = law.strain.back();
  pieces_.resize(n + 1);
  pieces_[0] = {first_, 0, law.force.front(), law.slope.front(), 0, 0};
  for (std::size_t k = 0; k < n; ++k) {
    Piece& p = pieces_[k + 1];
    p = {law.strain[k], 0, law.force[k], law.slope[k], 0, 0};
    if (k + 1 == n) break;
    const double w = law.strain[k + 1] - law.strain[k], rise = (law.force[k + 1] - law.force[k]) / w;
    p.b = (3 * rise - 2 * law.slope[k] - law.slope[k + 1]) / w;
    p.c = (law.slope[k] + law.slope[k + 1] - 2 * rise) / (w * w);
  }
  // Integrate from the first knot, then shift so that Psi is 0 at strain 0.
  for (std::size_t k = 1; k < n; ++k) {
    const Piece& p = pieces_[k];
    const double t = pieces_[k + 1].start - p.start;
    pieces_[k + 1].psi = p.psi + t * (p.force + t * (p.slope / 2 + t * (p.b / 3 + t * p.c / 4)));
  }
  buckets_per_strain_ = last_ > first_ ? kBuckets / (last_ - first_) : 0;
  std::size_t k = 1;
  for (std::size_t bucket = 0; bucket < kBuckets; ++bucket) {
    // A hair to the left, so that rounding in find() cannot land right of its piece.
    const double left = first_ + (static_cast<double>(bucket) - 1e-6) / kBuckets * (last_ - first_);
    while (k + 1 < n && pieces_[k + 1].start <= left) ++k;
    bucket_piece_[bucket] = static_cast<std::uint32_t>(k);
  }
  const double psi_at_zero = at(0).psi;
  for (Piece& p : pieces_) p.psi -= psi_at_zero;
}

}  // namespace garment::simulator
