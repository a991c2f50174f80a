#pragma once
// What the parts of the solvers keep in a checkpoint: all that lasts from one step to the next. Where a part gains such a thing, its
// `keep` gains a line; tests/unit/simulator/checkpoint_test.cpp sees a difference in the bits where it does not.
#include <vector>

#include "runtime/base/archive.hpp"
#include "runtime/model/model.hpp"
#include "runtime/simulator/drape.hpp"
#include "runtime/simulator/untangle.hpp"

namespace garment::simulator {

inline constexpr int kMostCounted = 1 << 30;  ///< steps that a checkpoint may have counted

/// Reports hold no NaN: what is no number is too large for one.
double number_or_infinite(double value);

/// Positions of `n` particles, within 1,000 km; refuses what no cloth is: more particles in places of the size `reach` (m) than the
/// lists of pairs could bear.
void keep_positions(Archive& a, std::vector<model::Vector3d>& x, std::size_t n, double reach);

void keep(Archive& a, Tangle& tangle, const ContactMesh& mesh);

/// All of a report but its findings.
void keep(Archive& a, DrapeReport& report, std::size_t n_holders);

}  // namespace garment::simulator
