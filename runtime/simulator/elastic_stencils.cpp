#include "runtime/simulator/elastic_stencils.hpp"

#include <algorithm>
#include <numeric>
#include <span>

#include "runtime/base/portable_math.hpp"

namespace garment::simulator {
namespace {

constexpr std::size_t kChunkParticles = 512;  // some 0.1 ms of work

/// Calls `visit(particles)` for every stencil: kind by kind, in the order of the Model.
template <class Visit>
void for_each_stencil(const model::Model& m, const Visit& visit) {
  for (const auto& s : m.spring) visit(std::span<const Index>(s));
  for (const auto& s : m.cell) visit(std::span<const Index>(s));
  for (const auto& s : m.membrane) visit(std::span<const Index>(s));
  for (const auto& s : m.bend) visit(std::span<const Index>(s));
  for (std::size_t k = 0; k + 1 < m.fit_begin.size(); ++k)
    visit(
        std::span<const Index>(m.fit_particle).subspan(m.fit_begin[k], m.fit_begin[k + 1] - m.fit_begin[k]));
  for (const auto& s : m.tie) visit(std::span<const Index>(s));
}

BlockPattern make_pattern(const model::Model& m) {
  std::vector<Indices<2>> pairs;
  for_each_stencil(m, [&](std::span<const Index> s) {
    for (std::size_t a = 0; a < s.size(); ++a)
      for (std::size_t b = a + 1; b < s.size(); ++b)
        if (s[a] != s[b]) pairs.push_back({std::min(s[a], s[b]), std::max(s[a], s[b])});
  });
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return BlockPattern::from_pairs(m.n_particles(), std::move(pairs));
}

/// Rank of every particle in a walk in breadth from neighbour to neighbour. Consecutive ranks are near one
/// another whatever numbering the modeller chose, so that a range of them meets few other ranges.
std::vector<std::size_t> breadth_first_rank(const BlockPattern& pattern) {
  const std::size_t n = pattern.n_rows();
  std::vector<std::size_t> rank(n, n), queue;
  queue.reserve(n);
  for (std::size_t start = 0; start < n; ++start) {
    if (rank[start] != n) continue;
    rank[start] = queue.size();
    queue.push_back(start);
    for (std::size_t head = rank[start]; head < queue.size(); ++head) {
      const std::size_t i = queue[head];
      for (Index k = pattern.row_begin[i]; k < pattern.row_begin[i + 1]; ++k) {
        const auto j = static_cast<std::size_t>(pattern.column[k]);
        if (rank[j] != n) continue;
        rank[j] = queue.size();
        queue.push_back(j);
      }
    }
  }
  return rank;
}

/// The order in which to store `n` stencils of one kind so that chunks are contiguous, and where each chunk
/// lies.
struct ChunkOrder {
  std::vector<std::size_t> order;
  std::vector<Chunk::Range> range;
};

template <class ChunkOf>
ChunkOrder chunk_order(std::size_t n, std::size_t n_chunks, const ChunkOf& chunk_of) {
  ChunkOrder result;
  result.order.resize(n);
  std::iota(result.order.begin(), result.order.end(), std::size_t{0});
  std::vector<std::size_t> chunk(n);
  for (std::size_t k = 0; k < n; ++k) chunk[k] = chunk_of(k);
  std::stable_sort(result.order.begin(), result.order.end(),
                   [&](std::size_t a, std::size_t b) { return chunk[a] < chunk[b]; });
  result.range.resize(n_chunks);
  std::size_t at = 0;
  for (std::size_t c = 0; c < n_chunks; ++c) {
    result.range[c].begin = at;
    while (at < n && chunk[result.order[at]] == c) ++at;
    result.range[c].end = at;
  }
  return result;
}

/// Greedy colouring, in the order of the chunks, of "touches a common particle".
std::vector<std::vector<std::size_t>> color_chunks(const std::vector<std::vector<Index>>& touched,
                                                   std::size_t n_particles) {
  std::vector<std::vector<std::size_t>> chunks_at(n_particles), colors;
  for (std::size_t c = 0; c < touched.size(); ++c)
    for (Index p : touched[c]) chunks_at[p].push_back(c);
  constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  std::vector<std::size_t> color(touched.size(), kNone);
  for (std::size_t c = 0; c < touched.size(); ++c) {
    std::vector<bool> taken(colors.size() + 1, false);
    for (Index p : touched[c])
      for (std::size_t other : chunks_at[p])
        if (color[other] != kNone) taken[color[other]] = true;
    color[c] = static_cast<std::size_t>(std::find(taken.begin(), taken.end(), false) - taken.begin());
    if (color[c] == colors.size()) colors.emplace_back();
    colors[color[c]].push_back(c);
  }
  return colors;
}

/// Fills an ElasticStencils from a Model.
class Builder {
 public:
  Builder(const model::Model& m, ElasticStencils& out) : m_(m), out_(out) {}

