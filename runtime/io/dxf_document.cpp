#include "runtime/io/dxf_document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "runtime/base/number.hpp"
#include "runtime/base/portable_math.hpp"
#include "runtime/io/dxf_curves.hpp"

namespace garment::io {
namespace {

using Kind = DxfEntity::Kind;

std::string_view trimmed(std::string_view text) {
  auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\0' || c == '\x1a'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

void add_utf8(std::string& out, std::uint32_t c) {
  if (c < 0x80) {
    out += static_cast<char>(c);
  } else if (c < 0x800) {
    out += static_cast<char>(0xC0 | (c >> 6));
    out += static_cast<char>(0x80 | (c & 0x3F));
  } else {
    out += static_cast<char>(0xE0 | (c >> 12));
    out += static_cast<char>(0x80 | ((c >> 6) & 0x3F));
    out += static_cast<char>(0x80 | (c & 0x3F));
  }
}

/// Length of the UTF-8 character that starts here; 0 if it is none.
std::size_t utf8_length(std::string_view text) {
  const auto c = static_cast<unsigned char>(text[0]);
  const std::size_t n = c < 0x80                ? 1
                        : c >= 0xC2 && c < 0xE0 ? 2
                        : c >= 0xE0 && c < 0xF0 ? 3
                        : c >= 0xF0 && c < 0xF5 ? 4
                                                : 0;
  if (n == 0 || n > text.size()) return 0;
  for (std::size_t i = 1; i < n; ++i)
    if ((static_cast<unsigned char>(text[i]) & 0xC0) != 0x80) return 0;
  return n;
}

std::string to_utf8(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    if (text.size() >= 7 && text.starts_with("\\U+")) {
      std::uint32_t code = 0;
      bool hex = true;
      for (char c : text.substr(3, 4)) {
        const int digit = c >= '0' && c <= '9'   ? c - '0'
                          : c >= 'A' && c <= 'F' ? c - 'A' + 10
                          : c >= 'a' && c <= 'f' ? c - 'a' + 10
                                                 : -1;
        hex = hex && digit >= 0;
        code = code * 16 + static_cast<std::uint32_t>(std::max(digit, 0));
      }
      if (hex && code >= 0x20 && (code < 0xD800 || code > 0xDFFF)) {
        add_utf8(out, code);
        text.remove_prefix(7);
        continue;
      }
    }
    const std::size_t n = utf8_length(text);
    if (n == 0)
      add_utf8(out, static_cast<unsigned char>(text[0]));
    else
      out += text.substr(0, n);
    text.remove_prefix(std::max<std::size_t>(n, 1));
  }
  return out;
}

struct Pair {
  int code = 0;
  std::string_view value;
  std::size_t line = 0;  // of the value
};

/// Lines end with LF, CR LF or CR.
class Lines {
 public:
  explicit Lines(std::string_view text) : text_(text) {}
  bool next(std::string_view& line) {
    if (text_.empty()) return false;
    const std::size_t end = text_.find_first_of("\r\n");
    line = text_.substr(0, end);
    if (end == std::string_view::npos) {
      text_ = {};
    } else {
      const bool both = text_[end] == '\r' && end + 1 < text_.size() && text_[end + 1] == '\n';
      text_.remove_prefix(end + (both ? 2 : 1));
    }
    ++number_;
    return true;
  }
  std::size_t number() const { return number_; }

 private:
  std::string_view text_;
  std::size_t number_ = 0;
};

class DxfParser {
 public:
  DxfParser(std::string_view bytes, const DxfLimits& limits, PatternReport& report)
      : lines_(bytes), limits_(limits), report_(report) {}

  bool parse() {
    while (next()) {
      if (pair_.code == 999) continue;  // a comment
      if (pair_.code != 0) {
        in_record(pair_);
      } else if (!start_record(trimmed(pair_.value))) {
        return false;
      }
      if (failed_) return false;
      if (ended_) break;
    }
    if (failed_) return false;
    finish_entity();
    if (failed_) return false;
    if (!ended_)
      report_.warning(
          "G0963",
          fmt::format("line {}: the file breaks off{}, expected EOF", lines_.number(),
                      in_block_ ? fmt::format(" in block {}", in_ticks(document_.blocks.back().name)) : ""),
          "what stands before is read; ask for the whole file");
    return true;
  }

  DxfDocument take() { return std::move(document_); }

 private:
  bool fail(const char* code, std::size_t line, const std::string& found, const std::string& help) {
    if (!failed_) report_.error(code, fmt::format("line {}: {}", line, found), help);
    failed_ = true;
    return false;
  }

