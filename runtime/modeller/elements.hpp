#pragma once
// From panel meshes to the Model's particles, masses, springs, cells and membranes.
#include "runtime/model/model.hpp"
#include "runtime/modeller/panel_mesh.hpp"

namespace garment::modeller {

class ClothFields;

/// A meshed panel and where it begins in the Model.
struct MeshedPanel {
  const design::Panel* panel = nullptr;
  const design::Fabric* fabric = nullptr;
  GridFrame frame;
  PanelMesh mesh;
  model::Index first_vertex = 0;
  std::vector<double> vertex_area;  ///< share of each vertex in the panel's exact area, m^2
};

/// Twist rigidity Ct of a fabric; where it is unknown 0.20 (B_warp + B_weft), the median of measured fabrics.
double twist_rigidity(const design::Fabric& fabric);

/// Shares of the vertices in `area`: a third of each triangle, a quarter of each cell, half the bulge beyond
/// each border segment. They add up to `area`.
std::vector<double> vertex_areas(const PanelMesh& mesh, const Border& border, double area);

/// Fills vertices, triangles, panels and, over merged particles, mass, thickness and friction. `particle`
/// maps vertices to particles (numbered in order of first appearance). False, with findings, where sewing
/// folds a triangle onto a line.
bool add_particles(const design::Garment& garment, const std::vector<MeshedPanel>& panels,
                   const std::vector<double>& areas, const std::vector<model::Index>& particle,
                   const ClothFields& fields, model::Model& model, Findings& findings);

/// Springs, trellis cells (without twist) and membranes. Each is made of the cloth about
/// its middle.
void add_elements(const design::Garment& garment, const std::vector<MeshedPanel>& panels,
                  const ClothFields& fields, model::Model& model);

}  // namespace garment::modeller
