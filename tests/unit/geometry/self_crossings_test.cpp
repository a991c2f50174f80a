#include "runtime/geometry/self_crossings.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <utility>

using garment::geometry::self_crossings;
using garment::geometry::SelfCrossings;
using garment::geometry::TrianglePair;
using Eigen::Vector3d;

namespace {

constexpr std::size_t kAll = 1000;

/// Three strips of two triangles each: the first two lie in z = 0, side by side, the third stands across both.
const std::vector<Vector3d> kPoints{{0, 0, 0},      {1, 0, 0},      {2, 0, 0},     {0, 1, 0},    {1, 1, 0},
                                    {2, 1, 0},      {0.2, 0.4, -1}, {1.8, 0.4, -1}, {0.2, 0.4, 1}, {1.8, 0.4, 1}};
const std::vector<std::array<std::int32_t, 3>> kFlat{{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}};

}  // namespace

TEST_CASE("neighbours in a plane do not meet, what stands across them does", "[crossings]") {
  CHECK(self_crossings(kFlat, kPoints, kAll).count == 0);
  auto triangles = kFlat;
  triangles.push_back({6, 7, 9});
  triangles.push_back({6, 9, 8});
  const SelfCrossings found = self_crossings(triangles, kPoints, kAll);
  CHECK(found.count == found.pairs.size());
  for (const TrianglePair& pair : found.pairs) CHECK((pair.first < 4 && pair.second >= 4));
  for (std::int32_t flat : {0, 1, 2, 3}) {
    bool met = false;
    for (const TrianglePair& pair : found.pairs) met = met || pair.first == flat;
    CHECK(met);
  }
  CHECK(std::is_sorted(found.pairs.begin(), found.pairs.end(), [](const TrianglePair& a, const TrianglePair& b) {
    return std::pair(a.first, a.second) < std::pair(b.first, b.second);
  }));
}

TEST_CASE("no more pairs are listed than asked for, but all are counted", "[crossings]") {
  auto triangles = kFlat;
  triangles.push_back({6, 7, 9});
  triangles.push_back({6, 9, 8});
  const SelfCrossings all = self_crossings(triangles, kPoints, kAll), two = self_crossings(triangles, kPoints, 2);
  CHECK(two.count == all.count);
  REQUIRE(two.pairs.size() == 2);
  CHECK(two.pairs[0] == all.pairs[0]);
  CHECK(two.pairs[1] == all.pairs[1]);
}

TEST_CASE("triangles that share a point meet where their opposite edges cross the other one", "[crossings]") {
  const std::vector<Vector3d> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.4, 0.2, 0.5}, {0.4, 0.2, -0.5}, {-1, 0, 0.5}, {-1, 0, -0.5}};
  CHECK(self_crossings({{0, 1, 2}, {0, 3, 4}}, points, kAll).count == 1);
  CHECK(self_crossings({{0, 1, 2}, {0, 5, 6}}, points, kAll).count == 0);
}
