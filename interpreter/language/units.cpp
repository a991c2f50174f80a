#include "interpreter/language/units.hpp"

#include <cmath>

#include "runtime/base/number.hpp"

namespace garment::interpreter {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kGramForce = 9.80665e-3;  // N, exact by definition
constexpr int kMaxExponent = 60;

std::optional<Dimension> combine(Dimension a, Dimension b, int sign) {
  const int e[4] = {a.m + sign * b.m, a.kg + sign * b.kg, a.s + sign * b.s, a.rad + sign * b.rad};
  for (int x : e)
    if (x < -kMaxExponent || x > kMaxExponent) return std::nullopt;
  return Dimension{static_cast<std::int8_t>(e[0]), static_cast<std::int8_t>(e[1]),
                   static_cast<std::int8_t>(e[2]), static_cast<std::int8_t>(e[3])};
}

struct Named {
  Dimension dimension;
  const char* description;
  const char* unit;
};
constexpr Named kNamed[] = {
    {kNumber, "a plain number", ""},
    {kLength, "a length", "cm"},
    {kArea, "an area", "cm^2"},
    {kAngle, "an angle", "deg"},
    {kTime, "a time", "s"},
    {kMass, "a mass", "g"},
    {kForce, "a force", "N"},
    {kAcceleration, "an acceleration", "m/s^2"},
    {{1, 0, -1, 0}, "a speed", "m/s"},
    {kForcePerLength, "a force per width", "N/m"},
    {kShearRigidity, "a shear rigidity", "gf/cm/deg"},
    {kMoment, "a bending rigidity or energy", "gf*cm^2/cm"},
    {kArealDensity, "a mass per area", "g/m^2"},
    {kPressure, "a pressure", "Pa"},
};

void append_power(std::string& text, const char* unit, int exponent) {
  if (exponent == 0) return;
  if (!text.empty()) text += '*';
  text += unit;
  if (exponent != 1) text += '^' + std::to_string(exponent);
}

std::string base_units(Dimension d) {
  std::string text;
  append_power(text, "kg", d.kg);
  append_power(text, "m", d.m);
  append_power(text, "s", d.s);
  append_power(text, "rad", d.rad);
  return text;
}

}  // namespace

std::optional<Dimension> product(Dimension a, Dimension b) { return combine(a, b, 1); }
std::optional<Dimension> quotient(Dimension a, Dimension b) { return combine(a, b, -1); }
std::optional<Dimension> power(Dimension a, int n) {
  if (n < -kMaxExponent || n > kMaxExponent) return a.none() ? std::optional(a) : std::nullopt;
  const int e[4] = {a.m * n, a.kg * n, a.s * n, a.rad * n};
  for (int x : e)
    if (x < -kMaxExponent || x > kMaxExponent) return std::nullopt;
  return Dimension{static_cast<std::int8_t>(e[0]), static_cast<std::int8_t>(e[1]),
                   static_cast<std::int8_t>(e[2]), static_cast<std::int8_t>(e[3])};
}

const std::vector<Unit>& unit_table() {
  static const std::vector<Unit> table = {
      {"mm", 1e-3, kLength},      {"cm", 1e-2, kLength},
      {"m", 1, kLength},          {"um", 1e-6, kLength},
      {"inch", 0.0254, kLength},  {"ft", 0.3048, kLength},
      {"g", 1e-3, kMass},         {"kg", 1, kMass},
      {"mg", 1e-6, kMass},        {"s", 1, kTime},
      {"ms", 1e-3, kTime},        {"min", 60, kTime},
      {"deg", kPi / 180, kAngle}, {"rad", 1, kAngle},
      {"N", 1, kForce},           {"mN", 1e-3, kForce},
      {"cN", 1e-2, kForce},       {"uN", 1e-6, kForce},
      {"gf", kGramForce, kForce}, {"kgf", 1000 * kGramForce, kForce},
      {"Pa", 1, kPressure},       {"kPa", 1e3, kPressure},
      {"J", 1, kEnergy},          {"mJ", 1e-3, kEnergy},
      {"%", 1e-2, kNumber},
  };
  return table;
}

std::vector<std::string> unit_names() {
  std::vector<std::string> names;
  for (const Unit& unit : unit_table()) names.emplace_back(unit.name);
  return names;
}

std::optional<UnitValue> find_unit(std::string_view text) {
  UnitValue result;
  if (text.empty()) return result;
  char join = '*';
  std::size_t at = 0;
  while (true) {
    std::size_t end = text.find_first_of("*/^", at);
    if (end == std::string_view::npos) end = text.size();
    const std::string_view name = text.substr(at, end - at);
    const Unit* found = nullptr;
    for (const Unit& unit : unit_table())
      if (unit.name == name) found = &unit;
    if (found == nullptr) return std::nullopt;
    int exponent = 1;
    if (end < text.size() && text[end] == '^') {
      std::size_t stop = text.find_first_of("*/", end);
      if (stop == std::string_view::npos) stop = text.size();
      const auto number = parse_number(text.substr(end + 1, stop - end - 1));
      if (!number || *number != std::floor(*number) || std::fabs(*number) > 9) return std::nullopt;
      exponent = static_cast<int>(*number);
      end = stop;
    }
    if (join == '/') exponent = -exponent;
    for (int k = 0; k < exponent; ++k) result.factor *= found->factor;
    for (int k = 0; k > exponent; --k) result.factor /= found->factor;
    const auto scaled = power(found->dimension, exponent);
    const auto joined = scaled ? product(result.dimension, *scaled) : std::nullopt;
    if (!joined) return std::nullopt;
    result.dimension = *joined;
    if (end >= text.size()) break;
    join = text[end];
    at = end + 1;
  }
  result.percent = text == "%";
  return result;
}

std::string describe(Dimension dimension) {
  for (const Named& named : kNamed)
    if (named.dimension == dimension) return named.description;
  return "a value in " + base_units(dimension);
}

std::string example_unit(Dimension dimension) {
  for (const Named& named : kNamed)
    if (named.dimension == dimension) return named.unit;
  return base_units(dimension);
}

std::string format_quantity(double value, Dimension dimension, bool percent, int digits) {
  if (percent && dimension.none()) return format_number(100 * value, digits) + '%';
  if (dimension == kLength) {
    if (std::fabs(value) < 0.01 && value != 0) return format_number(1000 * value, digits) + " mm";
    return std::fabs(value) < 10 ? format_number(100 * value, digits) + " cm" : format_number(value, digits) + " m";
  }
  if (dimension == kArea) return format_number(1e4 * value, digits) + " cm^2";
  if (dimension == kAngle) return format_number(value * (180 / kPi), digits) + " deg";
  if (dimension == kMass) return format_number(1000 * value, digits) + " g";
  if (dimension == kArealDensity) return format_number(1000 * value, digits) + " g/m^2";
  if (dimension == kMoment) return format_number(value, digits) + " N*m";
  if (dimension == kShearRigidity) return format_number(value, digits) + " N/m/rad";
  if (dimension.none()) return format_number(value, digits);
  const std::string unit = example_unit(dimension);
  return format_number(value, digits) + ' ' + unit;
}

std::string format_mm(double metres) {
  const double mm = 1000 * metres;
  const double rounded = std::fabs(mm) >= 100 ? std::round(mm) : std::round(10 * mm) / 10;
  return format_number(rounded, 6) + " mm";
}

}  // namespace garment::interpreter
