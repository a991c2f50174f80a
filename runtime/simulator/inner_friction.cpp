#include "runtime/simulator/inner_friction.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/simulator/elastic_kernels.hpp"
#include "runtime/simulator/elastic_stencils.hpp"

namespace garment::simulator {
namespace {

using model::Index;
using model::Indices;

constexpr double kNoWay = 1e-14;                       // of a strain, along which there is no secant

constexpr double kMostKink2 = 0.75;                    // sin^2(theta/2) at 120 degrees

/// d/du of g = arcsin(q)/q, u = 2 q^2; by its series where that cancels.
double slope_of_turn(double q2, double g) {
  if (q2 < 1e-4) return 1.0 / 12 + q2 * (3.0 / 40 + q2 * 15 / 224);
  return (1 / std::sqrt(1 - q2) - g) / (4 * q2);
}

}  // namespace

/// Works through all stencils. `kWanted` says what of: the potential, forces, the matrix; or the return mapping, whose sum is
/// the heat.
template <int kWanted>
class InnerFriction::Pass {
 public:
  Pass(const InnerFriction& f, const Vectors& x, Vectors* force, BlockMatrix* hessian, InnerFriction* out)
      : f_(f), x_(x), force_(force), hessian_(hessian), out_(out) {}

  double run() {
    find_normals();
    double sum = 0;
    for (std::size_t k = 0; k < f_.springs_.size(); ++k) sum += spring(k);
    for (std::size_t k = 0; k < f_.cells_.size(); ++k) sum += cell(k);
    for (std::size_t k = 0; k < f_.membranes_.size(); ++k) sum += membrane(k);
    for (std::size_t k = 0; k < f_.bends_.size(); ++k) sum += bend(k);
    for (std::size_t k = 0; k < f_.fits_.size(); ++k) sum += fit(k);
    if constexpr (kPush) push_normals();
    return sum;
  }

 private:
  static constexpr bool kPush = kWanted == kForce || kWanted == kHessian, kMatrix = kWanted == kHessian || kWanted == kForesee;

  const Vector3d& at(Index p) const { return x_[static_cast<std::size_t>(p)]; }
  void push(Index p, const Vector3d& f) { (*force_)[static_cast<std::size_t>(p)] += f; }

  void add(std::int32_t code, const Matrix3d& block) {
    const BlockPlace place{code};
    if (place.nowhere()) return;
    float* b = hessian_->raw_block(place.position());
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) b[place.transposed() ? 3 * r + c : 3 * c + r] += static_cast<float>(block(r, c));
  }

  /// One slider, or its return mapping: then the heat stands in `energy`. To foresee, the change of its slope stands in `slope`: from
  /// that in the matrix to the secant as far as the step goes.
  template <class Yield>
  Slip slide(std::size_t list, std::size_t slot, double k, const Yield& yield, double s) {
    if constexpr (kWanted == kSlip) {
      return {follow(out_->sliders_[list][slot], k, yield, s), 0, 0};
    } else if constexpr (kWanted == kStrains) {
      out_->ahead_[list][slot] = s;
      return {};
    } else if constexpr (kWanted == kForesee) {
      const double way = f_.ahead_[list][slot] - s;
      if (std::abs(way) < kNoWay) return {};
      const Slider& slider = f_.sliders_[list][slot];
      const double secant = (slip_at(slider, k, yield, s + way).force - slip_at(slider, k, yield, s).force) / way;
      double& now = out_->slopes_[list][slot];
      const double change = secant - now;
      now += change;
      return {0, 0, change};
    } else {
      const Slip slip = slip_at(f_.sliders_[list][slot], k, yield, s);
      if constexpr (kWanted == kHessian) f_.slopes_[list][slot] = slip.slope;
      return slip;
    }
  }

