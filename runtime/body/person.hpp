#pragma once
// A person measured as a tailor does: girths at levels, lengths from point to point, each with the course of
// its tape.
#include <optional>
#include <string>
#include <vector>

#include "runtime/body/anatomy.hpp"

namespace garment::body {

/// One measure. The names are those of the language: `form.waist.girth`, `form.waist.height`,
/// `form.sleeve_length`.
struct PersonMeasure {
  enum class Kind { level, length };
  std::string name;
  Kind kind = Kind::level;
  std::optional<double> height;  ///< m above the soles: of a level; of a length none
  double size = 0;               ///< girth of a level, or the length, m
  std::vector<Vector3d> course;  ///< where the tape lies; that of a level is closed
};

/// Levels from the head to the ankle, then the limbs' girths, then lengths. What the body lacks (arms, head)
/// is left out.
///
/// Girths are those of convex hulls, as a tape bridges hollows. Limbs are measured on the wearer's left where
/// it is there. Lengths: `stature`; `back_length` from the nape down the back to the waist;
/// `shoulder_breadth` across the shoulder points (the top of the skin over the head of the arm bone);
/// `shoulder_length` from the side of the neck to the shoulder point; `sleeve_length` from the shoulder point
/// over the elbow to the wrist; `upper_arm_length` its part down to the elbow; `bust_breadth`,
/// `waist_breadth`, `hip_breadth` and `..._depth` of the sections; `crotch_height` is the inseam.
std::vector<PersonMeasure> measure_person(const TriangleMesh& mesh, const Landmarks& marks, bool head = true);

}  // namespace garment::body
