#pragma once
// Wavefront OBJ, the part that carries a surface: `v` and `f`. Own and small: the file comes from anywhere.
#include <optional>
#include <string>
#include <string_view>

#include "runtime/base/finding.hpp"
#include "runtime/base/limits.hpp"
#include "runtime/body/body.hpp"

namespace garment::body {

inline constexpr std::uint64_t kMaxObjBytes = kMaxMeshBytes;
inline constexpr std::size_t kMaxObjTriangles = 5'000'000;
inline constexpr double kMaxCoordinate = 1e4;  ///< m, after scaling

struct MeshResult {
  std::optional<TriangleMesh> mesh;  ///< nothing when there are errors
  Findings findings;
};

/// Reads the text of an OBJ file; coordinates are multiplied by `scale` (metres). Polygons become fans of
/// triangles, indices may be negative, v/vt/vn are understood, all else is passed over. `name` is used in
/// messages, which point at `origin`.
///
/// Vertices at the same place become one, unused ones are dropped, and so are triangles that have no three
/// different corners (noted). Triangles that look inward as a whole are turned (noted).
///
/// Errors: G0702 no text or nothing of a mesh in it, G0703 a line that cannot be read, G0704 too large, G0705
/// the surface is open, G0706 neighbouring faces disagree about the outside. Warnings: G0707 the height looks
/// like centimetres or millimetres.
MeshResult read_obj(std::string_view text, double scale, const std::string& name, OriginId origin);

/// The same of a surface that is only looked at: it may be open, its faces may disagree, its unit is the file's. Errors:
/// G0702, G0703, G0704.
MeshResult read_obj_as_is(std::string_view text, const std::string& name);

}  // namespace garment::body
