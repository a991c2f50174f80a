#include "runtime/render/pictures.hpp"

#include <png.h>

#include <catch2/catch.hpp>
#include <limits>

#include "runtime/base/parallel.hpp"
#include "runtime/render/light.hpp"
#include "runtime/render/text.hpp"
#include "tests/support/draped_skirt.hpp"

using namespace garment;
using render::Image;
using render::View;

namespace {

constexpr render::PictureSize kSmall{120, 160};

Image decode(const std::string& bytes) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  REQUIRE(png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()) != 0);
  png.format = PNG_FORMAT_RGB;
  Image out(static_cast<int>(png.width), static_cast<int>(png.height));
  REQUIRE(png_image_finish_read(&png, nullptr, out.pixels.data(), 0, nullptr) != 0);
  return out;
}

render::Scene scene(const std::array<double, 3>& color = {0.2, 0.3, 0.7}, bool with_body = true) {
  test::DrapedSkirt skirt = test::make_skirt(64, 20);
  for (model::PanelRange& p : skirt.model.panels) p.color = color;
  std::vector<body::Body> bodies;
  if (with_body) bodies.push_back(test::make_egg(32, 24));
  return render::make_scene(skirt.model, skirt.state, bodies);
}

/// Pixels whose colour lies clearly on the side of channel `k`.
int count_tinted(const Image& image, std::size_t k) {
  int n = 0;
  for (const render::Rgb& p : image.pixels) n += p[k] > p[(k + 1) % 3] + 20 && p[k] > p[(k + 2) % 3] + 20;
  return n;
}

}  // namespace

TEST_CASE("a drape fills the picture with its own colour, from every side", "[render]") {
  const render::Scene blue = scene({0.2, 0.3, 0.7}), red = scene({0.7, 0.2, 0.2});
  for (View view : {View::front, View::side, View::back, View::three_quarter}) {
    const Image b = decode(render::render_drape(blue, view, kSmall)),
                r = decode(render::render_drape(red, view, kSmall));
    REQUIRE(b.width == 120);
    REQUIRE(b.height == 160);
    CHECK(count_tinted(b, 2) > 120 * 160 / 8);
    CHECK(count_tinted(b, 0) == 0);
    CHECK(count_tinted(r, 0) > 120 * 160 / 8);
    // the corners show the light studio, not the cloth
    for (const auto& corner : {b.at(0, 0), b.at(119, 0)})
      for (int channel : corner) CHECK(channel > 200);
  }
}

TEST_CASE("the picture does not depend on the number of threads", "[render]") {
  const render::Scene s = scene();
  const int before = thread_count();
  set_thread_count(1);
  const std::string one = render::render_drape(s, View::three_quarter, kSmall);
  set_thread_count(4);
  const std::string four = render::render_drape(s, View::three_quarter, kSmall);
  set_thread_count(before);
  CHECK(one == four);
}

TEST_CASE("a body throws its shadow and hides cloth behind it", "[render]") {
  const Image with = decode(render::render_drape(scene(), View::front, kSmall));
  const Image without = decode(render::render_drape(scene({0.2, 0.3, 0.7}, false), View::front, kSmall));
  CHECK(with.pixels != without.pixels);
  CHECK(count_tinted(without, 2) > count_tinted(with, 2));  // alone, the skirt is shown larger
}

TEST_CASE("strain is coloured from the cold to the hot end of its scale", "[render]") {
  const render::Scene s = scene();
  std::vector<double> none(s.cloth.positions.size(), -0.2), high(s.cloth.positions.size(), 0.0999);
  const Image cold = decode(render::render_strain(s, none, 0, View::front, kSmall));
  const Image hot = decode(render::render_strain(s, high, 0.0999, View::front, kSmall));
  CHECK(count_tinted(cold, 2) > 120 * 160 / 8);
  CHECK(count_tinted(hot, 0) > 120 * 160 / 8);
  CHECK(
      render::render_strain(s, {0.1}, 0.1, View::front, kSmall).empty());  // a value for every vertex or none
}

TEST_CASE("the sheet shows three views", "[render]") {
  const Image sheet = decode(render::render_sheet(scene(), kSmall));
  CHECK(sheet.width == 360);
  CHECK(sheet.height == 160);
}

TEST_CASE("what cannot be drawn gives no picture", "[render]") {
  CHECK(render::render_drape(render::Scene{}, View::front).empty());
  CHECK(render::render_drape(scene(), View::front, {0, 100}).empty());
  CHECK(render::render_drape(scene(), View::front, {100, 100000}).empty());
  render::Scene broken = scene();
  broken.cloth.positions[7][1] = std::numeric_limits<float>::quiet_NaN();
  CHECK(render::render_drape(broken, View::front, kSmall).empty());
}

TEST_CASE("cloth that is a point or a line still gives a picture", "[render]") {
  test::DrapedSkirt skirt = test::make_skirt(16, 4);
  for (model::Vector3d& p : skirt.state.position) p = model::Vector3d(0, p[1], 0);
  CHECK_FALSE(
      render::render_drape(render::make_scene(skirt.model, skirt.state, {}), View::front, kSmall).empty());
  for (model::Vector3d& p : skirt.state.position) p = model::Vector3d(1, 2, 3);
  CHECK_FALSE(
      render::render_drape(render::make_scene(skirt.model, skirt.state, {}), View::side, kSmall).empty());
}

TEST_CASE("a wide floor becomes the studio's floor", "[render]") {
  test::DrapedSkirt skirt = test::make_skirt(16, 4);
  body::Body floor;
  floor.mesh.vertices = {{-50, 0.1, -50}, {50, 0.1, -50}, {50, 0.1, 50}, {-50, -1, 50}};
  floor.mesh.triangles = {{0, 2, 1}, {0, 3, 2}};
  const render::Scene s = render::make_scene(skirt.model, skirt.state, {floor});
  CHECK(s.bodies.empty());
  CHECK(s.floor_y == Approx(0.1));
}

TEST_CASE("seams are known by the sides of triangles", "[render]") {
  const render::Scene s = scene();
  int sides = 0;
  for (std::uint8_t bits : s.cloth_seam) sides += (bits & 1) + (bits >> 1 & 1) + (bits >> 2 & 1);
  CHECK(sides == 2 * 2 * 20);  // two seams of 20 sides, each seen from two panels
}

TEST_CASE("letters are drawn where they are asked for", "[render]") {
  Image image(60, 30, {255, 255, 255});
  render::draw_text(image, 10, 5, "HI", 2, {0, 0, 0});
  int dark = 0, outside = 0;
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 60; ++x) {
      if (image.at(x, y)[0] > 100) continue;
      ++dark;
      outside += x < 9 || x > 11 + render::text_width("HI", 2) || y < 4 || y > 20;
    }
  CHECK(dark > 60);
  CHECK(outside == 0);
  render::draw_text(image, -20, -10, "off the picture \xff", 3, {0, 0, 0});
}

TEST_CASE("displayed brightness rises steadily and ends at white", "[render]") {
  float last = -1;
  for (int k = 0; k <= 400; ++k) {
    const float now = render::displayed(static_cast<float>(k) * 0.01f);
    CHECK(now >= last);
    CHECK(now <= 1);
    last = now;
  }
  CHECK(render::displayed(-1) == 0);
  CHECK(render::displayed(0.2f) == Approx(0.4845).margin(0.001));
}
