#pragma once
// A tensile law made ready for the hot loop: polynomial pieces for tension, its slope and its integral.
#include <array>
#include <cstdint>
#include <vector>

#include "runtime/model/model.hpp"

namespace garment::simulator {

/// Tension N (N/m), its slope dN/dstrain (N/m) and its integral Psi from strain 0 (J/m^2) at one strain.
struct Tension {
  double psi = 0, force = 0, slope = 0;
};

/// The cubic pieces of a TensileLaw, with its linear ends. Accepts any law of one knot or more.
class TensileTable {
 public:
  explicit TensileTable(const model::TensileLaw& law);

  Tension at(double strain) const {
    const Piece& p = pieces_[find(strain)];
    const double t = strain - p.start;
    return {p.psi + t * (p.force + t * (p.slope / 2 + t * (p.b / 3 + t * p.c / 4))),
            p.force + t * (p.slope + t * (p.b + t * p.c)), p.slope + t * (2 * p.b + t * 3 * p.c)};
  }

 private:
  struct Piece {
    double start = 0;                      // strain at which t = 0
    double psi = 0, force = 0, slope = 0;  // there
    double b = 0, c = 0;                   // N = force + slope t + b t^2 + c t^3
  };
  static constexpr std::size_t kBuckets = 64;

  // Piece 0 lies below the first knot, piece k from knot k - 1 on. Equal buckets between the first and the
  // last knot lead to the piece that holds a bucket's left end; from there it is a step or two to the right
  // one.
  std::size_t find(double strain) const {
    if (!(strain >= first_)) return 0;
    if (strain >= last_) return pieces_.size() - 1;
    const auto bucket = static_cast<std::size_t>((strain - first_) * buckets_per_strain_);
    std::size_t k = bucket_piece_[bucket < kBuckets ? bucket : kBuckets - 1];
    while (strain >= pieces_[k + 1].start) ++k;
    return k;
  }

  std::vector<Piece> pieces_;
  double first_ = 0, last_ = 0, buckets_per_strain_ = 0;
  std::array<std::uint32_t, kBuckets> bucket_piece_{};
};

}  // namespace garment::simulator
