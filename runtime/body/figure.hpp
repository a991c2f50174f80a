#pragma once
// The shape of a parametric person as a field: columns of sections for trunk, legs and arms, ellipsoids for
// breasts, head and feet, joined by smooth unions. Source of the proportions: ANSUR II.
#include <array>
#include <map>
#include <string>
#include <vector>

#include "runtime/body/body.hpp"
#include "runtime/body/pchip.hpp"
#include "runtime/body/slice.hpp"

namespace garment::body {

/// Body measures, m, by the column names of the size tables (ANSUR II names).
struct FigureMeasures {
  bool woman = true;
  double stature = 0, bust_chest = 0, underbust = 0, waist = 0, hip = 0;
  double neckcircumference = 0, neckcircumferencebase = 0, headcircumference = 0;
  double biacromialbreadth = 0, bideltoidbreadth = 0, sleeveoutseam = 0, acromionradialelength = 0;
  double bicepscircumferenceflexed = 0, wristcircumference = 0;
  double thighcircumference = 0, lowerthighcircumference = 0, calfcircumference = 0, anklecircumference = 0;
  double crotchheight = 0, trochanterionheight = 0, waistheightomphalion = 0, kneeheightmidpatella = 0;
  double cervicaleheight = 0, acromialheight = 0, axillaheight = 0, chestheight = 0;
  double chestbreadth = 0, chestdepth = 0, waistbreadth = 0, waistdepth = 0, hipbreadth = 0, buttockdepth = 0;
};

/// A place where a tape lies, and the number that makes its girth come true.
struct Tape {
  enum class Where { trunk, leg, arm } where = Where::trunk;
  std::string level;
  double at = 0;      ///< height y, m; on the arm the way along its axis from the shoulder joint
  double target = 0;  ///< girth, m
  /// Factor on the section's size; at a woman's bust how far the breasts stand out, m.
  double knob = 1;
  bool additive = false;
};

class Figure {
 public:
  explicit Figure(const FigureMeasures& measures);

  std::vector<Tape>& tapes() { return tapes_; }
  const std::vector<Tape>& tapes() const { return tapes_; }
  /// Makes the tables anew; call after knobs were changed.
  void rebuild();

  /// About the distance to the skin, m; negative inside. p.x() >= 0 (the figure is symmetric).
  double field(const Vector3d& p) const;
  /// Girth of the field's own section at a tape: what an infinitely fine mesh would measure.
  double field_girth(const Tape& tape) const;
  /// The plane and centre of the section at a tape (the wearer's left limb).
  Plane tape_plane(const Tape& tape) const;

  Vector3d low() const;
  Vector3d high() const;

 private:
  /// One row of the trunk: half breadth and half depth of a super-ellipse about (0, y, center).
  struct TrunkKnot {
    double y, breadth, depth, center, exponent;
    int tape;  ///< index of the tape that scales it, or -1
  };
  /// A section of a limb: half widths across (x or outward) and along z, and its centre.
  struct LimbKnot {
    double at, across, along, center_across, center_z;
    int tape;
  };
  /// Interpolated limb: an ellipse at every place of its axis.
  struct Limb {
    Pchip across, along, center_across, center_z;
    double low = 0, high = 0;
    double distance(double at, double u, double z) const;
  };
  struct Ellipsoid {
    Vector3d center, radii;
    double distance(const Vector3d& p) const;
  };

  int add_tape(Tape::Where where, const char* level, double at, double target);
  void lay_out_trunk();
  void lay_out_leg();
  void lay_out_arm();
  void lay_out_head_and_foot();
  Limb make_limb(const std::vector<LimbKnot>& knots) const;
  double trunk_distance(const Vector3d& p) const;
  double arm_distance(const Vector3d& p) const;
  double scale_of(int tape) const { return tape >= 0 && !tapes_[tape].additive ? tapes_[tape].knob : 1; }

  FigureMeasures m_;
  double unit_ = 1;  ///< stature against a person of 1.68 m
  std::vector<Tape> tapes_;
  std::vector<TrunkKnot> trunk_knots_;
  std::vector<LimbKnot> leg_knots_, arm_knots_;
  Limb leg_, arm_;
  Vector3d shoulder_, arm_axis_, arm_across_;
  double chest_breadth_ = 0;  ///< half of it, at the bust, without breasts
  int bust_tape_ = -1;
  Ellipsoid breast_, cranium_, jaw_, foot_, heel_;
  // Trunk table: radius by row (height) and column (angle from +z), centre and slope by row.
  double table_low_ = 0, table_high_ = 0;
  std::vector<double> radius_, center_, slope_;
};

}  // namespace garment::body
