#include "runtime/simulator/aggregates.hpp"

#include <algorithm>
#include <functional>
#include <queue>
#include <utility>

#include "runtime/base/parallel.hpp"

namespace garment::simulator {
namespace {

using model::Index;

constexpr int kLloydRounds = 5;
constexpr int kUnreached = 1 << 30;

/// Number of equal entries of two ascending rows.
int common_neighbours(const BlockPattern& p, Index a, Index b) {
  Index i = p.row_begin[a], j = p.row_begin[b];
  int count = 0;
  while (i < p.row_begin[a + 1] && j < p.row_begin[b + 1]) {
    count += p.column[i] == p.column[j];
    const Index left = p.column[i], right = p.column[j];
    i += left <= right;
    j += right <= left;
  }
  return count;
}

/// Length of each link of the pattern. On a grid of cells with bending over two of them, particles at
/// distance 1, sqrt(2) and 2 share 6, 4 and 3 neighbours: the inverse of that number measures distance
/// without geometry.
std::vector<int> link_lengths(const BlockPattern& pattern) {
  std::vector<int> length(pattern.n_blocks());
  parallel_for(pattern.n_rows(), 512, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      for (Index k = pattern.row_begin[i]; k < pattern.row_begin[i + 1]; ++k)
        length[k] = 60 / (1 + common_neighbours(pattern, static_cast<Index>(i), pattern.column[k]));
  });
  return length;
}

/// First groups: breadth-first balls in the order of the particles; leftovers join a neighbour.
int grow_balls(const BlockPattern& pattern, const Holds& holds, int size, std::vector<Index>& of) {
  int n_groups = 0;
  std::vector<std::size_t> ball;
  for (std::size_t seed = 0; seed < of.size(); ++seed) {
    if (of[seed] >= 0 || holds.is_fixed(seed)) continue;
    ball.assign(1, seed);
    of[seed] = n_groups;
    Index neighbour = -1;
    for (std::size_t q = 0; q < ball.size(); ++q)
      for (Index k = pattern.row_begin[ball[q]]; k < pattern.row_begin[ball[q] + 1]; ++k) {
        const auto j = static_cast<std::size_t>(pattern.column[k]);
        if (of[j] >= 0 && of[j] != n_groups && neighbour < 0) neighbour = of[j];
        if (of[j] >= 0 || holds.is_fixed(j) || static_cast<int>(ball.size()) >= size) continue;
        of[j] = n_groups;
        ball.push_back(j);
      }
    if (static_cast<int>(ball.size()) < size / 4 && neighbour >= 0)
      for (std::size_t i : ball) of[i] = neighbour;
    else
      ++n_groups;
  }
  return n_groups;
}

/// The member of each group that is nearest to the group's mean position; groups under `least` members get
/// none.
std::vector<Index> centres(const std::vector<Index>& of, int n_groups, const std::vector<Eigen::Vector3d>& x,
                           int least) {
  std::vector<Eigen::Vector3d> mean(n_groups, Eigen::Vector3d::Zero());
  std::vector<int> count(n_groups, 0);
  for (std::size_t i = 0; i < of.size(); ++i)
    if (of[i] >= 0) {
      mean[of[i]] += x[i];
      ++count[of[i]];
    }
  for (int a = 0; a < n_groups; ++a) mean[a] /= std::max(1, count[a]);
  std::vector<Index> centre(n_groups, -1);
  std::vector<double> best(n_groups, 0);
  for (std::size_t i = 0; i < of.size(); ++i) {
    const Index a = of[i];
    if (a < 0 || count[a] < least) continue;
    const double d = (x[i] - mean[a]).squaredNorm();
    if (centre[a] >= 0 && !(d < best[a])) continue;
    centre[a] = static_cast<Index>(i);
    best[a] = d;
  }
  centre.erase(std::remove(centre.begin(), centre.end(), -1), centre.end());
  return centre;
}

/// Gives every particle that a centre reaches to the nearest one; ties go to the lower number.
void flood(const BlockPattern& pattern, const std::vector<int>& length, const Holds& holds,
           const std::vector<Index>& centre, std::vector<Index>& of) {
  using Entry = std::pair<int, Index>;  // (distance, particle)
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> front;
  std::vector<int> distance(of.size(), kUnreached);
  for (std::size_t a = 0; a < centre.size(); ++a) {
    of[centre[a]] = static_cast<Index>(a);
    distance[centre[a]] = 0;
    front.emplace(0, centre[a]);
  }
  while (!front.empty()) {
    const auto [d, i] = front.top();
    front.pop();
    if (d > distance[i]) continue;
    for (Index k = pattern.row_begin[i]; k < pattern.row_begin[i + 1]; ++k) {
      const Index j = pattern.column[k];
      if (holds.is_fixed(static_cast<std::size_t>(j)) || d + length[k] >= distance[j]) continue;
      distance[j] = d + length[k];
      of[j] = of[i];
      front.emplace(distance[j], j);
    }
  }
}

/// Makes one group of all particles without one that hang together with `seed`.
void fill_island(const BlockPattern& pattern, const Holds& holds, Index seed, int group,
                 std::vector<Index>& of) {
  std::vector<Index> queue{seed};
  of[seed] = group;
  for (std::size_t q = 0; q < queue.size(); ++q)
    for (Index k = pattern.row_begin[queue[q]]; k < pattern.row_begin[queue[q] + 1]; ++k) {
      const Index j = pattern.column[k];
      if (of[j] >= 0 || holds.is_fixed(static_cast<std::size_t>(j))) continue;
      of[j] = group;
      queue.push_back(j);
    }
}

}  // namespace

Aggregates listed(std::vector<Index> of, int n_groups) {
  Aggregates result;
  result.begin.assign(static_cast<std::size_t>(n_groups) + 1, 0);
  for (Index a : of)
    if (a >= 0) ++result.begin[a + 1];
  for (int a = 0; a < n_groups; ++a) result.begin[a + 1] += result.begin[a];
  result.member.resize(static_cast<std::size_t>(result.begin.back()));
  std::vector<Index> next(result.begin.begin(), result.begin.end() - 1);
  for (std::size_t i = 0; i < of.size(); ++i)
    if (of[i] >= 0) result.member[next[of[i]]++] = static_cast<Index>(i);
  result.of = std::move(of);
  return result;
}

Aggregates group_particles(const BlockPattern& pattern, const Holds& holds,
                           const std::vector<Eigen::Vector3d>* positions, int size) {
  std::vector<Index> of(pattern.n_rows(), -1);
  int n_groups = grow_balls(pattern, holds, size, of);
  if (!positions) return listed(std::move(of), n_groups);
  const std::vector<int> length = link_lengths(pattern);
  for (int round = 0; round < kLloydRounds; ++round) {
    // Small groups give their members away, except where nobody else could take them: an island keeps its
    // group.
    std::vector<Index> centre = centres(of, n_groups, *positions, round + 1 < kLloydRounds ? size / 3 : 1);
    std::fill(of.begin(), of.end(), -1);
    flood(pattern, length, holds, centre, of);
    n_groups = static_cast<int>(centre.size());
    for (std::size_t i = 0; i < of.size(); ++i) {
      if (of[i] >= 0 || holds.is_fixed(i)) continue;
      fill_island(pattern, holds, static_cast<Index>(i), n_groups++, of);
    }
  }
  return listed(std::move(of), n_groups);
}

}  // namespace garment::simulator
