#pragma once
// The syntax tree: what was written, with spans, before any meaning. Every statement has one shape:
//     keyword name operands clause* [ { body } ]
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "grammar/diagnostic.hpp"
#include "grammar/source.hpp"
#include "runtime/base/limits.hpp"

namespace garment::grammar {

enum class ExprKind : std::uint8_t {
  number,   ///< `number` and `unit` ("" if none): 58 cm, 20%, 0.12 gf*cm^2/cm
  string,   ///< children are string parts (kind text) and `{expr}` parts; `text` is the whole if there is no
            ///< `{expr}`
  text,     ///< literal part of a string, in `text`
  boolean,  ///< text is "true" or "false"
  name,     ///< text; children are the parts of a name with braces, as in Name::parts
  member,  ///< children[0] . text            front.side; further children are the parts of a name with braces
  range_index,  ///< children[0] [ children[1] .. children[2] ]; a missing end is kind `none`
  index,        ///< children[0] [ children[1] ]
  call,    ///< children[0] ( arguments ); argument i is children[i+1], its name labels[i] ("" if positional);
           ///< an argument `long: length = 60 cm` (a parameter with default) is a binary "=" of type and
           ///< default
  unary,   ///< text is "-", "+", "not", "minus"
  binary,  ///< text is + - * / ^ == != < <= > >= and or minus is
  range,   ///< children[0] .. children[1]
  list,    ///< [a, b, c]
  record,  ///< { key = value, ... }: labels and children; only after `=` or `with`
  with,    ///< children[0] with record children[1]
  point,   ///< (x, y) or (x, y, z)
  conditional,  ///< if children[0] { children[1] } else { children[2] }
  none,         ///< an end of a range that was left out
  error,        ///< could not be parsed; a diagnostic was given
};

struct Name;

struct Expr {
  ExprKind kind = ExprKind::none;
  Span span;
  std::string text;
  double number = 0;
  std::string unit;
  Span unit_span;
  std::vector<Expr> children;
  std::vector<Name> labels;
  Span name_span;  ///< of `text` in a member
};

/// A name as written. May hold braces ("h_{i}"): they are filled when evaluated.
struct Name {
  std::string text;
  Span span;
  std::vector<Expr> parts =
      {};  ///< of a name with braces: literal parts (kind text) and `{expr}` parts in order; else empty
};

/// A clause word and the values that follow it: `through (1 cm, 2 cm)`, `at 20 cm before end`. Words among
/// the values are expressions of kind `name`. `=` and `:` and `is` count as clause words where a construct
/// has them.
struct Clause {
  Name word;
  std::vector<Expr> values;
  Span span;
};

struct Statement;
using Block = std::vector<Statement>;

struct Statement {
  Name keyword;  ///< "panel"; "=" for an assignment (operands[0] is the target); "both" holds its statement
                 ///< in body
  std::optional<Name> name;     ///< declared name, where the construct declares one
  std::vector<Expr> operands;   ///< what stands before the first clause word
  std::vector<Clause> clauses;  ///< in the order written
  std::optional<Block> body;
  std::optional<Block> else_body;  ///< of `if`
  Span body_span;                  ///< from its { to its }
  Span else_span;                  ///< the same of `else { }`; empty for `else if`
  std::string doc;                 ///< text of the `##` lines above, newline-joined
  Span span;                       ///< whole statement
  bool broken = false;             ///< had a syntax error; a diagnostic was given; not to be evaluated
};

struct Script {
  SourceId source = 0;
  Block statements;
};

/// What the parser must know of a construct; made from the construct table of the interpreter.
struct KeywordInfo {
  std::string keyword;
  bool declares_name = false;              ///< the word after the keyword is a declared name
  std::vector<std::string> clauses;        ///< clause words, in any order
  bool has_body = false;                   ///< may be followed by { statements }
  std::vector<std::string> body_keywords;  ///< statement keywords allowed in the body; assignments always are
};

/// All keywords. `top` lists those that stand at the top level. Besides, the parser itself knows: assignments
/// (`a.b = expr`), `if`/`else`, `for NAME in RANGE { }`, `both STATEMENT`.
struct Vocabulary {
  std::vector<KeywordInfo> keywords;
  std::vector<std::string> top;
  std::vector<std::string>
      units;  ///< closed table: "mm", "cm", "deg", "%", "gf*cm^2/cm" is joined from its parts
};

struct ParseLimits {
  std::size_t max_bytes = kMaxSourceBytes;
  int max_depth = kMaxTreeDepth;
};

struct ParseResult {
  Script script;  ///< always there; broken statements are marked
  Diagnostics diagnostics;
  bool incomplete =
      false;  ///< the text ends inside a bracket or block or after an operator: more lines would help
};

/// Parses a whole source. Never fails: errors are collected and parsing goes on at the next statement.
ParseResult parse(const Sources& sources, SourceId source, const Vocabulary& vocabulary,
                  const ParseLimits& limits = {});

/// A source that holds one expression and nothing else, as a person types it at the prompt.
struct ExpressionResult {
  Expr expr;
  Diagnostics diagnostics;
  bool incomplete = false;
};
ExpressionResult parse_expression(const Sources& sources, SourceId source, const Vocabulary& vocabulary,
                                  const ParseLimits& limits = {});

/// True if both trees say the same; spans are not compared.
bool same_tree(const Expr& a, const Expr& b);
bool same_tree(const Block& a, const Block& b);

/// The tree as JSON (kinds, texts, byte spans), for `garment parse --json`.
std::string to_json(const Script& script, const Sources& sources);
/// The tree as an indented text outline, for people and goldens.
std::string to_outline(const Script& script);

/// Canonical layout of a source: two-space indents, one blank between words, comments kept. Idempotent; the
/// result parses to the same tree. Sources with syntax errors come back unchanged with the diagnostics.
struct FormatResult {
  std::string text;
  Diagnostics diagnostics;
};
FormatResult format(const Sources& sources, SourceId source, const Vocabulary& vocabulary);

}  // namespace garment::grammar
