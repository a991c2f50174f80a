#pragma once
// The grammar of the language: one line a rule, no actions. It is LL(1) but for a few looks ahead within a
// line, so that reading is linear; `must<>` stands only after the token that commits. Included by parser.cpp
// alone (and its analysis).
#include <tao/pegtl.hpp>

#include "grammar/contextual_rules.hpp"

namespace garment::grammar::rules {

using namespace tao::pegtl;

// ---- blanks and comments
struct line_end : one<'\n'> {};
struct blanks : star<one<' ', '\t', '\r'>> {};
struct comment : seq<one<'#'>, star<not_one<'\n'>>> {};
struct line_gap : seq<blanks, opt<comment>> {};
struct wide_gap : star<sor<one<' ', '\t', '\r', '\n'>, comment>> {};
struct in_brackets : ask<&ParseState::in_brackets> {};
struct gap : if_then_else<in_brackets, wide_gap, line_gap> {};

// ---- context
struct clause_word : consume<&ParseState::clause_word> {};
struct clause_sign : consume<&ParseState::clause_sign> {};
struct continuation : consume<&ParseState::continuation> {};
struct keyword_word : consume<&ParseState::keyword_length> {};
struct known_unit : consume<&ParseState::unit_length> {};
struct sign_begins_value : look<&ParseState::sign_begins_value> {};
struct statement_begins : look<&ParseState::statement_begins> {};
struct assignment_begins : look<&ParseState::assignment_begins> {};
struct outer_statement_begins : look<&ParseState::outer_statement_begins> {};
struct block_begins_below : look<&ParseState::block_begins_below> {};
struct declares_name : ask<&ParseState::declares_name> {};
struct has_body : ask<&ParseState::has_body> {};
struct not_stopped : ask<&ParseState::not_stopped> {};
struct block_left_open : ask<&ParseState::block_left_open> {};

// ---- words
struct if_word : keyword<'i', 'f'> {};
struct else_word : keyword<'e', 'l', 's', 'e'> {};
struct for_word : keyword<'f', 'o', 'r'> {};
struct in_word : keyword<'i', 'n'> {};
struct both_word : keyword<'b', 'o', 't', 'h'> {};
struct and_word : keyword<'a', 'n', 'd'> {};
struct or_word : keyword<'o', 'r'> {};
struct not_word : keyword<'n', 'o', 't'> {};
struct minus_word : keyword<'m', 'i', 'n', 'u', 's'> {};
struct is_word : keyword<'i', 's'> {};
struct with_word : keyword<'w', 'i', 't', 'h'> {};
struct true_word : keyword<'t', 'r', 'u', 'e'> {};
struct false_word : keyword<'f', 'a', 'l', 's', 'e'> {};
struct boolean : sor<true_word, false_word> {};
struct reserved : sor<and_word, or_word, not_word, minus_word, is_word, if_word, else_word> {};

struct expression;
struct any_statement;

// ---- names: h_{i}; the brace touches the word and what it holds
struct name_word : identifier {};
struct name_text : plus<identifier_other> {};
struct name_hole_open : seq<one<'{'>, not_at<one<' ', '\t', '\r', '\n', '}', '#'>>> {};
struct name_hole_value : seq<expression> {};
struct name_hole_close : one<'}'> {};
struct name_hole : if_must<name_hole_open, name_hole_value, name_hole_close> {};
struct record_begins : seq<sor<with_word, else_word>, one<'{'>> {};
struct name : seq<not_at<record_begins>, name_word, star<sor<name_hole, name_text>>> {};

// ---- numbers: 12, 0.5, 1.2e-3, each with an optional unit: 58 cm, 50%, 0.12 gf*cm^2/cm
struct digits : plus<digit> {};
struct fraction : seq<one<'.'>, digits> {};
struct exponent : seq<one<'e', 'E'>, opt<one<'+', '-'>>, digits> {};
struct number_text : seq<digits, opt<fraction>, opt<exponent>> {};
struct unit_power : seq<one<'^'>, opt<one<'-'>>, digits, not_at<sor<identifier_first, fraction>>> {};
struct unit_factor : seq<known_unit, opt<unit_power>> {};
struct unit : seq<unit_factor, star<one<'*', '/'>, unit_factor>> {};
struct number_end : not_at<sor<identifier_first, one<'(', '[', '"'>, seq<one<'.'>, not_at<one<'.'>>>>> {};
struct number : seq<number_text, opt<blanks, unit>, must<number_end>> {};

// ---- strings: "waist {i} of {n}"
struct string_open : one<'"'> {};
struct string_chars : plus<not_one<'"', '\\', '{', '\n'>> {};
struct escaped : one<'"', '\\', 'n', '{'> {};
struct escape : if_must<one<'\\'>, escaped> {};
struct string_hole_open : one<'{'> {};
struct string_hole_value : seq<expression> {};
struct string_hole_close : one<'}'> {};
struct string_hole : if_must<string_hole_open, gap, string_hole_value, gap, string_hole_close> {};
struct string_close : one<'"'> {};
struct string_literal : if_must<string_open, star<sor<string_chars, escape, string_hole>>, string_close> {};

// ---- brackets: (a), (x, y), [a, b], { key = value }
struct comma : one<','> {};
struct inner_value : seq<expression> {};
struct group_open : one<'('> {};
struct group_close : one<')'> {};
struct group_tail : star<if_must<comma, gap, inner_value, gap>> {};
struct group : if_must<group_open, gap, inner_value, gap, group_tail, group_close> {};
struct list_open : one<'['> {};
struct list_close : one<']'> {};
struct list_tail_values : star<comma, gap, inner_value, gap> {};
struct list_values : seq<inner_value, gap, list_tail_values, opt<comma, gap>> {};
struct list : if_must<list_open, gap, opt<list_values>, list_close> {};

struct label_word : identifier {};
struct record_key : seq<label_word, line_gap, one<'='>, not_at<one<'='>>> {};
struct record_open : one<'{'> {};
struct record_close : one<'}'> {};
struct record;
struct record_value : sor<record, expression> {};
struct record_entry : if_must<record_key, wide_gap, record_value> {};
struct record_separator : seq<line_gap, sor<comma, line_end>, wide_gap> {};
struct record_entries : seq<record_entry, star<record_separator, record_entry>, opt<record_separator>> {};
struct record_body : seq<wide_gap, opt<record_entries>, line_gap, must<record_close>> {};
struct record : seq<record_open, record_body> {};

// ---- what follows a value: .name  (arguments)  [index]  with { }
struct member_dot : seq<one<'.'>, not_at<one<'.'>>> {};
struct member_name : seq<name> {};
struct member : if_must<member_dot, member_name> {};
struct call_open : one<'('> {};
struct call_close : one<')'> {};
struct argument_label : seq<label_word, gap, one<':'>> {};
struct labelled_value : seq<expression> {};
struct default_sign : seq<one<'='>, not_at<one<'='>>> {};
struct default_value : seq<expression> {};
struct argument_value : sor<if_must<argument_label, gap, labelled_value>, expression> {};
struct argument_default : if_must<default_sign, gap, default_value> {};
struct argument : seq<argument_value, gap, opt<argument_default, gap>> {};
struct arguments : seq<argument, star<comma, gap, argument>, opt<comma, gap>> {};
struct call : if_must<call_open, gap, opt<arguments>, call_close> {};
struct index_open : one<'['> {};
struct index_close : one<']'> {};
struct index_value;
struct index : if_must<index_open, gap, index_value, gap, index_close> {};
struct postfix : sor<member, call, index> {};
struct with_open : seq<gap, not_at<clause_word>, with_word, gap, one<'{'>> {};
struct with_record : seq<with_open, record_body> {};

// ---- if a { b } else { c } as a value
struct condition : seq<expression> {};
struct conditional_word : if_word {};
struct branch_open : one<'{'> {};
struct branch_close : one<'}'> {};
struct branch_value : seq<expression> {};
struct branch : if_must<branch_open, gap, branch_value, gap, branch_close> {};
struct then_branch : branch {};
struct branch_else : else_word {};
struct conditional;
struct else_branch : sor<conditional, branch> {};
struct conditional
    : if_must<conditional_word, gap, condition, gap, then_branch, wide_gap, branch_else, gap, else_branch> {};

// ---- operators: a flat chain; precedence is the builder's
struct plain_name : seq<not_at<reserved>, name> {};
struct operand : seq<sor<string_literal, group, list, conditional, boolean, plain_name>, star<postfix>> {};
struct primary : seq<sor<number, operand>, opt<with_record>> {};
struct prefix : sor<one<'+', '-'>, not_word, minus_word> {};
struct prefixed_operand : seq<primary> {};
struct prefixed : seq<plus<prefix, gap>, must<prefixed_operand>> {};
struct term : sor<prefixed, primary> {};
struct two_signs : sor<string<'=', '='>, string<'!', '='>, string<'<', '='>, string<'>', '='>> {};
struct infix_sign : sor<two_signs, one<'<', '>', '+', '-', '*', '/', '^'>> {};
struct infix_word : sor<and_word, or_word, minus_word, is_word> {};
struct infix : sor<seq<not_at<sign_begins_value>, infix_sign>, seq<not_at<clause_word>, infix_word>> {};
struct right_operand : seq<not_at<statement_begins>, term> {};
struct infix_tail : if_must<seq<gap, infix>, wide_gap, right_operand> {};
struct chain : seq<not_at<statement_begins>, term, star<infix_tail>> {};
struct range_sign : seq<two<'.'>, not_at<one<'.'>>> {};
struct range_end : seq<chain> {};
struct range_tail : if_must<seq<gap, range_sign>, wide_gap, range_end> {};
struct expression : seq<chain, opt<range_tail>> {};

struct missing_begin : at<range_sign> {};
struct missing_end : success {};
struct index_range : seq<range_sign, gap, sor<chain, missing_end>> {};
struct index_value : sor<seq<missing_begin, index_range>, seq<chain, opt<gap, index_range>>> {};

// ---- values and clauses of a statement
struct value : seq<expression> {};
struct next_value : seq<not_at<clause_word>, value> {};
struct comma_tail : if_must<seq<line_gap, comma>, wide_gap, next_value> {};
struct values : seq<value, star<comma_tail>> {};
struct record_item : seq<record> {};
struct clause_value : sor<record_item, seq<not_at<statement_begins>, values>> {};
struct sign_clause : if_must<clause_sign, wide_gap, clause_value> {};
struct with_clause : seq<at<with_word>, clause_word, opt<line_gap, record_item>> {};
struct clause : sor<sign_clause, with_clause, clause_word> {};
struct item_gap : seq<line_gap, opt<continuation>> {};
struct items : star<item_gap, sor<clause, values>> {};

// ---- statements
struct end_mark : sor<eof, one<'\n', ';', '}'>, block_left_open> {};
struct statement_end : seq<line_gap, at<end_mark>> {};
struct separators : star<sor<one<' ', '\t', '\r', '\n', ';'>, comment>> {};
struct statement : recovering<any_statement> {};
struct statements : seq<separators, star<not_stopped, statement, separators>> {};
struct block_open : sor<one<'{'>, block_begins_below> {};
struct block_close : sor<one<'}'>, eof, outer_statement_begins> {};
struct block : if_must<block_open, statements, block_close> {};
struct required_block : seq<block> {};

struct assignment_path : seq<name, star<member>> {};
struct assign_sign : one<'='> {};
struct assigned_value : sor<record, seq<not_at<statement_begins>, expression>> {};
struct assignment : if_must<assignment_begins, assignment_path, blanks, assign_sign, wide_gap, assigned_value,
                            statement_end> {};

struct if_begin : if_word {};
struct if_condition : seq<condition> {};
struct else_begin : seq<wide_gap, else_word> {};
struct else_part;
struct if_rest : seq<line_gap, must<if_condition>, line_gap, must<required_block>, opt<else_part>> {};
struct nested_if : seq<if_begin, if_rest> {};
struct else_body : sor<nested_if, required_block> {};
struct else_part : if_must<else_begin, line_gap, else_body> {};
struct if_statement : seq<if_begin, if_rest, must<statement_end>> {};

struct loop_name : seq<not_at<in_word>, name> {};
struct loop_in : in_word {};
struct loop_range : seq<expression> {};
struct loop_head : seq<line_gap, must<loop_name>, line_gap, must<loop_in>, line_gap, must<loop_range>> {};
struct for_statement : seq<for_word, loop_head, line_gap, must<required_block, statement_end>> {};

struct inner_statement : seq<any_statement> {};
struct both_statement : if_must<both_word, line_gap, inner_statement> {};

struct call_head : seq<identifier, one<'('>> {};
struct declared_name : seq<not_at<clause_word>, name> {};
struct declaration : seq<line_gap, sor<at<call_head>, must<declared_name>>> {};
struct opt_declaration : if_then_else<declares_name, declaration, success> {};
struct opt_body : if_then_else<has_body, opt<line_gap, block>, success> {};
struct construct : seq<keyword_word, opt_declaration, items, opt_body, must<statement_end>> {};

struct known_statement : failure {};
struct no_statement : sor<eof, one<'}'>, outer_statement_begins> {};
struct some_statement
    : sor<assignment, if_statement, for_statement, both_statement, construct, must<known_statement>> {};
struct any_statement : seq<not_at<no_statement>, some_statement> {};

// ---- the whole
struct stray_brace : one<'}'> {};
struct script : seq<statements, star<not_stopped, stray_brace, statements>, star<any>> {};
struct lone_end : eof {};
struct lone_value : seq<expression> {};
struct lone_expression : seq<wide_gap, must<lone_value>, wide_gap, must<lone_end>> {};

}  // namespace garment::grammar::rules
