#pragma once
// `garment reference`: the page docs/reference.md, made from the tables and from the command line itself.
#include <CLI/CLI.hpp>
#include <string>

namespace garment::cli {

/// The constructs, functions, units, codes (interpreter::reference_markdown), then the commands of `app`.
std::string reference_page(const CLI::App& app);

}  // namespace garment::cli
