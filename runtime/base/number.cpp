#include "runtime/base/number.hpp"

#include <charconv>
#include <cmath>
#include <cstdint>

namespace garment {

std::string format_number(double value) {
  if (value == 0) return "0";
  char text[40];
  auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return {text, end};
}

std::string format_number(double value, int digits) {
  if (value == 0) return "0";
  char text[400];
  auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits).ptr;
  std::string out(text, end);
  double rounded = 0;
  std::from_chars(out.data(), out.data() + out.size(), rounded);
  return format_number(rounded);
}

std::optional<double> parse_number(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0;
  auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace garment
