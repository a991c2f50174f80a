//   A path is resolved to the real one first (links, `..`). It must begin with the real path of a granted folder; then it
//   is walked from that folder, name by name, and no name may be a link any more. So a link that is put there between
//   the two steps is not followed either.
#include "runtime/base/access.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include "runtime/base/descriptor.hpp"

namespace garment {
namespace {

using detail::Descriptor, detail::last_error, detail::write_all;

namespace fs = std::filesystem;

constexpr long kProcFiles = 0x9fa0, kSystemFiles = 0x62656572;  // statfs magic of /proc and /sys

/// The granted folder that holds a real path, and the names that lead there from it.
struct Way {
  fs::path folder;
  std::vector<std::string> names;
};

bool lead(const fs::path& folder, const fs::path& path, Way& way) {
  auto at = path.begin();
  for (const fs::path& name : folder) {
    if (name.empty()) continue;  // of a slash at the end
    if (at == path.end() || *at != name) return false;
    ++at;
  }
  way = {folder, {}};
  for (; at != path.end(); ++at) way.names.push_back(at->string());
  return !way.names.empty();
}

HostError denied() { return {"it lies outside the folders that may be used", true}; }

HostResult<Way> find_way(const std::vector<std::string>& folders, const fs::path& real) {
  for (const std::string& folder : folders) {
    std::error_code code;
    const fs::path root = fs::canonical(folder.empty() ? fs::path(".") : fs::path(folder), code);
    Way way;
    if (!code && lead(root, real, way)) return {way, {}};
  }
  return {std::nullopt, denied()};
}

/// The folder of the last name, each name on the way opened as what it is. With `make`, missing folders are made.
HostResult<Descriptor> walk(const Way& way, bool make) {
  Descriptor at(::open(way.folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
  if (at.get() < 0) return {std::nullopt, last_error()};
  for (std::size_t k = 0; k + 1 < way.names.size(); ++k) {
    const char* name = way.names[k].c_str();
    if (make && ::mkdirat(at.get(), name, 0777) != 0 && errno != EEXIST) return {std::nullopt, last_error()};
    Descriptor next(::openat(at.get(), name, O_PATH | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
    if (next.get() < 0) return {std::nullopt, last_error()};
    at = std::move(next);
  }
  return {std::move(at), {}};
}

}  // namespace

HostResult<int> open_below(const std::vector<std::string>& folders, const std::string& path) {
  std::error_code code;
  const fs::path real = fs::canonical(path, code);
  if (code) {
    // Whether a file outside exists is nobody's business.
    const HostResult<Way> place = find_way(folders, fs::weakly_canonical(path, code));
    if (!place) return {std::nullopt, place.error};
    return {std::nullopt, {"no such file"}};
  }
  const HostResult<Way> way = find_way(folders, real);
  if (!way) return {std::nullopt, way.error};
  const HostResult<Descriptor> folder = walk(*way.value, false);
  if (!folder) return {std::nullopt, folder.error};
  const char* name = way.value->names.back().c_str();
  struct stat info {};
  if (::fstatat(folder.value->get(), name, &info, AT_SYMLINK_NOFOLLOW) != 0) return {std::nullopt, last_error()};
  if (S_ISDIR(info.st_mode)) return {std::nullopt, {"is a folder, not a file"}};
  if (!S_ISREG(info.st_mode)) return {std::nullopt, {"is not a regular file"}};
  Descriptor fd(::openat(folder.value->get(), name, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  if (fd.get() < 0) return {std::nullopt, last_error()};
  struct statfs system {};
  if (::fstatfs(fd.get(), &system) == 0 && (system.f_type == kProcFiles || system.f_type == kSystemFiles))
    return {std::nullopt, {"is not a regular file"}};
  return {fd.release(), {}};
}

HostResult<bool> write_below_folders(const std::vector<std::string>& folders, const std::string& path,
                                     std::string_view bytes) {
  std::error_code code;
  for (const std::string& folder : folders) fs::create_directories(folder, code);
  const fs::path target(path);
  if (target.filename().empty() || target.filename() == "." || target.filename() == "..")
    return {std::nullopt, {"it names a folder, not a file"}};
  const fs::path parent = fs::weakly_canonical(target.has_parent_path() ? target.parent_path() : fs::path("."), code);
  if (code) return {std::nullopt, {code.message()}};
  const HostResult<Way> way = find_way(folders, (parent / target.filename()).lexically_normal());
  if (!way) return {std::nullopt, way.error};
  const HostResult<Descriptor> folder = walk(*way.value, true);
  if (!folder) return {std::nullopt, folder.error};
  const int at = folder.value->get();
  const std::string name = way.value->names.back();
  struct stat info {};
  if (::fstatat(at, name.c_str(), &info, AT_SYMLINK_NOFOLLOW) == 0 && !S_ISREG(info.st_mode) && !S_ISLNK(info.st_mode))
    return {std::nullopt, {S_ISDIR(info.st_mode) ? "is a folder, not a file" : "is not a regular file"}};
  std::string temporary;
  Descriptor fd;
  for (int k = 0; k < 1000 && fd.get() < 0; ++k) {
    temporary = fmt::format("{}.{}.{}.tmp", name, ::getpid(), k);
    fd = Descriptor(::openat(at, temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0644));
    if (fd.get() < 0 && errno != EEXIST) break;
  }
  if (fd.get() < 0) return {std::nullopt, last_error()};
  auto fail = [&]() -> HostResult<bool> {
    const HostError error = last_error();
    ::unlinkat(at, temporary.c_str(), 0);
    return {std::nullopt, error};
  };
  if (!write_all(fd.get(), bytes)) return fail();
  if (::close(fd.release()) != 0) return fail();
  if (::renameat(at, temporary.c_str(), at, name.c_str()) != 0) return fail();
  return {true, {}};
}

void remove_below_folders(const std::vector<std::string>& folders, const std::string& path) {
  std::error_code code;
  const fs::path target(path);
  const fs::path parent = fs::canonical(target.has_parent_path() ? target.parent_path() : fs::path("."), code);
  if (code || target.filename().empty()) return;
  const HostResult<Way> way = find_way(folders, parent / target.filename());
  if (!way) return;
  const HostResult<Descriptor> folder = walk(*way.value, false);
  if (folder) ::unlinkat(folder.value->get(), way.value->names.back().c_str(), 0);
}

}  // namespace garment
