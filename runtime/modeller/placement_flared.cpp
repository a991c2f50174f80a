#include "runtime/modeller/placement_flared.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>

#include "runtime/base/portable_math.hpp"
#include "runtime/modeller/wrap_curve.hpp"

namespace garment::modeller {
namespace {

using model::Index;
using portable::kPi;

constexpr double kLeastTurn = 0.95 * kPi;     // of all arcs together, from which on the panels hang as a cone
constexpr double kLeastRing = 0.8;            // of the ring round the body, that the arcs fill
constexpr double kSteepest = kPi / 12;        // of the cone, off the upright
constexpr double kFlattest = kPi / 4;         // as flat as the arms of a standing person leave room for
constexpr double kSteeper = kPi / 36;         // a try
constexpr double kLeastOffset = 4e-3;         // m
constexpr double kClear = 3e-3;               // m, of all particles from the body
constexpr double kSounded = 0.15;             // m, how deep in the body a particle is found
constexpr double kNoArc = 5e-3;               // off a circle, of the arc's length: shoulders that slope to a neck are none
constexpr double kLayers = 0.5;               // of the grid's spacing, between layers whose facets bend otherwise
constexpr double kWidest = 0.75;              // of the arc's length, that a panel reaches beside its middle
constexpr double kHanging = kPi / 12;         // of the cone that skirts come to hang in, off the upright
constexpr int kFewestFlutes = 3;
constexpr double kCellsOfFlute = 16;          // grid spacings along the hem, at least: a first drape takes every other one
constexpr int kSteps = 1440;                  // of the table of half the hem

/// A panel in polar coordinates about the centre of the arc it hangs by.
struct Fan {
  std::size_t panel = 0;
  Vector2d center{0, 0};
  double radius = 0, length = 0;      ///< of the arc, m
  double turn() const { return length / radius; }
  std::vector<double> along, off;     ///< of its vertices, m: along the arc from its middle, beyond the arc
};

/// A short piece of the arc.
struct ArcPiece {
  Vector2d middle;
  double length;
};

void add_pieces(const design::Edge& edge, std::vector<ArcPiece>& pieces) {
  const std::vector<geometry::Point2> line = edge.curve.polyline(1e-5);
  for (std::size_t i = 1; i < line.size(); ++i) pieces.push_back({(line[i] + line[i - 1]) / 2, (line[i] - line[i - 1]).norm()});
}

/// The edge that the panel is placed by goes by this name in both halves.
bool is_hung_by(const design::Panel& panel, const design::Edge& edge) {
  std::string name = panel.placement.edge;
  for (const char* half : {"left.", "right."})
    if (panel.fold_x && name.starts_with(half)) name.erase(0, std::string(half).size());
  return edge.name == name || edge.name == "left." + name || edge.name == "right." + name;
}

/// To 1e-9, of metres or radians.
double rounded(double x) {
  constexpr double kPlaces = 1 << 30;
  return std::round(x * kPlaces) / kPlaces;
}

/// Centre and radius of the circle next to the pieces, by least squares of the differences of squares (Kasa 1976); false where they
/// are straight, or no arc.
bool fit_circle(const std::vector<ArcPiece>& pieces, Fan& fan) {
  constexpr double kStraight = 10;    // radii over lengths
  Vector2d mean = Vector2d::Zero();
  fan.length = 0;
  for (const ArcPiece& p : pieces) fan.length += p.length;
  if (!(fan.length > 0)) return false;
  for (const ArcPiece& p : pieces) mean += p.length / fan.length * p.middle;
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  Vector3d right = Vector3d::Zero();
  for (const ArcPiece& p : pieces) {
    const Vector2d at = (p.middle - mean) / fan.length;
    const Vector3d row(2 * at.x(), 2 * at.y(), 1);
    squares += p.length * row * row.transpose();
    right += p.length * at.squaredNorm() * row;
  }
  const Vector3d solved = squares.fullPivLu().solve(right);
  const double radius = std::sqrt(solved.z() + solved.head<2>().squaredNorm());
  if (!(radius < kStraight)) return false;
  fan.center = mean + fan.length * solved.head<2>();
  fan.radius = fan.length * radius;
  // Mirror images of a panel are to begin as mirror images: what sums leave in the last bits must not tell them apart.
  fan.center = {rounded(fan.center.x()), rounded(fan.center.y())};
  fan.radius = rounded(fan.radius);
  fan.length = rounded(fan.length);
  double error = 0;
  for (const ArcPiece& p : pieces) {
    const double off = (p.middle - fan.center).norm() - fan.radius;
    error += p.length / fan.length * off * off;
  }
  return std::sqrt(error) < kNoArc * fan.length;
}

/// The arc of a panel, with the edges that go on along the same circle. Empty where it is none.
std::vector<ArcPiece> fit_arc(const design::Panel& panel, Fan& fan) {
  std::vector<ArcPiece> pieces;
  for (const design::Edge& e : panel.edges)
    if (is_hung_by(panel, e)) add_pieces(e, pieces);
  if (!fit_circle(pieces, fan)) return {};
  const std::size_t named = pieces.size();
  for (const design::Edge& e : panel.edges) {
    if (is_hung_by(panel, e)) continue;
    std::vector<ArcPiece> more;
    add_pieces(e, more);
    const bool on_circle = std::all_of(more.begin(), more.end(), [&](const ArcPiece& p) {
      return std::abs((p.middle - fan.center).norm() - fan.radius) < kNoArc * fan.length;
    });
    if (on_circle) pieces.insert(pieces.end(), more.begin(), more.end());
  }
  if (pieces.size() > named && !fit_circle(pieces, fan)) return {};
  return pieces;
}

/// Angle from straight down, towards +x.
double angle_of(const Vector2d& way) { return portable::atan2(way.x(), -way.y()); }

/// By how many whole turns of the centre the vertices of a panel lie on from the first one: a whole circle does not close.
std::vector<int> turns_of(const model::Model& model, const model::PanelRange& range, const std::vector<double>& angle) {
  std::vector<std::vector<Index>> beside(angle.size());
  for (Index t = range.first_triangle; t < range.first_triangle + range.n_triangles; ++t)
    for (int k = 0; k < 3; ++k) {
      const Index a = model.triangle[t][k] - range.first_vertex, b = model.triangle[t][(k + 1) % 3] - range.first_vertex;
      beside[a].push_back(b);
      beside[b].push_back(a);
    }
  std::vector<int> turns(angle.size(), 0);
  std::vector<bool> reached(angle.size(), false);
  std::vector<Index> line{0};
  reached[0] = true;
  for (std::size_t k = 0; k < line.size(); ++k)
    for (Index b : beside[line[k]]) {
      if (reached[b]) continue;
      reached[b] = true;
      const double step = angle[b] - angle[line[k]];
      turns[b] = turns[line[k]] + (step > kPi ? -1 : step < -kPi ? 1 : 0);
      line.push_back(b);
    }
  return turns;
}

std::optional<Fan> fan_of(const Workspace& w, std::size_t panel) {
  const design::Panel& p = w.garment.panels[panel];
  Fan fan;
  fan.panel = panel;
  const std::vector<ArcPiece> pieces = fit_arc(p, fan);
  if (pieces.empty()) return std::nullopt;
  constexpr double kOnFold = 1e-6;  // m
  if (p.fold_x && std::abs(fan.center.x() - *p.fold_x) < kOnFold) fan.center.x() = *p.fold_x;
  const model::PanelRange& range = w.model.panels[panel];
  std::vector<double> angle;
  double mean = 0;
  for_each_vertex(w.model, panel, [&](Index v) {
    const Vector2d way = w.flat[v].head<2>() - fan.center;
    angle.push_back(angle_of(way));
    fan.off.push_back(way.norm() - fan.radius);
    mean += fan.off.back() / range.n_vertices;
  });
  if (mean <= 0) return std::nullopt;  // it lies inside of its arc
  const std::vector<int> turns = turns_of(w.model, range, angle);
  for (std::size_t k = 0; k < angle.size(); ++k) angle[k] += 2 * kPi * turns[k];
  double middle = 0;
  for (const ArcPiece& piece : pieces) {
    double nearest = 1e300, beside = 0;
    for_each_vertex(w.model, panel, [&](Index v) {
      const double far = (w.flat[v].head<2>() - piece.middle).squaredNorm();
      if (far < nearest) nearest = far, beside = angle[v - range.first_vertex];
    });
    const double at = angle_of(piece.middle - fan.center);
    middle += piece.length / fan.length * (at + 2 * kPi * std::round((beside - at) / (2 * kPi)));
  }
  middle = rounded(middle);
  for (double a : angle) {
    fan.along.push_back((a - middle) * fan.radius);
    if (std::abs(fan.along.back()) > kWidest * fan.length) return std::nullopt;
  }
  return fan;
}

/// The cone below a ring: which way the cloth goes from each place on the ring. Mirrored in x like the ring.
class FlutedCone {
 public:
  /// `hem` is the length that the cone is to have `off` beyond the ring; `slope` its mean angle off the upright.
  FlutedCone(double ring, double off, double hem, double slope, int flutes)
      : radius_(ring / (2 * kPi)), off_(off), slope_(slope), flutes_(flutes) {
    double low = 0, high = slope;
    fill(0);
    if (arc_.back() * 2 >= hem) return;
    for (int k = 0; k < 60; ++k) {
      const double swing = 0.5 * (low + high);
      fill(swing);
      (2 * arc_.back() < hem ? low : high) = swing;
    }
  }

