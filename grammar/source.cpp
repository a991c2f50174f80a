#include "grammar/source.hpp"

#include <algorithm>

#include "grammar/text.hpp"

namespace garment::grammar {

SourceId Sources::add(std::string name, std::string text) {
  Source source{std::move(name), std::move(text), {0}};
  for (std::size_t i = 0; i < source.text.size(); ++i)
    if (source.text[i] == '\n') source.line_begin.push_back(static_cast<std::uint32_t>(i + 1));
  sources_.push_back(std::move(source));
  return static_cast<SourceId>(sources_.size() - 1);
}

Place Sources::place(SourceId id, std::uint32_t offset) const {
  const Source& source = sources_[id];
  offset = std::min(offset, static_cast<std::uint32_t>(source.text.size()));
  auto next = std::upper_bound(source.line_begin.begin(), source.line_begin.end(), offset);
  Place place;
  place.line = static_cast<std::uint32_t>(next - source.line_begin.begin());
  std::string_view before(source.text.data() + *(next - 1), offset - *(next - 1));
  for (char c : before)
    if (!is_utf8_tail(c)) ++place.column;
  return place;
}

std::string_view Sources::text(Span span) const {
  const std::string& text = sources_[span.source].text;
  std::size_t begin = std::min<std::size_t>(span.begin, text.size());
  std::size_t end = std::clamp<std::size_t>(span.end, begin, text.size());
  return std::string_view(text).substr(begin, end - begin);
}

}  // namespace garment::grammar
