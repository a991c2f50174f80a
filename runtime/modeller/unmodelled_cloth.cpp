// Of seams, hems, layers and pressing: what the modeller leaves out.
#include "runtime/modeller/unmodelled_cloth.hpp"

namespace garment::modeller {
namespace {

void find_in_finish(const design::Seam& seam, const SayUnmodelled& say) {
  const design::SeamFinish& f = seam.finish;
  auto of_seam = [&](const char* word) {
    say("`" + std::string(word) + "` of seam `" + seam.name + "`", seam.origin);
  };
  if (f.turned) of_seam("turned");
  if (f.lap != 0) of_seam("lapped");
  if (f.fold_angle) of_seam("fold");
  if (f.tension != 0) of_seam("tension");
  if (f.slack != 0) of_seam("slack");
}

template <class List>
void say_all(const std::string& kind, const List& list, const SayUnmodelled& say) {
  for (const auto& thing : list) say(kind + " `" + thing.name + "`", thing.origin);
}

}  // namespace

void find_unmodelled_cloth(const design::Garment& garment, const SayUnmodelled& say) {
  for (const design::Seam& seam : garment.seams) find_in_finish(seam, say);
  say_all("pad", garment.pads, say);
  for (const design::Press& press : garment.presses) {
    bool along_border = false;
    for (const design::EdgePart& part : press.line) along_border = along_border || part.on != design::EdgePart::On::line;
    if (press.kind == design::Press::Kind::fold && along_border)
      say("iron `" + press.name + "` along an edge", press.origin);
  }
  for (const design::Stacking& s : garment.stackings)
    say("panel `" + garment.panels[s.panel].name + "` " + (s.over ? "over" : "under") + " `" +
            garment.panels[s.other].name + "`",
        s.origin);
  for (const design::Region& region : garment.regions)
    if (region.factors.damping != 1) say("`damping` of region `" + region.name + "`", region.origin);
}

}  // namespace garment::modeller
