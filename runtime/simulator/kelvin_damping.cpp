#include "runtime/simulator/kelvin_damping.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "runtime/base/parallel.hpp"
#include "runtime/simulator/elastic_kernels.hpp"
#include "runtime/simulator/elastic_stencils.hpp"

namespace garment::simulator {
namespace {

// Lengths of kinks, twists and curvatures are rounded off near zero, where they have no direction: |d| = sqrt(d . d + least^2).
constexpr double kLeastKink = 1e-3;       // rad
constexpr double kLeastTwist = 1e-5;      // m
constexpr double kLeastCurvature = 0.1;   // 1/m

}  // namespace

/// Works through one chunk: of every stencil its strains, their gradients, and what `kWanted` asks of them.
template <int kWanted>
class KelvinDamping::Pass {
 public:
  Pass(const KelvinDamping& d, const Vector3d* x, double h, Vector3d* force, BlockMatrix* hessian, KelvinDamping* out)
      : d_(d), s_(d.stencils_), x_(x), inverse_step_(h > 0 ? 1 / h : 0), force_(force), hessian_(hessian), out_(out) {}

  double run(const Chunk& chunk) const {
    double sum = 0;
    for (std::size_t k = chunk.springs.begin; k < chunk.springs.end; ++k) sum += spring(k);
    for (std::size_t k = chunk.cells.begin; k < chunk.cells.end; ++k) sum += cell(k);
    for (std::size_t k = chunk.membranes.begin; k < chunk.membranes.end; ++k) sum += membrane(k);
    for (std::size_t k = chunk.bends.begin; k < chunk.bends.end; ++k) sum += bend(k);
    for (std::size_t k = chunk.fits.begin; k < chunk.fits.end; ++k) sum += fit(k);
    return sum;
  }

 private:
  const Vector3d& at(Index p) const { return x_[p]; }

  template <std::size_t N>
  double tau(const Indices<N>& particle) const {
    double sum = 0;
    for (Index p : particle) sum += d_.tau_[p];
    return sum / static_cast<double>(N);
  }

  void add(BlockPlace place, const Matrix3d& block) const {
    if (place.nowhere()) return;
    float* b = hessian_->raw_block(place.position());
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) b[place.transposed() ? 3 * r + c : 3 * c + r] += static_cast<float>(block(r, c));
  }

  /// One strain s of a stencil of N particles with the gradients `g`; `stiffness` and tau matter when a step begins.
  template <std::size_t N, std::size_t P>
  double strain(std::vector<Dashpot> KelvinDamping::*list, std::size_t slot, const Indices<N>& particle,
                const std::array<BlockPlace, P>& place, double s, const std::array<Vector3d, N>& g, double stiffness) const {
    if constexpr (kWanted == kBegin) {
      (out_->*list)[slot] = {s, tau(particle) * std::max(stiffness, 0.0)};
      return 0;
    } else {
      const Dashpot& dashpot = (d_.*list)[slot];
      const double c = dashpot.eta * inverse_step_, change = s - dashpot.s;
      if constexpr (kWanted >= kForce)
        for (std::size_t a = 0; a < N; ++a) force_[particle[a]] -= (c * change) * g[a];
      if constexpr (kWanted == kHessian) {
        std::size_t at = 0;
        for (std::size_t a = 0; a < N; ++a)
          for (std::size_t b = a + 1; b < N; ++b) add(place[at++], (c * g[a]) * g[b].transpose());
      }
      return 0.5 * c * change * change;
    }
  }

  double spring(std::size_t k) const {
    const SpringStencil& s = s_.springs[k];
    const Direction n(at(s.particle[1]) - at(s.particle[0]));
    const double strain_now = (at(s.particle[1]) - at(s.particle[0])).norm() * s.inverse_rest - 1;
    const Vector3d g = s.inverse_rest * n.unit;
    double stiffness = 0;
    if constexpr (kWanted == kBegin) stiffness = s.width * s.rest * s_.laws[s.law].at(strain_now).slope;
    return strain(&KelvinDamping::springs_, k, s.particle, std::array<BlockPlace, 1>{s.place}, strain_now,
                  std::array<Vector3d, 2>{-g, g}, stiffness);
  }

