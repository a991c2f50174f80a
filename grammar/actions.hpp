#pragma once
// What the rules do when they match: one call into the builder each. No rule with an action is ever matched
// and then given up, except under a look ahead, where PEGTL calls no actions.
#include "grammar/grammar_rules.hpp"
#include "grammar/parse_state.hpp"
#include "grammar/text.hpp"

namespace garment::grammar::rules {

template <class Rule>
struct action : nothing<Rule> {};

/// The bytes that the rule matched.
template <class Input>
Span span_of(const Input& in, const ParseState& state) {
  std::size_t begin = static_cast<std::size_t>(in.begin() - state.text().data());
  return state.span(begin, begin + in.size());
}

/// Text of `argument_label` and `record_key` without the sign behind the word.
template <class Input>
void push_label(const Input& in, ParseState& state) {
  std::string_view word = word_at(in.string_view(), 0);
  Span span = span_of(in, state);
  state.expect_after({span.source, span.end - 1, span.end});
  span.end = span.begin + static_cast<std::uint32_t>(word.size());
  state.expressions().label(word, span);
}

#define GARMENT_ON(rule)                                                    \
  template <>                                                               \
  struct action<rule> {                                                     \
    template <class Input>                                                  \
    static void apply([[maybe_unused]] const Input& in, ParseState& state); \
  };                                                                        \
  template <class Input>                                                    \
  void action<rule>::apply([[maybe_unused]] const Input& in, ParseState& state)

#define GARMENT_ON_OPEN(rule, sign, mode)       \
  GARMENT_ON(rule) {                            \
    Span span = span_of(in, state);             \
    span.begin = span.end - 1;                  \
    state.expect_after(span);                   \
    state.expressions().open(sign, span, mode); \
  }

// ---- leaves
GARMENT_ON(number_text) { state.expressions().number(in.string_view(), span_of(in, state)); }
GARMENT_ON(unit) { state.expressions().unit(in.string_view(), span_of(in, state)); }
GARMENT_ON(boolean) { state.expressions().boolean(in.string_view(), span_of(in, state)); }
GARMENT_ON(name_word) { state.expressions().name(in.string_view(), span_of(in, state)); }
GARMENT_ON(name_text) { state.expressions().name_text(in.string_view(), span_of(in, state)); }
GARMENT_ON_OPEN(name_hole_open, '{', Mode::line)
GARMENT_ON(name_hole_close) { state.expressions().close_name_hole(); }
GARMENT_ON(name) { state.expressions().end_name(in.string_view(), span_of(in, state)); }
GARMENT_ON_OPEN(string_open, '"', Mode::line)
GARMENT_ON(string_chars) { state.expressions().string_text(in.string_view(), span_of(in, state).begin); }
GARMENT_ON(escaped) {
  char c = in.peek_char();
  state.expressions().string_text(c == 'n' ? "\n" : in.string_view(), span_of(in, state).begin - 1);
}
GARMENT_ON(string_hole_open) {
  Span span = span_of(in, state);
  state.expect_after(span);
  state.expressions().open('{', span, Mode::line);
  state.expressions().string_hole_begin();
}
GARMENT_ON(string_hole_close) { state.expressions().close(); }
GARMENT_ON(string_close) { state.expressions().close_string(span_of(in, state).end); }

// ---- brackets
GARMENT_ON(comma) { state.expect_after(span_of(in, state)); }
GARMENT_ON_OPEN(group_open, '(', Mode::brackets)
GARMENT_ON(group_close) { state.expressions().close_group(span_of(in, state).end); }
GARMENT_ON_OPEN(list_open, '[', Mode::brackets)
GARMENT_ON(list_close) { state.expressions().close_list(span_of(in, state).end); }
GARMENT_ON_OPEN(call_open, '(', Mode::brackets)
GARMENT_ON(argument_label) { push_label(in, state); }
GARMENT_ON(default_sign) { state.expect_after(span_of(in, state)); }
GARMENT_ON(argument_default) { state.expressions().end_default(); }
GARMENT_ON(argument) { state.expressions().argument(); }
GARMENT_ON(call_close) { state.expressions().close_call(span_of(in, state).end); }
GARMENT_ON_OPEN(index_open, '[', Mode::brackets)
GARMENT_ON(missing_begin) { state.expressions().none(span_of(in, state).begin); }
GARMENT_ON(missing_end) { state.expressions().none(span_of(in, state).begin); }
GARMENT_ON(index_range) { state.expressions().end_range(); }
GARMENT_ON(index_close) { state.expressions().close_index(span_of(in, state).end); }
GARMENT_ON_OPEN(record_open, '{', Mode::line)
GARMENT_ON_OPEN(with_open, '{', Mode::line)
GARMENT_ON(record_key) { push_label(in, state); }
GARMENT_ON(record_close) { state.expressions().close_record(span_of(in, state).end); }
GARMENT_ON(with_record) { state.expressions().end_with(); }
GARMENT_ON(member) { state.expressions().member(); }

// ---- if a { b } else { c } as a value
GARMENT_ON(conditional_word) {
  state.expressions().open('i', span_of(in, state), state.expressions().mode());
}
GARMENT_ON_OPEN(branch_open, '{', Mode::brackets)
GARMENT_ON(branch_close) { state.expressions().close(); }
GARMENT_ON(conditional) { state.expressions().end_conditional(span_of(in, state).end); }

// ---- operators
GARMENT_ON(prefix) {
  state.expect_after(span_of(in, state));
  state.expressions().prefix(in.string_view(), span_of(in, state));
}
GARMENT_ON(infix) {
  state.expect_after(span_of(in, state));
  state.expressions().infix(in.string_view(), span_of(in, state));
}
GARMENT_ON(chain) { state.expressions().end_chain(); }
GARMENT_ON(range_sign) { state.expect_after(span_of(in, state)); }
GARMENT_ON(range_tail) { state.expressions().end_range(); }

// ---- statements
GARMENT_ON(keyword_word) {
  Span span = span_of(in, state);
  state.begin_statement(span, in.string_view(), state.allowed_keyword(span.begin).keyword);
}
GARMENT_ON(declared_name) { state.declare_name(); }
GARMENT_ON(value) { state.add_value(); }
GARMENT_ON(record_item) { state.add_value(); }
GARMENT_ON(clause_word) { state.begin_clause(span_of(in, state)); }
GARMENT_ON(clause_sign) {
  state.expect_after(span_of(in, state));
  state.begin_clause(span_of(in, state));
}
GARMENT_ON(block_open) { state.open_block(span_of(in, state)); }
GARMENT_ON(block_close) { state.close_block(span_of(in, state)); }
GARMENT_ON(statement_end) { state.end_statement(span_of(in, state).begin); }

GARMENT_ON(assign_sign) {
  state.expect_after(span_of(in, state));
  state.begin_assignment(span_of(in, state));
}
GARMENT_ON(assigned_value) { state.add_value(); }

GARMENT_ON(if_begin) { state.begin_statement(span_of(in, state), "if", nullptr); }
GARMENT_ON(if_condition) { state.add_value(); }
GARMENT_ON(nested_if) { state.end_statement(span_of(in, state).end); }
GARMENT_ON(else_part) { state.end_else(); }
GARMENT_ON(for_word) { state.begin_statement(span_of(in, state), "for", nullptr); }
GARMENT_ON(loop_name) { state.declare_name(); }
GARMENT_ON(loop_in) { state.begin_clause(span_of(in, state)); }
GARMENT_ON(loop_range) { state.add_value(); }
GARMENT_ON(both_word) { state.begin_statement(span_of(in, state), "both", nullptr); }
GARMENT_ON(both_statement) { state.end_both(); }
GARMENT_ON(stray_brace) { state.report_stray_brace(span_of(in, state)); }

#undef GARMENT_ON
#undef GARMENT_ON_OPEN

}  // namespace garment::grammar::rules
