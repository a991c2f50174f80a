#include "runtime/io/pdf_page.hpp"

#include <hpdf.h>

#include <algorithm>
#include <array>
#include <vector>

#include "runtime/base/number.hpp"
#include "runtime/base/portable_math.hpp"

namespace garment::io {
namespace {

constexpr double kPoint = 72.0 / 25.4;  // points of PDF in a millimetre

/// "#rgb" or "#rrggbb" as 0..1.
std::array<float, 3> color_of(const std::string& text) {
  std::array<float, 3> out{0, 0, 0};
  const std::size_t digits = text.size() == 4 ? 1 : 2;
  for (std::size_t k = 0; k < 3 && text.size() == 1 + 3 * digits; ++k) {
    int value = 0;
    for (std::size_t d = 0; d < digits; ++d) {
      const char c = text[1 + k * digits + d];
      value = 16 * value + (c >= 'a' ? c - 'a' + 10 : c >= 'A' ? c - 'A' + 10 : c - '0');
    }
    out[k] = static_cast<float>(value) / (digits == 1 ? 15.0f : 255.0f);
  }
  return out;
}

/// UTF-8 to Latin 1.
std::string latin(std::string_view text) {
  std::string out;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const auto c = static_cast<unsigned char>(text[k]);
    if (c < 0x20) {
      out += ' ';
    } else if (c < 0x80) {
      out += static_cast<char>(c);
    } else if ((c == 0xC2 || c == 0xC3) && k + 1 < text.size()) {
      out += static_cast<char>((c & 3) << 6 | (static_cast<unsigned char>(text[++k]) & 0x3F));
    } else if (c >= 0xC0) {
      out += '?';
    }
  }
  return out;
}

void ignore_error(HPDF_STATUS, HPDF_STATUS, void*) {}  // asked for at the end

}  // namespace

struct PdfFile::Handles {
  HPDF_Doc doc = nullptr;
  HPDF_Page page = nullptr;
  HPDF_Font plain = nullptr, bold = nullptr;
  double height = 0;  ///< of the page, mm
  Point origin{0, 0};

  float x(const Point& p) const { return static_cast<float>(kPoint * (origin[0] + p[0])); }
  float y(const Point& p) const { return static_cast<float>(kPoint * (height - origin[1] - p[1])); }

  void take(const Pen& pen) const {
    const auto [r, g, b] = color_of(pen.stroke);
    HPDF_Page_SetRGBStroke(page, r, g, b);
    HPDF_Page_SetLineWidth(page, static_cast<float>(kPoint * pen.width));
    std::vector<HPDF_UINT16> dash;
    for (std::size_t at = 0; at < pen.dash.size() && dash.size() < 8;) {
      const std::size_t end = std::min(pen.dash.find(' ', at), pen.dash.size());
      const double length = parse_number(pen.dash.substr(at, end - at)).value_or(1);
      dash.push_back(static_cast<HPDF_UINT16>(std::max(1.0, kPoint * length + 0.5)));
      at = end + 1;
    }
    HPDF_Page_SetDash(page, dash.empty() ? nullptr : dash.data(), static_cast<HPDF_UINT>(dash.size()), 0);
    if (pen.fill != "none") {
      const auto [fr, fg, fb] = color_of(pen.fill);
      HPDF_Page_SetRGBFill(page, fr, fg, fb);
    }
  }
};

PdfFile::PdfFile(std::string_view title) : handles_(std::make_unique<Handles>()) {
  Handles& h = *handles_;
  h.doc = HPDF_New(ignore_error, nullptr);
  if (h.doc == nullptr) return;
  HPDF_SetCompressionMode(h.doc, HPDF_COMP_ALL);
  HPDF_SetInfoAttr(h.doc, HPDF_INFO_TITLE, latin(title).c_str());
  HPDF_SetInfoAttr(h.doc, HPDF_INFO_CREATOR, "Garment");
  h.plain = HPDF_GetFont(h.doc, "Helvetica", "WinAnsiEncoding");
  h.bold = HPDF_GetFont(h.doc, "Helvetica-Bold", "WinAnsiEncoding");
}

PdfFile::~PdfFile() {
  if (handles_->doc != nullptr) HPDF_Free(handles_->doc);
}

