#include "runtime/render/tracer.hpp"

#include <embree3/rtcore.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace garment::render {
namespace {

constexpr float kLift = 2e-4f;  // m, off the surface, against hits of the triangle itself

RTCRay make_ray(const Vec3& origin, const Vec3& direction, float reach) {
  RTCRay ray;
  ray.org_x = origin[0];
  ray.org_y = origin[1];
  ray.org_z = origin[2];
  ray.dir_x = direction[0];
  ray.dir_y = direction[1];
  ray.dir_z = direction[2];
  ray.tnear = 0;
  ray.tfar = reach;
  ray.time = 0;
  ray.mask = 0xffffffff;
  ray.id = 0;
  ray.flags = 0;
  return ray;
}

/// Embree reads whole 16-byte words, so its buffers are its own copies.
void attach(RTCDevice device, RTCScene scene, const SceneMesh& mesh) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* points = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.positions.size()));
  auto* corners = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t),
                              mesh.triangles.size()));
  if (points && corners) {
    for (const Vec3& p : mesh.positions) points = std::copy(p.data(), p.data() + 3, points);
    for (const auto& t : mesh.triangles) corners = std::copy(t.begin(), t.end(), corners);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
}

/// Shortest distance from the hit to the sides of the triangle that are seams.
float seam_distance(const std::array<Vec3, 3>& corner, const std::array<float, 3>& weight,
                    std::uint8_t sides) {
  float least = 1e30f;
  const float twice_area = (corner[1] - corner[0]).cross(corner[2] - corner[0]).norm();
  for (std::size_t k = 0; k < 3; ++k) {
    if (!(sides >> k & 1)) continue;
    const float side = (corner[(k + 1) % 3] - corner[(k + 2) % 3]).norm();
    if (side > 0) least = std::min(least, weight[k] * twice_area / side);
  }
  return least;
}

}  // namespace

struct Tracer::Handles {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
};

Tracer::Tracer(const Scene& scene, const std::vector<float>& values)
    : scene_(scene), values_(values), handles_(std::make_unique<Handles>()) {
  handles_->device = rtcNewDevice(nullptr);
  handles_->scene = rtcNewScene(handles_->device);
  rtcSetSceneFlags(handles_->scene, RTC_SCENE_FLAG_ROBUST);
  attach(handles_->device, handles_->scene, scene.cloth);
  for (const SceneMesh& b : scene.bodies) attach(handles_->device, handles_->scene, b);
  rtcCommitScene(handles_->scene);
}

Tracer::~Tracer() {
  rtcReleaseScene(handles_->scene);
  rtcReleaseDevice(handles_->device);
}

bool Tracer::occluded(const Vec3& origin, const Vec3& direction, float reach) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay ray = make_ray(origin, direction, reach);
  rtcOccluded1(handles_->scene, &context, &ray);
  return ray.tfar < 0;
}

Hit Tracer::mesh_hit(const SceneMesh& mesh, std::uint32_t triangle, float u, float v,
                     const Vec3& direction) const {
  const auto& t = mesh.triangles[triangle];
  const std::array<Vec3, 3> corner{mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]};
  const std::array<float, 3> weight{1 - u - v, u, v};
  Hit hit;
  hit.point = weight[0] * corner[0] + weight[1] * corner[1] + weight[2] * corner[2];
  hit.flat_normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized();
  hit.face = hit.flat_normal.dot(direction) < 0;
  const float side = hit.face ? 1.0f : -1.0f;
  hit.flat_normal *= side;
  Vec3 normal = Vec3::Zero(), lifted = Vec3::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 n = side * mesh.normals[t[k]];
    normal += weight[k] * n;
    // Rays leave from the rounded surface that the smooth normals speak of, so that coarse triangles cast no
    // shadows on themselves (J. Hanika, Hacking the shadow terminator, 2021).
    const Vec3 away = hit.point - corner[k];
    lifted -= weight[k] * std::min(0.0f, away.dot(n)) * n;
  }
  hit.normal = normal.squaredNorm() > 1e-12f ? Vec3(normal.normalized()) : hit.flat_normal;
  hit.origin = hit.point + lifted + kLift * hit.flat_normal;
  return hit;
}

Hit Tracer::trace(const Vec3& origin, const Vec3& direction) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query;
  query.ray = make_ray(origin, direction, 1e30f);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(handles_->scene, &context, &query);
  const bool struck = query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
  const float to_floor = direction[1] < 0 ? (scene_.floor_y - origin[1]) / direction[1] : 1e30f;
  if (to_floor > 0 && to_floor < 1e30f && (!struck || to_floor < query.ray.tfar)) {
    Hit hit;
    hit.surface = Surface::floor;
    hit.distance = to_floor;
    hit.point = origin + to_floor * direction;
    hit.origin = hit.point + Vec3(0, kLift, 0);
    return hit;
  }
  if (!struck) return {};
  const std::uint32_t triangle = query.hit.primID;
  const bool cloth = query.hit.geomID == 0;
  const SceneMesh& mesh = cloth ? scene_.cloth : scene_.bodies[query.hit.geomID - 1];
  Hit hit = mesh_hit(mesh, triangle, query.hit.u, query.hit.v, direction);
  hit.surface = cloth ? Surface::cloth : Surface::body;
  hit.distance = query.ray.tfar;
  if (!cloth) return hit;
  const auto& t = mesh.triangles[triangle];
  const std::array<float, 3> weight{1 - query.hit.u - query.hit.v, query.hit.u, query.hit.v};
  hit.panel = scene_.cloth_panel[triangle];
  if (scene_.cloth_seam[triangle] != 0)
    hit.seam = seam_distance({mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]}, weight,
                             scene_.cloth_seam[triangle]);
  if (!values_.empty())
    for (std::size_t k = 0; k < 3; ++k) hit.value += weight[k] * values_[t[k]];
  return hit;
}

}  // namespace garment::render
