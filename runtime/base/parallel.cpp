#include "runtime/base/parallel.hpp"

#include <atomic>

#ifdef GARMENT_STD_THREADS
#include <cstdlib>
#include <thread>
#else
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>

#include <memory>
#endif

namespace garment {
namespace {

constexpr int kUsualThreads = 2;

/// Builds for the thread sanitizer take the number for tests that do not set it from GARMENT_THREADS.
int first_thread_count() {
#ifdef GARMENT_STD_THREADS
  if (const char* given = std::getenv("GARMENT_THREADS"); given != nullptr && std::atoi(given) > 0) return std::atoi(given);
#endif
  return kUsualThreads;
}

std::atomic<int> threads_allowed{first_thread_count()};

}  // namespace

int thread_count() { return threads_allowed; }

#ifdef GARMENT_STD_THREADS

void set_thread_count(int threads) { threads_allowed = threads < 1 ? 1 : threads; }

void detail::run_chunks(std::size_t n_chunks, const std::function<void(std::size_t)>& run) {
  std::atomic<std::size_t> next{0};
  auto work = [&] {
    for (std::size_t c = next++; c < n_chunks; c = next++) run(c);
  };
  std::vector<std::thread> pool;
  for (int t = 1; t < thread_count(); ++t) pool.emplace_back(work);
  work();
  for (std::thread& t : pool) t.join();
}

#else

void set_thread_count(int threads) {
  threads_allowed = threads < 1 ? 1 : threads;
  static std::unique_ptr<oneapi::tbb::global_control> control;
  control = std::make_unique<oneapi::tbb::global_control>(oneapi::tbb::global_control::max_allowed_parallelism,
                                                          static_cast<std::size_t>(thread_count()));
}

void detail::run_chunks(std::size_t n_chunks, const std::function<void(std::size_t)>& run) {
  if (thread_count() == 1) {
    for (std::size_t c = 0; c < n_chunks; ++c) run(c);
    return;
  }
  oneapi::tbb::parallel_for(std::size_t{0}, n_chunks, run);
}

#endif

}  // namespace garment
