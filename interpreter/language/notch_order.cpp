#include "interpreter/language/notch_order.hpp"

#include <algorithm>
#include <cmath>

#include "interpreter/language/edges.hpp"

namespace garment::interpreter {
namespace {

constexpr double kFits = 5e-3;    // m
constexpr double kWithin = 1e-6;  // m

struct Mark {
  std::string name;  ///< without the half
  double at = 0;     ///< sewn length from the side's start, m
  Span span;
};

std::string plain(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  return dot == std::string::npos ? name : name.substr(dot + 1);
}

/// The notches along a side, in the order sewn.
std::vector<Mark> marks_of(const Program& program, const design::SeamSide& side) {
  std::vector<Mark> marks;
  double done = 0;
  for (const design::EdgePart& part : side.parts) {
    const PanelInfo& info = program.panels[static_cast<std::size_t>(part.panel)];
    const std::string& edge = design::edge_of(info.panel, part).name;
    const double low = std::min(part.from, part.to), high = std::max(part.from, part.to);
    for (const design::Notch& notch : info.panel.notches) {
      if (notch.edge != edge || notch.at < low - kWithin || notch.at > high + kWithin) continue;
      design::EdgePart before = part;
      before.to = std::clamp(notch.at, low, high);
      const auto span = info.spans.find(plain(notch.name));
      marks.push_back({plain(notch.name), done + sewn_length(program, before),
                       span == info.spans.end() ? Span{} : span->second});
    }
    done += sewn_length(program, part);
  }
  std::stable_sort(marks.begin(), marks.end(), [](const Mark& a, const Mark& b) { return a.at < b.at; });
  return marks;
}

/// Those of `marks` whose name is once in either list.
std::vector<Mark> shared(const std::vector<Mark>& marks, const std::vector<Mark>& others) {
  auto count = [](const std::vector<Mark>& list, const std::string& name) {
    return std::count_if(list.begin(), list.end(), [&](const Mark& mark) { return mark.name == name; });
  };
  std::vector<Mark> out;
  for (const Mark& mark : marks)
    if (count(marks, mark.name) == 1 && count(others, mark.name) == 1) out.push_back(mark);
  return out;
}

std::string listed_marks(const std::vector<Mark>& marks) {
  std::string text;
  for (const Mark& mark : marks) text += (text.empty() ? "" : ", ") + mark.name;
  return text;
}

void check_pair(Program& program, const SeamInfo& info, std::size_t k, bool alike) {
  const std::vector<Mark> all = marks_of(program, info.seam.sides[0]), theirs = marks_of(program, info.seam.sides[k]);
  const std::vector<Mark> a = shared(all, theirs), b = shared(theirs, all);
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i].name == b[i].name) continue;
    report(program, Message("G0432",
                            "in seam `" + info.seam.name + "` the notches come as " + listed_marks(a) + " on one side and as " +
                                listed_marks(b) + " on the other",
                            info.spans[0], listed_marks(a))
                        .also(info.spans[k], listed_marks(b))
                        .help("is one of the edges drawn the other way than meant, or a notch in a wrong place? `reversed` "
                              "turns a side round"));
    return;
  }
  for (std::size_t i = 0; i < a.size() && alike; ++i) {
    if (std::fabs(a[i].at - b[i].at) <= kFits) continue;
    report(program, Message("G0438",
                            "in seam `" + info.seam.name + "` notch `" + a[i].name + "` is " + format_mm(a[i].at) +
                                " along one side and " + format_mm(b[i].at) + " along the other",
                            a[i].span, format_mm(a[i].at))
                        .also(b[i].span, format_mm(b[i].at))
                        .warning()
                        .help("notches of one name meet when the seam is sewn: move one of them, or give them two names"));
  }
}

}  // namespace

void check_notch_order(Program& program) {
  for (const SeamInfo& info : program.seams) {
    if (!info.ready) continue;
    for (std::size_t k = 1; k < info.seam.sides.size(); ++k) {
      if (info.seam.sides[0].closed) continue;  // a ring may start anywhere
      const double ratio = info.seam.ratio[0] / info.seam.ratio[k];
      check_pair(program, info, k, std::fabs(ratio - 1) < 1e-9);
    }
  }
}

}  // namespace garment::interpreter
