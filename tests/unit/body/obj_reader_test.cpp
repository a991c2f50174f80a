#include "runtime/body/obj_reader.hpp"

#include <catch2/catch.hpp>
#include <random>

#include "runtime/body/shapes.hpp"

using namespace garment;
using namespace garment::body;

namespace {

const std::string kTetrahedron =
    "# a tetrahedron\nmtllib a.mtl\no thing\nv 0 0 0\nv 1 0 0 1.0 0.5 0.5\nv 0 1 0\nv 0 0 1\nvn 0 0 1\nvt 0 "
    "0\n"
    "usemtl x\ns off\nf 1 3 2\nf 1/1 2/1 4/1\nf 1//1 4//1 3//1\nf -3/1/1 -2/1/1 -1/1/1\n";

std::string code_of(const MeshResult& result) {
  return result.findings.empty() ? "" : result.findings.front().code;
}

MeshResult read(const std::string& text, double scale = 1) { return read_obj(text, scale, "body.obj", {}); }

}  // namespace

TEST_CASE("an OBJ file with all its trimmings is read") {
  MeshResult result = read(kTetrahedron);
  REQUIRE(result.mesh);
  CHECK(result.findings.empty());
  CHECK(result.mesh->vertices.size() == 4);
  CHECK(result.mesh->triangles.size() == 4);
  CHECK(signed_volume(*result.mesh) == Approx(1.0 / 6));
  CHECK(signed_volume(*read(kTetrahedron, 0.5).mesh) == Approx(1.0 / 48));
  std::string windows = kTetrahedron;
  for (std::size_t i = 0; (i = windows.find('\n', i)) != std::string::npos; i += 2)
    windows.replace(i, 1, "\r\n");
  CHECK(read(windows).mesh);
}

TEST_CASE("polygons become fans, unused and doubled vertices go") {
  std::string cube =
      "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
      "v 0 0 0\nv 1 0 0\n"  // doubles of 2 and 3, used by one face
      "f 5 4 3 2\nf 6 7 8 9\nf 10 11 7 6\nf 4 5 9 8\nf 3 4 8 7\nf 5 2 6 9\nf 2 2 3\n";
  MeshResult result = read(cube);
  REQUIRE(result.mesh);
  CHECK(result.mesh->vertices.size() == 8);
  CHECK(result.mesh->triangles.size() == 12);
  CHECK(signed_volume(*result.mesh) == Approx(1));
  CHECK(code_of(result) == "G0709");
}

TEST_CASE("inward surfaces are turned and said") {
  MeshResult result = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n");
  REQUIRE(result.mesh);
  CHECK(signed_volume(*result.mesh) > 0);
  CHECK(code_of(result) == "G0708");
}

TEST_CASE("unsound OBJ files end in coded errors") {
  auto fails = [](const std::string& text, const char* code) {
    MeshResult result = read(text);
    INFO(text.substr(0, 60));
    CHECK_FALSE(result.mesh);
    CHECK(code_of(result) == code);
    if (result.findings.empty()) return;
    CHECK(result.findings.size() == 1);
    CHECK_FALSE(result.findings[0].message.empty());
    CHECK_FALSE(result.findings[0].help.empty());
  };
  fails("", "G0702");
  fails("# nothing\n", "G0702");
  fails("v 0 0 0\nv 1 0 0\nv 0 1 0\n", "G0702");
  fails(std::string("v 0 0\0 0", 8), "G0702");
  fails("v 0 0 0\nv 1 0 0\nf 1 1 1\nf 1 2 2\n", "G0702");
  fails("v 0 0", "G0703");
  fails("v 0 nan 0\n", "G0703");
  fails("v 0 1e999 0\n", "G0703");
  fails("v 0 x 0\n", "G0703");
  fails("v 0 0 0\nf 1 2 3\n", "G0703");
  fails("v 0 0 0\nf 0 1 1\n", "G0703");
  fails("v 0 0 0\nf -2 1 1\n", "G0703");
  fails("v 0 0 0\nf 1 1\n", "G0703");
  fails("v 0 0 0\nf 1.5 1 1\n", "G0703");
  fails("v 0 0 0\nf 1e300 1 1\n", "G0703");
  fails("v 0 0 1e5\n", "G0704");
  fails(kTetrahedron.substr(0, kTetrahedron.rfind("f ")), "G0705");
  std::string twisted = kTetrahedron;
  twisted.replace(twisted.find("f 1 3 2"), 7, "f 1 2 3");
  fails(twisted, "G0706");
}

TEST_CASE("units are doubted aloud") {
  MeshResult tall = read(kTetrahedron, 170);
  REQUIRE(tall.mesh);
  CHECK(code_of(tall) == "G0707");
  CHECK(tall.findings[0].help == "add `scale: 0.01`");
  CHECK(read(kTetrahedron, 1700).findings[0].help == "add `scale: 0.001`");
  CHECK(code_of(read(kTetrahedron, 0.01)) == "G0707");
}

TEST_CASE("damaged OBJ files never crash the reader") {
  std::mt19937 random(3);
  for (int i = 0; i < 3000; ++i) {
    std::string text = kTetrahedron;
    for (unsigned k = 0; k < 1 + random() % 6; ++k) {
      std::size_t at = random() % text.size();
      switch (random() % 3) {
        case 0:
          text[at] = static_cast<char>(random() % 256);
          break;
        case 1:
          text.erase(at, 1 + random() % 5);
          break;
        default:
          text.insert(at,
                      std::string(1 + random() % 3, static_cast<char>("0123456789/-. \nfv"[random() % 17])));
      }
      if (text.empty()) text = "v";
    }
    MeshResult result = read(text);
    CHECK(result.mesh.has_value() != has_errors(result.findings));
  }
}
