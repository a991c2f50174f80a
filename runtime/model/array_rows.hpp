#pragma once
// The numbers in one row of any of the Model's arrays.
#include "runtime/model/model.hpp"

namespace garment::model {

template <class F>
void for_each_number(double x, const F& f) {
  f(x);
}
template <class F>
void for_each_number(Index x, const F& f) {
  f(x);
}
template <class F>
void for_each_number(HoldKind x, const F& f) {
  f(static_cast<Index>(x));
}
template <class F, int N>
void for_each_number(const Eigen::Matrix<double, N, 1>& x, const F& f) {
  for (int k = 0; k < N; ++k) f(x[k]);
}
template <class F, class T, std::size_t N>
void for_each_number(const std::array<T, N>& x, const F& f) {
  for (const T& y : x) f(y);
}

/// Is a row more than one number?
template <class T>
inline constexpr bool kIsTuple = true;
template <>
inline constexpr bool kIsTuple<double> = false;
template <>
inline constexpr bool kIsTuple<Index> = false;
template <>
inline constexpr bool kIsTuple<HoldKind> = false;

}  // namespace garment::model
