// Of seams, hems, layers and pressing: what the modeller leaves out.
#include "runtime/modeller/unmodelled_cloth.hpp"

#include "runtime/modeller/folding.hpp"
#include "runtime/modeller/pleats.hpp"

namespace garment::modeller {

void find_unmodelled_cloth(const design::Garment& garment, const SayUnmodelled& say) {
  for (const design::Seam& seam : garment.seams) {
    const design::SeamFinish& f = seam.finish;
    if ((f.turned || f.fold_angle) && !folds_as_one(seam))
      say(std::string(f.turned ? "`turned`" : "`fold`") + " of seam `" + seam.name + "`", seam.origin);
    if (f.stiffness != 1 && (f.lap > 0 || f.slack > 0)) say("`stiffness` of seam `" + seam.name + "`", seam.origin);
  }
  for (const design::Panel& panel : garment.panels)
    for (const LaidPleat& laid : laid_pleats(panel)) {
      const design::Pleat& pleat = panel.pleats[laid.pleat];
      const double length = panel.edges[laid.edge].curve.length();
      if (pleat.length > 0 && (same_place(laid.from, 0) || same_place(laid.to, length)))
        say("`stitched` of pleat `" + pleat.name + "`, which takes the end of its edge,", pleat.origin);
    }
  for (const design::Pad& pad : garment.pads)
    if (pad.side == design::Facing::face) say("pad `" + pad.name + "` on the face", pad.origin);
}

}  // namespace garment::modeller
