#include "runtime/io/dxf_piece.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>

namespace garment::io {
namespace {

using Kind = DxfEntity::Kind;

struct LayerWord {
  const char* word;
  DxfLayer layer;
};
// The longer words first: "sew" is in "sewline", "notch" must not be taken for a line.
constexpr LayerWord kWords[] = {
    {"notch", DxfLayer::notches},
    {"mirror", DxfLayer::mirror},
    {"fold", DxfLayer::mirror},
    {"grain", DxfLayer::grain},
    {"sew", DxfLayer::sew},
    {"stitch", DxfLayer::sew},
    {"seam", DxfLayer::sew},
    {"turn", DxfLayer::turn_points},
    {"curve", DxfLayer::curve_points},
    {"drill", DxfLayer::drill},
    {"cutout", DxfLayer::cutout},
    {"internal", DxfLayer::internal},
    {"annotation", DxfLayer::annotation},
    {"text", DxfLayer::annotation},
    {"boundary", DxfLayer::boundary},
    {"outline", DxfLayer::boundary},
    {"contour", DxfLayer::boundary},
    {"cut", DxfLayer::boundary},
};

constexpr std::size_t kMaxFacts = 200, kMaxFact = 200;

std::string trim(std::string text) {
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.pop_back();
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.erase(0, 1);
  return text;
}

/// MTEXT without its formatting: "{\\fArial;Size: M}" is "Size: M"; \\P ends a line.
std::vector<std::string> plain_lines(const std::string& text) {
  std::vector<std::string> lines(1);
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\\' && i + 1 < text.size()) {
      const char code = text[++i];
      if (code == 'P' && lines.size() < kMaxFacts)
        lines.emplace_back();
      else if (std::string_view("AaCcFfHhQqTtWwp").find(code) != std::string_view::npos &&
               text.find(';', i) != std::string::npos)
        i = text.find(';', i);
      else if (std::string_view("\\LlOoKk").find(code) == std::string_view::npos)
        lines.back() += code;
    } else if (c != '{' && c != '}') {
      lines.back() += c;
    }
  }
  return lines;
}

/// Takes "Key: value" into `facts`; other text as an annotation.
void add_fact(std::map<std::string, std::string>& facts, const std::string& text) {
  if (facts.size() >= kMaxFacts) return;
  if (text.find('\\') != std::string::npos) {
    for (const std::string& line : plain_lines(text)) add_fact(facts, line);
    return;
  }
  if (trim(text).starts_with("#")) return;  // the number of a grade rule
  const std::size_t colon = text.find(':');
  std::string key = colon == std::string::npos ? "annotation" : lower(trim(text.substr(0, colon)));
  std::string value = trim(colon == std::string::npos ? text : text.substr(colon + 1));
  std::replace(key.begin(), key.end(), '_', ' ');
  if (value.empty() || key.empty()) return;
  if (value.size() > kMaxFact) {
    std::size_t end = kMaxFact;
    while (end > 0 && (static_cast<unsigned char>(value[end]) & 0xC0) == 0x80) --end;
    value.resize(end);
  }
  std::string& fact = facts[key];
  if (fact.empty())
    fact = value;
  else if (key == "annotation" && fact.size() < kMaxFact)
    fact += ", " + value;
}

std::string fact(const std::map<std::string, std::string>& facts, std::initializer_list<const char*> keys) {
  for (const char* key : keys)
    if (const auto found = facts.find(key); found != facts.end()) return found->second;
  return {};
}

/// With `any_layer` what is on no layer of the standards is taken for the boundary.
void add_entity(DxfPiece& piece, const DxfEntity& e, bool any_layer = false) {
  DxfLayer layer = dxf_layer(e.layer);
  if (any_layer && layer == DxfLayer::none) layer = DxfLayer::boundary;
  if (e.kind == Kind::text) return add_fact(piece.facts, e.text);
  if (e.kind == Kind::point) return piece.points[layer].push_back(e.points[0].point);
  DxfCourse c;
  c.points = course(e, c.closed);
  if (c.points.size() == 1 && !c.closed)
    piece.points[layer].push_back(c.points[0].point);
  else if (!c.points.empty())
    piece.courses[layer].push_back(std::move(c));
}

