#include "runtime/base/host.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

#include "runtime/base/access.hpp"
#include "runtime/base/descriptor.hpp"
#include "runtime/base/folder.hpp"
#include "runtime/base/interrupt.hpp"

namespace garment {
namespace {

using detail::Descriptor, detail::last_error, detail::write_all;

volatile std::sig_atomic_t interrupt_count = 0;
volatile std::sig_atomic_t survives = 0;

extern "C" void on_interrupt(int) {
  // A second Ctrl-C means "now": give the signal back to the system.
  interrupt_count = interrupt_count + 1;
  if (interrupt_count > 1 && survives == 0) {
    std::signal(SIGINT, SIG_DFL);
    std::raise(SIGINT);
  }
}

class SystemHost final : public Host {
 public:
  HostResult<std::string> read_file(const std::string& path, std::uint64_t max_bytes) override {
    return read_all(Descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)), max_bytes);
  }

  HostResult<std::string> read_below(const std::vector<std::string>& folders, const std::string& path,
                                     std::uint64_t max_bytes) override {
    const HostResult<int> opened = open_below(folders, path);
    if (!opened) return {std::nullopt, opened.error};
    return read_all(Descriptor(*opened.value), max_bytes);
  }

  HostResult<bool> write_below(const std::vector<std::string>& folders, const std::string& path,
                               std::string_view bytes) override {
    return write_below_folders(folders, path, bytes);
  }

  void remove_below(const std::vector<std::string>& folders, const std::string& path) override { remove_below_folders(folders, path); }

  static HostResult<std::string> read_all(const Descriptor& fd, std::uint64_t max_bytes) {
    if (fd.get() < 0) return {std::nullopt, last_error()};
    struct stat info {};
    if (::fstat(fd.get(), &info) != 0) return {std::nullopt, last_error()};
    if (S_ISDIR(info.st_mode)) return {std::nullopt, {"is a folder, not a file"}};
    if (!S_ISREG(info.st_mode)) return {std::nullopt, {"is not a regular file"}};
    if (static_cast<std::uint64_t>(info.st_size) > max_bytes)
      return {std::nullopt, {fmt::format("has {} bytes, at most {} are read", info.st_size, max_bytes)}};
    std::string bytes(static_cast<std::size_t>(info.st_size), '\0');
    std::size_t have = 0;
    while (have < bytes.size()) {
      ssize_t n = ::read(fd.get(), bytes.data() + have, bytes.size() - have);
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) return {std::nullopt, last_error()};
      if (n == 0) break;
      have += static_cast<std::size_t>(n);
    }
    bytes.resize(have);
    return {std::move(bytes), {}};
  }

  HostResult<bool> write_file(const std::string& path, std::string_view bytes) override {
    std::filesystem::path target(path);
    std::error_code code;
    if (target.has_parent_path()) std::filesystem::create_directories(target.parent_path(), code);
    if (code) return {std::nullopt, {code.message()}};
    std::string temporary = path + ".XXXXXX.tmp";
    Descriptor fd(::mkostemps(temporary.data(), 4, O_CLOEXEC));
    if (fd.get() < 0) return {std::nullopt, last_error()};
    auto fail = [&]() -> HostResult<bool> {
      HostError error = last_error();
      ::unlink(temporary.c_str());
      return {std::nullopt, error};
    };
    if (!write_all(fd.get(), bytes)) return fail();
    ::fchmod(fd.get(), 0644);
    if (::close(fd.release()) != 0) return fail();
    if (::rename(temporary.c_str(), path.c_str()) != 0) return fail();
    return {true, {}};
  }

  double seconds() override {
    using namespace std::chrono;
    return duration<double>(steady_clock::now().time_since_epoch()).count();
  }

  bool interrupted() override { return interrupt_count > 0; }

  std::uint64_t peak_memory() override {
    struct rusage usage {};
    if (::getrusage(RUSAGE_SELF, &usage) != 0) return 0;
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
  }
};

}  // namespace

void survive_interrupts() { survives = 1; }
void forget_interrupts() { interrupt_count = 0; }

std::vector<std::string> folder_entries(const std::string& folder) {
  namespace fs = std::filesystem;
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator it(folder.empty() ? "." : folder, error), end; !error && it != end; it.increment(error)) {
    std::error_code unknown;
    names.push_back(it->path().filename().string() + (it->is_directory(unknown) ? "/" : ""));
  }
  std::sort(names.begin(), names.end());
  return names;
}

Host& system_host() {
  static SystemHost host;
  return host;
}

void install_interrupt_handler() {
  struct sigaction action {};
  action.sa_handler = on_interrupt;
  sigemptyset(&action.sa_mask);
  ::sigaction(SIGINT, &action, nullptr);
}

}  // namespace garment
