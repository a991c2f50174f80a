#pragma once
// `garment reference`: the page docs/reference.md, made from the tables and from the command line itself.
#include <CLI/CLI.hpp>
#include <string>

#include "runtime/base/host.hpp"

namespace garment::cli {

/// The constructs, functions, units, codes (interpreter::reference_markdown), the standard library in `stdlib_dir`, then the
/// commands of `app`.
std::string reference_page(const CLI::App& app, const std::string& stdlib_dir, Host& host);

}  // namespace garment::cli
