// PEGTL's own proof that no rule can loop without consuming.
#include <catch2/catch.hpp>
#include <tao/pegtl/contrib/analyze.hpp>

#include "grammar/grammar_rules.hpp"

using namespace garment::grammar;

TEST_CASE("the rules have no endless loop") {
  CHECK(tao::pegtl::analyze<rules::script>(1) == 0);
  CHECK(tao::pegtl::analyze<rules::lone_expression>(1) == 0);
}
