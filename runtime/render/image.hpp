#pragma once
// Pictures in memory.
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace garment::render {

/// sRGB, 0..255.
using Rgb = std::array<std::uint8_t, 3>;

/// Rows from the top, pixels from the left.
struct Image {
  int width = 0, height = 0;
  std::vector<Rgb> pixels;  ///< [height x width]

  Image() = default;
  Image(int w, int h, Rgb fill = {255, 255, 255})
      : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), fill) {}

  Rgb& at(int x, int y) { return pixels[static_cast<std::size_t>(y) * width + x]; }
  const Rgb& at(int x, int y) const { return pixels[static_cast<std::size_t>(y) * width + x]; }
  bool holds(int x, int y) const { return x >= 0 && y >= 0 && x < width && y < height; }

  /// Mixes `color` over the pixel with the given cover (0..1); outside the picture nothing happens.
  void blend(int x, int y, Rgb color, double cover);
  /// Copies `source` with its upper left corner at (x, y); what lies outside is cut off.
  void paste(const Image& source, int x, int y);
  void fill_rect(int x, int y, int w, int h, Rgb color);
};

/// The picture as a PNG file (8 bits a channel), the same bytes for the same pixels. Empty if libpng refuses.
std::string encode_png(const Image& image);

}  // namespace garment::render
