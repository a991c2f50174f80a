#pragma once
// Making text, lists and records: each is counted before its memory is taken.
#include <string>
#include <vector>

#include "interpreter/language/program.hpp"

namespace garment::interpreter {

/// Refuses (G1601, nothing goes on) where `bytes` more would pass the budget of values; else holds them.
Charge charge_memory(Program& program, std::size_t bytes, Span span);

/// Text of at most 1 MB; refuses longer ones (G0326).
Value text_value(Program& program, std::string text, Span span);

/// A short text of a thing that the garment holds anyway; not counted.
Value own_text(std::string text);

/// A list being made: memory for `size` values is counted and taken at once. No more than `size` may be added.
class ListBuilder {
 public:
  ListBuilder(Program& program, std::size_t size, Span span);
  void add(Value value);
  /// The list; refuses values nested deeper than the limit (G1602).
  Value finish();

 private:
  Program& program_;
  Span span_;
  std::shared_ptr<ListBody> list_;
};
Value list_value(Program& program, const std::vector<Value>& values, Span span);

/// Equality as `==` means it, lists and records value by value; each comparison is a step.
bool equal_values(Program& program, const Value& a, const Value& b, Span span);

/// A record of these fields, in this order.
Value record_value(Program& program, RecordFields fields, Span span);

}  // namespace garment::interpreter
