#pragma once
// What a `must<>` of the grammar says when its rule does not match: the kind of explanation and what was
// expected.
#include <string_view>

namespace garment::grammar {

enum class ProblemKind {
  missing,    ///< something else stands there
  value,      ///< a value was asked for by the sign before it
  closing,    ///< the partner of an open bracket
  quote,      ///< the end of a string
  number,     ///< a number runs into something
  statement,  ///< no statement begins here
  leftover,   ///< the statement was complete
};

struct Problem {
  ProblemKind kind;
  std::string_view code;
  std::string_view expected;  ///< "a name for the loop variable"
  std::string_view help = "";
};

}  // namespace garment::grammar
