#pragma once
// Questions to a script that was interpreted: the value of an expression in its scope, and what it declares.
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "interpreter/language/interpret.hpp"
#include "interpreter/language/value.hpp"

namespace garment::interpreter {

/// Names that a question knows beside those of the script.
using Locals = std::map<std::string, Value, std::less<>>;

struct Asked {
  std::optional<Value> value;        ///< nothing where the expression has none
  grammar::Diagnostics diagnostics;  ///< then why
};

/// Value of `expr` at the top level of the script, with fresh budgets. `drape` answers what asks the drape;
/// null where there is none yet. The tree and its source must outlive the call only.
Asked ask(Interpretation& interpretation, const grammar::Expr& expr, const Locals& locals,
          const DrapeMeasures* drape);

/// True where the expression, or what it names in the script, asks the drape.
bool asks_drape(const Interpretation& interpretation, const grammar::Expr& expr);

/// True for values that mean the same after the script was changed: numbers, text, points, lists of them.
bool is_plain(const Value& value);

/// The value as an answer to a person: quantities with seven digits, edges with their lengths (sewn, as cut,
/// and in the drape), panels with area and edges, fabrics with their weight, levels with height and girth.
std::string describe_value(const Interpretation& interpretation, const Value& value,
                           const DrapeMeasures* drape);

/// Something that the script declares.
struct DeclaredThing {
  std::string name;     ///< "front", "side.left"
  std::string keyword;  ///< "panel"
  const grammar::Statement* statement = nullptr;
  const Value* value = nullptr;  ///< null where it has none (yet)
};
/// In the order of the script; loops and `both` expanded.
std::vector<DeclaredThing> declared_things(const Interpretation& interpretation);

}  // namespace garment::interpreter
