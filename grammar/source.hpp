#pragma once
// Source text and places in it. Spans are byte offsets; lines and columns are made only when a person reads
// them.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace garment::grammar {

using SourceId = std::uint32_t;

/// Bytes [begin, end) of one source.
struct Span {
  SourceId source = 0;
  std::uint32_t begin = 0, end = 0;
  friend bool operator==(const Span&, const Span&) = default;
};

/// Smallest span that covers both (same source).
inline Span cover(Span a, Span b) {
  return {a.source, a.begin < b.begin ? a.begin : b.begin, a.end > b.end ? a.end : b.end};
}

/// One script, with its line table. Columns count Unicode code points from 1; lines count from 1.
struct Source {
  std::string name;  ///< as the user named it: "skirt.garment", "<prompt>"
  std::string text;
  std::vector<std::uint32_t> line_begin;
};

struct Place {
  std::uint32_t line = 1, column = 1;
};

class Sources {
 public:
  SourceId add(std::string name, std::string text);
  const Source& operator[](SourceId id) const { return sources_[id]; }
  Place place(SourceId id, std::uint32_t offset) const;
  std::string_view text(Span span) const;
  std::size_t size() const { return sources_.size(); }

 private:
  std::vector<Source> sources_;
};

}  // namespace garment::grammar
