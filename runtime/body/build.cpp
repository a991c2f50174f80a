// From the declared body to one that is ready for use.
#include <fmt/format.h>

#include <cmath>

#include "runtime/base/number.hpp"
#include "runtime/body/anatomy.hpp"
#include "runtime/body/mannequin.hpp"
#include "runtime/body/obj_reader.hpp"
#include "runtime/body/shapes.hpp"

namespace garment::body {
namespace {

constexpr double kSmallest = 0.001, kLargest = 20, kFarthest = 1000;  // m
constexpr double kMostFriction = 10;
constexpr double kGirthTolerance = 0.001;  // m

class BodyBuilder {
 public:
  BodyBuilder(const design::Body& declared, Host& host, const std::string& base_folder)
      : declared_(declared), host_(host), base_folder_(base_folder) {}

  BodyResult run() {
    for (double p : {declared_.position.x(), declared_.position.y(), declared_.position.z()})
      check("position", p, -kFarthest, kFarthest);
    check("friction", declared_.friction, 0, kMostFriction);
    body_.name = declared_.name;
    body_.friction = declared_.friction;
    if (!has_errors(findings_)) std::visit([&](const auto& shape) { make(shape); }, declared_.shape);
    BodyResult result;
    if (!has_errors(findings_)) {
      move();
      build_index(body_);
      result.body = std::move(body_);
    }
    result.findings = std::move(findings_);
    return result;
  }

 private:
  void make(const design::Sphere& s) {
    if (check("radius", s.radius, kSmallest, kLargest))
      body_.mesh = ellipsoid_mesh(Vector3d::Constant(s.radius));
  }
  void make(const design::Ellipsoid& e) {
    bool ok = true;
    for (double a : {e.semi_axes.x(), e.semi_axes.y(), e.semi_axes.z()})
      ok = check("semi-axis", a, kSmallest, kLargest) && ok;
    if (ok) body_.mesh = ellipsoid_mesh(e.semi_axes);
  }
  void make(const design::Cylinder& c) {
    bool ok = check("radius", c.radius, kSmallest, kLargest);
    if (check("height", c.height, kSmallest, kLargest) && ok) body_.mesh = cylinder_mesh(c.radius, c.height);
  }
  void make(const design::Box& b) {
    bool ok = true;
    for (double a : {b.size.x(), b.size.y(), b.size.z()}) ok = check("size", a, kSmallest, kLargest) && ok;
    if (ok) body_.mesh = box_mesh(b.size);
  }
  void make(const design::Floor&) { body_.mesh = floor_mesh(); }

  void make(const design::MeshFile& file) {
    if (!check("scale", file.scale, 1e-6, 1e6)) return;
    bool absolute = !file.path.empty() && file.path.front() == '/';
    std::string path = absolute || base_folder_.empty() ? file.path : base_folder_ + "/" + file.path;
    HostResult<std::string> text = host_.read_file(path, kMaxObjBytes);
    if (!text) {
      fail("G0701", fmt::format("`{}` cannot be read: {}", file.path, text.error.message),
           text.error.denied ? "put the file itself beside the script, or grant its folder with `--allow-read`"
                             : "check the path; it counts from the folder of the script");
      return;
    }
    MeshResult result = read_obj(*text.value, file.scale, file.path, declared_.origin);
    findings_.insert(findings_.end(), result.findings.begin(), result.findings.end());
    if (!result.mesh) return;
    body_.mesh = std::move(*result.mesh);
    add_anatomy();  // a mesh that is no person has no levels: not an error
  }

  void make(const design::Mannequin& mannequin) {
    MeasuresResult checked = check_measures(mannequin, declared_.name, declared_.origin);
    findings_.insert(findings_.end(), checked.findings.begin(), checked.findings.end());
    if (!checked.measures) return;
    MannequinResult built = build_mannequin(*checked.measures);
    if (built.worst > kGirthTolerance) {
      double reached = built.levels[built.worst_tape.level].girth;
      fail("G0712",
           fmt::format("the {} of body `{}` came out at {} cm; the tape says {} cm", built.worst_tape.level,
                       declared_.name, format_number(100 * reached, 4),
                       format_number(100 * built.worst_tape.target, 4)),
           "the measures contradict each other: change this one or those beside it");
      return;
    }
    body_.mesh = std::move(built.mesh);
    add_anatomy();
    for (const auto& [name, level] : built.levels) body_.levels[name] = level;
  }

  void add_anatomy() {
    std::optional<Landmarks> marks = find_landmarks(body_.mesh);
    if (!marks) return;
    body_.parts = find_parts(body_.mesh, *marks);
    body_.levels = find_levels(body_.mesh, *marks, body_.parts);
  }

  void move() {
    for (Vector3d& p : body_.mesh.vertices) p += declared_.position;
    for (auto& [name, level] : body_.levels) level.height += declared_.position.y();
    for (auto& [name, part] : body_.parts)
      for (Section& section : part.sections) section.center += declared_.position;
  }

  bool check(const char* what, double value, double low, double high) {
    if (value >= low && value <= high) return true;
    fail("G0713",
         fmt::format("the {} of body `{}` is {}; it must lie between {} and {}", what, declared_.name,
                     format_number(value, 6), format_number(low), format_number(high)),
         "check the number and its unit");
    return false;
  }

  void fail(const char* code, std::string message, std::string help) {
    findings_.push_back(
        {code, Severity::error, std::move(message), {{declared_.origin, ""}}, std::move(help)});
  }

  const design::Body& declared_;
  Host& host_;
  const std::string& base_folder_;
  Body body_;
  Findings findings_;
};

}  // namespace

BodyResult build_body(const design::Body& declared, Host& host, const std::string& base_folder) {
  return BodyBuilder(declared, host, base_folder).run();
}

}  // namespace garment::body
