#pragma once
// Which statement of a script made a thing. The runtime carries the id without knowing what it stands for; the
// interpreter keeps the table from id to source span.
#include <cstdint>

namespace garment {

/// Opaque id of the statement that made an object; 0 means "no statement" (made by a reader or by code).
struct OriginId {
  std::uint32_t value = 0;
  friend bool operator==(OriginId, OriginId) = default;
};

}  // namespace garment
