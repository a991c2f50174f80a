#pragma once
// The only door to files, the clock and interruption. Everything above gets a Host&; tests pass one that lives in memory.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace garment {

/// Why a file could not be read or written; `message` is ready to be shown ("no such file", "is a folder", ...).
struct HostError {
  std::string message;
};

template <class T>
struct HostResult {
  std::optional<T> value;
  HostError error;
  explicit operator bool() const { return value.has_value(); }
};

class Host {
 public:
  virtual ~Host() = default;

  /// Whole file as bytes. Refuses folders, devices and files larger than `max_bytes`.
  virtual HostResult<std::string> read_file(const std::string& path, std::uint64_t max_bytes) = 0;

  /// Writes to a temporary file beside `path` and renames it, so that a reader never sees half a file. Makes missing
  /// folders. `value` is true on success.
  virtual HostResult<bool> write_file(const std::string& path, std::string_view bytes) = 0;

  /// Seconds on a clock that only goes forward. For reports and progress only: no result may depend on it.
  virtual double seconds() = 0;

  /// True once the user asked to stop (Ctrl-C). Long loops ask at step boundaries and keep the work so far.
  virtual bool interrupted() = 0;

  /// Peak resident memory of the process in bytes; 0 where it is not known.
  virtual std::uint64_t peak_memory() = 0;
};

/// The real machine: files below any path, steady clock, SIGINT (call `install_interrupt_handler` once).
Host& system_host();
void install_interrupt_handler();

}  // namespace garment
