#pragma once
// The pictures a user sees: the drape from four sides, a sheet of three, and a map of its strain. Bytes of
// PNG files.
#include <string>
#include <vector>

#include "runtime/render/camera.hpp"
#include "runtime/render/image.hpp"

namespace garment::render {

struct PictureSize {
  int width = 900, height = 1200;
};

/// The drape seen from `view`. Empty when the scene has no cloth or the size is not in 16 .. 8192 pixels a
/// side.
std::string render_drape(const Scene& scene, View view, const PictureSize& size = {});

/// Front, side and back next to one another with their names, each of `size`.
std::string render_sheet(const Scene& scene, const PictureSize& size = {600, 800});

/// The same cloth coloured by tensile strain, with a scale in percent. `vertex_strain` [cloth vertices] is
/// 0.05 for 5 %; negative counts as 0. The scale ends at a round number above 99.5 % of the vertices;
/// `largest` (a fraction, as reported) is printed above it.
std::string render_strain(const Scene& scene, const std::vector<double>& vertex_strain, double largest,
                          View view, const PictureSize& size = {});

}  // namespace garment::render
