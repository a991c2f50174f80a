#include "runtime/io/svg_paper.hpp"

#include <cmath>

#include "runtime/base/number.hpp"

namespace garment::io {
namespace {

/// Ten thousandths of a millimetre are plenty for scissors.
std::string mm(double x) { return format_number(std::round(x * 1e4) / 1e4); }

std::string escaped(std::string_view text) {
  std::string out;
  for (char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
    }
  }
  return out;
}

std::string style(const Pen& pen) {
  std::string out =
      " fill=\"" + pen.fill + "\" stroke=\"" + pen.stroke + "\" stroke-width=\"" + mm(pen.width) + '"';
  if (!pen.dash.empty()) out += " stroke-dasharray=\"" + pen.dash + '"';
  return out;
}

}  // namespace

void SvgPaper::polyline(const std::vector<Point>& points, bool closed, const Pen& pen) {
  if (points.size() < 2) return data_.clear();
  body_ += "<path d=\"";
  for (std::size_t k = 0; k < points.size(); ++k)
    body_ += (k == 0 ? "M" : "L") + mm(points[k][0]) + ' ' + mm(points[k][1]);
  body_ += closed ? "Z\"" : "\"";
  body_ += data_ + style(pen) + "/>\n";
  data_.clear();
}

void SvgPaper::data(std::string_view name, std::string_view value) {
  data_ += ' ' + std::string(name) + "=\"" + escaped(value) + '"';
}

void SvgPaper::circle(const Point& center, double radius, const Pen& pen) {
  body_ += "<circle cx=\"" + mm(center[0]) + "\" cy=\"" + mm(center[1]) + "\" r=\"" + mm(radius) + '"' +
           style(pen) + "/>\n";
}

void SvgPaper::text(const Point& at, std::string_view text, const Lettering& l) {
  static constexpr const char* anchors[] = {"start", "middle", "end"};
  // SVG sets letters on their base line; a third of the size below the middle is where it lies.
  const std::string x = mm(at[0]), y = mm(at[1]);
  body_ += "<text x=\"" + x + "\" y=\"" + y + "\" dy=\"" + mm(0.35 * l.size) + "\" font-size=\"" +
           mm(l.size) + "\" text-anchor=\"" + anchors[static_cast<int>(l.anchor)] + "\" fill=\"" + l.color +
           '"';
  if (l.bold) body_ += " font-weight=\"bold\"";
  if (l.turn != 0) body_ += " transform=\"rotate(" + mm(l.turn) + ' ' + x + ' ' + y + ")\"";
  body_ += '>' + escaped(text) + "</text>\n";
}

void SvgPaper::begin_group(std::string_view id) { body_ += "<g id=\"" + escaped(id) + "\">\n"; }
void SvgPaper::end_group() { body_ += "</g>\n"; }

std::string SvgPaper::finish(const Point& size, std::string_view title) const {
  const std::string w = mm(size[0]), h = mm(size[1]);
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" +
         w + "mm\" height=\"" + h + "mm\" viewBox=\"0 0 " + w + ' ' + h +
         "\" font-family=\"Helvetica, Arial, sans-serif\" stroke-linejoin=\"round\" "
         "stroke-linecap=\"round\">\n<title>" +
         escaped(title) + "</title>\n<rect width=\"" + w + "\" height=\"" + h + "\" fill=\"#fff\"/>\n" +
         body_ + "</svg>\n";
}

double lettering_width(std::string_view text, double size) {
  return 0.56 * size * static_cast<double>(text.size());
}

}  // namespace garment::io
