#pragma once
// What acts on the cloth beside its own weight and the bodies: what holds it, pushes it, blows on it, and how it is
// simulated. Plain values; which of them the simulator can do is for runtime/modeller/unmodelled.cpp to say.
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "runtime/design/edge_part.hpp"

namespace garment::design {

/// A rigid motion at a time: turned by Rz Ry Rx about the body's own position (a clamp: about the middle of what it
/// holds), then moved.
struct Pose {
  double time = 0;                                ///< s
  Eigen::Vector3d move = Eigen::Vector3d::Zero();  ///< m
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();  ///< rad
};
/// A motion in time: between its poses moves and turns run straight, after the last one it stands still.
struct Path {
  std::string name;
  OriginId origin;
  int body = -1;            ///< index into Garment::bodies; -1: a clamp's
  std::vector<Pose> poses;  ///< times ascend, the first is at 0 s
};

/// Cloth held as if between jaws: the edges, or all of the region.
struct Clamp {
  std::string name;
  OriginId origin;
  int region = -1;              ///< index into Garment::regions
  std::vector<EdgePart> parts;  ///< where there is no region
  int path = -1;                ///< index into Scene::paths
  bool released = false;        ///< holds nothing any more; the grid still goes along its line
};

/// A constant force on a point of a panel, in space.
struct Force {
  std::string name;
  OriginId origin;
  int panel = -1;
  Point2 point{0, 0};
  Eigen::Vector3d newtons = Eigen::Vector3d::Zero();
};

/// A pressure on a panel from its back: positive pushes the face outwards.
struct Pressure {
  std::string name;
  OriginId origin;
  int panel = -1;
  double pascals = 0;
};

struct PanelPoint {
  int panel = -1;
  Point2 point{0, 0};
};

/// A bilateral constraint.
struct Constraint {
  enum class Kind { distance, on_line, on_plane, equal } kind = Kind::distance;
  OriginId origin;
  PanelPoint a, b;   ///< b only for distance and equal
  double length = 0;  ///< m, of distance
  Eigen::Vector3d through = Eigen::Vector3d::Zero(), along = Eigen::Vector3d::UnitY();  ///< line, or plane with normal
};

/// Coulomb friction of a pair, in place of the pair's own: a fabric with a body, or two fabrics.
struct FrictionPair {
  OriginId origin;
  int fabric = -1, body = -1, other_fabric = -1;
  double factor = 0.3;
};

struct Wind {
  OriginId origin;
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< m/s
  double gust = 0;  ///< how much stronger it gets, as a share
};

/// The method that moves the particles.
struct SolverChoice {
  OriginId origin;
  enum class Method { quasi_static, dynamic_constraints, implicit, semi_implicit, explicit_steps } method = Method::quasi_static;
  double step = 0;  ///< s; 0: chosen by the solver
  std::optional<bool> hysteresis;  ///< friction inside the cloth; unstated: `quasi_static` has it
  bool symmetric = true;           ///< a garment on a person that is its own mirror image comes to rest so
  bool slides() const { return hysteresis.value_or(method == Method::quasi_static); }
};

struct Scene {
  std::vector<Path> paths;
  std::vector<Clamp> clamps;
  std::vector<Force> forces;
  std::vector<Pressure> pressures;
  std::vector<Constraint> constraints;
  std::vector<FrictionPair> frictions;
  std::optional<Wind> wind;
  std::optional<double> drag;  ///< coefficient of air drag
  OriginId drag_origin;
  std::optional<SolverChoice> solver;
  /// The cloth's own friction acts: drapes to rest have it where it is stated, drapes for a time also with `quasi_static`.
  bool slides() const { return solver && solver->slides(); }
  bool slides_to_rest() const { return solver && solver->hysteresis.value_or(false); }
  bool symmetric() const { return !solver || solver->symmetric; }
};

}  // namespace garment::design
