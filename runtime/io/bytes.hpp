#pragma once
// Binary output, least byte first.
#include <bit>
#include <cstring>
#include <string>

namespace garment::io {

static_assert(std::endian::native == std::endian::little, "binary writers copy values as they lie in memory");

template <class T>
void put(std::string& out, T value) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  out.append(bytes, sizeof(T));
}

}  // namespace garment::io
