// FAST figures to the figures of a cloth.
#include <algorithm>
#include <array>
#include <cmath>

#include "interpreter/language/fabric_fields.hpp"

namespace garment::interpreter {
namespace {

constexpr double kGfPerCm = 0.980665;  // N/m
constexpr double kGravity = 9.80665;

void refuse_twice(Program& program, const Given& given, Slot fast, Slot other, std::size_t d,
                  const char* what) {
  if (!given.at(fast, d) || !given.at(other, d)) return;
  fail(program, Message("G0314", std::string("two figures say the same thing: ") + what, given.place(fast, d))
                    .also(given.place(other, d), "here too")
                    .help("give one of them"));
}

/// Area under the monotone cubic (Fritsch and Butland's slopes) through points of rising x.
double area_under(const std::array<double, 4>& x, const std::array<double, 4>& y) {
  std::array<double, 3> secant{};
  for (std::size_t k = 0; k < 3; ++k) secant[k] = (y[k + 1] - y[k]) / (x[k + 1] - x[k]);
  std::array<double, 4> slope{secant[0], 0, 0, secant[2]};
  for (std::size_t k = 1; k < 3; ++k) slope[k] = 2 * secant[k - 1] * secant[k] / (secant[k - 1] + secant[k]);
  double area = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double h = x[k + 1] - x[k];
    area += h * (y[k] + y[k + 1]) / 2 + h * h * (slope[k] - slope[k + 1]) / 12;
  }
  return area;
}

void apply_tension(Program& program, design::Tensile& tensile, const Given& given, std::size_t d) {
  const auto &e5 = given.at(Slot::E5, d), &e20 = given.at(Slot::E20, d), &e100 = given.at(Slot::E100, d);
  if (!e5 && !e20 && !e100) return;
  const Slot first = e5 ? Slot::E5 : e20 ? Slot::E20 : Slot::E100;
  if (!e100)
    fail(program,
         Message("G1134", "FAST tension needs E100, the extension at 100 gf/cm", given.place(first, d))
             .help("E5 and E20 refine the curve; E100 says how far it goes"));
  for (Slot other : {Slot::EM, Slot::LT, Slot::WT, Slot::Fm, Slot::stretch})
    refuse_twice(program, given, Slot::E100, other, d, "FAST extensions and Kawabata or SI tension");
  tensile.max_force = 100 * kGfPerCm;
  tensile.max_strain = *e100;
  if (!e5 || !e20) return;
  if (!(*e5 < *e20 && *e20 < *e100))
    fail(program,
         Message("G1134",
                 "extension must grow with the load: E5 is " + format_quantity(*e5, {}, true) + ", E20 " +
                     format_quantity(*e20, {}, true) + ", E100 " + format_quantity(*e100, {}, true),
                 given.place(Slot::E20, d))
             .help("E5 < E20 < E100; are two of them exchanged?"));
  const double work = area_under({0, *e5, *e20, *e100}, {0, 5 * kGfPerCm, 20 * kGfPerCm, 100 * kGfPerCm});
  tensile.linearity = std::clamp(2 * work / (tensile.max_force * tensile.max_strain), 0.1, 1.5);
}

}  // namespace

void apply_fast(Program& program, design::Fabric& fabric, Given& given) {
  for (std::size_t d = 0; d < 2; ++d) {
    apply_tension(program, fabric.tensile[d], given, d);
    refuse_twice(program, given, Slot::bending_length, Slot::B, d,
                 "the bending length `c` and the rigidity B");
    if (const auto& c = given.at(Slot::bending_length, d))
      fabric.bending_rigidity[d] = fabric.areal_density * kGravity * *c * *c * *c;
  }
  refuse_twice(program, given, Slot::EB5, Slot::G, 0, "the bias extension EB5 and the shear rigidity G");
  if (const auto& eb5 = given.at(Slot::EB5, 0)) fabric.shear_rigidity = 1.23 / *eb5;
  const auto &pressed = given.at(Slot::T100, 0), &loose = given.at(Slot::T, 0);
  if (pressed && loose && *pressed > *loose)
    fail(program, Message("G1134",
                          "T100 is " + format_mm(*pressed) + ", thicker than T2 with " + format_mm(*loose) +
                              ", though more load lies on it",
                          given.place(Slot::T100, 0))
                      .help("T2 is the thickness under 2 gf/cm^2, T100 under 100 gf/cm^2"));
  if (pressed && !loose)
    fail(program, Message("G1134", "T100 alone does not say how thick the cloth is when it hangs",
                          given.place(Slot::T100, 0))
                      .help("give T2 too, or T"));
}

}  // namespace garment::interpreter