  /// Of tension: the slider less the share that the elastic law has too much.
  Slip tension(std::size_t list, std::size_t slot, Index law, double strain) {
    const Law& own = f_.laws_[static_cast<std::size_t>(law)];
    const TensileYield yield{f_.stencils_.laws[static_cast<std::size_t>(law)], own.share};
    Slip slip = slide(list, slot, own.stiffness, yield, strain);
    if constexpr (kPush || kWanted == kEnergy) {
      slip.energy -= yield.work(strain);
      slip.force -= yield.at(strain);
      slip.slope -= yield.slope(strain);
    }
    return slip;
  }
  Slip shear(std::size_t list, std::size_t slot, double stiffness, const ShearYield& yield, double phi) {
    Slip slip = slide(list, slot, stiffness, yield, phi);
    if constexpr (kPush || kWanted == kEnergy) {
      slip.energy -= 0.5 * yield.rise * phi * phi;
      slip.force -= yield.rise * phi;
      slip.slope -= yield.rise;
    }
    return slip;
  }

  double spring(std::size_t k) {
    const Spring& s = f_.springs_[k];
    const Vector3d edge = at(s.particle[1]) - at(s.particle[0]);
    const double length = edge.norm();
    const Slip slip = tension(kSprings, k, s.law, length / s.rest - 1);
    if constexpr (kPush || kMatrix) {
      const double inverse = 1 / std::max(length, kLeastLength);
      const Vector3d n = edge * inverse, pull = (s.width * slip.force) * n;
      if constexpr (kPush) {
        push(s.particle[0], pull);
        push(s.particle[1], -pull);
      }
      if constexpr (kMatrix)
        add(s.place, -length_curvature(n, s.width * slip.slope / s.rest, s.width * slip.force * inverse));
    }
    return s.width * s.rest * slip.energy;
  }

  double cell(std::size_t k) {
    const Cell& s = f_.cells_[k];
    const auto& p = s.particle;
    const Vector3d &x0 = at(p[0]), &x1 = at(p[1]), &x2 = at(p[2]), &x3 = at(p[3]), zero = Vector3d::Zero();
    const Direction a(x1 - x0), b(x2 - x3), c(x3 - x0), d(x2 - x1);
    const TrellisAngle ac(a, c), ad(a, d), bd(b, d), bc(b, c);
    auto one = [&](std::size_t q, double phi, const std::array<Vector3d, 4>& g) {
      const Slip slip = shear(kCells, 4 * k + q, s.stiffness, s.yield, phi);
      return s.area * strain(p, s.place, slip, g, s.area);
    };
    double sum = one(0, ac.phi, {-ac.grad_a - ac.grad_b, ac.grad_a, zero, ac.grad_b});
    sum += one(1, ad.phi, {-ad.grad_a, ad.grad_a - ad.grad_b, ad.grad_b, zero});
    sum += one(2, bd.phi, {zero, -bd.grad_b, bd.grad_a + bd.grad_b, -bd.grad_a});
    return sum + one(3, bc.phi, {-bc.grad_b, zero, bc.grad_a, bc.grad_b - bc.grad_a});
  }

  double membrane(std::size_t k) {
    const Membrane& s = f_.membranes_[k];
    const auto& w = s.weight;
    const Vector3d e1 = at(s.particle[1]) - at(s.particle[0]), e2 = at(s.particle[2]) - at(s.particle[0]);
    const Vector3d U = w[1] * e1 + w[2] * e2, V = w[4] * e1 + w[5] * e2, zero = Vector3d::Zero();
    const Direction u(U), v(V);
    const TrellisAngle angle(u, v);
    auto spread = [&](const Vector3d& by_u, const Vector3d& by_v) {
      const Vector3d g1 = w[1] * by_u + w[4] * by_v, g2 = w[2] * by_u + w[5] * by_v;
      return std::array<Vector3d, 3>{-g1 - g2, g1, g2};
    };
    constexpr std::size_t list = kMembranes;
    double sum = strain(s.particle, s.place, tension(list, 3 * k, s.law[0], U.norm() - 1), spread(u.unit, zero), s.area);
    sum += strain(s.particle, s.place, tension(list, 3 * k + 1, s.law[1], V.norm() - 1), spread(zero, v.unit), s.area);
    sum += strain(s.particle, s.place, shear(list, 3 * k + 2, s.stiffness, s.yield, angle.phi), spread(angle.grad_a, angle.grad_b),
                  s.area);
    return s.area * sum;
  }

