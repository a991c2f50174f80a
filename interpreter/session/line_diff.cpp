#include "interpreter/session/line_diff.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace garment::session {
namespace {

using Lines = std::vector<std::string_view>;

constexpr std::size_t kContext = 3;
constexpr std::size_t kMostCells =
    4'000'000;  // of the table of common lines; beyond, all lines between count as changed

Lines lines_of(std::string_view text) {
  Lines lines;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    lines.push_back(text.substr(0, end == std::string_view::npos ? text.size() : end + 1));
    text.remove_prefix(lines.back().size());
  }
  return lines;
}

/// One line of the difference: ' ' stays, '-' goes, '+' comes.
struct Step {
  char kind;
  std::size_t a, b;  ///< places in both texts
};

void add_middle(const Lines& a, const Lines& b, std::size_t from, std::size_t end_a, std::size_t end_b,
                std::vector<Step>& steps) {
  const std::size_t n = end_a - from, m = end_b - from;
  std::vector<std::vector<int>> common;
  const bool known = n * m <= kMostCells;
  if (known) {
    common.assign(n + 1, std::vector<int>(m + 1, 0));
    for (std::size_t i = n; i-- > 0;)
      for (std::size_t j = m; j-- > 0;)
        common[i][j] = a[from + i] == b[from + j] ? common[i + 1][j + 1] + 1
                                                  : std::max(common[i + 1][j], common[i][j + 1]);
  }
  std::size_t i = 0, j = 0;
  while (i < n || j < m) {
    if (known && i < n && j < m && a[from + i] == b[from + j])
      steps.push_back({' ', from + i++, from + j++});
    else if (i < n && (!known || j == m || common[i + 1][j] >= common[i][j + 1]))
      steps.push_back({'-', from + i++, from + j});
    else
      steps.push_back({'+', from + i, from + j++});
  }
}

std::vector<Step> compare(const Lines& a, const Lines& b) {
  std::vector<Step> steps;
  std::size_t from = 0, end_a = a.size(), end_b = b.size();
  while (from < end_a && from < end_b && a[from] == b[from]) {
    steps.push_back({' ', from, from});
    ++from;
  }
  while (end_a > from && end_b > from && a[end_a - 1] == b[end_b - 1]) --end_a, --end_b;
  add_middle(a, b, from, end_a, end_b, steps);
  while (end_a < a.size()) steps.push_back({' ', end_a++, end_b++});
  return steps;
}

std::string range(std::size_t first, std::size_t count) {
  const std::size_t line = count == 0 ? first : first + 1;
  return count == 1 ? std::to_string(line) : fmt::format("{},{}", line, count);
}

std::string hunk(const Lines& a, const Lines& b, const std::vector<Step>& steps, std::size_t begin,
                 std::size_t end) {
  std::size_t n_a = 0, n_b = 0;
  std::string body;
  for (std::size_t k = begin; k < end; ++k) {
    const Step& step = steps[k];
    n_a += step.kind != '+' ? 1 : 0;
    n_b += step.kind != '-' ? 1 : 0;
    const std::string_view line = step.kind == '+' ? b[step.b] : a[step.a];
    body += step.kind;
    body += line;
    if (line.empty() || line.back() != '\n') body += "\n\\ No newline at end of file\n";
  }
  return fmt::format("@@ -{} +{} @@\n", range(steps[begin].a, n_a), range(steps[begin].b, n_b)) + body;
}

}  // namespace

std::string unified_diff(std::string_view before, std::string_view after, std::string_view name_before,
                         std::string_view name_after) {
  if (before == after) return "";
  const Lines a = lines_of(before), b = lines_of(after);
  const std::vector<Step> steps = compare(a, b);
  std::string text = fmt::format("--- {}\n+++ {}\n", name_before, name_after);
  for (std::size_t k = 0; k < steps.size();) {
    if (steps[k].kind == ' ') {
      ++k;
      continue;
    }
    const std::size_t begin = k < kContext ? 0 : k - kContext;
    std::size_t last = k;
    for (std::size_t next = k; next < steps.size() && next <= last + 2 * kContext + 1; ++next)
      if (steps[next].kind != ' ') last = next;
    const std::size_t end = std::min(steps.size(), last + kContext + 1);
    text += hunk(a, b, steps, begin, end);
    k = end;
  }
  return text;
}

}  // namespace garment::session
