#pragma once
// Memory that values hold, counted while they live, so that a script cannot take more than it may.
#include <cstddef>
#include <memory>
#include <utility>

namespace garment::interpreter {

/// Bytes held by the values of one interpretation.
struct Meter {
  std::size_t held = 0;
};

/// A share of a meter; given back when it is destroyed.
class Charge {
 public:
  Charge() = default;
  Charge(std::shared_ptr<Meter> meter, std::size_t bytes) : meter_(std::move(meter)), bytes_(bytes) {
    meter_->held += bytes_;
  }
  Charge(Charge&& other) noexcept : meter_(std::move(other.meter_)), bytes_(std::exchange(other.bytes_, 0)) {}
  Charge& operator=(Charge&& other) noexcept {
    std::swap(meter_, other.meter_);
    std::swap(bytes_, other.bytes_);
    return *this;
  }
  Charge(const Charge&) = delete;
  Charge& operator=(const Charge&) = delete;
  ~Charge() {
    if (meter_ != nullptr) meter_->held -= bytes_;
  }

 private:
  std::shared_ptr<Meter> meter_;
  std::size_t bytes_ = 0;
};

}  // namespace garment::interpreter
