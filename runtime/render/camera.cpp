#include "runtime/render/camera.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "runtime/base/portable_math.hpp"

namespace garment::render {
namespace {

struct Bounds {
  float low_u = 1e30f, high_u = -1e30f, low_v = 1e30f, high_v = -1e30f;

  void grow(float u, float v) {
    low_u = std::min(low_u, u);
    high_u = std::max(high_u, u);
    low_v = std::min(low_v, v);
    high_v = std::max(high_v, v);
  }
};

double azimuth(View view) {
  switch (view) {
    case View::front:
      return 0;
    case View::side:
      return 90;
    case View::back:
      return 180;
    case View::three_quarter:
      return 35;
  }
  return 0;
}

/// Flat, wide things are looked at from above.
double elevation(const Scene& s, View view) {
  const Vec3 size = s.high - s.low;
  const double flatness = std::max(size[0], size[2]) / std::max(size[1], 1e-3f);
  return (view == View::three_quarter ? 12 : 5) + 16 * std::clamp((flatness - 0.9) / 1.5, 0.0, 1.0);
}

Camera look(const Scene& s, View view, const Vec3& target, float distance) {
  const double a = azimuth(view) * portable::kPi / 180, e = elevation(s, view) * portable::kPi / 180;
  const Vec3 out(static_cast<float>(portable::cos(e) * portable::sin(a)),
                 static_cast<float>(portable::sin(e)),
                 static_cast<float>(portable::cos(e) * portable::cos(a)));
  Camera c;
  c.eye = target + distance * out;
  c.forward = -out;
  c.right = c.forward.cross(Vec3(0, 1, 0)).normalized();
  c.up = c.right.cross(c.forward);
  return c;
}

/// Heights between which bodies are shown: all of a body not much taller than the cloth, else what stands
/// about it.
std::array<float, 2> shown_heights(const Scene& s) {
  float low = s.low[1], high = s.high[1];
  for (const SceneMesh& b : s.bodies)
    for (const Vec3& p : b.positions) {
      low = std::min(low, p[1]);
      high = std::max(high, p[1]);
    }
  const float height = std::max(s.high[1] - s.low[1], 0.05f);
  if (high - low < 1.9f * height) return {low, high};
  return {std::max(low, s.low[1] - 0.25f * height), std::min(high, s.high[1] + 0.45f * height)};
}

Bounds bounds_in(const Scene& s, const Camera& c, const std::array<float, 2>& heights) {
  Bounds b;
  auto projected = [&](const Vec3& p) {
    const Vec3 d = p - c.eye;
    const float depth = std::max(d.dot(c.forward), 1e-3f);
    return std::array{d.dot(c.right) / depth, d.dot(c.up) / depth};
  };
  for (const Vec3& p : s.cloth.positions) {
    const auto [u, v] = projected(p);
    b.grow(u, v);
  }
  const Bounds cloth = b;
  const float aside = 0.15f * (cloth.high_u - cloth.low_u);  // spread arms may leave the picture
  for (const SceneMesh& m : s.bodies)
    for (const Vec3& p : m.positions) {
      if (p[1] < heights[0] || p[1] > heights[1]) continue;
      const auto [u, v] = projected(p);
      b.grow(std::clamp(u, cloth.low_u - aside, cloth.high_u + aside), v);
    }
  return b;
}

}  // namespace

const char* view_name(View view) {
  switch (view) {
    case View::front:
      return "front";
    case View::side:
      return "side";
    case View::back:
      return "back";
    case View::three_quarter:
      return "three-quarter";
  }
  return "";
}

Camera frame(const Scene& s, View view, float aspect) {
  const std::array<float, 2> heights = shown_heights(s);
  const Vec3 target = 0.5f * (s.low + s.high);
  const float radius = std::max(0.5f * (s.high - s.low).norm(), 0.05f);
  const float distance = 7 * radius;  // long lens: little perspective
  float half_height = 0;
  for (View v : {View::front, View::side, View::back, View::three_quarter}) {
    const Bounds b = bounds_in(s, look(s, v, target, distance), heights);
    half_height = std::max({half_height, 0.5f * (b.high_v - b.low_v), 0.5f * (b.high_u - b.low_u) / aspect});
  }
  half_height *= 1.1f;
  Camera c = look(s, view, target, distance);
  const Bounds b = bounds_in(s, c, heights);
  const float u = 0.5f * (b.low_u + b.high_u);
  // Where the width decides the scale there is room above or below: show more of the bodies there.
  const Bounds all = bounds_in(s, c, {-1e30f, 1e30f});
  const float room = half_height / 1.1f;
  const float v =
      std::clamp(0.5f * (all.low_v + all.high_v), b.high_v - room, std::max(b.low_v + room, b.high_v - room));
  c.left_edge = u - half_height * aspect;
  c.right_edge = u + half_height * aspect;
  c.bottom_edge = v - half_height;
  c.top_edge = v + half_height;
  return c;
}

}  // namespace garment::render