  void build() {
    out_.n_particles = m_.n_particles();
    for (const model::TensileLaw& law : m_.laws) out_.laws.emplace_back(law);
    auto pattern = std::make_shared<BlockPattern>(make_pattern(m_));
    out_.pattern = pattern;
    rank_ = breadth_first_rank(*pattern);
    n_chunks_ = (out_.n_particles + kChunkParticles - 1) / kChunkParticles;
    out_.chunks.resize(n_chunks_);
    touched_.resize(n_chunks_);
    constant_.assign(pattern->n_blocks(), 0.0);
    add_springs();
    add_cells();
    add_membranes();
    add_bends();
    add_fits();
    add_ties();
    for (auto& t : touched_) {
      std::sort(t.begin(), t.end());
      t.erase(std::unique(t.begin(), t.end()), t.end());
    }
    out_.colors = color_chunks(touched_, out_.n_particles);
    out_.constant.assign(constant_.begin(), constant_.end());
    for (std::size_t i = 0; i < out_.n_particles; ++i) {
      auto begin = pattern->column.begin() + pattern->row_begin[i],
           end = pattern->column.begin() + pattern->row_begin[i + 1];
      out_.upper_begin.push_back(
          static_cast<Index>(std::upper_bound(begin, end, static_cast<Index>(i)) - pattern->column.begin()));
    }
  }

 private:
  /// Sorts the stencils of one kind into the chunks of their first particle (by rank), tells the chunks their
  /// range and their particles, and calls `add(k)` in the new order.
  template <class Particles, class Add>
  void sort_kind(std::size_t n, Chunk::Range Chunk::*range, const Particles& particles, const Add& add) {
    const ChunkOrder sorted = chunk_order(n, n_chunks_, [&](std::size_t k) {
      std::size_t first = out_.n_particles;
      for (Index p : particles(k)) first = std::min(first, rank_[p]);
      return std::min(first / kChunkParticles, n_chunks_ - 1);
    });
    for (std::size_t c = 0; c < n_chunks_; ++c) {
      out_.chunks[c].*range = sorted.range[c];
      for (std::size_t at = sorted.range[c].begin; at < sorted.range[c].end; ++at)
        for (Index p : particles(sorted.order[at])) touched_[c].push_back(p);
    }
    for (std::size_t k : sorted.order) add(k);
  }

  BlockPlace place(Index a, Index b) const {
    if (a == b) return {};
    const Index position = out_.pattern->find(std::min(a, b), std::max(a, b));
    return {2 * position + (a > b ? 1 : 0)};
  }
  void add_constant(Index a, Index b, double value) {
    if (a != b) constant_[place(a, b).position()] += value;
  }
  std::array<BlockPlace, 3> places(const Indices<3>& p) const {
    return {place(p[0], p[1]), place(p[0], p[2]), place(p[1], p[2])};
  }

  void add_springs() {
    sort_kind(
        m_.spring.size(), &Chunk::springs,
        [&](std::size_t k) { return std::span<const Index>(m_.spring[k]); },
        [&](std::size_t k) {
          const auto& p = m_.spring[k];
          out_.springs.push_back({p, m_.spring_law[k], place(p[0], p[1]), m_.spring_rest[k],
                                  1 / m_.spring_rest[k], m_.spring_width[k]});
        });
  }

