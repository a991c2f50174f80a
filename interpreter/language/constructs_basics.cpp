// Names, values, functions: what a script is made of.
#include "interpreter/language/acts.hpp"
#include "interpreter/language/construct_table.hpp"
#include "interpreter/language/declarations.hpp"
#include "interpreter/language/dependencies.hpp"
#include "interpreter/language/files.hpp"
#include "interpreter/language/parameters.hpp"
#include "interpreter/language/solving.hpp"

namespace garment::interpreter::detail {
namespace {

const std::vector<ClauseRecord> kDefinition = {{"=", "VALUE", "the value"}};

}  // namespace

std::vector<ConstructRecord> basics_constructs() {
  return {
      {.keyword = "garment",
       .form = "garment EDITION \"TITLE\"",
       .doc = "the edition of the language and the garment's title",
       .example = "garment 1 \"darted skirt\"",
       .in_library = true,
       .run = run_garment},
      {.keyword = "use",
       .form = "use NAME [, NAME ...] | use \"FILE\" as NAME",
       .doc = "takes in a library, or a file below the script's folder, under its name",
       .example = "use fabrics, bodies",
       .clauses = {{"as", "NAME", "the name it gets here"}},
       .in_library = true},
      {.keyword = "param",
       .declares_name = true,
       .form = "param NAME = VALUE [in RANGE | in [CHOICE, ...]] [\"what it is\"]",
       .doc = "a value that may be given from outside",
       .example = "param long = 58 cm in 30 cm .. 110 cm \"waist to hem\"",
       .clauses = {{"=", "VALUE", "what it is unless given"},
                   {"in", "RANGE | [CHOICE, ...]", "what is allowed"}},
       .evaluate = evaluate_param,
       .forget = forget_param},
      {.keyword = "let",
       .declares_name = true,
       .form = "let NAME = VALUE",
       .doc = "names a value",
       .example = "let w = form.waist.girth / 4",
       .clauses = kDefinition,
       .in_library = true,
       .evaluate = evaluate_let,
       .forget = forget_value},
      {.keyword = "measure",
       .declares_name = true,
       .form = "measure NAME = VALUE",
       .doc = "names a value that also appears in the report; it may ask the drape",
       .example = "measure hem_width = length(front.hem)",
       .clauses = kDefinition,
       .evaluate = evaluate_let,
       .forget = forget_value,
       .run = run_measure},
      {.keyword = "solve",
       .declares_name = true,
       .form = "solve NAME in LOW .. HIGH so A == B",
       .doc = "names the value for which two numbers agree; with >= or <= the first from the low end that does",
       .example = "solve radius in 2 cm .. 40 cm so 2 * pi * radius == length(front.waist)",
       .clauses = {{"in", "LOW .. HIGH", "the range it is looked for in"},
                   {"so", "CONDITION", "a comparison of two numbers with ==, >= or <="}},
       .evaluate = evaluate_solve,
       .forget = forget_solve},
      {.keyword = "fn",
       .form = "fn NAME(PARAMETER, PARAMETER: KIND = DEFAULT, ...) = VALUE",
       .doc = "a function",
       .example = "fn half(x) = x / 2",
       .clauses = kDefinition,
       .in_library = true,
       .evaluate = evaluate_function,
       .forget = forget_value},
      {.keyword = "assert",
       .form = "assert CONDITION [\"what must hold\"]",
       .doc = "refuses the garment where the condition does not hold",
       .example = "assert length(front.waist) > 20 cm \"waist is cut too small\"",
       .clauses = {{"within", "% | VALUE", "how near `==` must come"}},
       .in_library = true,
       .run = run_assert},
  };
}

}  // namespace garment::interpreter::detail