  /// Forces and curvature of one strain with the gradients g, for the weight `w`; returns the energy without it.
  template <std::size_t N, std::size_t P>
  double strain(const Indices<N>& particle, const std::array<std::int32_t, P>& place, const Slip& slip,
                const std::array<Vector3d, N>& g, double w) {
    if constexpr (kPush)
      for (std::size_t a = 0; a < N; ++a) push(particle[a], (-w * slip.force) * g[a]);
    if constexpr (kMatrix) {
      std::size_t at = 0;
      for (std::size_t a = 0; a < N; ++a)
        for (std::size_t b = a + 1; b < N; ++b) add(place[at++], (w * slip.slope * g[a]) * g[b].transpose());
    }
    return slip.energy;
  }

  double bend(std::size_t k) {
    const Bend& s = f_.bends_[k];
    const Vector3d& middle = at(s.particle[1]);
    Direction in(middle - at(s.particle[0]));
    const Direction out(at(s.particle[2]) - middle);
    if (s.crease >= 0) in.unit = f_.stencils_.creases[static_cast<std::size_t>(s.crease)].turn * in.unit;
    const Vector3d d = out.unit - in.unit;
    // As in BendTerm; beyond 120 degrees by the kink.
    const double q2 = std::min(0.25 * d.squaredNorm(), kMostKink2), q = std::sqrt(q2), g = turn_over_kink(q);
    const double across = d.dot(normal(s.particle[1]));
    const Slip slip = slide(kBends, k, s.stiffness, ConstantYield{s.yield}, g * across);
    if constexpr (kPush || kMatrix) {
      const double by_u = q2 < kMostKink2 ? across * slope_of_turn(q2, g) : 0;
      const Vector3d by_d = g * normal(s.particle[1]) + by_u * d;
      const Vector3d to_out = (by_d - by_d.dot(out.unit) * out.unit) * out.inverse_length;
      Vector3d to_in = (by_d - by_d.dot(in.unit) * in.unit) * -in.inverse_length;
      if (s.crease >= 0) to_in = f_.stencils_.creases[static_cast<std::size_t>(s.crease)].turn.transpose() * to_in;
      strain(s.particle, s.place, slip, std::array<Vector3d, 3>{-to_in, to_in - to_out, to_out}, 1.0);
      by_normal(s.particle[1]) += (slip.force * g) * d;
    }
    return slip.energy;
  }

  double fit(std::size_t k) {
    const Fit& s = f_.fits_[k];
    const Vector3d& origin = at(f_.fit_particle_[s.begin]);
    Vector3d curvature = Vector3d::Zero();
    for (std::size_t j = s.begin + 1; j < s.end; ++j) curvature += f_.fit_weight_[j] * (at(f_.fit_particle_[j]) - origin);
    const Vector3d& n = normal(s.particle);
    const Slip slip = slide(kFits, k, s.stiffness, ConstantYield{s.yield}, curvature.dot(n));
    if constexpr (kPush) {
      Vector3d sum = Vector3d::Zero();
      for (std::size_t j = s.begin + 1; j < s.end; ++j) {
        const Vector3d f = (slip.force * f_.fit_weight_[j]) * n;
        push(f_.fit_particle_[j], -f);
        sum += f;
      }
      push(f_.fit_particle_[s.begin], sum);
      by_normal(s.particle) += slip.force * curvature;
    }
    if constexpr (kMatrix) {
      const Matrix3d h = (slip.slope * n) * n.transpose();
      std::size_t place = s.place;
      for (std::size_t a = s.begin; a < s.end; ++a)
        for (std::size_t b = a + 1; b < s.end; ++b) add(f_.fit_place_[place++], (f_.fit_weight_[a] * f_.fit_weight_[b]) * h);
    }
    return slip.energy;
  }

