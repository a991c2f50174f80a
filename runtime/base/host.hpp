#pragma once
// The only door to files, the clock and interruption. Everything above gets a Host&; tests pass one that lives in memory.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace garment {

/// Why a file could not be read or written; `message` is ready to be shown ("no such file", "is a folder", ...).
struct HostError {
  std::string message;
  bool denied = false;  ///< it lies outside the folders that were granted
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

  /// As `read_file`, but only what really lies below one of `folders`: symbolic links, `..` and absolute paths are
  /// resolved first, and nothing that is no regular file is opened. A Host without a file system reads what it has.
  virtual HostResult<std::string> read_below(const std::vector<std::string>& folders, const std::string& path,
                                             std::uint64_t max_bytes) {
    static_cast<void>(folders);
    return read_file(path, max_bytes);
  }

  /// As `write_file`, but only to a place that really lies below one of `folders`, which are made where they are
  /// missing. A symbolic link at the place itself is replaced, not followed.
  virtual HostResult<bool> write_below(const std::vector<std::string>& folders, const std::string& path,
                                       std::string_view bytes) {
    static_cast<void>(folders);
    return write_file(path, bytes);
  }

  /// Removes the file at `path`, which must really lie below one of `folders`; one that is not there is no matter. Links are
  /// removed themselves.
  virtual void remove_below(const std::vector<std::string>& folders, const std::string& path) {
    static_cast<void>(folders);
    static_cast<void>(path);
  }

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

/// Another host whose reading is confined to what lies below `folders`.
class ConfinedHost final : public Host {
 public:
  ConfinedHost(Host& host, std::vector<std::string> folders) : host_(host), folders_(std::move(folders)) {}
  HostResult<std::string> read_file(const std::string& path, std::uint64_t max_bytes) override {
    return host_.read_below(folders_, path, max_bytes);
  }
  HostResult<bool> write_file(const std::string&, std::string_view) override {
    return {std::nullopt, {"a script may not write while it is evaluated", true}};
  }
  double seconds() override { return host_.seconds(); }
  bool interrupted() override { return host_.interrupted(); }
  std::uint64_t peak_memory() override { return host_.peak_memory(); }

 private:
  Host& host_;
  std::vector<std::string> folders_;
};

/// The real machine: files below any path, steady clock, SIGINT (call `install_interrupt_handler` once).
Host& system_host();
void install_interrupt_handler();

}  // namespace garment
