#include "interpreter/language/unparse_scene.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "interpreter/language/unparse_seam.hpp"
#include "runtime/base/number.hpp"
#include "runtime/base/portable_math.hpp"

namespace garment::interpreter::text {
namespace {

std::string plain(std::string name) {
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

/// "(0, 2 N, 0)".
std::string vector(const Eigen::Vector3d& v, const char* unit) {
  auto part = [unit](double x) {
    if (x == 0) return std::string("0");
    return format_number(x) + (*unit == '\0' ? "" : " ") + unit;
  };
  return fmt::format("({}, {}, {})", part(v.x()), part(v.y()), part(v.z()));
}

std::string path(const design::Path& path, const Names& names) {
  std::string out = "path " + plain(path.name);
  if (path.body >= 0) out += " of " + names.bodies[static_cast<std::size_t>(path.body)];
  out += " {";
  for (std::size_t k = 0; k < path.poses.size(); ++k) {
    const design::Pose& pose = path.poses[k];
    out += fmt::format("{} pose at {} s", k > 0 ? ";" : "", format_number(pose.time));
    if (pose.move != Eigen::Vector3d::Zero()) out += " move " + vector(pose.move, "m");
    if (pose.turn != Eigen::Vector3d::Zero())
      out += " turn " + vector(pose.turn * (180 / portable::kPi), "deg");
  }
  return out + " }";
}

std::string clamp(const design::Clamp& clamp, const design::Garment& garment, const Names& names) {
  std::string held;
  for (const design::EdgePart& part : clamp.parts)
    held += (held.empty() ? "" : " + ") + edge_part(garment, names, part);
  if (clamp.region >= 0) held = plain(garment.regions[static_cast<std::size_t>(clamp.region)].name);
  std::string out = fmt::format("clamp {}: {}", plain(clamp.name), held);
  if (clamp.path >= 0)
    out += " path " + plain(garment.scene.paths[static_cast<std::size_t>(clamp.path)].name);
  return out;
}

std::string panel_point(const design::PanelPoint& at, const Names& names) {
  return fmt::format("{}.at({})", names.panels[static_cast<std::size_t>(at.panel)], point(at.point));
}

std::string constraint(const design::Constraint& c, const Names& names) {
  using Kind = design::Constraint::Kind;
  const std::string a = panel_point(c.a, names);
  switch (c.kind) {
    case Kind::distance:
      return fmt::format("constrain distance {} to {} of {}", a, panel_point(c.b, names), length(c.length));
    case Kind::equal:
      return fmt::format("constrain equal {} to {}", a, panel_point(c.b, names));
    case Kind::on_line:
      return fmt::format("constrain on_line {} through {} along {}", a, vector(c.through, "m"),
                         vector(c.along, ""));
    case Kind::on_plane:
      return fmt::format("constrain on_plane {} through {} normal {}", a, vector(c.through, "m"),
                         vector(c.along, ""));
  }
  return {};
}

std::string friction(const design::FrictionPair& pair, const Names& names) {
  const std::string first = names.fabrics[static_cast<std::size_t>(pair.fabric)];
  const std::string second = pair.body >= 0 ? names.bodies[static_cast<std::size_t>(pair.body)]
                                            : names.fabrics[static_cast<std::size_t>(pair.other_fabric)];
  return fmt::format("friction {} {} {}", first, second, format_number(pair.factor));
}

std::string solver(const design::SolverChoice& choice) {
  constexpr const char* kMethods[] = {"quasi_static", "dynamic_constraints", "implicit", "semi_implicit", "explicit"};
  std::string out = std::string("solver ") + kMethods[static_cast<int>(choice.method)];
  if (choice.step > 0) out += " step " + format_number(choice.step) + " s";
  if (choice.hysteresis) out += *choice.hysteresis ? " hysteresis on" : " hysteresis off";
  if (!choice.symmetric) out += " symmetric off";
  return out;
}

}  // namespace

std::vector<std::string> scene(const design::Garment& garment, const Names& names) {
  const design::Scene& all = garment.scene;
  std::vector<std::string> lines;
  for (const design::Path& p : all.paths) lines.push_back(path(p, names));
  for (const design::Clamp& c : all.clamps) lines.push_back(clamp(c, garment, names));
  for (const design::Force& f : all.forces)
    lines.push_back(fmt::format("force {} on {} at {} of {}", plain(f.name),
                                names.panels[static_cast<std::size_t>(f.panel)], point(f.point),
                                vector(f.newtons, "N")));
  for (const design::Pressure& p : all.pressures)
    lines.push_back(fmt::format("pressure {} on {} of {} Pa", plain(p.name),
                                names.panels[static_cast<std::size_t>(p.panel)], format_number(p.pascals)));
  for (const design::Constraint& c : all.constraints) lines.push_back(constraint(c, names));
  for (const design::FrictionPair& pair : all.frictions) lines.push_back(friction(pair, names));
  if (all.wind) {
    std::string line = "wind " + vector(all.wind->velocity, "m/s");
    if (all.wind->gust != 0) line += fmt::format(" gust {}%", format_number(100 * all.wind->gust));
    lines.push_back(line);
  }
  if (all.drag) lines.push_back("drag " + format_number(*all.drag));
  if (all.solver) lines.push_back(solver(*all.solver));
  return lines;
}

}  // namespace garment::interpreter::text
