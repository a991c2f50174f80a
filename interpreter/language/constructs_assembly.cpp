// What joins panels.
#include "interpreter/language/construct_table.hpp"
#include "interpreter/language/seams.hpp"

namespace garment::interpreter::detail {

std::vector<ConstructRecord> assembly_constructs() {
  return {
      {.keyword = "seam",
       .declares_name = true,
       .form = "seam NAME: SIDE to SIDE [to SIDE ...]",
       .doc = "sews edges, parts of edges or chains `a + b`; a relation stands after its own side",
       .example = "seam cap: sleeve.cap ease 6% to front.armhole + back.armhole",
       .clauses = {{":", "EDGES", "the first side"},
                   {"to", "EDGES", "a further side"},
                   {"ease", "%", "the side is this much longer", kNumber, 0, 0.5},
                   {"gather", "FACTOR", "the side is this many times longer", kNumber, 1, 10},
                   {"stretch", "%", "the side is stretched by this much", kNumber, 0, 1},
                   {"reversed", "", "the other way round than the rule says"},
                   {"start", "at SEAM | NOTCH", ""},
                   {"turned", "", ""},
                   {"lapped", "LENGTH", ""},
                   {"fold", "ANGLE", ""},
                   {"ironed", "open | toward SIDE", ""},
                   {"tension", "%", ""},
                   {"slack", "LENGTH", ""},
                   {"stiffness", "FACTOR", ""}},
       .evaluate = evaluate_seam,
       .reserve = reserve_seam},
  };
}

}  // namespace garment::interpreter::detail
