#include "interpreter/session/patch.hpp"

#include <algorithm>

namespace garment::session {

void Patch::replace(Bytes place, std::string_view before, Typed typed, std::string_view after) {
  std::string made(before);
  made += typed.text;
  made += after;
  text_.replace(place.begin, place.end - place.begin, made);
  std::erase_if(pieces_,
                [&](const Piece& p) { return p.in_text.begin < place.end && p.in_text.end > place.begin; });
  const std::uint32_t grown = static_cast<std::uint32_t>(made.size()), lost = place.end - place.begin;
  for (Piece& p : pieces_)
    if (p.in_text.begin >= place.end) {
      p.in_text.begin += grown - lost;  // unsigned: wraps round and back
      p.in_text.end += grown - lost;
    }
  const std::uint32_t begin = place.begin + static_cast<std::uint32_t>(before.size());
  if (!typed.text.empty())
    pieces_.push_back({{begin, begin + static_cast<std::uint32_t>(typed.text.size())}, typed.at});
}

std::optional<Bytes> Patch::in_entry(Bytes place) const {
  for (const Piece& p : pieces_)
    if (place.begin >= p.in_text.begin && place.end <= p.in_text.end)
      return Bytes{place.begin - p.in_text.begin + p.in_entry, place.end - p.in_text.begin + p.in_entry};
  return std::nullopt;
}

}  // namespace garment::session
