#pragma once
// What a value is, in one line, and what may stand after its dot.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/language/program.hpp"

namespace garment::service {

struct Member {
  std::string name;
  std::string
      kind;  ///< "edge", "dart", "notch", "half", "point", "length", "level", "part", "field", "function" ...
  std::string detail;  ///< its value, shortly
  std::string doc;
};

/// Everything that may follow the dot of a value, in a fixed order.
std::vector<Member> members_of(interpreter::Program& program, const interpreter::Value& value);

/// Names of the members of a panel that stand by themselves in its own block: edges, darts, notches, lines,
/// points.
std::vector<Member> panel_items(const interpreter::Program& program, int panel);

/// "a length, 58 cm", "an edge, 24.3 cm sewn, 26.8 cm cut", "a panel, 1520 cm^2".
std::string describe_value(interpreter::Program& program, const interpreter::Value& value);

/// The value of an expression in a scope, without a trace in the program's diagnostics; nothing where it has
/// none.
std::optional<interpreter::Value> quiet_value(interpreter::Program& program, const interpreter::Expr& expr,
                                              interpreter::Scope& scope);
/// The same of a text such as `front.left` in the scope of the script.
std::optional<interpreter::Value> quiet_value(interpreter::Program& program, std::string_view text);

}  // namespace garment::service
