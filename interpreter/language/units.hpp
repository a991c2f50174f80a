#pragma once
// Dimensions and the closed table of units. Inside, everything is m, kg, s, rad.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace garment::interpreter {

/// Exponents of the base units.
struct Dimension {
  std::int8_t m = 0, kg = 0, s = 0, rad = 0;
  friend bool operator==(const Dimension&, const Dimension&) = default;
  bool none() const { return *this == Dimension{}; }
};

inline constexpr Dimension kNumber{};
inline constexpr Dimension kLength{1, 0, 0, 0};
inline constexpr Dimension kArea{2, 0, 0, 0};
inline constexpr Dimension kAngle{0, 0, 0, 1};
inline constexpr Dimension kTime{0, 0, 1, 0};
inline constexpr Dimension kMass{0, 1, 0, 0};
inline constexpr Dimension kForce{1, 1, -2, 0};
inline constexpr Dimension kAcceleration{1, 0, -2, 0};
inline constexpr Dimension kForcePerLength{0, 1, -2, 0};  ///< N/m
inline constexpr Dimension kShearRigidity{0, 1, -2, -1};  ///< N/(m rad)
inline constexpr Dimension kMoment{2, 1, -2, 0};          ///< N m
inline constexpr Dimension kEnergy{2, 1, -2, 0};          ///< J
inline constexpr Dimension kArealDensity{-2, 1, 0, 0};    ///< kg/m^2
inline constexpr Dimension kPressure{-1, 1, -2, 0};

/// Exponents added, subtracted, times `n`; nothing when one leaves -60 .. 60.
std::optional<Dimension> product(Dimension a, Dimension b);
std::optional<Dimension> quotient(Dimension a, Dimension b);
std::optional<Dimension> power(Dimension a, int n);

/// A unit of the table: value in SI = number * factor.
struct Unit {
  std::string_view name;
  double factor;
  Dimension dimension;
};

/// The closed table ("mm", "inch", "gf", "%", ...). Products are joined from these by `*`, `/` and `^`.
const std::vector<Unit>& unit_table();
std::vector<std::string> unit_names();

struct UnitValue {
  double factor = 1;
  Dimension dimension;
  bool percent = false;
};
/// Meaning of a unit as written after a number: "cm", "gf*cm^2/cm", "g/m^2". Nothing if it is not made of the
/// table.
std::optional<UnitValue> find_unit(std::string_view text);

/// "a length", "an angle", "a number", "N/m" ...; for messages.
std::string describe(Dimension dimension);
/// What a person may write for it: "cm", "deg", "N/m".
std::string example_unit(Dimension dimension);
/// A value as a person reads it: lengths in mm or cm, angles in deg, `percent` as %, at most `digits` digits.
std::string format_quantity(double value, Dimension dimension, bool percent = false, int digits = 4);
/// "31 mm": lengths where sewing compares them; at most 4 digits.
std::string format_mm(double metres);

}  // namespace garment::interpreter
