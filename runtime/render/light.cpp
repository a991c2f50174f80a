#include "runtime/render/light.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "runtime/base/portable_math.hpp"

namespace garment::render {
namespace {

constexpr std::size_t kDirections = 32;  // per set: 4 x 4 pixels times 2 rays
constexpr std::size_t kSets = 32;
constexpr float kSeamWidth = 0.0011f;  // m, half the width of a drawn seam line

struct Sample {
  float x, y;  // square, -1..1
  Vec3 dome;   // about +z, cosine-weighted
};

/// Additive recurrence with the plastic number: every set covers the square evenly (M. Roberts, 2018).
std::array<Sample, kDirections * kSets> make_samples() {
  std::array<Sample, kDirections * kSets> out;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double k = static_cast<double>(i) + 0.5;
    double a = k * 0.7548776662466927, b = k * 0.5698402909980532;
    a -= std::floor(a);
    b -= std::floor(b);
    const double r = std::sqrt(a), phi = 2 * portable::kPi * b;
    out[i] = {static_cast<float>(2 * a - 1), static_cast<float>(2 * b - 1),
              Vec3(static_cast<float>(r * portable::cos(phi)), static_cast<float>(r * portable::sin(phi)),
                   static_cast<float>(std::sqrt(1 - a)))};
  }
  return out;
}

const std::array<Sample, kDirections * kSets>& samples() {
  static const auto table = make_samples();
  return table;
}

std::uint32_t scramble(std::uint32_t x, std::uint32_t y) {
  std::uint32_t h = x * 0x8da6b343u ^ y * 0xd8163841u;
  h ^= h >> 16;
  h *= 0x7feb352du;
  h ^= h >> 15;
  h *= 0x846ca68bu;
  return h ^ h >> 16;
}

/// Order in which the 16 pixels of a block take their directions, so that close pixels take distant ones.
constexpr std::array<std::uint8_t, 16> kBlock = {0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5};

/// Two unit vectors square to n and to each other.
std::array<Vec3, 2> tangents(const Vec3& n) {
  const Vec3 t = (std::fabs(n[0]) > 0.7f ? Vec3(0, 1, 0) : Vec3(1, 0, 0)).cross(n).normalized();
  return {t, n.cross(t)};
}

float smooth_step(float low, float high, float x) {
  const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

}  // namespace

Light::Light(const Scene& scene, const Camera& camera) : scene_(scene) {
  center_ = 0.5f * (scene.low + scene.high);
  radius_ = std::max(0.5f * (scene.high - scene.low).norm(), 0.05f);
  const Vec3 towards = (-0.70f * camera.right + 1.30f * Vec3(0, 1, 0) - 0.85f * camera.forward).normalized();
  const auto [u, v] = tangents(towards);
  box_center_ = center_ + 6 * radius_ * towards;
  box_u_ = 1.3f * radius_ * u;
  box_v_ = 1.3f * radius_ * v;
  fill_direction_ = (0.9f * camera.right + 0.35f * Vec3(0, 1, 0) - 0.5f * camera.forward).normalized();
}

Visibility Light::measure(const Tracer& tracer, const Hit& hit, int x, int y) const {
  const std::size_t place = kBlock[static_cast<std::size_t>(y & 3) * 4 + static_cast<std::size_t>(x & 3)];
  // One set for a block, so that its pixels together see the box and the dome evenly.
  const std::size_t set =
      scramble(static_cast<std::uint32_t>(x >> 2), static_cast<std::uint32_t>(y >> 2)) % kSets;
  const auto [t, b] = tangents(hit.normal);
  const float reach = 0.9f * radius_;
  Visibility seen{0, 0};
  for (std::size_t k = 0; k < 2; ++k) {
    const Sample& s = samples()[set * kDirections + 2 * place + k];
    const Vec3 to_box = box_center_ + s.x * box_u_ + s.y * box_v_ - hit.origin;
    const float distance = to_box.norm();
    if (to_box.dot(hit.normal) > 0 && !tracer.occluded(hit.origin, to_box / distance, distance))
      seen.box += 0.5f;
    const Vec3 up = s.dome[0] * t + s.dome[1] * b + s.dome[2] * hit.normal;
    const bool floor =
        hit.surface != Surface::floor && up[1] < 0 && hit.origin[1] - scene_.floor_y < -up[1] * reach;
    if (!floor && !tracer.occluded(hit.origin, up, reach)) seen.dome += 0.5f;
  }
  return seen;
}

Vec3 Light::cloth_albedo(const Hit& hit, const Look& look) const {
  Vec3 color = look.strain                             ? strain_color(hit.value / look.strain_full)
               : hit.panel < scene_.panel_color.size() ? scene_.panel_color[hit.panel]
                                                       : Vec3(0.2f, 0.2f, 0.2f);
  if (!look.strain && !hit.face) {  // the reverse of a cloth is duller and a little lighter
    const float grey = color.dot(Vec3(0.25f, 0.6f, 0.15f));
    color = 0.72f * color + Vec3::Constant(0.20f * grey + 0.035f);
  }
  const float line = 1 - smooth_step(0.45f * kSeamWidth, kSeamWidth, hit.seam);
  return color * (1 - (look.strain ? 0.35f : 0.42f) * line);
}

Vec3 Light::shade_surface(const Hit& hit, const Visibility& seen, const Vec3& view, const Vec3& albedo,
                          float sheen) const {
  const Vec3& n = hit.normal;
  const Vec3 to_box = (box_center_ - hit.point).normalized();
  const float wrap = 0.12f;
  const float direct = std::max(0.0f, (n.dot(to_box) + wrap) / (1 + wrap)) * seen.box;
  const float dome = 0.10f + 0.90f * seen.dome * (0.65f + 0.35f * seen.dome);
  const float fill = std::max(0.0f, n.dot(fill_direction_)) * dome;
  const Vec3 sky(0.36f, 0.375f, 0.41f), ground(0.26f, 0.245f, 0.23f);
  const Vec3 ambient = (0.5f + 0.5f * n[1]) * sky + (0.5f - 0.5f * n[1]) * ground;
  const Vec3 key(0.93f, 0.90f, 0.85f);
  Vec3 color = albedo.cwiseProduct(direct * key + dome * ambient + 0.12f * fill * Vec3(1, 1, 1));
  const float edge = 1 - std::clamp(n.dot(-view), 0.0f, 1.0f);
  color += sheen * edge * edge * edge * dome * (0.6f * albedo + Vec3::Constant(0.08f));
  return color;
}

Vec3 Light::shade(const Hit& hit, const Visibility& seen, const Vec3& view, const Vec3& background,
                  const Look& look) const {
  switch (hit.surface) {
    case Surface::none:
      return background;
    case Surface::floor: {
      const float away = (hit.point - center_).norm() / radius_;
      const float near = 1 - smooth_step(2.5f, 6, away);
      return background * (1 - 0.42f * near * (1 - seen.box)) * (1 - 0.55f * near * (1 - seen.dome));
    }
    case Surface::body: {
      const Vec3 skin = look.strain ? Vec3(0.58f, 0.58f, 0.59f) : Vec3(0.70f, 0.65f, 0.60f);
      Vec3 color = shade_surface(hit, seen, view, skin, 0.25f);
      const Vec3 half = ((box_center_ - hit.point).normalized() - view).normalized();
      const float shine = std::max(0.0f, hit.normal.dot(half));
      const float s2 = shine * shine, s8 = s2 * s2 * s2 * s2;
      return color + Vec3::Constant(0.05f * s8 * s8 * s8 * seen.box);
    }
    case Surface::cloth:
      return shade_surface(hit, seen, view, cloth_albedo(hit, look), look.strain ? 0.2f : 0.5f);
  }
  return background;
}

Vec3 strain_color(float t) {
  static const std::array<Vec3, 6> stops = {
      linear_color({0.25, 0.36, 0.65}), linear_color({0.24, 0.62, 0.74}), linear_color({0.52, 0.78, 0.48}),
      linear_color({0.95, 0.85, 0.35}), linear_color({0.93, 0.53, 0.22}), linear_color({0.76, 0.14, 0.17})};
  const float x = std::clamp(t, 0.0f, 1.0f) * (stops.size() - 1);
  const auto k = std::min(static_cast<std::size_t>(x), stops.size() - 2);
  const float f = x - static_cast<float>(k);
  return (1 - f) * stops[k] + f * stops[k + 1];
}

Vec3 backdrop(float t) {
  static const Vec3 low = linear_color({0.885, 0.885, 0.89}), high = linear_color({0.975, 0.975, 0.975});
  const float s = smooth_step(0.0f, 1.0f, t);
  return (1 - s) * low + s * high;
}

float displayed(float linear) {
  static const auto table = [] {
    std::array<float, 4098> out{};
    for (std::size_t i = 0; i < out.size(); ++i) {
      const double c = std::min(1.0, static_cast<double>(i) / 4096);
      out[i] = static_cast<float>(c <= 0.0031308 ? 12.92 * c : 1.055 * portable::pow(c, 1 / 2.4) - 0.055);
    }
    return out;
  }();
  // A soft shoulder keeps white cloth from burning out.
  const float knee = 0.75f;
  const float x = linear <= knee ? linear : knee + (1 - knee) * (1 - 1 / (1 + (linear - knee) / (1 - knee)));
  const float at = std::clamp(x, 0.0f, 1.0f) * 4096;
  const auto k = static_cast<std::size_t>(at);
  const float f = at - static_cast<float>(k);
  return (1 - f) * table[k] + f * table[k + 1];
}

std::uint8_t srgb_byte(float linear) { return static_cast<std::uint8_t>(255 * displayed(linear) + 0.5f); }

}  // namespace garment::render
