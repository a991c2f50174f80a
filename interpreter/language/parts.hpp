#pragma once
// Components and their uses: `component`, `part`, `port`, `join`.
#include <string>
#include <vector>

#include "interpreter/language/evaluate.hpp"

namespace garment::interpreter {

/// `component NAME(PARAMETERS) { ... }`: its head is checked; the block waits for a part.
Value evaluate_component(Program& program, Declaration& declaration);
/// `part NAME = COMPONENT(ARGUMENTS)`, after it was taken in.
Value evaluate_part(Program& program, Declaration& declaration);
/// `port NAME = EDGE`.
Value evaluate_port(Program& program, Declaration& declaration);

/// Takes in a part: its arguments and the statements of its component, under the part's name. Reports and
/// throws Stop.
void expand_part(Program& program, const Item& item);

/// `join PORT to EDGE ...` as the `seam` that it is, and the name that this seam gets.
const Statement& make_join(Program& program, const Statement& statement);
std::string join_name(Program& program, const Statement& statement, Scope& scope);
Value evaluate_join(Program& program, Declaration& declaration);

/// True for the declaration of a part's argument. Its value may be assigned from outside: `left_sleeve.long =
/// 55 cm`.
bool is_argument(const Declaration& declaration);

/// `left_sleeve.upper.waist_dart.depth` by its words alone, nothing evaluated: the declaration that the first
/// words name, through parts and through arguments that are names themselves, and the words that are left.
/// Null where the first word names nothing declared, or `expr` is no chain of names. What is there left and right (a
/// pair, or by `both`) and is called without a half is the left one, and `twin` the right one. An argument of a part
/// that stands alone is itself, or what it names where `through` is true.
struct DeclaredPath {
  Declaration* declaration = nullptr;
  std::vector<std::string> rest;
  Declaration* twin = nullptr;
};
DeclaredPath find_path(Program& program, const Expr& expr, Scope& scope, bool through = false);

/// `part.name`: a port, or anything else declared in the part's block.
Value part_member(Program& program, const Expr& expr, const ThingValue& part, const std::string& name);

[[noreturn]] void fail_part_member(Program& program, const Part& part, const std::string& name, Span span);

/// Components of the script that no part uses: a warning each.
void check_components(Program& program);

/// While it lives, messages know that they come out of this part: the `part` statement is shown where the
/// component stands in a library.
class PartGuard {
 public:
  PartGuard(Program& program, const Part* part);
  PartGuard(const PartGuard&) = delete;
  PartGuard& operator=(const PartGuard&) = delete;
  ~PartGuard();

 private:
  Program& program_;
  const Part* before_;
  std::size_t calls_;
};

}  // namespace garment::interpreter
