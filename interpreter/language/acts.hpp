#pragma once
// drape, expect, save, assert, measure; and how a condition is judged.
#include <optional>
#include <string>

#include "interpreter/language/program.hpp"

namespace garment::interpreter {

void run_garment(Program& program, const Item& item);
void run_drape(Program& program, const Item& item);
void run_expect(Program& program, const Item& item);
void run_save(Program& program, const Item& item);
void run_assert(Program& program, const Item& item);
/// A `measure` after it was evaluated, or one that asks the drape.
void run_measure(Program& program, const Item& item);

/// Evaluates expressions that may ask a drape, for their sense. Reports and throws Stop.
void check_questions(Program& program, const std::vector<const Expr*>& questions, Scope& scope);

struct Verdict {
  bool passed = false;
  std::string found, expected;
  std::optional<double> value;
};
/// The condition of `expect` or `assert`, with `within`. Reports and throws Stop where it cannot be judged.
Verdict judge(Program& program, const Statement& statement, Scope& scope);

MeasureValue measure_value(const std::string& name, const Value& value);

}  // namespace garment::interpreter
