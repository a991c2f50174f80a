#include "interpreter/language/person_names.hpp"

namespace garment::interpreter {

const std::vector<PersonName>& person_names() {
  // The first alias is the name in the list of measurements of Seamly2D and Valentina (vmeasurements, groups
  // A to O).
  static const std::vector<PersonName> names = {
      {"stature", {"height", "body_height"}, true},
      {"bust", {"bust_circ", "bust_girth", "chest", "chest_girth"}, true},
      {"chest", {"bust_circ", "chest_circ", "chest_girth", "bust", "bust_girth"}, true},
      {"waist", {"waist_circ", "waist_girth"}, true},
      {"hip", {"hip_circ", "hips", "hip_girth", "hips_girth"}, true},
      {"underbust", {"lowbust_circ", "under_bust", "underbust_girth"}},
      {"neck", {"neck_mid_circ", "neck_girth"}},
      {"neck_base", {"neck_circ"}},
      {"shoulder_breadth", {"shoulder_tip_to_shoulder_tip_b", "shoulder_width"}},
      {"shoulder", {"shoulder_length"}},
      {"sleeve", {"arm_shoulder_tip_to_wrist", "arm_length", "sleeve_length"}},
      {"upper_arm", {"arm_shoulder_tip_to_elbow", "upper_arm_length"}},
      {"biceps", {"arm_upper_circ", "upper_arm_girth", "biceps_girth"}},
      {"wrist", {"arm_wrist_circ", "wrist_girth"}},
      {"thigh", {"leg_thigh_upper_circ", "thigh_girth"}},
      {"lower_thigh", {}},
      {"calf", {"leg_calf_circ", "calf_girth"}},
      {"ankle", {"leg_ankle_circ", "ankle_girth"}},
      {"crotch_height", {"leg_crotch_to_floor", "inseam", "inside_leg"}},
      {"hip_height", {"height_hip"}},
      {"knee_height", {"height_knee"}},
      {"cervicale_height", {"height_neck_back"}},
      {"shoulder_height", {"height_shoulder_tip"}},
      {"axilla_height", {"height_armpit"}},
      {"bust_height", {"height_bustpoint"}},
      {"bust_breadth", {}},
      {"bust_depth", {}},
      {"waist_breadth", {"width_waist"}},
      {"waist_depth", {}},
      {"hip_breadth", {"width_hip"}},
      {"hip_depth", {}},
      {"navel_height", {}},
      {"head", {"head_circ", "head_girth"}},
  };
  return names;
}

const PersonName* find_person_name(std::string_view measure) {
  for (const PersonName& name : person_names())
    if (name.measure == measure) return &name;
  return nullptr;
}

}  // namespace garment::interpreter
