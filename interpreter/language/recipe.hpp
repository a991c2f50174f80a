#pragma once
// What a panel is made of, before it is drawn: its statements, with the changes of `like` blocks and
// assignments.
#include <map>
#include <string>
#include <vector>

#include "interpreter/language/evaluate.hpp"

namespace garment::interpreter {

/// A statement of a panel's block (edge, line, dart, notch ...) with what was changed in it.
struct RecipeItem {
  const Statement* statement = nullptr;
  Scope* scope = nullptr;
  std::string name;
  std::vector<Override> overrides;
  std::map<std::string, std::string> renamed;  ///< names in the statement's text -> names today
  std::string owner;                           ///< of a hole's edge: the hole
};

/// `grain`, `resolution`, `label`: one value.
struct RecipeValue {
  const Expr* value = nullptr;
  Scope* scope = nullptr;
  Span span;
};

struct Recipe {
  RecipeValue fabric;
  std::string fold;  ///< edge name, or empty
  Span fold_span;
  bool mirrored = false;
  RecipeItem outline;
  std::vector<RecipeItem> edges;
  std::vector<RecipeItem> interior;    ///< lines, points, holes and slits, in the order written
  std::vector<RecipeItem> hole_edges;  ///< of all holes
  std::vector<RecipeItem> notches, darts, pleats;
  std::vector<RecipeItem> allowances;  ///< `allowance LENGTH [on EDGE]`; they have no names
  std::map<std::string, RecipeValue> values;

  /// All lists of things that have names.
  std::vector<std::vector<RecipeItem>*> lists() {
    return {&edges, &interior, &hole_edges, &notches, &darts, &pleats};
  }
};

/// Puts a panel's recipe together. Reports and throws Stop.
Recipe make_recipe(Program& program, Declaration& declaration);

}  // namespace garment::interpreter
