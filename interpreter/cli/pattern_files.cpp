#include "interpreter/cli/pattern_files.hpp"

#include <filesystem>

#include "runtime/io/dxf_import.hpp"
#include "runtime/io/dxf_writer.hpp"
#include "runtime/io/pattern_layout.hpp"
#include "runtime/io/pattern_writer.hpp"
#include "runtime/io/svg_import.hpp"
#include "runtime/io/svg_writer.hpp"

namespace garment::cli {
namespace {

PatternFile read_specification(std::string_view bytes, const PatternFileOptions& options) {
  io::PatternOptions pattern_options;
  pattern_options.title = options.title;
  pattern_options.fabric = io::import_fabric();
  io::PatternResult read = io::read_pattern(bytes, pattern_options);
  PatternFile file;
  file.garment = std::move(read.garment);
  file.layout = std::move(read.layout);
  file.frame = read.frame;
  file.findings = std::move(read.findings);
  file.notes = std::move(read.notes);
  return file;
}

PatternFile read_pieces(std::string_view bytes, const PatternFileOptions& options) {
  io::DxfOptions dxf_options;
  dxf_options.title = options.title;
  dxf_options.fabric = io::import_fabric();
  dxf_options.size = options.size;
  io::DxfResult read = io::read_dxf(bytes, dxf_options);
  PatternFile file;
  file.garment = std::move(read.garment);
  file.sizes = std::move(read.sizes);
  file.findings = std::move(read.findings);
  file.notes = std::move(read.notes);
  return file;
}

PatternFile read_drawing(std::string_view bytes, const PatternFileOptions& options) {
  io::SvgOptions svg_options;
  svg_options.title = options.title;
  svg_options.fabric = io::import_fabric();
  io::SvgResult read = io::read_svg(bytes, svg_options);
  PatternFile file;
  file.garment = std::move(read.garment);
  file.findings = std::move(read.findings);
  file.notes = std::move(read.notes);
  return file;
}

}  // namespace

std::string ending_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  for (char& c : ending)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return ending;
}

bool is_pattern_ending(const std::string& ending) {
  return ending == ".json" || ending == ".dxf" || ending == ".svg";
}

PatternFile read_pattern_file(const std::string& ending, std::string_view bytes,
                              const PatternFileOptions& options) {
  if (ending == ".dxf") return read_pieces(bytes, options);
  if (ending == ".svg") return read_drawing(bytes, options);
  return read_specification(bytes, options);
}

PatternBytes write_pattern_file(const std::string& ending, const design::Garment& garment,
                                const io::PatternLayout* layout) {
  if (ending == ".json") {
    io::PatternText written = io::write_pattern_json(garment, layout);
    return {std::move(written.text), std::move(written.findings)};
  }
  if (ending == ".dxf") {
    io::DxfText written = io::write_dxf(garment);
    return {std::move(written.text), std::move(written.findings)};
  }
  if (ending == ".svg") return {io::write_pattern_svg(garment), {}};
  return {};
}

}  // namespace garment::cli
