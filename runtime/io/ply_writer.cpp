#include <algorithm>

#include "runtime/io/bytes.hpp"
#include "runtime/io/mesh_writers.hpp"
#include "runtime/model/surface.hpp"

namespace garment::io {
namespace {

std::string header(const model::Model& m) {
  std::string out = "ply\nformat binary_little_endian 1.0\n";
  out += "comment garment " GARMENT_VERSION ", metres, y up; s t: flat position; strain as a fraction\n";
  for (std::size_t p = 0; p < m.panels.size(); ++p) {
    std::string name = m.panels[p].name;
    std::replace_if(
        name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }, '_');
    out += "comment panel " + std::to_string(p) + ' ' + name + '\n';
  }
  out += "element vertex " + std::to_string(m.n_vertices()) + '\n';
  for (const char* name : {"x", "y", "z"}) out += std::string("property double ") + name + '\n';
  for (const char* name : {"nx", "ny", "nz", "s", "t", "strain_warp", "strain_weft"})
    out += std::string("property float ") + name + '\n';
  for (const char* name : {"red", "green", "blue"}) out += std::string("property uchar ") + name + '\n';
  out += "property int panel\n";
  out += "element face " + std::to_string(m.n_triangles()) +
         "\nproperty list uchar int vertex_indices\nend_header\n";
  return out;
}

unsigned char color_byte(double value) {
  return static_cast<unsigned char>(std::clamp(value, 0.0, 1.0) * 255 + 0.5);
}

}  // namespace

std::string write_ply(const model::Model& m, const model::State& state,
                      const std::vector<Eigen::Vector2d>& strain) {
  const std::vector<model::Vector3d> normals = model::particle_normals(m, state.position);
  std::string out = header(m);
  for (std::size_t v = 0; v < m.n_vertices(); ++v) {
    const model::Index p = m.vertex_particle[v], panel = m.vertex_panel[v];
    const Eigen::Vector2d e = v < strain.size() ? strain[v] : Eigen::Vector2d(0, 0);
    for (int d = 0; d < 3; ++d) put(out, state.position[p][d]);
    for (int d = 0; d < 3; ++d) put(out, static_cast<float>(normals[p][d]));
    for (int d = 0; d < 2; ++d) put(out, static_cast<float>(m.vertex_uv[v][d]));
    for (int d = 0; d < 2; ++d) put(out, static_cast<float>(e[d]));
    for (double c : m.panels[panel].color) put(out, color_byte(c));
    put(out, panel);
  }
  for (const model::Indices<3>& t : m.triangle) {
    put(out, static_cast<unsigned char>(3));
    for (model::Index v : t) put(out, v);
  }
  return out;
}

}  // namespace garment::io
