#pragma once
// What a person reads when something is wrong: a coded message with the places it speaks of.
#include <string>
#include <vector>

#include "grammar/source.hpp"
#include "runtime/base/finding.hpp"

namespace garment::grammar {

struct Label {
  Span span;
  std::string text;  ///< may be empty
};

/// `labels[0]` is the primary place. `message` says what was found, then what was expected; `help` is the
/// remedy.
struct Diagnostic {
  std::string code;  ///< "G0312"; in codes.def
  Severity severity = Severity::error;
  std::string message;
  std::vector<Label> labels;
  std::string help;
};

using Diagnostics = std::vector<Diagnostic>;

/// Text as in the language design, section 7: caret lines, labels, `= help:`. `color` adds ANSI colours.
/// Control characters from the source are shown escaped.
std::string render(const Diagnostic& diagnostic, const Sources& sources, bool color);
/// The same as a JSON array (code, severity, message, help, labels with source, byte span, line, column,
/// text).
std::string render_json(const Diagnostics& diagnostics, const Sources& sources);

/// One row of the table of codes.
struct CodeInfo {
  std::string_view code, title, explanation;
};
const std::vector<CodeInfo>& code_table();
const CodeInfo* find_code(std::string_view code);
/// The first sentence of what the explanation says is to be done, "keep one of the two"; empty for unknown codes.
std::string remedy_of(std::string_view code);

}  // namespace garment::grammar
