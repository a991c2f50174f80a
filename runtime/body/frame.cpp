#include "runtime/body/frame.hpp"

#include "runtime/body/mannequin.hpp"

namespace garment::body {
namespace {

/// Measures that are neither a level's girth nor its height.
struct Measure {
  const char* name;    ///< in a script
  const char* column;  ///< of the size tables
};
constexpr Measure kLengths[] = {
    {"stature", "stature"},
    {"back_length", "waistbacklength"},
    {"back_breadth", "interscyei"},
    {"shoulder_breadth", "biacromialbreadth"},
    {"shoulder_length", "shoulderlength"},
    {"sleeve_length", "sleeveoutseam"},
    {"upper_arm_length", "acromionradialelength"},
    {"neck_base", "neckcircumferencebase"},
    {"crotch_height", "crotchheight"},
    {"bust_breadth", "chestbreadth"},
    {"hip_breadth", "hipbreadth"},
};

}  // namespace

FrameResult make_frame(const design::Body& declared) {
  FrameResult result;
  const auto* person = std::get_if<design::Mannequin>(&declared.shape);
  if (person == nullptr) return result;
  MeasuresResult checked = check_measures(*person, declared.name, declared.origin);
  result.findings = std::move(checked.findings);
  if (!checked.measures) return result;
  const FigureMeasures& m = *checked.measures;
  const Figure figure(m);
  Frame frame;
  const double base = declared.position.y();
  for (const Tape& tape : figure.tapes())
    frame.levels[tape.level] = {base + figure.tape_plane(tape).origin.y(), tape.target};
  // Levels without a tape: the tables have their heights, the surface alone their girths.
  frame.levels["shoulder"].height = base + m.acromialheight;
  frame.levels["armpit"].height = base + m.axillaheight;
  frame.levels["crotch"].height = base + m.crotchheight;
  frame.levels["head"].girth = m.headcircumference;
  if (!frame.levels.contains("underbust")) frame.levels["underbust"] = {};
  frame.parts = {"arm.left", "arm.right", "head", "leg.left", "leg.right", "neck", "torso"};
  for (const Measure& length : kLengths)
    if (const auto given = person->measures.find(length.column); given != person->measures.end())
      frame.lengths[length.name] = given->second;
  result.frame = std::move(frame);
  return result;
}

}  // namespace garment::body
