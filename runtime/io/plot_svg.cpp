#include "runtime/io/plot_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runtime/base/number.hpp"

namespace garment::io {
namespace {

constexpr double kWidth = 640, kHeight = 440;              // px
constexpr double kLeft = 80, kRight = 20, kTop = 20, kBottom = 60;
constexpr std::size_t kMostSigns = 64;                     // of a label
constexpr int kTicks = 6;                                  // about so many on an axis

/// One axis: from tick to tick, and where its values lie in the picture.
struct Axis {
  double low = 0, high = 1, step = 1, from, to;

  Axis(double least, double most, double from_px, double to_px) : from(from_px), to(to_px) {
    if (!(most > least)) {
      const double wide = std::abs(least) > 0 ? 0.5 * std::abs(least) : 0.5;
      least -= wide;
      most += wide;
    }
    double raw = (most - least) / kTicks, power = 1;
    while (power > raw) power /= 10;
    while (power * 10 <= raw) power *= 10;
    const double lead = raw / power;
    step = power * (lead <= 1 ? 1 : lead <= 2 ? 2 : lead <= 5 ? 5 : 10);
    low = step * std::floor(least / step + 1e-9);
    high = step * std::ceil(most / step - 1e-9);
  }
  double at(double value) const { return from + (value - low) / (high - low) * (to - from); }
  int ticks() const { return static_cast<int>(std::lround((high - low) / step)); }
  double tick(int k) const {
    const double value = low + k * step;
    return std::abs(value) < 1e-9 * step ? 0 : value;
  }
};

/// As it may stand in XML; long formulas are cut short.
std::string escaped(const std::string& text) {
  const std::string cut = text.size() > kMostSigns ? text.substr(0, kMostSigns - 3) + "..." : text;
  std::string out;
  for (const char c : cut) out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  return out;
}

std::string px(double value) { return format_number(std::round(value * 100) / 100); }

std::string line(double x1, double y1, double x2, double y2, const char* color) {
  return fmt::format("<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\" stroke=\"{}\"/>\n", px(x1), px(y1), px(x2), px(y2), color);
}

std::string grid(const Axis& x, const Axis& y) {
  std::string out;
  for (int k = 0; k <= x.ticks(); ++k) {
    const double at = x.at(x.tick(k));
    out += line(at, y.from, at, y.to, x.tick(k) == 0 ? "#888" : "#ddd");
    out += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n", px(at), px(y.from + 18), format_number(x.tick(k), 6));
  }
  for (int k = 0; k <= y.ticks(); ++k) {
    const double at = y.at(y.tick(k));
    out += line(x.from, at, x.to, at, y.tick(k) == 0 ? "#888" : "#ddd");
    out += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{}</text>\n", px(x.from - 6), px(at + 4), format_number(y.tick(k), 6));
  }
  return out;
}

}  // namespace

std::string plot_svg(const std::vector<std::array<double, 2>>& points, const std::string& x_label, const std::string& y_label) {
  if (points.empty()) return "";
  std::array<double, 2> low = points[0], high = points[0];
  for (const auto& p : points)
    for (std::size_t k = 0; k < 2; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  const Axis x(low[0], high[0], kLeft, kWidth - kRight), y(low[1], high[1], kHeight - kBottom, kTop);
  std::string out = fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}\" height=\"{}\" viewBox=\"0 0 {} {}\" "
                                "font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
                                px(kWidth), px(kHeight), px(kWidth), px(kHeight));
  out += grid(x, y);
  out += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n", px(0.5 * (x.from + x.to)), px(kHeight - 14), escaped(x_label));
  out += fmt::format("<text x=\"16\" y=\"{}\" text-anchor=\"middle\" transform=\"rotate(-90 16 {})\">{}</text>\n", px(0.5 * (y.from + y.to)),
                     px(0.5 * (y.from + y.to)), escaped(y_label));
  out += "<polyline fill=\"none\" stroke=\"#1f5f99\" stroke-width=\"1.5\" points=\"";
  for (std::size_t k = 0; k < points.size(); ++k)
    out += (k > 0 ? " " : "") + px(x.at(points[k][0])) + ',' + px(y.at(points[k][1]));
  return out + "\"/>\n</svg>\n";
}

}  // namespace garment::io
