#pragma once
// Pages of a PDF file, by libharu, which is known to this room's pdf_page.cpp only.
#include <memory>
#include <string>

#include "runtime/io/paper.hpp"

namespace garment::io {

/// A PDF file being made. Everything drawn goes to the newest page, in millimetres from its upper left
/// corner.
class PdfFile final : public Paper {
 public:
  explicit PdfFile(std::string_view title);
  ~PdfFile() override;
  PdfFile(const PdfFile&) = delete;
  PdfFile& operator=(const PdfFile&) = delete;

  void add_page(const Point& size);
  /// From here on, until `end_window`, only what lies in this part of the page is drawn, and `origin` of the
  /// drawing lies at `at` on the page.
  void begin_window(const Extent& window, const Point& origin);
  void end_window();

  void polyline(const std::vector<Point>& points, bool closed, const Pen& pen) override;
  void circle(const Point& center, double radius, const Pen& pen) override;
  /// Letters beyond Latin 1 print as ?.
  void text(const Point& at, std::string_view text, const Lettering& lettering) override;
  void begin_group(std::string_view) override {}
  void end_group() override {}

  /// The bytes; empty where something went wrong.
  std::string finish();

 private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
};

}  // namespace garment::io
