#pragma once
// What a run found, as data: the command line fills a Report, report_json prints it.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "runtime/results/measures.hpp"
#include "runtime/results/strain.hpp"
#include "runtime/simulator/drape.hpp"

namespace garment::results {

inline constexpr int kReportSchema = 1;

/// A file that the result depends on, by the SHA-256 of its bytes.
struct SourceHash {
  std::string name;  ///< as the script says it, never an absolute path
  std::string sha256;
};

struct ParameterValue {
  std::string name;
  std::string value;    ///< as printed by the language, "58 cm"
  bool stated = false;  ///< given from outside rather than the script's default
};

/// One `measure` of the script.
struct MeasureOutcome {
  std::string name;
  std::optional<double> value;  ///< SI; nothing where it is no number
  std::string unit;             ///< SI unit of `value`, "" for numbers
  std::string shown;            ///< as printed by the language, "58 cm"
};

/// One `expect`.
struct ExpectOutcome {
  std::string text;             ///< the statement as written
  std::optional<double> value;  ///< SI; nothing when it could not be evaluated
  std::string shown;            ///< the value as printed, with its unit
  std::string expected;
  bool passed = false;
};

/// What a `solve` of the script found.
struct SolveOutcome {
  std::string name;
  double value = 0, residual = 0;  ///< SI; of the condition, left minus right
  std::string shown, shown_residual;
  std::string bound;  ///< "low" or "high" where an end of the range was reached, else empty
};

struct PhaseTime {
  std::string phase;  ///< "parse", "model", "drape", "write", ...
  double seconds = 0;
};

struct OutputFile {
  std::string name;
  std::string sha256;
  std::uint64_t bytes = 0;
};

struct Report {
  std::string title;
  std::string script;
  std::vector<SourceHash> sources;  ///< the script and the files it reads
  std::vector<SourceHash> library;  ///< of the standard library
  std::vector<ParameterValue> parameters;
  std::size_t particles = 0, triangles = 0;
  simulator::Settle settle = simulator::Settle::equilibrium;
  simulator::DrapeReport drape;
  StrainReport strain;
  Measures measures;
  std::string state_hash;
  std::vector<SolveOutcome> solves;
  std::vector<MeasureOutcome> stated_measures;  ///< those of the script
  std::vector<ExpectOutcome> expects;
  std::vector<OutputFile> outputs;
  std::vector<PhaseTime> phases;  ///< wall clock, s
  std::uint64_t peak_memory = 0;  ///< bytes; 0 where unknown
};

/// Fills particles, triangles, strain, measures and state_hash.
void fill_results(Report& report, const model::Model& model, const model::State& state,
                  const std::vector<body::Body>& bodies);

/// "at rest", "not settled", ... as the report and the command line say it.
const char* status_name(simulator::DrapeStatus status);

/// JSON text, two spaces of indent, keys in a fixed order, ending in a newline. SI units; strains as
/// fractions, angles in radians. Everything that changes from run to run stands in the object "timings"; the
/// rest is comparable byte for byte.
std::string report_json(const Report& report);

}  // namespace garment::results
