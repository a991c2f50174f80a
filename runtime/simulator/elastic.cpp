#include "runtime/simulator/elastic.hpp"

#include <Eigen/SVD>

#include "runtime/base/parallel.hpp"
#include "runtime/simulator/elastic_kernels.hpp"
#include "runtime/simulator/elastic_stencils.hpp"

namespace garment::simulator {
namespace {

constexpr std::size_t kParticleGrain = 2048;
constexpr double kLeastStretch = 1e-3;

enum class Wanted { energy, force, hessian };

/// The curvatures of a folded stencil at rest, turned with the cloth: by the rotation R that carries the places at rest best
/// onto the particles (Kabsch 1976). When particles move by dx, R turns by `stretch` times the sum of (R place) x dx: the inverse of
/// tr(S) I - S, S = R (RT sum x placeT) RT.
struct FoldedRest {
  Matrix3d curvature, rotation, stretch;

  FoldedRest() = default;
  FoldedRest(const ElasticStencils& s, const Fold& fold, const Vector3d* x) {
    const Vector3d& origin = x[s.fold_frames[fold.begin].particle];  // the places' sum is zero: any origin does
    Matrix3d together = Matrix3d::Zero();
    for (std::size_t j = fold.begin; j < fold.end; ++j)
      together += (x[s.fold_frames[j].particle] - origin) * s.fold_frames[j].place.transpose();
    const Eigen::JacobiSVD<Matrix3d> svd(together, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const double mirrored = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
    rotation = svd.matrixU() * Vector3d(1, 1, mirrored).asDiagonal() * svd.matrixV().transpose();
    curvature = rotation * fold.rest;
    Vector3d size = svd.singularValues();
    size[2] *= mirrored;
    const double least = kLeastStretch * size[0];  // cloth crushed to a line turns with nothing
    Vector3d inverse;
    for (int k = 0; k < 3; ++k) {
      const double other = size.sum() - size[k];
      inverse[k] = other > least && other > 0 ? 1 / other : 0;
    }
    stretch = svd.matrixU() * inverse.asDiagonal() * svd.matrixU().transpose();
  }
};

/// Works through one chunk. Writes forces and upper blocks of particles that no other chunk of this colour
/// touches.
template <Wanted kWanted>
class ChunkPass {
 public:
  ChunkPass(const ElasticStencils& stencils, const Vector3d* x, Vector3d* force, BlockMatrix* hessian)
      : s_(stencils), x_(x), force_(force), hessian_(hessian) {}

  double run(const Chunk& chunk) const {
    double energy = 0;
    for (std::size_t k = chunk.springs.begin; k < chunk.springs.end; ++k) energy += spring(s_.springs[k]);
    for (std::size_t k = chunk.cells.begin; k < chunk.cells.end; ++k) energy += cell(s_.cells[k]);
    for (std::size_t k = chunk.membranes.begin; k < chunk.membranes.end; ++k)
      energy += membrane(s_.membranes[k]);
    for (std::size_t k = chunk.bends.begin; k < chunk.bends.end; ++k) energy += bend(s_.bends[k]);
    for (std::size_t k = chunk.fits.begin; k < chunk.fits.end; ++k) energy += fit(s_.fits[k]);
    for (std::size_t k = chunk.ties.begin; k < chunk.ties.end; ++k) energy += tie(s_.ties[k]);
    return energy;
  }

 private:
  static constexpr bool kForce = kWanted != Wanted::energy, kHessian = kWanted == Wanted::hessian;

  const Vector3d& at(Index particle) const { return x_[particle]; }
  void push(Index particle, const Vector3d& f) const { force_[particle] += f; }

  /// Adds `block` (d2E / dx_first dx_second) where `place` says.
  void add(BlockPlace place, const Matrix3d& block) const {
    if (place.nowhere()) return;
    float* b = hessian_->raw_block(place.position());
    if (place.transposed())
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) b[3 * c + r] += static_cast<float>(block(c, r));
    else
      for (int e = 0; e < 9; ++e) b[e] += static_cast<float>(block.data()[e]);
  }
  void add(BlockPlace place, double diagonal) const {
    if (place.nowhere()) return;
    float* b = hessian_->raw_block(place.position());
    const auto d = static_cast<float>(diagonal);
    b[0] += d;
    b[4] += d;
    b[8] += d;
  }

  double spring(const SpringStencil& s) const {
    const Vector3d edge = at(s.particle[1]) - at(s.particle[0]);
    const double length = edge.norm(), scale = s_.tensile_scale * s.width;
    const Tension t = s_.laws[s.law].at((length - s.rest) * s.inverse_rest);
    if constexpr (kForce) {
      const double inverse_length = 1 / std::max(length, kLeastLength);
      const Vector3d n = edge * inverse_length, pull = (scale * t.force) * n;
      push(s.particle[0], pull);
      push(s.particle[1], -pull);
      if constexpr (kHessian)
        add(s.place, -length_curvature(n, scale * std::max(t.slope, 0.0) * s.inverse_rest,
                                       scale * std::max(t.force, 0.0) * inverse_length));
    }
    return scale * s.rest * t.psi;
  }

