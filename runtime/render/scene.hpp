#pragma once
// What a picture shows: cloth and bodies as triangle meshes in float, ready for the ray tracer.
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "runtime/body/body.hpp"
#include "runtime/model/model.hpp"

namespace garment::render {

using Vec3 = Eigen::Vector3f;

struct SceneMesh {
  std::vector<Vec3> positions;  ///< m
  std::vector<Vec3> normals;    ///< unit, smooth
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

struct Scene {
  SceneMesh cloth;                        ///< its vertices are the model's vertices, in their order
  std::vector<std::uint8_t> cloth_panel;  ///< [n_triangles], index into `panel_color`, capped at 255
  std::vector<std::uint8_t> cloth_seam;   ///< [n_triangles], bit k: the side opposite corner k is a seam
  std::vector<Vec3> panel_color;          ///< linear
  std::vector<SceneMesh> bodies;
  float floor_y = 0;  ///< height of the studio's floor, m

  Vec3 low{0, 0, 0}, high{0, 0, 0};  ///< of the cloth
};

/// Bodies more than 4 m wide both ways, and half as wide again as the cloth, are floors: they become the
/// studio's floor instead of a mesh. studio's floor instead of a mesh.
Scene make_scene(const model::Model& model, const model::State& state, const std::vector<body::Body>& bodies);

/// sRGB 0..1 to linear.
Vec3 linear_color(const std::array<double, 3>& srgb);

}  // namespace garment::render
