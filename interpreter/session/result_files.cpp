#include "interpreter/session/result_files.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "runtime/io/dxf_writer.hpp"
#include "runtime/io/mesh_writers.hpp"
#include "runtime/io/pattern_writer.hpp"
#include "runtime/io/svg_writer.hpp"
#include "runtime/render/pictures.hpp"
#include "runtime/results/strain.hpp"

namespace garment::session {

ResultFile make_result_file(const std::string& name, const design::Garment& garment,
                            const std::vector<body::Body>& bodies, const model::Model& model,
                            const model::State& state, const io::PaperSize& paper) {
  std::filesystem::path path(name);
  std::string ending = path.extension().string();
  if (ending == ".obj") return {io::write_obj(model, state), "", ""};
  if (ending == ".glb") return {io::write_glb(model, state, bodies), "", ""};
  if (ending == ".ply") return {io::write_ply(model, state, results::vertex_strain(model, state)), "", ""};
  if (ending == ".csv") return {io::write_csv(model, state, results::vertex_strain(model, state)), "", ""};
  if (ending == ".pdf") return {io::write_pattern_pdf(garment, &model, paper), "", ""};
  if (ending == ".dxf") return {io::write_dxf(garment).text, "", ""};
  if (ending == ".json") return {io::write_pattern_json(garment).text, "", ""};
  if (ending == ".svg") return {io::write_pattern_svg(garment, model), "", ""};
  if (ending == ".png") return {render::render_sheet(render::make_scene(model, state, bodies)), "", ""};
  return {std::nullopt, fmt::format("`save \"{}\"`: `{}` is no format that can be written", name, ending),
          "use .obj, .glb, .ply, .svg, .pdf, .dxf, .json, .png or .csv"};
}

}  // namespace garment::session
