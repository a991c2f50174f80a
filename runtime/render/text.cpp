#include "runtime/render/text.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/render/font_table.hpp"

namespace garment::render {
namespace {

constexpr double kAdvance = 6.2;  // dots from letter to letter
constexpr double kStroke = 0.52;  // half the width of a stroke, dots

struct Stroke {
  double x0, y0, x1, y1;
};

const Glyph& glyph_of(char c) {
  auto find = [](char wanted) {
    return std::lower_bound(kFont.begin(), kFont.end(), wanted,
                            [](const Glyph& g, char w) { return g.letter < w; });
  };
  const auto it = find(c);
  return it != kFont.end() && it->letter == c ? *it : *find('?');
}

bool dot(const Glyph& g, int x, int y) {
  return x >= 0 && y >= 0 && x < 5 && y < 7 && (g.rows[static_cast<std::size_t>(y)] >> (4 - x) & 1);
}

/// Neighbouring dots are joined; a diagonal only where no corner dot joins the two already.
std::vector<Stroke> strokes_of(const Glyph& g) {
  std::vector<Stroke> out;
  for (int y = 0; y < 7; ++y)
    for (int x = 0; x < 5; ++x) {
      if (!dot(g, x, y)) continue;
      const double px = x, py = y;
      out.push_back({px, py, px, py});
      if (dot(g, x + 1, y)) out.push_back({px, py, px + 1, py});
      if (dot(g, x, y + 1)) out.push_back({px, py, px, py + 1});
      for (int side : {-1, 1})
        if (dot(g, x + side, y + 1) && !dot(g, x + side, y) && !dot(g, x, y + 1))
          out.push_back({px, py, px + side, py + 1});
    }
  return out;
}

double distance(const Stroke& s, double x, double y) {
  const double dx = s.x1 - s.x0, dy = s.y1 - s.y0, length2 = dx * dx + dy * dy;
  const double t = length2 > 0 ? std::clamp(((x - s.x0) * dx + (y - s.y0) * dy) / length2, 0.0, 1.0) : 0;
  const double ex = x - s.x0 - t * dx, ey = y - s.y0 - t * dy;
  return std::sqrt(ex * ex + ey * ey);
}

}  // namespace

double text_width(std::string_view text, double size) {
  return text.empty() ? 0 : (kAdvance * (static_cast<double>(text.size()) - 1) + 5) * size;
}

void draw_text(Image& image, double x, double y, std::string_view text, double size, Rgb color) {
  for (char c : text) {
    const std::vector<Stroke> strokes = strokes_of(glyph_of(c));
    const int left = static_cast<int>(std::floor(x - size)),
              right = static_cast<int>(std::ceil(x + 6 * size));
    const int top = static_cast<int>(std::floor(y - size)),
              bottom = static_cast<int>(std::ceil(y + 8 * size));
    for (int j = top; j <= bottom; ++j)
      for (int i = left; i <= right; ++i) {
        const double u = (i + 0.5 - x) / size - 0.5, v = (j + 0.5 - y) / size - 0.5;
        double least = 1e9;
        for (const Stroke& s : strokes) least = std::min(least, distance(s, u, v));
        image.blend(i, j, color, std::clamp((kStroke - least) * size + 0.5, 0.0, 1.0));
      }
    x += kAdvance * size;
  }
}

}  // namespace garment::render
