// What joins panels.
#include "interpreter/language/closures.hpp"
#include "interpreter/language/construct_table.hpp"
#include "interpreter/language/seams.hpp"

namespace garment::interpreter::detail {

std::vector<ConstructRecord> assembly_constructs() {
  return {
      {.keyword = "seam",
       .declares_name = true,
       .form = "seam NAME: SIDE to SIDE [to SIDE ...] [FINISH]",
       .doc = "sews edges, parts of edges or chains `a + b`; a relation stands after its own side, `ease 6% "
              "[a .. b]` on part of it",
       .example = "seam cap: sleeve.cap ease 6% to front.armhole + back.armhole",
       .clauses = {{":", "EDGES", "the first side"},
                   {"to", "EDGES", "a further side"},
                   {"ease", "%", "the side is this much longer", kNumber, 0, 0.5},
                   {"gather", "FACTOR", "the side is this many times longer", kNumber, 1, 10},
                   {"stretch", "%", "the side is stretched by this much", kNumber, 0, 1},
                   {"reversed", "", "the other way round than the rule says"},
                   {"start", "at SEAM | ZIP | NOTCH", "where closed rings begin"},
                   {"turned", "", "sewn right sides together, then turned out"},
                   {"lapped", "LENGTH", "the sides lie over each other by this much", kLength, 1e-3, 0.2},
                   {"fold", "ANGLE to face | back", "the cloths meet at this angle, 0 is flat", kAngle, 0,
                    3.14159265359},
                   {"ironed", "open | toward SIDE", "how the allowances are pressed"},
                   {"tension", "%", "strain of the thread: negative draws the seam in", kNumber, -0.3, 0.3,
                    "0%"},
                   {"slack", "LENGTH", "play between the sides", kLength, 1e-4, 0.05},
                   {"stiffness", "FACTOR", "on bending along the seam", kNumber, 0.01, 100, "1"},
                   {"allowance", "LENGTH", "cloth beyond the stitch line", kLength, 0, 0.2}},
       .evaluate = evaluate_seam,
       .reserve = reserve_seam},
      {.keyword = "hem",
       .declares_name = true,
       .form = "hem NAME on EDGES turn LENGTH [to back | to face]",
       .doc = "turns an edge over and sews it down",
       .example = "hem front_hem on front.hem turn 4 cm to back",
       .clauses = {{"on", "EDGES", "the edge, or a chain `a + b`"},
                   {"turn", "LENGTH", "cloth that is turned over", kLength, 1e-3, 0.5},
                   {"to", "back | face", "the side it lies on", {}, 1, 0, "back"}},
       .evaluate = evaluate_hem,
       .reserve = reserve_hem},
      {.keyword = "tack",
       .declares_name = true,
       .form = "tack NAME: PANEL to PANEL along LINE | in REGION",
       .doc = "stitches that hold two panels together without a seam",
       .example = "tack hold: front to back along front.side",
       .clauses = {{":", "PANEL", "the panel with the line or region"},
                   {"to", "PANEL", "the panel it is held to"},
                   {"along", "EDGE | LINE", "of the first panel"},
                   {"in", "REGION", "of the first panel"}},
       .evaluate = evaluate_tack,
       .reserve = reserve_tack},
      {.keyword = "zip",
       .declares_name = true,
       .form = "zip NAME: EDGE to EDGE [open %] [reversed]",
       .doc = "two equally long edges that a slider joins, from the drawn start of the first one",
       .example = "zip placket: front.side to back.side open 30%",
       .clauses = {{":", "EDGE", "the first side"},
                   {"to", "EDGE", "the other side"},
                   {"open", "%", "share that is undone, at the drawn end of the first side", kNumber, 0, 1,
                    "0%"},
                   {"reversed", "", "the other way round than the rule of seams says"}},
       .evaluate = evaluate_zip,
       .reserve = reserve_zip},
      {.keyword = "button",
       .declares_name = true,
       .form = "button NAME on PANEL at POINT through PANEL at POINT [through PANEL at POINT ...] [mass "
               "MASS] [diameter "
               "LENGTH] [shank LENGTH] [kind KIND]",
       .doc = "a button, hook or snap with the holes or eyes it goes through",
       .example =
           "button top on front at (5 cm, 20 cm) through back at (5 cm, 20 cm) mass 1.5 g diameter 15 mm",
       .clauses = {{"on", "PANEL", "the panel it is sewn to"},
                   {"at", "POINT", "where, on the panel named before"},
                   {"through", "PANEL", "the panel with its hole; several from the button downwards"},
                   {"mass", "MASS", "of one button", kMass, 1e-5, 0.1, "1 g"},
                   {"diameter", "LENGTH", "of the button", kLength, 2e-3, 0.1, "15 mm"},
                   {"shank", "LENGTH", "thread between cloth and button; none for a hook or snap", kLength, 0, 0.02, "3 mm"},
                   {"kind", "sew_through | hook | snap", "what it is", {}, 1, 0, "sew_through"}},
       .evaluate = evaluate_button,
       .reserve = reserve_button},
  };
}

}  // namespace garment::interpreter::detail
