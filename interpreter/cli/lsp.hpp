#pragma once
// `garment lsp`: the language server on standard input and output.
#include <string>

#include "interpreter/cli/exit_codes.hpp"
#include "runtime/base/host.hpp"

namespace garment::cli {

/// Serves until the client leaves; 0 if it asked to shut down before, as the protocol has it, else 1.
ExitCode serve_editor(const std::string& stdlib_dir, Host& host);

}  // namespace garment::cli
