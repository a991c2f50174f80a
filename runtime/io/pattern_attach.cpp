#include "runtime/io/pattern_attach.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "runtime/io/pattern_place.hpp"

namespace garment::io {
namespace {

using design::Attachment;
using design::EdgePart;

constexpr double kShoulder = 0.1;  // m, above the bust: what reaches there lies on the shoulders

const char* level_of_label(const std::string& label) {
  if (label == "lower_interface") return "waist";
  if (label == "strapless_top") return "bust";
  if (label == "left_collar" || label == "right_collar") return "neck";
  return nullptr;
}

EdgePart whole_edge(const design::Garment& garment, std::size_t panel, std::size_t edge) {
  return {static_cast<int>(panel), static_cast<int>(edge), 0,
          garment.panels[panel].edges[edge].curve.length()};
}

/// Free edges of piece `piece` that lie across, in the upper fifth of the piece.
std::vector<EdgePart> upper_edges(const design::Garment& garment, const GarmentPlace& place, int piece) {
  double low = place.piece_low[piece], high = place.piece_high[piece];
  std::vector<EdgePart> parts;
  for (std::size_t p = 0; p < place.panels.size(); ++p) {
    if (place.panels[p].piece != piece) continue;
    for (std::size_t e = 0; e < place.panels[p].edges.size(); ++e) {
      const EdgePlace& edge = place.panels[p].edges[e];
      if (!edge.sewn() && !edge.upright() && edge.middle.y() > high - 0.2 * (high - low))
        parts.push_back(whole_edge(garment, p, e));
    }
  }
  return parts;
}

std::string list_of(const design::Garment& garment, const std::vector<EdgePart>& parts) {
  std::string text;
  for (std::size_t i = 0; i < parts.size() && i < 8; ++i) {
    const design::Panel& panel = garment.panels[parts[i].panel];
    text += fmt::format("{}{}.{}", i > 0 ? ", " : "", panel.name, panel.edges[parts[i].edge].name);
  }
  return parts.size() > 8 ? fmt::format("{} and {} more", text, parts.size() - 8) : text;
}

}  // namespace

std::vector<Attachment> guess_attachments(const design::Garment& garment, const EdgeLabels& labels,
                                          PatternFrame frame, const std::string& body,
                                          PatternReport& report) {
  GarmentPlace place = garment_place(garment);
  std::vector<bool> labelled(place.piece_low.size());
  std::vector<bool> hangs(place.piece_low.size());
  for (std::size_t piece = 0; piece < hangs.size(); ++piece)
    hangs[piece] = place.piece_high[piece] > bust_height(frame) + kShoulder;
  bool left_out = false;
  std::map<std::string, std::vector<EdgePart>> by_level;
  for (std::size_t p = 0; p < labels.size(); ++p)
    for (std::size_t e = 0; e < labels[p].size(); ++e)
      if (const char* level = level_of_label(labels[p][e])) {
        // What hangs from the shoulders has its waist where it was drawn, which need not be the waist of the
        // body.
        if (hangs[place.panels[p].piece] && std::string_view(level) == "waist") {
          left_out = true;
          continue;
        }
        by_level[level].push_back(whole_edge(garment, p, e));
        labelled[place.panels[p].piece] = true;
      }
  for (const auto& [level, parts] : by_level)
    report.note(fmt::format("attached to the {} by labels: {}", level, list_of(garment, parts)));

  if (left_out)
    report.note("hangs from the shoulders, so not attached to the waist, whatever its labels say");
  std::vector<EdgePart> guessed;
  for (std::size_t piece = 0; piece < labelled.size(); ++piece) {
    if (labelled[piece] || place.piece_high[piece] > bust_height(frame)) continue;
    std::vector<EdgePart> parts = upper_edges(garment, place, static_cast<int>(piece));
    guessed.insert(guessed.end(), parts.begin(), parts.end());
  }
  if (!guessed.empty()) {
    report.note(fmt::format("nothing holds it at the shoulders, so attached to the waist: {}",
                            list_of(garment, guessed)));
    std::vector<EdgePart>& waist = by_level["waist"];
    waist.insert(waist.end(), guessed.begin(), guessed.end());
  }
  std::vector<Attachment> attachments;
  for (auto& [level, parts] : by_level)
    attachments.push_back({fmt::format("{}_hold", level), {}, std::move(parts), body, level, true});
  return attachments;
}

}  // namespace garment::io
