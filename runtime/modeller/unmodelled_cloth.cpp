// Of seams, hems, layers and pressing: what the modeller leaves out.
#include "runtime/modeller/unmodelled_cloth.hpp"

#include <cmath>

#include "runtime/base/portable_math.hpp"

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

/// Threads keep a rest angle, cells no rest twist yet: what is folded or curled about a line far from warp and weft would come
/// out much too weak.
bool bends_at_a_slant(const design::Garment& garment, const design::Press& press) {
  using Kind = design::Press::Kind;
  constexpr double kMostSlant = 0.17;  // sine of the angle between line and thread
  if (press.kind != Kind::fold && press.kind != Kind::curl) return false;
  for (const design::EdgePart& part : press.line) {
    const design::Panel& panel = garment.panels[part.panel];
    const geometry::Curve& curve = design::edge_of(panel, part).curve;
    const design::Point2 warp(-portable::sin(panel.grain_angle), portable::cos(panel.grain_angle));
    for (int k = 0; k <= 8; ++k) {
      const design::Point2 way = curve.tangent_at(part.from + k / 8.0 * (part.to - part.from));
      const double along = std::abs(way.dot(warp)), across = std::abs(way.x() * warp.y() - way.y() * warp.x());
      if (std::min(along, across) > kMostSlant) return true;
    }
  }
  return false;
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
    else if (bends_at_a_slant(garment, press))
      say("iron `" + press.name + "` at a slant to the threads", press.origin);
  }
  for (const design::Stacking& s : garment.stackings)
    say("panel `" + garment.panels[s.panel].name + "` " + (s.over ? "over" : "under") + " `" +
            garment.panels[s.other].name + "`",
        s.origin);
  for (const design::Region& region : garment.regions)
    if (region.factors.damping != 1) say("`damping` of region `" + region.name + "`", region.origin);
}

}  // namespace garment::modeller
