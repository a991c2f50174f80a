#include "runtime/model/motion.hpp"

#include <algorithm>

#include "runtime/base/portable_math.hpp"

namespace garment::model {
namespace {

Eigen::Matrix3d about(int axis, double angle) {
  const double c = portable::cos(angle), s = portable::sin(angle);
  const int a = (axis + 1) % 3, b = (axis + 2) % 3;
  Eigen::Matrix3d r = Eigen::Matrix3d::Identity();
  r(a, a) = r(b, b) = c;
  r(b, a) = s;
  r(a, b) = -s;
  return r;
}

Pose pose_at(const Motion& motion, double time) {
  const std::vector<Pose>& poses = motion.poses;
  const auto after = std::find_if(poses.begin(), poses.end(), [&](const Pose& p) { return p.time > time; });
  if (after == poses.begin()) return poses.front();
  if (after == poses.end()) return poses.back();
  const Pose &a = *(after - 1), &b = *after;
  const double share = (time - a.time) / (b.time - a.time);
  return {time, a.move + share * (b.move - a.move), a.turn + share * (b.turn - a.turn)};
}

}  // namespace

Eigen::Matrix3d rotation(const Vector3d& turn) { return about(2, turn.z()) * about(1, turn.y()) * about(0, turn.x()); }

Placement placement_at(const Motion& motion, double time) {
  const Pose pose = pose_at(motion, time);
  Placement p;
  if (pose.turn != Vector3d::Zero()) p.turn = rotation(pose.turn);
  p.shift = motion.pivot - p.turn * motion.pivot + pose.move;
  return p;
}

void move_holds(const Model& start, double time, Model& moved) {
  std::vector<Placement> placements;
  for (const Motion& m : start.motions) placements.push_back(placement_at(m, time));
  for (std::size_t k = 0; k < start.moved_hold.size(); ++k) {
    const auto h = static_cast<std::size_t>(start.moved_hold[k]);
    const Placement& p = placements[static_cast<std::size_t>(start.moved_by[k])];
    moved.hold_point[h] = p.apply(start.hold_point[h]);
    moved.hold_normal[h] = p.turn * start.hold_normal[h];
  }
}

Model at_time(const Model& model, double time) {
  Model moved = model;
  move_holds(model, time, moved);
  return moved;
}

}  // namespace garment::model
