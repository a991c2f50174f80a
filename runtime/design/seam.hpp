#pragma once
#include <optional>
#include <string>
#include <vector>

#include "runtime/design/edge_part.hpp"

namespace garment::design {

/// The face of the cloth looks out, its back to the body.
enum class Facing : std::uint8_t { face, back };

/// One side of a seam: parts that follow each other. The start of every side meets the start of the others.
struct SeamSide {
  OriginId origin;
  std::vector<EdgePart> parts;
  bool closed = false;  ///< a ring: its end is its start
  /// Of each part: how many times longer it is than the seam it is sewn into, against the side as a whole; a relation
  /// on part of a side. Empty: 1 everywhere.
  std::vector<double> fullness{};

  double fullness_of(std::size_t part) const { return fullness.empty() ? 1 : fullness[part]; }
};

/// How a seam is made up, once its sides are joined.
struct SeamFinish {
  bool turned = false;                   ///< sewn right sides together, then turned out
  double lap = 0;                        ///< m by which the sides lie over each other; 0: edge to edge
  std::optional<double> fold_angle;      ///< rad between the cloths, 0 is flat; folded to `fold_to`
  Facing fold_to = Facing::back;
  enum class Ironed : std::uint8_t { no, open, toward } ironed = Ironed::no;
  int ironed_toward = -1;                ///< side that the allowances lie on, with Ironed::toward
  double tension = 0;                    ///< strain at which the seam's thread is sewn: negative draws it in
  double slack = 0;                      ///< m of play between the sides; 0: none
  double stiffness = 1;                  ///< factor on the bending rigidity along the seam
  std::optional<double> allowance;       ///< m of cloth beyond the stitch line on either side

  friend bool operator==(const SeamFinish&, const SeamFinish&) = default;
};

/// Sides sewn together. Corresponding points are at equal fractions of sewn length (darts closed), each part's length
/// divided by its fullness.
struct Seam {
  std::string name;
  OriginId origin;
  std::vector<SeamSide> sides;
  /// What the script states about the length of side i against the last side: length_i = ratio * length_last.
  /// 1 is plain, 1.06 is 6 % ease, 1.8 a gather. `nan` means: whatever the lengths are (imports).
  std::vector<double> ratio;
  SeamFinish finish{};
};

/// An edge turned over and sewn down.
struct Hem {
  std::string name;
  OriginId origin;
  std::vector<EdgePart> parts;
  double turn = 0;  ///< m of cloth turned over
  Facing to = Facing::back;
};

}  // namespace garment::design
