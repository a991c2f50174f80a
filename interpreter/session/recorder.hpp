#pragma once
// What `record` writes while a garment moves: curves as tables, and its shape again and again.
#include <functional>
#include <string>
#include <vector>

#include "interpreter/language/interpret.hpp"
#include "runtime/base/archive.hpp"
#include "runtime/model/model.hpp"

namespace garment::session {

class Recorder {
 public:
  /// Writes one file; its own messages on failure.
  using Write = std::function<void(const std::string& name, const std::string& bytes)>;

  Recorder(interpreter::Interpretation& script, const model::Model& model, Write write)
      : script_(script), model_(model), write_(std::move(write)) {}

  /// From now on; the first sample is taken when the next motion begins.
  void add(const interpreter::RecordAct& act) { tracks_.emplace_back().act = act; }
  bool idle() const { return tracks_.empty(); }
  /// The next time (s) later than `after` at which something is recorded.
  double next(double after) const;
  /// Takes the samples that are due at the state's time. `bodies` are where they are then.
  void sample(const model::State& state, const simulator::DrapeReport& report, const std::vector<body::Body>& bodies);
  /// The points of a curve so far, by its file; null where there are none.
  const interpreter::CurvePoints* curve(const std::string& path) const;
  /// Writes the tables and pictures of curves so far: after each motion, so that a run that fails later keeps them.
  void write_tables();
  /// In a checkpoint, between two samples: what the same records have taken so far. What could not be evaluated is not kept:
  /// see `troubled`.
  void keep(Archive& a);
  bool troubled() const { return !diagnostics_.empty(); }
  /// What could not be evaluated, once for each record.
  grammar::Diagnostics take_diagnostics();

 private:
  struct Track {
    interpreter::RecordAct act{};
    std::string rows{};
    interpreter::CurvePoints points{};
    std::string x_label{}, y_label{};
    int frames = 0;
    bool begun = false;
    double start = 0;   // s, of the first sample
    bool broken = false;
  };
  bool too_many(Track& track);
  void take(Track& track, const model::State& state, const simulator::DrapeReport& report, const std::vector<body::Body>& bodies);
  void write_frame(Track& track, const model::State& state, const std::vector<body::Body>& bodies);

  interpreter::Interpretation& script_;
  const model::Model& model_;
  Write write_;
  std::vector<Track> tracks_;
  grammar::Diagnostics diagnostics_;
};

}  // namespace garment::session
