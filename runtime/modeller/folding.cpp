#include "runtime/modeller/folding.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "runtime/base/portable_math.hpp"
#include "runtime/modeller/pleats.hpp"

namespace garment::modeller {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using geometry::cross;
using model::Index;
using model::Vector3d;

constexpr double kSameLength = 1e-6;  // m
constexpr double kFar = 1e3;          // links by which a line goes on beyond what a chart shows of it

/// The rotation by `angle` about a direction in the plane.
Matrix3d turn_about(const Vector2d& direction, double angle) {
  const Vector2d d = direction.normalized();
  Matrix3d across;  // d x
  across << 0, 0, d.y(), 0, 0, -d.x(), -d.y(), d.x(), 0;
  return Matrix3d::Identity() + portable::sin(angle) * across + (1 - portable::cos(angle)) * across * across;
}

/// A piece of a folded line as a chart shows it; a and b may lie far beyond the chart.
struct Hinge {
  Vector2d a, b;
  double angle;
  bool through_centre;
};

/// Where the way to a point bends: how far along it, about what.
struct Bend {
  double share;
  Vector2d about;
  double angle;  // of what comes after, about `about`
};

/// The way from the origin to `to`, over the hinges.
Vector3d carry(const Vector2d& to, const std::vector<Hinge>& hinges, bool& bent) {
  std::vector<Bend> bends;
  for (const Hinge& hinge : hinges) {
    const Vector2d way = hinge.b - hinge.a;
    // What is carried over to the left side folds to the back when it turns about the line by minus the angle.
    if (hinge.through_centre) {
      if (cross(way, to) > 1e-9 * way.norm() * to.norm()) bends.push_back({0, way, -hinge.angle});
      continue;
    }
    const double det = cross(to, way);
    if (det == 0) continue;
    const double share = cross(hinge.a, way) / det;
    // Asked of each end by itself, so that a way through a particle of the line crosses one of the hinges that meet there.
    if (share <= 0 || share >= 1 || (cross(to, hinge.a) > 0) == (cross(to, hinge.b) > 0)) continue;
    bends.push_back({share, way, cross(way, to) > 0 ? -hinge.angle : hinge.angle});
  }
  std::sort(bends.begin(), bends.end(), [](const Bend& x, const Bend& y) { return x.share < y.share; });
  const Vector3d flat(to.x(), to.y(), 0);
  Vector3d at = Vector3d::Zero();
  Matrix3d frame = Matrix3d::Identity();
  double before = 0;
  for (const Bend& bend : bends) {
    at += frame * ((bend.share - before) * flat);
    frame = frame * turn_about(bend.about, bend.angle);
    before = bend.share;
  }
  bent = bent || !bends.empty();
  return at + frame * ((1 - before) * flat);
}

double signed_fold(double angle, design::Facing to) {
  return std::clamp(angle, 0.0, kLargestFold) * (to == design::Facing::back ? 1 : -1);
}

/// A particle on a part of an edge or line, and where it lies in the panel.
struct OnPart {
  Index particle;
  design::Point2 at;
};

/// In the order in which the border walks the part.
std::vector<OnPart> particles_on(const design::EdgePart& part, const std::vector<BorderPanel>& outlines, const Borders& borders,
                                 const std::vector<MeshedPanel>& panels, const model::Model& model) {
  std::vector<OnPart> particles;
  for (int v : vertices_on(part, outlines[part.panel], borders.panels[part.panel])) {
    const Index vertex = panels[part.panel].first_vertex + v, particle = model.vertex_particle[vertex];
    if (particles.empty() || particles.back().particle != particle) particles.push_back({particle, model.vertex_uv[vertex]});
  }
  return particles;
}

/// What later flat irons leave of a fold.
class FlatIrons {
 public:
  FlatIrons(const design::Garment& garment, std::size_t fold, int panel) {
    for (std::size_t k = fold + 1; k < garment.presses.size(); ++k) {
      const design::Press& flat = garment.presses[k];
      if (flat.kind != design::Press::Kind::flat || flat.region < 0) continue;
      for (const design::RegionPart& part : garment.regions[flat.region].parts)
        if (part.panel == panel) flats_.emplace_back(design::RegionTest(garment.panels[panel], part.shape), flat.factor);
    }
  }
  double share_at(const design::Point2& p) const {
    double share = 1;
    for (const auto& [region, factor] : flats_)
      if (region.contains(p)) share *= 1 - std::min(1.0, factor);
    return share;
  }