  bool next() {
    std::string_view code, value;
    do {
      if (!lines_.next(code)) return false;
    } while (trimmed(code).empty() && records_ == 0);  // blank lines before the first pair
    const auto number = parse_number(trimmed(code));
    if (trimmed(code).empty()) {  // blank lines at the end
      std::string_view rest;
      while (lines_.next(rest))
        if (!trimmed(rest).empty())
          return fail("G0961", lines_.number(),
                      fmt::format("text after an empty line, expected a group code"),
                      "a DXF file is pairs of lines: a group code, then its value");
      return false;
    }
    if (!number || *number != std::floor(*number) || *number < -5 || *number > 1071)
      return fail("G0961", lines_.number(),
                  fmt::format("{} is no group code, expected a whole number from -5 to 1071",
                              in_ticks(trimmed(code))),
                  "a DXF file is pairs of lines: a group code, then its value");
    if (!lines_.next(value)) return false;
    pair_ = {static_cast<int>(*number), value, lines_.number()};
    ++records_;
    return true;
  }

  std::optional<double> figure(const Pair& pair) {
    std::string text(trimmed(pair.value));
    std::replace(text.begin(), text.end(), ',', '.');
    if (!text.empty() && text[0] == '+') text.erase(0, 1);
    const auto number = parse_number(text);
    if (number && std::fabs(*number) <= limits_.max_coordinate) return number;
    fail("G0961", pair.line,
         fmt::format("{} after group code {}, expected a finite number of at most {}", in_ticks(text),
                     pair.code, format_number(limits_.max_coordinate)),
         "NaN and infinite numbers have no place in a drawing");
    return std::nullopt;
  }

  bool count(std::size_t n) {
    points_ += n;
    if (points_ <= limits_.max_points) return true;
    return fail("G0962", lines_.number(), fmt::format("more than {} points and entities", limits_.max_points),
                "is this the right file?");
  }

  bool start_record(std::string_view type) {
    if (type == "VERTEX" && polyline_) {
      finish_vertex();
      has_vertex_ = true;
      return !failed_;
    }
    if (type == "SEQEND") {
      finish_entity();
      return !failed_;
    }
    finish_entity();
    if (failed_) return false;
    table_record_ = false;
    if (type == "EOF") {
      ended_ = true;
    } else if (type == "SECTION") {
      section_.clear();
      name_section_ = true;
    } else if (type == "ENDSEC") {
      section_.clear();
      in_block_ = false;
    } else if (type == "BLOCK" && (section_ == "BLOCKS" || section_.empty())) {
      if (document_.blocks.size() >= limits_.max_blocks)
        return fail("G0962", pair_.line, fmt::format("more than {} blocks", limits_.max_blocks),
                    "is this the right file?");
      document_.blocks.emplace_back().line = pair_.line;
      in_block_ = block_head_ = true;
    } else if (type == "ENDBLK") {
      in_block_ = false;
      table_record_ = true;  // its own groups
    } else if (section_ == "ENTITIES" || in_block_) {
      block_head_ = false;
      return start_entity(type);
    } else {
      table_record_ = true;
    }
    return true;
  }

  bool start_entity(std::string_view type) {
    entity_.emplace();
    entity_->line = pair_.line;
    polyline_ = type == "POLYLINE";
    if (type == "LINE")
      entity_->kind = Kind::line, entity_->points.resize(2);
    else if (type == "POLYLINE" || type == "LWPOLYLINE")
      entity_->kind = Kind::polyline;
    else if (type == "POINT")
      entity_->kind = Kind::point, entity_->points.resize(1);
    else if (type == "TEXT" || type == "MTEXT" || type == "ATTRIB" || type == "ATTDEF")
      entity_->kind = Kind::text, entity_->points.resize(1);
    else if (type == "ARC")
      entity_->kind = Kind::arc, entity_->points.resize(1);
    else if (type == "CIRCLE")
      entity_->kind = Kind::circle, entity_->points.resize(1);
    else if (type == "INSERT")
      entity_->kind = Kind::insert, entity_->points.resize(1);
    else if (type == "SPLINE")
      entity_->kind = Kind::spline, spline_ = {};
    else if (type == "ELLIPSE")
      entity_->kind = Kind::ellipse, ellipse_ = {};
    if (entity_->kind == Kind::other && type != "VIEWPORT") pass_over(type);  // a view draws nothing itself
    light_ = type == "LWPOLYLINE";
    return count(1);
  }