bool has_course(const DxfPiece& piece, DxfLayer layer) {
  const auto found = piece.courses.find(layer);
  return found != piece.courses.end() && !found->second.empty();
}

/// The last part of a name that is set off: "FRONT-38" is FRONT and 38.
std::size_t size_split(const std::string& name) {
  const std::size_t at = name.find_last_of("-_ .");
  return at == std::string::npos || at == 0 || at + 1 == name.size() ? std::string::npos : at;
}

/// Sizes from block names, where no text states them: the last parts of names that are taken for several
/// pieces, or that are the sample size.
void split_names(DxfStyle& style, const std::string& sample) {
  std::map<std::string, std::set<std::string>> sizes_of;  // by first part
  for (const DxfPiece& piece : style.pieces)
    if (piece.size.empty())
      if (const std::size_t at = size_split(piece.name); at != std::string::npos)
        sizes_of[piece.name.substr(0, at)].insert(piece.name.substr(at + 1));
  std::size_t most = 0;
  for (const auto& [base, sizes] : sizes_of) most = std::max(most, sizes.size());
  for (DxfPiece& piece : style.pieces) {
    if (!piece.size.empty()) continue;
    const std::size_t at = size_split(piece.name);
    if (at == std::string::npos) continue;
    const std::string base = piece.name.substr(0, at), size = piece.name.substr(at + 1);
    const bool graded = most >= 2 && sizes_of[base].size() == most && sizes_of.size() * most >= 4;
    if (!graded && !(!sample.empty() && lower(size) == lower(sample))) continue;
    piece.name = base;
    piece.size = size;
  }
}

/// A file without blocks: every closed course of the boundary is a piece, and what lies in its box belongs to
/// it.
void loose_pieces(const std::vector<DxfEntity>& entities, DxfStyle& style) {
  struct Box {
    Point2 low{1e300, 1e300}, high{-1e300, -1e300};
    void grow(const Point2& p) { low = low.cwiseMin(p), high = high.cwiseMax(p); }
    bool holds(const Point2& p) const {
      return (p.array() >= low.array()).all() && (p.array() <= high.array()).all();
    }
  };
  std::vector<Box> boxes;
  constexpr std::size_t kMost = 4096;
  for (const DxfEntity& e : entities) {
    bool closed = false;
    const std::vector<DxfVertex> points = course(e, closed);
    const bool loop =
        points.size() > 2 && (closed || (points.front().point - points.back().point).norm() < 1e-6);
    if (dxf_layer(e.layer) != DxfLayer::boundary || !loop || boxes.size() >= kMost) continue;
    Box box;
    for (const DxfVertex& v : points) box.grow(v.point);
    boxes.push_back(box);
    DxfPiece piece;
    piece.name = fmt::format("piece_{}", boxes.size());
    piece.line = e.line;
    add_entity(piece, e);
    style.pieces.push_back(std::move(piece));
  }
  if (boxes.empty()) {  // lines that are still to be chained
    DxfPiece piece;
    piece.name = "piece";
    for (const DxfEntity& e : entities) add_entity(piece, e);
    if (has_course(piece, DxfLayer::boundary)) style.pieces.push_back(std::move(piece));
    return;
  }
  for (const DxfEntity& e : entities) {
    if (dxf_layer(e.layer) == DxfLayer::boundary && e.kind != Kind::text) continue;
    const Point2 at = e.points.empty() ? Point2(1e300, 1e300) : e.points[0].point;
    std::size_t best = boxes.size();
    for (std::size_t b = 0; b < boxes.size(); ++b)
      if (boxes[b].holds(at) && (best == boxes.size() || (boxes[b].high - boxes[b].low).prod() <
                                                             (boxes[best].high - boxes[best].low).prod()))
        best = b;
    if (best < boxes.size()) add_entity(style.pieces[best], e);
  }
  for (DxfPiece& piece : style.pieces)
    if (const std::string name = fact(piece.facts, {"piece name", "name"}); !name.empty()) piece.name = name;
}

