#include "interpreter/cli/golden_compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "runtime/base/number.hpp"

namespace garment::cli {
namespace {

constexpr std::size_t kLinesAround = 2, kMaxLines = 2000;

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

/// A number of a line with its unit.
struct Figure {
  double value = 0;  ///< SI, or plain
  interpreter::Dimension dimension;
  std::string text;
};

/// A line as its words, with `#` for each number, and its numbers.
struct Figures {
  std::string words;
  std::vector<Figure> numbers;
};

Figure figure_at(const std::string& line, std::size_t& at) {
  const std::size_t begin = at;
  if (line[at] == '-') ++at;
  while (at < line.size() && (is_digit(line[at]) || (line[at] == '.' && at + 1 < line.size() && is_digit(line[at + 1])))) ++at;
  if (at + 1 < line.size() && line[at] == 'e' && (is_digit(line[at + 1]) || line[at + 1] == '-'))
    for (at += 2; at < line.size() && is_digit(line[at]);) ++at;
  Figure figure{parse_number(std::string_view(line).substr(begin, at - begin)).value_or(0), {}, ""};
  std::size_t unit = at + (at + 1 < line.size() && line[at] == ' ' ? 1 : 0), end = unit;
  while (end < line.size() && (is_letter(line[end]) || line[end] == '%' || (end > unit && (line[end] == '/' || line[end] == '^' ||
                                                                                          line[end] == '*' || is_digit(line[end])))))
    ++end;
  const auto found = end > unit ? interpreter::find_unit(std::string_view(line).substr(unit, end - unit)) : std::nullopt;
  if (found) {
    figure.value *= found->factor;
    figure.dimension = found->dimension;
    at = end;
  }
  figure.text = line.substr(begin, at - begin);
  return figure;
}

Figures figures_of(const std::string& line) {
  Figures out;
  for (std::size_t at = 0; at < line.size();) {
    const bool inside = at > 0 && (is_letter(line[at - 1]) || is_digit(line[at - 1]));
    const bool sign = line[at] == '-' && at + 1 < line.size() && is_digit(line[at + 1]);
    if (!inside && (is_digit(line[at]) || sign)) {
      out.numbers.push_back(figure_at(line, at));
      out.words += '#';
    } else {
      out.words += line[at++];
    }
  }
  return out;
}

bool near(const Figure& a, const Figure& b, const GoldenTolerance& tolerance) {
  if (a.dimension != b.dimension) return false;
  if (a.value == b.value) return true;
  const double apart = std::fabs(a.value - b.value);
  if (tolerance.relative) return apart <= tolerance.value * std::max(std::fabs(a.value), std::fabs(b.value));
  return tolerance.dimension == a.dimension && apart <= tolerance.value * (1 + 1e-12);
}

bool same_line(const std::string& a, const std::string& b, const std::optional<GoldenTolerance>& tolerance) {
  if (a == b) return true;
  if (!tolerance) return false;
  const Figures x = figures_of(a), y = figures_of(b);
  return x.words == y.words && x.numbers.size() == y.numbers.size() &&
         std::equal(x.numbers.begin(), x.numbers.end(), y.numbers.begin(),
                    [&](const Figure& p, const Figure& q) { return near(p, q, *tolerance); });
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return lines;
}

/// ' ' both, '-' golden only, '+' new only.
using Edit = std::pair<char, std::string>;

/// The shortest way from one text to the other, by the longest common sequence of lines.
std::vector<Edit> edits_between(const std::vector<std::string>& a, const std::vector<std::string>& b,
                                const std::optional<GoldenTolerance>& tolerance) {
  const std::size_t n = a.size(), m = b.size();
  std::vector<std::vector<std::size_t>> common(n + 1, std::vector<std::size_t>(m + 1, 0));
  std::vector<std::vector<bool>> same(n, std::vector<bool>(m));
  for (std::size_t i = n; i-- > 0;)
    for (std::size_t j = m; j-- > 0;) {
      same[i][j] = same_line(a[i], b[j], tolerance);
      common[i][j] = same[i][j] ? common[i + 1][j + 1] + 1 : std::max(common[i + 1][j], common[i][j + 1]);
    }
  std::vector<Edit> edits;
  for (std::size_t i = 0, j = 0; i < n || j < m;) {
    if (i < n && j < m && same[i][j])
      edits.emplace_back(' ', a[i]), ++i, ++j;
    else if (j == m || (i < n && common[i + 1][j] >= common[i][j + 1]))
      edits.emplace_back('-', a[i++]);
    else
      edits.emplace_back('+', b[j++]);
  }
  return edits;
}

/// "23.2 cm -> 24 cm (+3.4 %)" for each number of two lines that otherwise say the same.
std::string changed_numbers(const std::string& golden, const std::string& now) {
  const Figures a = figures_of(golden), b = figures_of(now);
  if (a.words != b.words || a.numbers.size() != b.numbers.size()) return "";
  std::string out;
  for (std::size_t k = 0; k < a.numbers.size(); ++k) {
    const Figure &x = a.numbers[k], &y = b.numbers[k];
    if (x.text == y.text) continue;
    out += (out.empty() ? "" : ", ") + x.text + " -> " + y.text;
    if (x.value != 0 && x.dimension == y.dimension)
      out += fmt::format(" ({}{}%)", y.value > x.value ? "+" : "", format_number(100 * (y.value / x.value - 1), 2));
  }
  return out.empty() ? "" : "  ~ " + out + "\n";
}

std::string told(const std::vector<Edit>& edits) {
  std::string out;
  std::size_t last = 0;  // first line not told yet
  for (std::size_t k = 0; k < edits.size(); ++k) {
    if (edits[k].first == ' ') continue;
    const std::size_t from = std::max(last, k < kLinesAround ? 0 : k - kLinesAround);
    if (from > last && last > 0) out += "  ...\n";
    for (std::size_t i = from; i < k; ++i) out += "    " + edits[i].second + "\n";
    std::vector<std::string> gone, come;
    for (; k < edits.size() && edits[k].first != ' '; ++k) {
      out += fmt::format("  {} {}\n", edits[k].first, edits[k].second);
      (edits[k].first == '-' ? gone : come).push_back(edits[k].second);
    }
    if (gone.size() == come.size())
      for (std::size_t i = 0; i < gone.size(); ++i) out += changed_numbers(gone[i], come[i]);
    last = std::min(edits.size(), k + kLinesAround);
    for (std::size_t i = k; i < last; ++i) {
      if (edits[i].first != ' ') {
        last = i;
        break;
      }
      out += "    " + edits[i].second + "\n";
    }
    k = last - 1;
  }
  return out;
}

bool is_expected(const ExpectedDiagnostic& e, const grammar::Diagnostic& d, const grammar::Sources& sources) {
  const char* severity = d.severity == Severity::error     ? "error"
                         : d.severity == Severity::warning ? "warning"
                                                           : "note";
  if (d.code != e.code || e.severity != severity || d.message.find(e.part) == std::string::npos) return false;
  if (e.first == 0 || d.labels.empty()) return e.first == 0 && d.labels.empty();
  const grammar::Span& span = d.labels[0].span;
  const grammar::Place a = sources.place(span.source, span.begin), b = sources.place(span.source, span.end);
  return a.line == e.line && a.column == e.first && (b.line != a.line || b.column == e.last + 1);
}

}  // namespace

std::string compare_diagnostics(const Expectations& expected, const GoldenOutcome& outcome) {
  std::string differences;
  std::vector<bool> used(outcome.diagnostics.size(), false);
  for (const ExpectedDiagnostic& e : expected.diagnostics) {
    bool found = false;
    for (std::size_t i = 0; i < outcome.diagnostics.size() && !found; ++i) {
      if (used[i] || !is_expected(e, outcome.diagnostics[i], outcome.sources)) continue;
      found = used[i] = true;
    }
    if (!found)
      differences += fmt::format("  missing: line {} {}[{}] {}-{} \"{}\"\n", e.line, e.severity, e.code, e.first, e.last, e.part);
  }
  for (std::size_t i = 0; i < outcome.diagnostics.size(); ++i)
    if (!used[i]) differences += "  not expected:\n" + grammar::render(outcome.diagnostics[i], outcome.sources, false);
  return differences;
}

std::string compare_values(const Expectations& expected, const GoldenOutcome& outcome) {
  std::string differences;
  for (const ExpectedValue& e : expected.values) {
    const auto found = outcome.values.find(e.line);
    if (found == outcome.values.end())
      differences += fmt::format("  line {}: `#! expect: {}` stands above no `let`, `param` or `measure` that has a value\n",
                                 e.line, e.text);
    else if (!same_line(e.text, found->second, expected.tolerance))
      differences += fmt::format("  line {}: expected {}, found {}\n", e.line, e.text, found->second);
  }
  return differences;
}

std::string compare_texts(const std::string& golden, const std::string& now,
                          const std::optional<GoldenTolerance>& tolerance) {
  std::vector<std::string> a = lines_of(golden), b = lines_of(now);
  if (a.size() > kMaxLines || b.size() > kMaxLines)
    return golden == now ? "" : fmt::format("  the texts differ; they have {} and {} lines\n", a.size(), b.size());
  const std::vector<Edit> edits = edits_between(a, b, tolerance);
  const std::string out = told(edits);
  if (out.empty() && golden != now && !tolerance) return "  they differ in line ends only\n";
  return out;
}

}  // namespace garment::cli
