#pragma once
// drape, expect, save, assert, measure; and how a condition is judged.
#include <optional>
#include <string>

#include "interpreter/language/program.hpp"

namespace garment::interpreter {

void run_drape(Program& program, const Statement& statement, Scope& scope);
void run_expect(Program& program, const Statement& statement, Scope& scope);
void run_save(Program& program, const Statement& statement, Scope& scope);
void run_assert(Program& program, const Statement& statement, Scope& scope);
/// A `measure` after it was evaluated, or one that asks the drape.
void run_measure(Program& program, Declaration& declaration);

struct Verdict {
  bool passed = false;
  std::string found, expected;
  std::optional<double> value;
};
/// The condition of `expect` or `assert`, with `within`. Reports and throws Stop where it cannot be judged.
Verdict judge(Program& program, const Statement& statement, Scope& scope);

MeasureValue measure_value(const std::string& name, const Value& value);

}  // namespace garment::interpreter
