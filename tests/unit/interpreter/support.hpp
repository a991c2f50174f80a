#pragma once
// A script to try: text in, interpretation out, with a plain person in place of the parametric one.
#include <catch2/catch.hpp>
#include <map>
#include <string>

#include "interpreter/language/interpret.hpp"
#include "runtime/base/host.hpp"

namespace garment::interpreter::test {

/// Files in memory; what is not there is read from disk (the standard library).
class MemoryHost : public Host {
 public:
  std::map<std::string, std::string> files;
  HostResult<std::string> read_file(const std::string& path, std::uint64_t max_bytes) override {
    if (const auto found = files.find(path); found != files.end()) return {found->second, {}};
    return system_host().read_file(path, max_bytes);
  }
  HostResult<bool> write_file(const std::string&, std::string_view) override {
    return {std::nullopt, {"read only"}};
  }
  double seconds() override { return 0; }
  bool interrupted() override { return false; }
  std::uint64_t peak_memory() override { return 0; }
};

/// A person with the girths of the declared one; no surface.
inline body::BodyResult plain_person(const design::Body& declared, Host&, const std::string&) {
  body::BodyResult result;
  result.body.emplace();
  result.body->name = declared.name;
  if (const auto* person = std::get_if<design::Mannequin>(&declared.shape)) {
    result.body->levels["waist"] = {1.07, person->measures.at("waist")};
    result.body->levels["hip"] = {0.87, person->measures.at("hip")};
    result.body->levels["bust"] = {1.21, person->measures.at("bust_chest")};
    for (const char* part : {"torso", "arm.left", "arm.right", "leg.left", "leg.right", "neck", "head"})
      result.body->parts[part].name = part;
  }
  return result;
}

struct Trial {
  MemoryHost host;
  grammar::Sources sources;
  Interpretation result;
  InterpretOptions options;

  /// Runs a script. «...» marks a place; the marks are taken out and the first remembered.
  explicit Trial(std::string script, InterpretOptions with = {},
                 std::map<std::string, std::string> files = {})
      : options(std::move(with)) {
    const std::string open = "\u00ab", shut = "\u00bb";
    if (const std::size_t at = script.find(open); at != std::string::npos) {
      script.erase(at, open.size());
      const std::size_t end = script.find(shut);
      script.erase(end, shut.size());
      mark = {0, static_cast<std::uint32_t>(at), static_cast<std::uint32_t>(end)};
    }
    host.files = std::move(files);
    options.stdlib_dir = GARMENT_STDLIB_DIR;
    if (!options.build_body) options.build_body = plain_person;
    const grammar::SourceId source = sources.add("try.garment", script);
    result = interpret(sources, source, host, options);
  }

  grammar::Span mark;

  std::string text() const {
    std::string all;
    for (const auto& d : result.diagnostics) all += grammar::render(d, sources, false) + "\n";
    return all;
  }
};

/// The script is accepted without errors (warnings are allowed).
inline void accepts(const Trial& trial) {
  INFO(trial.text());
  CHECK(trial.result.ok());
}

inline const design::Panel& last_panel(const Trial& trial) {
  INFO(trial.text());
  REQUIRE(trial.result.ok());
  REQUIRE_FALSE(trial.result.garment.panels.empty());
  return trial.result.garment.panels.back();
}

/// What `measure` shows of an expression.
inline std::string value_of(const std::string& expr, const std::string& before = "") {
  const Trial trial(before + "\nmeasure answer = " + expr + "\n");
  INFO(expr);
  INFO(trial.text());
  REQUIRE(trial.result.ok());
  return trial.result.measures.back().text;
}

/// Exactly one error, with this code, at the marked place.
inline void refuses(const std::string& script, const std::string& code, const std::string& says = "",
                    InterpretOptions options = {}) {
  const Trial trial(script, std::move(options));
  INFO(script);
  INFO(trial.text());
  int errors = 0;
  for (const auto& d : trial.result.diagnostics) errors += d.severity == Severity::error ? 1 : 0;
  REQUIRE(errors == 1);
  for (const auto& d : trial.result.diagnostics) {
    if (d.severity != Severity::error) continue;
    CHECK(d.code == code);
    REQUIRE_FALSE(d.labels.empty());
    if (trial.mark.end > 0) {
      CHECK(trial.sources.text(d.labels[0].span) == trial.sources.text(trial.mark));
      CHECK(d.labels[0].span == trial.mark);
    }
    if (!says.empty()) CHECK((d.message + " | " + d.help).find(says) != std::string::npos);
  }
}

}  // namespace garment::interpreter::test
