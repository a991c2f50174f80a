#include "grammar/diagnostic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "grammar/text.hpp"

namespace garment::grammar {
namespace {

constexpr std::size_t kLongLine = 400;    // bytes; a longer line is shown as a window around its first label
constexpr std::size_t kWindowLead = 100;  // bytes shown before that label

struct Palette {
  std::string_view severity, gutter, bold, reset;
};

Palette palette_of(Severity severity, bool color) {
  if (!color) return {};
  std::string_view tone = severity == Severity::error     ? "\x1b[1;31m"
                          : severity == Severity::warning ? "\x1b[1;33m"
                                                          : "\x1b[1;36m";
  return {tone, "\x1b[1;34m", "\x1b[1m", "\x1b[0m"};
}

std::string_view severity_name(Severity severity) {
  return severity == Severity::error ? "error" : severity == Severity::warning ? "warning" : "note";
}

/// One row of carets: bytes [begin, end) of the source, all within `line`.
struct Underline {
  std::uint32_t line, begin, end;
  std::string text;
  bool primary;
};

/// Underlines of one source by line, in the order of the labels.
using Underlines = std::map<std::uint32_t, std::vector<Underline>>;

Span line_span(const Source& source, std::uint32_t line) {
  std::uint32_t begin = source.line_begin[line - 1];
  std::size_t end = line < source.line_begin.size() ? source.line_begin[line] - 1 : source.text.size();
  if (end > begin && source.text[end - 1] == '\r') --end;
  return {0, begin, static_cast<std::uint32_t>(end)};
}

/// A label over several lines is drawn under the rest of its first line and under its last line, which bears
/// the text.
void add_underlines(const Label& label, bool primary, const Sources& sources, Underlines& underlines) {
  const Source& source = sources[label.span.source];
  std::uint32_t size = static_cast<std::uint32_t>(source.text.size());
  std::uint32_t begin = std::min(label.span.begin, size);
  std::uint32_t end = std::clamp(label.span.end, begin, size);
  std::uint32_t first = sources.place(label.span.source, begin).line;
  std::uint32_t last = sources.place(label.span.source, end > begin ? end - 1 : end).line;
  if (first == last) {
    underlines[first].push_back({first, begin, end, label.text, primary});
    return;
  }
  underlines[first].push_back({first, begin, line_span(source, first).end, "", primary});
  std::uint32_t text_begin = line_span(source, last).begin;
  while (text_begin < end && is_blank(source.text[text_begin])) ++text_begin;
  underlines[last].push_back({last, text_begin, end, label.text, primary});
}

/// A source line as a terminal shows it: tabs expanded, control characters escaped, and the column of every
/// byte.
struct ShownLine {
  std::string text;
  std::vector<std::uint32_t>
      columns;  ///< of the bytes [begin, begin + columns.size()); the last is one past the end
  std::uint32_t begin = 0;

  std::uint32_t column(std::uint32_t offset) const {
    std::size_t i = offset < begin ? 0 : std::min<std::size_t>(offset - begin, columns.size() - 1);
    return columns[i];
  }
};

ShownLine show_line(const Source& source, std::uint32_t line, std::uint32_t first_label) {
  Span span = line_span(source, line);
  std::string_view text = source.text;
  ShownLine shown;
  bool cut_front = false, cut_back = false;
  if (span.end - span.begin > kLongLine) {
    if (first_label > span.begin + kWindowLead) {
      span.begin = first_label - kWindowLead;
      while (is_utf8_tail(text[span.begin])) ++span.begin;
      cut_front = true;
    }
    if (span.end - span.begin > kLongLine) {
      span.end = span.begin + kLongLine;
      while (is_utf8_tail(text[span.end])) --span.end;
      cut_back = true;
    }
  }
  shown.begin = span.begin;
  std::uint32_t column = 0;
  if (cut_front) {
    shown.text = "... ";
    column = 4;
  }
  for (std::size_t i = span.begin; i < span.end;) {
    Character c = decode_utf8(text, i);
    for (std::uint32_t k = 0; k < c.length; ++k) shown.columns.push_back(column);
    if (c.valid && c.code == '\t') {
      std::uint32_t blanks = kTabStop - column % kTabStop;
      shown.text.append(blanks, ' ');
      column += blanks;
    } else if (!c.valid || is_control(c.code)) {
      std::string escaped = escape_character(c.code);
      column += static_cast<std::uint32_t>(escaped.size());
      shown.text += escaped;
    } else {
      shown.text += text.substr(i, c.length);
      column += static_cast<std::uint32_t>(display_width(c.code));
    }
    i += c.length;
  }
  shown.columns.push_back(column);
  if (cut_back) shown.text += " ...";
  while (!shown.text.empty() && shown.text.back() == ' ') shown.text.pop_back();
  return shown;
}

class Renderer {
 public:
  Renderer(const Diagnostic& diagnostic, const Sources& sources, bool color)
      : diagnostic_(diagnostic), sources_(sources), palette_(palette_of(diagnostic.severity, color)) {}

