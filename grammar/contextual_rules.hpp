#pragma once
// The few rules that PEGTL cannot state alone, because they depend on the vocabulary or on the statement
// around them. Each asks one question of the ParseState.
#include <tao/pegtl.hpp>
#include <tao/pegtl/contrib/analyze_traits.hpp>

#include "grammar/parse_state.hpp"

namespace garment::grammar::rules {

namespace pegtl = tao::pegtl;

template <class Input>
std::size_t offset(const Input& in) {
  return static_cast<std::size_t>(in.current() - in.begin());
}

/// Tags for `pegtl::analyze`: rules that consume when they match, and rules that only look.
struct consuming_rule;
struct looking_rule;

template <std::size_t (ParseState::*Length)(std::size_t) const>
struct consume {
  using rule_t = consuming_rule;
  using subs_t = pegtl::empty_list;
  template <pegtl::apply_mode, pegtl::rewind_mode, template <class...> class, template <class...> class,
            class Input>
  static bool match(Input& in, ParseState& state) {
    std::size_t length = (state.*Length)(offset(in));
    in.bump(length);
    return length > 0;
  }
};

template <bool (ParseState::*Question)(std::size_t) const>
struct look {
  using rule_t = looking_rule;
  using subs_t = pegtl::empty_list;
  template <pegtl::apply_mode, pegtl::rewind_mode, template <class...> class, template <class...> class,
            class Input>
  static bool match(Input& in, ParseState& state) {
    return (state.*Question)(offset(in));
  }
};

template <bool (ParseState::*Question)() const>
struct ask {
  using rule_t = looking_rule;
  using subs_t = pegtl::empty_list;
  template <pegtl::apply_mode, pegtl::rewind_mode, template <class...> class, template <class...> class,
            class Input>
  static bool match(Input&, ParseState& state) {
    return (state.*Question)();
  }
};

/// Matches `Rule`; a mistake in it is reported, marks the statement as broken, and skips to the statement's
/// end.
template <class Rule>
struct recovering {
  using rule_t = recovering;
  using subs_t = pegtl::type_list<Rule>;

  template <pegtl::apply_mode A, pegtl::rewind_mode, template <class...> class Action,
            template <class...> class Control, class Input>
  static bool match(Input& in, ParseState& state) {
    const std::size_t begin = offset(in), depth = state.depth();
    const auto heights = state.expressions().heights();
    try {
      auto start = in.template mark<pegtl::rewind_mode::required>();  // goes back to it on a throw
      return start(
          Control<Rule>::template match<A, pegtl::rewind_mode::required, Action, Control>(in, state));
    } catch (SyntaxError& error) {
      std::size_t end = state.resume(begin, error.position);
      state.expressions().unwind(heights);
      state.break_statement(std::move(error), begin, end, depth);
      in.bump(state.stopped() ? in.size() : end - begin);
      return true;
    }
  }
};

}  // namespace garment::grammar::rules

namespace tao::pegtl {
template <class Name>
struct analyze_traits<Name, garment::grammar::rules::consuming_rule> : analyze_any_traits<> {};
template <class Name>
struct analyze_traits<Name, garment::grammar::rules::looking_rule> : analyze_opt_traits<> {};
template <class Name, class Rule>
struct analyze_traits<Name, garment::grammar::rules::recovering<Rule>> : analyze_seq_traits<Rule> {};
}  // namespace tao::pegtl
