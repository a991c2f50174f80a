#include "runtime/base/portable_math.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>

namespace portable = garment::portable;

namespace {

constexpr double kTolerance = 1e-15;

double relative_error(double value, long double truth) {
  if (truth == 0) return value == 0 ? 0 : 1;
  return static_cast<double>(std::fabs((static_cast<long double>(value) - truth) / truth));
}

/// Largest relative error of `ours` against the long double `theirs` over `n` values of [low, high].
template <class Ours, class Theirs>
double worst_error(double low, double high, const Ours& ours, const Theirs& theirs, int n = 20000) {
  std::mt19937_64 random(7);
  double worst = 0;
  for (int i = 0; i < n; ++i) {
    double x = low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53);
    worst = std::max(worst, relative_error(ours(x), theirs(static_cast<long double>(x))));
  }
  return worst;
}

}  // namespace

TEST_CASE("portable trigonometric functions agree with long double") {
  auto sin_l = [](long double x) { return std::sin(x); };
  auto cos_l = [](long double x) { return std::cos(x); };
  auto tan_l = [](long double x) { return std::tan(x); };
  for (double range : {1e-3, 0.8, 3.2, 100.0, 1e5}) {
    INFO("range " << range);
    CHECK(worst_error(-range, range, portable::sin, sin_l) < kTolerance);
    CHECK(worst_error(-range, range, portable::cos, cos_l) < kTolerance);
    CHECK(worst_error(-range, range, portable::tan, tan_l) < kTolerance);
  }
  // Where the plain double argument comes close to a multiple of pi, the result is the small remainder.
  CHECK(relative_error(portable::sin(portable::kPi), std::sin(static_cast<long double>(portable::kPi))) <
        kTolerance);
  CHECK(relative_error(portable::cos(355.0 / 2), std::cos(355.0L / 2)) < kTolerance);
  CHECK(std::fabs(portable::sin(1e9) - static_cast<double>(std::sin(1e9L))) < 1e-6);
  CHECK(portable::cos(0.0) == 1.0);
  CHECK(portable::sin(0.0) == 0.0);
  CHECK(std::isnan(portable::sin(std::numeric_limits<double>::infinity())));
}

TEST_CASE("portable inverse functions agree with long double") {
  for (double range : {1e-4, 1.0, 5.0, 1e6})
    CHECK(worst_error(-range, range, portable::atan, [](long double x) { return std::atan(x); }) <
          kTolerance);
  CHECK(worst_error(-1, 1, portable::acos, [](long double x) { return std::acos(x); }) < kTolerance);
  CHECK(worst_error(-1, 1, portable::asin, [](long double x) { return std::asin(x); }) < kTolerance);
  CHECK(worst_error(0.999999, 1, portable::acos, [](long double x) { return std::acos(x); }) < kTolerance);
  for (double y : {-3.0, -1e-9, -0.0, 0.0, 1e-9, 0.7, 1e12})
    for (double x : {-2.0, -1e-9, -0.0, 0.0, 1e-9, 0.7, 1e12}) {
      INFO("atan2(" << y << ", " << x << ")");
      double a = portable::atan2(y, x);
      CHECK(relative_error(a, std::atan2(static_cast<long double>(y), static_cast<long double>(x))) <
            kTolerance);
      CHECK(std::signbit(a) == std::signbit(y));
    }
  CHECK(std::isnan(portable::acos(1.0000001)));
}

TEST_CASE("portable exp, log and pow agree with long double") {
  CHECK(worst_error(-1, 1, portable::exp, [](long double x) { return std::exp(x); }) < kTolerance);
  CHECK(worst_error(-700, 700, portable::exp, [](long double x) { return std::exp(x); }) < kTolerance);
  CHECK(worst_error(1e-9, 2, portable::log, [](long double x) { return std::log(x); }) < kTolerance);
  CHECK(worst_error(0.99, 1.01, portable::log, [](long double x) { return std::log(x); }) < kTolerance);
  CHECK(worst_error(1, 1e12, portable::log, [](long double x) { return std::log(x); }) < kTolerance);
  for (double y : {-30.5, -1.0, 0.3333, 2.0, 7.25, 60.0})
    CHECK(worst_error(
              1e-3, 50, [&](double x) { return portable::pow(x, y); },
              [&](long double x) { return std::pow(x, static_cast<long double>(y)); }) < kTolerance);
  CHECK(portable::exp(0) == 1);
  CHECK(portable::log(1) == 0);
  CHECK(portable::pow(2, 10) == 1024);
  CHECK(portable::pow(-2, 3) == -8);
  CHECK(portable::pow(0, 2) == 0);
  CHECK(std::isinf(portable::pow(0, -1)));
  CHECK(std::isnan(portable::pow(-2, 0.5)));
  CHECK(std::isinf(portable::exp(800)));
  CHECK(portable::exp(-800) == 0);
  CHECK(std::isnan(portable::log(-1)));
}

TEST_CASE("portable functions keep their bits") {
  // A change of compiler or flags that moves one bit must be seen: state hashes depend on these values.
  std::uint64_t hash = 1469598103934665603u;
  for (int i = 0; i < 1000; ++i) {
    double x = -5 + i * 0.01;
    for (double v : {portable::sin(x), portable::cos(x), portable::atan(x), portable::exp(x),
                     portable::pow(i + 1, 0.3)}) {
      std::uint64_t bits = 0;
      static_assert(sizeof bits == sizeof v);
      std::memcpy(&bits, &v, sizeof v);
      hash = (hash ^ bits) * 1099511628211u;
    }
  }
  CHECK(hash == 0x363b4793438b11b1u);
}
