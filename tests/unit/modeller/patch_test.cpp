// Patch tests: uniform strain leaves no net force inside, uniform curvature has its exact energy, on any
// outline.
#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "runtime/modeller/modeller.hpp"
#include "runtime/modeller/tensile_law.hpp"
#include "tests/unit/modeller/built.hpp"
#include "tests/unit/modeller/garments.hpp"

using namespace garment;
using test::build;
using Eigen::Vector3d;

namespace {

design::Fabric linear_cloth() {
  design::Fabric f = test::cloth();
  f.tensile[0] = {0.05, 1.0, 100, 0.6};
  f.tensile[1] = {0.05, 1.0, 60, 0.6};
  f.shear_rigidity = 35;
  return f;
}

/// Force of the shear energy area * G phi^2 / 2, phi = asin(a^ . b^), as derivatives by a and b.
void shear(const Vector3d& a, const Vector3d& b, double stiffness, Vector3d& by_a, Vector3d& by_b) {
  Vector3d u = a.normalized(), v = b.normalized();
  double s = u.dot(v), scale = stiffness * std::asin(s) / std::sqrt(1 - s * s);
  by_a = scale * (v - s * u) / a.norm();
  by_b = scale * (u - s * v) / b.norm();
}

/// Membrane forces, springs and trellis included: -dE/dx.
std::vector<Vector3d> stretch_forces(const model::Model& m, const std::vector<Vector3d>& x) {
  std::vector<Vector3d> force(m.n_particles(), Vector3d::Zero());
  for (std::size_t s = 0; s < m.spring.size(); ++s) {
    auto [i, j] = m.spring[s];
    Vector3d d = x[j] - x[i];
    double pull =
        m.spring_width[s] * modeller::tensile_force(m.laws[m.spring_law[s]], d.norm() / m.spring_rest[s] - 1);
    force[i] += pull * d.normalized();
    force[j] -= pull * d.normalized();
  }
  for (std::size_t c = 0; c < m.cell.size(); ++c) {
    double quarter = m.cell_size[c].x() * m.cell_size[c].y() / 4 * m.cell_shear[c];
    for (int k = 0; k < 4; ++k) {
      // corner k: along weft lies k ^ 1, along warp 3 - k
      int at = m.cell[c][k], weft = m.cell[c][k ^ 1], q = m.cell[c][3 - k];
      Vector3d by_a, by_b, a = x[weft] - x[at], b = x[q] - x[at];
      double sense = k % 2 == 0 ? 1 : -1;  // against each other at corners 1 and 3
      shear(sense * a, b, quarter, by_a, by_b);
      by_a *= sense;
      force[weft] -= by_a;
      force[q] -= by_b;
      force[at] += by_a + by_b;
    }
  }
  for (std::size_t t = 0; t < m.membrane.size(); ++t) {
    const auto& w = m.membrane_weights[t];
    Vector3d u = Vector3d::Zero(), v = Vector3d::Zero(), by_u, by_v;
    for (int k = 0; k < 3; ++k) {
      u += w[k] * x[m.membrane[t][k]];
      v += w[3 + k] * x[m.membrane[t][k]];
    }
    shear(u, v, m.membrane_shear[t], by_u, by_v);
    by_u += modeller::tensile_force(m.laws[m.membrane_law[t][0]], u.norm() - 1) * u.normalized();
    by_v += modeller::tensile_force(m.laws[m.membrane_law[t][1]], v.norm() - 1) * v.normalized();
    for (int k = 0; k < 3; ++k)
      force[m.membrane[t][k]] -= m.membrane_area[t] * (w[k] * by_u + w[3 + k] * by_v);
  }
  return force;
}

std::vector<Eigen::Vector2d> flat_of(const model::Model& m) {
  std::vector<Eigen::Vector2d> at(m.n_particles());
  for (std::size_t v = 0; v < m.n_vertices(); ++v) at[m.vertex_particle[v]] = m.vertex_uv[v];
  return at;
}

/// Particles on the rim of the sewn sheet: ends of sides that one triangle has alone.
std::vector<char> rim(const model::Model& m) {
  std::map<std::array<int, 2>, int> sides;
  for (std::size_t t = 0; t < m.n_triangles(); ++t) {
    auto c = m.corners(t);
    for (int k = 0; k < 3; ++k) ++sides[{std::min(c[k], c[(k + 1) % 3]), std::max(c[k], c[(k + 1) % 3])}];
  }
  std::vector<char> result(m.n_particles(), 0);
  for (const auto& [s, n] : sides)
    if (n == 1) result[s[0]] = result[s[1]] = 1;
  return result;
}

double worst_force_inside(const model::Model& m) {
  Eigen::Matrix<double, 3, 2> deform;
  deform << 1.03, 0.04, -0.01, 1.02, 0.2, 0.1;
  std::vector<Vector3d> x;
  for (const Eigen::Vector2d& p : flat_of(m)) x.push_back(deform * p);
  std::vector<Vector3d> force = stretch_forces(m, x);
  std::vector<char> on_rim = rim(m);
  double worst = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (!on_rim[i]) worst = std::max(worst, force[i].norm());
  return worst / (2000 * 0.05 * 0.01);  // against K * strain * h
}

/// Energy of all bending and twist stencils.
double bending_energy(const model::Model& m, const std::vector<Vector3d>& x) {
  double energy = 0;
  for (std::size_t b = 0; b < m.bend.size(); ++b) {
    auto [i, j, l] = m.bend[b];
    Vector3d before = x[j] - x[i], after = x[l] - x[j];
    double psi = 2 * before.cross(after).norm() / (before.norm() * after.norm() + before.dot(after));
    double hbar = (m.bend_lengths[b].x() + m.bend_lengths[b].y()) / 2;
    energy += m.bend_width[b] * hbar / 2 * m.bend_rigidity[b] * psi * psi / (hbar * hbar);
  }
  for (std::size_t c = 0; c < m.cell.size(); ++c) {
    double area = m.cell_size[c].x() * m.cell_size[c].y();
    double kappa = (x[m.cell[c][2]] - x[m.cell[c][1]] - x[m.cell[c][3]] + x[m.cell[c][0]]).norm() / area;
    energy += 2 * m.cell_twist[c] * kappa * kappa * area;
  }
  for (std::size_t f = 0; f < m.fit_area.size(); ++f) {
    Eigen::Matrix3d curvature = Eigen::Matrix3d::Zero();  // columns 11, 22, 12
    for (int j = m.fit_begin[f]; j < m.fit_begin[f + 1]; ++j)
      curvature += x[m.fit_particle[j]] * m.fit_weight[j].transpose();
    const auto& d = m.fit_rigidity[f];
    Eigen::Matrix3d plate;
    plate << d[0], d[3], d[4], d[3], d[1], d[5], d[4], d[5], d[2];
    energy += m.fit_area[f] / 2 * (curvature.transpose() * curvature).cwiseProduct(plate).sum();
  }
  return energy;
}

/// The same over positions z(x, y) = k . (x^2/2, y^2/2, x y) of the flat sheet.
double curvature_energy(const model::Model& m, const Vector3d& k) {
  std::vector<Vector3d> x;
  for (const Eigen::Vector2d& p : flat_of(m))
    x.emplace_back(p.x(), p.y(), k[0] * p.x() * p.x() / 2 + k[1] * p.y() * p.y() / 2 + k[2] * p.x() * p.y());
  return bending_energy(m, x);
}

void check_curvature(const model::Model& m, double area, double grain) {
  design::Fabric f = test::cloth();
  double c = std::cos(grain), s = std::sin(grain);
  for (int mode = 0; mode < 4; ++mode) {
    Vector3d k = mode == 3 ? Vector3d(0.7, -0.4, 0.5) : Vector3d(Vector3d::Unit(mode));
    k *= 1e-5;
    // curvature along warp (-s, c), weft (c, s), and twist between them
    double warp = s * s * k[0] + c * c * k[1] - 2 * s * c * k[2],
           weft = c * c * k[0] + s * s * k[1] + 2 * s * c * k[2];
    double twist = -s * c * k[0] + s * c * k[1] + (c * c - s * s) * k[2];
    double exact = area / 2 *
                   (f.bending_rigidity[0] * warp * warp + f.bending_rigidity[1] * weft * weft +
                    4 * f.twist_rigidity * twist * twist);
    INFO("mode " << mode);
    CHECK(curvature_energy(m, k) == Approx(exact).epsilon(1e-9));
  }
}

/// Two panels that tile a plane region: the right one begins where the left one ends, along a slanted line.
design::Garment two_sewn(double h, double h_right) {
  design::Garment g;
  g.fabrics = {linear_cloth()};
  design::Panel a = test::rectangle("a", 0.2, 0.3, h), b = test::rectangle("b", 0.25, 0.3, h_right, {0.2, 0});
  test::Point2 low(0.17, 0), high(0.26, 0.3);
  a.edges = {test::edge("bottom", {0, 0}, low), test::edge("joint", low, high),
             test::edge("top", high, {0, 0.3}), test::edge("left", {0, 0.3}, {0, 0})};
  b.edges = {test::edge("bottom", low, {0.45, 0.03}), test::edge("right", {0.45, 0.03}, {0.45, 0.3}),
             test::edge("top", {0.45, 0.3}, high), test::edge("joint", high, low)};
  g.panels = {a, b};
  g.seams = {test::seam("joint", {test::whole(g, 0, 1)}, {test::whole(g, 1, 3, true)})};
  return g;
}

}  // namespace

