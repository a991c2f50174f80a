#pragma once
// One record per builtin function or constant: form, arguments, doc, example, and the C++ that gives it
// meaning.
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/language/value.hpp"

namespace garment::grammar {
struct Expr;
struct Span;
}  // namespace garment::grammar

namespace garment::interpreter {

struct Program;
struct Scope;

/// A call being run: arguments in the order of the record's parameters; those not given are `nothing`.
struct Call {
  Program& program;
  const FunctionRecord& record;
  const grammar::Expr& expr;
  std::vector<Value> arguments;
  std::vector<const grammar::Expr*> places;              ///< of the arguments; null where not given
  std::vector<std::pair<std::string, Value>> further{};  ///< named arguments beyond the parameters, if `open`
  std::vector<const grammar::Expr*> further_places{};

  bool given(std::size_t k) const { return k < places.size() && places[k] != nullptr; }
};

struct FunctionRecord {
  std::string_view name;
  std::string_view form;
  std::string_view doc;
  std::string_view example;
  std::vector<std::string_view> parameters;
  std::size_t required = 0;
  Value (*run)(Call&) = nullptr;
  bool bare = false;  ///< a constant, or may stand without parentheses
  bool asks_drape = false;
  bool many = false;  ///< the last parameter may repeat
  bool open = false;  ///< takes further named arguments
  /// Parameters that are directions (+x, -y, an angle): they arrive as unit vectors, plain points.
  std::vector<std::string_view> directions{};
};

const std::vector<FunctionRecord>& function_table();
const FunctionRecord* find_function(std::string_view name);

/// Runs a builtin on the arguments of `expr` (a call, or a bare name).
Value call_builtin(Program& program, const FunctionRecord& record, const grammar::Expr& expr, Scope& scope);

/// Calls a function that came as a value, with values in the order of its parameters. `call` is the place for messages,
/// `asked_at` the argument that names the function.
Value call_function(Program& program, const Value& function, const std::vector<Value>& values, const grammar::Expr& call,
                    grammar::Span asked_at);

namespace detail {
std::vector<FunctionRecord> number_functions();
std::vector<FunctionRecord> list_functions();
std::vector<FunctionRecord> point_functions();
std::vector<FunctionRecord> curve_functions();
std::vector<FunctionRecord> crossing_functions();
std::vector<FunctionRecord> garment_functions();
std::vector<FunctionRecord> drape_functions();
std::vector<FunctionRecord> drape_test_functions();
std::vector<FunctionRecord> record_functions();
std::vector<FunctionRecord> shape_functions();
std::vector<FunctionRecord> cloth_functions();
std::vector<FunctionRecord> people_functions();
}  // namespace detail

}  // namespace garment::interpreter