 private:
  std::vector<std::pair<design::RegionTest, double>> flats_;
};

/// Chains of the particles, a new one wherever another share of the fold is left.
void add_runs(const std::vector<OnPart>& particles, const FoldChain& fold, const FlatIrons& pressed, std::vector<FoldChain>& chains) {
  for (std::size_t k = 0; k + 1 < particles.size();) {
    const double share = pressed.share_at(0.5 * (particles[k].at + particles[k + 1].at));
    FoldChain chain{{particles[k].particle}, fold.angle * share, fold.goes_on, fold.turned_over};
    for (; k + 1 < particles.size() && pressed.share_at(0.5 * (particles[k].at + particles[k + 1].at)) == share; ++k)
      chain.particle.push_back(particles[k + 1].particle);
    if (chain.angle != 0) chains.push_back(std::move(chain));
  }
}

/// True where the part walks its panel's outline counter-clockwise.
bool with_loop(const design::Garment& garment, const design::EdgePart& part) {
  double area = 0;
  for (const design::Edge& edge : garment.panels[part.panel].edges) area += edge.curve.area_term();
  return (part.from < part.to) == (area > 0);
}

/// Panels of the seam that lie face down where its side `base` lies face up.
std::vector<Index> turned_over(const design::Garment& garment, const design::Seam& seam, std::size_t base) {
  std::vector<Index> panels;
  const std::vector<design::EdgePart>& own = seam.sides[base].parts;
  if (own.empty() || own[0].on != design::EdgePart::On::outline) return panels;
  for (std::size_t k = 0; k < seam.sides.size(); ++k)
    for (const design::EdgePart& part : seam.sides[k].parts)
      if (k != base && part.on == design::EdgePart::On::outline && with_loop(garment, part) == with_loop(garment, own[0]))
        panels.push_back(part.panel);
  return panels;
}

/// The same of the seams that sew the edge of a part.
std::vector<Index> turned_over(const design::Garment& garment, const design::EdgePart& edge) {
  std::vector<Index> panels;
  for (const design::Seam& seam : garment.seams)
    for (std::size_t k = 0; k < seam.sides.size(); ++k)
      for (const design::EdgePart& part : seam.sides[k].parts) {
        if (part.panel != edge.panel || part.on != edge.on || part.edge != edge.edge) continue;
        const std::vector<Index> more = turned_over(garment, seam, k);
        panels.insert(panels.end(), more.begin(), more.end());
      }
  return panels;
}

/// Folds of one place add up, as far as cloth can be folded: chains are cut where another share of theirs is left.
void clamp_sums(std::vector<FoldChain>& chains) {
  auto link = [](const FoldChain& chain, std::size_t k) { return std::minmax(chain.particle[k], chain.particle[k + 1]); };
  std::map<std::pair<Index, Index>, double> sum;
  for (const FoldChain& chain : chains)
    for (std::size_t k = 0; k + 1 < chain.particle.size(); ++k) sum[link(chain, k)] += chain.angle;
  auto share = [&](const FoldChain& chain, std::size_t k) {
    const double total = std::abs(sum[link(chain, k)]);
    return total > kLargestFold ? kLargestFold / total : 1;
  };
  std::vector<FoldChain> result;
  for (FoldChain& chain : chains) {
    bool whole = true;
    for (std::size_t k = 0; k + 1 < chain.particle.size(); ++k) whole = whole && share(chain, k) == 1;
    if (whole) {
      result.push_back(std::move(chain));
      continue;
    }
    for (std::size_t k = 0; k + 1 < chain.particle.size();) {
      const double left = share(chain, k);
      FoldChain part{{chain.particle[k]}, chain.angle * left, chain.goes_on, chain.turned_over};
      for (; k + 1 < chain.particle.size() && share(chain, k) == left; ++k) part.particle.push_back(chain.particle[k + 1]);
      result.push_back(std::move(part));
    }
  }
  chains = std::move(result);
}

/// 1 where the chart shows the face of the chain's first side, -1 where it shows its back.
int face_of(const Chart& chart, const FoldChain& chain, const model::Model& model) {
  if (chart.fan.empty()) return 1;
  const FanTriangle& first = chart.fan[0];
  const Index panel = model.triangle_panel[first.triangle];
  const bool over = std::find(chain.turned_over.begin(), chain.turned_over.end(), panel) != chain.turned_over.end();
  return (first.here == (first.centre + 1) % 3) != over ? 1 : -1;
}

}  // namespace