void PdfFile::add_page(const Point& size) {
  Handles& h = *handles_;
  if (h.doc == nullptr) return;
  h.page = HPDF_AddPage(h.doc);
  h.height = size[1];
  h.origin = Point(0, 0);
  HPDF_Page_SetWidth(h.page, static_cast<float>(kPoint * size[0]));
  HPDF_Page_SetHeight(h.page, static_cast<float>(kPoint * size[1]));
  HPDF_Page_SetLineJoin(h.page, HPDF_ROUND_JOIN);
  HPDF_Page_SetLineCap(h.page, HPDF_ROUND_END);
}

void PdfFile::begin_window(const Extent& window, const Point& origin) {
  Handles& h = *handles_;
  if (h.page == nullptr) return;
  HPDF_Page_GSave(h.page);
  const Point corner(window.low[0], window.high[1]), size = kPoint * window.size();
  HPDF_Page_Rectangle(h.page, h.x(corner), h.y(corner), static_cast<float>(size[0]),
                      static_cast<float>(size[1]));
  HPDF_Page_Clip(h.page);
  HPDF_Page_EndPath(h.page);
  h.origin = origin;
}

void PdfFile::end_window() {
  Handles& h = *handles_;
  if (h.page == nullptr) return;
  HPDF_Page_GRestore(h.page);
  h.origin = Point(0, 0);
}

void PdfFile::polyline(const std::vector<Point>& points, bool closed, const Pen& pen) {
  const Handles& h = *handles_;
  if (h.page == nullptr || points.size() < 2) return;
  h.take(pen);
  HPDF_Page_MoveTo(h.page, h.x(points[0]), h.y(points[0]));
  for (std::size_t k = 1; k < points.size(); ++k) HPDF_Page_LineTo(h.page, h.x(points[k]), h.y(points[k]));
  if (closed && pen.fill != "none")
    HPDF_Page_ClosePathFillStroke(h.page);
  else if (closed)
    HPDF_Page_ClosePathStroke(h.page);
  else
    HPDF_Page_Stroke(h.page);
}

void PdfFile::circle(const Point& center, double radius, const Pen& pen) {
  const Handles& h = *handles_;
  if (h.page == nullptr) return;
  h.take(pen);
  HPDF_Page_Circle(h.page, h.x(center), h.y(center), static_cast<float>(kPoint * radius));
  if (pen.fill != "none")
    HPDF_Page_FillStroke(h.page);
  else
    HPDF_Page_Stroke(h.page);
}

void PdfFile::text(const Point& at, std::string_view text, const Lettering& l) {
  const Handles& h = *handles_;
  if (h.page == nullptr || text.empty()) return;
  const std::string letters = latin(text);
  const auto [r, g, b] = color_of(l.color);
  HPDF_Page_SetRGBFill(h.page, r, g, b);
  HPDF_Page_BeginText(h.page);
  HPDF_Page_SetFontAndSize(h.page, l.bold ? h.bold : h.plain, static_cast<float>(kPoint * l.size));
  const double wide = HPDF_Page_TextWidth(h.page, letters.c_str()) / kPoint;
  const double before = l.anchor == Anchor::middle ? 0.5 * wide : l.anchor == Anchor::end ? wide : 0;
  // Letters stand on their base line, a third of the size below the middle; `turn` is clockwise on paper.
  const double angle = -l.turn * portable::kPi / 180, c = portable::cos(angle), s = portable::sin(angle);
  const double dx = -before, dy = -0.35 * l.size;  // y up
  const double x = h.x(at) + kPoint * (c * dx - s * dy), y = h.y(at) + kPoint * (s * dx + c * dy);
  HPDF_Page_SetTextMatrix(h.page, static_cast<float>(c), static_cast<float>(s), static_cast<float>(-s),
                          static_cast<float>(c), static_cast<float>(x), static_cast<float>(y));
  HPDF_Page_ShowText(h.page, letters.c_str());
  HPDF_Page_EndText(h.page);
}

std::string PdfFile::finish() {
  Handles& h = *handles_;
  if (h.doc == nullptr || HPDF_SaveToStream(h.doc) != HPDF_OK || HPDF_GetError(h.doc) != HPDF_OK) return {};
  HPDF_ResetStream(h.doc);
  std::string bytes;
  std::array<HPDF_BYTE, 1 << 14> part{};
  for (;;) {
    HPDF_UINT32 n = part.size();
    const HPDF_STATUS status = HPDF_ReadFromStream(h.doc, part.data(), &n);
    bytes.append(reinterpret_cast<const char*>(part.data()), n);
    if (n == 0 || status != HPDF_OK) break;
  }
  return bytes;
}

}  // namespace garment::io