  void add_cells() {
    std::vector<Index> twisted(m_.cell.size(), -1);
    for (std::size_t t = 0; t < m_.twist_cell.size(); ++t) {
      const Index c = m_.twist_cell[t];
      twisted[c] = static_cast<Index>(t);
      out_.twisted.push_back({m_.cell[c], m_.twist_rest[t] * m_.cell_size[c][0] * m_.cell_size[c][1]});
    }
    sort_kind(
        m_.cell.size(), &Chunk::cells, [&](std::size_t k) { return std::span<const Index>(m_.cell[k]); },
        [&](std::size_t k) {
          const auto& p = m_.cell[k];
          const double area = m_.cell_size[k][0] * m_.cell_size[k][1], twist = 4 * m_.cell_twist[k] / area;
          out_.cells.push_back({p,
                                {place(p[0], p[1]), place(p[0], p[2]), place(p[0], p[3]), place(p[1], p[2]),
                                 place(p[1], p[3]), place(p[2], p[3])},
                                m_.cell_shear[k] * area / 4,
                                twist,
                                twisted[k]});
          constexpr double kSign[4] = {1, -1, 1, -1};
          for (int a = 0; a < 4; ++a)
            for (int b = a + 1; b < 4; ++b) add_constant(p[a], p[b], kSign[a] * kSign[b] * twist);
        });
  }

  void add_membranes() {
    sort_kind(
        m_.membrane.size(), &Chunk::membranes,
        [&](std::size_t k) { return std::span<const Index>(m_.membrane[k]); },
        [&](std::size_t k) {
          out_.membranes.push_back({m_.membrane[k], m_.membrane_law[k], places(m_.membrane[k]),
                                    m_.membrane_weights[k], m_.membrane_area[k], m_.membrane_shear[k]});
        });
  }

  void add_bends() {
    std::vector<Index> crease(m_.bend.size(), -1);
    for (std::size_t c = 0; c < m_.crease_bend.size(); ++c) {
      const auto& p = m_.bend[m_.crease_bend[c]];
      crease[m_.crease_bend[c]] = static_cast<Index>(c);
      out_.creases.push_back({m_.crease_axis[c],
                              {p[0], p[1]},
                              portable::sin(m_.crease_angle[c]),
                              portable::cos(m_.crease_angle[c]),
                              Eigen::Matrix3d::Identity()});
    }
    sort_kind(
        m_.bend.size(), &Chunk::bends, [&](std::size_t k) { return std::span<const Index>(m_.bend[k]); },
        [&](std::size_t k) {
          const double hbar = 0.5 * (m_.bend_lengths[k][0] + m_.bend_lengths[k][1]);
          out_.bends.push_back(
              {m_.bend[k], places(m_.bend[k]), m_.bend_width[k] * m_.bend_rigidity[k] / hbar, crease[k]});
        });
  }

  std::span<const Index> fit_particles(std::size_t k) const {
    return std::span<const Index>(m_.fit_particle)
        .subspan(m_.fit_begin[k], m_.fit_begin[k + 1] - m_.fit_begin[k]);
  }

  void add_fits() {
    const std::size_t n = m_.fit_begin.empty() ? 0 : m_.fit_begin.size() - 1;
    fold_of_.assign(n, -1);
    for (std::size_t f = 0; f < m_.fold_fit.size(); ++f) fold_of_[m_.fold_fit[f]] = static_cast<Index>(f);
    sort_kind(
        n, &Chunk::fits, [&](std::size_t k) { return fit_particles(k); }, [&](std::size_t k) { add_fit(k); });
  }

  void add_fit(std::size_t k) {
    const auto& d = m_.fit_rigidity[k];
    Eigen::Matrix3d rigidity;
    rigidity << d[0], d[3], d[4], d[3], d[1], d[5], d[4], d[5], d[2];
    rigidity *= m_.fit_area[k];
    const std::span<const Index> p = fit_particles(k);
    const std::size_t begin = out_.fit_particle.size();
    out_.fits.push_back({begin, begin + p.size(), rigidity});
    if (fold_of_[k] >= 0) add_fold(static_cast<std::size_t>(fold_of_[k]), k);
    const Eigen::Vector3d* w = m_.fit_weight.data() + m_.fit_begin[k];
    for (std::size_t a = 0; a < p.size(); ++a) {
      out_.fit_particle.push_back(p[a]);
      out_.fit_weight.push_back(w[a]);
      for (std::size_t b = a + 1; b < p.size(); ++b) add_constant(p[a], p[b], w[a].dot(rigidity * w[b]));
    }
  }

