// Fabrics, and what changes them.
#include "interpreter/language/construct_table.hpp"
#include "interpreter/language/fabrics.hpp"

namespace garment::interpreter::detail {
namespace {

const std::vector<ClauseRecord> kDefinition = {{"=", "VALUE", "the value"}};

}  // namespace

std::vector<ConstructRecord> cloth_constructs() {
  return {
      {.keyword = "fabric",
       .declares_name = true,
       .form = "fabric NAME = FABRIC | { FIELD = VALUE, ... } | FABRIC with { FIELD = VALUE, ... }",
       .doc = "a cloth, by Kawabata figures or SI stiffness",
       .example = "fabric stiff = fabrics.denim with { bend_warp = 3 * fabrics.denim.bend_warp }",
       .clauses = kDefinition,
       .in_library = true,
       .evaluate = evaluate_fabric},
  };
}

}  // namespace garment::interpreter::detail
