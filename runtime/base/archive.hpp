#pragma once
// Values to bytes and back by one function for both ways, so that what is written and what is read cannot differ.
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace garment {

static_assert(std::endian::native == std::endian::little, "archives are written lowest byte first");

/// Bytes of values in the order in which they are named. An archive that collects copies them out; one that reads sets them.
///
/// Reading never trusts the bytes: after the first thing that does not fit (an end too early, a length that cannot be, a number
/// that is not finite) `ok` is false and all further values stay as they are. Lengths are bounded by the bytes that are there.
class Archive {
 public:
  Archive() = default;
  explicit Archive(std::string_view bytes) : in_(bytes), reading_(true) {}

  bool reading() const { return reading_; }
  bool ok() const { return ok_; }
  /// All that was to be read has been read, and nothing is left.
  bool whole() const { return ok_ && in_.empty(); }
  /// What has not been read.
  std::string_view rest() const { return in_; }
  /// For who reads: what was read cannot be.
  void refuse() { ok_ = false; }
  /// Refuses unless `fits`.
  void demand(bool fits) { ok_ = ok_ && fits; }
  std::string take() { return std::move(out_); }

  template <class T>
    requires(std::is_integral_v<T> && !std::is_same_v<T, bool>)
  void keep(T& value) {
    raw(&value, sizeof value);
  }
  void keep(bool& value) {
    std::uint8_t byte = value ? 1 : 0;
    keep(byte);
    demand(byte <= 1);
    if (reading_ && ok_) value = byte != 0;
  }
  /// Finite numbers alone.
  void keep(double& value) {
    double copy = value;
    raw(&copy, sizeof copy);
    take_finite(copy, value);
  }
  /// Any bits: reports of what went wrong hold infinities.
  void keep_any(double& value) { raw(&value, sizeof value); }
  /// One of `first` .. `last`.
  template <class Enum>
    requires(std::is_enum_v<Enum>)
  void keep(Enum& value, Enum last) {
    auto number = static_cast<std::int32_t>(value);
    keep(number);
    demand(number >= 0 && number <= static_cast<std::int32_t>(last));
    if (reading_ && ok_) value = static_cast<Enum>(number);
  }
  void keep(std::string& text) {
    if (!length(text, 1)) return;
    raw(text.data(), text.size());
  }
  /// Integers and finite doubles.
  template <class T>
    requires(std::is_arithmetic_v<T> && !std::is_same_v<T, bool>)
  void keep(std::vector<T>& list) {
    if (!length(list, sizeof(T))) return;
    numbers(list.data(), list.size());
  }
  /// `n` numbers that lie in a row; doubles must be finite.
  template <class T>
  void numbers(T* data, std::size_t n) {
    raw(data, n * sizeof(T));
    if constexpr (std::is_floating_point_v<T>)
      for (std::size_t k = 0; reading_ && ok_ && k < n; ++k) demand(std::isfinite(data[k]));
  }
  /// The length of a list of things that take at least `least_bytes` each; resizes it. False where it cannot be.
  template <class List>
  bool length(List& list, std::size_t least_bytes) {
    auto n = static_cast<std::uint64_t>(list.size());
    keep(n);
    if (!reading_) return true;
    demand(n <= in_.size() / (least_bytes > 0 ? least_bytes : 1));
    if (ok_) list.resize(static_cast<std::size_t>(n));
    return ok_;
  }

 private:
  void take_finite(double copy, double& value) {
    if (!reading_) return;
    demand(std::isfinite(copy));
    if (ok_) value = copy;
  }
  void raw(void* data, std::size_t n) {
    if (!reading_) {
      if (n > 0) out_.append(static_cast<const char*>(data), n);
      return;
    }
    demand(n <= in_.size());
    if (!ok_ || n == 0) return;
    std::memcpy(data, in_.data(), n);
    in_.remove_prefix(n);
  }

  std::string out_;
  std::string_view in_;
  bool reading_ = false, ok_ = true;
};

}  // namespace garment
