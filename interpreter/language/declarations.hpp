#pragma once
// Which names a script declares, in which order, and the assignments that change them.
#include <string>

#include "interpreter/language/program.hpp"

namespace garment::interpreter {

/// Takes in all statements of a module: declares names, expands `for`, `if` and `both`, runs `use`. Nothing
/// is evaluated but loop ranges and conditions.
void register_module(Program& program, Module& module);

/// Takes in the block of a component as the block of a part: what it declares is known in the part's scope,
/// and in the garment under the part's name.
void register_part(Program& program, Part& part, const grammar::Block& block);

/// Gives every panel, body, seam and pin of the script its index, and attaches assignments to what they
/// change.
void settle_declarations(Program& program, Module& module);

/// Reports and throws Stop where `name` is taken, or hides a unit or a builtin.
void check_new_name(Program& program, const std::string& name, Span span, Scope& scope);

/// Reports assignments that changed nothing because there is no such property.
void check_assignments(Program& program, Module& module);

/// Runs `take` on every statement of a block after `for` and `if` are expanded; in a panel or outline.
void expand_block(Program& program, const grammar::Block& block, Scope& scope,
                  const std::function<void(const Statement&, Scope&)>& take);

/// `let` and `measure`: the value after `=`.
Value evaluate_let(Program& program, Declaration& declaration);
/// `fn NAME(...) = ...`.
Value evaluate_function(Program& program, Declaration& declaration);

/// Parameters of a `fn`: names well formed and not builtin.
void check_function(Program& program, const Declaration& declaration);

}  // namespace garment::interpreter
