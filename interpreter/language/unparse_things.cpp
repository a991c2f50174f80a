#include "interpreter/language/unparse_things.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "interpreter/language/unparse_text.hpp"
#include "runtime/base/number.hpp"

namespace garment::interpreter::text {
namespace {

std::string channel(double value) {
  int byte = static_cast<int>(std::lround(std::clamp(value, 0.0, 1.0) * 255));
  return fmt::format("{:02x}", byte);
}

struct BodyWriter {
  std::string operator()(const design::Mannequin& person) const {
    std::string out =
        fmt::format("mannequin(sex: \"{}\", size: {}",
                    person.sex == design::Mannequin::Sex::woman ? "woman" : "man", number(person.size));
    for (const auto& [name, value] : person.measures) out += fmt::format(", {}: {}", name, length(value));
    return out + ")";
  }
  std::string operator()(const design::MeshFile& file) const {
    if (file.scale == 1) return fmt::format("mesh({})", in_quotes(file.path));
    return fmt::format("mesh({}, scale: {})", in_quotes(file.path), format_number(file.scale));
  }
  std::string operator()(const design::Sphere& s) const {
    return fmt::format("sphere(radius: {})", length(s.radius));
  }
  std::string operator()(const design::Ellipsoid& e) const {
    return fmt::format("ellipsoid(semi_axes: {})", point(e.semi_axes));
  }
  std::string operator()(const design::Cylinder& c) const {
    return fmt::format("cylinder(radius: {}, height: {})", length(c.radius), length(c.height));
  }
  std::string operator()(const design::Box& b) const { return fmt::format("box(size: {})", point(b.size)); }
  std::string operator()(const design::Floor&) const { return "floor"; }
};

/// Fields whose printed figures, read back, are the same doubles: units of factor 1.
std::vector<std::string> fields_of(const design::Fabric& f) {
  std::vector<std::string> fields;
  auto field = [&](std::string_view name, double value, std::string_view unit = {}) {
    std::string figure = format_number(value);
    fields.push_back(fmt::format("{} = {}{}{}", name, figure, unit.empty() ? "" : " ", unit));
  };
  field("W", f.areal_density, "kg/m^2");
  field("T", f.thickness, "m");
  field("Fm", f.tensile[0].max_force, "N/m");
  constexpr const char* kSuffix[] = {"_warp", "_weft"};
  for (int d = 0; d < 2; ++d) {
    field(std::string("EM") + kSuffix[d], f.tensile[d].max_strain);
    field(std::string("LT") + kSuffix[d], f.tensile[d].linearity);
    field(std::string("RT") + kSuffix[d], f.tensile[d].resilience);
  }
  field("G", f.shear_rigidity, "N/m");
  field("two_HG", 2 * f.shear_friction, "N/m");
  field("two_HG5", 2 * f.shear_friction_5, "N/m");
  for (int d = 0; d < 2; ++d) field(std::string("B") + kSuffix[d], f.bending_rigidity[d], "N*m");
  for (int d = 0; d < 2; ++d) field(std::string("two_HB") + kSuffix[d], 2 * f.bending_friction[d], "N");
  if (f.twist_rigidity != 0) field("twist", f.twist_rigidity, "N*m");
  field("friction", f.friction);
  field("damping", f.damping, "s");
  if (f.color != design::Fabric{}.color)
    fields.push_back(
        fmt::format("color = \"#{}{}{}\"", channel(f.color[0]), channel(f.color[1]), channel(f.color[2])));
  if (!f.pattern.empty()) {
    fields.push_back("pattern = " + in_quotes(f.pattern));
    field("repeat", f.pattern_repeat, "m");
  }
  if (!f.kind.empty() && f.kind != "stated") fields.push_back("kind = " + in_quotes(f.kind));
  if (!f.source.empty()) fields.push_back("source = " + in_quotes(f.source));
  return fields;
}

}  // namespace

std::string fabric(const std::string& name, const design::Fabric& fabric) {
  std::string out = fmt::format("fabric {} = {{\n", name);
  for (const std::string& field : fields_of(fabric)) out += "  " + field + "\n";
  return out + "}";
}

std::string body(const std::string& name, const design::Body& body) {
  std::string out = fmt::format("body {} = {}", name, std::visit(BodyWriter{}, body.shape));
  if (body.position != Eigen::Vector3d::Zero()) out += " at " + point(body.position);
  if (body.friction != design::Body{}.friction) out += " friction " + format_number(body.friction);
  return out;
}

std::string acceleration(const Eigen::Vector3d& a) {
  auto part = [](double x) { return x == 0 ? std::string("0") : format_number(x) + " m/s^2"; };
  return fmt::format("({}, {}, {})", part(a.x()), part(a.y()), part(a.z()));
}

}  // namespace garment::interpreter::text
