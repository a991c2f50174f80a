#pragma once
// `param`: default, range or choice, and values given from outside.
#include "interpreter/language/program.hpp"

namespace garment::interpreter {

Value evaluate_param(Program& program, Declaration& declaration);
/// Takes its entry in the list of parameters back.
void forget_param(Program& program, Declaration& declaration);

/// Reports values given for parameters that the script does not have.
void check_given_parameters(Program& program);

}  // namespace garment::interpreter
