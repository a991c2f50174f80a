#include <catch2/catch.hpp>

#include "tests/unit/grammar/test_vocabulary.hpp"

using namespace garment::grammar;
using namespace garment::grammar::test;

TEST_CASE("the script of the language's design parses without a diagnostic") {
  Parsed parsed = parse_text(kSkirt);
  CHECK(rendered(parsed) == "");
  CHECK(parsed.result.script.statements.size() == 28);
}
