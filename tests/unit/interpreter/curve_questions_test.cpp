#include "interpreter/language/curve_questions.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace garment::interpreter;

namespace {

/// y = 2 x + 1 on the way out to 4, y = 2 x - 1 on the way back to -4, out again.
CurvePoints loop() {
  CurvePoints c;
  for (int k = 0; k <= 8; ++k) c.push_back({0.5 * k, k + 1.0});
  for (int k = 7; k >= -8; --k) c.push_back({0.5 * k, k - 1.0});
  for (int k = -7; k <= 0; ++k) c.push_back({0.5 * k, k + 1.0});
  return c;
}

}  // namespace

TEST_CASE("a curve is asked where it goes through a range for the first time") {
  const CurvePoints c = loop();
  CHECK(*slope_of(c, 0.7, 3.1) == Approx(2));
  CHECK(*slope_of(c, 3.1, 0.7) == Approx(2));
  CHECK(*work_of(c, 1, 3) == Approx(10));    // 2 (2 x 2 + 1)
  CHECK(*work_of(c, 3, 1) == Approx(-6));    // back: 2 (2 x 2 - 1), the other way
  CHECK(*work_of(c, -4, -2) == Approx(-10.5));  // out again: begun on the lower line at -4
  CHECK(*reading_of(c, 1.25) == Approx(3.5));
  CHECK(*loop_width_of(c, 1.25) == Approx(2));
  CHECK(*loop_width_of(c, -3) == Approx(2));
}

TEST_CASE("a curve that does not go so far has no answer") {
  const CurvePoints c = loop();
  CHECK_FALSE(slope_of(c, 0, 5));
  CHECK_FALSE(work_of(c, -5, 0));
  CHECK_FALSE(reading_of(c, 4.1));
  CHECK_FALSE(loop_width_of({{0, 0}, {1, 1}}, 0.5));
  CHECK_FALSE(slope_of({}, 0, 1));
}

TEST_CASE("a loop begun at its end is a point of both ways") {
  CHECK(*reading_of({{0, 3}, {0, 3.5}, {1, 4}}, 0) == 3);
  CHECK(*slope_of({{0, 1}, {1, 2}, {2, 3}}, 0, 2) == Approx(1));
  CHECK(*slope_of({{0, 1}, {0, 0}, {2, 2}}, 0, 2) == Approx(1));  // the last point before it leaves counts
}
