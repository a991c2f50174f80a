// Binary glTF: header, a JSON chunk, a binary chunk (Khronos glTF 2.0, section 4.4).
#include <algorithm>
#include <nlohmann/json.hpp>

#include "runtime/base/portable_math.hpp"
#include "runtime/io/bytes.hpp"
#include "runtime/io/mesh_writers.hpp"
#include "runtime/model/surface.hpp"

namespace garment::io {
namespace {

using Json = nlohmann::ordered_json;
using model::Index;
using model::Vector3d;

enum : int { kFloat = 5126, kUnsignedInt = 5125, kArrayBuffer = 34962, kElementBuffer = 34963 };

/// glTF colours are linear.
double linear_color(double srgb) {
  const double c = std::clamp(srgb, 0.0, 1.0);
  const double linear = c <= 0.04045 ? c / 12.92 : portable::pow((c + 0.055) / 1.055, 2.4);
  return static_cast<double>(static_cast<long>(linear * 1e4 + 0.5)) / 1e4;
}

class GlbFile {
 public:
  GlbFile() {
    json_["asset"] = {{"version", "2.0"}, {"generator", "garment " GARMENT_VERSION}};
    json_["scene"] = 0;
    json_["scenes"] = Json::array({{{"nodes", Json::array()}}});
    for (const char* key : {"nodes", "meshes", "materials", "accessors", "bufferViews"})
      json_[key] = Json::array();
  }

  int add_material(const std::string& name, const std::array<double, 3>& srgb, double roughness,
                   bool double_sided) {
    Json m = {
        {"name", name},
        {"pbrMetallicRoughness",
         {{"baseColorFactor", {linear_color(srgb[0]), linear_color(srgb[1]), linear_color(srgb[2]), 1.0}},
          {"metallicFactor", 0.0},
          {"roughnessFactor", roughness}}}};
    if (double_sided) m["doubleSided"] = true;
    return append("materials", std::move(m));
  }

  int add_vectors(const std::vector<Vector3d>& values, bool with_bounds) {
    const int view = begin_view(kArrayBuffer);
    std::array<float, 3> low{}, high{};
    for (std::size_t i = 0; i < values.size(); ++i)
      for (int d = 0; d < 3; ++d) {
        const auto x = static_cast<float>(values[i][d]);
        low[d] = i == 0 ? x : std::min(low[d], x);
        high[d] = i == 0 ? x : std::max(high[d], x);
        put(binary_, x);
      }
    end_view(view);
    Json a = {{"bufferView", view}, {"componentType", kFloat}, {"count", values.size()}, {"type", "VEC3"}};
    if (with_bounds) {
      a["min"] = low;
      a["max"] = high;
    }
    return append("accessors", std::move(a));
  }

  int add_uv(const model::Vector2d* uv, Index n) {
    const int view = begin_view(kArrayBuffer);
    for (Index i = 0; i < n; ++i) {
      put(binary_, static_cast<float>(uv[i][0]));
      put(binary_, static_cast<float>(-uv[i][1]));  // glTF counts v downwards
    }
    end_view(view);
    return append("accessors",
                  {{"bufferView", view}, {"componentType", kFloat}, {"count", n}, {"type", "VEC2"}});
  }

  int add_indices(const std::vector<std::uint32_t>& indices) {
    const int view = begin_view(kElementBuffer);
    for (std::uint32_t i : indices) put(binary_, i);
    end_view(view);
    return append("accessors", {{"bufferView", view},
                                {"componentType", kUnsignedInt},
                                {"count", indices.size()},
                                {"type", "SCALAR"}});
  }

  void add_node(const std::string& name, Json primitives) {
    if (primitives.empty()) return;
    const int mesh = append("meshes", {{"name", name}, {"primitives", std::move(primitives)}});
    const int node = append("nodes", {{"name", name}, {"mesh", mesh}});
    json_["scenes"][0]["nodes"].push_back(node);
  }