  double cell(std::size_t k) const {
    const CellStencil& s = s_.cells[k];
    const auto& p = s.particle;
    const Vector3d &x0 = at(p[0]), &x1 = at(p[1]), &x2 = at(p[2]), &x3 = at(p[3]), zero = Vector3d::Zero();
    const Direction a(x1 - x0), b(x2 - x3), c(x3 - x0), d(x2 - x1);
    const TrellisAngle ac(a, c), ad(a, d), bd(b, d), bc(b, c);
    using Gradients = std::array<Vector3d, 4>;
    auto one = [&](std::size_t q, double value, const Gradients& g, double stiffness) {
      return strain(&KelvinDamping::cells_, 5 * k + q, p, s.place, value, g, stiffness);
    };
    double sum = one(0, ac.phi, Gradients{-ac.grad_a - ac.grad_b, ac.grad_a, zero, ac.grad_b}, s.corner_shear);
    sum += one(1, ad.phi, Gradients{-ad.grad_a, ad.grad_a - ad.grad_b, ad.grad_b, zero}, s.corner_shear);
    sum += one(2, bd.phi, Gradients{zero, -bd.grad_b, bd.grad_a + bd.grad_b, -bd.grad_a}, s.corner_shear);
    sum += one(3, bc.phi, Gradients{-bc.grad_b, zero, bc.grad_a, bc.grad_b - bc.grad_a}, s.corner_shear);
    Vector3d twist = (x2 - x3) - (x1 - x0);
    if (s.twisted >= 0) twist -= s_.twisted[s.twisted].now;
    const double size = std::sqrt(twist.squaredNorm() + kLeastTwist * kLeastTwist);
    const Vector3d t = twist / size;
    return sum + one(4, size, Gradients{t, -t, t, -t}, s.twist);
  }

  double membrane(std::size_t k) const {
    const MembraneStencil& s = s_.membranes[k];
    const auto& w = s.weight;
    const Vector3d e1 = at(s.particle[1]) - at(s.particle[0]), e2 = at(s.particle[2]) - at(s.particle[0]);
    const Vector3d U = w[1] * e1 + w[2] * e2, V = w[4] * e1 + w[5] * e2;
    const Direction u(U), v(V);
    const TrellisAngle angle(u, v);
    double slope_u = 0, slope_v = 0;
    if constexpr (kWanted == kBegin) {
      slope_u = s_.laws[s.law[0]].at(U.norm() - 1).slope;
      slope_v = s_.laws[s.law[1]].at(V.norm() - 1).slope;
    }
    using Gradients = std::array<Vector3d, 3>;
    auto spread = [&](const Vector3d& by_u, const Vector3d& by_v) {
      const Vector3d g1 = w[1] * by_u + w[4] * by_v, g2 = w[2] * by_u + w[5] * by_v;
      return Gradients{-g1 - g2, g1, g2};
    };
    auto one = [&](std::size_t q, double value, const Gradients& g, double stiffness) {
      return strain(&KelvinDamping::membranes_, 3 * k + q, s.particle, s.place, value, g, stiffness);
    };
    const Vector3d zero = Vector3d::Zero();
    return one(0, U.norm() - 1, spread(u.unit, zero), s.area * slope_u) +
           one(1, V.norm() - 1, spread(zero, v.unit), s.area * slope_v) +
           one(2, angle.phi, spread(angle.grad_a, angle.grad_b), s.area * s.shear);
  }

  double bend(std::size_t k) const {
    const BendStencil& s = s_.bends[k];
    const Vector3d& middle = at(s.particle[1]);
    Direction in(middle - at(s.particle[0]));
    const Direction out(at(s.particle[2]) - middle);
    if (s.crease >= 0) in.unit = s_.creases[s.crease].turn * in.unit;
    const Vector3d kink = out.unit - in.unit;
    const double size = std::sqrt(kink.squaredNorm() + kLeastKink * kLeastKink);
    const Vector3d n = kink / size;
    Vector3d g_in = -(n - n.dot(in.unit) * in.unit) * in.inverse_length;
    const Vector3d g_out = (n - n.dot(out.unit) * out.unit) * out.inverse_length;
    if (s.crease >= 0) g_in = s_.creases[s.crease].turn.transpose() * g_in;
    double stiffness = 0;
    if constexpr (kWanted == kBegin) stiffness = BendTerm(s.stiffness, in, out).stiffness;
    return strain(&KelvinDamping::bends_, k, s.particle, s.place, size, std::array<Vector3d, 3>{-g_in, g_in - g_out, g_out},
                  stiffness);
  }

