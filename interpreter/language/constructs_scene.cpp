// Bodies, placement, what holds and pulls the cloth.
#include "interpreter/language/bodies.hpp"
#include "interpreter/language/construct_table.hpp"
#include "interpreter/language/placements.hpp"

namespace garment::interpreter::detail {

std::vector<ConstructRecord> scene_constructs() {
  return {
      {.keyword = "body",
       .declares_name = true,
       .form = "body NAME = SHAPE [at (X, Y, Z)] [friction MU]",
       .doc = "a person, a mesh or a plain shape that cloth lies on",
       .example = "body form = bodies.woman(size: 40)",
       .clauses = {{"=", "SHAPE", "bodies.woman(...), mesh(\"file.obj\"), sphere(...), cylinder(...), ..."},
                   {"at", "(X, Y, Z)", "where it stands", {}, 1, 0, "(0, 0, 0)"},
                   {"friction", "NUMBER", "Coulomb friction with cloth", kNumber, 0, 2, "0.3"}},
       .evaluate = evaluate_body,
       .reserve = reserve_body,
       .forget = forget_body},
      {.keyword = "place",
       .form = "place PANEL on BODY.PART [with EDGE at LEVEL] | around BODY.PART | around SHAPE | at (X, Y, Z) turn (RX, "
               "RY, RZ) | flat at (X, Y, Z) | start folded",
       .doc = "where a panel starts in space",
       .example = "place front on form.front with waist at form.waist offset 1 cm",
       .clauses = {{"on", "BODY.front | BODY.back | ...", "wrapped onto a side of the body"},
                   {"around", "BODY.PART | SHAPE", "wrapped round a limb, the torso or a plain shape"},
                   {"with", "EDGE", "the edge that comes to the level"},
                   {"at", "LEVEL | (X, Y, Z)", "the level, or the place of the panel's origin"},
                   {"turn", "(RX, RY, RZ)", "turned by Rz Ry Rx"},
                   {"flat", "", "lies flat, face up, the panel's y away from the viewer"},
                   {"offset", "LENGTH", "distance from the body", kLength, 0, 0.5, "1 cm"},
                   {"start", "folded", "begins folded in half; alone: where it lies comes from its seams"}},
       .run = run_place},
      {.keyword = "attach",
       .form = "attach EDGES [, EDGES ...] to LEVEL [slide | hold]",
       .doc = "keeps edges at a level of the body: `slide` along it, or `hold` where they lie",
       .example = "attach front.waist, back.waist to form.waist slide",
       .clauses = {{"to", "BODY.LEVEL", "the level"},
                   {"slide", "", "may move along the level (the default)"},
                   {"hold", "", "stays where it lies"}},
       .run = run_attach},
      {.keyword = "pin",
       .declares_name = true,
       .form = "pin NAME on PANEL at POINT",
       .doc = "holds a point of a panel where it starts",
       .example = "pin corner on cloth at cloth.top.start",
       .clauses = {{"on", "PANEL", "the panel"}, {"at", "POINT", "a point of the panel, or an edge's end"}},
       .evaluate = evaluate_pin,
       .reserve = reserve_pin},
      {.keyword = "gravity",
       .form = "gravity ACCELERATION | (X, Y, Z)",
       .doc = "a number points down; 9.80665 m/s^2 unless stated",
       .example = "gravity 1.62 m/s^2",
       .run = run_gravity},
  };
}

}  // namespace garment::interpreter::detail
