// The one file that compiles the grammar: PEGTL drives, the problem table speaks, the actions build.
#include <fmt/format.h>

#include "grammar/actions.hpp"
#include "grammar/problem_table.hpp"
#include "grammar/text.hpp"

namespace garment::grammar {
namespace {

template <class Rule>
struct control : tao::pegtl::normal<Rule> {
  template <class Input, class... States>
  [[noreturn]] static void raise(const Input& in, ParseState& state) {
    static_assert(rules::never_fails<Rule> || !rules::problem<Rule>.code.empty(),
                  "a must<> without a message");
    state.fail(rules::problem<Rule>, rules::offset(in));
  }
};

/// A mistake that keeps the whole source from being read; nothing if it can be read.
Diagnostics refuse(const Source& source, SourceId id, const ParseLimits& limits) {
  const std::string& text = source.text;
  auto at = [id](std::size_t offset) {
    std::uint32_t begin = static_cast<std::uint32_t>(offset);
    return Span{id, begin, begin + 1};
  };
  if (text.size() > limits.max_bytes) {
    std::string message =
        fmt::format("the source has {} bytes, but at most {} are read", text.size(), limits.max_bytes);
    return {{"G0108", Severity::error, message, {{{id, 0, 0}, ""}}, "check that the right file was named"}};
  }
  if (std::size_t nul = text.find('\0'); nul != std::string::npos)
    return {{"G0109",
             Severity::error,
             "a zero byte: this is not a text",
             {{at(nul), "here"}},
             "save the file as UTF-8, or check that the right file was named"}};
  if (std::size_t bad = find_invalid_utf8(text); bad != std::string::npos) {
    std::string message =
        fmt::format("the byte 0x{:02x} is not UTF-8", static_cast<unsigned char>(text[bad]));
    return {{"G0101", Severity::error, message, {{at(bad), "here"}}, "save the file as UTF-8"}};
  }
  return {};
}

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

template <class Rule>
void run(ParseState& state, std::string_view text, const std::string& name) {
  tao::pegtl::memory_input<tao::pegtl::tracking_mode::lazy> in(text.data(), text.data() + text.size(), name);
  if (text.substr(0, kByteOrderMark.size()) == kByteOrderMark) in.bump(kByteOrderMark.size());
  tao::pegtl::parse<Rule, rules::action, control>(in, state);
}

}  // namespace

ParseResult parse(const Sources& sources, SourceId id, const Vocabulary& vocabulary,
                  const ParseLimits& limits) {
  ParseResult result;
  result.script.source = id;
  result.diagnostics = refuse(sources[id], id, limits);
  if (!result.diagnostics.empty()) return result;
  Keywords keywords(vocabulary);
  ParseState state(sources[id], id, keywords, limits);
  run<rules::script>(state, sources[id].text, sources[id].name);
  result.script.statements = state.take_script();
  result.diagnostics = state.take_diagnostics();
  result.incomplete = state.incomplete();
  return result;
}

ExpressionResult parse_expression(const Sources& sources, SourceId id, const Vocabulary& vocabulary,
                                  const ParseLimits& limits) {
  ExpressionResult result;
  result.expr.kind = ExprKind::error;
  result.expr.span = {id, 0, static_cast<std::uint32_t>(sources[id].text.size())};
  result.diagnostics = refuse(sources[id], id, limits);
  if (!result.diagnostics.empty()) return result;
  Keywords keywords(vocabulary);
  ParseState state(sources[id], id, keywords, limits);
  try {
    run<rules::lone_expression>(state, sources[id].text, sources[id].name);
    result.expr = state.expressions().take();
  } catch (SyntaxError& error) {
    state.report(std::move(error));
  }
  result.diagnostics = state.take_diagnostics();
  result.incomplete = state.incomplete();
  return result;
}

}  // namespace garment::grammar
