#include "interpreter/cli/lsp.hpp"

#include <algorithm>
#include <cstdio>
#include <iostream>

#include "interpreter/lsp/server.hpp"

namespace garment::cli {
namespace {

/// What is there, as soon as anything is.
std::size_t read_bytes(char* at, std::size_t size) {
  std::streambuf& in = *std::cin.rdbuf();
  if (in.sgetc() == std::char_traits<char>::eof()) return 0;
  const std::streamsize ready =
      std::clamp<std::streamsize>(in.in_avail(), 1, static_cast<std::streamsize>(size));
  return static_cast<std::size_t>(in.sgetn(at, ready));
}

void write_bytes(std::string_view bytes) {
  std::fwrite(bytes.data(), 1, bytes.size(), stdout);
  std::fflush(stdout);
}

}  // namespace

ExitCode serve_editor(const std::string& stdlib_dir, Host& host) {
  std::ios::sync_with_stdio(false);
  lsp::Server server(read_bytes, write_bytes, host, stdlib_dir);
  return server.run() ? kOk : kDiagnostics;
}

}  // namespace garment::cli
