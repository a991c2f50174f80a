// Time of one linear solve of the drape on a sheet that hangs from two corners, and the iterations it takes;
// arguments: particles a side, stretch stiffness N/m, time step ms, threads. The sheet is 0.5 m wide at every
// resolution.
#include <benchmark/benchmark.h>

#include <array>
#include <cstdint>
#include <map>

#include "runtime/base/parallel.hpp"
#include "tests/support/linear_case.hpp"

namespace {

using garment::simulator::LinearResult;
using garment::simulator::LinearSolver;
using garment::simulator::Preconditioner;
using garment::test::LinearCase;

/// The sheet after 25 steps, made once for each stiffness and size.
const LinearCase& hanging_sheet(const benchmark::State& state) {
  static std::map<std::array<std::int64_t, 3>, LinearCase> made;
  garment::set_thread_count(static_cast<int>(state.range(3)));
  const std::array key{state.range(0), state.range(1), state.range(2)};
  if (const auto at = made.find(key); at != made.end()) return at->second;
  garment::test::SheetSpec spec;
  spec.nx = spec.ny = static_cast<int>(state.range(0));
  spec.h = 0.5 / spec.nx;
  spec.stretch = static_cast<double>(state.range(1));
  garment::model::Model m = garment::test::make_sheet(spec);
  garment::test::hold_upper_corners(m, spec);
  const double time_step = 1e-3 * static_cast<double>(state.range(2));
  LinearCase& c = made.try_emplace(key, std::move(m), time_step, 0.05).first->second;
  c.relax(25, time_step);
  return c;
}

/// Tolerance 1e-2: factorisation of the coarse matrix and conjugate gradients.
void solve(benchmark::State& state, bool with_positions) {
  const LinearCase& c = hanging_sheet(state);
  LinearSolver solver(c.matrix.pattern(), c.holds);
  std::vector<Eigen::Vector3d> x;
  LinearResult result;
  for (auto _ : state)
    result = solver.solve(c.matrix, {}, c.force, 1e-2, 500, x, with_positions ? &c.x : nullptr);
  state.counters["iterations"] = result.iterations;
}
void solve_rigid(benchmark::State& state) { solve(state, true); }
void solve_translations(benchmark::State& state) { solve(state, false); }

void factor(benchmark::State& state) {
  const LinearCase& c = hanging_sheet(state);
  Preconditioner preconditioner(c.matrix.pattern(), c.holds);
  preconditioner.factor(c.matrix, &c.x);
  for (auto _ : state) preconditioner.factor(c.matrix, &c.x);
  state.counters["groups"] = static_cast<double>(preconditioner.aggregates().size());
}

void apply(benchmark::State& state) {
  const LinearCase& c = hanging_sheet(state);
  Preconditioner preconditioner(c.matrix.pattern(), c.holds);
  preconditioner.factor(c.matrix, &c.x);
  std::vector<Eigen::Vector3f> r, z;
  for (const Eigen::Vector3d& f : c.force) r.push_back(f.cast<float>());
  for (auto _ : state) benchmark::DoNotOptimize(preconditioner.apply(r, z));
}

/// Grouping of the particles and order of elimination, once for a garment.
void set_up(benchmark::State& state) {
  const LinearCase& c = hanging_sheet(state);
  for (auto _ : state) {
    Preconditioner preconditioner(c.matrix.pattern(), c.holds);
    preconditioner.factor(c.matrix, &c.x);
  }
}

void sizes(benchmark::internal::Benchmark* b) {
  for (const int n : {50, 100, 200}) b->Args({n, 1000, 2000, 2});
  b->Args({100, 1000, 17, 2})
      ->Args({100, 1000, 2000, 1})
      ->Args({100, 4000, 2000, 2})
      ->Args({100, 20000, 2000, 2});
  b->ArgNames({"side", "stretch", "step_ms", "threads"})->Unit(benchmark::kMillisecond)->UseRealTime();
}
BENCHMARK(solve_rigid)->Apply(sizes);
BENCHMARK(solve_translations)->Apply(sizes);
BENCHMARK(factor)
    ->Args({100, 1000, 2000, 2})
    ->Args({200, 1000, 2000, 2})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(apply)
    ->Args({100, 1000, 2000, 2})
    ->Args({200, 1000, 2000, 2})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(set_up)
    ->Args({100, 1000, 2000, 2})
    ->Args({200, 1000, 2000, 2})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
