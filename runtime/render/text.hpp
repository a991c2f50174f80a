#pragma once
// Lettering for pictures: a small bitmap font whose dots are joined by round strokes, so that it stays smooth
// at any size.
#include <string_view>

#include "runtime/render/image.hpp"

namespace garment::render {

/// Writes `text` with the upper left corner of its capitals at (x, y), pixels. `size` is the width of one
/// dot; capitals are 7 dots high. Characters that the font lacks show as '?'.
void draw_text(Image& image, double x, double y, std::string_view text, double size, Rgb color);

/// Width of `text` in pixels.
double text_width(std::string_view text, double size);

}  // namespace garment::render
