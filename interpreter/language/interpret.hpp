#pragma once
// From the text of a script to the declared garment, its bodies and the acts that follow.
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "grammar/diagnostic.hpp"
#include "grammar/syntax_tree.hpp"
#include "interpreter/language/curve_questions.hpp"
#include "interpreter/language/origins.hpp"
#include "runtime/base/finding.hpp"
#include "runtime/base/host.hpp"
#include "runtime/body/body.hpp"
#include "runtime/design/garment.hpp"
#include "runtime/simulator/drape.hpp"

namespace garment::interpreter {

struct Program;

/// One round of a `vary`: the garment with this value, and the acts of its block alone.
struct Study {
  std::size_t ordinal = 0;  ///< of the `vary`, see VaryAct
  std::string target, value;
};

struct InterpretOptions {
  std::string stdlib_dir;                     ///< folder of the standard library
  std::vector<std::string> library_dirs;      ///< where `use NAME` looks first
  std::string script_dir;                     ///< files named by the script are looked up below it
  std::map<std::string, std::string> params;  ///< name -> expression text, as after `-p`
  std::vector<std::string> allow_read;        ///< further folders below which files may be read
  std::vector<std::string> allow_write;       ///< folders beside the output folder below which `save` may write
  /// Build all declared bodies. Otherwise mannequins are built only where a script asks what their measures do not
  /// tell, and Interpretation::bodies is empty for the others.
  bool build_bodies = true;
  bool warn_unused = false;  ///< of names that a whole script never uses; at the prompt they may still be
  std::optional<Study> study{};
  /// How bodies are built; empty: body::build_body.
  std::function<body::BodyResult(const design::Body&, Host&, const std::string&)> build_body;
};

/// `drape until rest` or `drape for 2 s`.
struct DrapeAct {
  bool until_rest = true;
  simulator::Settle settle = simulator::Settle::equilibrium;
  double duration = 0;  ///< s, where not until rest
};
/// `expect` and a `measure` or `assert` that asks the drape. `condition` points into the tree that the
/// Interpretation keeps alive.
struct ExpectAct {
  const grammar::Statement* statement = nullptr;
  void* scope = nullptr;  ///< opaque
  std::string text;       ///< as written
};
struct SaveAct {
  std::vector<std::string> paths;
};
struct MeasureAct {
  std::string name;
  const grammar::Statement* statement = nullptr;
  void* scope = nullptr;  ///< opaque
  std::string text;
};
/// `release`: one of the two is an index.
struct ReleaseAct {
  int pin = -1;    ///< into Garment::pins
  int clamp = -1;  ///< into Scene::clamps
};
/// `record curve X, Y` or `record frames`, of the drapes for a time that follow.
struct RecordAct {
  bool frames = false;
  std::string x, y;  ///< as written; of a curve
  double every = 0;  ///< s
  std::string path;  ///< of frames: the name that each number is put into; of a curve its name
  std::vector<std::string> plots;  ///< pictures of a curve, beside its table
  const grammar::Statement* statement = nullptr;
  void* scope = nullptr;  ///< opaque
};
/// `vary TARGET over VALUE, ...`: each value is a script of its own, made with InterpretOptions::study.
struct VaryAct {
  std::size_t ordinal = 0;  ///< which `vary` of the script, from 0
  std::string target;       ///< as written
  std::vector<std::string> values;
};
struct Act {
  std::variant<DrapeAct, ExpectAct, SaveAct, MeasureAct, ReleaseAct, RecordAct, VaryAct> act;
  grammar::Span span;
};

struct Parameter {
  std::string name, doc, value, standard;  ///< value and default as text
  std::string range;                       ///< "30 cm .. 110 cm", "\"slim\", \"loose\"" or empty
  bool given = false;
};

/// A value for the report: SI number with its unit, or text.
struct MeasureValue {
  std::string name;
  std::string text;             ///< "58 cm"
  std::optional<double> value;  ///< SI
  std::string unit;             ///< SI unit of `value`, "" for numbers
};

/// What a `solve` found.
struct SolvedValue {
  std::string name;
  std::string text;             ///< "13.2 cm"
  double value = 0;             ///< SI
  std::string unit;             ///< SI unit of `value`
  std::string residual;         ///< left minus right side of the condition, as text
  double residual_value = 0;    ///< SI
  std::string residual_unit;
  std::string bound;            ///< "low" or "high" where an end of the range was reached, else empty
  int trials = 0;
};

struct Interpretation {
  design::Garment garment;
  std::vector<body::Body> bodies;  ///< of garment.bodies, same order; empty where one could not be built
  std::vector<Act> acts;           ///< in the order of the script
  std::vector<Parameter> parameters;
  std::vector<MeasureValue> measures;
  std::vector<SolvedValue> solved;          ///< in the order of the script
  grammar::Diagnostics diagnostics;
  Origins origins;                          ///< places of what `garment` is made of
  const grammar::Script* script = nullptr;  ///< the tree of the script, kept alive by `program`
  std::shared_ptr<Program> program;         ///< keeps scopes alive for `expect`; opaque

