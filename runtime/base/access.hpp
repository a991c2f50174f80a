#pragma once
// Files below granted folders, without following links out of them.
#include <string>
#include <string_view>
#include <vector>

#include "runtime/base/host.hpp"

namespace garment {

/// Opens the file at `path` for reading if it really lies below one of `folders`. `value` is its descriptor, which the
/// caller closes. Only regular files are opened; those that the system makes up (/proc, /sys) are none.
HostResult<int> open_below(const std::vector<std::string>& folders, const std::string& path);

/// Writes below one of `folders` by way of a temporary file beside the place.
HostResult<bool> write_below_folders(const std::vector<std::string>& folders, const std::string& path,
                                     std::string_view bytes);

/// Removes a file below one of `folders`; nothing happens where there is none.
void remove_below_folders(const std::vector<std::string>& folders, const std::string& path);

}  // namespace garment
