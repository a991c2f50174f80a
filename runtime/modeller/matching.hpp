#pragma once
// Which stretch of which border lies against which: seams, dart legs and the halves of symmetric panels all
// ask that borders carry the same particles at the same fractions.
#include <string>
#include <vector>

#include "runtime/base/finding.hpp"
#include "runtime/design/garment.hpp"
#include "runtime/modeller/outline.hpp"

namespace garment::modeller {

constexpr double kSnap = 0.2;  // of h, on the side with most particles: breaks closer than this are one

/// A panel's outline with its grid spacing, as the matching sees it.
struct BorderPanel {
  const design::Panel* panel = nullptr;
  double h = 0.01;
  Outline outline;
};

/// Part of one piece, walked from t0 to t1 (t0 > t1 walks it backwards). `begin` is the seam's length before
/// it: sewn length divided by fullness.
struct SideSegment {
  int panel = -1, piece = -1;
  double t0 = 0, t1 = 0;
  double begin = 0;
  double fullness = 1;  ///< how many times longer than the seam it is sewn into
  double length() const { return t0 < t1 ? t1 - t0 : t0 - t1; }
  double taken() const { return length() / fullness; }
};

struct Side {
  std::vector<SideSegment> segments;
  double length = 0;  ///< of the seam: sewn lengths, each divided by its fullness, m
};

/// Borders that carry particles at the same fractions of the seam.
struct Matching {
  std::string name;
  OriginId origin;
  std::vector<Side> sides;
  bool merge = true;   ///< false: the particles correspond but stay apart (halves of a symmetric panel, tied seams)
  bool report = true;  ///< has a SeamChain in the model
  double lap = 0, slack = 0;  ///< m; with either the sides are tied
  double tension = 0;         ///< of the seam's thread; design::SeamFinish
  bool rings = false;         ///< every side is closed
  bool tied() const { return lap > 0 || slack > 0; }
};

/// A border between two neighbouring breaks of a piece.
struct Stretch {
  int panel = -1, piece = -1;
  std::size_t lower = 0;  ///< from breaks[lower] to breaks[lower + 1]
  int group = -1;         ///< stretches of a group share their fractions
  bool reversed = false;  ///< its fractions are those of the group from the other end
};

/// One stretch per side, in the order walked; `forward` where a side walks it with its piece.
struct StretchTuple {
  std::vector<int> stretch;
  std::vector<bool> forward;
};

struct Matched {
  std::vector<Stretch> stretches;  ///< panel by panel, piece by piece, in walking order
  int n_groups = 0;
  std::vector<std::vector<StretchTuple>> tuples;  ///< per matching, along its sides
};

/// Seams, then the closed parts of zips, then darts, then symmetric halves. Sides whose parts lie wholly in a dart's mouth or name nothing
/// are reported. Adds breaks to the outlines at the ends of parts; parts that end within 0.2 h of a break end
/// there.
std::vector<Matching> collect_matchings(const design::Garment& garment, std::vector<BorderPanel>& panels,
                                        Findings& findings);

/// Puts breaks at the ends of the attached parts of edges.
void break_at_attachments(const design::Garment& garment, std::vector<BorderPanel>& panels);

/// Carries every break to the borders that lie against it, until each side of each matching has as many
/// breaks as the others (breaks of different sides closer than 0.2 h are taken for one), then groups the
/// stretches between them. Returns false, with a finding at the seam, where that does not end.
bool match_stretches(const std::vector<Matching>& matchings, std::vector<BorderPanel>& panels,
                     Matched& matched, Findings& findings);

}  // namespace garment::modeller
