#pragma once
// Where a statement typed at the prompt goes in the text of the script.
#include <string>
#include <vector>

#include "grammar/syntax_tree.hpp"
#include "interpreter/session/patch.hpp"

namespace garment::session {

enum class EditKind {
  value,     ///< a value was changed where it stands
  replaced,  ///< a statement was put in the place of the one of the same name
  added,     ///< a statement was added
};

struct ScriptEdit {
  EditKind kind = EditKind::added;
  bool declares = false;  ///< a statement that is no assignment
  std::string name;       ///< "front.waist_dart.depth", "seam side"
  std::string before;     ///< text that was there; empty where nothing was
  std::string after;      ///< text that is there now
};

/// One statement of an entry, and its text with the comments above it.
struct TypedStatement {
  const grammar::Statement* statement = nullptr;
  Typed typed;
};

/// Cuts an entry into its statements.
std::vector<TypedStatement> cut_entry(const grammar::Block& statements, std::string_view entry);

/// Writes one statement of an entry into the script's text:
/// an assignment changes the value where it stands (an assignment of the same name, the value of a `param`,
/// `let` or `measure`, a clause of the declared statement or of one inside it, a field of a fabric's record),
/// and is added as a statement where there is no such place; a declaration takes the place of that of the
/// same name; `place`, `attach`, `gravity` and their like that of the same operands; all else is added after
/// the last declaration. `last` puts what is added at the end, after the acts. The rest of the text stays as
/// it is.
ScriptEdit write_statement(Patch& patch, const TypedStatement& typed, std::string_view entry, bool last);

/// Takes out the statement that declares `name`, with the comments right above it and assignments to it.
/// False where the script has none at its top level.
bool remove_statement(Patch& patch, const std::string& name);

/// `front.waist_dart.depth` as words; empty where the expression is not of that shape.
std::vector<std::string> path_of(const grammar::Expr& expr);
/// The name that a top-level statement declares, or empty; "both side" where `both` declares one for each
/// half.
std::string declared_name(const grammar::Statement& statement);
/// Is it a statement that runs in the order of the script: `drape`, `expect`, `save` ...?
bool is_act(const grammar::Statement& statement);

}  // namespace garment::session
