#pragma once
// Everything one interpretation knows while it runs: scopes, declarations, the garment as far as it is made,
// budgets. Only the interpreter's own files include this.
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "grammar/syntax_tree.hpp"
#include "interpreter/language/construct_table.hpp"
#include "interpreter/language/interpret.hpp"
#include "interpreter/language/value.hpp"
#include "runtime/body/body.hpp"
#include "runtime/body/frame.hpp"

namespace garment::interpreter {

using grammar::Clause;
using grammar::Diagnostic;
using grammar::Expr;
using grammar::ExprKind;
using grammar::Span;
using grammar::Statement;

/// This declaration or statement cannot go on; a diagnostic was given. Never leaves the room.
struct Stop {};
/// A budget is spent: nothing goes on. Never leaves the room.
struct Exhausted {};

struct Declaration;
struct Scope;
struct Recipe;

/// A clause with the scope its values are evaluated in: assignments put clauses of one place into another
/// statement.
struct BoundClause {
  const Clause* clause = nullptr;
  Scope* scope = nullptr;
};

/// `name.property = value`, seen from the statement it changes.
struct Override {
  std::vector<std::string> path;  ///< after the declared name
  const Expr* value = nullptr;
  Scope* scope = nullptr;
  Span span;
  bool used = false;
  int depth = 0;  ///< how many parts deep it is said; what is said outside holds
};

/// One use of a component. Its declarations live in `scope`, its arguments too.
struct Part {
  std::string name;  ///< "left_sleeve"; of a part in a part "left_sleeve.cuff"
  const Part* outer = nullptr;
  Declaration* component = nullptr;
  Scope* scope = nullptr;
  Span span;  ///< the `part` statement
  int depth = 1;
  bool broken = false;  ///< something of its block was refused: what is missing in it is no second mistake
};

struct Declaration {
  enum class State { waiting, running, done, failed };
  std::string name;
  const Statement* statement = nullptr;
  Scope* scope = nullptr;
  Module* module = nullptr;
  State state = State::waiting;
  int index = -1;  ///< among panels, bodies, seams or pins
  Value value;
  std::vector<Override> overrides;
  /// Gives the value in place of the construct's record: arguments of a part.
  Value (*evaluate)(Program&, Declaration&) = nullptr;
  Declaration* pair_left = nullptr;  ///< of the right one of a `pair panel`: the one it mirrors
  /// What its value was made from: the declarations asked for while it was evaluated. Nothing may follow from their
  /// order here.
  std::set<Declaration*> needs;
};

/// Names visible at a place. Statement scopes live in Program::scopes; a call's scope lives on the stack.
struct Scope {
  Scope* parent = nullptr;
  Module* module = nullptr;
  std::string half;  ///< "left" or "right" inside `both`
  mutable bool half_used = false;
  const Part* part = nullptr;  ///< the part whose block this is in
  int drawn = -1;  ///< a panel being drawn: what is drawn of it so far is known by its plain names
  const std::map<std::string, std::string>* renamed = nullptr;  ///< of the drawn panel, by `rename`
  std::map<std::string, Value, std::less<>> values;
  std::map<std::string, Declaration*, std::less<>> declared;
};

/// A statement ready to run, in source order.
struct Item {
  const Statement* statement = nullptr;
  Scope* scope = nullptr;
  Declaration* declaration = nullptr;  ///< nothing for unnamed statements
};

/// One source file: the script, or a used library.
struct Module {
  std::string name;
  bool library = false;
  int depth = 0;
  bool loading = false;     ///< its `use` statements are being run
  bool has_broken = false;  ///< a broken statement may have declared anything: unknown names stay unsaid
  std::map<std::string, Span> uses;  ///< name -> where it is used here
  Span used_at{};                    ///< of a library: the `use` in the script that leads to it
  bool titled = false;               ///< its `garment` line was met
  grammar::Script script;
  Scope* scope = nullptr;
  std::vector<Item> items;
};

/// An edge as a script speaks of it.
struct NamedEdge {
  std::string name;                     ///< "side", without the half
  std::string half;                     ///< "left", "right", or "" for the whole
  std::vector<design::EdgePart> parts;  ///< in drawn direction
  Span span;
};

struct PanelInfo {
  design::Panel panel;
  bool ready = false;
  const Part* part = nullptr;  ///< that it is declared in
  bool folded = false;
  double area = 0;                ///< of the outline, m^2
  bool counter_clockwise = true;  ///< sense of Panel::edges
  std::vector<NamedEdge> edges;
  std::map<std::string, Span> spans;  ///< of all that is named in the panel, by its drawn name
  std::set<std::string> own_allowance;    ///< edges, by drawn name, whose allowance is stated for them alone
  bool on_back = false;               ///< placed on a `.back`: left is the smaller-x half
  std::vector<Item> modifiers;        ///< `slash`, `move`, `scale` that act on it, in order
};

/// `start at X`: the place where closed rings begin.
struct SeamStart {
  int seam = -1, zip = -1;  ///< where one of these ends
  int panel = -1;           ///< or a point of a panel
  design::Point2 point{0, 0};
  Span span;
};

struct SeamInfo {
  design::Seam seam;
  std::vector<SeamStart> starts;
  std::vector<EdgeValue> sides;  ///< as written
  std::vector<Span> spans;
  bool ready = false;
  const Part* part = nullptr;  ///< that it is declared in
};

struct Program {
  grammar::Sources& sources;
  Host& host;
  InterpretOptions options;