  /// No error among the diagnostics.
  bool ok() const;
};

/// The script holds only what a library may hold. Values alone may as well be the beginning of a garment whose panels are still
/// to be written.
bool may_be_library(const grammar::Script& script);

/// The script may be a library and has a fabric, a function or a component to offer: it is there for others to use, and what
/// it does not use itself is no news.
bool is_library(const grammar::Script& script);

/// Parses and evaluates one script. Never throws; what is wrong stands in `diagnostics`, and then the garment
/// is only as far as it came. Libraries and command-line parameters are added to `sources`, which with `host`
/// must outlive the result. Same input, same bits.
Interpretation interpret(grammar::Sources& sources, grammar::SourceId source, Host& host,
                         const InterpretOptions& options);

/// What can be asked of a finished drape, SI. An empty panel name means the whole garment; nothing means "not
/// known".
class DrapeMeasures {
 public:
  virtual ~DrapeMeasures() = default;
  /// Answers stand for those of a drape to come: they are not shown to anybody.
  virtual bool stand_in() const { return false; }
  virtual std::optional<double> strain(const std::string& panel) const = 0;  ///< largest tensile, 1
  virtual std::optional<double> shear(const std::string& panel) const = 0;   ///< largest angle, rad
  virtual std::optional<double> stress(const std::string&) const { return std::nullopt; }  ///< largest tension, N/m
  virtual std::optional<double> length(const std::vector<design::EdgePart>& parts) const = 0;  ///< m
  virtual std::optional<double> area(const std::string& panel) const = 0;                      ///< m^2
  virtual std::optional<double> mass(const std::string& panel) const = 0;                      ///< kg
  virtual std::optional<double> clearance(
      const std::string& panel) const = 0;                 ///< least distance to a body, m
  virtual std::optional<double> energy() const = 0;        ///< J
  virtual std::optional<double> penetrations() const = 0;  ///< count
  /// Of one panel, by its index: share of shadow, and folds of the rim.
  virtual std::optional<double> drape_coefficient(int) const { return std::nullopt; }
  virtual std::optional<double> nodes(int) const { return std::nullopt; }
  /// Of a pin by its index in Garment::pins.
  virtual std::optional<Eigen::Vector3d> position(int pin) const = 0;
  /// Force with which a pin or clamp holds the cloth, by its name, N.
  virtual std::optional<Eigen::Vector3d> reaction(const std::string&) const { return std::nullopt; }
  /// The moment of that force about the middle of what is held, N m.
  virtual std::optional<Eigen::Vector3d> moment(const std::string&) const { return std::nullopt; }
  /// The points of a recorded curve so far, by its file; null where there are none.
  virtual const CurvePoints* curve(const std::string&) const { return nullptr; }
  virtual std::optional<double> elapsed() const { return std::nullopt; }  ///< time of the motions, s
  /// Of a point of a panel, panel coordinates in m.
  virtual std::optional<Eigen::Vector3d> position(int panel, const design::Point2& point) const = 0;
};

struct ExpectResult {
  bool passed = false;
  std::string text;                  ///< the condition as written
  std::string found;                 ///< "6.2%"
  std::string expected;              ///< "< 8%"
  std::optional<double> value;       ///< SI, where the left side is a number
  grammar::Diagnostics diagnostics;  ///< where it could not be evaluated, or did not hold
};

ExpectResult evaluate_expect(Interpretation& interpretation, const Act& act, const DrapeMeasures& measures);

/// The two values of a recorded curve as it stands: SI numbers, or why there are none.
struct CurvePoint {
  double x = 0, y = 0;
  std::string x_unit, y_unit;
  grammar::Diagnostics diagnostics;
};
CurvePoint evaluate_curve(Interpretation& interpretation, const RecordAct& act, const DrapeMeasures& measures);

/// Value of a `measure` that asks the drape.
struct MeasureResult {
  MeasureValue measure;
  grammar::Diagnostics diagnostics;
};
MeasureResult evaluate_measure(Interpretation& interpretation, const Act& act, const DrapeMeasures& measures);

}  // namespace garment::interpreter
