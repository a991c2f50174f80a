#include "runtime/modeller/inner_lines.hpp"

#include "runtime/modeller/folding.hpp"
#include "runtime/modeller/pleats.hpp"

namespace garment::modeller {
namespace {

constexpr double kShortestLine = 1e-6;  // m

class Followed {
 public:
  Followed(const design::Garment& garment, int panel) : panel_(panel), followed_(garment.panels[panel].lines.size(), 0) {}

  void add(int line) {
    if (line >= 0 && line < static_cast<int>(followed_.size())) followed_[line] = 1;
  }
  void add(const std::vector<design::EdgePart>& parts) {
    for (const design::EdgePart& part : parts)
      if (part.panel == panel_ && part.on == design::EdgePart::On::line) add(part.edge);
  }
  bool holds(std::size_t line) const { return followed_[line] != 0; }

 private:
  int panel_;
  std::vector<char> followed_;
};

}  // namespace

std::vector<InnerLine> lines_to_follow(const design::Garment& garment, int panel, double h) {
  Followed followed(garment, panel);
  for (const design::Seam& seam : garment.seams)
    for (const design::SeamSide& side : seam.sides) followed.add(side.parts);
  for (const design::Zip& zip : garment.zips)
    for (const auto& side : zip.sides) followed.add(side);
  for (const design::Attachment& attachment : garment.attachments) followed.add(attachment.parts);
  for (const design::Clamp& clamp : garment.scene.clamps) followed.add(clamp.parts);
  for (const design::Press& press : garment.presses)
    for (const design::EdgePart& part : press.line)
      if (part.panel == panel && part.on == design::EdgePart::On::line && follows_fold(press, garment.panels[panel], part, h))
        followed.add(part.edge);
  for (const design::Slit& slit : garment.panels[panel].slits) followed.add(slit.line);
  std::vector<InnerLine> lines;
  const std::vector<design::Edge>& drawn = garment.panels[panel].lines;
  for (std::size_t k = 0; k < drawn.size(); ++k)
    if (followed.holds(k) && drawn[k].curve.length() > kShortestLine) lines.push_back({.curve = drawn[k].curve, .line = static_cast<int>(k)});
  const std::vector<InnerLine> of_pleats = pleat_lines(garment.panels[panel]);
  lines.insert(lines.end(), of_pleats.begin(), of_pleats.end());
  return lines;
}

}  // namespace garment::modeller
