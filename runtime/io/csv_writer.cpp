#include <fmt/format.h>

#include "runtime/base/number.hpp"
#include "runtime/io/mesh_writers.hpp"

namespace garment::io {

std::string write_csv(const model::Model& model, const model::State& state,
                      const std::vector<Eigen::Vector2d>& vertex_strain) {
  std::string table = "panel,pattern_x,pattern_y,x,y,z,strain_warp,strain_weft\n";
  for (std::size_t v = 0; v < model.n_vertices(); ++v) {
    const model::PanelRange& panel = model.panels[static_cast<std::size_t>(model.vertex_panel[v])];
    const model::Vector3d& p = state.position[static_cast<std::size_t>(model.vertex_particle[v])];
    const model::Vector2d& uv = model.vertex_uv[v];
    table += panel.name;
    for (double x : {uv.x(), uv.y(), p.x(), p.y(), p.z(), vertex_strain[v].x(), vertex_strain[v].y()})
      table += ',' + format_number(x, 9);
    table += '\n';
  }
  return table;
}

}  // namespace garment::io
