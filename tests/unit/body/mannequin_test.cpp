#include "runtime/body/mannequin.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "runtime/base/parallel.hpp"
#include "runtime/base/portable_math.hpp"
#include "runtime/body/anatomy.hpp"
#include "runtime/body/measure.hpp"
#include "runtime/body/mesh_repair.hpp"
#include "runtime/body/shapes.hpp"
#include "tests/unit/body/meshes.hpp"
#include "tests/unit/body/size_table.hpp"

using namespace garment;
using namespace garment::body;
using design::Mannequin;

namespace {

Body built(const Mannequin& person) {
  BodyResult result = build_body(declare(person), system_host(), "");
  for (const Finding& f : result.findings) FAIL(f.code << " " << f.message);
  return *result.body;
}

std::string first_code(const BodyResult& result) {
  return result.findings.empty() ? "" : result.findings.front().code;
}

}  // namespace

TEST_CASE("every size is measured back to a millimetre on a sound, symmetric mesh") {
  std::map<Mannequin::Sex, Body> before;
  std::map<Mannequin::Sex, Mannequin> measures_before;
  for (const SizeRow& row : size_table()) {
    const auto& m = row.person.measures;
    bool woman = row.person.sex == Mannequin::Sex::woman;
    INFO((woman ? "woman " : "man ") << row.person.size);
    Body body = built(row.person);

    SurfaceCheck check = check_surface(body.mesh);
    CHECK(check.open_edges == 0);
    CHECK(check.twisted_edges == 0);
    CHECK(check.crowded_edges == 0);
    CHECK(body.mesh.vertices.size() * 2 == body.mesh.triangles.size() + 4);  // one piece without handles
    CHECK(smallest_angle(body.mesh) > 12);
    std::set<std::array<double, 3>> places;
    for (const Vector3d& p : body.mesh.vertices) places.insert({p.x(), p.y(), p.z()});
    CHECK(places.size() == body.mesh.vertices.size());
    bool symmetric = true;
    for (const auto& p : places) symmetric = symmetric && places.count({-p[0], p[1], p[2]});
    CHECK(symmetric);

    // The girths once more, by the general tape and not by the builder's own.
    double low = 1, high = 0;
    for (const Vector3d& p : body.mesh.vertices) low = std::min(low, p.y()), high = std::max(high, p.y());
    CHECK(low == 0);
    CHECK(high == Approx(m.at("stature")).margin(0.002));
    const std::pair<const char*, const char*> kTapes[] = {{"bust", "bust_chest"},
                                                          {"waist", "waist"},
                                                          {"hip", "hip"},
                                                          {"neck", "neckcircumference"},
                                                          {"thigh", "thighcircumference"},
                                                          {"lower_thigh", "lowerthighcircumference"},
                                                          {"calf", "calfcircumference"},
                                                          {"ankle", "anklecircumference"},
                                                          {"underbust", "underbust"}};
    for (auto [level, measure] : kTapes) {
      if (!m.count(measure)) continue;
      INFO(level);
      REQUIRE(body.levels.count(level));
      CHECK(girth(body, body.levels.at(level).height) == Approx(m.at(measure)).margin(0.001));
      CHECK(body.levels.at(level).girth == Approx(m.at(measure)).margin(0.001));
    }
    CHECK(body.levels.at("biceps").girth == Approx(m.at("bicepscircumferenceflexed")).margin(0.001));
    CHECK(body.levels.at("wrist").girth == Approx(m.at("wristcircumference")).margin(0.001));
    CHECK(body.levels.at("crotch").height == Approx(m.at("crotchheight")).margin(0.015));
    CHECK(body.levels.at("armpit").height == Approx(m.at("axillaheight")).margin(0.04));
    CHECK(body.levels.at("hip").height == Approx(m.at("trochanterionheight")).margin(0.001));
    CHECK(body.levels.at("waist").height == Approx((woman ? 0.649 : 0.638) * m.at("stature")).margin(0.001));
    // A body weighs about a kilogram a litre.
    CHECK(signed_volume(body.mesh) * 1000 == Approx(row.weight).epsilon(0.06));
    for (const char* part : {"torso", "neck", "head", "arm.left", "arm.right", "leg.left", "leg.right"})
      CHECK(body.parts.count(part));

    // Larger sizes are larger at every tape that grows in the table.
    if (auto smaller = before.find(row.person.sex); smaller != before.end())
      for (auto [level, measure] : kTapes)
        if (m.count(measure) && m.at(measure) > measures_before[row.person.sex].measures.at(measure) + 0.001)
          CHECK(body.levels.at(level).girth > smaller->second.levels.at(level).girth);
    before[row.person.sex] = std::move(body);
    measures_before[row.person.sex] = row.person;
  }
}