  bool reaches(double hem) const { return 2 * arc_.back() > 0.999 * hem; }

  /// Unit, at a share in [0, 0.5] of the way round.
  Vector3d way(double share) const {
    const double wanted = 2 * share * arc_.back();
    const auto next = std::upper_bound(arc_.begin() + 1, arc_.end() - 1, wanted);
    const std::size_t k = static_cast<std::size_t>(next - arc_.begin());
    const double part = (wanted - arc_[k - 1]) / (arc_[k] - arc_[k - 1]);
    return way_at(kPi * (static_cast<double>(k - 1) + part) / kSteps);
  }

 private:
  Vector3d way_at(double angle) const {
    const double lean = slope_ + swing_ * portable::cos(flutes_ * angle);
    const double out = portable::sin(lean);
    return {out * portable::sin(angle), -portable::cos(lean), out * portable::cos(angle)};
  }
  void fill(double swing) {
    swing_ = swing;
    arc_.assign(1, 0);
    auto at = [&](double angle) -> Vector3d {
      return radius_ * Vector3d(portable::sin(angle), 0, portable::cos(angle)) + off_ * way_at(angle);
    };
    Vector3d before = at(0);
    for (int k = 1; k <= kSteps; ++k) {
      const Vector3d here = at(kPi * k / kSteps);
      arc_.push_back(arc_.back() + (here - before).norm());
      before = here;
    }
  }

