#pragma once
// Elementary functions with the same bits on every x86-64 machine. The C library chooses its kernels by
// processor, so nothing that feeds the Model or the State may call std::sin and its kin; std::sqrt is exact
// and stays allowed. Own argument reductions and series; relative error below 1e-15 in the ranges stated. NaN
// in, NaN out.

namespace garment::portable {

inline constexpr double kPi = 3.14159265358979323846;

/// |x| up to 1e6 rad to full precision; beyond that the error grows as 1e-16 |x|. Infinity gives NaN.
double sin(double x);
double cos(double x);
double tan(double x);

double atan(double x);
/// Angle of (x, y) in [-pi, pi], with the signs of zeros and infinities as in C.
double atan2(double y, double x);
/// x in [-1, 1], else NaN.
double acos(double x);
double asin(double x);

double exp(double x);
/// Natural logarithm; x < 0 gives NaN, 0 gives -infinity.
double log(double x);
/// x^y; a negative x needs an integer y, else NaN.
double pow(double x, double y);

}  // namespace garment::portable
