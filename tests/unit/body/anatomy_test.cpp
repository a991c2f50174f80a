#include "runtime/body/anatomy.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "runtime/body/measure.hpp"
#include "runtime/body/shapes.hpp"
#include "tests/unit/body/meshes.hpp"

using namespace garment;
using namespace garment::body;

namespace {

BodyResult load(const std::string& file) {
  design::Body declared;
  declared.name = file;
  declared.shape = design::MeshFile{kBodies + file, 1};
  return build_body(declared, system_host(), "");
}

bool data_present() {
  if (system_host().read_file(kBodies + "f_smpl_average_A40.obj", 100'000'000)) return true;
  WARN("skipped: no bodies in " GARMENT_DATA_DIR);
  return false;
}

struct Expected {
  const char* file;
  double stature, waist, bust, underbust, hip, arm;  // m; hand-taken measures come with the meshes
};

}  // namespace

TEST_CASE("levels and parts are found on scanned people") {
  if (!data_present()) return;
  const Expected kPeople[] = {
      {"f_smpl_average_A40.obj", 1.658, 0.80, 0.96, 0.83, 1.05, 0.42},
      {"f_smpl_template.obj", 1.658, 0.80, 0.96, 0.83, 1.05, 0.42},
      {"m_smpl_average_A40.obj", 1.791, 0.92, 1.01, 0.95, 1.02, 0.45},
  };
  for (const Expected& e : kPeople) {
    INFO(e.file);
    BodyResult result = load(e.file);
    REQUIRE(result.body);
    const Body& body = *result.body;
    auto level = [&](const char* name) {
      INFO(name);
      REQUIRE(body.levels.count(name));
      return body.levels.at(name);
    };
    double low = 1e9;
    for (const Vector3d& p : body.mesh.vertices) low = std::min(low, p.y());
    CHECK(level("waist").girth == Approx(e.waist).margin(0.03));
    CHECK(level("bust").girth == Approx(e.bust).margin(0.03));
    CHECK(level("underbust").girth == Approx(e.underbust).margin(0.03));
    CHECK(level("hip").girth == Approx(e.hip).margin(0.03));
    const char* kUpwards[] = {"ankle",     "calf", "knee",   "thigh",    "crotch", "hip", "waist",
                              "underbust", "bust", "armpit", "shoulder", "neck",   "head"};
    for (std::size_t i = 1; i < std::size(kUpwards); ++i) {
      INFO(kUpwards[i]);
      CHECK(level(kUpwards[i]).height > level(kUpwards[i - 1]).height);
    }
    CHECK((level("waist").height - low) / e.stature == Approx(0.645).margin(0.03));
    CHECK((level("crotch").height - low) / e.stature == Approx(0.47).margin(0.02));
    CHECK((level("armpit").height - low) / e.stature == Approx(0.757).margin(0.02));
    CHECK(level("wrist").girth == Approx(0.16).margin(0.015));
    CHECK(level("biceps").girth == Approx(0.285).margin(0.03));
    for (const auto& [name, part] : body.parts) {
      INFO(name);
      CHECK(part.name == name);
      REQUIRE(part.sections.size() >= 2);
      for (std::size_t i = 0; i < part.sections.size(); ++i) {
        const Section& s = part.sections[i];
        CHECK((s.u.cross(s.v) - s.axis).norm() < 1e-9);
        CHECK(loop_area(s.hull) > 0);
        CHECK(convex_hull(s.hull).size() == s.hull.size());
        if (i > 0) CHECK((s.center - part.sections[i - 1].center).dot(s.axis) > 0);
      }
    }
    for (const char* side : {"left", "right"}) {
      double sign = std::string(side) == "left" ? 1 : -1;
      const Part& arm = body.parts.at(std::string("arm.") + side);
      const Part& leg = body.parts.at(std::string("leg.") + side);
      CHECK(arm.sections.front().center.x() * sign > 0.1);
      CHECK(arm.sections.back().center.x() * sign > 0.4);
      CHECK((arm.sections.back().center - arm.sections.front().center).norm() ==
            Approx(e.arm + 0.04).margin(0.08));
      CHECK(leg.sections.front().center.x() * sign > 0.04);
      CHECK(leg.sections.front().center.y() > leg.sections.back().center.y());
    }
    const Part& torso = body.parts.at("torso");
    for (const Section& s : torso.sections)
      CHECK(loop_high(s.hull).x() - loop_low(s.hull).x() < 0.45);  // no arms
    CHECK(torso.sections.size() > 28);
    CHECK(girth(body, level("waist").height) == Approx(level("waist").girth).margin(1e-9));
    CHECK(girth(body, level("knee").height) == Approx(level("knee").girth).margin(1e-9));
    CHECK(girth(body, 5) == 0);
    MeasureTable table = measure(body);
    CHECK(table.size() == body.levels.size());
    CHECK(table.front().level == "head");
    CHECK(table.back().level == "ankle");
    CHECK(table.back().height > 0);
  }
}

TEST_CASE("the same woman in two poses has the same torso") {
  if (!data_present()) return;
  Body a = *load("f_smpl_average_A40.obj").body, t = *load("f_smpl_template.obj").body;
  for (const char* level : {"neck", "waist", "hip", "thigh", "knee", "calf", "ankle"}) {
    INFO(level);
    CHECK(a.levels.at(level).girth == Approx(t.levels.at(level).girth).margin(0.006));
    CHECK(a.levels.at(level).height == Approx(t.levels.at(level).height + 1.12073).margin(0.01));
  }
}

TEST_CASE("a scanned body that overlaps itself is solid all the same") {
  if (!data_present()) return;
  Body body = *load("f_smpl_average_A40.obj").body;
  int wrong = 0, asked = 0;
  for (std::size_t i = 0; i < body.mesh.triangles.size(); i += 7) {
    const auto& t = body.mesh.triangles[i];
    Vector3d middle = (body.mesh.vertices[t[0]] + body.mesh.vertices[t[1]] + body.mesh.vertices[t[2]]) / 3;
    Vector3d out = (body.mesh.vertices[t[1]] - body.mesh.vertices[t[0]])
                       .cross(body.mesh.vertices[t[2]] - body.mesh.vertices[t[0]])
                       .normalized();
    for (double side : {-0.002, 0.002}) {
      Vector3d p = middle + side * out;
      auto hit = body.closest(p, 1);
      REQUIRE(hit);
      ++asked;
      if ((hit->distance < 0) != body.inside(p)) ++wrong;
    }
  }
  CHECK(asked > 3000);
  CHECK(wrong < asked / 100);  // only between the fingers
}

TEST_CASE("a mesh that is no person has no levels, and that is no error") {
  for (const design::Body& declared : {design::Body{"ball", {}, design::Sphere{0.5}, {0, 1, 0}, 0.3},
                                       design::Body{"table", {}, design::Cylinder{0.5, 1.2}},
                                       design::Body{"box", {}, design::Box{{0.5, 1.7, 0.3}}}}) {
    CHECK_FALSE(find_landmarks(build_body(declared, system_host(), "").body->mesh));
    Body body = *build_body(declared, system_host(), "").body;
    CHECK(body.levels.empty());
    CHECK(body.parts.empty());
    CHECK(measure(body).size() == 1);
  }
  CHECK_FALSE(find_landmarks({}));
  CHECK_FALSE(find_landmarks(cylinder_mesh(0.2, 1.7)));
}
