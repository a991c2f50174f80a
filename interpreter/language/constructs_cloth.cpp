// Fabrics, and what changes them.
#include "interpreter/language/construct_table.hpp"
#include "interpreter/language/dependencies.hpp"
#include "interpreter/language/fabrics.hpp"
#include "interpreter/language/layers.hpp"
#include "interpreter/language/regions.hpp"

namespace garment::interpreter::detail {
std::vector<ConstructRecord> cloth_constructs() {
  return {
      {.keyword = "fabric",
       .declares_name = true,
       .form = "fabric NAME = FABRIC | { FIELD = VALUE, ... } | FABRIC with { FIELD = VALUE, ... } | "
               "csv(\"FILE\", row: "
               "\"NAME\") [pattern \"PICTURE\" repeat LENGTH]",
       .doc = "a cloth, by Kawabata or FAST figures or SI stiffness",
       .example = "fabric stiff = fabrics.denim with { bend_warp = 3 * fabrics.denim.bend_warp }",
       .clauses = {{"=", "VALUE", "the value"},
                   {"pattern", "\"PICTURE\"", "a .png or .jpg printed on its face"},
                   {"repeat", "LENGTH", "width of one repeat of the picture", {}, 1, 0, "10 cm"}},
       .in_library = true,
       .evaluate = evaluate_fabric,
       .forget = forget_value},
      {.keyword = "region",
       .declares_name = true,
       .form = "region NAME in PANEL [, PANEL ...]: SHAPE",
       .doc = "part of one or more panels; `NAME.bend = 1.4` and its like change the cloth in it",
       .example = "region yoke in front, back: within 10 cm of waist",
       .clauses =
           {{"in", "PANEL [, PANEL ...]", "the panels it lies on; `front.left` is one half"},
            {":", "SHAPE",
             "within, above, below, left of, right of, circle(CENTRE, RADIUS), polygon(P, Q, R, ...), or "
             "a region"},
            {"within", "LENGTH of EDGE | POINT", "what lies that near"},
            {"of", "EDGE | LINE | POINT", "after `within`, `left` or `right`"},
            {"above", "POINT | HEIGHT", "what lies higher, as drawn"},
            {"below", "POINT | HEIGHT", "what lies lower, as drawn"},
            {"left", "of LINE", "what lies to the left of the way the line is drawn"},
            {"right", "of LINE", "what lies to the right of it"},
            {"and", "SHAPE", "only what lies in both"},
            {"or", "SHAPE", "what lies in either"},
            {"minus", "SHAPE", "takes the next shape away"},
            {"not", "SHAPE", "all but the next shape"}},
       .evaluate = evaluate_region,
       .reserve = reserve_region},
      {.keyword = "layer",
       .declares_name = true,
       .form = "layer NAME of FABRIC on PANEL [in REGION] fused | basted [grain DIRECTION] [side back | "
               "face] [above LAYER]",
       .doc = "a cloth joined to the whole surface of a panel or region: interlining, canvas, fusing",
       .example = "layer canvas of shell on front in yoke fused grain 45 deg side back",
       .clauses = {{"of", "FABRIC", "what it is cut from"},
                   {"on", "PANEL", "the panel it is joined to"},
                   {"in", "REGION", "the part of the panel it covers; all of it unless stated"},
                   {"fused", "", "glued on"},
                   {"basted", "", "sewn on by basting stitches"},
                   {"grain", "DIRECTION", "of its warp; as the panel's unless stated"},
                   {"side", "back | face", "the side of the panel it lies on", {}, 1, 0, "back"},
                   {"above", "LAYER", "the layer it lies on, seen from the panel"}},
       .evaluate = evaluate_layer,
       .reserve = reserve_layer},
      {.keyword = "pad",
       .declares_name = true,
       .form = "pad NAME on PANEL in REGION | at POINT radius LENGTH thickness LENGTH [, LENGTH ...] [side "
               "back | face]",
       .doc = "a soft piece of some thickness, as a shoulder pad",
       .example = "pad shoulder on front in yoke thickness 12 mm, 8 mm, 0",
       .clauses = {{"on", "PANEL", "the panel it lies on"},
                   {"in", "REGION", "the part of the panel it covers"},
                   {"at", "POINT", "its middle, instead of a region"},
                   {"radius", "LENGTH", "with `at`", kLength, 5e-3, 0.5},
                   {"thickness", "LENGTH [, LENGTH ...]", "from the middle to the border at equal steps",
                    kLength, 0, 0.1},
                   {"side", "back | face", "the side of the panel it lies on", {}, 1, 0, "back"}},
       .evaluate = evaluate_pad,
       .reserve = reserve_pad},
      {.keyword = "iron",
       .declares_name = true,
       .form = "iron NAME along LINE fold ANGLE [to back | face] [radius LENGTH] [set %] | in REGION shrink "
               "| extend [warp %] "
               "[weft %] | in REGION flat | in REGION curl radius LENGTH about LINE, each [factor FACTOR]",
       .doc = "presses a fold along a line; shrinks, draws out, flattens or curls a region",
       .example = "iron crease along front.hem fold 180 deg to back set 80%",
       .clauses = {{"along", "EDGE | LINE", "the fold"},
                   {"in", "REGION", "what is ironed"},
                   {"fold", "ANGLE", "0 is flat, 180 deg folds it over", kAngle, 0, 3.14159265359},
                   {"to", "back | face", "the side it is folded to", {}, 1, 0, "back"},
                   {"radius", "LENGTH", "of the fold's edge, or of the curl", kLength, 0, 1},
                   {"set", "%", "share of the fold that stays", kNumber, 0, 1, "100%"},
                   {"shrink", "", "makes the region smaller"},
                   {"extend", "", "draws the region out"},
                   {"warp", "%", "change of length along the warp", kNumber, 0, 0.3, "0%"},
                   {"weft", "%", "change of length along the weft", kNumber, 0, 0.3, "0%"},
                   {"flat", "", "takes folds and curls out"},
                   {"curl", "", "rolls the region, with `radius` and `about`"},
                   {"about", "EDGE | LINE", "the axis of a curl"},
                   {"factor", "FACTOR", "on what remains", kNumber, 0, 10, "1"}},
       .evaluate = evaluate_iron,
       .reserve = reserve_iron},
      {.keyword = "starch",
       .form = "starch REGION factor FACTOR",
       .doc = "stiffens a region: bending and twist times the factor, shear times its square root",
       .example = "starch yoke factor 3",
       .clauses = {{"factor", "FACTOR", "on bending and twist", kNumber, 1, 20}},
       .run = run_starch},
  };
}

}  // namespace garment::interpreter::detail
