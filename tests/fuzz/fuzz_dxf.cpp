// The DXF reader on arbitrary bytes: no crash, no hang, and what it lets through is a sound garment.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "runtime/io/dxf_import.hpp"

namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  garment::io::DxfOptions options;
  options.limits.max_bytes = 1 << 20;
  options.limits.max_points = 20000;
  const garment::io::DxfResult result =
      garment::io::read_dxf(std::string_view(reinterpret_cast<const char*>(data), size), options);
  require(result.garment.has_value() != garment::has_errors(result.findings));
  if (!result.garment) return 0;
  for (const auto& panel : result.garment->panels) {
    double area = 0;
    for (std::size_t i = 0; i < panel.edges.size(); ++i) {
      const auto& curve = panel.edges[i].curve;
      require((curve.end() - panel.edges[(i + 1) % panel.edges.size()].curve.start()).norm() < 1e-6);
      require(std::isfinite(curve.length()));
      area += curve.area_term();
    }
    require(std::isfinite(area) && area > 0);
  }
  return 0;
}