  /// The fold of the fit that was added last. It turns with the cloth on this side of it, z = 0: turned with both sides, a
  /// fold by half a turn would hardly feel being opened, and could not tell face from back.
  void add_fold(std::size_t f, std::size_t k) {
    FitStencil& fit = out_.fits.back();
    fit.fold = static_cast<Index>(out_.folds.size());
    const Eigen::Vector3d *place = m_.fold_place.data() + m_.fold_begin[f], *w = m_.fit_weight.data() + m_.fit_begin[k];
    const std::span<const Index> particle = fit_particles(k);
    const std::size_t begin = out_.fold_frames.size();
    Fold fold{begin, begin, Eigen::Matrix3d::Zero()};
    for (std::size_t j = 0; j < particle.size(); ++j) fold.rest += (place[j] - place[0]) * w[j].transpose();
    for (bool whole : {false, true}) {  // of a narrow sector: with all of it
      out_.fold_frames.resize(begin);
      for (std::size_t j = 0; j < particle.size(); ++j)
        if (whole || place[j].z() == 0) out_.fold_frames.push_back({particle[j], place[j]});
      if (centre(begin)) break;
    }
    fold.end = out_.fold_frames.size();
    out_.folds.push_back(fold);
  }

  /// Moves the places from `begin` on to their middle; false where they lie on a line.
  bool centre(std::size_t begin) {
    const auto n = static_cast<double>(out_.fold_frames.size() - begin);
    if (n < 3) return false;
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (std::size_t j = begin; j < out_.fold_frames.size(); ++j) middle += out_.fold_frames[j].place / n;
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (std::size_t j = begin; j < out_.fold_frames.size(); ++j) {
      Eigen::Vector3d& p = out_.fold_frames[j].place;
      p -= middle;
      spread += p * p.transpose();
    }
    // The sum of the products of two eigenvalues against the square of their sum.
    const double trace = spread.trace(), pairs = 0.5 * (trace * trace - (spread * spread).trace());
    return pairs > 1e-3 * trace * trace;
  }

  void add_ties() {
    sort_kind(
        m_.tie.size(), &Chunk::ties, [&](std::size_t k) { return std::span<const Index>(m_.tie[k]); },
        [&](std::size_t k) { out_.ties.push_back(tie(k)); });
  }

  TieStencil tie(std::size_t k) const {
    TieStencil s;
    s.length = m_.tie_length[k];
    s.stiffness = m_.tie_stiffness[k];
    s.rod = std::binary_search(m_.rod_tie.begin(), m_.rod_tie.end(), static_cast<Index>(k));
    for (std::size_t j = 0; j < 6; ++j) {
      const double c = j < 3 ? -m_.tie_weights[k][j] : m_.tie_weights[k][j];
      const auto end = s.particle.begin() + s.n, same = std::find(s.particle.begin(), end, m_.tie[k][j]);
      if (same == end) s.particle[s.n++] = m_.tie[k][j];
      s.coefficient[same - s.particle.begin()] += c;
    }
    if (s.n == 1) s.n = 0;
    int at = 0;
    for (int a = 0; a < s.n; ++a)
      for (int b = a + 1; b < s.n; ++b) s.place[at++] = place(s.particle[a], s.particle[b]);
    return s;
  }

  const model::Model& m_;
  ElasticStencils& out_;
  std::vector<std::size_t> rank_;
  std::size_t n_chunks_ = 0;
  std::vector<std::vector<Index>> touched_;
  std::vector<double> constant_;
  std::vector<Index> fold_of_;  // of every fit: its fold, or -1
};

}  // namespace

ElasticStencils::ElasticStencils(const model::Model& model) { Builder(model, *this).build(); }

}  // namespace garment::simulator