  //        3 --b-> 2     Trellis angles at the corners 0 (a, c), 1 (a, d), 2 (b, d), 3 (b, c);
  //        ^       ^     twist by b - a = x2 - x1 - x3 + x0. That vector is n h1 h2 kappa_12 on a twisted
  //        cell and zero c       d     under any uniform strain; taking it whole instead of its part along
  //        the cell's normal keeps |       |     the energy quadratic and defined on collapsed cells, at the
  //        price of a stiffness Ct/h^2 0 --a-> 1     against non-uniform strain, a thousandth of the
  //        trellis'.
  double cell(const CellStencil& s) const {
    const auto& p = s.particle;
    const Vector3d &x0 = at(p[0]), &x1 = at(p[1]), &x2 = at(p[2]), &x3 = at(p[3]);
    Vector3d twist = (x2 - x3) - (x1 - x0);
    if (s.twisted >= 0) twist -= s_.twisted[s.twisted].now;
    const Direction a(x1 - x0), b(x2 - x3), c(x3 - x0), d(x2 - x1);
    const TrellisAngle ac(a, c), ad(a, d), bd(b, d), bc(b, c);
    const double k = s.corner_shear;
    if constexpr (kForce) {
      const Vector3d twist_force = s.twist * twist;
      const Vector3d fa = k * (ac.phi * ac.grad_a + ad.phi * ad.grad_a),
                     fb = k * (bd.phi * bd.grad_a + bc.phi * bc.grad_a);
      const Vector3d fc = k * (ac.phi * ac.grad_b + bc.phi * bc.grad_b),
                     fd = k * (ad.phi * ad.grad_b + bd.phi * bd.grad_b);
      push(p[0], fa + fc - twist_force);
      push(p[1], fd - fa + twist_force);
      push(p[2], -fb - fd - twist_force);
      push(p[3], fb - fc + twist_force);
      if constexpr (kHessian) add_trellis(s, ac, ad, bd, bc);
    }
    return 0.5 * k * (ac.phi * ac.phi + ad.phi * ad.phi + bd.phi * bd.phi + bc.phi * bc.phi) +
           0.5 * s.twist * twist.squaredNorm();
  }

  /// k sum over corners of grad phi grad phiT; each corner moves three particles, so each pair belongs to two
  /// corners.
  void add_trellis(const CellStencil& s, const TrellisAngle& ac, const TrellisAngle& ad,
                   const TrellisAngle& bd, const TrellisAngle& bc) const {
    const double k = s.corner_shear;
    const Vector3d m0 = -k * (ac.grad_a + ac.grad_b);  // corner 0, particle 0; particles 1, 3: grad_a, grad_b
    const Vector3d m1 = ad.grad_a - ad.grad_b;  // corner 1, particle 1; particles 0, 2: -grad_a, grad_b
    const Vector3d m2 =
        k * (bd.grad_a + bd.grad_b);            // corner 2, particle 2; particles 3, 1: -grad_a, -grad_b
    const Vector3d m3 = bc.grad_b - bc.grad_a;  // corner 3, particle 3; particles 2, 0: grad_a, -grad_b
    const Vector3d ka = k * ad.grad_a, kb = k * bc.grad_b, kd = k * ad.grad_b, kc = k * bc.grad_a;
    add(s.place[0], m0 * ac.grad_a.transpose() - ka * m1.transpose());
    add(s.place[1], -ka * ad.grad_b.transpose() - kb * bc.grad_a.transpose());
    add(s.place[2], m0 * ac.grad_b.transpose() - kb * m3.transpose());
    add(s.place[3], m1 * kd.transpose() - bd.grad_b * m2.transpose());
    add(s.place[4], (k * ac.grad_a) * ac.grad_b.transpose() + (k * bd.grad_b) * bd.grad_a.transpose());
    add(s.place[5], kc * m3.transpose() - m2 * bd.grad_a.transpose());
  }

