#pragma once
// The stencils of a Model, copied into chunks that can be worked on at the same time without meeting.
#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "runtime/model/model.hpp"
#include "runtime/simulator/block_matrix.hpp"
#include "runtime/simulator/tensile_table.hpp"

namespace garment::simulator {

using model::Index;
using model::Indices;

/// Where the block of two particles of a stencil stands in the matrix: the block of the upper triangle,
/// transposed if the first particle has the larger id; nowhere if a seam has made one particle of both.
struct BlockPlace {
  std::int32_t code = -1;  ///< 2 * position + transposed, -1: nowhere
  bool nowhere() const { return code < 0; }
  bool transposed() const { return (code & 1) != 0; }
  std::size_t position() const { return static_cast<std::size_t>(code >> 1); }
};

struct SpringStencil {
  Indices<2> particle;
  Index law;
  BlockPlace place;
  double rest, inverse_rest, width;
};

struct CellStencil {
  Indices<4> particle;
  std::array<BlockPlace, 6> place;  ///< 01 02 03 12 13 23
  double corner_shear;              ///< G times a quarter of the cell, N m
  double twist;                     ///< 4 Ct / (h1 h2), N/m: E = twist/2 |x2 - x1 - x3 + x0|^2
  Index twisted = -1;               ///< into twisted; -1: flat at rest
};

/// What x2 - x1 - x3 + x0 of a cell is at rest: `size` along the normal that the cell had at the last ElasticModel::follow.
struct TwistedCell {
  Indices<4> particle;
  double size = 0;                  ///< m
  Eigen::Vector3d now = Eigen::Vector3d::Zero();
};

struct MembraneStencil {
  Indices<3> particle;
  Indices<2> law;
  std::array<BlockPlace, 3> place;  ///< 01 02 12
  std::array<double, 6> weight;
  double area, shear;
};

struct BendStencil {
  Indices<3> particle;
  std::array<BlockPlace, 3> place;  ///< 01 02 12
  double stiffness;                 ///< p B / hbar, N m: E = stiffness/2 theta^2
  Index crease = -1;                ///< into creases; -1: flat at rest
};

/// The rest fold of a bending stencil. Its axis is that of the last ElasticModel::follow, so that the energy has a gradient
/// of its own; near rest the axis no longer turns.
struct Crease {
  Indices<2> axis, in;              ///< particles: of the axis; of the edge that is turned
  double sine = 0, cosine = 1;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
};

struct FitStencil {
  std::size_t begin, end;    ///< into fit_particle, fit_weight
  Eigen::Matrix3d rigidity;  ///< D times the area
  Index fold = -1;           ///< into folds; -1: flat at rest
};

/// The curvatures of a fitted stencil at rest, K_11, K_22 and K_12 as columns, in the axes of its places.
struct Fold {
  std::size_t begin, end;    ///< into fold_frames: the particles that it turns with
  Eigen::Matrix3d rest;
};

/// A particle that a fold turns with, and its place at rest from the middle of all those, m.
struct FoldFrame {
  Index particle;
  Eigen::Vector3d place;
};

/// A tie with equal particles taken together: span = sum coefficient[k] x[particle[k]], and the coefficients sum to zero.
struct TieStencil {
  int n = 0;  ///< particles that count; 0: both places are one
  Indices<6> particle{};
  std::array<double, 6> coefficient{};
  std::array<BlockPlace, 15> place{};  ///< 01 02 .. 0n-1, 12 .. 1n-1, ..
  double length = 0, stiffness = 0;
  bool rod = false;          ///< pushes as well
};

/// A range of every kind of stencil, all near one another.
struct Chunk {
  struct Range {
    std::size_t begin = 0, end = 0;
  };
  Range springs, cells, membranes, bends, fits, ties;
};

struct ElasticStencils {
  explicit ElasticStencils(const model::Model& model);

  std::size_t n_particles = 0;
  double tensile_scale = 1;
  std::vector<TensileTable> laws;
  std::vector<SpringStencil> springs;
  std::vector<CellStencil> cells;
  std::vector<MembraneStencil> membranes;
  std::vector<BendStencil> bends;
  std::vector<Crease> creases;
  std::vector<TwistedCell> twisted;
  std::vector<Fold> folds;
  std::vector<FoldFrame> fold_frames;
  std::vector<FitStencil> fits;
  std::vector<TieStencil> ties;
  std::vector<Index> fit_particle;
  std::vector<Eigen::Vector3d> fit_weight;

  std::vector<Chunk> chunks;
  std::vector<std::vector<std::size_t>> colors;  ///< chunks that share no particle, colour by colour
  std::shared_ptr<const BlockPattern> pattern;
  std::vector<Index> upper_begin;  ///< [n] first block of each row with column > row
  std::vector<float> constant;     ///< [n_blocks] twist and fits: this times the identity, upper blocks
};

}  // namespace garment::simulator
