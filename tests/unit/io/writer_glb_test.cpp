#include <catch2/catch.hpp>
#include <cstring>
#include <nlohmann/json.hpp>

#include "runtime/io/mesh_writers.hpp"
#include "tests/support/draped_skirt.hpp"

using namespace garment;
using nlohmann::json;

namespace {

struct Glb {
  json head;
  std::string binary;
};

std::uint32_t u32(const std::string& b, std::size_t at) {
  std::uint32_t value = 0;
  REQUIRE(at + 4 <= b.size());
  std::memcpy(&value, b.data() + at, 4);
  return value;
}

Glb glb_of(const std::string& b) {
  REQUIRE(b.substr(0, 4) == "glTF");
  CHECK(u32(b, 4) == 2);
  CHECK(u32(b, 8) == b.size());
  const std::size_t n = u32(b, 12);
  CHECK(n % 4 == 0);
  CHECK(b.substr(16, 4) == "JSON");
  Glb out{json::parse(b.substr(20, n)), ""};
  if (b.size() > 20 + n) {
    CHECK(b.substr(24 + n, 4) == std::string("BIN\0", 4));
    CHECK(u32(b, 20 + n) == b.size() - 28 - n);
    out.binary = b.substr(28 + n);
  }
  return out;
}

template <class T>
std::vector<T> values(const Glb& glb, int accessor, std::size_t per_item) {
  const json& a = glb.head["accessors"][accessor];
  const json& view = glb.head["bufferViews"][a["bufferView"].get<int>()];
  std::vector<T> out(a["count"].get<std::size_t>() * per_item);
  REQUIRE(view["byteLength"].get<std::size_t>() == out.size() * sizeof(T));
  std::memcpy(out.data(), glb.binary.data() + view["byteOffset"].get<std::size_t>(), out.size() * sizeof(T));
  return out;
}

}  // namespace

TEST_CASE("GLB holds a primitive per panel and a node per body", "[writer]") {
  const test::DrapedSkirt skirt = test::make_skirt(24, 8);
  const model::Model& m = skirt.model;
  const Glb glb = glb_of(io::write_glb(m, skirt.state, {test::make_egg(12, 8)}));
  REQUIRE(glb.head["nodes"].size() == 2);
  CHECK(glb.head["nodes"][0]["name"] == "garment");
  CHECK(glb.head["nodes"][1]["name"] == "form");
  const json& primitives = glb.head["meshes"][0]["primitives"];
  REQUIRE(primitives.size() == m.panels.size());
  for (std::size_t p = 0; p < m.panels.size(); ++p) {
    const model::PanelRange& range = m.panels[p];
    const json& attributes = primitives[p]["attributes"];
    const auto position = values<float>(glb, attributes["POSITION"], 3);
    const auto uv = values<float>(glb, attributes["TEXCOORD_0"], 2);
    const auto index = values<std::uint32_t>(glb, primitives[p]["indices"], 1);
    REQUIRE(position.size() == 3 * static_cast<std::size_t>(range.n_vertices));
    REQUIRE(index.size() == 3 * static_cast<std::size_t>(range.n_triangles));
    for (model::Index v = 0; v < range.n_vertices; ++v) {
      for (int d = 0; d < 3; ++d)
        REQUIRE(position[3 * v + d] ==
                static_cast<float>(skirt.state.position[m.vertex_particle[range.first_vertex + v]][d]));
      REQUIRE(uv[2 * v] == static_cast<float>(m.vertex_uv[range.first_vertex + v][0]));
    }
    for (std::size_t k = 0; k < index.size(); ++k)
      REQUIRE(static_cast<model::Index>(index[k]) + range.first_vertex ==
              m.triangle[range.first_triangle + k / 3][k % 3]);
    CHECK(glb.head["materials"][primitives[p]["material"].get<int>()]["doubleSided"] == true);
  }
}

TEST_CASE("GLB of nothing has no empty arrays", "[writer]") {
  const Glb glb = glb_of(io::write_glb({}, {}, {}));
  CHECK(glb.binary.empty());
  CHECK_FALSE(glb.head.contains("nodes"));
  CHECK_FALSE(glb.head.contains("buffers"));
}
