// Going on along the last step: what it saves where every step is far too short, and that it stops where the force turns.
#include <catch2/catch.hpp>

#include <Eigen/Core>
#include <vector>

#include "runtime/simulator/momentum.hpp"

namespace {

using garment::simulator::Momentum;
using Eigen::Vector3d;
using Vectors = std::vector<Vector3d>;

constexpr double kSoft = 1, kStiff = 50;  // N/m; the step takes both for stiff

Vectors force_at(const Vectors& x) {
  Vectors force;
  for (const Vector3d& p : x) force.push_back({-kSoft * p.x(), -kStiff * p.y(), 0});
  return force;
}

double energy_at(const Vectors& x) {
  double sum = 0;
  for (const Vector3d& p : x) sum += 0.5 * (kSoft * p.x() * p.x() + kStiff * p.y() * p.y());
  return sum;
}

/// Steps of the too stiff matrix until the soft way is done to a thousandth.
int steps_to_rest(bool with_momentum) {
  Vectors x{{1, 0.3, 0}};
  Momentum momentum;
  for (int step = 1; step < 1000; ++step) {
    const Vectors before = x;
    if (with_momentum)
      if (const double share = momentum.share(); share > 0) x[0] += share * momentum.way()[0];
    const Vectors force = force_at(x);
    x[0] += force[0] / kStiff;
    if (with_momentum && momentum.rose(energy_at(x)) && step > 1) {
      x = before;
      momentum.forget();
      continue;
    }
    momentum.went(before, x, force, energy_at(x));
    if (x[0].norm() < 1e-3) return step;
  }
  return 1000;
}

}  // namespace

TEST_CASE("momentum: steps that are fifty times too short become a root as many") {
  const int plain = steps_to_rest(false), with_momentum = steps_to_rest(true);
  INFO(plain << " steps without, " << with_momentum << " with momentum");
  CHECK(plain > 300);
  CHECK(with_momentum < plain / 5);
}

TEST_CASE("momentum: nothing is known before the first step, and again where it is forgotten") {
  Momentum momentum;
  CHECK(momentum.share() == 0);
  const Vectors a{{0, 0, 0}}, b{{1, 0, 0}}, force{{1, 0, 0}};
  momentum.went(a, b, force, 1);
  CHECK(momentum.share() == 0);  // one step is no pace yet
  momentum.went(a, b, force, 0.9);
  CHECK(momentum.share() > 0);
  CHECK(momentum.rose(0.91));
  CHECK_FALSE(momentum.rose(0.89));
  momentum.forget();
  CHECK(momentum.share() == 0);
}

TEST_CASE("momentum: it begins anew where the force has turned against the way") {
  Momentum momentum;
  const Vectors a{{0, 0, 0}}, b{{1, 0, 0}}, with{{1, 0, 0}}, against{{-1, 0, 0}};
  for (int k = 0; k < 5; ++k) {
    momentum.went(a, b, with, 1);
    momentum.share();
  }
  CHECK(momentum.share() > 0.5);
  momentum.went(a, b, against, 1);
  CHECK(momentum.share() == 0);
}