  std::string bytes() && {
    for (const char* key : {"nodes", "meshes", "materials", "accessors", "bufferViews"})
      if (json_[key].empty()) json_.erase(key);  // the format forbids empty arrays
    if (json_["scenes"][0]["nodes"].empty()) json_["scenes"][0].erase("nodes");
    if (!binary_.empty()) json_["buffers"] = Json::array({{{"byteLength", binary_.size()}}});
    std::string text = json_.dump(-1, ' ', false, Json::error_handler_t::replace);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::size_t binary_chunk = binary_.empty() ? 0 : 8 + binary_.size();
    std::string out = "glTF";
    put(out, std::uint32_t{2});
    put(out, static_cast<std::uint32_t>(12 + 8 + text.size() + binary_chunk));
    put(out, static_cast<std::uint32_t>(text.size()));
    out += "JSON" + text;
    if (binary_chunk > 0) {
      put(out, static_cast<std::uint32_t>(binary_.size()));
      out += std::string("BIN\0", 4) + binary_;
    }
    return out;
  }

 private:
  int append(const char* key, Json value) {
    json_[key].push_back(std::move(value));
    return static_cast<int>(json_[key].size()) - 1;
  }

  int begin_view(int target) {
    return append("bufferViews",
                  {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", 0}, {"target", target}});
  }
  void end_view(int view) {
    Json& v = json_["bufferViews"][view];
    v["byteLength"] = binary_.size() - v["byteOffset"].get<std::size_t>();
  }

  Json json_;
  std::string binary_;  // every element is 4 bytes wide, so all offsets are aligned
};

/// Material of a colour, made once.
class Cloths {
 public:
  explicit Cloths(GlbFile& file) : file_(file) {}
  int of(const std::array<double, 3>& color) {
    for (const auto& [c, id] : known_)
      if (c == color) return id;
    const int id = file_.add_material("cloth " + std::to_string(known_.size() + 1), color, 0.9, true);
    known_.emplace_back(color, id);
    return id;
  }

 private:
  GlbFile& file_;
  std::vector<std::pair<std::array<double, 3>, int>> known_;
};

Json garment_primitives(GlbFile& file, const model::Model& m, const std::vector<Vector3d>& x) {
  const std::vector<Vector3d> normals = model::particle_normals(m, x);
  Cloths cloths(file);
  Json primitives = Json::array();
  for (const model::PanelRange& panel : m.panels) {
    if (panel.n_triangles == 0) continue;
    std::vector<Vector3d> position, normal;
    for (Index v = panel.first_vertex; v < panel.first_vertex + panel.n_vertices; ++v) {
      position.push_back(x[m.vertex_particle[v]]);
      normal.push_back(normals[m.vertex_particle[v]]);
    }
    std::vector<std::uint32_t> indices;
    for (Index t = panel.first_triangle; t < panel.first_triangle + panel.n_triangles; ++t)
      for (Index v : m.triangle[t]) indices.push_back(static_cast<std::uint32_t>(v - panel.first_vertex));
    Json attributes = {{"POSITION", file.add_vectors(position, true)},
                       {"NORMAL", file.add_vectors(normal, false)},
                       {"TEXCOORD_0", file.add_uv(&m.vertex_uv[panel.first_vertex], panel.n_vertices)}};
    primitives.push_back({{"attributes", std::move(attributes)},
                          {"indices", file.add_indices(indices)},
                          {"material", cloths.of(panel.color)},
                          {"extras", {{"panel", panel.name}}}});
  }
  return primitives;
}

Json body_primitives(GlbFile& file, const body::Body& b, int material) {
  if (b.mesh.triangles.empty()) return Json::array();
  std::vector<std::uint32_t> indices;
  std::vector<model::Indices<3>> triangles;
  for (const std::array<int, 3>& t : b.mesh.triangles) {
    triangles.push_back({t[0], t[1], t[2]});
    for (int v : t) indices.push_back(static_cast<std::uint32_t>(v));
  }
  Json attributes = {{"POSITION", file.add_vectors(b.mesh.vertices, true)},
                     {"NORMAL", file.add_vectors(model::smooth_normals(triangles, b.mesh.vertices), false)}};
  return Json::array({{{"attributes", std::move(attributes)},
                       {"indices", file.add_indices(indices)},
                       {"material", material}}});
}

}  // namespace

std::string write_glb(const model::Model& m, const model::State& state,
                      const std::vector<body::Body>& bodies) {
  GlbFile file;
  file.add_node("garment", garment_primitives(file, m, state.position));
  if (!bodies.empty()) {
    const int skin = file.add_material("body", {0.78, 0.75, 0.72}, 0.6, false);
    for (const body::Body& b : bodies)
      file.add_node(b.name.empty() ? "body" : b.name, body_primitives(file, b, skin));
  }
  return std::move(file).bytes();
}

}  // namespace garment::io