  void pass_over(std::string_view type) {
    constexpr std::size_t kMostKinds = 24;
    std::string kind = to_utf8(type.substr(0, 40));
    if (document_.passed_over.size() >= kMostKinds && !document_.passed_over.contains(kind)) kind = "other";
    ++document_.passed_over[kind];
  }

  void in_record(const Pair& pair) {
    if (name_section_ && pair.code == 2) {
      section_ = trimmed(pair.value);
      name_section_ = false;
    } else if (section_ == "HEADER") {
      header(pair);
    } else if (in_block_ && block_head_) {
      DxfBlock& block = document_.blocks.back();
      if (pair.code == 2 || (pair.code == 3 && block.name.empty())) block.name = to_utf8(trimmed(pair.value));
      if (pair.code == 10 || pair.code == 20)
        if (auto number = figure(pair)) block.base[pair.code == 10 ? 0 : 1] = *number;
    } else if (entity_ && !table_record_) {
      if (polyline_ && has_vertex_)
        in_vertex(pair);
      else
        in_entity(pair);
    }
  }

  void header(const Pair& pair) {
    if (pair.code == 9)
      variable_ = trimmed(pair.value);
    else if ((pair.code == 70 || pair.code == 40) && !variable_.empty())
      if (auto number = parse_number(trimmed(pair.value))) document_.header[variable_] = *number;
  }

  void in_vertex(const Pair& pair) {
    if (pair.code == 10 || pair.code == 20 || pair.code == 42) {
      const auto number = figure(pair);
      if (!number) return;
      if (pair.code == 42)
        vertex_.bulge = *number;
      else
        vertex_.point[pair.code == 10 ? 0 : 1] = *number, vertex_known_ = true;
    } else if (pair.code == 70) {
      const auto flags = parse_number(trimmed(pair.value));
      vertex_frame_ = flags && *flags >= 0 && *flags < 256 && (static_cast<int>(*flags) & 16) != 0;
    } else if (pair.code == 8 && entity_->layer.empty()) {
      entity_->layer = to_utf8(trimmed(pair.value));
    }
  }

  void finish_vertex() {
    if (has_vertex_ && vertex_known_ && !vertex_frame_ && count(1)) entity_->points.push_back(vertex_);
    vertex_ = {};
    has_vertex_ = vertex_known_ = vertex_frame_ = false;
  }

  void in_entity(const Pair& pair) {
    DxfEntity& e = *entity_;
    switch (pair.code) {
      case 8:
        e.layer = to_utf8(trimmed(pair.value));
        return;
      case 1:
      case 3:
        if (e.kind == Kind::text && e.text.size() < 4096) e.text += to_utf8(trimmed(pair.value));
        return;
      case 2:
        if (e.kind == Kind::insert) e.text = to_utf8(trimmed(pair.value));
        return;
      case 70: {
        const auto flags = parse_number(trimmed(pair.value));
        if ((e.kind == Kind::polyline || e.kind == Kind::spline) && flags && *flags >= 0 && *flags < 32768)
          e.closed = (static_cast<int>(*flags) & 1) != 0;
        return;
      }
      case 71:
        if (const auto degree = parse_number(trimmed(pair.value)); e.kind == Kind::spline && degree)
          spline_.degree = static_cast<int>(std::clamp(*degree, -1.0, 1000.0));
        return;
      case 10:
      case 20:
      case 11:
      case 21:
      case 12:
      case 22:
      case 13:
      case 23:
      case 40:
      case 41:
      case 42:
      case 50:
      case 51:
      case 230:
        break;
      default:
        return;
    }
    if (e.kind == Kind::other) return;
    const auto number = figure(pair);
    if (number) set(e, pair.code, *number);
  }

  void set(DxfEntity& e, int code, double value) {
    const std::size_t axis = code % 100 >= 20 ? 1 : 0;
    if (code == 230) flipped_ = value < 0;  // the drawing plane seen from behind
    if (light_) {
      if (code == 10 && count(1)) e.points.emplace_back();
      if (e.points.empty()) return;
      if (code == 10 || code == 20) e.points.back().point[static_cast<Eigen::Index>(axis)] = value;
      if (code == 42) e.points.back().bulge = value;
    } else if (e.kind == Kind::spline) {
      set_spline(code, value);
    } else if (e.kind == Kind::ellipse) {
      set_ellipse(code, value);
    } else if (code == 10 || code == 20) {
      if (!e.points.empty()) e.points[0].point[static_cast<Eigen::Index>(axis)] = value;
    } else if (code == 11 || code == 21) {
      if (e.kind == Kind::line) e.points[1].point[static_cast<Eigen::Index>(axis)] = value;
    } else if (e.kind == Kind::arc || e.kind == Kind::circle) {
      if (code == 40) e.radius = std::fabs(value);
      if (e.kind == Kind::arc && code == 50) e.from = value;
      if (e.kind == Kind::arc && code == 51) e.to = value;
    } else if (e.kind == Kind::insert) {
      if (code == 41) e.scale.x() = value;
      if (code == 42) e.scale.y() = value;
      if (code == 50) e.turn = value;
    }
  }

