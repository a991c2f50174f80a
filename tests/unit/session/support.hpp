#pragma once
// A session with files in memory.
#include <catch2/catch.hpp>
#include <map>
#include <string>

#include "interpreter/session/session.hpp"
#include "runtime/base/host.hpp"

namespace garment::session::test {

class MemoryHost : public Host {
 public:
  std::map<std::string, std::string> files;
  HostResult<std::string> read_file(const std::string& path, std::uint64_t max_bytes) override {
    if (const auto found = files.find(path); found != files.end()) return {found->second, {}};
    if (path.find("stdlib") == std::string::npos) return {std::nullopt, {"no such file"}};
    return system_host().read_file(path, max_bytes);
  }
  HostResult<bool> write_file(const std::string& path, std::string_view bytes) override {
    files[path] = std::string(bytes);
    return {true, {}};
  }
  double seconds() override { return 0; }
  bool interrupted() override { return false; }
  std::uint64_t peak_memory() override { return 0; }
};

inline const char* kSquare = R"(garment 1 "square"  # a comment
use fabrics

param wide = 10 cm in 2 cm .. 50 cm  "side of the square"
let tall = 10 cm
fabric thin = fabrics.satin with { friction = 0.2 }  # of the shop

## The cloth.
panel cloth of thin {
  outline from (0, 0) {
    edge bottom to (wide, 0) free
    edge right_side to (wide, tall) free
    edge top to (0, tall) free
    close left_side free
  }
  notch mark on top at 20 mm   # here
  resolution 2 cm
}

place cloth at (0, 1 m, 0)
pin one on cloth at cloth.top.start
pin two on cloth at cloth.top.end

drape until rest settle preview
expect penetrations == 0
)";

struct Prompt {
  MemoryHost host;
  Session session;
  Answer last;

  explicit Prompt(const std::string& script = kSquare, SessionOptions options = {})
      : session(host, with_library(std::move(options))) {
    host.files["square.garment"] = script;
    last = session.open("square.garment");
  }
  static SessionOptions with_library(SessionOptions options) {
    options.stdlib_dir = GARMENT_STDLIB_DIR;
    options.timing = false;
    return options;
  }
  /// Enters and wants an outcome; returns what was said.
  std::string enter(const std::string& entry, Outcome outcome = Outcome::done) {
    last = session.enter(entry);
    INFO(entry);
    INFO(last.text);
    CHECK(last.outcome == outcome);
    return last.text;
  }
  std::string text() const { return session.stage().text; }
};

inline bool has(const std::string& text, const std::string& part) {
  INFO(text);
  INFO(part);
  return text.find(part) != std::string::npos;
}

}  // namespace garment::session::test
