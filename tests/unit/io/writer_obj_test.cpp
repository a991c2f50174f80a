#include <catch2/catch.hpp>
#include <sstream>

#include "runtime/base/number.hpp"
#include "runtime/io/mesh_writers.hpp"
#include "tests/support/draped_skirt.hpp"

using namespace garment;

namespace {

struct Obj {
  std::vector<std::array<double, 3>> v;
  std::vector<std::array<double, 2>> vt;
  std::vector<std::array<std::array<int, 2>, 3>> f;
  std::vector<std::string> groups, objects;
};

Obj obj_of(const std::string& text) {
  Obj out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::vector<std::string> w;
    for (std::string word; words >> word;) w.push_back(word);
    if (w.empty() || w[0][0] == '#') continue;
    auto number = [&](int k) { return parse_number(w.at(k)).value(); };
    if (w[0] == "v") out.v.push_back({number(1), number(2), number(3)});
    if (w[0] == "vt") out.vt.push_back({number(1), number(2)});
    if (w[0] == "g") out.groups.push_back(w.at(1));
    if (w[0] == "o") out.objects.push_back(w.at(1));
    if (w[0] == "f") {
      out.f.emplace_back();
      for (int k = 0; k < 3; ++k) {
        const auto slash = w.at(k + 1).find('/');
        out.f.back()[k] = {std::stoi(w[k + 1]),
                           slash == std::string::npos ? 0 : std::stoi(w[k + 1].substr(slash + 1))};
      }
    }
  }
  return out;
}

}  // namespace

TEST_CASE("OBJ reads back to the same doubles, welded along seams", "[writer]") {
  test::DrapedSkirt skirt = test::make_skirt(24, 8);
  skirt.state.position[3] = {1.0 / 3, 5e-324, -1.7976931348623157e308};
  const Obj obj = obj_of(io::write_obj(skirt.model, skirt.state));
  REQUIRE(obj.v.size() == skirt.model.n_particles());
  for (std::size_t p = 0; p < obj.v.size(); ++p)
    for (int d = 0; d < 3; ++d) REQUIRE(obj.v[p][d] == skirt.state.position[p][d]);
  REQUIRE(obj.vt.size() == skirt.model.n_vertices());
  for (std::size_t v = 0; v < obj.vt.size(); ++v)
    for (int d = 0; d < 2; ++d) REQUIRE(obj.vt[v][d] == skirt.model.vertex_uv[v][d]);
  REQUIRE(obj.f.size() == skirt.model.n_triangles());
  for (std::size_t t = 0; t < obj.f.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      REQUIRE(obj.f[t][k][0] - 1 == skirt.model.corners(t)[k]);
      REQUIRE(obj.f[t][k][1] - 1 == skirt.model.triangle[t][k]);
    }
  CHECK(obj.groups == std::vector<std::string>{"front", "back"});
}

TEST_CASE("OBJ names hold no blanks and no line ends", "[writer]") {
  test::DrapedSkirt skirt = test::make_skirt(8, 2);
  skirt.model.panels[0].name = "front left\nf 1 1 1";
  skirt.model.panels[1].name = "";
  const Obj obj = obj_of(io::write_obj(skirt.model, skirt.state));
  CHECK(obj.groups == std::vector<std::string>{"front_left_f_1_1_1", "unnamed"});
  CHECK(obj.f.size() == skirt.model.n_triangles());
}

TEST_CASE("body OBJ counts on over bodies", "[writer]") {
  body::Body a = test::make_egg(8, 6), b = test::make_egg(10, 7);
  b.name = "stand";
  const Obj obj = obj_of(io::write_body_obj({a, b}));
  CHECK(obj.objects == std::vector<std::string>{"form", "stand"});
  CHECK(obj.v.size() == a.mesh.vertices.size() + b.mesh.vertices.size());
  const auto& last = obj.f.back();
  for (int k = 0; k < 3; ++k)
    CHECK(last[k][0] - 1 == b.mesh.triangles.back()[k] + static_cast<int>(a.mesh.vertices.size()));
}
