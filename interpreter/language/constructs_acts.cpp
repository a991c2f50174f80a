// Acts: they run from top to bottom.
#include "interpreter/language/acts.hpp"
#include "interpreter/language/construct_table.hpp"
#include "interpreter/language/studies.hpp"

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
      {.keyword = "release",
       .form = "release PIN | CLAMP",
       .doc = "lets a pin or clamp go; the next drape goes on without it",
       .example = "release corner",
       .run = run_release},
      {.keyword = "record",
       .form = "record curve VALUE, VALUE every TIME as \"FILE.csv\" [, \"FILE.svg\"] | record frames every TIME as \"FILE.obj\"",
       .doc = "writes a curve, or the shape again and again, while the garment moves: in the drapes for a time that follow",
       .example = "record curve position(corner).y, energy every 10 ms as \"fall.csv\"",
       .clauses = {{"every", "TIME", "how often", kTime, 1e-6, 60}, {"as", "\"FILE\", ...", "the table, by whose name the curve is asked, and pictures of it; of frames the name that each number is put into: fall.obj gives fall_0000.obj"}},
       .run = run_record},
      {.keyword = "vary",
       .form = "vary PARAM | THING.PROPERTY over VALUE, VALUE, ... { drape until rest; ... }",
       .doc = "a study: makes the garment anew with each value and runs the block on it, in a folder NAME=VALUE",
       .example = "vary long over 30 cm, 40 cm { drape until rest; save \"garment.png\" }",
       .clauses = {{"over", "VALUE, VALUE, ...", "what it is set to, one after the other"}},
       .has_body = true,
       .body_keywords = {"drape", "expect", "save", "record", "release"},
       .run = run_vary},
  };
}

}  // namespace garment::interpreter::detail