bool folds_as_one(const design::Seam& seam) {
  if (seam.sides.size() != 2 || seam.finish.lap > 0 || seam.finish.slack > 0) return false;
  for (const design::SeamSide& side : seam.sides)
    for (const design::EdgePart& part : side.parts)
      if (part.on == design::EdgePart::On::line) return false;
  return true;
}

bool follows_fold(const design::Press& press, const design::Panel& panel, const design::EdgePart& part, double h) {
  constexpr double kNarrow = 1.5;     // of the grid
  constexpr double kMostSlant = 0.17; // sine of the angle between line and thread
  if (press.kind != design::Press::Kind::fold) return false;
  if (press.radius * press.angle < kNarrow * h) return true;
  const geometry::Curve& curve = design::edge_of(panel, part).curve;
  const Vector2d warp(-portable::sin(panel.grain_angle), portable::cos(panel.grain_angle));
  for (int k = 0; k <= 8; ++k) {
    const Vector2d way = curve.tangent_at(part.from + k / 8.0 * (part.to - part.from));
    if (std::min(std::abs(way.dot(warp)), std::abs(cross(way, warp))) > kMostSlant) return true;
  }
  return false;
}

std::vector<FoldChain> fold_chains(const design::Garment& garment, const std::vector<BorderPanel>& outlines,
                                   const Borders& borders, const std::vector<MeshedPanel>& panels,
                                   const model::Model& model) {
  std::vector<FoldChain> chains;
  for (const design::Seam& seam : garment.seams) {
    double angle = seam.finish.fold_angle ? signed_fold(*seam.finish.fold_angle, seam.finish.fold_to) : 0;
    if (seam.finish.turned) angle = signed_fold(portable::kPi, design::Facing::back);
    if (angle == 0 || !folds_as_one(seam)) continue;  // told as not modelled
    for (const model::SeamChain& chain : model.seams)
      if (chain.name == seam.name) chains.push_back({chain.particles, angle, true, turned_over(garment, seam, 0)});
  }
  for (std::size_t k = 0; k < garment.presses.size(); ++k) {
    const design::Press& press = garment.presses[k];
    if (press.kind != design::Press::Kind::fold) continue;
    const double angle = signed_fold(press.angle * press.set * press.factor, press.to);
    for (const design::EdgePart& part : press.line) {
      const bool line = part.on == design::EdgePart::On::line;
      if (line && !follows_fold(press, garment.panels[part.panel], part, outlines[part.panel].h)) continue;
      const double length = design::edge_of(garment.panels[part.panel], part).curve.length();
      const bool whole_edge = !line && std::abs(part.to - part.from) > length - kSameLength;  // it goes on into the next edge's seam
      const FlatIrons pressed(garment, k, part.panel);
      add_runs(particles_on(part, outlines, borders, panels, model), {{}, angle, whole_edge, turned_over(garment, part)}, pressed, chains);
    }
  }
  for (std::size_t p = 0; p < panels.size(); ++p) {
    const std::vector<LaidPleat> pleats = laid_pleats(garment.panels[p]);
    const Border& border = borders.panels[p];
    for (std::size_t k = 0; k < outlines[p].outline.lines.size(); ++k) {
      const InnerLine& line = outlines[p].outline.lines[k];
      if (line.pleat < 0 || !garment.panels[p].pleats[pleats[line.pleat].pleat].ironed) continue;
      for (const LaidPleat::Fold& fold : pleats[line.pleat].folds) {
        if (!same_place(fold.at, line.at)) continue;
        FoldChain chain;
        chain.angle = kPleatSet * portable::kPi * fold.to;
        for (int v = border.loops[border.n_closed + k]; v < border.end_of(border.n_closed + k); ++v)
          chain.particle.push_back(model.vertex_particle[panels[p].first_vertex + v]);
        chains.push_back(std::move(chain));
      }
    }
  }
  clamp_sums(chains);
  return chains;
}

