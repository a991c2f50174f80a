#pragma once
// Where the rigid motions of a Model have come to at a time.
#include <Eigen/Core>

#include "runtime/model/model.hpp"

namespace garment::model {

/// x -> pivot + turn (x - pivot) + move; space to space, m.
struct Placement {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Vector3d shift{0, 0, 0};  ///< x -> turn x + shift

  Vector3d apply(const Vector3d& x) const { return turn * x + shift; }
  Vector3d undo(const Vector3d& x) const { return turn.transpose() * (x - shift); }
  bool is_identity() const { return turn == Eigen::Matrix3d::Identity() && shift == Vector3d::Zero(); }
};

/// Rz Ry Rx; portable sine and cosine, so the same bits everywhere. Angles in rad.
Eigen::Matrix3d rotation(const Vector3d& turn);

/// Where the motion has come to at `time` (s): moves and angles run straight between poses.
Placement placement_at(const Motion& motion, double time);

/// The model with its moving holds where they are at `time`; the rest is a copy.
Model at_time(const Model& model, double time);

/// Moves the points and normals of moving holds to where they are at `time`: from those of the start (`start`) into `moved`,
/// which has the same holds.
void move_holds(const Model& start, double time, Model& moved);

}  // namespace garment::model
