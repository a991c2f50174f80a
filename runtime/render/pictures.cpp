#include "runtime/render/pictures.hpp"

#include <algorithm>

#include "runtime/base/number.hpp"
#include "runtime/render/studio.hpp"
#include "runtime/render/text.hpp"

namespace garment::render {
namespace {

constexpr Rgb kScaleInk = {70, 74, 82};
constexpr Rgb kPaleInk = {120, 125, 134};

bool drawable(const Scene& scene, const PictureSize& size) {
  auto fits = [](int side) { return side >= 16 && side <= 8192; };
  auto finite = [](const SceneMesh& m) {
    return std::all_of(m.positions.begin(), m.positions.end(), [](const Vec3& p) { return p.allFinite(); });
  };
  return !scene.cloth.triangles.empty() && fits(size.width) && fits(size.height) && finite(scene.cloth) &&
         std::all_of(scene.bodies.begin(), scene.bodies.end(), finite);
}

Image picture(const Scene& scene, const Tracer& tracer, View view, const PictureSize& size,
              const Look& look) {
  const float aspect = static_cast<float>(size.width) / static_cast<float>(size.height);
  return photograph(scene, tracer, frame(scene, view, aspect), size.width, size.height, look);
}

void draw_centered(Image& image, double x, double y, const std::string& text, double dot, Rgb color) {
  draw_text(image, x - 0.5 * text_width(text, dot), y, text, dot, color);
}

/// End of the colour scale: the round number at or above nearly all values.
double scale_end(std::vector<double> values) {
  for (double& v : values) v = std::max(v, 0.0);
  const std::size_t k = values.empty() ? 0 : (values.size() - 1) * 995 / 1000;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(k), values.end());
  const double wanted = values.empty() ? 0 : values[k];
  for (double round : {0.001, 0.002, 0.005, 0.01, 0.02, 0.03, 0.05, 0.08, 0.1, 0.15, 0.2, 0.3, 0.5, 1.0, 2.0})
    if (wanted <= round) return round;
  return 5.0;
}

std::string percent(double fraction) { return format_number(100 * fraction, 3) + " %"; }

/// Upright colour bar with five marks, at the right border.
void draw_scale(Image& image, double end, double largest) {
  const double dot = std::max(1.0, image.width / 450.0);
  const int bar_width = static_cast<int>(13 * dot), bar_height = static_cast<int>(0.34 * image.height);
  const int x = image.width - static_cast<int>(75 * dot), y = static_cast<int>(30 * dot);
  draw_text(image, x, y - 17 * dot, "strain", dot, kScaleInk);
  for (int j = 0; j < bar_height; ++j) {
    const Vec3 c = strain_color(1 - (static_cast<float>(j) + 0.5f) / static_cast<float>(bar_height));
    image.fill_rect(x, y + j, bar_width, 1, {srgb_byte(c[0]), srgb_byte(c[1]), srgb_byte(c[2])});
  }
  for (int k = 0; k <= 4; ++k) {
    const int at = y + bar_height - k * bar_height / 4;
    image.fill_rect(x + bar_width, at - (k == 4 ? 0 : 1), static_cast<int>(4 * dot),
                    std::max(1, static_cast<int>(dot)), kScaleInk);
    draw_text(image, x + bar_width + 7 * dot, at - 3.5 * dot, percent(end * k / 4), dot, kScaleInk);
  }
  const double below = y + bar_height + 14 * dot;
  draw_text(image, x, below, "largest", dot, kPaleInk);
  draw_text(image, x, below + 11 * dot, percent(largest), dot, kScaleInk);
}

}  // namespace

std::string render_drape(const Scene& scene, View view, const PictureSize& size) {
  if (!drawable(scene, size)) return {};
  const std::vector<float> no_values;
  const Tracer tracer(scene, no_values);
  return encode_png(picture(scene, tracer, view, size, {}));
}

std::string render_sheet(const Scene& scene, const PictureSize& size) {
  if (!drawable(scene, size)) return {};
  const std::vector<float> no_values;
  const Tracer tracer(scene, no_values);
  Image sheet(3 * size.width, size.height);
  int k = 0;
  for (View view : {View::front, View::side, View::back}) {
    sheet.paste(picture(scene, tracer, view, size, {}), k * size.width, 0);
    const double dot = std::max(1.0, size.width / 300.0);
    draw_centered(sheet, (k + 0.5) * size.width, size.height - 16 * dot, view_name(view), dot, kPaleInk);
    if (k > 0) sheet.fill_rect(k * size.width - 1, 0, 2, size.height, {255, 255, 255});
    ++k;
  }
  return encode_png(sheet);
}

std::string render_strain(const Scene& scene, const std::vector<double>& vertex_strain, double largest,
                          View view, const PictureSize& size) {
  if (!drawable(scene, size) || vertex_strain.size() != scene.cloth.positions.size()) return {};
  std::vector<float> values;
  for (double v : vertex_strain) values.push_back(static_cast<float>(std::max(v, 0.0)));
  const double end = scale_end(vertex_strain);
  const Tracer tracer(scene, values);
  const Look look{true, static_cast<float>(end)};
  Image image = picture(scene, tracer, view, size, look);
  draw_scale(image, end, largest);
  return encode_png(image);
}

}  // namespace garment::render
