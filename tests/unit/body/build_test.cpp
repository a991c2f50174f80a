#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <map>

#include "runtime/body/body.hpp"
#include "runtime/body/shapes.hpp"

using namespace garment;
using namespace garment::body;

namespace {

/// Files that live in memory.
class MemoryHost : public Host {
 public:
  std::map<std::string, std::string> files;
  HostResult<std::string> read_file(const std::string& path, std::uint64_t) override {
    auto it = files.find(path);
    if (it == files.end()) return {std::nullopt, {"no such file"}};
    return {it->second, {}};
  }
  HostResult<bool> write_file(const std::string&, std::string_view) override {
    return {std::nullopt, {"read-only"}};
  }
  double seconds() override { return 0; }
  bool interrupted() override { return false; }
  std::uint64_t peak_memory() override { return 0; }
};

design::Body declare(decltype(design::Body::shape) shape, Vector3d position = Vector3d::Zero()) {
  design::Body body;
  body.name = "thing";
  body.origin = OriginId{7};
  body.shape = std::move(shape);
  body.position = position;
  return body;
}

}  // namespace

TEST_CASE("declared shapes stand at their positions") {
  MemoryHost host;
  auto distance = [&](const design::Body& declared, const Vector3d& p) {
    BodyResult result = build_body(declared, host, "");
    REQUIRE(result.body);
    CHECK(result.findings.empty());
    CHECK(result.body->name == "thing");
    return result.body->closest(p, 100)->distance;
  };
  CHECK(distance(declare(design::Sphere{0.2}, {1, 2, 3}), {1.5, 2, 3}) == Approx(0.3).margin(0.001));
  CHECK(distance(declare(design::Sphere{0.2}, {1, 2, 3}), {1, 2, 3}) < -0.19);
  CHECK(distance(declare(design::Ellipsoid{{0.3, 0.2, 0.1}}), {0, 0.5, 0}) == Approx(0.3).margin(0.001));
  CHECK(distance(declare(design::Cylinder{0.2, 0.7}, {0, 0.1, 0}), {0, 1, 0}) == Approx(0.2).margin(1e-9));
  CHECK(distance(declare(design::Box{{0.2, 0.4, 0.6}}, {0, 1, 0}), {0, 1.3, 0}) == Approx(0.1).margin(1e-9));
  CHECK(distance(declare(design::Floor{}, {0, 0.5, 0}), {1, 0.7, -1}) == Approx(0.2).margin(1e-9));
}

TEST_CASE("mesh bodies are read beside the script and scaled") {
  MemoryHost host;
  host.files["scripts/tet.obj"] =
      "v 0 0 0\nv 100 0 0\nv 0 100 0\nv 0 0 100\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  BodyResult result = build_body(declare(design::MeshFile{"tet.obj", 0.01}, {0, 1, 0}), host, "scripts");
  REQUIRE(result.body);
  CHECK(signed_volume(result.body->mesh) == Approx(1.0 / 6));
  CHECK(result.body->inside({0.1, 1.1, 0.1}));
  CHECK_FALSE(result.body->inside({0.1, 0.9, 0.1}));
  result = build_body(declare(design::MeshFile{"gone.obj", 1}), host, "scripts");
  CHECK_FALSE(result.body);
  REQUIRE(result.findings.size() == 1);
  CHECK(result.findings[0].code == "G0701");
  CHECK(result.findings[0].labels.at(0).origin.value == 7);
  host.files["empty.obj"] = "";
  CHECK(build_body(declare(design::MeshFile{"empty.obj", 1}), host, "").findings.at(0).code == "G0702");
}

TEST_CASE("sizes out of range end in a coded error") {
  MemoryHost host;
  double nan = std::numeric_limits<double>::quiet_NaN();
  for (const design::Body& declared :
       {declare(design::Sphere{0}), declare(design::Sphere{-1}), declare(design::Sphere{nan}),
        declare(design::Sphere{1e9}), declare(design::Ellipsoid{{0.1, 0, 0.1}}),
        declare(design::Cylinder{0.1, nan}), declare(design::Cylinder{1e-9, 1}),
        declare(design::Box{{0.1, 1e5, 0.1}}), declare(design::Sphere{0.1}, {nan, 0, 0}),
        declare(design::Floor{}, {0, 1e7, 0}), declare(design::MeshFile{"a.obj", 0}),
        declare(design::MeshFile{"a.obj", nan})}) {
    BodyResult result = build_body(declared, host, "");
    CHECK_FALSE(result.body);
    REQUIRE_FALSE(result.findings.empty());
    CHECK(result.findings[0].code == "G0713");
  }
  design::Body sticky = declare(design::Sphere{0.1});
  sticky.friction = -0.1;
  CHECK(build_body(sticky, host, "").findings.at(0).code == "G0713");
}
