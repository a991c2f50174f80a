// Any bytes: the parser ends, its labels lie in the source, its diagnostics can be shown; a source without
// mistakes keeps its tree when laid out, and its layout when laid out again.
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "tests/unit/grammar/test_vocabulary.hpp"

using namespace garment::grammar;

namespace {

void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "%s\n", what);
  std::abort();
}

void check_diagnostics(const Diagnostics& diagnostics, const Sources& sources) {
  for (const Diagnostic& d : diagnostics) {
    require(find_code(d.code) != nullptr, "a code without a row");
    require(!d.message.empty() && d.message.size() < 1000, "a message without end");
    for (const Label& label : d.labels) {
      require(label.span.source < sources.size(), "a label in no source");
      require(label.span.begin <= label.span.end, "a label that ends before it begins");
      require(label.span.end <= sources[label.span.source].text.size(), "a label beyond the source");
    }
    require(!render(d, sources, false).empty(), "nothing to show");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const Vocabulary& vocabulary = test::vocabulary();
  Sources sources;
  SourceId id = sources.add("fuzz", std::string(reinterpret_cast<const char*>(data), size));
  ParseResult first = parse(sources, id, vocabulary);
  check_diagnostics(first.diagnostics, sources);
  check_diagnostics(parse_expression(sources, id, vocabulary).diagnostics, sources);
  require(size == 0 || to_json(first.script, sources).size() > 2, "no JSON");
  to_outline(first.script);
  if (!first.diagnostics.empty()) return 0;

  SourceId laid_out = sources.add("laid out", format(sources, id, vocabulary).text);
  ParseResult second = parse(sources, laid_out, vocabulary);
  require(second.diagnostics.empty(), "the layout does not parse");
  require(same_tree(first.script.statements, second.script.statements), "the layout changed the tree");
  require(format(sources, laid_out, vocabulary).text == sources[laid_out].text, "the layout is not stable");
  return 0;
}