  double membrane(const MembraneStencil& s) const {
    const auto& w = s.weight;
    // The weights sum to zero; differences make the forces' sum vanish to the last bit's rounding.
    const Vector3d e1 = at(s.particle[1]) - at(s.particle[0]), e2 = at(s.particle[2]) - at(s.particle[0]);
    const MembraneTerm t(s_.laws[s.law[0]], s_.laws[s.law[1]], w[1] * e1 + w[2] * e2, w[4] * e1 + w[5] * e2);
    const double scale = s_.tensile_scale * s.area, shear = s.area * s.shear;
    if constexpr (kForce) {
      const Vector3d gu = t.grad_u(scale, shear), gv = t.grad_v(scale, shear);
      const Vector3d f1 = -(w[1] * gu + w[4] * gv), f2 = -(w[2] * gu + w[5] * gv);
      push(s.particle[0], -f1 - f2);
      push(s.particle[1], f1);
      push(s.particle[2], f2);
      if constexpr (kHessian) {
        const Matrix3d uu = t.curvature_uu(scale, shear), vv = t.curvature_vv(scale, shear),
                       uv = t.curvature_uv(shear);
        const std::array<double, 3> wu{-w[1] - w[2], w[1], w[2]}, wv{-w[4] - w[5], w[4], w[5]};
        auto pair = [&](int i, int j) -> Matrix3d {
          return (wu[i] * wu[j]) * uu + (wv[i] * wv[j]) * vv + (wu[i] * wv[j]) * uv +
                 (wv[i] * wu[j]) * uv.transpose();
        };
        add(s.place[0], pair(0, 1));
        add(s.place[1], pair(0, 2));
        add(s.place[2], pair(1, 2));
      }
    }
    return t.energy(scale, shear);
  }

  double bend(const BendStencil& s) const {
    const Vector3d& middle = at(s.particle[1]);
    Direction in(middle - at(s.particle[0]));
    const Direction out(at(s.particle[2]) - middle);
    if (s.crease >= 0) in.unit = s_.creases[s.crease].turn * in.unit;
    const BendTerm t(s.stiffness, in, out);
    if constexpr (kForce) {
      const Vector3d grad_in = s.crease >= 0 ? Vector3d(s_.creases[s.crease].turn.transpose() * t.grad_in) : t.grad_in;
      push(s.particle[0], grad_in);
      push(s.particle[1], t.grad_out - grad_in);
      push(s.particle[2], -t.grad_out);
      if constexpr (kHessian) {
        // Second difference of the unit directions: weights 1/l_in, -(1/l_in + 1/l_out), 1/l_out.
        const double i = in.inverse_length, o = out.inverse_length, k = t.stiffness;
        add(s.place[0], -k * i * (i + o));
        add(s.place[1], k * i * o);
        add(s.place[2], -k * o * (i + o));
      }
    }
    return t.energy;
  }

  double fit(const FitStencil& s) const {
    if (s.begin == s.end) return 0;
    // Columns: K_11, K_22, K_12. Relative to the first particle, since the weights sum to zero.
    const Vector3d& origin = at(s_.fit_particle[s.begin]);
    Matrix3d curvature = Matrix3d::Zero();
    for (std::size_t j = s.begin + 1; j < s.end; ++j)
      curvature += (at(s_.fit_particle[j]) - origin) * s_.fit_weight[j].transpose();
    FoldedRest rest;
    if (s.fold >= 0) {
      rest = FoldedRest(s_, s_.folds[s.fold], x_);
      curvature -= rest.curvature;
    }
    const Matrix3d moment = curvature * s.rigidity;
    if constexpr (kForce) {
      if (s.fold >= 0) push_frame(s_.folds[s.fold], rest, moment);
      Vector3d sum = Vector3d::Zero();
      for (std::size_t j = s.begin + 1; j < s.end; ++j) {
        const Vector3d f = moment * s_.fit_weight[j];
        push(s_.fit_particle[j], -f);
        sum += f;
      }
      push(s_.fit_particle[s.begin], sum);
    }
    return 0.5 * curvature.cwiseProduct(moment).sum();
  }

  /// What the moment does to the cloth that the fold turns with.
  void push_frame(const Fold& fold, const FoldedRest& rest, const Matrix3d& moment) const {
    Vector3d torque = Vector3d::Zero();
    for (int a = 0; a < 3; ++a) torque += rest.curvature.col(a).cross(moment.col(a));
    const Vector3d turn = rest.stretch * torque;
    for (std::size_t j = fold.begin; j < fold.end; ++j)
      push(s_.fold_frames[j].particle, turn.cross(rest.rotation * s_.fold_frames[j].place));
  }

