#pragma once
// What the tables of the language say of a word, as an editor shows it.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "grammar/syntax_tree.hpp"
#include "interpreter/language/construct_table.hpp"
#include "interpreter/language/function_table.hpp"

namespace garment::service {

/// A word that the parser itself knows: `if`, `for`, `both`.
struct ParserWord {
  std::string word, form, doc;
};
const std::vector<ParserWord>& parser_words();

std::string construct_doc(const interpreter::ConstructRecord& record);  ///< doc and example, Markdown
std::string function_doc(const interpreter::FunctionRecord& function);  ///< doc and example, Markdown
std::string clause_detail(
    const interpreter::ClauseRecord& clause);  ///< "LENGTH, 0 cm .. 50 cm, default 1 cm"

/// What a statement takes before its first clause word, by its form: "EDGES" of "attach EDGES [, EDGES ...]
/// to LEVEL".
std::string operands_of(const interpreter::ConstructRecord& record);

/// The lower-case words of "preview | equilibrium | exact"; `only` if it takes nothing but words.
struct FixedWords {
  std::vector<std::string> words;
  bool only = false;
};
FixedWords fixed_words(std::string_view takes);

/// A parameter of a function: its name ("" where it cannot be named) and how it is declared ("size: number =
/// 40").
struct Parameter {
  std::string name, text;
};
/// What can be called, for completion and signature help.
struct Callable {
  std::string name, form, doc;
  std::vector<Parameter> parameters;
};
/// Parameters of `fn f(a, b: length = 2 cm)`.
std::vector<Parameter> parameters_of_head(const grammar::Expr& head, const grammar::Sources& sources);
/// The function that a text such as `bodies.woman` or `polar` names; `program` may be null.
std::optional<Callable> find_callable(interpreter::Program* program, std::string_view callee);

}  // namespace garment::service
