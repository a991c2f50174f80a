#pragma once
// What each `must<>` of the grammar says when its rule does not match. A rule without a row does not compile.
#include "grammar/grammar_rules.hpp"
#include "grammar/problems.hpp"

namespace garment::grammar::rules {

template <class Rule>
inline constexpr Problem problem = {};

using enum ProblemKind;

template <>
inline constexpr Problem problem<right_operand> = {value, "G0206", "a value"};
template <>
inline constexpr Problem problem<prefixed_operand> = {value, "G0206", "a value"};
template <>
inline constexpr Problem problem<range_end> = {value, "G0206", "the end of the range"};
template <>
inline constexpr Problem problem<inner_value> = {value, "G0206", "a value"};
template <>
inline constexpr Problem problem<next_value> = {value, "G0206", "another value"};
template <>
inline constexpr Problem problem<clause_value> = {value, "G0206", "a value"};
template <>
inline constexpr Problem problem<assigned_value> = {value, "G0206", "a value"};
template <>
inline constexpr Problem problem<record_value> = {value, "G0206", "a value"};
template <>
inline constexpr Problem problem<labelled_value> = {value, "G0206", "the value of the argument"};
template <>
inline constexpr Problem problem<default_value> = {value, "G0206", "the default of the parameter"};
template <>
inline constexpr Problem problem<index_value> = {value, "G0206", "a value or a range"};
template <>
inline constexpr Problem problem<name_hole_value> = {value, "G0206", "a value"};
template <>
inline constexpr Problem problem<string_hole_value> = {value, "G0206", "a value"};
template <>
inline constexpr Problem problem<branch_value> = {value, "G0206", "a value"};
template <>
inline constexpr Problem problem<condition> = {missing, "G0206", "a condition after `if`"};
template <>
inline constexpr Problem problem<if_condition> = {missing, "G0206", "a condition after `if`"};
template <>
inline constexpr Problem problem<loop_range> = {missing, "G0206", "a range or a list after `in`"};
template <>
inline constexpr Problem problem<lone_value> = {missing, "G0206", "a value"};

template <>
inline constexpr Problem problem<group_close> = {closing, "G0203", "`,` or `)`"};
template <>
inline constexpr Problem problem<list_close> = {closing, "G0203", "`,` or `]`"};
template <>
inline constexpr Problem problem<call_close> = {closing, "G0203", "`,` or `)`"};
template <>
inline constexpr Problem problem<index_close> = {closing, "G0203", "`]`"};
template <>
inline constexpr Problem problem<record_close> = {closing, "G0216", "an entry `key = value` or `}`"};
template <>
inline constexpr Problem problem<branch_close> = {closing, "G0203", "`}`"};
template <>
inline constexpr Problem problem<name_hole_close> = {closing, "G0203", "`}`"};
template <>
inline constexpr Problem problem<string_hole_close> = {closing, "G0203", "`}`"};

template <>
inline constexpr Problem problem<string_close> = {quote, "G0103", "`\"`"};
template <>
inline constexpr Problem problem<escaped> = {quote, "G0104", "\\\" \\\\ \\n or \\{"};
template <>
inline constexpr Problem problem<number_end> = {ProblemKind::number, "G0107", "the end of the number"};

template <>
inline constexpr Problem problem<declared_name> = {
    missing, "G0207", "a name",
    "a name is made of letters, digits and `_`, and is no clause word of its statement"};
template <>
inline constexpr Problem problem<loop_name> = {missing, "G0207", "the name of the loop variable"};
template <>
inline constexpr Problem problem<member_name> = {missing, "G0207", "a name after `.`"};
template <>
inline constexpr Problem problem<loop_in> = {missing, "G0217", "`in`",
                                             "a loop is written `for i in 1 .. 5 { ... }`"};
template <>
inline constexpr Problem problem<required_block> = {
    missing, "G0212", "`{`", "the block stands in braces, with a blank before the `{`"};
template <>
inline constexpr Problem problem<else_body> = {missing, "G0212", "`{` or `if` after `else`",
                                               "the block stands in braces"};
template <>
inline constexpr Problem problem<then_branch> = {missing, "G0215", "`{` after the condition",
                                                 "as a value: if long { 60 cm } else { 40 cm }"};
template <>
inline constexpr Problem problem<branch_else> = {missing, "G0215", "`else`",
                                                 "as a value: if long { 60 cm } else { 40 cm }"};
template <>
inline constexpr Problem problem<else_branch> = {missing, "G0215", "`{` after `else`",
                                                 "as a value: if long { 60 cm } else { 40 cm }"};
template <>
inline constexpr Problem problem<known_statement> = {ProblemKind::statement, "G0202", "a statement"};
template <>
inline constexpr Problem problem<inner_statement> = {missing, "G0202", "a statement after `both`",
                                                     "for example `both place sleeve around form.arm`"};
template <>
inline constexpr Problem problem<statement_end> = {leftover, "G0208", "the end of the statement"};
template <>
inline constexpr Problem problem<lone_end> = {leftover, "G0208", "the end of the expression"};

/// Rules behind a `must<>` that match always, since they may match nothing or were looked at before.
template <class Rule>
inline constexpr bool never_fails = false;
template <class... R>
inline constexpr bool never_fails<opt<R...>> = true;
template <class... R>
inline constexpr bool never_fails<star<R...>> = true;
template <>
inline constexpr bool never_fails<gap> = true;
template <>
inline constexpr bool never_fails<wide_gap> = true;
template <>
inline constexpr bool never_fails<line_gap> = true;
template <>
inline constexpr bool never_fails<blanks> = true;
template <>
inline constexpr bool never_fails<group_tail> = true;
template <>
inline constexpr bool never_fails<statements> = true;
template <>
inline constexpr bool never_fails<block_close> = true;
template <>
inline constexpr bool never_fails<assignment_path> = true;
template <>
inline constexpr bool never_fails<assign_sign> = true;

}  // namespace garment::grammar::rules