  std::string run() {
    out_ = fmt::format("{}{}[{}]{}{}: {}{}\n", palette_.severity, severity_name(diagnostic_.severity),
                       diagnostic_.code, palette_.reset, palette_.bold, escape_controls(diagnostic_.message),
                       palette_.reset);
    // The sources in the order in which the labels name them: the primary place first.
    std::vector<SourceId> order;
    std::map<SourceId, Underlines> by_source;
    for (std::size_t i = 0; i < diagnostic_.labels.size(); ++i) {
      const Label& label = diagnostic_.labels[i];
      if (label.span.source >= sources_.size()) continue;
      if (!by_source.count(label.span.source)) order.push_back(label.span.source);
      add_underlines(label, i == 0, sources_, by_source[label.span.source]);
    }
    for (const auto& [id, underlines] : by_source)
      width_ = std::max(width_, fmt::formatted_size("{}", underlines.rbegin()->first));
    for (SourceId id : order) print_source(id, by_source[id], id == order.front() ? "-->" : ":::");
    print_help();
    return std::move(out_);
  }

 private:
  void print_source(SourceId id, const Underlines& underlines, std::string_view arrow) {
    const Label* first = nullptr;
    for (const Label& label : diagnostic_.labels)
      if (!first && label.span.source == id) first = &label;
    Place place = sources_.place(id, first->span.begin);
    out_ += fmt::format("{:{}}{}{}{} {}:{}:{}\n", "", width_, palette_.gutter, arrow, palette_.reset,
                        escape_controls(sources_[id].name), place.line, place.column);
    gutter("");
    std::uint32_t previous = 0;
    for (const auto& [line, rows] : underlines) {
      if (previous != 0 && line > previous + 1) out_ += "...\n";
      previous = line;
      print_line(sources_[id], line, rows);
    }
  }

  void print_line(const Source& source, std::uint32_t line, const std::vector<Underline>& rows) {
    ShownLine shown = show_line(source, line, rows.front().begin);
    gutter(shown.text, std::to_string(line));
    for (const Underline& row : rows) {
      std::uint32_t begin = shown.column(row.begin), end = shown.column(row.end);
      std::string marks(std::max(end, begin + 1) - begin, row.primary ? '^' : '-');
      std::string text = escape_controls(row.text);
      std::string_view tone = row.primary ? palette_.severity : palette_.gutter;
      gutter(fmt::format("{:{}}{}{}{}{}{}", "", begin, tone, marks, text.empty() ? "" : " ", text,
                         palette_.reset));
    }
  }

  void gutter(std::string_view content, std::string_view number = "") {
    out_ += fmt::format("{}{:>{}} |{}{}{}\n", palette_.gutter, number, width_, palette_.reset,
                        content.empty() ? "" : " ", content);
  }

  void print_help() {
    if (diagnostic_.help.empty()) return;
    std::string help = escape_controls(diagnostic_.help);
    std::string next_line = "\n" + std::string(width_ + 9, ' ');
    for (std::size_t at = 0; (at = help.find('\n', at)) != std::string::npos; at += next_line.size())
      help.replace(at, 1, next_line);
    out_ += fmt::format("{:{}}{}={} help: {}\n", "", width_ + 1, palette_.gutter, palette_.reset, help);
  }

  const Diagnostic& diagnostic_;
  const Sources& sources_;
  Palette palette_;
  std::size_t width_ = 1;
  std::string out_;
};

}  // namespace

std::string render(const Diagnostic& diagnostic, const Sources& sources, bool color) {
  return Renderer(diagnostic, sources, color).run();
}

std::string render_json(const Diagnostics& diagnostics, const Sources& sources) {
  using nlohmann::ordered_json;
  ordered_json all = ordered_json::array();
  for (const Diagnostic& diagnostic : diagnostics) {
    ordered_json labels = ordered_json::array();
    for (const Label& label : diagnostic.labels) {
      if (label.span.source >= sources.size()) continue;
      Place begin = sources.place(label.span.source, label.span.begin);
      Place end = sources.place(label.span.source, label.span.end);
      labels.push_back({{"source", sources[label.span.source].name},
                        {"begin", label.span.begin},
                        {"end", label.span.end},
                        {"line", begin.line},
                        {"column", begin.column},
                        {"end_line", end.line},
                        {"end_column", end.column},
                        {"text", label.text}});
    }
    all.push_back({{"code", diagnostic.code},
                   {"severity", severity_name(diagnostic.severity)},
                   {"message", diagnostic.message},
                   {"help", diagnostic.help},
                   {"labels", std::move(labels)}});
  }
  return all.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace garment::grammar