  std::deque<Module> modules;
  std::deque<Scope> scopes;
  std::deque<Declaration> declarations;
  std::deque<Statement> made_statements;  ///< copies that `both` and assignments made
  std::deque<Clause> made_clauses;
  std::map<std::string, Module*> loaded;  ///< by path
  Module* main = nullptr;

  design::Garment garment;
  std::deque<PanelInfo> panels;  ///< stay where they are when parts bring in more
  std::vector<SeamInfo> seams;
  std::map<int, std::shared_ptr<const Recipe>> recipes;  ///< by panel
  std::vector<Item> panel_places;                        ///< `place` inside a panel's block
  std::map<std::shared_ptr<const design::Fabric>, int> fabric_index;  ///< keeps them alive, so that none is mistaken
  std::vector<std::shared_ptr<const body::Body>> built;  ///< by body index; empty until asked
  std::vector<bool> build_failed;
  std::map<int, body::Frame> frames;  ///< of mannequins, by body index
  std::deque<Part> parts;             ///< ThingValue::index of a `part` is its place here
  std::vector<std::string> estimated;  ///< measures of the person being made that its record does not state
  std::set<int> placed;
  std::vector<Act> acts;
  std::size_t studies = 0;      ///< `vary` met so far
  std::vector<Act> study_acts;  ///< of InterpretOptions::study
  std::vector<MeasureValue> measures;
  std::vector<SolvedValue> solved;
  int solving = 0;  ///< solves within each other that are being tried
  std::vector<Parameter> parameters;
  std::map<std::string, std::string> given;  ///< parameters not yet met

  grammar::Diagnostics diagnostics;
  bool has_error = false;
  Origins origins;
  std::vector<Declaration*> running;     ///< for cycles
  std::vector<Span> calls;               ///< places of the calls being run
  const Part* part = nullptr;            ///< whose block is being evaluated
  const DrapeMeasures* drape = nullptr;  ///< while an `expect` is evaluated
  std::shared_ptr<Meter> meter = std::make_shared<Meter>();  ///< of the values
  std::size_t steps = 0;
  int depth = 0;
  std::size_t expanded = 0;  ///< statements made by loops

  Program(grammar::Sources& s, Host& h, InterpretOptions o) : sources(s), host(h), options(std::move(o)) {}

  /// A new id for a place of the script.
  OriginId origin(Span span);
  Scope& new_scope(Scope* parent);
  bool in_library(Span span) const;
};

/// Starts a diagnostic; the chain ends with `report` (goes on) or `fail` (stops this statement).
struct Message {
  Diagnostic diagnostic;
  Message(std::string code, std::string text, Span span, std::string label = {});
  Message& warning();
  Message& also(Span span, std::string label);
  Message& help(std::string text);
};
void report(Program& program, Message message);
[[noreturn]] void fail(Program& program, Message message);

/// One step of work; stops everything after 50 million.
void count_step(Program& program, Span span);

}  // namespace garment::interpreter