TEST_CASE("a mannequin looks like a person") {
  for (const SizeRow& row : size_table()) {
    if (row.person.size != 38 && row.person.size != 50) continue;
    Body body = built(row.person);
    auto depth = [&](const char* level, bool front) {
      double z = 0;
      for (const Vector2d& p : hull_section(body, body.levels.at(level).height))
        z = front ? std::max(z, -p.y()) : std::max(z, p.y());
      return z;
    };
    CHECK(depth("bust", true) > depth("underbust", true));       // breast or chest stands out
    CHECK(depth("hip", false) > depth("waist", false) + 0.02);   // buttocks
    CHECK(depth("bust", false) > depth("waist", false) + 0.01);  // the hollow of the back
    CHECK(body.levels.at("waist").girth < body.levels.at("hip").girth);
    const Part& arm = body.parts.at("arm.left");
    CHECK(arm.sections.front().center.x() > 0.1);
    CHECK(arm.sections.front().center.y() > body.levels.at("bust").height);
    Vector3d way = arm.sections.back().center - arm.sections.front().center;
    CHECK(std::atan2(way.x(), -way.y()) * 180 / portable::kPi == Approx(40).margin(3));
    CHECK(way.norm() == Approx(row.person.measures.at("sleeveoutseam")).margin(0.08));
    CHECK(body.parts.at("arm.right").sections.front().center.x() < 0);
    for (const auto& [name, part] : body.parts)
      for (const Section& s : part.sections) {
        INFO(name);
        CHECK((s.u.cross(s.v) - s.axis).norm() < 1e-9);
        CHECK(loop_area(s.hull) > 0);
      }
    // Nothing of the trunk looks into the body: the winding number agrees with the signed distance.
    for (const auto& [name, part] : body.parts)
      for (const Section& s : part.sections) {
        if (name.substr(0, 3) == "arm") continue;
        auto hit = body.closest(s.center, 1);
        REQUIRE(hit);
        CHECK(hit->distance < 0);
        CHECK(body.inside(s.center));
      }
  }
}

TEST_CASE("a mannequin is the same on every run and thread count") {
  for (const SizeRow& row : size_table()) {
    if (row.person.size != 40) continue;
    int threads = thread_count();
    set_thread_count(1);
    MannequinResult a = build_mannequin(*check_measures(row.person, "a", {}).measures);
    set_thread_count(4);
    MannequinResult b = build_mannequin(*check_measures(row.person, "b", {}).measures);
    set_thread_count(threads);
    CHECK(a.mesh.vertices == b.mesh.vertices);
    CHECK(a.mesh.triangles == b.mesh.triangles);
  }
}

TEST_CASE("odd but possible wishes still come out true") {
  for (const SizeRow& row : size_table()) {
    if (row.person.size != 38 && row.person.size != 48) continue;
    for (auto [name, factor] : {std::pair{"bust_chest", 1.10},
                                {"waist", 0.88},
                                {"waist", 1.25},
                                {"hip", 1.1},
                                {"thighcircumference", 0.9},
                                {"neckcircumference", 1.15}}) {
      Mannequin person = row.person;
      person.measures[name] *= factor;
      INFO(row.person.size << ": " << name << " x " << factor);
      BodyResult result = build_body(declare(person), system_host(), "");
      CHECK((result.findings.empty() ? "" : result.findings[0].message) == "");
      if (!result.body) continue;
      SurfaceCheck check = check_surface(result.body->mesh);
      CHECK(check.open_edges + check.twisted_edges + check.crowded_edges == 0);
    }
  }
}

TEST_CASE("unsound measures end in coded errors") {
  Mannequin nobody;
  BodyResult result = build_body(declare(nobody), system_host(), "");
  CHECK_FALSE(result.body);
  CHECK(first_code(result) == "G0710");
  CHECK(result.findings[0].message.find("`bust_chest`") != std::string::npos);
  for (const SizeRow& row : size_table()) {
    if (row.person.size != 38) continue;
    auto code_with = [&](const char* name, double value) {
      Mannequin person = row.person;
      person.measures[name] = value;
      BodyResult r = build_body(declare(person), system_host(), "");
      CHECK_FALSE(r.body);
      return first_code(r);
    };
    CHECK(code_with("stature", 168) == "G0711");  // centimetres
    CHECK(code_with("stature", std::nan("")) == "G0711");
    CHECK(code_with("waist", -0.7) == "G0711");
    CHECK(code_with("waist", 72) == "G0711");
    CHECK(code_with("crotchheight", 0.93) == "G0711");
    CHECK(code_with("bust_chest", 0.70) == "G0711");  // below the underbust
    Mannequin person = row.person;
    person.measures.erase("calfcircumference");
    CHECK(first_code(build_body(declare(person), system_host(), "")) == "G0710");
  }
}