Folds::Folds(std::vector<FoldChain> chains, std::size_t n_particles) : chains_(std::move(chains)), links_(n_particles) {
  for (std::size_t c = 0; c < chains_.size(); ++c)
    for (std::size_t k = 0; k < chains_[c].particle.size(); ++k)
      links_[chains_[c].particle[k]].push_back({static_cast<Index>(c), static_cast<Index>(k)});
}

std::vector<Vector3d> Folds::rest_places(const Chart& chart, Index centre, const model::Model& model) const {
  struct Seen {
    Link link;
    Vector2d at;
  };
  std::vector<Seen> seen;
  for (const Link& link : links_[centre]) seen.push_back({link, Vector2d(0, 0)});
  for (const Chart::Point& p : chart.points)
    for (const Link& link : links_[p.particle]) seen.push_back({link, p.at});
  if (seen.empty()) return {};
  std::sort(seen.begin(), seen.end(), [](const Seen& a, const Seen& b) {
    return a.link.chain != b.link.chain ? a.link.chain < b.link.chain : a.link.place < b.link.place;
  });
  std::vector<Hinge> hinges;
  for (std::size_t begin = 0, end = 0; begin < seen.size(); begin = end) {
    while (end < seen.size() && seen[end].link.chain == seen[begin].link.chain) ++end;
    const FoldChain& chain = chains_[seen[begin].link.chain];
    const double angle = face_of(chart, chain, model) * chain.angle;
    const auto last = static_cast<Index>(chain.particle.size()) - 1;
    const auto here = std::find_if(links_[centre].begin(), links_[centre].end(),
                                   [&](const Link& l) { return l.chain == seen[begin].link.chain; });
    if (here != links_[centre].end()) {
      const bool at_end = here->place == 0 || here->place == last;
      const bool ring = chain.particle.front() == chain.particle.back();
      if (at_end && !ring && !chain.goes_on) continue;
      Vector2d way(0, 0);
      for (std::size_t k = begin; k < end; ++k) {
        if (seen[k].link.place == here->place + 1 || (ring && here->place == last && seen[k].link.place == 1)) way += seen[k].at;
        if (seen[k].link.place == here->place - 1 || (ring && here->place == 0 && seen[k].link.place == last - 1)) way -= seen[k].at;
      }
      if (way.norm() > 0) hinges.push_back({Vector2d(0, 0), way, angle, true});
      continue;
    }
    for (std::size_t k = begin; k + 1 < end; ++k) {
      if (seen[k + 1].link.place != seen[k].link.place + 1) continue;
      Hinge hinge{seen[k].at, seen[k + 1].at, angle, false};
      const Vector2d way = hinge.b - hinge.a;
      if (!(way.norm() > 0)) continue;
      const bool first_seen = k == begin || seen[k - 1].link.place + 1 != seen[k].link.place;
      const bool last_seen = k + 2 == end || seen[k + 2].link.place != seen[k + 1].link.place + 1;
      if (first_seen && (seen[k].link.place > 0 || chain.goes_on)) hinge.a -= kFar * way;
      if (last_seen && (seen[k + 1].link.place < last || chain.goes_on)) hinge.b += kFar * way;
      hinges.push_back(hinge);
    }
  }
  bool bent = false;
  std::vector<Vector3d> places;
  for (const Chart::Point& p : chart.points) places.push_back(carry(p.at, hinges, bent));
  places.push_back(Vector3d::Zero());
  return bent ? places : std::vector<Vector3d>{};
}

}  // namespace garment::modeller
