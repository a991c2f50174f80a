#include "runtime/render/image.hpp"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <csetjmp>

namespace garment::render {

void Image::blend(int x, int y, Rgb color, double cover) {
  if (!holds(x, y) || !(cover > 0)) return;
  Rgb& p = at(x, y);
  const double c = std::min(cover, 1.0);
  for (std::size_t k = 0; k < 3; ++k)
    p[k] = static_cast<std::uint8_t>(p[k] + (static_cast<double>(color[k]) - p[k]) * c + 0.5);
}

void Image::paste(const Image& source, int x, int y) {
  for (int j = 0; j < source.height; ++j)
    for (int i = 0; i < source.width; ++i)
      if (holds(x + i, y + j)) at(x + i, y + j) = source.at(i, j);
}

void Image::fill_rect(int x, int y, int w, int h, Rgb color) {
  for (int j = std::max(0, y); j < std::min(height, y + h); ++j)
    for (int i = std::max(0, x); i < std::min(width, x + w); ++i) at(i, j) = color;
}

std::string encode_png(const Image& image) {
  std::string bytes;
  std::vector<png_bytep> rows;
  for (int y = 0; y < image.height; ++y)
    rows.push_back(const_cast<png_bytep>(image.pixels[static_cast<std::size_t>(y) * image.width].data()));
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  if (!info || setjmp(png_jmpbuf(png))) {  // libpng reports failure by a jump to here
    png_destroy_write_struct(&png, &info);
    return {};
  }
  auto append = [](png_structp p, png_bytep data, png_size_t n) {
    static_cast<std::string*>(png_get_io_ptr(p))->append(reinterpret_cast<const char*>(data), n);
  };
  png_set_write_fn(png, &bytes, append, nullptr);
  png_set_compression_level(png, 5);
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height), 8,
               PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_write_info(png, info);
  png_write_image(png, rows.data());
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return bytes;
}

}  // namespace garment::render