bool is_space(const std::string& block) {
  const std::string name = lower(block);
  return name.ends_with("model_space") || name.ends_with("paper_space");
}

/// A piece of each block that has a boundary; false, and an error, where they are too large.
bool add_blocks(const DxfDocument& document, const DxfLimits& limits, bool any_layer, DxfStyle& style,
                PatternReport& report) {
  std::set<std::string> inserted;  // into other blocks: parts of pieces, no pieces
  for (const DxfBlock& block : document.blocks)
    for (const DxfEntity& e : block.entities)
      if (e.kind == Kind::insert && !is_space(block.name)) inserted.insert(e.text);
  std::size_t budget = limits.max_points;
  for (const DxfBlock& block : document.blocks) {
    if (inserted.contains(block.name) || is_space(block.name)) continue;
    const std::vector<DxfEntity> entities = flattened(document, block.entities, limits, report);
    if (entities.size() > budget) {
      report.error("G0962",
                   fmt::format("line {}: blocks hold more than {} entities, with those inserted into them",
                               block.line, limits.max_points),
                   "is this the right file?");
      return false;
    }
    budget -= entities.size();
    DxfPiece piece;
    piece.line = block.line;
    for (const DxfEntity& e : entities) add_entity(piece, e, any_layer);
    if (!has_course(piece, DxfLayer::boundary) && !has_course(piece, DxfLayer::sew)) continue;
    piece.name = fact(piece.facts, {"piece name", "piecename", "name"});
    if (piece.name.empty()) piece.name = block.name;
    piece.size = fact(piece.facts, {"size"});
    style.pieces.push_back(std::move(piece));
  }
  return true;
}

}  // namespace

std::string lower(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

DxfLayer dxf_layer(const std::string& name) {
  const std::string low = lower(name);
  std::size_t first = 0;
  if (low.size() > 1 && low[0] == 'l' && low[1] >= '0' && low[1] <= '9') first = 1;
  std::size_t end = first;
  int number = 0;
  while (end < low.size() && low[end] >= '0' && low[end] <= '9' && end < first + 6)
    number = 10 * number + (low[end++] - '0');
  if (end > first &&
      (end == low.size() || low[end] == '_' || low[end] == ' ' || low[end] == '-' || low[end] == '.')) {
    if (number >= 80 && number <= 83) return DxfLayer::notches;
    switch (number) {
      case 1:
      case 2:
      case 3:
      case 4:
      case 5:
      case 6:
      case 7:
      case 8:
      case 11:
      case 13:
      case 14:
      case 15:
        return static_cast<DxfLayer>(number);
      default:
        return DxfLayer::none;
    }
  }
  for (const LayerWord& w : kWords)
    if (low.find(w.word) != std::string::npos) return w.layer;
  return DxfLayer::none;
}

DxfStyle dxf_style(const DxfDocument& document, const DxfLimits& limits, PatternReport& report) {
  DxfStyle style;
  for (const DxfEntity& e : document.entities)
    if (e.kind == Kind::text) add_fact(style.facts, e.text);
  if (!add_blocks(document, limits, false, style, report)) return {};
  if (style.pieces.empty()) loose_pieces(flattened(document, document.entities, limits, report), style);
  if (style.pieces.empty()) {
    if (!add_blocks(document, limits, true, style, report)) return {};
    if (!style.pieces.empty())
      report.note(
          "nothing lies on the layers of AAMA and ASTM: the largest closed line of each block is taken");
  }
  // Some systems state the style in every piece.
  for (const DxfPiece& piece : style.pieces)
    for (const char* key : {"units", "sample size", "style name"})
      if (const std::string value = fact(piece.facts, {key});
          !value.empty() && fact(style.facts, {key}).empty())
        style.facts[key] = value;
  split_names(style, fact(style.facts, {"sample size", "base size"}));
  for (const DxfPiece& piece : style.pieces)
    if (!piece.size.empty() &&
        std::find(style.sizes.begin(), style.sizes.end(), piece.size) == style.sizes.end())
      style.sizes.push_back(piece.size);
  return style;
}

}  // namespace garment::io
