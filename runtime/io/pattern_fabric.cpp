#include "runtime/io/pattern_json.hpp"

namespace garment::io {

design::Fabric import_fabric() {
  design::Fabric f;
  f.name = "jersey";
  f.kind = "class-typical";
  f.source = "typical cotton-elastane single jersey; not a measurement";
  f.areal_density = 0.18;
  f.thickness = 0.7e-3;
  f.tensile[0] = f.tensile[1] = {0.5, 0.8, 490.3325, 0.5};
  f.shear_rigidity = 30;
  f.bending_rigidity = {5e-6, 5e-6};
  f.friction = 0.3;
  f.color = {0.50, 0.55, 0.66};
  return f;
}

}  // namespace garment::io
