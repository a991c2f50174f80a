#pragma once
// Rays against the scene, by Embree. Embree and its handles are known to this file's .cpp only.
#include <memory>
#include <optional>

#include "runtime/render/camera.hpp"

namespace garment::render {

enum class Surface : std::uint8_t { none, floor, body, cloth };

struct Hit {
  Surface surface = Surface::none;
  std::uint8_t panel = 0;
  bool face = true;        ///< the cloth's face (not its reverse) is seen
  float distance = 1e30f;  ///< along the unit direction, m
  float seam = 1e30f;      ///< distance to the nearest seam line of the triangle, m
  float value = 0;         ///< interpolated vertex value
  Vec3 point{0, 0, 0};
  Vec3 normal{0, 1, 0};       ///< unit, smooth, towards the viewer's side of the surface
  Vec3 flat_normal{0, 1, 0};  ///< unit, of the triangle, towards the viewer
  Vec3 origin{0, 0, 0};       ///< where rays that leave the surface start, lifted off it
};

/// Read-only after construction; asks may run at the same time.
class Tracer {
 public:
  /// `values` [cloth vertices] are interpolated into Hit::value; may be empty. Keeps references to both.
  Tracer(const Scene& scene, const std::vector<float>& values);
  ~Tracer();
  Tracer(const Tracer&) = delete;
  Tracer& operator=(const Tracer&) = delete;

  /// First thing hit from `origin` along the unit vector `direction`; the floor is the plane y =
  /// scene.floor_y.
  Hit trace(const Vec3& origin, const Vec3& direction) const;

  /// Something of cloth or bodies within `reach` metres.
  bool occluded(const Vec3& origin, const Vec3& direction, float reach) const;

 private:
  struct Handles;
  Hit mesh_hit(const SceneMesh& mesh, std::uint32_t triangle, float u, float v, const Vec3& direction) const;

  const Scene& scene_;
  const std::vector<float>& values_;
  std::unique_ptr<Handles> handles_;
};

}  // namespace garment::render
