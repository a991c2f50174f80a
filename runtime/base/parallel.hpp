#pragma once
// Parallel loops with results that do not depend on the number of threads: work is cut into fixed chunks, and partial
// sums are added in the order of the chunks.
#include <cstddef>
#include <functional>
#include <vector>

namespace garment {

/// Threads that parallel loops may use from now on (>= 1). The bits of every result stay the same.
void set_thread_count(int threads);
int thread_count();

namespace detail {
void run_chunks(std::size_t n_chunks, const std::function<void(std::size_t)>& run);
}

/// Calls `body(begin, end)` for consecutive ranges of at most `grain` indices that together cover [0, n). Ranges may run
/// at the same time: `body` writes only what belongs to its range. Never use for work under about 50 us.
template <class Body>
void parallel_for(std::size_t n, std::size_t grain, const Body& body) {
  std::size_t n_chunks = (n + grain - 1) / grain;
  auto chunk = [&](std::size_t c) { body(c * grain, (c + 1) * grain < n ? (c + 1) * grain : n); };
  if (n_chunks <= 1) {
    if (n > 0) chunk(0);
    return;
  }
  detail::run_chunks(n_chunks, chunk);
}

/// Sum of `body(begin, end)` over the chunks of [0, n), added in the order of the chunks.
template <class T, class Body>
T parallel_sum(std::size_t n, std::size_t grain, T zero, const Body& body) {
  std::size_t n_chunks = (n + grain - 1) / grain;
  std::vector<T> partial(n_chunks, zero);
  parallel_for(n, grain, [&](std::size_t begin, std::size_t end) { partial[begin / grain] = body(begin, end); });
  T sum = zero;
  for (const T& p : partial) sum += p;
  return sum;
}

/// Runs `find(i, list)` for i in [0, n) and appends to `out` what all of them put into their list, in the order of i.
template <class T, class Find>
void parallel_collect(std::size_t n, std::size_t grain, std::vector<T>& out, const Find& find) {
  std::vector<std::vector<T>> found((n + grain - 1) / grain);
  parallel_for(n, grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) find(i, found[begin / grain]);
  });
  std::size_t total = out.size();
  for (const auto& f : found) total += f.size();
  out.reserve(total);
  for (const auto& f : found) out.insert(out.end(), f.begin(), f.end());
}

}  // namespace garment
