#pragma once
// What lies in a folder, for completing names of files.
#include <string>
#include <vector>

namespace garment {

/// Names in a folder, sorted, those of folders with a `/` at their end; nothing where it cannot be read. For proposals
/// only: no result may depend on it.
std::vector<std::string> folder_entries(const std::string& folder);

}  // namespace garment