TEST_CASE("uniform strain leaves no net force on particles inside") {
  design::Garment g = test::single(test::rectangle("sheet", 0.2, 0.31, 0.012));
  g.fabrics[0] = linear_cloth();
  CHECK(worst_force_inside(build(g)) < 1e-9);
  for (int seed = 1; seed <= 12; ++seed) {
    INFO("blob " << seed);
    g = test::single(test::blob(seed, 0.02));
    g.fabrics[0] = linear_cloth();
    CHECK(worst_force_inside(build(g)) < 1e-9);
  }
  CHECK(worst_force_inside(build(two_sewn(0.013, 0.013))) < 1e-9);
  CHECK(worst_force_inside(build(two_sewn(0.02, 0.011))) < 1e-9);
}

TEST_CASE("uniform curvature and twist have their exact energy") {
  for (double h : {0.011, 0.02, 0.05}) {
    INFO("h " << h);
    check_curvature(build(test::single(test::rectangle("sheet", 0.2, 0.31, h))), 0.2 * 0.31, 0);
  }
  for (int seed = 1; seed <= 12; ++seed) {
    INFO("blob " << seed);
    design::Panel blob = test::blob(seed, 0.018);
    model::Model m = build(test::single(blob));
    check_curvature(m, m.panels[0].area, blob.grain_angle);
  }
}

