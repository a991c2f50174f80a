#pragma once
// What a session is at one moment: the text, what it means, its model, and the shape it hangs in.
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "interpreter/language/interpret.hpp"
#include "interpreter/session/body_cache.hpp"
#include "interpreter/session/patch.hpp"
#include "runtime/model/model.hpp"
#include "runtime/simulator/drape.hpp"

namespace garment::session {

/// A text and its meaning. Never moved: the interpretation speaks of the sources.
struct Evaluated {
  grammar::Sources sources;
  grammar::SourceId source = 0;
  interpreter::Interpretation result;
};

/// The model of a text, or why there is none.
struct Modelled {
  std::optional<model::Model> model;
  grammar::Diagnostics diagnostics;  ///< places in the sources of its Evaluated
  grammar::Diagnostics of_start;     ///< what a drape from the start minds, where the script has none: told by the first one typed
  bool failed = false;               ///< there are errors (not only things that cannot be modelled yet)
  bool dressed = true;               ///< the start is kept out of the bodies; otherwise nobody may use it
};

/// A shape and how it came about. Without a drape it is where the panels were placed.
struct Shape {
  std::shared_ptr<const model::State> state;  ///< null without a model
  simulator::DrapeReport report;
  simulator::Settle settle = simulator::Settle::equilibrium;
  bool draped = false;   ///< `report` speaks of this shape
  bool carried = false;  ///< carried over from a drape and not draped since
  double strained = 0;   ///< simulator::strained_share at the last rest
};

/// Names of pins and clamps that `release` let go.
using Released = std::set<std::string>;

/// The garment less the pins and clamps of these names.
design::Garment less(const design::Garment& garment, const Released& released);

struct Stage {
  std::string text;
  std::string entry;  ///< what was typed to come here; empty at the start
  std::shared_ptr<Evaluated> evaluated;
  std::shared_ptr<const Modelled> modelled;  ///< without what was released
  Shape shape;
  Released released;
};

/// How a session turns text into meaning.
struct Workshop {
  Host& host;
  BodyCache& bodies;
  std::string name;  ///< of the script in messages
  std::string stdlib_dir, script_dir;
  std::vector<std::string> library_dirs, allow_read;  ///< as in interpreter::InterpretOptions

  std::shared_ptr<Evaluated> evaluate(const std::string& text) const;
  /// `dress` as in modeller::ModelOptions; a model that holds particles where they start is always dressed.
  Modelled build(const Evaluated& evaluated, const Released& released, bool dress = true) const;
};

/// Are particles held where they start?
bool start_matters(const model::Model& model);
/// All the same but for where they start?
bool same_model(const model::Model& a, const model::Model& b);

/// Where the panels were placed, at rest.
std::shared_ptr<const model::State> start_state(const model::Model& model);

/// Moves the places of diagnostics that lie in what was typed to a source of their own, `<prompt>`, which is
/// added to the sources.
void show_as_typed(Evaluated& evaluated, grammar::Diagnostics& diagnostics, const Patch& patch,
                   const std::string& entry);

}  // namespace garment::session
