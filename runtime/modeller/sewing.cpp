#include "runtime/modeller/sewing.hpp"

namespace garment::modeller {
namespace {

using model::Index;

class Merger {
 public:
  explicit Merger(std::size_t n) : parent_(n) {
    for (std::size_t i = 0; i < n; ++i) parent_[i] = static_cast<Index>(i);
  }
  Index root(Index i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void merge(Index a, Index b) {
    a = root(a);
    b = root(b);
    if (a < b) parent_[b] = a;
    if (b < a) parent_[a] = b;
  }

 private:
  std::vector<Index> parent_;
};

/// Vertex k of a stretch, walked forward or backward. Its end may be the first vertex of its loop.
struct Walk {
  int first, count, loop_begin, loop_end;
  bool forward;
  Index base;
  Index operator[](int k) const {
    const int v = first + (forward ? k : count - k);
    return base + (v < loop_end ? v : loop_begin);
  }
};

}  // namespace

std::vector<Index> sew(const std::vector<Matching>& matchings, const Matched& matched, const Borders& borders,
                       const std::vector<Index>& first_vertex, std::size_t n_vertices, model::Model& model,
                       std::vector<SewnSides>& sides) {
  Merger merger(n_vertices);
  auto walk = [&](int s, bool forward) {
    const Stretch& stretch = matched.stretches[s];
    const Border& border = borders.panels[stretch.panel];
    const auto loop = static_cast<std::size_t>(borders.stretch_loop[s]);
    return Walk{borders.stretch_first[s],
                borders.stretch_count[s],
                border.loops[loop],
                border.end_of(loop),
                forward,
                first_vertex[stretch.panel]};
  };
  for (std::size_t p = 0; p < borders.panels.size(); ++p) {
    const std::vector<int>& same = borders.panels[p].same;
    for (std::size_t v = 0; v < same.size(); ++v) merger.merge(first_vertex[p] + static_cast<Index>(v), first_vertex[p] + same[v]);
  }
  std::vector<std::vector<Index>> chains(matchings.size());
  for (std::size_t m = 0; m < matchings.size(); ++m) {
    const std::vector<StretchTuple>& tuples = matched.tuples[m];
    if (matchings[m].tied() || matchings[m].tension != 0 || matchings[m].rings) {
      SewnSides sewn{&matchings[m], std::vector<std::vector<Index>>(matchings[m].sides.size())};
      for (const StretchTuple& tuple : tuples) {
        bool on = true;  // all sides go on from where they were: not over a dart, not on another panel
        for (std::size_t s = 0; s < tuple.stretch.size(); ++s)
          on = on && !sewn.side[s].empty() && sewn.side[s].back() == walk(tuple.stretch[s], tuple.forward[s])[0];
        for (std::size_t s = 0; s < tuple.stretch.size(); ++s) {
          const Walk along = walk(tuple.stretch[s], tuple.forward[s]);
          for (int k = on ? 1 : 0; k <= along.count; ++k) sewn.side[s].push_back(along[k]);
        }
      }
      sides.push_back(std::move(sewn));
    }
    if (!matchings[m].merge) continue;
    std::vector<Index> ends;  // of the tuple before, one per side: the links of a chain meet
    for (const StretchTuple& tuple : tuples) {
      Walk first = walk(tuple.stretch[0], tuple.forward[0]);
      for (std::size_t s = 0; s < tuple.stretch.size(); ++s) {
        Walk other = walk(tuple.stretch[s], tuple.forward[s]);
        for (int k = 0; k <= first.count; ++k) merger.merge(first[k], other[k]);
        if (!ends.empty()) merger.merge(ends[s], other[0]);
      }
      ends.clear();
      for (std::size_t s = 0; s < tuple.stretch.size(); ++s) {
        Walk other = walk(tuple.stretch[s], tuple.forward[s]);
        ends.push_back(other[other.count]);
      }
      for (int k = chains[m].empty() ? 0 : 1; k <= first.count; ++k) chains[m].push_back(first[k]);
    }
  }
  std::vector<Index> particle(n_vertices, -1);
  Index n = 0;
  for (std::size_t v = 0; v < n_vertices; ++v) {
    Index root = merger.root(static_cast<Index>(v));
    if (particle[root] < 0) particle[root] = n++;  // the root is the least vertex of its class
    particle[v] = particle[root];
  }
  for (std::size_t m = 0; m < matchings.size(); ++m) {
    if (!matchings[m].report) continue;
    model::SeamChain chain{matchings[m].name, matchings[m].origin, {}, 0};
    for (const SideSegment& segment : matchings[m].sides[0].segments) chain.length += segment.length();
    for (Index v : chains[m]) chain.particles.push_back(particle[v]);
    model.seams.push_back(std::move(chain));
  }
  return particle;
}

}  // namespace garment::modeller