TEST_CASE("curvature is exact across a seam at an angle to the grid") {
  for (double h : {0.01, 0.02}) {
    for (double other : {0.01, 0.017}) {
      model::Model m = build(two_sewn(h, other));
      check_curvature(m, m.panels[0].area + m.panels[1].area, 0);
    }
  }
}

TEST_CASE("a seam resists what the mean curvature does not see: going to and fro, and a sharp fold") {
  const double h = 0.01, B = std::min(test::cloth().bending_rigidity[0], test::cloth().bending_rigidity[1]);
  model::Model m = build(two_sewn(h, h));
  const std::vector<Eigen::Vector2d> flat = flat_of(m);
  REQUIRE(m.seams.size() == 1);
  const std::vector<model::Index>& chain = m.seams[0].particles;
  const double length = (flat[chain.back()] - flat[chain.front()]).norm(), spacing = length / static_cast<double>(chain.size() - 1);
  std::vector<Vector3d> zigzag, crease;
  const Eigen::Vector2d low(0.17, 0), along = Eigen::Vector2d(0.09, 0.3).normalized(), across(along.y(), -along.x());
  const double slope = 1e-3, step = 1e-5;
  for (const Eigen::Vector2d& p : flat) {
    zigzag.emplace_back(p.x(), p.y(), 0);
    crease.emplace_back(p.x(), p.y(), slope * std::abs(across.dot(p - low)));
  }
  for (std::size_t k = 0; k < chain.size(); ++k) zigzag[chain[k]].z() = k % 2 ? step : -step;
  // As much as a line of the grid that goes to and fro: kappa = 4 step / spacing^2 over the seam's own strip.
  const double to_and_fro = 4 * step / (spacing * spacing);
  CHECK(bending_energy(m, zigzag) > B / 2 * to_and_fro * to_and_fro * length * h);
  // And as a hinge of that strip: kappa = 2 slope / h.
  CHECK(bending_energy(m, crease) > 0.9 * B / 2 * 4 * slope * slope / (h * h) * length * h);
}
