#pragma once
// The TextMate grammar of the language, made from the tables:
// editors/vscode/syntaxes/garment.tmLanguage.json.
#include <string>

namespace garment::service {

/// The grammar as JSON. Colours by the shape of a statement: its keyword, its name, its own clause words,
/// units after numbers.
std::string textmate_grammar();

}  // namespace garment::service
