#pragma once
// Where a picture is taken from.
#include "runtime/render/scene.hpp"

namespace garment::render {

/// The wearer faces +z; `side` looks at the wearer's left.
enum class View { front, side, back, three_quarter };

const char* view_name(View view);

/// A pinhole: the ray through picture coordinates (u, v), v upwards, has direction forward + u right + v up.
struct Camera {
  Vec3 eye{0, 0, 1}, forward{0, 0, -1}, right{1, 0, 0}, up{0, 1, 0};
  float left_edge = -1, right_edge = 1, bottom_edge = -1, top_edge = 1;  ///< of the picture, in (u, v)

  Vec3 direction(float x, float y) const {  ///< x, y in 0..1 from the upper left corner; not normalised
    return forward + (left_edge + x * (right_edge - left_edge)) * right +
           (top_edge - y * (top_edge - bottom_edge)) * up;
  }
};

/// A camera that shows the cloth large, with as much of the bodies as stands around it, in a picture of
/// width/height `aspect`. All views of one scene are taken at one scale.
Camera frame(const Scene& scene, View view, float aspect);

}  // namespace garment::render
