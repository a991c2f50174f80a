#include "runtime/base/number.hpp"
#include "runtime/io/mesh_writers.hpp"

namespace garment::io {
namespace {

/// OBJ names end at a blank.
std::string obj_name(const std::string& name) {
  std::string out;
  for (char c : name) out += static_cast<unsigned char>(c) <= ' ' || c == 127 ? '_' : c;
  return out.empty() ? "unnamed" : out;
}

void add_point(std::string& out, const char* keyword, const double* x, int n) {
  out += keyword;
  for (int d = 0; d < n; ++d) {
    out += ' ';
    out += format_number(x[d]);
  }
  out += '\n';
}

const char* const kHeader = "# garment " GARMENT_VERSION ", metres, y up\n";

}  // namespace

std::string write_obj(const model::Model& m, const model::State& state) {
  std::string out = kHeader;
  out.reserve(64 * (m.n_particles() + m.n_vertices() + m.n_triangles()));
  out += "o garment\n";
  for (const model::Vector3d& x : state.position) add_point(out, "v", x.data(), 3);
  for (const model::Vector2d& uv : m.vertex_uv) add_point(out, "vt", uv.data(), 2);
  for (const model::PanelRange& panel : m.panels) {
    out += "g " + obj_name(panel.name) + '\n';
    for (model::Index t = panel.first_triangle; t < panel.first_triangle + panel.n_triangles; ++t) {
      out += 'f';
      for (model::Index v : m.triangle[t])
        out += ' ' + std::to_string(m.vertex_particle[v] + 1) + '/' + std::to_string(v + 1);
      out += '\n';
    }
  }
  return out;
}

std::string write_body_obj(const std::vector<body::Body>& bodies) {
  std::string out = kHeader;
  std::size_t first = 1;
  for (const body::Body& b : bodies) {
    out += "o " + obj_name(b.name) + '\n';
    for (const body::Vector3d& x : b.mesh.vertices) add_point(out, "v", x.data(), 3);
    for (const std::array<int, 3>& t : b.mesh.triangles) {
      out += 'f';
      for (int v : t) out += ' ' + std::to_string(first + static_cast<std::size_t>(v));
      out += '\n';
    }
    first += b.mesh.vertices.size();
  }
  return out;
}

}  // namespace garment::io
