// Rings that are sewn to rings, as they are placed.
#include <catch2/catch.hpp>
#include <cmath>

#include "runtime/modeller/ring_turn.hpp"

using namespace garment;
using Eigen::Vector3d;

namespace {

constexpr int kSteps = 64;
constexpr double kRound = 6.283185307179586;

/// An upright oval of these radii round `middle`, from its lowest place on.
modeller::RingPlaces oval(double wide, double high, const Vector3d& middle, double begin = 0) {
  modeller::RingPlaces points;
  for (int k = 0; k < kSteps; ++k) {
    const double angle = kRound * (static_cast<double>(k) / kSteps + begin);
    points.emplace_back(middle + Vector3d(0.02 * std::cos(2 * angle), -high * std::cos(angle), wide * std::sin(angle)));
  }
  return points;
}

}  // namespace

TEST_CASE("rings that lie to each other as they are sewn fit best as they are") {
  const auto armhole = oval(0.07, 0.1, {0.2, 1.3, 0}), cap = oval(0.06, 0.08, {0.35, 1.25, 0.01});
  const modeller::RingTurn turn = modeller::ring_turn(cap, armhole);
  CHECK(turn.sewn > 0.98);
  CHECK(turn.turned == 0);
}

TEST_CASE("a ring that begins elsewhere is told by how far it is turned") {
  const auto armhole = oval(0.07, 0.1, {0.2, 1.3, 0});
  for (double begin : {0.5, 0.375, 0.25}) {
    const modeller::RingTurn turn = modeller::ring_turn(oval(0.06, 0.08, {0.35, 1.25, 0.01}, begin), armhole);
    CHECK(turn.sewn == Approx(std::cos(kRound * begin)).margin(0.1));
    CHECK(turn.best > 0.98);
    CHECK(turn.turned == Approx(begin));
  }
}

TEST_CASE("rings without size are in no order") {
  const modeller::RingPlaces one(kSteps, Vector3d(1, 2, 3));
  const modeller::RingTurn turn = modeller::ring_turn(one, oval(0.07, 0.1, {0, 0, 0}));
  CHECK(turn.sewn == 1);
  CHECK(turn.turned == 0);
}

TEST_CASE("a ring of which a third has no place is told all the same, one with less than half of its places is not") {
  const auto armhole = oval(0.07, 0.1, {0.2, 1.3, 0});
  auto cap = oval(0.06, 0.08, {0.35, 1.25, 0.01}, 0.5);
  for (int k = 20; k < 40; ++k) cap[static_cast<std::size_t>(k)].reset();
  const modeller::RingTurn turn = modeller::ring_turn(cap, armhole);
  CHECK(turn.sewn < -0.7);
  CHECK(turn.best > 0.8);
  CHECK(turn.turned == Approx(0.5).margin(0.05));
  for (int k = 0; k < 16; ++k) cap[static_cast<std::size_t>(k)].reset();
  CHECK(modeller::ring_turn(cap, armhole).sewn == 1);
}