  double radius_, off_, slope_, swing_ = 0;
  int flutes_;
  std::vector<double> arc_;  ///< of half the hem, at equal steps of angle, m
};

/// How many folds such a skirt has room for: wrinkles of a sheet of bending rigidity B under a tension T over a length L are
/// 2 sqrt(pi) (B / T)^(1/4) L^(1/2) long (Cerda, Mahadevan 2003); here T is half the weight of what hangs. The start decides, as few
/// folds merge or part on the way down; a skirt of denim with as many as this has less energy at rest than with two fewer or more.
int count_flutes(const Workspace& w, const Fan& fan, double ring, double off, double hem) {
  const design::Panel& panel = w.garment.panels[fan.panel];
  const design::Fabric& cloth = w.garment.fabrics[panel.fabric];
  constexpr double kGravity = 9.80665;  // m/s^2
  const double rigidity = 0.5 * (cloth.bending_rigidity[0] + cloth.bending_rigidity[1]);
  const double tension = 0.5 * cloth.areal_density * kGravity * off;
  const double wave = 2 * std::sqrt(kPi * off * std::sqrt(rigidity / tension));
  const double most = hem / (kCellsOfFlute * panel.resolution), around = ring + 2 * kPi * off * portable::sin(kHanging);
  return std::max(kFewestFlutes, static_cast<int>(std::min(most, wave > 0 ? std::round(around / wave) : most)));
}

/// Share of the ring, from the front centre towards +x, at which a part's middle lies; in (-0.5, 0.5].
double share_of(const std::string& part) {
  if (part == "back") return 0.5;
  if (part == "left") return 0.25;
  if (part == "right") return -0.25;
  return 0;
}

/// Panels that hang from one ring at a level of a body, and the ring.
class Flare {
 public:
  Flare(Workspace& w, const body::Body& body, const std::vector<std::size_t>& panels);

