#pragma once
// What the server answers to questions about one text: the service's answers in the protocol's shapes.
#include <string>

#include "interpreter/lsp/documents.hpp"

namespace garment::lsp {

/// What a request asks about: an analysed text, and where in it.
struct Question {
  Documents& documents;
  Document& document;
  const Json& params;
  Encoding encoding;

  const Analysis& now() const { return *document.now; }
  Lines lines() const { return Lines(document.text, encoding); }
  std::uint32_t offset() const { return lines().offset(params.at("position")); }
};

/// A request that is refused, with the protocol's error code.
struct Refused {
  int code = -32803;  ///< RequestFailed
  std::string message;
};

Json answer_hover(const Question& question);
Json answer_completion(const Question& question);
Json answer_signature(const Question& question);
Json answer_definition(const Question& question);
Json answer_references(const Question& question);
Json answer_highlight(const Question& question);
Json answer_partners(const Question& question);  ///< places that the edge is sewn to
Json answer_symbols(const Question& question);
Json answer_folding(const Question& question);
Json answer_formatting(const Question& question);
Json answer_actions(const Question& question);
Json answer_prepare_rename(const Question& question);
Json answer_rename(const Question& question);  ///< throws Refused
Json answer_tokens(const Question& question);

/// Kinds of semantic tokens, in the order of their numbers.
Json token_legend();

/// The diagnostics of one analysed text, by the address of the file that each is shown in.
std::map<std::string, Json> diagnostics_of(const Document& document, Encoding encoding);

}  // namespace garment::lsp
