#pragma once
// One photograph: first hits, light, smoothing of the light, and finer sampling where the picture has edges.
#include "runtime/render/image.hpp"
#include "runtime/render/light.hpp"

namespace garment::render {

/// Takes the picture in parallel; the same bytes for any number of threads.
Image photograph(const Scene& scene, const Tracer& tracer, const Camera& camera, int width, int height,
                 const Look& look);

}  // namespace garment::render
