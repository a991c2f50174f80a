#pragma once
#include <array>
#include <string>

#include "runtime/base/origin.hpp"

namespace garment::design {

/// Kawabata tensile record along one direction, SI. The law made from it is in modeller/tensile_law.
struct Tensile {
  double max_strain = 0.06;    ///< EM/100, strain at `max_force`
  double linearity = 0.65;     ///< LT
  double max_force = 490.3325; ///< Fm, N/m (500 gf/cm unless recorded)
  double resilience = 1;       ///< RT/100; 1 where it is not known: nothing is lost
};

/// A cloth, SI units (docs/physics.md, section 1, converts KES and FAST). Index 0 is warp, 1 is weft.
struct Fabric {
  std::string name;
  OriginId origin;
  std::string kind;                          ///< "measured", "population mean", "class-typical", "stated"
  std::string source;                        ///< where the figures come from
  double areal_density = 0.2;                ///< W, kg/m^2
  double thickness = 0.5e-3;                 ///< T, m
  std::array<Tensile, 2> tensile{};
  double shear_rigidity = 40;                ///< G, N/m per rad
  double shear_friction = 0;                 ///< HG = 2HG/2, N/m
  double shear_friction_5 = 0;               ///< HG5 = 2HG5/2, N/m
  std::array<double, 2> bending_rigidity{1e-5, 1e-5};  ///< B, N m (per metre width)
  std::array<double, 2> bending_friction{0, 0};        ///< HB = 2HB/2, N
  double twist_rigidity = 0;                 ///< Ct, N m; 0 means unknown: 0.20 (B1 + B2) is taken
  double friction = 0.3;                     ///< Coulomb, cloth on body
  double damping = 0.02;                     ///< tau of the Kelvin damper, s
  std::array<double, 3> color{0.45, 0.48, 0.55};       ///< sRGB, 0..1
  std::string pattern;                       ///< picture printed on the face, a file below the script's folder; or empty
  double pattern_repeat = 0.1;               ///< width of one repeat of the picture along the weft, m
};

}  // namespace garment::design
