// The pattern reader on arbitrary bytes: no crash, no hang, and what it lets through is a sound garment.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "runtime/io/pattern_json.hpp"
#include "runtime/io/pattern_writer.hpp"

namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

void check(const garment::design::Garment& garment) {
  for (const auto& panel : garment.panels) {
    double area = 0;
    for (std::size_t i = 0; i < panel.edges.size(); ++i) {
      const auto& curve = panel.edges[i].curve;
      require(!panel.edges[i].name.empty());
      require(curve.end() == panel.edges[(i + 1) % panel.edges.size()].curve.start());
      require(std::isfinite(curve.length()) && curve.length() > 0);
      area += curve.area_term();
    }
    require(std::isfinite(area) && area > 0);
    require(panel.placement.rotation.allFinite() && panel.placement.translation.allFinite());
  }
  auto check_part = [&](const garment::design::EdgePart& part) {
    require(part.panel >= 0 && static_cast<std::size_t>(part.panel) < garment.panels.size());
    const auto& edges = garment.panels[static_cast<std::size_t>(part.panel)].edges;
    require(part.edge >= 0 && static_cast<std::size_t>(part.edge) < edges.size());
    require(std::isfinite(part.from) && std::isfinite(part.to) && part.from != part.to);
  };
  for (const auto& seam : garment.seams) {
    require(seam.sides.size() == 2 && seam.ratio.size() == 2 && seam.ratio[0] >= 1);
    for (const auto& side : seam.sides)
      for (const auto& part : side.parts) check_part(part);
  }
  for (const auto& attachment : garment.attachments)
    for (const auto& part : attachment.parts) check_part(part);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  garment::io::PatternOptions options;
  options.limits.max_bytes = 1 << 20;
  garment::io::PatternResult result =
      garment::io::read_pattern(std::string_view(reinterpret_cast<const char*>(data), size), options);
  require(result.garment.has_value() != garment::has_errors(result.findings));
  if (!result.garment) return 0;
  check(*result.garment);
  // What was read can be written, and what is written can be read.
  const garment::io::PatternText written = garment::io::write_pattern_json(*result.garment, result.layout.get());
  options.limits.max_bytes = 64u << 20;  // laid out, it is longer
  require(garment::io::read_pattern(written.text, options).garment.has_value());
  return 0;
}
