#pragma once
// A text with what was typed at the prompt written into it.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace garment::session {

/// Bytes [begin, end) of some text.
struct Bytes {
  std::uint32_t begin = 0, end = 0;
};

/// Part of an entry: its text, and where it begins in the entry.
struct Typed {
  std::string_view text;
  std::uint32_t at = 0;
};

/// Remembers which bytes came from the entry, so that what is wrong with them is shown as it was typed.
class Patch {
 public:
  explicit Patch(std::string text) : text_(std::move(text)) {}

  const std::string& text() const { return text_; }
  /// Writes `before`, what was typed and `after` in the place of [begin, end).
  void replace(Bytes place, std::string_view before, Typed typed, std::string_view after);
  void insert(std::uint32_t at, std::string_view before, Typed typed, std::string_view after) {
    replace({at, at}, before, typed, after);
  }
  void remove(Bytes place) { replace(place, "", {}, ""); }
  /// Where the bytes stand in the entry; nothing where they are not wholly of it.
  std::optional<Bytes> in_entry(Bytes place) const;

 private:
  struct Piece {
    Bytes in_text;
    std::uint32_t in_entry = 0;
  };
  std::string text_;
  std::vector<Piece> pieces_;
};

}  // namespace garment::session
