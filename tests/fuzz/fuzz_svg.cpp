// The SVG reader on arbitrary bytes: no crash, no hang, and what it lets through is a sound garment.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "runtime/io/svg_import.hpp"

namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  garment::io::SvgOptions options;
  options.limits.max_bytes = 1 << 20;
  options.limits.max_curves = 20000;
  const garment::io::SvgResult result =
      garment::io::read_svg(std::string_view(reinterpret_cast<const char*>(data), size), options);
  require(result.garment.has_value() != garment::has_errors(result.findings));
  if (!result.garment) return 0;
  for (const auto& panel : result.garment->panels) {
    double area = 0;
    for (const auto& edge : panel.edges) {
      require(!edge.name.empty() && std::isfinite(edge.curve.length()));
      area += edge.curve.area_term();
    }
    require(std::isfinite(area) && area > 0);
  }
  return 0;
}
