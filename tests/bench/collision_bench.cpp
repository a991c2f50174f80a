// Contact of a folded skirt: a cone of 7,000 particles at 1 cm in deep pleats around a body.
#include <benchmark/benchmark.h>

#include "runtime/base/parallel.hpp"
#include "runtime/base/portable_math.hpp"
#include "runtime/simulator/contact.hpp"
#include "runtime/simulator/truncate.hpp"
#include "runtime/simulator/untangle.hpp"
#include "tests/unit/simulator/collision_support.hpp"

using namespace garment;
using namespace garment::simulator;

namespace {

constexpr double kRadius = 0.012;

struct Skirt {
  model::Model model = test::sheet(118, 60, 0.01, 1e-3);
  std::vector<body::Body> bodies{test::ball(0.12, {0, -0.1, 0}, 40, 80)};
  std::vector<Vector3d> x, wish;
  Candidates candidates;
  std::unique_ptr<ContactMesh> mesh;

  Skirt() {
    test::Random random(1);
    for (const Vector3d& p : model.start) {
      // Around the body, in pleats that fold over each other: 1.18 m of cloth on a circle of 0.8 m.
      const double s = p[0] / 1.18 * 2 * portable::kPi * 0.97, down = -p[2];
      const double wave = 14 * s;
      const double angle = s + 0.05 * portable::sin(2 * wave), radius = 0.1225 + 0.002 * portable::cos(wave);
      x.emplace_back(radius * portable::sin(angle), -down, radius * portable::cos(angle));
      wish.push_back(random.vector(1e-6));
    }
    mesh = std::make_unique<ContactMesh>(model, bodies);
    candidates.rebuild(*mesh, x, kRadius);
  }
};

Skirt& skirt() {
  set_thread_count(1);
  static Skirt s;
  return s;
}

void rebuild(benchmark::State& state) {
  Skirt& s = skirt();
  Candidates candidates;
  for (auto _ : state) candidates.rebuild(*s.mesh, s.x, 0.001 * static_cast<double>(state.range(0)));
  state.counters["pairs"] = static_cast<double>(candidates.pairs().size());
}
BENCHMARK(rebuild)->Arg(12)->Arg(6)->Arg(3)->Unit(benchmark::kMillisecond);

void contacts(benchmark::State& state) {
  Skirt& s = skirt();
  std::vector<Contact> out;
  for (auto _ : state) active_contacts(*s.mesh, s.candidates, s.x, out);
  state.counters["contacts"] = static_cast<double>(out.size());
}
BENCHMARK(contacts)->Unit(benchmark::kMillisecond);

void walls(benchmark::State& state) {
  Skirt& s = skirt();
  TruncateStats stats;
  for (auto _ : state) {
    std::vector<Vector3d> dx = s.wish;
    for (Vector3d& d : dx) d *= static_cast<double>(state.range(0));  // steps of so many um
    stats = truncate(*s.mesh, s.candidates, s.x, dx);
  }
  state.counters["limited"] = static_cast<double>(stats.limited);
}
BENCHMARK(walls)->Arg(200)->Arg(2000)->Unit(benchmark::kMillisecond);

void tangle(benchmark::State& state) {
  Skirt& s = skirt();
  Tangle t;
  for (auto _ : state) t = find_tangle(*s.mesh, s.bodies, s.x);
  state.counters["hits"] = static_cast<double>(t.hits.size());
}
BENCHMARK(tangle)->Unit(benchmark::kMillisecond);

void build_mesh(benchmark::State& state) {
  Skirt& s = skirt();
  for (auto _ : state) benchmark::DoNotOptimize(ContactMesh(s.model, s.bodies).edge.size());
}
BENCHMARK(build_mesh)->Unit(benchmark::kMillisecond);

}  // namespace