  std::size_t slot(Index p) const { return static_cast<std::size_t>(f_.normal_slot_[static_cast<std::size_t>(p)]); }
  const Vector3d& normal(Index p) const { return normal_[slot(p)]; }
  Vector3d& by_normal(Index p) { return by_normal_[slot(p)]; }

  /// The normal of each fan: the sum of its triangles' area vectors, made a unit.
  void find_normals() {
    const std::size_t n = f_.normal_of_.size();
    normal_.assign(n, Vector3d::Zero());
    size_.assign(n, 0);
    by_normal_.assign(n, Vector3d::Zero());
    for (std::size_t k = 0; k < n; ++k) {
      const Vector3d& c = at(f_.normal_of_[k]);
      for (std::size_t t = f_.fan_begin_[k]; t < f_.fan_begin_[k + 1]; ++t)
        normal_[k] += (at(f_.fan_[t][0]) - c).cross(at(f_.fan_[t][1]) - c);
      size_[k] = normal_[k].norm();
      if (size_[k] > 0) normal_[k] /= size_[k];
    }
  }

  /// Hands dE/dn on to the corners of the fans.
  void push_normals() {
    for (std::size_t k = 0; k < normal_.size(); ++k) {
      if (!(size_[k] > 0)) continue;
      const Vector3d g = (by_normal_[k] - by_normal_[k].dot(normal_[k]) * normal_[k]) / size_[k];
      const Index centre = f_.normal_of_[k];
      const Vector3d& c = at(centre);
      Vector3d sum = Vector3d::Zero();
      for (std::size_t t = f_.fan_begin_[k]; t < f_.fan_begin_[k + 1]; ++t) {
        const Index i = f_.fan_[t][0], j = f_.fan_[t][1];
        const Vector3d by_i = (at(j) - c).cross(g), by_j = g.cross(at(i) - c);
        push(i, -by_i);
        push(j, -by_j);
        sum += by_i + by_j;
      }
      push(centre, sum);
    }
  }

  const InnerFriction& f_;
  const Vectors& x_;
  Vectors* force_;
  BlockMatrix* hessian_;
  InnerFriction* out_;
  std::vector<Vector3d> normal_, by_normal_;
  std::vector<double> size_;
};

double InnerFriction::energy(const Vectors& x) const {
  return idle_ ? 0 : Pass<kEnergy>(*this, x, nullptr, nullptr, nullptr).run();
}

double InnerFriction::add_force(const Vectors& x, Vectors& force) const {
  return idle_ ? 0 : Pass<kForce>(*this, x, &force, nullptr, nullptr).run();
}

double InnerFriction::add_force_hessian(const Vectors& x, Vectors& force, BlockMatrix& hessian) const {
  if (idle_) return 0;
  const double sum = Pass<kHessian>(*this, x, &force, &hessian, nullptr).run();
  hessian.finish_assembly();
  return sum;
}

double InnerFriction::slip(const Vectors& x) { return idle_ ? 0 : Pass<kSlip>(*this, x, nullptr, nullptr, this).run(); }

void InnerFriction::foresee(const Vectors& x, const Vectors& dx, BlockMatrix& hessian) {
  if (idle_) return;
  Vectors ahead = x;
  for (std::size_t i = 0; i < x.size(); ++i) ahead[i] += dx[i];
  Pass<kStrains>(*this, ahead, nullptr, nullptr, this).run();
  Pass<kForesee>(*this, x, nullptr, &hessian, this).run();
  hessian.finish_assembly();
}

std::vector<double> InnerFriction::anchors() const {
  std::vector<double> out;
  for (const auto& list : sliders_)
    for (const Slider& s : list) out.push_back(s.anchor);
  return out;
}

bool InnerFriction::take_anchors(const std::vector<double>& anchors) {
  std::size_t n = 0, at = 0;
  for (const auto& list : sliders_) n += list.size();
  if (anchors.size() != n || n == 0) return false;
  for (auto& list : sliders_)
    for (Slider& s : list) s.anchor = anchors[at++];
  reset();
  return true;
}

}  // namespace garment::simulator
