#include <catch2/catch.hpp>
#include <cstring>

#include "runtime/io/mesh_writers.hpp"
#include "tests/support/draped_skirt.hpp"

using namespace garment;

namespace {

template <class T>
T take(const std::string& bytes, std::size_t& at) {
  T value;
  REQUIRE(at + sizeof(T) <= bytes.size());
  std::memcpy(&value, bytes.data() + at, sizeof(T));
  at += sizeof(T);
  return value;
}

}  // namespace

TEST_CASE("PLY holds places, unit normals, flat places, strain, colour and panel of every vertex",
          "[writer]") {
  const test::DrapedSkirt skirt = test::make_skirt(24, 8);
  const model::Model& m = skirt.model;
  std::vector<Eigen::Vector2d> strain(m.n_vertices(), {0.25, -0.5});
  const std::string bytes = io::write_ply(m, skirt.state, strain);
  const std::string end = "end_header\n";
  std::size_t at = bytes.find(end) + end.size();
  CHECK(bytes.substr(0, 4) == "ply\n");
  CHECK(bytes.find("element vertex " + std::to_string(m.n_vertices()) + "\n") != std::string::npos);
  for (std::size_t v = 0; v < m.n_vertices(); ++v) {
    for (int d = 0; d < 3; ++d)
      REQUIRE(take<double>(bytes, at) == skirt.state.position[m.vertex_particle[v]][d]);
    float n2 = 0;
    for (int d = 0; d < 3; ++d) {
      const float n = take<float>(bytes, at);
      n2 += n * n;
    }
    REQUIRE(n2 == Approx(1).epsilon(1e-5));
    for (int d = 0; d < 2; ++d) REQUIRE(take<float>(bytes, at) == static_cast<float>(m.vertex_uv[v][d]));
    REQUIRE(take<float>(bytes, at) == 0.25f);
    REQUIRE(take<float>(bytes, at) == -0.5f);
    const auto red = take<unsigned char>(bytes, at);
    REQUIRE(red == static_cast<unsigned char>(m.panels[m.vertex_panel[v]].color[0] * 255 + 0.5));
    at += 2;
    REQUIRE(take<int>(bytes, at) == m.vertex_panel[v]);
  }
  for (const model::Indices<3>& t : m.triangle) {
    REQUIRE(take<unsigned char>(bytes, at) == 3);
    for (int k = 0; k < 3; ++k) REQUIRE(take<int>(bytes, at) == t[k]);
  }
  CHECK(at == bytes.size());
}
