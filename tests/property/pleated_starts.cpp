// Pleats begin folded: whatever their size, grid and stitches, no layer begins in another.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "interpreter/language/interpret.hpp"
#include "runtime/base/host.hpp"
#include "runtime/modeller/modeller.hpp"
#include "runtime/simulator/certificate.hpp"

using namespace garment;

namespace {

std::size_t cuts_at_the_start(const std::string& pleat, double resolution_mm) {
  const std::string script = fmt::format(
      "garment 1 \"pleated\"\nuse fabrics\n"
      "panel skirt of fabrics.gabardine {{\n  outline from (0, 0) {{\n    edge hem to (48 cm, 0) free\n"
      "    edge right_side to (47 cm, 20 cm) free\n    edge top to (1 cm, 20 cm)\n    close left_side free\n  }}\n"
      "  {}\n  resolution {} mm\n}}\n"
      "panel band of fabrics.gabardine {{\n  outline from (0, 0) {{\n    edge low to (length(skirt.top), 0)\n"
      "    edge right_side by (0, 4 cm) free\n    edge high by (-length(skirt.top), 0) free\n    close left_side free\n  }}\n}}\n"
      "seam join_seam: skirt.top to band.low\nclamp bar: band.high\nplace band at (0, 1 m, 0)\ndrape until rest\n",
      pleat, resolution_mm);
  grammar::Sources sources;
  interpreter::InterpretOptions options;
  options.stdlib_dir = GARMENT_STDLIB_DIR;
  const interpreter::Interpretation result = interpreter::interpret(sources, sources.add("x", script), system_host(), options);
  std::string told;
  for (const auto& d : result.diagnostics)
    if (d.severity == Severity::error) told += grammar::render(d, sources, false);
  INFO(script);
  INFO(told);
  REQUIRE(result.ok());
  const modeller::ModelResult built = modeller::build_model(result.garment, {});
  REQUIRE(built.model);
  model::State state;
  state.position = built.model->start;
  return simulator::certify(*built.model, state, {}).self_intersections;
}

}  // namespace

TEST_CASE("pleats and tucks, stitched down or not, begin without a cut") {
  for (const double resolution : {5.0, 7.0, 10.0, 12.0})
    for (const int underlay : {13, 25, 30, 41})
      for (const char* stitched : {"", "stitched 23 mm", "stitched 6 cm", "stitched 9.5 cm ironed"}) {
        if (underlay < 2.5 * resolution) continue;  // a layer one or two cells wide may begin with cuts, which the drape mends
        const std::string pleat =
            fmt::format("pleat fold on top at 14 cm underlay {} mm count 2 every 11 cm toward start {}", underlay, stitched);
        INFO(pleat << ", " << resolution << " mm");
        CHECK(cuts_at_the_start(pleat, resolution) == 0);
      }
  for (const double resolution : {5.0, 7.0, 10.0, 12.0})
    for (const char* width : {"8 mm", "15 mm", "24 mm"})
      for (const char* length : {"5 cm", "8 cm"}) {
        const std::string tuck = fmt::format("tuck fold on top at 40% width {} length {}", width, length);
        INFO(tuck << ", " << resolution << " mm");
        CHECK(cuts_at_the_start(tuck, resolution) == 0);
      }
}
