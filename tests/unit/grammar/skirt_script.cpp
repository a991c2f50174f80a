#include "tests/unit/grammar/test_vocabulary.hpp"

namespace garment::grammar::test {

const char* const kSkirt =
    R"garment(garment 1 "darted skirt"                     # edition of the language, title
use fabrics, bodies                          # the standard library, itself written in this language

param size   = 40        in 34 .. 48         "EU size"
param long   = 58 cm     in 30 cm .. 110 cm  "waist to hem"
param ease   = 2 cm      in 0 cm .. 8 cm     "ease at the hip, all round"

body form = bodies.woman(size: size)
let w = form.waist.girth / 4
let h = (form.hip.girth + ease) / 4
let take = 2.5 cm                            # what one dart takes in

fabric shell = fabrics.wool_suiting

panel front of shell on fold cf {            # one piece, two halves, no centre seam; the wearer's left is drawn
  outline from (0, 0) {
    edge hem   to (h + 3 cm, 1 cm)           tangents start +x
    edge side  to (w + take, long + 1 cm)    through (h, long - 20 cm)
    edge waist to (0, long)                  tangents end -x
    close cf
  }
  grain +y
  dart waist_dart on waist at 50% width take depth 9 cm
  notch hip on side at 20 cm before end
}
panel back of shell like front {             # the source block again, changed where it differs
  waist_dart.depth = 12 cm
  rename cf as cb
}
panel band of shell {
  outline from (0, 0) {
    edge lower to (4 * w, 0)
    edge end by (0, 4 cm); edge upper by (-4 * w, 0)
    close start
  }
}

seam side_right: front.right.side to back.right.side
seam side_left:  front.left.side[start .. hip] to back.left.side[start .. hip]
zip  placket:    front.left.side[hip .. end] to back.left.side[hip .. end]  open 0%
seam waist_seam: band.lower to front.waist + back.waist  start at placket

hem front_hem on front.hem turn 4 cm to back
hem back_hem  on back.hem  turn 4 cm to back
iron front_hem_edge along front.hem  fold 180 deg to back  set 80%

place front on form.front with waist at form.waist  offset 1 cm
place back  on form.back  with waist at form.waist  offset 1 cm
attach band.upper to form.waist  slide

region yoke in front, back: within 10 cm of waist
yoke.bend = 1.4

drape until rest
expect strain(all) < 8%
save "skirt.glb", "skirt.svg"
)garment";

}  // namespace garment::grammar::test
