// Twisted garments: panels are walked over the seams, face up; where a walk comes back face down, the sewn
// surface has one side only, as a Moebius strip has.
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "interpreter/language/edges.hpp"
#include "interpreter/language/seam_rings.hpp"

namespace garment::interpreter {
namespace {

using design::EdgePart;
using design::Point2;

constexpr double kLeastContact = 2e-3;  // m of common seam that count

/// Panels known to lie face to the same side as their root, or to the other.
class Faces {
 public:
  explicit Faces(std::size_t n) : parent_(n), flip_(n, 0) {
    for (std::size_t k = 0; k < n; ++k) parent_[k] = k;
  }
  std::pair<std::size_t, bool> root(std::size_t k) const {
    bool flip = false;
    while (parent_[k] != k) flip = flip != (flip_[k] != 0), k = parent_[k];
    return {k, flip};
  }
  /// False where the two are known to lie otherwise.
  bool join(std::size_t a, std::size_t b, bool flipped) {
    const auto [ra, fa] = root(a);
    const auto [rb, fb] = root(b);
    const bool flip = (fa != fb) != flipped;
    if (ra == rb) return !flip;
    parent_[std::max(ra, rb)] = std::min(ra, rb);
    flip_[std::max(ra, rb)] = flip;
    return true;
  }

 private:
  std::vector<std::size_t> parent_;
  std::vector<char> flip_;
};

/// Two panels that lie along a seam, and whether both walk it the same way round their loops.
struct Contact {
  std::size_t seam;
  int panels[2];
  bool flipped;
};

bool with_loop(const Program& program, const EdgePart& part) {
  return (part.to >= part.from) == program.panels[static_cast<std::size_t>(part.panel)].counter_clockwise;
}

void add_contacts(const Program& program, std::size_t index, std::vector<Contact>& contacts) {
  const design::Seam& seam = program.seams[index].seam;
  const std::vector<EdgePart>*a = &seam.sides[0].parts, *b = &seam.sides[1].parts;
  auto total = [&](const std::vector<EdgePart>& parts) {
    double sum = 0;
    for (const EdgePart& part : parts) sum += sewn_length(program, part);
    return sum;
  };
  const double length_a = total(*a), length_b = total(*b);
  if (!(length_a > 0) || !(length_b > 0)) return;
  double done_a = 0, done_b = 0;  // as fractions
  for (std::size_t i = 0, j = 0; i < a->size() && j < b->size();) {
    const double end_a = done_a + sewn_length(program, (*a)[i]) / length_a;
    const double end_b = done_b + sewn_length(program, (*b)[j]) / length_b;
    if ((std::min(end_a, end_b) - std::max(done_a, done_b)) * length_a > kLeastContact)
      contacts.push_back({index,
                          {(*a)[i].panel, (*b)[j].panel},
                          with_loop(program, (*a)[i]) == with_loop(program, (*b)[j])});
    if (end_a <= end_b) done_a = end_a, ++i;
    if (end_b <= end_a) done_b = end_b, ++j;
  }
}

/// A seam of two sides along outlines, none of it sewn by another seam: there the cloth is a surface.
bool is_surface(const SeamInfo& info, const std::map<std::tuple<int, int>, std::vector<std::size_t>>& users) {
  if (!info.ready || info.seam.sides.size() != 2) return false;
  for (const design::SeamSide& side : info.seam.sides)
    for (const EdgePart& part : side.parts)
      if (part.on != EdgePart::On::outline || users.at({part.panel, part.edge}).size() > 1) return false;
  return true;
}

std::string place_text(const Program& program, const EdgePart& part, bool at_end) {
  const design::Panel& panel = program.panels[static_cast<std::size_t>(part.panel)].panel;
  const Point2 p = design::edge_of(panel, part).curve.point_at(at_end ? part.to : part.from);
  return panel.name + " (" + format_quantity(p.x(), kLength) + ", " + format_quantity(p.y(), kLength) + ")";
}

std::string run_text(const Program& program, const std::vector<EdgePart>& parts) {
  return "from " + place_text(program, parts.front(), false) + " to " +
         place_text(program, parts.back(), true);
}

void report_twist(Program& program, const Contact& contact) {
  const SeamInfo& info = program.seams[contact.seam];
  const std::string one = program.panels[static_cast<std::size_t>(contact.panels[0])].panel.name,
                    two = program.panels[static_cast<std::size_t>(contact.panels[1])].panel.name;
  const std::string where = one == two ? "`" + one + "`" : "`" + one + "` and `" + two + "`";
  report(program,
         Message("G0510",
                 "seam `" + info.seam.name + "` twists the garment: it turns the face of " + where +
                     " to the back, where " + (one == two ? "the panel's own cloth keeps it out" : "other seams keep it out"),
                 info.spans[1], run_text(program, info.seam.sides[1].parts))
             .also(info.spans[0], "meets it " + run_text(program, info.seam.sides[0].parts))
             .help("join the other ends: leave out `reversed`, or reverse every seam between these panels"));
}

}  // namespace

void check_twists(Program& program) {
  std::map<std::tuple<int, int>, std::vector<std::size_t>> users;
  for (std::size_t s = 0; s < program.seams.size(); ++s)
    for (const design::SeamSide& side : program.seams[s].seam.sides)
      for (const EdgePart& part : side.parts) {
        if (part.on != EdgePart::On::outline) continue;
        std::vector<std::size_t>& list = users[{part.panel, part.edge}];
        // Parts of one edge may be sewn by several seams; that is a surface as long as they do not overlap.
        bool overlaps = list.empty();
        for (std::size_t other : list)
          for (const design::SeamSide& theirs : program.seams[other].seam.sides)
            for (const EdgePart& q : theirs.parts)
              overlaps = overlaps ||
                         (q.panel == part.panel && q.edge == part.edge && q.on == part.on && other != s &&
                          std::min(std::max(q.from, q.to), std::max(part.from, part.to)) -
                                  std::max(std::min(q.from, q.to), std::min(part.from, part.to)) >
                              kLeastContact);
        if (overlaps && (list.empty() || list.back() != s)) list.push_back(s);
      }
  std::vector<Contact> contacts;
  for (std::size_t s = 0; s < program.seams.size(); ++s)
    if (is_surface(program.seams[s], users)) add_contacts(program, s, contacts);
  // Seams that follow the rule first: a contradiction is then found at one that says `reversed`.
  std::stable_sort(contacts.begin(), contacts.end(),
                   [](const Contact& a, const Contact& b) { return a.flipped < b.flipped; });
  Faces faces(program.panels.size());
  std::vector<char> said(program.seams.size(), 0);
  for (const Contact& contact : contacts) {
    if (faces.join(static_cast<std::size_t>(contact.panels[0]), static_cast<std::size_t>(contact.panels[1]),
                   contact.flipped) ||
        said[contact.seam])
      continue;
    said[contact.seam] = 1;
    report_twist(program, contact);
  }
}

}  // namespace garment::interpreter