  /// False where the panels fan out too little, or do not go round.
  bool any() const { return ring_.has_value(); }
  /// Mean angle off the upright at which the cone is as wide as the cloth.
  double widest() const { return portable::asin(std::min(1.0, turn_ / (2 * kPi))); }
  /// Fills the places of all panels. False where a particle lies less than `kClear` off the body, or where the flutes do not take up
  /// the cloth.
  bool lay(double slope);
  std::vector<std::size_t> panels() const;

 private:
  bool lies_on_another(const Fan& fan) const;
  double lift(const Fan& fan, Index vertex) const;
  double middle_share(const Fan& fan) const;
  Vector3d place(double middle, double along, double off, double lift, const FlutedCone& cone) const;

  Workspace& w_;
  const body::Body& body_;
  std::vector<Fan> fans_;
  std::string level_;
  double turn_ = 0, length_ = 0, off_ = 0;  ///< of all that do not lie on each other: rad, of the arcs, and the farthest below them, m
  double height_ = 0, center_ = 0;          ///< y and x of the ring, m
  int flutes_ = 0;
  std::optional<WrapCurve> ring_;
};

Flare::Flare(Workspace& w, const body::Body& body, const std::vector<std::size_t>& panels) : w_(w), body_(body) {
  for (std::size_t panel : panels) {
    const design::Placement& p = w.garment.panels[panel].placement;
    if (p.edge.empty() || !body.levels.contains(p.level) || (!level_.empty() && p.level != level_)) continue;
    if (std::optional<Fan> fan = fan_of(w, panel)) fans_.push_back(std::move(*fan)), level_ = p.level;
  }
  const Fan* longest = nullptr;
  for (const Fan& fan : fans_) {
    if (lies_on_another(fan)) continue;
    turn_ += fan.turn();
    length_ += fan.length;
    const double reach = *std::max_element(fan.off.begin(), fan.off.end());
    if (reach > off_) off_ = reach, longest = &fan;
  }
  if (turn_ < kLeastTurn) return;
  height_ = body.levels.at(level_).height;
  const std::vector<Vector2d> points = torso_points(body, height_, height_);
  if (points.size() < 3) return;
  double low = 1e300, high = -1e300;
  for (const Vector2d& p : points) low = std::min(low, p.x()), high = std::max(high, p.x());
  center_ = (low + high) / 2;
  const double bare = WrapCurve(points, center_, kLeastOffset).length();
  if (length_ < kLeastRing * bare) return;
  double under = 0;  // m, of linings
  for (const Fan& fan : fans_)
    for_each_vertex(w.model, fan.panel, [&](Index v) { under = std::max(under, -lift(fan, v)); });
  // A ring grown by d is longer by 2 pi d. It is as long as the cloth, wherever the panels were told to lie.
  ring_.emplace(points, center_, kLeastOffset + std::max(under, (length_ - bare) / (2 * kPi)));
  flutes_ = count_flutes(w, *longest, ring_->length(), off_, length_ + turn_ * off_);
}

std::vector<std::size_t> Flare::panels() const {
  std::vector<std::size_t> panels;
  for (const Fan& fan : fans_) panels.push_back(fan.panel);
  return panels;
}

bool Flare::lies_on_another(const Fan& fan) const {
  return std::any_of(w_.garment.stackings.begin(), w_.garment.stackings.end(), [&](const design::Stacking& s) {
    return s.panel == static_cast<int>(fan.panel) &&
           std::any_of(fans_.begin(), fans_.end(), [&](const Fan& f) { return f.panel == static_cast<std::size_t>(s.other); });
  });
}

/// How far a vertex lies off the cone, m.
double Flare::lift(const Fan& fan, Index vertex) const {
  const double z = w_.flat[vertex].z();
  if (z == 0 || !lies_on_another(fan)) return z;
  const double least = kLayers * w_.garment.panels[fan.panel].resolution;
  return z < 0 ? std::min(z, -least) : std::max(z, least);
}

/// Where the middle of a panel's arc lies on the ring, in (-0.5, 0.5]: two of a pair on one part lie side by side.
double Flare::middle_share(const Fan& fan) const {
  const double share = share_of(w_.garment.panels[fan.panel].placement.part);
  if (!image_of(w_.garment, fan.panel)) return share;
  double mean = 0;
  for_each_vertex(w_.model, fan.panel, [&](Index v) { mean += w_.flat[v].x(); });
  const double half = 0.5 * fan.length / length_;
  if (mean < 0) return share - half;
  return share == 0.5 ? half - share : share + half;
}

/// `along` the arc from the panel's middle, `off` it, and `lift` off the cone, m. Only half the ring is looked up: the other half is
/// its mirror image to the last bit.
Vector3d Flare::place(double middle, double along, double off, double lift, const FlutedCone& cone) const {
  double share = std::abs(middle + along / length_), side = middle + along / length_ < 0 ? -1 : 1;
  if (middle == 0.5) share = 0.5 - std::abs(along) / length_, side = along > 0 ? -1 : 1;
  if (share > 0.5) share = 1 - share, side = -side;
  share = std::clamp(share, 0.0, 0.5);
  const Vector3d way = cone.way(share);
  const Vector2d at = ring_->at(share * ring_->length()), level(way.x(), way.z());
  const Vector2d there = at - Vector2d(center_, 0) + (off - lift * way.y() / level.norm()) * level;
  const bool on_axis = share == 0 || share == 0.5;
  return {on_axis ? center_ : center_ + side * there.x(), height_ + off * way.y() + lift * level.norm(), there.y()};
}

bool Flare::lay(double slope) {
  const double hem = length_ + turn_ * off_;
  const FlutedCone cone(ring_->length(), off_, hem, slope, flutes_);
  if (!cone.reaches(hem)) return false;
  bool clear = true;
  for (const Fan& fan : fans_) {
    const double middle = middle_share(fan);
    const Index first = w_.model.panels[fan.panel].first_vertex;
    for_each_vertex(w_.model, fan.panel, [&](Index v) {
      const auto k = static_cast<std::size_t>(v - first);
      w_.place[v] = place(middle, fan.along[k], fan.off[k], lift(fan, v), cone);
      const auto hit = body_.closest(w_.place[v], kSounded);
      clear = clear && (!hit || hit->distance >= kClear);
    });
  }
  return clear;
}

}  // namespace

std::vector<std::size_t> lay_flared(Workspace& w, const body::Body& body, const std::vector<std::size_t>& panels) {
  Flare flare(w, body, panels);
  if (!flare.any()) return {};
  for (double slope = std::min(flare.widest() - kSteeper, kFlattest); slope >= kSteepest; slope -= kSteeper)
    if (flare.lay(slope)) return flare.panels();
  return {};
}

}  // namespace garment::modeller
