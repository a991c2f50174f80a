// write_samples FOLDER: sample files for the independent readers of this folder.
#include <cstdio>

#include "runtime/base/host.hpp"
#include "runtime/io/mesh_writers.hpp"
#include "tests/support/draped_skirt.hpp"

int main(int argc, char** argv) {
  using namespace garment;
  if (argc != 2) return 2;
  const std::string folder = argv[1];
  const test::DrapedSkirt skirt = test::make_skirt(96, 40);
  const test::DrapedSkirt none;
  const struct {
    const char* name;
    std::string bytes;
  } files[] = {{"skirt.glb", io::write_glb(skirt.model, skirt.state, {test::make_egg()})},
               {"bare.glb", io::write_glb(skirt.model, skirt.state, {})},
               {"body.glb", io::write_glb(none.model, none.state, {test::make_egg()})}};
  for (const auto& file : files)
    if (auto written = system_host().write_file(folder + "/" + file.name, file.bytes); !written) {
      std::fprintf(stderr, "%s: %s\n", file.name, written.error.message.c_str());
      return 1;
    }
}
