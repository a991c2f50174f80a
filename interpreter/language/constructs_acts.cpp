// Acts: they run from top to bottom.
#include "interpreter/language/acts.hpp"
#include "interpreter/language/construct_table.hpp"

namespace garment::interpreter::detail {

std::vector<ConstructRecord> acts_constructs() {
  return {
      {.keyword = "drape",
       .form = "drape until rest [settle preview | equilibrium | exact] | drape for TIME",
       .doc = "lets the garment fall to rest, or for a time",
       .example = "drape until rest",
       .clauses =
           {{"until", "rest", "until it rests"},
            {"settle", "preview | equilibrium | exact", "how still it must be", {}, 1, 0, "equilibrium"},
            {"for", "TIME", "for a time", kTime, 1e-3, 600}},
       .run = run_drape},
      {.keyword = "expect",
       .form = "expect CONDITION [within % | VALUE]",
       .doc = "checks the drape and says so in the report",
       .example = "expect strain(all) < 8%",
       .clauses = {{"within", "% | VALUE", "how near `==` must come"}},
       .run = run_expect},
      {.keyword = "save",
       .form = "save \"FILE\" [, \"FILE\" ...]",
       .doc = "writes files below the output folder, by extension",
       .example = "save \"skirt.glb\", \"skirt.svg\"",
       .run = run_save},
  };
}

}  // namespace garment::interpreter::detail
