#pragma once
// Fingerprints of bytes: SHA-256 (FIPS 180-4), for sources, states and written files.
#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace garment {

/// SHA-256 of bytes that arrive in pieces.
class Sha256 {
 public:
  void add(std::string_view bytes);
  /// The bits of `value`, lowest byte first, so that states hash alike wherever their bits are alike.
  void add_double(double value);

  /// 64 lower-case hexadecimal digits. Ends the sum: use a fresh object for the next one.
  std::string hex();

 private:
  void run_block(const unsigned char* block);

  std::array<std::uint32_t, 8> sum_{0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                    0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<unsigned char, 64> rest_{};
  std::uint64_t n_bytes_ = 0;
};

/// SHA-256 of `bytes` as 64 hexadecimal digits.
std::string sha256(std::string_view bytes);

}  // namespace garment