  void set_spline(int code, double value) {
    DxfSpline& s = spline_;
    const Eigen::Index axis = code % 100 >= 20 ? 1 : 0;
    auto place = [&](std::vector<Point2>& points) {
      if (axis == 0 && count(1)) points.emplace_back(0, 0);
      if (!points.empty()) points.back()[axis] = value;
    };
    if (code == 10 || code == 20) place(s.control);
    if (code == 11 || code == 21) place(s.fit);
    if (code == 12 || code == 22) s.start[axis] = value;
    if (code == 13 || code == 23) s.end[axis] = value;
    if (code == 40 && count(1)) s.knots.push_back(value);
    if (code == 41 && count(1)) s.weights.push_back(value);
  }

  void set_ellipse(int code, double value) {
    const Eigen::Index axis = code % 100 >= 20 ? 1 : 0;
    if (code == 10 || code == 20) ellipse_.centre[axis] = value;
    if (code == 11 || code == 21) ellipse_.major[axis] = value;
    if (code == 40) ellipse_.ratio = value;
    if (code == 41) ellipse_.from = value;
    if (code == 42) ellipse_.to = value;
  }

  /// A spline or an ellipse becomes a polyline; false, and a warning, where it is none.
  bool flatten(DxfEntity& e) {
    const bool spline = e.kind == Kind::spline;
    spline_.closed = e.closed;
    ellipse_.flipped = flipped_;
    const DxfFlattened curve = spline ? flattened(spline_) : flattened(ellipse_);
    e.kind = Kind::polyline;
    e.closed = curve.closed;
    if (!curve.fault.empty())
      report_.warning("G0969",
                      fmt::format("line {}: a {} with {}; it is left out", e.line, spline ? "SPLINE" : "ELLIPSE",
                                  curve.fault),
                      "draw that line again, or export curves as polylines");
    for (const Point2& p : curve.points) e.points.push_back({p, 0});
    return count(curve.points.size()) && curve.fault.empty();
  }

  /// Into the drawing's own plane, for kinds whose coordinates are those of their own one: seen from behind, x
  /// runs the other way.
  static void turn_round(DxfEntity& e) {
    if (e.kind == Kind::line || e.kind == Kind::point) return;
    for (DxfVertex& v : e.points) v.point.x() = -v.point.x(), v.bulge = -v.bulge;
    if (e.kind == Kind::arc) {
      const double from = e.from;
      e.from = 180 - e.to;
      e.to = 180 - from;
    }
    if (e.kind == Kind::insert) e.scale.x() = -e.scale.x(), e.turn = -e.turn;
  }

  void finish_entity() {
    if (!entity_) return;
    if (polyline_) finish_vertex();
    const bool curve = entity_->kind == Kind::spline || entity_->kind == Kind::ellipse;
    if (flipped_ && !curve) turn_round(*entity_);
    const bool drawn = curve ? flatten(*entity_) : entity_->kind != Kind::other;
    if (drawn && !(entity_->kind == Kind::polyline && entity_->points.empty()))
      (in_block_ ? document_.blocks.back().entities : document_.entities).push_back(std::move(*entity_));
    entity_.reset();
    polyline_ = flipped_ = light_ = false;
  }

  Lines lines_;
  const DxfLimits& limits_;
  PatternReport& report_;
  DxfDocument document_;
  Pair pair_;
  std::size_t records_ = 0, points_ = 0;
  std::string section_, variable_;
  bool name_section_ = false, in_block_ = false, block_head_ = false, table_record_ = false;
  bool ended_ = false, failed_ = false;
  std::optional<DxfEntity> entity_;
  DxfSpline spline_;    // of entity_
  DxfEllipse ellipse_;  // of entity_
  bool polyline_ = false, light_ = false, flipped_ = false;
  DxfVertex vertex_;
  bool has_vertex_ = false, vertex_known_ = false, vertex_frame_ = false;
};

struct Motion {
  Eigen::Matrix2d linear = Eigen::Matrix2d::Identity();
  Point2 shift{0, 0};
  Point2 operator()(const Point2& p) const { return linear * p + shift; }
};

class Flattener {
 public:
  Flattener(const DxfDocument& document, const DxfLimits& limits, PatternReport& report)
      : document_(document), limits_(limits), report_(report) {
    for (std::size_t b = 0; b < document.blocks.size(); ++b) by_name_.emplace(document.blocks[b].name, b);
  }

