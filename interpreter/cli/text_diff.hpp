#pragma once
// Two texts as a unified diff, the form that `patch` and reviewers read.
#include <string>

namespace garment::cli {

/// `--- NAME`, `+++ NAME`, hunks with three lines around; empty where the texts are the same. Not always the shortest
/// diff, but always a right one, in time linear in the texts.
std::string unified_diff(const std::string& before, const std::string& after, const std::string& name);

}  // namespace garment::cli
