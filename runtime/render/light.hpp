#pragma once
// The studio's light: a large soft box beside the camera, a dome of sky, and how cloth, body and floor answer
// to them.
#include "runtime/render/tracer.hpp"

namespace garment::render {

/// How much of the light arrives at a point: 1 is all.
struct Visibility {
  float box = 1;   ///< share of the soft box that is seen
  float dome = 1;  ///< share of the sky that is seen (ambient occlusion)
};

/// How cloth is coloured.
struct Look {
  bool strain = false;       ///< colour by Hit::value instead of the panel's colour
  float strain_full = 0.1f;  ///< value at the end of the colour scale
};

class Light {
 public:
  Light(const Scene& scene, const Camera& camera);

  /// Estimate from two rays to the soft box and two into the dome. Neighbouring pixels (x, y) take different
  /// directions; the same pixel always the same ones.
  Visibility measure(const Tracer& tracer, const Hit& hit, int x, int y) const;

  /// Linear colour towards the viewer. `background` is the linear colour behind the point.
  Vec3 shade(const Hit& hit, const Visibility& visibility, const Vec3& view, const Vec3& background,
             const Look& look) const;

 private:
  Vec3 shade_surface(const Hit& hit, const Visibility& seen, const Vec3& view, const Vec3& albedo,
                     float sheen) const;
  Vec3 cloth_albedo(const Hit& hit, const Look& look) const;

  const Scene& scene_;
  Vec3 box_center_, box_u_, box_v_;  ///< half axes of the soft box
  Vec3 fill_direction_;
  Vec3 center_;
  float radius_;
};

/// Colour of the strain scale at t in 0..1, linear.
Vec3 strain_color(float t);

/// The studio's paper at height t in 0..1 from the bottom of the picture, linear.
Vec3 backdrop(float t);

/// Linear light to what the file holds (sRGB, 0..1), with a soft shoulder towards white.
float displayed(float linear);
std::uint8_t srgb_byte(float linear);

}  // namespace garment::render
