#pragma once
// What `garment limits` prints. The numbers are those of runtime/base/limits.hpp, which the checks read.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace garment::interpreter {

struct LimitRecord {
  std::string_view name;  ///< "source_bytes"
  std::uint64_t value = 0;
  std::string_view text;  ///< "bytes of one source file"
  std::string_view code;  ///< of the diagnostic that tells that it is passed
};

const std::vector<LimitRecord>& limit_table();

/// The table for people, and as JSON: an array of objects {name, value, text, code}.
std::string limits_text();
std::string limits_json();

}  // namespace garment::interpreter
