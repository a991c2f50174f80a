#pragma once
// The difference of two texts, as `diff -u` says it.
#include <string>
#include <string_view>

namespace garment::session {

/// Unified diff with three lines of context and the names in its head; empty where the texts are equal.
std::string unified_diff(std::string_view before, std::string_view after, std::string_view name_before,
                         std::string_view name_after);

}  // namespace garment::session
