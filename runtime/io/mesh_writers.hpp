#pragma once
// Draped garments and bodies as mesh files. Each writer returns the bytes of the file; the caller writes them
// through the Host. Metres, y up, triangles counter-clockwise seen on the cloth's face. Positions must be
// finite.
#include <Eigen/Core>
#include <string>
#include <vector>

#include "runtime/body/body.hpp"
#include "runtime/model/model.hpp"

namespace garment::io {

/// Wavefront OBJ of the garment alone. One `v` per particle, so seams are welded, printed with the digits
/// that read back to the same double; one `vt` per panel vertex, its flat position in metres; a group per
/// panel; faces are v/vt.
std::string write_obj(const model::Model& model, const model::State& state);

/// Wavefront OBJ of bodies, an object each.
std::string write_body_obj(const std::vector<body::Body>& bodies);

/// Binary little-endian PLY of the garment, one vertex per panel vertex: x y z (double), nx ny nz, s t (flat
/// metres), strain_warp strain_weft (float), red green blue, panel. `strain` is [n_vertices] of (warp, weft),
/// or empty for zeros.
std::string write_ply(const model::Model& model, const model::State& state,
                      const std::vector<Eigen::Vector2d>& strain = {});

/// Binary glTF 2.0: node "garment" with one primitive per panel (double-sided cloth, TEXCOORD_0 = flat metres
/// with v downwards, smooth normals), and one node per body. Positions are rounded to float32, as the format
/// wants.
std::string write_glb(const model::Model& model, const model::State& state,
                      const std::vector<body::Body>& bodies);

/// A table for analysis, a row for each vertex: panel, its place in the pattern and in space (m), tensile strain along
/// warp and weft. `vertex_strain` as in write_ply.
std::string write_csv(const model::Model& model, const model::State& state,
                      const std::vector<Eigen::Vector2d>& vertex_strain);

}  // namespace garment::io
