#pragma once
// Scripts that must be understood, as the garment and the bodies that they declare.
#include <catch2/catch.hpp>
#include <map>
#include <string>

#include "interpreter/language/interpret.hpp"
#include "runtime/base/host.hpp"

namespace garment::test {

struct Declared {
  design::Garment garment;
  std::vector<body::Body> bodies;
};

/// The test fails, with what was found, where the script has errors.
inline Declared declared(const std::string& script, const std::map<std::string, std::string>& params = {}) {
  grammar::Sources sources;
  interpreter::InterpretOptions options;
  options.stdlib_dir = GARMENT_STDLIB_DIR;
  options.params = params;
  interpreter::Interpretation result = interpreter::interpret(sources, sources.add("x", script), system_host(), options);
  std::string told;
  for (const auto& d : result.diagnostics)
    if (d.severity == Severity::error) told += grammar::render(d, sources, false);
  INFO(told);
  REQUIRE(result.ok());
  return {std::move(result.garment), std::move(result.bodies)};
}

}  // namespace garment::test
