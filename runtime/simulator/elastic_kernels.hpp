#pragma once
// The mathematics of one stencil each: positions in, energy, gradient and curvature out. Inlined into the
// loops of elastic.cpp; no trigonometry of the C library, whose last bits change with the processor.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "runtime/simulator/tensile_table.hpp"

namespace garment::simulator {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Edges shorter than this count as this long (m): directions fade out instead of becoming NaN.
constexpr double kLeastLength = 1e-7;

/// asin for |x| <= 1 (beyond: clamped), error under 1 ulp or so. The rational approximation of FreeBSD's libm
/// (e_asin.c), which uses nothing but + * / and sqrt.
inline double arc_sine(double x) {
  const double a = std::min(std::abs(x), 1.0);
  const bool small = a < 0.5;
  const double t = small ? a * a : (1 - a) / 2;
  const double p = t * (1.66666666666666657415e-01 +
                        t * (-3.25565818622400915405e-01 +
                             t * (2.01212532134862925881e-01 +
                                  t * (-4.00555345006794114027e-02 +
                                       t * (7.91534994289814532176e-04 + t * 3.47933107596021167570e-05)))));
  const double q = 1 + t * (-2.40339491173441421878e+00 +
                            t * (2.02094576023350569471e+00 +
                                 t * (-6.88283971605453293030e-01 + t * 7.70381505559019352791e-02)));
  const double base = small ? a : std::sqrt(t);
  const double s = base + base * (p / q);
  return std::copysign(small ? s : 1.57079632679489661923 - 2 * s, x);
}

/// An edge and its direction.
struct Direction {
  Vector3d unit;
  double inverse_length;
  explicit Direction(const Vector3d& edge) {
    inverse_length = 1 / std::max(edge.norm(), kLeastLength);
    unit = edge * inverse_length;
  }
};

/// Trellis angle phi = pi/2 - angle(a, b) and its gradients along the two edges.
///        b
///        ^   / phi > 0: the corner has closed
///        |  /
///        +-----> a
struct TrellisAngle {
  double phi;
  Vector3d grad_a, grad_b;  ///< rad/m
  TrellisAngle(const Direction& a, const Direction& b) {
    const double s = a.unit.dot(b.unit);
    phi = arc_sine(s);
    const double inverse_cosine = 1 / std::max(std::sqrt(std::max((1 - s) * (1 + s), 0.0)), 1e-9);
    grad_a = (b.unit - s * a.unit) * (inverse_cosine * a.inverse_length);
    grad_b = (a.unit - s * b.unit) * (inverse_cosine * b.inverse_length);
  }
};

/// arcsin(q)/q for 0 <= q <= 1: half of a turn over half of the kink |t_out - t_in| that it makes.
inline double turn_over_kink(double q) { return q > 1e-6 ? arc_sine(q) / q : 1; }

/// Bending at the middle of three particles, E = k/2 theta^2: what an arc of that turn has, of any length. Held against it,
/// 2 tan(theta/2) for theta is 31 % too stiff where cloth is bent to 1.5 /cm on a grid of 5 mm.
///
///     before ---e_in---> at ---e_out---> after,   theta = angle between e_in and e_out
///
/// With the kink d = t_out - t_in and u = 1 - cos(theta) = |d|^2 / 2: |d| = 2 sin(theta/2), dE/du = k theta / sin(theta).
struct BendTerm {
  double energy;
  Vector3d grad_in, grad_out;  ///< dE/d(e_in), dE/d(e_out), N
  double stiffness;            ///< dE/du, which bounds the curvature along the kink and across it; at most 16 k, N m
  BendTerm(double k, const Direction& in, const Direction& out) {
    const Vector3d d = out.unit - in.unit;
    const double u = 0.5 * d.squaredNorm(), q = std::min(std::sqrt(0.5 * u), 1.0), ratio = turn_over_kink(q);
    const double theta = 2 * q * ratio, slope = k * ratio / std::max(std::sqrt((1 - q) * (1 + q)), 1e-9);
    energy = 0.5 * k * theta * theta;
    stiffness = std::min(slope, 16 * k);
    grad_out = (d - u * out.unit) * (slope * out.inverse_length);
    grad_in = (d + u * in.unit) * (-slope * in.inverse_length);
  }
};

/// along n nT + across (I - n nT): curvature of an energy that depends on the length of one vector.
inline Matrix3d length_curvature(const Vector3d& n, double along, double across) {
  Matrix3d h = ((along - across) * n) * n.transpose();
  h.diagonal().array() += across;
  return h;
}

/// Cut cell per unit of area: E = Psi1(|U| - 1) + Psi2(|V| - 1) + G phi^2 / 2.
struct MembraneTerm {
  Tension u, v;
  Direction along_u, along_v;
  TrellisAngle angle;
  MembraneTerm(const TensileTable& warp, const TensileTable& weft, const Vector3d& U, const Vector3d& V)
      : u(warp.at(U.norm() - 1)), v(weft.at(V.norm() - 1)), along_u(U), along_v(V), angle(along_u, along_v) {}
  double energy(double scale, double G) const {
    return scale * (u.psi + v.psi) + 0.5 * G * angle.phi * angle.phi;
  }
  Vector3d grad_u(double scale, double G) const {
    return scale * u.force * along_u.unit + G * angle.phi * angle.grad_a;
  }
  Vector3d grad_v(double scale, double G) const {
    return scale * v.force * along_v.unit + G * angle.phi * angle.grad_b;
  }
  Matrix3d curvature_uu(double scale, double G) const {
    return side(u, along_u, scale) + G * angle.grad_a * angle.grad_a.transpose();
  }
  Matrix3d curvature_vv(double scale, double G) const {
    return side(v, along_v, scale) + G * angle.grad_b * angle.grad_b.transpose();
  }
  Matrix3d curvature_uv(double G) const { return G * angle.grad_a * angle.grad_b.transpose(); }

 private:
  static Matrix3d side(const Tension& t, const Direction& d, double scale) {
    return length_curvature(d.unit, scale * std::max(t.slope, 0.0),
                            scale * std::max(t.force, 0.0) * d.inverse_length);
  }
};

/// A thread of stiffness k that is slack up to its length; too long by more than model::kTieReach it pulls no harder. A rod
/// pushes alike where its ends come too near, and has the reach model::kRodReach.
struct TieTerm {
  double energy = 0, force = 0, slope = 0;  ///< J, N, N/m, by the distance of its ends
  TieTerm(double k, double gap, bool rod = false) {
    if (gap <= 0 && !rod) return;
    const double reach = rod ? model::kRodReach : model::kTieReach, held = std::clamp(gap, -reach, reach);
    force = k * held;
    energy = force * (gap - 0.5 * held);
    slope = std::abs(gap) < reach ? k : 0;
  }
};

}  // namespace garment::simulator