  /// The length of each curvature vector; of folded cloth those vectors whole, rest included.
  double fit(std::size_t k) const {
    const FitStencil& s = s_.fits[k];
    if (s.begin == s.end) return 0;
    const Vector3d& origin = at(s_.fit_particle[s.begin]);
    Matrix3d curvature = Matrix3d::Zero();
    for (std::size_t j = s.begin + 1; j < s.end; ++j)
      curvature += (at(s_.fit_particle[j]) - origin) * s_.fit_weight[j].transpose();
    double sum = 0;
    for (int q = 0; q < 3; ++q) {
      const double size = std::sqrt(curvature.col(q).squaredNorm() + kLeastCurvature * kLeastCurvature);
      if constexpr (kWanted == kBegin) {
        out_->fits_[3 * k + q] = {size, d_.tau_[s_.fit_particle[s.begin]] * std::max(s.rigidity(q, q), 0.0)};
      } else {
        const Dashpot& dashpot = d_.fits_[3 * k + q];
        const double c = dashpot.eta * inverse_step_, change = size - dashpot.s;
        sum += 0.5 * c * change * change;
        const Vector3d n = curvature.col(q) / size;
        if constexpr (kWanted >= kForce) push_fit(s, q, (c * change) * n);
        if constexpr (kWanted == kHessian) stiffen_fit(s, d_.fit_places_[k], q, (c * n) * n.transpose());
      }
    }
    return sum;
  }
  void push_fit(const FitStencil& s, int q, const Vector3d& pull) const {
    Vector3d sum = Vector3d::Zero();
    for (std::size_t j = s.begin + 1; j < s.end; ++j) {
      const Vector3d f = s_.fit_weight[j][q] * pull;
      force_[s_.fit_particle[j]] -= f;
      sum += f;
    }
    force_[s_.fit_particle[s.begin]] += sum;
  }

  /// n nT w_a w_b for every pair of the fit's particles.
  void stiffen_fit(const FitStencil& s, std::size_t place, int q, const Matrix3d& curvature) const {
    for (std::size_t a = s.begin; a < s.end; ++a)
      for (std::size_t b = a + 1; b < s.end; ++b)
        add({d_.pair_places_[place++]}, (s_.fit_weight[a][q] * s_.fit_weight[b][q]) * curvature);
  }

  const KelvinDamping& d_;
  const ElasticStencils& s_;
  const Vector3d* x_;
  double inverse_step_;
  Vector3d* force_;
  BlockMatrix* hessian_;
  KelvinDamping* out_;
};

KelvinDamping::KelvinDamping(const model::Model& model, const ElasticModel& elastic)
    : stencils_(elastic.stencils()), tau_(model.damping) {
  if (tau_.empty()) tau_.assign(model.n_particles(), model::kUsualDamping);
  for (double t : tau_) largest_ = std::max(largest_, t);
  idle_ = largest_ == 0;
  springs_.resize(stencils_.springs.size());
  cells_.resize(5 * stencils_.cells.size());
  membranes_.resize(3 * stencils_.membranes.size());
  bends_.resize(stencils_.bends.size());
  fits_.resize(3 * stencils_.fits.size());
  for (const FitStencil& s : stencils_.fits) {
    fit_places_.push_back(pair_places_.size());
    for (std::size_t a = s.begin; a < s.end; ++a)
      for (std::size_t b = a + 1; b < s.end; ++b) {
        const Index i = stencils_.fit_particle[a], j = stencils_.fit_particle[b];
        pair_places_.push_back(i == j ? -1 : 2 * stencils_.pattern->find(std::min(i, j), std::max(i, j)) + (i > j ? 1 : 0));
      }
  }
}

/// Chunks of one colour share no particle; energies are added in the order of the chunks.
template <class Work>
double KelvinDamping::run(const Work& pass) const {
  std::vector<double> part(stencils_.chunks.size(), 0.0);
  for (const std::vector<std::size_t>& color : stencils_.colors)
    parallel_for(color.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t c = begin; c < end; ++c) part[color[c]] = pass.run(stencils_.chunks[color[c]]);
    });
  double sum = 0;
  for (double p : part) sum += p;
  return sum;
}

void KelvinDamping::begin(const std::vector<Vector3d>& x) {
  if (!idle_) run(Pass<kBegin>(*this, x.data(), 0, nullptr, nullptr, this));
}

double KelvinDamping::potential(const std::vector<Vector3d>& x, double h) const {
  return idle_ ? 0 : run(Pass<kPotential>(*this, x.data(), h, nullptr, nullptr, nullptr));
}

double KelvinDamping::add_force(const std::vector<Vector3d>& x, double h, std::vector<Vector3d>& force) const {
  return idle_ ? 0 : run(Pass<kForce>(*this, x.data(), h, force.data(), nullptr, nullptr));
}

double KelvinDamping::add_force_hessian(const std::vector<Vector3d>& x, double h, std::vector<Vector3d>& force,
                                        BlockMatrix& hessian) const {
  if (idle_) return 0;
  const double sum = run(Pass<kHessian>(*this, x.data(), h, force.data(), &hessian, nullptr));
  hessian.finish_assembly();
  return sum;
}

}  // namespace garment::simulator
