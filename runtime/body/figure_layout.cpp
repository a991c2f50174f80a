// Where the sections of a figure lie and how large they are before the tapes are solved. Heights and breadths
// come from the measures; what ANSUR II does not measure (the S of the back, the stance, hands and feet) is
// drawn here by hand.
#include <cmath>

#include "runtime/base/portable_math.hpp"
#include "runtime/body/figure.hpp"

namespace garment::body {
namespace {

using portable::kPi;

constexpr double kThighGap = 0.012;    // m, from the plane of symmetry to a thigh, at a stature of 1.68 m
constexpr double kStance = 0.045;      // tangent of the angle by which a leg stands out
constexpr double kArmAngle = 40;       // degrees from the vertical
constexpr double kShoulderSlope = 21;  // degrees

struct HalfAxes {
  double across, along;
};

/// Half axes of the super-ellipse |x/a|^n + |z/b|^n = 1 with perimeter `girth` and a/b = `aspect`.
HalfAxes super_ellipse(double girth, double aspect, double n) {
  constexpr int kPoints = 128;
  double sum = 0, x0 = aspect, z0 = 0;
  for (int i = 1; i <= kPoints; ++i) {
    double angle = 0.5 * kPi * i / kPoints;
    double x = i == kPoints ? 0 : aspect * portable::pow(portable::cos(angle), 2 / n);
    double z = portable::pow(portable::sin(angle), 2 / n);
    sum += std::sqrt((x - x0) * (x - x0) + (z - z0) * (z - z0));
    x0 = x;
    z0 = z;
  }
  return {girth / (4 * sum) * aspect, girth / (4 * sum)};
}
HalfAxes ellipse(double girth, double aspect) { return super_ellipse(girth, aspect, 2); }

/// Breadth to depth of a thigh: both thighs together are as broad as the hip, within what thighs look like.
double thigh_aspect(const FigureMeasures& m, double gap) {
  double low = 0.66, high = 0.86, outside = 1.02 * 0.5 * m.hipbreadth;
  for (int i = 0; i < 30; ++i) {
    double middle = 0.5 * (low + high);
    (2 * ellipse(m.thighcircumference, middle).across + gap < outside ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

Figure::Figure(const FigureMeasures& measures) : m_(measures), unit_(measures.stature / 1.68) {
  lay_out_trunk();
  lay_out_leg();
  lay_out_arm();
  lay_out_head_and_foot();
  rebuild();
}

int Figure::add_tape(Tape::Where where, const char* level, double at, double target) {
  tapes_.push_back({where, level, at, target, 1, false});
  return static_cast<int>(tapes_.size()) - 1;
}

void Figure::lay_out_trunk() {
  using Where = Tape::Where;
  double h = m_.stature, s = unit_;
  double waist_y = (m_.woman ? 0.649 : 0.638) * h, under_y = m_.chestheight - 0.047 * h;
  double neck_y = m_.cervicaleheight + 0.010 * h;
  // Girths that the tables do not have.
  double under_girth = m_.underbust > 0 ? m_.underbust : m_.bust_chest - 0.35 * (m_.bust_chest - m_.waist);
  double rib_girth = m_.woman ? under_girth + 0.18 * (m_.bust_chest - under_girth) : m_.bust_chest;

  int hip = add_tape(Where::trunk, "hip", m_.trochanterionheight, m_.hip);
  int waist = add_tape(Where::trunk, "waist", waist_y, m_.waist);
  int under = m_.underbust > 0 ? add_tape(Where::trunk, "underbust", under_y, m_.underbust) : -1;
  int bust = add_tape(Where::trunk, "bust", m_.chestheight, m_.bust_chest);
  int neck = add_tape(Where::trunk, "neck", neck_y, m_.neckcircumference);

  HalfAxes thigh = ellipse(m_.thighcircumference, thigh_aspect(m_, kThighGap * s));
  double thigh_outside = 2 * thigh.across + kThighGap * s;
  HalfAxes waist_axes = super_ellipse(m_.waist, m_.woman ? 1.38 : 1.34, 2.8);
  HalfAxes under_axes = super_ellipse(under_girth, 1.36, 2.5);
  HalfAxes rib = super_ellipse(rib_girth, m_.woman ? 1.36 : 1.29, 2.5),
           collar = ellipse(m_.neckcircumference, 0.98);
  chest_breadth_ = rib.across;
  double acromion = 0.5 * m_.biacromialbreadth, base = 1.10 * m_.neckcircumferencebase / (2 * kPi);
  double shoulder_top = m_.acromialheight - 0.004 * s;
  double tangent = portable::tan(kShoulderSlope * kPi / 180);
  double neck_base_y = shoulder_top + (0.80 * acromion - base) * tangent;

  double hip_depth = 0.5 * m_.buttockdepth, rib_depth = rib.along;
  auto knot = [&](double y, double breadth, double depth, double center, double exponent, int tape = -1) {
    trunk_knots_.push_back({y, breadth, depth, center * s, exponent, tape});
  };
  knot(m_.crotchheight - 0.10 * s, 0.65 * thigh_outside, 0.50 * thigh.along, -0.005, 2.3);
  knot(m_.crotchheight - 0.03 * s, 0.90 * thigh_outside, 0.82 * thigh.along, -0.009, 2.5);
  knot(m_.crotchheight + 0.02 * s, thigh_outside - 0.003 * s, 0.96 * hip_depth, -0.014, 3.0, hip);
  knot(m_.trochanterionheight, 0.5 * m_.hipbreadth, hip_depth, -0.017, 3.4, hip);
  knot(0.5 * (m_.trochanterionheight + m_.waistheightomphalion), 0.96 * 0.5 * m_.hipbreadth, 0.96 * hip_depth,
       -0.010, 3.1, hip);
  knot(m_.waistheightomphalion, 0.5 * m_.waistbreadth, 0.5 * m_.waistdepth, 0.006, 2.8);
  knot(waist_y, waist_axes.across, waist_axes.along, 0.009, 2.8, waist);
  knot(under_y, under_axes.across, under_axes.along, m_.woman ? 0.000 : -0.006, 2.5, under);
  knot(m_.chestheight, rib.across, rib_depth, m_.woman ? -0.009 : -0.003, 2.5, m_.woman ? -1 : bust);
  knot(m_.axillaheight, std::max(0.385 * m_.biacromialbreadth, 1.01 * rib.across),
       (m_.woman ? 0.90 : 0.94) * rib_depth, -0.020, 2.4);
  knot(0.5 * (m_.axillaheight + shoulder_top), 0.80 * acromion, 0.76 * rib_depth, -0.027, 2.2);
  knot(shoulder_top - 0.018 * s, 0.84 * acromion, 0.62 * rib_depth, -0.031, 2.1);
  knot(shoulder_top, 0.76 * acromion, 0.57 * rib_depth, -0.033, 2.0);
  knot(0.5 * (shoulder_top + neck_base_y), 0.5 * (0.76 * acromion + base), 0.058 * s, -0.034, 2.0);
  knot(neck_base_y, base, 0.056 * s, -0.031, 2.0);
  knot(std::max(neck_y, neck_base_y + 0.02 * s), collar.across, collar.along, -0.020, 2.1, neck);
  knot(neck_y + 0.035 * s, 0.98 * collar.across, 0.98 * collar.along, -0.006, 2.1, neck);
  knot(neck_y + 0.075 * s, 0.96 * collar.across, 0.96 * collar.along, 0.008, 2.1, neck);

  if (m_.woman) {
    bust_tape_ = bust;
    tapes_[bust].additive = true;
    tapes_[bust].knob = 0.30 * (m_.bust_chest - under_girth);
    double apex = 0.080 * (0.5 * s + 0.5 * m_.bust_chest / 0.88);  // half the distance of the bust points
    double size = 0.061 * (0.4 * s + 0.6 * m_.bust_chest / 0.88);
    breast_.center = {apex, m_.chestheight + 0.002 * s, rib_depth - 0.036 * s};
    breast_.radii = {size, 1.08 * size, 0.06};
  }
}

void Figure::lay_out_leg() {
  double h = m_.stature, s = unit_;
  double thigh_y = m_.crotchheight - 0.025 * h, knee_y = m_.kneeheightmidpatella;
  double lower_y = knee_y + 0.032 * h, calf_y = 0.205 * h, ankle_y = 0.05 * h;
  int thigh = add_tape(Tape::Where::leg, "thigh", thigh_y, m_.thighcircumference);
  int lower = add_tape(Tape::Where::leg, "lower_thigh", lower_y, m_.lowerthighcircumference);
  int knee = add_tape(Tape::Where::leg, "knee", knee_y, 0.965 * m_.lowerthighcircumference);
  int calf = add_tape(Tape::Where::leg, "calf", calf_y, m_.calfcircumference);
  int ankle = add_tape(Tape::Where::leg, "ankle", ankle_y, m_.anklecircumference);
  double top_aspect = thigh_aspect(m_, kThighGap * s);
  HalfAxes top = ellipse(m_.thighcircumference, top_aspect);
  double x0 = top.across + kThighGap * s;
  auto knot = [&](double y, double girth, double aspect, double z, int tape) {
    HalfAxes axes = ellipse(girth, aspect);
    double x = x0 + (thigh_y - y) * kStance;
    leg_knots_.push_back({y, axes.across, axes.along, x, z * s, tape});
  };
  double middle_girth = 0.55 * m_.thighcircumference + 0.45 * m_.lowerthighcircumference;
  knot(0.018 * h, 1.02 * m_.anklecircumference, 0.85, -0.040, -1);
  knot(ankle_y, m_.anklecircumference, 0.80, -0.036, ankle);
  knot(0.115 * h, 0.5 * (m_.anklecircumference + m_.calfcircumference), 0.88, -0.033, -1);
  knot(calf_y, m_.calfcircumference, 0.93, -0.028, calf);
  knot(knee_y - 0.035 * h, 0.93 * m_.lowerthighcircumference, 0.93, -0.017, -1);
  knot(knee_y, 0.965 * m_.lowerthighcircumference, 0.92, -0.008, knee);
  knot(lower_y, m_.lowerthighcircumference, 0.92, -0.007, lower);
  knot(0.5 * (lower_y + thigh_y), middle_girth, 0.86, -0.002, -1);
  knot(thigh_y, m_.thighcircumference, top_aspect, 0.000, thigh);
  knot(m_.crotchheight + 0.01 * s, 0.97 * m_.thighcircumference, top_aspect, -0.004, thigh);
  knot(m_.crotchheight + 0.06 * s, 0.70 * m_.thighcircumference, top_aspect, -0.010, thigh);
}

void Figure::lay_out_arm() {
  double s = unit_, angle = kArmAngle * kPi / 180;
  arm_axis_ = {portable::sin(angle), -portable::cos(angle), 0};
  arm_across_ = {portable::cos(angle), portable::sin(angle), 0};
  double radius = m_.bicepscircumferenceflexed / (2 * kPi), top = 1.0 * radius;
  shoulder_ = {std::max(0.5 * m_.bideltoidbreadth - 0.90 * top, 0.40 * m_.biacromialbreadth),
               m_.acromialheight - 0.018 * s - 0.85 * top, -0.028 * s};
  // Where the chest is broad for the shoulders the arms hang farther out: the tape at the bust passes under
  // them.
  double clear_y = m_.chestheight + 0.4 * (m_.axillaheight - m_.chestheight);
  double inner = portable::tan(angle) * (shoulder_.y() - clear_y) - top / portable::cos(angle);
  shoulder_.x() = std::max(shoulder_.x(), chest_breadth_ + 0.012 - inner);
  double elbow = m_.acromionradialelength - 0.02 * s, wrist = m_.sleeveoutseam - 0.02 * s;
  int biceps_tape = add_tape(Tape::Where::arm, "biceps", 0.52 * elbow, m_.bicepscircumferenceflexed);
  int wrist_tape = add_tape(Tape::Where::arm, "wrist", wrist, m_.wristcircumference);
  auto round = [&](double at, double r, double center, int tape) {
    arm_knots_.push_back({at, r, r, center, 0, tape});
  };
  double wrist_radius = m_.wristcircumference / (2 * kPi);
  round(0, top, 0, biceps_tape);
  round(0.52 * elbow, radius, 0.002 * s, biceps_tape);
  round(0.92 * elbow, 0.86 * radius, 0, -1);
  round(elbow + 0.22 * (wrist - elbow), 0.87 * radius, 0, -1);
  round(elbow + 0.65 * (wrist - elbow), 0.45 * 0.87 * radius + 0.55 * wrist_radius, 0, -1);
  // Wrist and hand are broad in z (palm towards the thigh) and end rounded.
  HalfAxes flat = ellipse(m_.wristcircumference, 0.80);
  arm_knots_.push_back({wrist, flat.across, flat.along, 0, 0, wrist_tape});
  arm_knots_.push_back({wrist + 0.03 * s, 0.0215 * s, 0.028 * s, 0, 0.001 * s, -1});
  arm_knots_.push_back({wrist + 0.08 * s, 0.0225 * s, 0.036 * s, -0.002 * s, 0.004 * s, -1});
  arm_knots_.push_back({wrist + 0.12 * s, 0.0220 * s, 0.034 * s, -0.006 * s, 0.003 * s, -1});
  arm_knots_.push_back({wrist + 0.15 * s, 0.0190 * s, 0.027 * s, -0.010 * s, 0.002 * s, -1});
  arm_knots_.push_back({wrist + 0.162 * s, 0.0155 * s, 0.020 * s, -0.012 * s, 0.002 * s, -1});
}

void Figure::lay_out_head_and_foot() {
  double s = unit_, chin = m_.cervicaleheight + 0.018 * s, top = m_.stature;
  HalfAxes head = ellipse(m_.headcircumference, 0.79);
  double tall = top - chin;
  cranium_.center = {0, top - 0.40 * tall, 0.016 * s};
  cranium_.radii = {head.across, 0.40 * tall, head.along};
  jaw_.center = {0, chin + 0.37 * tall, 0.044 * s};
  jaw_.radii = {0.78 * head.across, 0.37 * tall, 0.68 * head.along};
  double x = leg_knots_.front().center_across;
  foot_.center = {x + 0.006 * s, 0.012 * s, 0.055 * s};
  foot_.radii = {0.046 * s, 0.048 * s, 0.128 * s};
  heel_.center = {x, 0.022 * s, -0.046 * s};
  heel_.radii = {0.034 * s, 0.042 * s, 0.042 * s};
}

}  // namespace garment::body
