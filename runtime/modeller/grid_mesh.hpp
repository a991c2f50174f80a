#pragma once
// The mesh of a polygon, with holes or without: full grid cells inside, triangles between them and the border.
#include <array>
#include <vector>

#include <Eigen/Core>

namespace garment::modeller {

///      3---2      corners of a cell, counter-clockwise from the one of least p and q
///      |   |
///   q  0---1
///      p
struct LoopMesh {
  bool ok = false;
  std::array<int, 2> bad{-1, -1};   ///< on failure: the border vertices between which the polygon is pinched
  std::vector<Eigen::Vector2d> at;  ///< the loops' vertices first, then the interior ones, row by row
  std::vector<std::array<int, 4>> cells;  ///< full cells, all of size hp x hq
  std::vector<std::array<int, 3>> cut;    ///< triangles between full cells and border, counter-clockwise
  std::vector<std::array<int, 3>> cell_halves;  ///< two triangles per full cell, in the order of `cells`
};

/// The border of a polygon: it runs from vertex k to vertex next[k] (simple loops: the outer one counter-clockwise, holes
/// clockwise; -1 where no border goes on), and the segments inside that must become sides of triangles.
struct LoopBorder {
  std::vector<Eigen::Vector2d> at;
  std::vector<int> next;
  std::vector<std::array<int, 2>> lines{};
};

/// Meshes the polygon on the grid lines p = i hp, q = j hq. Crossings nearer than 0.45 spacings to the border or a line are
/// left out; vertices of theirs that lie on a crossing take its place. Vertices on no segment are left out.
LoopMesh mesh_loop(const LoopBorder& border, double hp, double hq);

}  // namespace garment::modeller
