#pragma once
// The const particle Model: struct of arrays, SI units, made by the modeller and never changed by the simulator.
// It carries no knowledge of the declared garment beyond names and origin ids.
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "runtime/base/origin.hpp"

namespace garment::model {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Index = std::int32_t;
template <int N>
using Indices = std::array<Index, N>;

/// Tensile law N(strain) in N/m, tabulated as a monotone cubic (Hermite) on knots; linear outside the first and last knot.
struct TensileLaw {
  std::vector<double> strain;   ///< ascending; 0 is a knot
  std::vector<double> force;    ///< N/m, ascending, 0 at strain 0
  std::vector<double> slope;    ///< dN/dstrain at the knots, > 0
};

struct PanelRange {
  std::string name;
  OriginId origin;
  Index first_vertex = 0, n_vertices = 0;
  Index first_triangle = 0, n_triangles = 0;
  double area = 0;              ///< exact area of the outline (darts cut away), m^2
  double mass = 0;              ///< kg
  std::array<double, 3> color{0.5, 0.5, 0.5};
};

/// Pairs of particles that a seam brings together. Merged seams have none (their gap is zero by construction) but keep
/// the chain of particles, for reports.
struct SeamChain {
  std::string name;
  OriginId origin;
  std::vector<Index> particles; ///< along the seam
  double length = 0;            ///< sewn length of the first side, m
};

/// What a button, hook, snap or tack brings into the model, for reports.
struct Closure {
  std::string name;
  OriginId origin;
  double mass = 0;              ///< kg, of the button itself; the particles of its place carry it
};

/// What the cloth of a region comes to on one panel: means over its area of what all its regions, layers and irons make of the
/// panel's fabric together. For reports; directions are 0 warp, 1 weft.
struct RegionValues {
  std::string name, panel;
  OriginId origin;
  double area = 0;                       ///< m^2
  double areal_density = 0;              ///< kg/m^2
  double thickness = 0;                  ///< m
  double friction = 0;                   ///< Coulomb, on bodies
  std::array<double, 2> tensile{};       ///< dN/dstrain at rest, N/m
  double shear = 0;                      ///< G, N/m per rad
  std::array<double, 2> bending{};       ///< B, N m
  double twist = 0;                      ///< Ct, N m
  std::array<double, 2> rest_length{};   ///< over the length as cut
};

/// By how much a tie may be too long before its pull no longer grows, m: closures may start far apart, and are brought
/// together without tearing at the cloth.
inline constexpr double kTieReach = 5e-3;

/// The same of a rod, m: stiffer than any button, it would else drag its ends through the cloth.
inline constexpr double kRodReach = 0.5e-3;

/// Stiffness of the sliders of tension before they slip, over the largest slope of their law: known where their yield is fitted
/// to the resilience, and where they act.
inline constexpr double kTensilePreSlip = 8;

enum class HoldKind : std::uint8_t {
  point,   ///< stays at `hold_point`
  plane,   ///< stays in the plane through `hold_point` with normal `hold_normal` (sliding along a level)
};

/// Kelvin time tau of cloth whose fabric states none, s.
inline constexpr double kUsualDamping = 0.02;

/// A rigid pose at a time: turned by Rz Ry Rx about the motion's pivot, then moved.
struct Pose {
  double time = 0;              ///< s
  Vector3d move{0, 0, 0};       ///< m
  Vector3d turn{0, 0, 0};       ///< rad
};

/// A rigid motion in time: between its poses moves and turns run straight, before the first and after the last it stands.
struct Motion {
  std::string name;
  OriginId origin;
  Index body = -1;              ///< index into the bodies; -1: of holds (`moved_by`)
  Vector3d pivot{0, 0, 0};      ///< m
  std::vector<Pose> poses;      ///< at least one, times ascend
};

/// The particles that a pin or clamp holds: for its reaction. Edges attached to a level have none.
struct Holder {
  std::string name;
  OriginId origin;
  std::vector<Index> particles; ///< ascending
};

/// The air about the cloth; without wind and without drag there is none.
struct Air {
  Vector3d wind{0, 0, 0};       ///< m/s
  double gust = 0;              ///< by what share it gets stronger at most
  double drag = 0;              ///< coefficient of a sheet square to the flow
  bool still() const { return drag == 0; }
};

/// How the arrays speak of one another:
///   particle   a mass point of the simulation; seams merge particles of several panels
///   vertex     a particle as one panel sees it, with its place in the flat pattern (uv)
struct Model {
  // --- particles [n]
  std::vector<double> mass;                      ///< kg
  std::vector<Vector3d> start;                   ///< initial positions, m
  std::vector<double> thickness;                 ///< of the cloth at the particle, m (largest of the panels it joins)
  std::vector<double> friction;                  ///< Coulomb, cloth on body
  // --- vertices [m]
  std::vector<Index> vertex_particle;
  std::vector<Index> vertex_panel;
  std::vector<Vector2d> vertex_uv;               ///< (weft, warp) coordinates rotated back: panel coordinates x, y, m
  // --- triangles: the one triangulation for collision, certificate and written meshes
  std::vector<Indices<3>> triangle;              ///< vertex ids, counter-clockwise seen on the cloth's face
  std::vector<Index> triangle_panel;
  // --- full cells: springs, trellis, twist
  //        3---2      h2 along warp        spring i-j: force = width * N(l/l0 - 1)
  //        |   |                           trellis: per corner quarter cell, energy G phi^2/2
  //        0---1      h1 along weft        twist: E = 2 Ct kappa_12^2 A_t
  std::vector<Indices<2>> spring;                ///< particle ids
  std::vector<double> spring_rest;               ///< l0, m
  std::vector<double> spring_width;              ///< tributary width p, m
  std::vector<Index> spring_law;                 ///< index into laws
  std::vector<Index> spring_panel;
  std::vector<Indices<4>> cell;                  ///< particle ids 0..3 as drawn above
  std::vector<Vector2d> cell_size;               ///< (h1, h2), m
  std::vector<double> cell_shear;                ///< G, N/m per rad
  std::vector<double> cell_twist;                ///< Ct times (area whose twist is read here / area of the cell), N m
  // --- cut cells: E = A [Psi1(|U|-1) + Psi2(|V|-1) + G phi^2/2], U = dx/d(warp), V = dx/d(weft)
  std::vector<Indices<3>> membrane;              ///< particle ids
  std::vector<std::array<double, 6>> membrane_weights;  ///< U = sum w[k] x_k, V = sum w[3+k] x_k, 1/m
  std::vector<double> membrane_area;             ///< m^2
  std::vector<Indices<2>> membrane_law;          ///< warp law, weft law
  std::vector<double> membrane_shear;            ///< G
  std::vector<Index> membrane_panel;
  // --- bending along grid lines: E = p hbar/2 B (theta/hbar)^2, theta the turn, hbar = (h- + h+)/2
  std::vector<Indices<3>> bend;                  ///< particle ids (before, at, after)
  std::vector<Vector2d> bend_lengths;            ///< (h-, h+), m
  std::vector<double> bend_width;                ///< p, m
  std::vector<double> bend_rigidity;             ///< B, N m
  // --- bending where no grid stencil fits (borders, across seams and darts): least-squares quadratic in a developed
  //     chart. K_a = sum_j w_ja x_j is the curvature vector (a = 11, 22, 12); E = A/2 sum_ab D_ab K_a . K_b
  std::vector<Index> fit_begin;                  ///< CSR [n_fits + 1]
  std::vector<Index> fit_particle;               ///< particle ids
  std::vector<Vector3d> fit_weight;              ///< (w_11, w_22, w_12), 1/m^2; or three residuals of the fit
  std::vector<double> fit_area;                  ///< m^2
  std::vector<std::array<double, 6>> fit_rigidity;  ///< D: 11, 22, 12-12, 11-22, 11-12, 22-12, N m
  // --- holds
  std::vector<Index> hold_particle;
  std::vector<HoldKind> hold_kind;
  std::vector<Vector3d> hold_point;
  std::vector<Vector3d> hold_normal;
  // --- ties: threads between two places of the cloth. A place is a point of a triangle, three particles with weights
  //     that sum to 1; a place at a particle repeats it. With x = sum w[k] x_k, y = sum w[3+k] x_(3+k) and the gap
  //     g = |x - y| - length: E = k g^2 / 2 for 0 < g < kTieReach, beyond it the pull k kTieReach stays; slack, E = 0
  std::vector<Indices<6>> tie;                   ///< particle ids: of the one place, of the other
  std::vector<std::array<double, 6>> tie_weights;
  std::vector<double> tie_length;                ///< L, m
  std::vector<double> tie_stiffness;             ///< k, N/m
  std::vector<Index> tie_closure;                ///< index into closures
  // --- creases: bending stencils that are folded at rest, because the iron left them so. The direction from `before` to `at`
  //     is turned by `crease_angle` about the direction from the first to the second particle of `crease_axis`, and only
  //     then compared with the direction from `at` to `after`; axes are such that a positive angle folds to the back
  std::vector<Index> crease_bend;                ///< index into bend, ascending
  std::vector<double> crease_angle;              ///< rad
  std::vector<Indices<2>> crease_axis;           ///< particle ids
  // --- folds: fitted stencils that are not flat at rest, because a seam, a pleat or the iron folded the cloth there. The
  //     curvatures at rest are those of the stencil's particles at `fold_place`, which turn with the cloth on this side of the
  //     fold: by the rotation that carries the places with z = 0 best (least squares) to where their particles are
  std::vector<Index> fold_fit;                   ///< index into fits, ascending
  std::vector<Index> fold_begin;                 ///< CSR [n_folds + 1]
  std::vector<Vector3d> fold_place;              ///< m, in the order of the fit's particles, any axes
  // --- twists: cells that are twisted at rest: kappa_12 has this part along the cell's normal
  std::vector<Index> twist_cell;                 ///< index into cells, ascending
  std::vector<double> twist_rest;                ///< 1/m
  // --- padding: what lies between the cloth and the bodies under it
  std::vector<Index> pad_particle;               ///< ascending
  std::vector<double> pad_thickness;             ///< m
  // --- rods: ties that push as well where their places come nearer than the length, E = k g^2 / 2 for |g| < kRodReach
  std::vector<Index> rod_tie;                    ///< index into ties, ascending
  // --- loads: constant forces in space
  std::vector<Index> load_particle;
  std::vector<Vector3d> load_force;              ///< N
  // --- pressure from the back of triangles: a force p A n, with the area and the normal that the triangle has as it lies
  std::vector<Index> pressed_triangle;           ///< ascending
  std::vector<double> pressed_pascals;           ///< Pa; negative from the face
  // --- friction of a particle with one of the bodies, in place of the geometric mean of cloth and body
  std::vector<Index> rub_particle;
  std::vector<Index> rub_body;                   ///< index into the bodies that are given with the model
  std::vector<double> rub_factor;
  // --- friction of cloth with cloth, stated for pairs of panels
  std::vector<Indices<2>> rub_panels;            ///< panel ids, the lower first
  std::vector<double> rub_panels_factor;
  // --- Kelvin time of the cloth at each particle; none where it is kUsualDamping everywhere. An element has the mean of its own
  std::vector<double> damping;                   ///< tau, s [n_particles] or empty
  // --- friction inside the cloth, beside the elastic laws (simulator/inner_friction); all empty where nothing asks for it.
  std::vector<double> law_slip;                  ///< share f of the tension N that is friction, 0 .. 0.5 [n_laws] or empty
  std::vector<Vector2d> cell_slip;               ///< (HG, HG5): half the loop at 0.5 and 5 degrees, N/m [n_cells] or empty
  std::vector<Vector2d> membrane_slip;           ///< the same [n_membranes] or empty
  std::vector<double> bend_slip;                 ///< HB, N [n_bends] or empty
  //     of fitted stencils: the curvature K . way along one line of the chart, way = (c^2, s^2, 2 c s) of (K_11, K_22, K_12)
  std::vector<Index> fit_slip;                   ///< index into fits, ascending
  std::vector<Index> fit_slip_particle;          ///< at whose normal
  std::vector<Vector3d> fit_slip_way;
  std::vector<double> fit_slip_moment;           ///< HB times the area, N m^2
  std::vector<double> fit_slip_rigidity;         ///< B along the line times the area, N m^3
  // --- holds that move: their place is that of the motion at the time, `hold_point` that of the start
  std::vector<Index> moved_hold;                 ///< index into holds, ascending
  std::vector<Index> moved_by;                   ///< index into motions
  // --- tables
  std::vector<TensileLaw> laws;
  std::vector<PanelRange> panels;
  std::vector<SeamChain> seams;
  std::vector<Closure> closures;
  std::vector<RegionValues> regions;
  std::vector<Motion> motions;
  std::vector<Holder> holders;
  Air air;
  Vector3d gravity{0, -9.80665, 0};

  std::size_t n_particles() const { return mass.size(); }
  std::size_t n_vertices() const { return vertex_particle.size(); }
  std::size_t n_triangles() const { return triangle.size(); }
  /// From one place of tie t to the other, with the particles at `x`, m.
  Vector3d tie_span(std::size_t t, const std::vector<Vector3d>& x) const {
    Vector3d span = Vector3d::Zero();
    for (int k = 0; k < 3; ++k) span += tie_weights[t][3 + k] * x[tie[t][3 + k]] - tie_weights[t][k] * x[tie[t][k]];
    return span;
  }
  /// Particle ids of triangle t.
  Indices<3> corners(std::size_t t) const {
    return {vertex_particle[triangle[t][0]], vertex_particle[triangle[t][1]], vertex_particle[triangle[t][2]]};
  }
};

/// What changes while the garment drapes.
struct State {
  std::vector<Vector3d> position;                ///< m [n_particles]
  std::vector<Vector3d> velocity;                ///< m/s [n_particles]
  double time = 0;                               ///< s
  std::vector<double> slip{};                    ///< anchors of the sliders inside the cloth; empty: none has slipped yet
};

}  // namespace garment::model
