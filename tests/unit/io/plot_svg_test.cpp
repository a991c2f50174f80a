#include "runtime/io/plot_svg.hpp"

#include <catch2/catch.hpp>

using garment::io::plot_svg;

TEST_CASE("a curve is drawn from end to end of its axes") {
  const std::string text = plot_svg({{0, 0}, {1, 10}, {2, 5}}, "way [m]", "force [N]");
  CHECK(text.find("points=\"80,380 350,20 620,200\"") != std::string::npos);
  CHECK(text.find(">way [m]</text>") != std::string::npos);
  CHECK(text == plot_svg({{0, 0}, {1, 10}, {2, 5}}, "way [m]", "force [N]"));
}

TEST_CASE("a plot of one point, of none, and of labels that XML would mistake") {
  CHECK(plot_svg({}, "x", "y").empty());
  CHECK(plot_svg({{3, 3}}, "x", "y").find("polyline") != std::string::npos);
  const std::string text = plot_svg({{0, 0}, {1, 1}}, "a < b & c", std::string(200, 'y'));
  CHECK(text.find("a &lt; b &amp; c") != std::string::npos);
  CHECK(text.find(std::string(61, 'y') + "...") != std::string::npos);
  CHECK(text.find(std::string(62, 'y')) == std::string::npos);
}