  double tie(const TieStencil& s) const {
    if (s.n == 0) return 0;
    // Relative to the first particle, since the coefficients sum to zero.
    Vector3d span = Vector3d::Zero();
    for (int k = 1; k < s.n; ++k) span += s.coefficient[k] * (at(s.particle[k]) - at(s.particle[0]));
    const double length = span.norm();
    const TieTerm t(s_.tensile_scale * s.stiffness, length - s.length, s.rod);
    if constexpr (kForce) {
      if (t.force == 0) return 0;
      const Direction along(span);
      Vector3d sum = Vector3d::Zero();
      for (int k = 1; k < s.n; ++k) {
        const Vector3d f = (-t.force * s.coefficient[k]) * along.unit;
        push(s.particle[k], f);
        sum += f;
      }
      push(s.particle[0], -sum);
      if constexpr (kHessian) {
        const Matrix3d h = length_curvature(along.unit, t.slope, std::max(t.force, 0.0) * along.inverse_length);
        int place = 0;
        for (int a = 0; a < s.n; ++a)
          for (int b = a + 1; b < s.n; ++b) add(s.place[place++], (s.coefficient[a] * s.coefficient[b]) * h);
      }
    }
    return t.energy;
  }

  const ElasticStencils& s_;
  const Vector3d* x_;
  Vector3d* force_;
  BlockMatrix* hessian_;
};

/// Runs the pass over all chunks, colour after colour, and adds their energies in the order of the chunks.
template <Wanted kWanted>
double run_chunks(const ElasticStencils& s, const Vector3d* x, Vector3d* force, BlockMatrix* hessian) {
  const ChunkPass<kWanted> pass(s, x, force, hessian);
  std::vector<double> energy(s.chunks.size(), 0.0);
  for (const std::vector<std::size_t>& color : s.colors)
    parallel_for(color.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t c = begin; c < end; ++c) energy[color[c]] = pass.run(s.chunks[color[c]]);
    });
  double sum = 0;
  for (double e : energy) sum += e;
  return sum;
}

/// Every upper block becomes its constant part: twist and fits.
void fill_constant(const ElasticStencils& s, BlockMatrix& hessian) {
  parallel_for(s.n_particles, kParticleGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      for (Index k = s.upper_begin[i]; k < s.pattern->row_begin[i + 1]; ++k) {
        const float c = s.constant[k];
        const std::array<float, 9> block{c, 0, 0, 0, c, 0, 0, 0, c};
        std::copy(block.begin(), block.end(), hessian.raw_block(static_cast<std::size_t>(k)));
      }
  });
}

void turn(Crease& c, const std::vector<Vector3d>& x) {
  const Direction in(x[c.in[1]] - x[c.in[0]]);
  const Vector3d along = x[c.axis[1]] - x[c.axis[0]];
  const Direction axis(along - along.dot(in.unit) * in.unit);
  Matrix3d across;  // axis.unit x
  across << 0, -axis.unit.z(), axis.unit.y(), axis.unit.z(), 0, -axis.unit.x(), -axis.unit.y(), axis.unit.x(), 0;
  c.turn = Matrix3d::Identity() + c.sine * across + (1 - c.cosine) * across * across;
}

void turn(TwistedCell& t, const std::vector<Vector3d>& x) {
  const auto& p = t.particle;
  t.now = t.size * Direction((x[p[2]] - x[p[0]]).cross(x[p[3]] - x[p[1]])).unit;
}

}  // namespace

ElasticModel::ElasticModel(const model::Model& model) : stencils_(std::make_unique<ElasticStencils>(model)) {
  follow(model.start);
}
ElasticModel::~ElasticModel() = default;
ElasticModel::ElasticModel(ElasticModel&&) noexcept = default;
ElasticModel& ElasticModel::operator=(ElasticModel&&) noexcept = default;

std::size_t ElasticModel::n_particles() const { return stencils_->n_particles; }
void ElasticModel::set_tensile_scale(double scale) { stencils_->tensile_scale = scale; }
double ElasticModel::tensile_scale() const { return stencils_->tensile_scale; }
void ElasticModel::follow(const std::vector<Vector3d>& x) {
  for (Crease& c : stencils_->creases) turn(c, x);
  for (TwistedCell& t : stencils_->twisted) turn(t, x);
}
BlockMatrix ElasticModel::make_matrix() const { return BlockMatrix(stencils_->pattern); }

double ElasticModel::energy(const std::vector<Vector3d>& x) const {
  return run_chunks<Wanted::energy>(*stencils_, x.data(), nullptr, nullptr);
}

double ElasticModel::energy_and_force(const std::vector<Vector3d>& x, std::vector<Vector3d>& force) const {
  force.assign(n_particles(), Vector3d::Zero());
  return run_chunks<Wanted::force>(*stencils_, x.data(), force.data(), nullptr);
}

double ElasticModel::energy_force_hessian(const std::vector<Vector3d>& x, std::vector<Vector3d>& force,
                                          BlockMatrix& hessian) const {
  force.assign(n_particles(), Vector3d::Zero());
  hessian.clear_added();
  fill_constant(*stencils_, hessian);
  const double energy = run_chunks<Wanted::hessian>(*stencils_, x.data(), force.data(), &hessian);
  hessian.finish_assembly();
  return energy;
}

}  // namespace garment::simulator
