#pragma once
// Levels and parts of an upright person, found on the mesh by slicing: feet down, face to +z, arms away from
// the body (A- or T-pose), any origin. The wearer's left is +x.
#include <limits>
#include <optional>

#include "runtime/body/body.hpp"
#include "runtime/body/slice.hpp"

namespace garment::body {

/// The lowest and the highest y of a mesh, m.
struct Heights {
  double low = std::numeric_limits<double>::infinity(), high = -low;
};
Heights heights_of(const TriangleMesh& mesh);

/// The places that everything else on a person is measured from, m.
struct Landmarks {
  double base = 0;      ///< y of the soles
  double stature = 0;   ///< height of the whole person
  double top = 0;       ///< y of the highest point
  double center_x = 0;  ///< of the plane of symmetry
  double crotch = 0;    ///< y where the legs part
  double armpit = 0;    ///< y where the arms part from the torso
  double reach = 0;     ///< half the breadth of the torso under the armpits
  double height(double fraction) const { return base + fraction * stature; }
};

/// What a mesh lacks that an upright person has, in the order in which it is looked for.
enum class Lacking { nothing, stature, legs, crotch, torso };

/// Nothing where the mesh is no upright person: a size beyond 0.7 to 2.6 m, no two legs, no crotch, no torso; `lacking`
/// receives which. `stature` (m) is given for a body without a head, whose own height is not the person's.
std::optional<Landmarks> find_landmarks(const TriangleMesh& mesh, std::optional<double> stature = std::nullopt,
                                        Lacking* lacking = nullptr);

/// Hull of the torso (neck, head) at height y in the plane `horizontal(y)`, without arms; empty if there is
/// none.
Loop torso_hull(const TriangleMesh& mesh, const Landmarks& marks, double y);
/// Hull of one leg; `side` +1 is the wearer's left.
Loop leg_hull(const TriangleMesh& mesh, const Landmarks& marks, double y, int side);

/// Heights from the stature fractions of ANSUR II, moved to the smallest or largest girth nearby. Arms give
/// "biceps" and "wrist" when `parts` holds them.
std::map<std::string, Level> find_levels(const TriangleMesh& mesh, const Landmarks& marks,
                                         const std::map<std::string, Part>& parts);
/// Part "torso" (crotch to neck, every 2 cm), "neck", "head", legs (crotch to ankle), arms (shoulder to
/// wrist).
std::map<std::string, Part> find_parts(const TriangleMesh& mesh, const Landmarks& marks);

/// Sections square to an arm, from the shoulder to the wrist; none if no arm is found. `wrist` receives the
/// index of the wrist's section, `biceps` of the thickest of the upper arm.
std::vector<Section> trace_arm(const TriangleMesh& mesh, const Landmarks& marks, int side,
                               std::size_t* biceps, std::size_t* wrist);

/// Section of `mesh` in `plane` as a convex hull of `loop` about its own centroid.
Section make_section(const Plane& plane, const Loop& loop);

}  // namespace garment::body