  void add(const std::vector<DxfEntity>& entities, const Motion& motion, int depth) {
    for (const DxfEntity& entity : entities) {
      if (++visits_ > limits_.max_points) return;  // blocks that insert many blocks that insert many ...
      if (entity.kind != Kind::insert) {
        out.push_back(moved(entity, motion));
        continue;
      }
      const auto found = by_name_.find(entity.text);
      if (found == by_name_.end()) continue;
      if (depth >= limits_.max_depth) {
        report_.warning("G0964",
                        fmt::format("line {}: blocks are inserted more than {} deep; the rest is left out",
                                    entity.line, limits_.max_depth),
                        "does a block insert itself?");
        return;
      }
      const DxfBlock& block = document_.blocks[found->second];
      const double turn = entity.turn * (portable::kPi / 180), c = portable::cos(turn),
                   s = portable::sin(turn);
      Eigen::Matrix2d linear;
      linear << c * entity.scale.x(), -s * entity.scale.y(), s * entity.scale.x(), c * entity.scale.y();
      Motion inner;
      inner.linear = motion.linear * linear;
      inner.shift = motion(entity.points[0].point) - inner.linear * block.base;
      add(block.entities, inner, depth + 1);
    }
  }

  std::vector<DxfEntity> out;

 private:
  static DxfEntity moved(const DxfEntity& entity, const Motion& motion) {
    DxfEntity e = entity;
    const double sense = motion.linear.determinant() < 0 ? -1 : 1;
    if ((e.kind == Kind::arc || e.kind == Kind::circle) && !motion.linear.isIdentity()) {
      bool closed = false;  // as points with bulges they move like any
      e.points = course(entity, closed);
      e.closed = closed;
      e.kind = Kind::polyline;
    }
    for (DxfVertex& v : e.points) v.point = motion(v.point), v.bulge *= sense;
    return e;
  }

  const DxfDocument& document_;
  const DxfLimits& limits_;
  PatternReport& report_;
  std::map<std::string, std::size_t> by_name_;
  std::size_t visits_ = 0;
};

}  // namespace

std::optional<DxfDocument> parse_dxf(std::string_view bytes, const DxfLimits& limits, PatternReport& report) {
  if (bytes.starts_with("AutoCAD Binary DXF")) {
    report.error("G0960", "line 1: a binary DXF file, expected text",
                 "save it as ASCII DXF, R12 if there is a choice");
    return std::nullopt;
  }
  if (bytes.size() > limits.max_bytes) {
    report.error(
        "G0962",
        fmt::format("line 1: the file has {} bytes, at most {} are read", bytes.size(), limits.max_bytes),
        "is this the right file?");
    return std::nullopt;
  }
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  DxfParser parser(bytes, limits, report);
  if (!parser.parse()) return std::nullopt;
  return parser.take();
}

std::vector<DxfEntity> flattened(const DxfDocument& document, const std::vector<DxfEntity>& entities,
                                 const DxfLimits& limits, PatternReport& report) {
  Flattener flattener(document, limits, report);
  flattener.add(entities, {}, 0);
  return std::move(flattener.out);
}

std::vector<DxfVertex> course(const DxfEntity& entity, bool& closed) {
  closed = entity.closed;
  if (entity.kind == Kind::line || entity.kind == Kind::polyline) return entity.points;
  if (entity.kind != Kind::arc && entity.kind != Kind::circle) return {};
  auto at = [&](double degrees) {
    const double a = degrees * (portable::kPi / 180);
    return Point2(entity.points[0].point + entity.radius * Point2(portable::cos(a), portable::sin(a)));
  };
  closed = entity.kind == Kind::circle;
  const double from = entity.from;
  double turn = closed ? 360 : std::fmod(entity.to - from, 360);
  if (turn <= 0) turn += 360;
  const double quarter = turn / 4 * (portable::kPi / 180) / 2;  // of half the way
  const double bulge = portable::sin(quarter) / portable::cos(quarter);
  std::vector<DxfVertex> out{{at(from), bulge}, {at(from + turn / 2), bulge}};
  if (!closed) out.push_back({at(from + turn), 0});
  return out;
}

}  // namespace garment::io
