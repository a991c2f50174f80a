// Of seams, hems, layers and pressing: what the modeller leaves out.
#include "runtime/modeller/unmodelled_cloth.hpp"

#include <cmath>

#include "runtime/base/portable_math.hpp"

namespace garment::modeller {
namespace {

}  // namespace

void find_unmodelled_cloth(const design::Garment& garment, const SayUnmodelled& say) {
  for (const design::Pad& pad : garment.pads)
    if (pad.side == design::Facing::face) say("pad `" + pad.name + "` on the face", pad.origin);
  for (const design::Region& region : garment.regions)
    if (region.factors.damping != 1) say("`damping` of region `" + region.name + "`", region.origin);
}

}  // namespace garment::modeller
