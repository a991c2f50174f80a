// Time of the elastic kernels and of the matrix product on a crumpled square sheet; arguments: particles a
// side, threads. Targets for 10,000 particles on one thread: force 2.5 ms, Hessian 9 ms.
#include <benchmark/benchmark.h>

#include "runtime/base/parallel.hpp"
#include "runtime/simulator/elastic.hpp"
#include "tests/support/grid_model.hpp"

namespace {

using garment::simulator::BlockMatrix;
using garment::simulator::ElasticModel;

struct Sheet {
  explicit Sheet(const benchmark::State& state) {
    garment::test::SheetSpec spec;
    spec.nx = spec.ny = static_cast<int>(state.range(0));
    spec.h = 0.005;
    model = garment::test::make_sheet(spec);
    std::uint64_t seed = 1;
    auto noise = [&seed] {
      seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
      return static_cast<double>(seed >> 11) / 9007199254740992.0 - 0.5;
    };
    for (const Eigen::Vector3d& p : model.start)
      x.push_back(1.01 * p + 0.2 * spec.h * Eigen::Vector3d(noise(), noise(), 4 * noise()));
    garment::set_thread_count(static_cast<int>(state.range(1)));
  }
  garment::model::Model model;
  std::vector<Eigen::Vector3d> x, force;
};

void energy(benchmark::State& state) {
  Sheet sheet(state);
  const ElasticModel elastic(sheet.model);
  for (auto _ : state) benchmark::DoNotOptimize(elastic.energy(sheet.x));
}

void force(benchmark::State& state) {
  Sheet sheet(state);
  const ElasticModel elastic(sheet.model);
  for (auto _ : state) benchmark::DoNotOptimize(elastic.energy_and_force(sheet.x, sheet.force));
}

void hessian(benchmark::State& state) {
  Sheet sheet(state);
  const ElasticModel elastic(sheet.model);
  BlockMatrix matrix = elastic.make_matrix();
  for (auto _ : state) benchmark::DoNotOptimize(elastic.energy_force_hessian(sheet.x, sheet.force, matrix));
}

void product(benchmark::State& state) {
  Sheet sheet(state);
  const ElasticModel elastic(sheet.model);
  BlockMatrix matrix = elastic.make_matrix();
  elastic.energy_force_hessian(sheet.x, sheet.force, matrix);
  std::vector<Eigen::Vector3f> x(sheet.x.size()), y;
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = sheet.x[i].cast<float>();
  for (auto _ : state) benchmark::DoNotOptimize(matrix.multiply_and_dot(x, y));
  // Blocks and their columns, added diagonal blocks, x once, y once.
  const std::size_t bytes = 40 * matrix.pattern().n_blocks() + (36 + 4 + 24) * matrix.n_rows();
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations()) * static_cast<std::int64_t>(bytes));
}

void set_up(benchmark::State& state) {
  const Sheet sheet(state);
  for (auto _ : state) benchmark::DoNotOptimize(ElasticModel(sheet.model));
}

void sizes(benchmark::internal::Benchmark* b) {
  b->Args({100, 1})
      ->Args({100, 2})
      ->Args({200, 1})
      ->Args({200, 2})
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime();
}
BENCHMARK(energy)->Apply(sizes);
BENCHMARK(force)->Apply(sizes);
BENCHMARK(hessian)->Apply(sizes);
BENCHMARK(product)->Apply(sizes);
BENCHMARK(set_up)->Args({100, 1})->Unit(benchmark::kMillisecond);

}  // namespace
