// The tape on mannequins whose measures are stated, on scans, and on copies of them that lie otherwise in
// their file.
#include "runtime/body/person.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "runtime/base/number.hpp"
#include "runtime/body/frame.hpp"
#include "runtime/body/mend.hpp"
#include "runtime/body/mesh_repair.hpp"
#include "runtime/body/obj_reader.hpp"
#include "runtime/body/shapes.hpp"
#include "runtime/body/stance.hpp"
#include "tests/unit/body/meshes.hpp"
#include "tests/unit/body/size_table.hpp"

using namespace garment;
using namespace garment::body;

namespace {

std::map<std::string, PersonMeasure> by_name(const std::vector<PersonMeasure>& all) {
  std::map<std::string, PersonMeasure> out;
  for (const PersonMeasure& m : all) out[m.name] = m;
  return out;
}

StanceResult stand(TriangleMesh mesh, std::optional<double> unit = std::nullopt) {
  clean_mesh(mesh);
  mend(mesh);
  return find_stance(mesh, unit, "body.obj");
}

std::map<std::string, PersonMeasure> measured(const TriangleMesh& mesh) {
  const StanceResult found = stand(mesh);
  for (const Finding& f : found.findings) INFO(f.code << " " << f.message);
  REQUIRE(found.stance);
  return by_name(measure_person(found.stance->mesh, found.stance->marks, found.stance->head));
}

std::optional<TriangleMesh> scan(const std::string& file) {
  const auto text = system_host().read_file(kBodies + file, kMaxObjBytes);
  if (!text) {
    WARN("skipped: no " << file << " in " GARMENT_DATA_DIR);
    return std::nullopt;
  }
  return read_obj_as_is(*text.value, file).mesh;
}

TriangleMesh moved(TriangleMesh mesh, const Eigen::Matrix3d& turn, double scale, const Vector3d& shift) {
  for (Vector3d& p : mesh.vertices) p = scale * (turn * p) + shift;
  if (turn.determinant() < 0)
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

void same_measures(const std::map<std::string, PersonMeasure>& a,
                   const std::map<std::string, PersonMeasure>& b, double margin) {
  CHECK(a.size() == b.size());
  for (const auto& [name, m] : a) {
    INFO(name);
    REQUIRE(b.count(name));
    CHECK(b.at(name).size == Approx(m.size).margin(margin));
    if (m.height) CHECK(*b.at(name).height == Approx(*m.height).margin(margin));
  }
}

const char* code_of(const StanceResult& r) {
  return r.findings.empty() ? "" : r.findings.front().code.c_str();
}

}  // namespace

TEST_CASE("the tape finds the stated measures on mannequins of all sizes") {
  // Where the sheet speaks of another place: the armpit of the table is a point of bone, the fullest place of
  // an upper arm is anywhere on its muscle, a man's waist is flat down to the navel.
  const std::map<std::string, double> kHeightMargins = {
      {"armpit", 0.04}, {"biceps", 0.03}, {"waist", 0.035}, {"wrist", 0.025}};
  const std::map<std::string, double> kLengthMargins = {
      {"stature", 0.001},      {"crotch_height", 0.005},   {"hip_breadth", 0.01},
      {"sleeve_length", 0.03}, {"upper_arm_length", 0.03}, {"shoulder_breadth", 0.04}};
  for (const SizeRow& row : size_table()) {
    INFO((row.person.sex == design::Mannequin::Sex::woman ? "woman " : "man ") << row.person.size);
    const design::Body declared = declare(row.person);
    const BodyResult built = build_body(declared, system_host(), "");
    REQUIRE(built.body);
    const FrameResult frame = make_frame(declared);
    REQUIRE(frame.frame);
    auto found = measured(built.body->mesh);
    int girths = 0;
    for (const auto& [name, level] : frame.frame->levels) {
      INFO(name);
      REQUIRE((found.count(name) || name == "lower_thigh"));
      if (!found.count(name)) continue;
      const auto margin = kHeightMargins.find(name);
      girths += level.girth.has_value();
      if (level.girth) CHECK(found[name].size == Approx(*level.girth).margin(0.02));
      if (level.height)
        CHECK(*found[name].height ==
              Approx(*level.height).margin(margin == kHeightMargins.end() ? 0.02 : margin->second));
    }
    CHECK(girths >= 10);
    for (const auto& [name, margin] : kLengthMargins) {
      INFO(name);
      REQUIRE(found.count(name));
      CHECK(found[name].size == Approx(frame.frame->lengths.at(name)).margin(margin));
    }
  }
}

TEST_CASE("the tape agrees with measures taken by hand on scans") {
  struct Hand {
    const char* file;
    double stature, bust, underbust, waist, hip, wrist, shoulders, back;  // m, beside the meshes
  };
  // Where the sheet and the tape speak of other levels (the man's underbust and waist) the figure is that of
  // the anatomy test.
  const Hand kHands[] = {{"f_smpl_average_A40.obj", 1.658, 0.96, 0.83, 0.80, 1.05, 0.16, 0.38, 0.36},
                         {"f_smpl_template.obj", 1.658, 0.96, 0.83, 0.80, 1.05, 0.16, 0.37, 0.36},
                         {"m_smpl_average_A40.obj", 1.791, 1.01, 0.95, 0.92, 1.02, 0.17, 0.382, 0.38}};
  for (const Hand& hand : kHands) {
    const auto mesh = scan(hand.file);
    if (!mesh) return;
    INFO(hand.file);
    auto found = measured(*mesh);
    CHECK(found["stature"].size == Approx(hand.stature).margin(0.002));
    CHECK(found["bust"].size == Approx(hand.bust).margin(0.02));
    CHECK(found["underbust"].size == Approx(hand.underbust).margin(0.02));
    CHECK(found["waist"].size == Approx(hand.waist).margin(0.02));
    CHECK(found["hip"].size == Approx(hand.hip).margin(0.02));
    CHECK(found["wrist"].size == Approx(hand.wrist).margin(0.015));
    CHECK(found["shoulder_breadth"].size == Approx(hand.shoulders).margin(0.025));
    CHECK(found["back_length"].size == Approx(hand.back).margin(0.025));
  }
}

TEST_CASE("measures do not depend on how the body lies in its file") {
  for (const char* file : {"f_smpl_average_A40.obj", "m_smpl_average_A40.obj", "f_smpl_template.obj"}) {
    const auto mesh = scan(file);
    if (!mesh) return;
    INFO(file);
    const auto straight = measured(*mesh);
    using Eigen::AngleAxisd;
    const Vector3d x(1, 0, 0), y(0, 1, 0);
    const double right = M_PI / 2;
    const Eigen::Matrix3d z_up = AngleAxisd(right, x).toRotationMatrix();
    const struct {
      Eigen::Matrix3d turn;
      double scale;
      Vector3d shift;
    } kCopies[] = {{AngleAxisd(M_PI, y).toRotationMatrix(), 1, {3, -2, 5}},
                   {AngleAxisd(right, y).toRotationMatrix(), 100, {0, 0, 0}},
                   {AngleAxisd(-right, y).toRotationMatrix(), 1000, {10, 20, 30}},
                   {z_up, 1 / 0.0254, {0, 0, 0}},
                   {z_up * AngleAxisd(0.4, y).toRotationMatrix(), 100, {1, 2, 3}},
                   {AngleAxisd(2.5, y).toRotationMatrix(), 1, {0, 0, 0}}};
    for (const auto& copy : kCopies) {
      INFO("scale " << copy.scale);
      same_measures(straight, measured(moved(*mesh, copy.turn, copy.scale, copy.shift)), 0.001);
    }
  }
}

TEST_CASE("a body in its mirror has the same measures, the limbs of the other side") {
  const auto mesh = scan("m_smpl_average_A40.obj");
  if (!mesh) return;
  auto straight = measured(*mesh),
       mirrored = measured(moved(*mesh, Vector3d(-1, 1, 1).asDiagonal(), 1, {0, 0, 0}));
  // The section at the shoulder is cut off where the arms begin, and his shoulders differ.
  for (const char* name : {"shoulder", "shoulder_length"}) straight.erase(name), mirrored.erase(name);
  same_measures(straight, mirrored, 0.01);
}

TEST_CASE("holes, inside-out faces, doubled vertices and loose parts do not change a measure") {
  auto mesh = scan("f_smpl_average_A40.obj");
  if (!mesh) return;
  const auto whole = measured(*mesh);
  TriangleMesh worn;
  for (std::size_t t = 0; t < mesh->triangles.size(); ++t) {
    if (t % 500 == 7) continue;  // small holes all over
    std::array<int, 3> corners{};
    for (int k = 0; k < 3; ++k) {
      corners[k] = static_cast<int>(worn.vertices.size());
      worn.vertices.push_back(mesh->vertices[mesh->triangles[t][k]]);
    }
    if (t % 3 == 0) std::swap(corners[0], corners[1]);
    worn.triangles.push_back(corners);
  }
  TriangleMesh eye = ellipsoid_mesh(Vector3d::Constant(0.012));
  for (Vector3d& p : eye.vertices) p += Vector3d(0.03, 1.55, 0.05);
  const int first = static_cast<int>(worn.vertices.size());
  worn.vertices.insert(worn.vertices.end(), eye.vertices.begin(), eye.vertices.end());
  for (const auto& t : eye.triangles) worn.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  same_measures(whole, measured(worn), 0.004);
}

TEST_CASE("a mesh of quads has the measures of its triangles") {
  const auto mesh = scan("f_smpl_average_A40.obj");
  if (!mesh) return;
  // Every triangle in three: from its corners to the middles of its sides and its own middle.
  std::string text;
  int n = 0;
  auto vertex = [&](const Vector3d& p) {
    text += "v " + format_number(p.x()) + " " + format_number(p.y()) + " " + format_number(p.z()) + "\n";
    return ++n;
  };
  for (const auto& t : mesh->triangles) {
    int corner[3], side[3];
    Vector3d middle = Vector3d::Zero();
    for (int k = 0; k < 3; ++k) {
      // The middle of a side must come out the same from both its triangles.
      const Vector3d &a = mesh->vertices[std::min(t[k], t[(k + 1) % 3])],
                     &b = mesh->vertices[std::max(t[k], t[(k + 1) % 3])];
      corner[k] = vertex(mesh->vertices[t[k]]);
      side[k] = vertex(0.5 * (a + b));
      middle += mesh->vertices[t[k]] / 3;
    }
    const int center = vertex(middle);
    for (int k = 0; k < 3; ++k)
      text += "f " + std::to_string(corner[k]) + "/1 " + std::to_string(side[k]) + "/1 " +
              std::to_string(center) + "/1 " + std::to_string(side[(k + 2) % 3]) + "/1\n";
  }
  MeshResult read = read_obj_as_is(text, "quads.obj");
  REQUIRE(read.mesh);
  CHECK(mend(*read.mesh).holes == 0);
  same_measures(measured(*mesh), measured(*read.mesh), 0.001);
}

TEST_CASE("arms that hang are measured as those held out") {
  auto mesh = scan("f_smpl_template.obj");
  if (!mesh) return;
  const auto straight = measured(*mesh);
  double low = 1e9;
  for (const Vector3d& p : mesh->vertices) low = std::min(low, p.y());
  for (const double degrees : {40.0, 60.0, 72.0, 80.0}) {
    INFO(degrees);
    TriangleMesh bent = *mesh;
    for (Vector3d& p : bent.vertices) {
      // About the joint of the shoulder, softly from the trunk to the arm.
      double share = p.y() - low < 1.2 ? 0 : std::clamp((std::fabs(p.x()) - 0.15) / 0.08, 0.0, 1.0);
      share *= share * (3 - 2 * share);
      const double angle = -degrees * M_PI / 180 * share, side = p.x() > 0 ? 1 : -1;
      const double dx = side * p.x() - 0.17, dy = p.y() - low - 1.33;
      p.x() = side * (0.17 + dx * std::cos(angle) - dy * std::sin(angle));
      p.y() = low + 1.33 + dx * std::sin(angle) + dy * std::cos(angle);
    }
    auto found = measured(bent);
    for (const char* name : {"bust", "waist", "hip", "thigh", "neck", "biceps", "elbow", "wrist"}) {
      INFO(name);
      REQUIRE(found.count(name));
      CHECK(found[name].size == Approx(straight.at(name).size).margin(0.02));
    }
    CHECK(found["sleeve_length"].size == Approx(straight.at("sleeve_length").size).margin(0.04));
    CHECK(found["shoulder_breadth"].size == Approx(straight.at("shoulder_breadth").size).margin(0.06));
  }
}

TEST_CASE("without head and hands the rest is measured") {
  auto mesh = scan("f_smpl_average_A40.obj");
  if (!mesh) return;
  const auto whole = measured(*mesh);
  TriangleMesh cut = *mesh;
  std::erase_if(cut.triangles, [&](const std::array<int, 3>& t) {
    const Vector3d p = (cut.vertices[t[0]] + cut.vertices[t[1]] + cut.vertices[t[2]]) / 3;
    return p.y() > 1.46 || std::fabs(p.x()) > 0.56;
  });
  clean_mesh(cut);
  CHECK(mend(cut).holes == 3);
  const StanceResult found = find_stance(cut, std::nullopt, "torso.obj");
  REQUIRE(found.stance);
  CHECK_FALSE(found.stance->head);
  CHECK(std::string(code_of(found)) == "G0717");
  auto rest = by_name(measure_person(found.stance->mesh, found.stance->marks, false));
  CHECK(rest.count("stature") == 0);
  for (const char* name :
       {"neck", "bust", "underbust", "waist", "hip", "thigh", "knee", "calf", "ankle", "biceps"}) {
    INFO(name);
    REQUIRE(rest.count(name));
    CHECK(rest[name].size == Approx(whole.at(name).size).margin(0.015));
  }
}

TEST_CASE("what is no upright body says why") {
  const auto refused = [](const TriangleMesh& mesh, const char* why) {
    const StanceResult r = stand(mesh);
    REQUIRE_FALSE(r.stance);
    CHECK(std::string(code_of(r)) == "G0714");
    CHECK_THAT(r.findings.front().message, Catch::Contains(why));
  };
  refused(cylinder_mesh(0.2, 1.7), "two legs");
  refused(box_mesh({5, 5, 5}), "5 units high");
  const StanceResult scaled = find_stance(box_mesh({5, 5, 5}), 0.01, "box.obj");
  REQUIRE_FALSE(scaled.stance);
  CHECK_THAT(scaled.findings.front().message, Catch::Contains("0.05 m high"));
  refused(ellipsoid_mesh(Vector3d::Constant(0.9)), "two legs");
}
