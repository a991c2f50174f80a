#pragma once
// One pattern piece as it is drawn: outline with its darts, names, notches, grain, and the letters of its
// seams.
#include <string>
#include <vector>

#include "runtime/design/garment.hpp"
#include "runtime/io/paper.hpp"

namespace garment::io {

constexpr double kChord = 5e-5;  // m, error of drawn curves
inline const Pen kCut{"#1b1d22", 0.7, "", "none"};
inline const Pen kMark{"#1b1d22", 0.5, "", "none"};

inline Point mm_of(const design::Point2& p) { return 1000 * p; }
inline std::vector<Point> mm_of(const std::vector<design::Point2>& points) {
  std::vector<Point> out;
  for (const design::Point2& p : points) out.push_back(mm_of(p));
  return out;
}

/// A stretch of an edge that a seam takes; both sides of the seam carry the same letter.
struct SeamTag {
  std::string letter;
  int edge = -1;
  double from = 0, to = 0;  ///< arc lengths in sewing order, m
};

class PanelDrawing {
 public:
  /// `facts` are printed under the name.
  PanelDrawing(const design::Panel& panel, std::vector<SeamTag> tags, std::vector<std::string> facts,
           const std::array<double, 3>& color);

  /// Room it takes, with its letters, mm.
  Point size() const { return room_.size(); }

  /// Draws it with the upper left corner of its room at `corner`.
  void draw(Paper& paper, const Point& corner) const;

  /// Outline in mm with darts cut away, y up, in the panel's own coordinates.
  const std::vector<Point>& outline() const { return outline_; }

 private:
  /// Panel millimetres, y up, to paper, y down.
  struct Placed {
    Point shift;
    Point operator()(const Point& p) const { return {shift[0] + p[0], shift[1] - p[1]}; }
    std::vector<Point> operator()(std::vector<Point> points) const {
      for (Point& p : points) p = (*this)(p);
      return points;
    }
  };
  struct Dart {
    int edge;
    double from, to;         ///< mouth on the edge, m
    Point start, apex, end;  ///< mm
    Point middle;            ///< of the mouth, mm
  };

  void collect_darts();
  void collect_outline();
  Point inward(int edge, double at) const;
  void draw_outline(Paper& paper, const Placed& on) const;
  void draw_notches(Paper& paper, const Placed& on) const;
  void draw_edge_names(Paper& paper, const Placed& on) const;
  void draw_tags(Paper& paper, const Placed& on) const;
  void draw_middle(Paper& paper, const Placed& on) const;
  void draw_interior(Paper& paper, const Placed& on) const;
  void draw_allowances(Paper& paper, const Placed& on) const;
  void draw_lenses(Paper& paper, const Placed& on) const;
  void draw_pleats(Paper& paper, const Placed& on) const;
  void draw_grain(Paper& paper, const Placed& on, const Point& through) const;

  const design::Panel& panel_;
  std::vector<SeamTag> tags_;
  std::vector<std::string> facts_;
  std::string tint_;
  double side_ = 1;  ///< +1: the inside lies left of the way the outline is walked
  std::vector<Dart> darts_;
  std::vector<Point> outline_;
  Extent room_;  ///< mm
};

}  // namespace garment::io
