#pragma once
// Where the cloth is folded at rest along chains of particles - seams, and lines that the mesh follows - and what that means
// for the fitted stencils nearby.
#include <vector>

#include "runtime/modeller/chart.hpp"
#include "runtime/modeller/elements.hpp"

namespace garment::modeller {

constexpr double kLargestFold = 3.05;  // rad; folded flat, cloth turns about its own thickness

/// Particles along which the cloth is folded at rest.
struct FoldChain {
  std::vector<model::Index> particle;
  double angle = 0;   ///< rad from flat; positive folds to the back
  bool goes_on = false;  ///< the fold does not end where the chain does: it is a seam's
  /// Panels whose back is not that of the chain, because a `reversed` side joins them face to back.
  std::vector<model::Index> turned_over{};
};

/// Folds of seams (`fold`, `turned`), and of irons along edges and along lines that the mesh follows.
std::vector<FoldChain> fold_chains(const design::Garment& garment, const std::vector<BorderPanel>& outlines,
                                   const Borders& borders, const std::vector<MeshedPanel>& panels, const model::Model& model);

/// True of a seam that joins two sheets into one, which can be folded along it: not one onto a line inside a panel, of three
/// sides, or one that is tied.
bool folds_as_one(const design::Seam& seam);

/// True where the mesh follows the fold and the fitted stencils keep it: narrower than the grid `h`, m, or at a slant to the
/// threads of the panel; other folds lie in the threads that cross them.
bool follows_fold(const design::Press& press, const design::Panel& panel, const design::EdgePart& part, double h);

/// The chains, by particle.
class Folds {
 public:
  Folds(std::vector<FoldChain> chains, std::size_t n_particles);

  /// Where the chart's points and then its centre lie at rest, m, the plane of the centre being that of the chart; nothing
  /// where no chain comes between them. The way from the centre to a point is bent where it crosses a chain.
  std::vector<model::Vector3d> rest_places(const Chart& chart, model::Index centre, const model::Model& model) const;

 private:
  struct Link {
    model::Index chain, place;  // place of the particle on the chain
  };
  std::vector<FoldChain> chains_;
  std::vector<std::vector<Link>> links_;  // of every particle
};

}  // namespace garment::modeller
