#pragma once
// The standard library in the reference page, made from its files.
#include <string>

#include "runtime/base/host.hpp"

namespace garment::cli {

/// Markdown: the fabrics, the bodies with their measures, levels and parts, and the components of each library file in
/// `folder`. What has no `##` line above it is the library's own business and left out.
std::string library_chapter(const std::string& folder, Host& host);

}  // namespace garment::cli
