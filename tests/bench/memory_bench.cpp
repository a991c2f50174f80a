// What the machine's memory gives: sums read from arrays of so many MiB, by threads; the bound that the phases of a drape are
// held against (docs/performance.md).
#include <benchmark/benchmark.h>

#include <vector>

#include "runtime/base/parallel.hpp"

namespace {

/// Reads an array from end to end, eight sums side by side so that the adding is not what takes the time.
void read(benchmark::State& state) {
  garment::set_thread_count(static_cast<int>(state.range(1)));
  const std::vector<float> data(static_cast<std::size_t>(state.range(0)) << 18U, 1.0F);
  for (auto _ : state)
    benchmark::DoNotOptimize(garment::parallel_sum(data.size(), 1U << 16U, 0.0, [&](std::size_t begin, std::size_t end) {
      float sum[8] = {};
      for (std::size_t i = begin; i + 8 <= end; i += 8)
        for (std::size_t k = 0; k < 8; ++k) sum[k] += data[i + k];
      double all = 0;
      for (float s : sum) all += static_cast<double>(s);
      return all;
    }));
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations()) * static_cast<std::int64_t>(data.size() * sizeof(float)));
}

BENCHMARK(read)->ArgsProduct({{1, 8, 256}, {1, 2}})->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
