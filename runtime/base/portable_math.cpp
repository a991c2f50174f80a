#include "runtime/base/portable_math.hpp"

#include <cmath>
#include <cstdint>
#include <limits>

namespace garment::portable {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A value as the unevaluated sum of two doubles, |lo| <= ulp(hi) / 2.
struct Double2 {
  double hi, lo;
};

Double2 two_sum(double a, double b) {
  double s = a + b;
  double bb = s - a;
  return {s, (a - (s - bb)) + (b - bb)};
}

/// Dekker's product without fused multiply-add, which not every processor has.
Double2 two_product(double a, double b) {
  constexpr double kSplit = 134217729.0;  // 2^27 + 1
  double p = a * b;
  double t = kSplit * a;
  double a_hi = t - (t - a), a_lo = a - a_hi;
  t = kSplit * b;
  double b_hi = t - (t - b), b_lo = b - b_hi;
  return {p, ((a_hi * b_hi - p) + a_hi * b_lo + a_lo * b_hi) + a_lo * b_lo};
}

// pi/2 in parts of 33 bits, so that n times a part is exact for n < 2^20.
constexpr double kHalfPi1 = 0x1.921fb544p+0;
constexpr double kHalfPi2 = 0x1.0b4611a6p-34;
constexpr double kHalfPi3 = 0x1.3198a2ep-69;
constexpr double kHalfPi4 = 0x1.b839a252049c1p-104;

/// x - n pi/2 in [-pi/4, pi/4]; `quadrant` = n mod 4.
Double2 reduce(double x, int& quadrant) {
  constexpr double kLimit = 1.6e6;
  if (std::fabs(x) > kLimit) x = std::fmod(x, 2 * kPi);
  double n = std::nearbyint(x * (2 / kPi));
  quadrant = static_cast<int>(static_cast<std::int64_t>(n) & 3);
  if (n == 0) return {x, 0};
  Double2 a = two_sum(x - n * kHalfPi1, -n * kHalfPi2);
  Double2 b = two_sum(a.hi, -n * kHalfPi3);
  return two_sum(b.hi, (a.lo + b.lo) - n * kHalfPi4);
}

// Taylor coefficients: on [-pi/4, pi/4] the first term left out is below 1e-19.
double sin_kernel(Double2 r) {
  constexpr double c3 = -1.0 / 6, c5 = 1.0 / 120, c7 = -1.0 / 5040, c9 = 1.0 / 362880, c11 = -1.0 / 39916800,
                   c13 = 1.0 / 6227020800.0, c15 = -1.0 / 1307674368000.0, c17 = 1.0 / 355687428096000.0;
  double z = r.hi * r.hi;
  double p = c3 + z * (c5 + z * (c7 + z * (c9 + z * (c11 + z * (c13 + z * (c15 + z * c17))))));
  return r.hi + (r.hi * z * p + r.lo * (1 - 0.5 * z));
}

double cos_kernel(Double2 r) {
  constexpr double c4 = 1.0 / 24, c6 = -1.0 / 720, c8 = 1.0 / 40320, c10 = -1.0 / 3628800,
                   c12 = 1.0 / 479001600, c14 = -1.0 / 87178291200.0, c16 = 1.0 / 20922789888000.0,
                   c18 = -1.0 / 6402373705728000.0;
  double z = r.hi * r.hi;
  double p = c4 + z * (c6 + z * (c8 + z * (c10 + z * (c12 + z * (c14 + z * (c16 + z * c18))))));
  double half = 0.5 * z, w = 1 - half;
  return w + (((1 - w) - half) + (z * z * p - r.hi * r.lo));
}

constexpr double kLn2Hi = 0x1.62e42feep-1;  // 32 bits: k times it is exact
constexpr double kLn2Lo = 0x1.a39ef35793c76p-33;
constexpr double kLn2LoLo = 0x1.cc01f97b57a08p-87;

/// exp(hi + lo).
double exp_sum(double hi, double lo) {
  if (hi > 709.8) return kInfinity;
  if (hi < -745.2) return 0;
  double k = std::nearbyint(hi * 1.4426950408889634);
  Double2 r = two_sum(hi - k * kLn2Hi, -k * kLn2Lo);
  double x = r.hi, tail = r.lo + lo;
  double p = 1.0 / 6227020800.0;  // 1/13!, Horner down to 1/2!
  constexpr double kInverseFactorial[] = {
      1.0 / 479001600, 1.0 / 39916800, 1.0 / 3628800, 1.0 / 362880, 1.0 / 40320, 1.0 / 5040,
      1.0 / 720,       1.0 / 120,      1.0 / 24,      1.0 / 6,      0.5};
  for (double c : kInverseFactorial) p = p * x + c;
  double square = x * x * p;
  double y = 1 + (x + (square + tail * (1 + x + square)));
  // In two steps, since 2^k alone may overflow or be subnormal where the result is not.
  int half = static_cast<int>(k) / 2;
  return std::ldexp(std::ldexp(y, half), static_cast<int>(k) - half);
}

/// Logarithm as a pair, relative error below 1e-18; x positive and finite.
///   log(m 2^k) = k ln 2 + 2 s + 2 s^3/3 + 2 s^5/5 + ...,  s = (m - 1)/(m + 1),  m in [sqrt(1/2), sqrt(2))
Double2 log_pair(double x) {
  int exponent = 0;
  double m = std::frexp(x, &exponent);
  if (m < 0.70710678118654752) {
    m *= 2;
    --exponent;
  }
  double f = m - 1;
  Double2 below = two_sum(m, 1);
  double s = f / below.hi;
  Double2 product = two_product(s, below.hi);
  double s_lo = (((f - product.hi) - product.lo) - s * below.lo) / below.hi;
  double z = s * s, tail = 0;
  for (int n = 27; n >= 3; n -= 2) tail = tail * z + 2.0 / n;
  tail *= z * s;
  Double2 sum = two_sum(2 * s, tail);
  sum.lo += 2 * s_lo + 2 * z * s_lo;
  if (exponent == 0) return two_sum(sum.hi, sum.lo);
  double k = exponent;
  Double2 a = two_sum(k * kLn2Hi, sum.hi);
  Double2 low = two_product(k, kLn2Lo);
  Double2 b = two_sum(a.hi, low.hi);
  return two_sum(b.hi, a.lo + (b.lo + (low.lo + k * kLn2LoLo + sum.lo)));
}

// atan(i/8) as pairs.
constexpr Double2 kAtanTable[9] = {
    {0, 0},
    {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
    {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
    {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
    {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
    {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
    {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
    {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
    {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55},
};

/// x in [0, 1]: atan(x) = atan(c) + atan((x - c)/(1 + c x)) with c the nearest eighth.
Double2 atan_unit(double x) {
  int i = static_cast<int>(x * 8 + 0.5);
  double c = i / 8.0;
  double t = i == 0 ? x : (x - c) / (1 + c * x);
  double z = t * t, p = 0;
  for (int n = 17; n >= 3; n -= 2) p = p * z + ((n / 2) % 2 == 0 ? 1.0 : -1.0) / n;
  return {kAtanTable[i].hi, t + (t * z * p + kAtanTable[i].lo)};
}

constexpr double kPiLo = 0x1.1a62633145c07p-53;

}  // namespace

double sin(double x) {
  if (!std::isfinite(x)) return kNan;
  if (std::fabs(x) < 1e-8) return x;
  int q = 0;
  Double2 r = reduce(x, q);
  double y = q % 2 == 0 ? sin_kernel(r) : cos_kernel(r);
  return q >= 2 ? -y : y;
}

double cos(double x) {
  if (!std::isfinite(x)) return kNan;
  int q = 0;
  Double2 r = reduce(x, q);
  double y = q % 2 == 0 ? cos_kernel(r) : sin_kernel(r);
  return q == 1 || q == 2 ? -y : y;
}

double tan(double x) {
  if (!std::isfinite(x)) return kNan;
  if (std::fabs(x) < 1e-8) return x;
  int q = 0;
  Double2 r = reduce(x, q);
  double s = sin_kernel(r), c = cos_kernel(r);
  return q % 2 == 0 ? s / c : -c / s;
}

double atan(double x) {
  if (std::isnan(x)) return kNan;
  double a = std::fabs(x), y = 0;
  if (a <= 1) {
    Double2 r = atan_unit(a);
    y = r.hi + r.lo;
  } else {
    Double2 r = atan_unit(1 / a);
    y = (kPi / 2 - r.hi) - (r.lo - kPiLo / 2);
  }
  return std::copysign(y, x);
}

double atan2(double y, double x) {
  if (std::isnan(x) || std::isnan(y)) return kNan;
  double ax = std::fabs(x), ay = std::fabs(y);
  if (std::isinf(ax) && std::isinf(ay)) ax = ay = 1;
  Double2 r{0, 0};
  if (ay <= ax) {
    if (ax > 0) r = atan_unit(std::isinf(ax) ? 0 : ay / ax);
  } else {
    r = atan_unit(std::isinf(ay) ? 0 : ax / ay);
    r = {kPi / 2 - r.hi, kPiLo / 2 - r.lo};
  }
  double angle = std::signbit(x) ? (kPi - r.hi) + (kPiLo - r.lo) : r.hi + r.lo;
  return std::copysign(angle, y);
}

double acos(double x) {
  if (!(std::fabs(x) <= 1)) return kNan;
  return 2 * atan2(std::sqrt(1 - x), std::sqrt(1 + x));
}

double asin(double x) {
  if (!(std::fabs(x) <= 1)) return kNan;
  return atan2(x, std::sqrt((1 - x) * (1 + x)));
}

double exp(double x) { return std::isnan(x) ? kNan : exp_sum(x, 0); }

double log(double x) {
  if (std::isnan(x) || x < 0) return kNan;
  if (x == 0) return -kInfinity;
  if (std::isinf(x)) return x;
  Double2 l = log_pair(x);
  return l.hi + l.lo;
}

double pow(double x, double y) {
  if (y == 0 || x == 1) return 1;
  if (std::isnan(x) || std::isnan(y)) return kNan;
  bool integer = std::floor(y) == y;  // infinity too
  bool odd = integer && std::fabs(y) < 9007199254740992.0 && std::fmod(y, 2) != 0;
  double ax = std::fabs(x);
  if (x < 0 && !integer && !std::isinf(x)) return kNan;
  double result = 0;
  if (ax == 0 || std::isinf(ax) || std::isinf(y)) {
    bool grows = (ax > 1) == (y > 0);
    result = ax == 1 ? 1 : (grows ? kInfinity : 0);
  } else {
    Double2 l = log_pair(ax);
    Double2 p = std::fabs(y) > 1e300 ? Double2{y * l.hi, 0} : two_product(y, l.hi);
    if (!std::isfinite(p.lo) || std::fabs(p.hi) > 1000) p.lo = 0;
    result = exp_sum(p.hi, p.lo + (std::fabs(p.hi) > 1000 ? 0 : y * l.lo));
  }
  return odd && std::signbit(x) ? -result : result;
}

}  // namespace garment::portable
