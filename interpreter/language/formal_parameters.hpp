#pragma once
// Parameters of `fn` and `component`: `a, b: length, c: length = 2 * b`, and the arguments that meet them.
#include <string>
#include <vector>

#include "interpreter/language/evaluate.hpp"

namespace garment::interpreter {

struct FormalParameter {
  std::string name;
  std::string kind;  ///< "length", "number", ...; empty: anything
  const Expr* standard = nullptr;
  Span span;
};

/// Parameters as they stand in the head `f(a, b: length, c: length = 2 cm)`, a call. Reports and throws Stop
/// where one is malformed, unknown in kind, or there twice.
std::vector<FormalParameter> parameters_of(Program& program, const Expr& head);

/// The value as a parameter of this kind takes it, or a report and Stop.
Value checked_kind(Program& program, const std::string& name, const std::string& kind, Value value,
                   Span span);

/// The name of argument k (from 1) of a call; empty if it stands by position.
std::string label_of(const Expr& call, std::size_t k);
[[noreturn]] void fail_label(Program& program, const Expr& call, std::size_t k, const std::string& function,
                             const std::vector<std::string>& names);

/// Which argument meets which parameter: [parameter] -> its place among the call's children, 0 where none is
/// given. Reports and throws Stop on too many, unknown, doubled and missing arguments. `head` is the
/// declaration's, for the message.
std::vector<std::size_t> match_arguments(Program& program, const std::string& name,
                                         const std::vector<FormalParameter>& parameters, const Expr& call,
                                         Span head);

}  // namespace garment::interpreter
