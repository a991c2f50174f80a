#include "interpreter/lsp/positions.hpp"

#include <algorithm>

#include "grammar/text.hpp"

namespace garment::lsp {
namespace {

/// Units that the character at `text[at]` takes.
std::uint32_t width(std::string_view text, std::size_t at, Encoding encoding, std::uint32_t& bytes) {
  const grammar::Character c = grammar::decode_utf8(text, at);
  bytes = c.length;
  if (encoding == Encoding::utf8) return c.length;
  return encoding == Encoding::utf16 && c.code > 0xFFFF ? 2 : 1;
}

}  // namespace

Lines::Lines(std::string_view text, Encoding encoding) : text_(text), encoding_(encoding), begins_{0} {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool carriage = text[i] == '\r' && (i + 1 >= text.size() || text[i + 1] != '\n');
    if (text[i] == '\n' || carriage) begins_.push_back(static_cast<std::uint32_t>(i + 1));
  }
}

std::uint32_t Lines::offset(std::uint64_t line, std::uint64_t column) const {
  if (line >= begins_.size()) return static_cast<std::uint32_t>(text_.size());
  std::uint32_t at = begins_[line];
  std::uint64_t units = 0;
  while (at < text_.size() && text_[at] != '\n' && text_[at] != '\r') {
    std::uint32_t bytes = 1;
    units += width(text_, at, encoding_, bytes);
    if (units > column) break;
    at += bytes;
  }
  return at;
}

std::uint32_t Lines::offset(const Json& position) const {
  const auto line = position.at("line").get<std::int64_t>(),
             column = position.at("character").get<std::int64_t>();
  return offset(static_cast<std::uint64_t>(std::max<std::int64_t>(line, 0)),
                static_cast<std::uint64_t>(std::max<std::int64_t>(column, 0)));
}

Json Lines::position(std::uint32_t offset) const {
  offset = std::min(offset, static_cast<std::uint32_t>(text_.size()));
  const auto next = std::upper_bound(begins_.begin(), begins_.end(), offset);
  std::uint32_t at = *(next - 1), units = 0;
  while (at < offset) {
    std::uint32_t bytes = 1;
    const std::uint32_t wide = width(text_, at, encoding_, bytes);
    if (at + bytes > offset) break;
    units += wide;
    at += bytes;
  }
  return Json{{"line", next - begins_.begin() - 1}, {"character", units}};
}

Json Lines::range(grammar::Span span) const {
  return Json{{"start", position(span.begin)}, {"end", position(span.end)}};
}

}  // namespace garment::lsp
