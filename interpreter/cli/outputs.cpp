#include "interpreter/cli/outputs.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "interpreter/session/result_files.hpp"
#include "runtime/base/hash.hpp"
#include "runtime/io/mesh_writers.hpp"
#include "runtime/io/svg_writer.hpp"
#include "runtime/render/pictures.hpp"
#include "runtime/results/strain.hpp"

namespace garment::cli {
namespace {

/// Tensile strain of each vertex: the larger of warp and weft.
std::vector<double> largest_of_both(const std::vector<Eigen::Vector2d>& strain) {
  std::vector<double> out;
  out.reserve(strain.size());
  for (const Eigen::Vector2d& s : strain) out.push_back(s.maxCoeff());
  return out;
}

void write_pictures(const Project& project, const model::Model& model, const model::State& state, OutputFolder& out) {
  render::Scene scene = render::make_scene(model, state, project.result.bodies);
  results::StrainReport strain = results::measure_strain(model, state);
  std::vector<double> per_vertex = largest_of_both(results::vertex_strain(model, state));
  out.write("drape.png", render::render_sheet(scene));
  out.write("front.png", render::render_drape(scene, render::View::front));
  out.write("side.png", render::render_drape(scene, render::View::side));
  out.write("back.png", render::render_drape(scene, render::View::back));
  out.write("strain.png", render::render_strain(scene, per_vertex, strain.all.any.largest, render::View::front));
}

}  // namespace

bool OutputFolder::write(const std::string& name, const std::string& bytes) {
  if (bytes.empty()) return true;  // nothing to show (a picture without cloth)
  HostResult<bool> written = host_.write_below(granted_, (std::filesystem::path(folder_) / name).string(), bytes);
  if (!written) {
    if (!failed_)
      show({plain_error("G0902", fmt::format("cannot write `{}/{}`: {}", folder_, name, written.error.message),
                        "choose another folder with -o")},
           grammar::Sources{}, terminal_);
    failed_ = true;
    return false;
  }
  files_.push_back({name, sha256(bytes), bytes.size()});
  return true;
}

void OutputFolder::keep(Archive& a) {
  if (!a.length(files_, 1)) return;
  for (results::OutputFile& file : files_) {
    a.keep(file.name);
    a.keep(file.sha256);
    a.keep(file.bytes);
  }
}

void write_results(const OutputOptions& options, const Project& project, const model::Model& model,
                   const model::State& state, OutputFolder& out) {
  const std::vector<body::Body>& bodies = project.result.bodies;
  if (!out.write("garment.obj", io::write_obj(model, state))) return;
  if (!bodies.empty()) out.write("body.obj", io::write_body_obj(bodies));
  out.write("garment.glb", io::write_glb(model, state, bodies));
  out.write("pattern.svg", io::write_pattern_svg(project.result.garment, model));
  if (options.ply) out.write("garment.ply", io::write_ply(model, state, results::vertex_strain(model, state)));
  if (options.pictures) write_pictures(project, model, state, out);
}

bool save_file(const std::string& name, const Project& project, const model::Model& model, const model::State& state,
               OutputFolder& out, const io::PaperSize& paper, Terminal& terminal) {
  session::ResultFile file =
      session::make_result_file(name, project.result.garment, project.result.bodies, model, state, paper);
  if (file.bytes) return out.write(name, *file.bytes);
  show({plain_error("G0905", file.message, file.help)}, project.sources, terminal);
  return false;
}

}  // namespace garment::cli
