#include "runtime/render/scene.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "runtime/base/portable_math.hpp"
#include "runtime/model/surface.hpp"

namespace garment::render {
namespace {

using model::Index;
using model::Vector3d;

constexpr float kFloorWidth = 4;        // m, bodies wider than this both ways are floors
constexpr double kCreaseCosine = 0.77;  // about 40 degrees

void add_cloth(Scene& scene, const model::Model& m, const model::State& state) {
  const std::vector<Vector3d> normals = model::particle_normals(m, state.position);
  for (Index p : m.vertex_particle) {
    scene.cloth.positions.push_back(state.position[p].cast<float>());
    scene.cloth.normals.push_back(normals[p].cast<float>());
  }
  std::vector<model::Indices<2>> stitched;
  for (const model::SeamChain& seam : m.seams)
    for (std::size_t k = 1; k < seam.particles.size(); ++k)
      stitched.push_back({std::min(seam.particles[k - 1], seam.particles[k]),
                          std::max(seam.particles[k - 1], seam.particles[k])});
  std::sort(stitched.begin(), stitched.end());
  for (std::size_t t = 0; t < m.n_triangles(); ++t) {
    const auto& v = m.triangle[t];
    scene.cloth.triangles.push_back({static_cast<std::uint32_t>(v[0]), static_cast<std::uint32_t>(v[1]),
                                     static_cast<std::uint32_t>(v[2])});
    scene.cloth_panel.push_back(static_cast<std::uint8_t>(std::min<Index>(m.triangle_panel[t], 255)));
    const auto c = m.corners(t);
    std::uint8_t seam = 0;
    for (int k = 0; k < 3; ++k) {
      const Index a = c[(k + 1) % 3], b = c[(k + 2) % 3];
      if (std::binary_search(stitched.begin(), stitched.end(),
                             model::Indices<2>{std::min(a, b), std::max(a, b)}))
        seam |= static_cast<std::uint8_t>(1 << k);
    }
    scene.cloth_seam.push_back(seam);
  }
  for (const model::PanelRange& p : m.panels) scene.panel_color.push_back(linear_color(p.color));
}

/// Smooth over a person, sharp at the rim of a table: a corner's normal is the mean over those triangles
/// about its vertex that look nearly the same way.
SceneMesh body_mesh(const body::TriangleMesh& mesh) {
  std::vector<std::vector<std::uint32_t>> around(mesh.vertices.size());
  std::vector<Vector3d> twice_area, face;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    twice_area.push_back((mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]));
    face.push_back(twice_area.back().stableNormalized());
    for (int v : {a, b, c}) around[v].push_back(t);
  }
  SceneMesh out;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto first = static_cast<std::uint32_t>(out.positions.size());
    out.triangles.push_back({first, first + 1, first + 2});
    for (int v : mesh.triangles[t]) {
      Vector3d sum = Vector3d::Zero();
      for (std::uint32_t other : around[v])
        if (face[other].dot(face[t]) > kCreaseCosine) sum += twice_area[other];
      out.positions.push_back(mesh.vertices[v].cast<float>());
      out.normals.push_back((sum.squaredNorm() > 0 ? sum.stableNormalized() : face[t]).cast<float>());
    }
  }
  return out;
}

}  // namespace

Vec3 linear_color(const std::array<double, 3>& srgb) {
  Vec3 out;
  for (int k = 0; k < 3; ++k) {
    const double c = std::clamp(srgb[k], 0.0, 1.0);
    out[k] = static_cast<float>(c <= 0.04045 ? c / 12.92 : portable::pow((c + 0.055) / 1.055, 2.4));
  }
  return out;
}

Scene make_scene(const model::Model& m, const model::State& state, const std::vector<body::Body>& bodies) {
  Scene scene;
  add_cloth(scene, m, state);
  scene.low = Vec3::Constant(1e30f);
  scene.high = Vec3::Constant(-1e30f);
  for (const Vec3& p : scene.cloth.positions) {
    scene.low = scene.low.cwiseMin(p);
    scene.high = scene.high.cwiseMax(p);
  }
  const float width = std::max({scene.high[0] - scene.low[0], scene.high[2] - scene.low[2], 0.1f});
  float lowest = scene.low[1];
  bool floor_given = false;
  for (const body::Body& b : bodies) {
    Vec3 low = Vec3::Constant(1e30f), high = Vec3::Constant(-1e30f);
    for (const Vector3d& p : b.mesh.vertices) {
      low = low.cwiseMin(p.cast<float>());
      high = high.cwiseMax(p.cast<float>());
    }
    if (std::min(high[0] - low[0], high[2] - low[2]) > std::max(kFloorWidth, 1.5f * width)) {
      scene.floor_y = floor_given ? std::max(scene.floor_y, high[1]) : high[1];
      floor_given = true;
      continue;
    }
    lowest = std::min(lowest, low[1]);
    if (!b.mesh.triangles.empty()) scene.bodies.push_back(body_mesh(b.mesh));
  }
  if (!floor_given) {
    // Things stand on y = 0; what hangs high above it gets a floor within sight.
    const float height = scene.high[1] - scene.low[1];
    scene.floor_y = lowest < 0                      ? lowest - 0.002f
                    : lowest > 1.2f * height + 0.3f ? lowest - 0.25f * height
                                                    : 0.0f;
  }
  return scene;
}

}  // namespace garment::render
