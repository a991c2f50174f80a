#pragma once
// Fields of a fabric as they are given, before they are put together into a cloth.
#include <optional>
#include <string>
#include <vector>

#include "interpreter/language/program.hpp"

namespace garment::interpreter {

/// What a figure of a fabric is, whatever it is called.
enum class Slot {
  W,
  T,
  G,
  HG,
  HG5,
  B,
  HB,
  twist,
  EM,
  LT,
  WT,
  RT,
  Fm,
  stretch,
  friction,
  damping,
  E5,
  E20,
  E100,
  EB5,
  bending_length,
  T100
};
inline constexpr std::size_t kSlotCount = 22;

/// Figures per slot and direction (0 warp, 1 weft; 0 where a figure has no direction), SI.
struct Given {
  std::optional<double> value[kSlotCount][2];
  Span span[kSlotCount][2];
  std::optional<double>& at(Slot slot, std::size_t d) { return value[static_cast<std::size_t>(slot)][d]; }
  const std::optional<double>& at(Slot slot, std::size_t d) const {
    return value[static_cast<std::size_t>(slot)][d];
  }
  Span place(Slot slot, std::size_t d) const { return span[static_cast<std::size_t>(slot)][d]; }
};

/// Takes one field into `given` (colour, kind, source, pattern and repeat go straight into `fabric`). Reports
/// and throws Stop: unknown field, wrong dimension, out of range, said twice.
void take_field(Program& program, design::Fabric& fabric, Given& given, const std::string& name,
                Span name_span, const Value& value, Span value_span);
/// Puts the figures into the cloth.
void apply_given(Program& program, design::Fabric& fabric, Given& given);

/// Turns FAST figures into those of the cloth. `fabric` has its weight. De Boos and Tester, SiroFAST (CSIRO
/// WT92.02):
///   B [uN m] = 9.81e-6 W [g/m^2] c^3 [mm], that is B = W g c^3 in SI, c the bending length;
///   G [N/m]  = 123 / EB5 [%], EB5 the bias extension at 5 gf/cm;
///   tension: E5, E20, E100 are extensions at 5, 20, 100 gf/cm. EM = E100 at Fm = 100 gf/cm, and LT = 2 WT /
///   (Fm EM) with WT the area under the monotone cubic through the three points and the origin.
void apply_fast(Program& program, design::Fabric& fabric, Given& given);

/// Warns of what a record that states a whole cloth leaves to defaults (G1130), once, at `span`.
void warn_defaults(Program& program, const Given& given, const std::string& name, Span span);
/// Warns of given figures that no woven cloth of this weight has (G1131).
void warn_implausible(Program& program, const design::Fabric& fabric, const Given& given,
                      const std::string& name);

/// Says which given figures act only where hysteresis is asked for (G0461).
void note_unused(Program& program, const Given& given);

/// The picture's file must be there (G1133).
void check_pattern(Program& program, const std::string& path, Span span);

}  // namespace garment::interpreter
