#pragma once
// Places of the protocol and byte offsets. A place is a line and a column in units that client and server
// agreed on: bytes, UTF-16 code units (the usual case) or code points.
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "grammar/source.hpp"

namespace garment::lsp {

using Json = nlohmann::ordered_json;

enum class Encoding { utf8, utf16, utf32 };

/// The lines of one text; they end at "\n", "\r\n" or "\r". Holds a view of the text.
class Lines {
 public:
  Lines(std::string_view text, Encoding encoding);

  /// Byte offset of a place; places behind a line's or the text's end are taken back to it, and so are those
  /// inside a character.
  std::uint32_t offset(std::uint64_t line, std::uint64_t column) const;
  std::uint32_t offset(
      const Json& position) const;  ///< throws nlohmann::json::exception where it is no position

  Json position(std::uint32_t offset) const;
  Json range(grammar::Span span) const;

 private:
  std::string_view text_;
  Encoding encoding_;
  std::vector<std::uint32_t> begins_;
};

}  // namespace garment::lsp
