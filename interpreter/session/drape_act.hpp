#pragma once
// One `drape` of a script, to rest or for a time: for the command line, the prompt and the tests of scripts alike.
#include <functional>
#include <vector>

#include "interpreter/language/interpret.hpp"
#include "interpreter/session/recorder.hpp"
#include "runtime/simulator/drape.hpp"

namespace garment::session {

/// Where a drape takes place.
struct DrapeScene {
  const interpreter::Interpretation& script;
  const std::vector<body::Body>& bodies;  ///< at time 0
  const model::Model& model;
  bool from_present = false;              ///< the state hangs already: no coarser grids first
  simulator::DrapeSettings settings{};    ///< `settle` is the act's
  Recorder* recorder = nullptr;           ///< of a drape for a time; null: none
};

/// What the script says of its drapes to rest: whether the cloth's own friction acts, and whether a garment on a person is kept symmetric.
void take_stated(const interpreter::Interpretation& script, const std::vector<body::Body>& bodies, simulator::DrapeSettings& settings);

/// Drapes `state`. To rest, moving clamps and bodies stand where they are at the state's time.
simulator::DrapeReport perform_drape(const interpreter::DrapeAct& act, const DrapeScene& scene, model::State& state);

/// Adds to the report what lies on the wrong side of what it is declared over or under, where the garment came to rest (G0811).
void look_at_layers(const design::Garment& garment, const model::Model& model, const model::State& state, simulator::DrapeReport& report);

/// At rest, as physics goes, but not as the script says (an error among the findings).
bool rests_otherwise(const simulator::DrapeReport& report);

/// Lets a pin or clamp go: `holding` is the garment less what was released so far, whose holds the model gets; all else of it stays.
/// Returns why it could not, with both as they were but for what no longer holds.
Findings let_go(const interpreter::ReleaseAct& act, const std::vector<body::Body>& bodies, design::Garment& holding, model::Model& model);

/// What the drape found, as diagnostics; what has no place of its own stands at the act's.
grammar::Diagnostics told_by(const simulator::DrapeReport& report, const interpreter::Interpretation& script, grammar::Span act);

}  // namespace garment::session
