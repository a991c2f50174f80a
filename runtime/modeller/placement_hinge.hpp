#pragma once
// Placing the parts of a collar: a stand goes on from the neckline, a leaf is turned over the stand and reaches beyond it.
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "runtime/geometry/self_crossings.hpp"
#include "runtime/model/flat_index.hpp"

namespace garment::modeller {

/// A panel that hangs on its seams like a flap on its hinge: from each place of the seam it goes off as far as in the flat
/// pattern. It lies along the panel that it is turned onto, and beyond that one's foot on what follows, no further open than the
/// cloth there asks for. Over seams with other panels it carries their surface on; a panel that is turned onto none does so all along.
///
///          seam o.        A shirt's collar, cut across: the stand goes down from the seam, the leaf lies along it on the
///               | .       outside, and beyond the stand's foot on the shoulder.
///         stand |  . leaf
///               |   .
///         ------+--. .
///                   '-.'..
class HingedPanel {
 public:
  /// `panel` goes on from panels that are `placed` [n_panels] and share particles with it. `flat` [n_vertices] as for lay_panel.
  /// Keeps references to the model and to `flat`.
  HingedPanel(const model::Model& model, std::size_t panel, const std::vector<bool>& placed, const std::vector<model::Vector3d>& flat);
  /// The same, turned onto `other`, over its face or, where `over` is false, over its back.
  HingedPanel(const model::Model& model, std::size_t panel, std::size_t other, bool over, const std::vector<bool>& placed,
              const std::vector<model::Vector3d>& flat);

  std::size_t panel() const { return panel_; }

  /// False where it shares no stretch of a seam with the other panel, or with any: then it cannot be laid.
  bool hinged() const;

  /// Gives every vertex of the panel a position in `place` [n_vertices], from those of the panels it is hinged on.
  void lay(std::vector<model::Vector3d>& place) const;

  /// Where its seam's particles would lie, spread evenly over the line that they lie on now: the seam as a whole is stretched or
  /// drawn in then, not one cell of it.
  std::vector<std::pair<model::Index, model::Vector3d>> evenly_along_seam(const std::vector<model::Vector3d>& place) const;

  /// Opens it where its triangles cross others (numbers of the model's triangles), and a little less beside; where its ends meet
  /// one another they lean apart, and where neighbouring parts do their ways off the seam are evened. False where nothing is left
  /// to do.
  bool open(const std::vector<geometry::TrianglePair>& crossings);

 private:
  /// A place of the seam, by a vertex of the panel.
  struct Hinge {
    model::Index here = -1;
    model::Index other = -1;               ///< vertex of the panel that it is turned onto; -1 where it carries a third one on
    model::Vector2d into{0, 0};            ///< unit, off the seam in that panel's pattern
    std::vector<model::Index> there;       ///< vertices of placed panels at its particle
    std::vector<model::Index> triangles;   ///< round its particle, of the panel that it goes on from
    double foot = 0;                       ///< m off the seam, where the other panel ends
    std::array<double, 2> opening{0, 0};   ///< rad, between the other panel and this one: before and beyond its foot
    int evenings = 0;                      ///< of its way off the seam with those beside it
    double to_end = 0;                     ///< m, along the seam to its nearest end
    int way_from_end = 0;                  ///< 1 where that lies before it along the seam, -1 behind it; 0 on a ring
  };
  /// Neighbours along the seam; the panel lies to the left of the way.
  struct Span {
    std::size_t from = 0, to = 0;
    double length = 0;  ///< m, in the flat pattern
  };
  /// Where a vertex goes off the seam: at a share of a span, so far along it and across, m.
  struct Foot {
    std::size_t span = 0;
    double share = 0, along = 0, across = 0;
  };
  using Points = std::vector<model::Vector3d>;

  model::Vector2d flat_at(model::Index v) const { return flat_[v].head<2>(); }
  Points places_of_hinges(const Points& place) const;
  void find_hinges(const std::vector<bool>& placed);
  void find_spans();
  void find_ends();
  void find_feet_of_other();
  void find_feet();
  struct Shape;
  Points normals_of_other(const Points& place) const;
  Shape shape(const Points& place) const;
  model::Vector3d off_seam(const Shape& shape, std::size_t hinge, double across) const;
  Points evened(Points directions) const;
  void ease();

  const model::Model& model_;
  const Points& flat_;
  std::size_t panel_;
  std::optional<std::size_t> other_;       ///< that it is turned onto
  std::optional<model::FlatIndex> index_;  ///< of that one
  double sense_ = 1;                       ///< 1 over the other one's face, -1 over its back
  std::vector<Hinge> hinges_;
  std::vector<Span> spans_;
  std::vector<Foot> feet_;      ///< of the panel's vertices
  double lean_ = 0;             ///< at the ends of the seam, away from them, per length off it
};

}  // namespace garment::modeller
