#include "runtime/io/pattern_stitch.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <utility>

#include "runtime/base/number.hpp"
#include "runtime/io/pattern_document.hpp"

namespace garment::io {
namespace {

using nlohmann::json;

constexpr int kMaxGather = 10;  ///< largest `gather` of the language

class StitchReader {
 public:
  StitchReader(const std::vector<FilePanel>& panels, PatternReport& report)
      : panels_(panels), report_(report) {
    for (std::size_t i = 0; i < panels.size(); ++i) by_name_[panels[i].file_name] = static_cast<int>(i);
  }

  /// Adds the seam of stitch `number`, if it is one.
  void read(const json& stitch, std::size_t number, std::vector<design::Seam>& seams) {
    where_ = fmt::format("stitch {}", number);
    if (!stitch.is_array() || stitch.size() < 2 || stitch.size() > 3) {
      report_.error(
          "G0943",
          fmt::format("{}: is {}, expected two sides and perhaps \"right_wrong\"", where_, describe(stitch)),
          "[{\"panel\": \"front\", \"edge\": 1}, {\"panel\": \"back\", \"edge\": 3}]");
      return;
    }
    bool right_wrong = stitch.size() == 3;
    if (right_wrong && stitch[2] != "right_wrong") {
      report_.error(
          "G0955",
          fmt::format("{}: its third item is {}, expected \"right_wrong\"", where_, describe(stitch[2])),
          "right_wrong makes start meet start; without it start meets end");
      return;
    }
    auto first = side(stitch[0]), second = side(stitch[1]);
    if (!first || !second) return;
    if (first->panel == second->panel && first->edge == second->edge) {
      report_.warning("G0954", fmt::format("{}: sews {} to itself; the stitch is left out", where_, name_of(*first)),
                      "a stitch joins two different edges");
      return;
    }
    if (!right_wrong) std::swap(second->from, second->to);
    seams.push_back(seam_of(*first, *second));
    if (double ratio = seams.back().ratio[0]; ratio > kMaxGather)
      report_.warning(
          "G0957",
          fmt::format("{}: {} and {} differ in length {} times, a seam can state at most {}", where_,
                      name_of(*first), name_of(*second), format_number(ratio, 4), kMaxGather),
          "are these the edges that are meant?");
    count(*first);
    count(*second);
  }

 private:
  std::string name_of(const design::EdgePart& part) const {
    const FilePanel& p = panels_[part.panel];
    for (std::size_t i = 0; i < p.edges.size(); ++i)
      if (p.edges[i].edge == part.edge) return fmt::format("edge {} of panel {}", i, in_ticks(p.file_name));
    return "an edge";
  }

  /// The whole edge from its start to its end as in the file; nothing, and a finding, where there is none.
  std::optional<design::EdgePart> side(const json& value) {
    const json* panel = member(value, "panel");
    const json* edge = member(value, "edge");
    if (!panel || !panel->is_string() || !edge) {
      report_.error("G0943", fmt::format("{}: a side is {}, expected a `panel` name and an `edge` number",
                                         where_, describe(value)));
      return std::nullopt;
    }
    const std::string& name = panel->get_ref<const std::string&>();
    auto found = by_name_.find(name);
    if (found == by_name_.end()) {
      report_.error("G0953", fmt::format("{}: there is no panel {}", where_, in_ticks(name)),
                    "names in stitches must be keys of `pattern.panels`");
      return std::nullopt;
    }
    const FilePanel& p = panels_[found->second];
    auto index = index_below(*edge, p.edges.size());
    if (!index) {
      report_.error("G0945", fmt::format("{}: edge {} of panel {}, expected a number from 0 to {}", where_,
                                         describe(*edge), in_ticks(name), p.edges.size() - 1));
      return std::nullopt;
    }
    const FileEdge& e = p.edges[*index];
    if (e.edge < 0) {
      report_.warning("G0954", fmt::format("{}: edge {} of panel {} has no length; the stitch is left out",
                                           where_, *index, in_ticks(name)));
      return std::nullopt;
    }
    double length = p.panel.edges[e.edge].curve.length();
    design::EdgePart part{found->second, e.edge, 0, length};
    if (e.turned) std::swap(part.from, part.to);
    return part;
  }

  static design::Seam seam_of(design::EdgePart a, design::EdgePart b) {
    if (std::abs(b.to - b.from) > std::abs(a.to - a.from) + kPlainSeam) std::swap(a, b);
    if (a.from > a.to) {
      std::swap(a.from, a.to);
      std::swap(b.from, b.to);
    }
    design::Seam seam;
    seam.sides = {{{}, {a}, false}, {{}, {b}, false}};
    double length_a = a.to - a.from, length_b = std::abs(b.to - b.from);
    seam.ratio = {length_a > length_b ? stated_ratio(length_a, length_b) : 1.0, 1.0};
    return seam;
  }

  void count(const design::EdgePart& part) {
    if (++uses_[{part.panel, part.edge}] == 2)
      report_.warning("G0956", fmt::format("{}: {} is sewn in more than one stitch", where_, name_of(part)),
                      "all of its partners will be sewn together in one line");
  }

  const std::vector<FilePanel>& panels_;
  PatternReport& report_;
  std::map<std::string, int> by_name_;
  std::map<std::pair<int, int>, int> uses_;
  std::string where_;
};

}  // namespace

double stated_ratio(double length, double reference) {
  if (std::abs(length - reference) <= kPlainSeam) return 1;
  double ratio = length / reference;
  if (ratio < 1.5) return 1 + std::round((ratio - 1) * 1e4) / 100 / 100;
  return std::round(ratio * 1e4) / 1e4;
}

std::vector<design::Seam> read_pattern_stitches(const json* stitches, const std::vector<FilePanel>& panels,
                                                const PatternLimits& limits, PatternReport& report,
                                                std::vector<std::size_t>* numbers) {
  std::vector<design::Seam> seams;
  if (!stitches) {
    report.note("the pattern has no `stitches`: nothing is sewn");
    return seams;
  }
  if (!stitches->is_array()) {
    report.error("G0943", fmt::format("`pattern.stitches` is {}, expected a list", describe(*stitches)));
    return seams;
  }
  if (stitches->size() > limits.max_total) {
    report.error("G0944",
                 fmt::format("{} stitches, at most {} are read", stitches->size(), limits.max_total));
    return seams;
  }
  StitchReader reader(panels, report);
  for (std::size_t i = 0; i < stitches->size(); ++i) {
    reader.read((*stitches)[i], i, seams);
    if (numbers) numbers->resize(seams.size(), i);
  }
  return seams;
}

}  // namespace garment::io
