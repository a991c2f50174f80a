#pragma once
// Gauss-Legendre quadrature on an interval; exact for polynomials of degree 2n - 1.
#include <array>
#include <cstddef>

namespace garment::geometry {

template <std::size_t N>
struct GaussRule {
  std::array<double, N> x, w;  ///< abscissae and weights on [-1, 1]
};

inline constexpr GaussRule<5> kGauss5{
    {-0.90617984593866399, -0.53846931010568309, 0, 0.53846931010568309, 0.90617984593866399},
    {0.23692688505618909, 0.47862867049936647, 0.56888888888888889, 0.47862867049936647,
     0.23692688505618909}};

inline constexpr GaussRule<8> kGauss8{
    {-0.96028985649753623, -0.79666647741362674, -0.52553240991632899, -0.18343464249564980,
     0.18343464249564980, 0.52553240991632899, 0.79666647741362674, 0.96028985649753623},
    {0.10122853629037626, 0.22238103445337447, 0.31370664587788729, 0.36268378337836198, 0.36268378337836198,
     0.31370664587788729, 0.22238103445337447, 0.10122853629037626}};

/// Integral of `f` over [a, b].
template <class Value, std::size_t N, class Function>
Value integrate(const GaussRule<N>& rule, double a, double b, const Value& zero, const Function& f) {
  double middle = 0.5 * (a + b), half = 0.5 * (b - a);
  Value sum = zero;
  for (std::size_t i = 0; i < N; ++i) sum += rule.w[i] * f(middle + half * rule.x[i]);
  return half * sum;
}

}  // namespace garment::geometry
