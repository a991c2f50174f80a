// The words of a region, `within 10 cm of waist and above (0, 20 cm)`, to a tree of shapes on one panel.
#include <algorithm>

#include "interpreter/language/edges.hpp"
#include "interpreter/language/evaluate.hpp"
#include "interpreter/language/regions.hpp"

namespace garment::interpreter {
namespace {

using design::RegionShape;
using RegionKind = RegionShape::Kind;

constexpr const char* kShapes =
    "shapes are `within 5 cm of EDGE`, `above P`, `below P`, `left of LINE`, `right of LINE`, "
    "`circle(CENTRE, RADIUS)`, "
    "`polygon(P, Q, R, ...)`";
constexpr double kLongest = 100;  // m

bool is_word(std::string_view word) {
  static const char* const words[] = {"within", "of",  "above", "below", "left",
                                      "right",  "and", "or",    "minus", "not"};
  return std::any_of(std::begin(words), std::end(words), [&](const char* w) { return word == w; });
}

/// A word of the shape language, or a value (`expr`).
struct Token {
  std::string word;
  const Expr* expr = nullptr;
  Span span;
};

void add_value(const Expr& value, bool may_be_word, std::vector<Token>& tokens) {
  const bool sign = value.kind == ExprKind::unary && (value.text == "not" || value.text == "minus");
  if (sign && value.children[0].kind == ExprKind::name && is_word(value.children[0].text)) {
    tokens.push_back({value.text, nullptr, value.span});
    return add_value(value.children[0], true, tokens);
  }
  if (may_be_word && value.kind == ExprKind::name && is_word(value.text))
    tokens.push_back({value.text, nullptr, value.span});
  else
    tokens.push_back({"", &value, value.span});
}

std::vector<Token> tokens_of(const Statement& statement) {
  std::vector<Token> tokens;
  bool begun = false;
  for (const Clause& clause : statement.clauses) {
    const bool colon = clause.word.text == ":";
    begun = begun || colon;
    if (!begun) continue;
    if (!colon) tokens.push_back({clause.word.text, nullptr, clause.word.span});
    for (const Expr& value : clause.values) add_value(value, colon, tokens);
  }
  return tokens;
}

RegionShape leaf(RegionKind kind) {
  RegionShape shape;
  shape.kind = kind;
  return shape;
}

/// Two shapes joined by `kind`, flat where it can be, without what holds nowhere or everywhere.
RegionShape joined(RegionKind kind, RegionShape first, RegionShape next) {
  const bool none = first.kind == RegionKind::nowhere, all = first.kind == RegionKind::everywhere;
  const bool next_none = next.kind == RegionKind::nowhere, next_all = next.kind == RegionKind::everywhere;
  if (kind == RegionKind::all_of) {
    if (none || next_all) return first;
    if (next_none || all) return next;
  } else if (kind == RegionKind::any_of) {
    if (all || next_none) return first;
    if (next_all || none) return next;
  } else {
    if (none || next_none) return first;
    if (next_all) return leaf(RegionKind::nowhere);
  }
  if (first.kind == kind) {
    first.children.push_back(std::move(next));
    return first;
  }
  RegionShape shape = leaf(kind);
  shape.children.push_back(std::move(first));
  shape.children.push_back(std::move(next));
  return shape;
}

RegionShape opposite(RegionShape shape) {
  if (shape.kind == RegionKind::nowhere) return leaf(RegionKind::everywhere);
  if (shape.kind == RegionKind::everywhere) return leaf(RegionKind::nowhere);
  RegionShape result = leaf(RegionKind::opposite);
  result.children.push_back(std::move(shape));
  return result;
}

class ShapeReader {
 public:
  ShapeReader(Program& program, const Statement& statement, Scope& scope, const PanelPart& on,
              const std::vector<PanelPart>& others)
      : program_(program),
        statement_(statement),
        on_(on),
        others_(others),
        info_(program.panels[static_cast<std::size_t>(on.panel)]),
        tokens_(tokens_of(statement)) {
    scope_.parent = &scope;
    scope_.module = scope.module;
    scope_.half = scope.half;
    name_members();
  }

  RegionShape read() {
    if (tokens_.empty())
      fail(program_, Message("G1101", "the region has no shape", statement_.keyword.span)
                         .help("write `region NAME in PANEL: SHAPE`; " + std::string(kShapes)));
    RegionShape shape = read_any();
    if (at_ < tokens_.size()) {
      const Token& extra = tokens_[at_];
      fail(program_, Message("G1101", "a shape ends before `" + text_of(extra) + "`", extra.span)
                         .help("join shapes by `and`, `or`, `minus`, `not`"));
    }
    return shape;
  }

 private:
  // ---- names of the panel itself: `waist`, `roll`, `hip`

  /// On a panel on the fold, names mean what was drawn.
  std::string drawn_half() const {
    if (!info_.folded || info_.panel.edges.empty()) return "";
    return info_.panel.edges[0].name.starts_with("left.") ? "left" : "right";
  }

  int drawn_side() const {
    if (!info_.folded) return 0;
    return (drawn_half() == "left") != info_.on_back ? 1 : -1;
  }

  void name_members() {
    const std::string half = drawn_half(), prefix = half.empty() ? "" : half + '.';
    for (const NamedEdge& edge : info_.edges) {
      if (edge.half != half) continue;
      EdgeSpan span;
      span.panel = on_.panel;
      span.name = info_.panel.name + '.' + edge.name;
      span.parts = edge.parts;
      scope_.values.emplace(edge.name, Value{EdgeValue{{span}}});
    }
    for (const design::InteriorPoint& point : info_.panel.points)
      if (point.name.starts_with(prefix))
        scope_.values.emplace(
            point.name.substr(prefix.size()),
            Value{PointValue{{point.point.x(), point.point.y(), 0}, 2, kLength, on_.panel}});
  }

  /// The value speaks of this panel by the names of its block, so it holds for both halves.
  bool is_bare(const Expr& expr) const {
    const Expr* root = &expr;
    while (root->kind != ExprKind::name && !root->children.empty()) root = &root->children[0];
    return root->kind == ExprKind::name && scope_.values.contains(root->text);
  }

  // ---- the grammar: or, then and / minus, then not, then one shape

  bool next_is(const char* word) const { return at_ < tokens_.size() && tokens_[at_].word == word; }
  bool take(const char* word) {
    if (!next_is(word)) return false;
    ++at_;
    return true;
  }

  std::string text_of(const Token& token) const { return std::string(program_.sources.text(token.span)); }

  RegionShape read_any() {
    RegionShape shape = read_all();
    while (take("or")) shape = joined(RegionKind::any_of, std::move(shape), read_all());
    return shape;
  }

  RegionShape read_all() {
    RegionShape shape = read_one();
    while (true) {
      if (take("and"))
        shape = joined(RegionKind::all_of, std::move(shape), read_one());
      else if (take("minus"))
        shape = joined(RegionKind::minus, std::move(shape), read_one());
      else
        return shape;
    }
  }

  RegionShape read_one() {
    count_step(program_, statement_.span);
    if (at_ >= tokens_.size()) {
      const Token& last = tokens_.back();
      fail(program_,
           Message("G1101", "a shape is missing after `" + text_of(last) + "`", last.span).help(kShapes));
    }
    if (take("not")) return opposite(read_one());
    const Token& token = tokens_[at_++];
    if (token.expr != nullptr) return read_value(*token.expr);
    if (token.word == "within") return read_within();
    if (token.word == "above" || token.word == "below")
      return make_height(token.word, argument(token.word, "a point"));
    if (token.word == "left" || token.word == "right") {
      if (!take("of"))
        fail(program_, Message("G1101", "`" + token.word + "` needs `of LINE`", token.span)
                           .help("as in `" + token.word + " of roll`"));
      return make_side(token.word, argument("of", "an edge or line"));
    }
    fail(program_,
         Message("G1101", "`" + token.word + "` stands where a shape is expected", token.span).help(kShapes));
  }

  const Expr& argument(const std::string& word, const std::string& wanted) {
    const Span span = tokens_[at_ - 1].span;
    if (at_ >= tokens_.size() || tokens_[at_].expr == nullptr)
      fail(program_, Message("G1101", "`" + word + "` needs " + wanted, span).help(kShapes));
    return *tokens_[at_++].expr;
  }

  RegionShape read_within() {
    const Expr& distance = argument("within", "a distance");
    if (!take("of"))
      fail(program_, Message("G1101", "`within` needs `of EDGE` after its distance", distance.span)
                         .help("as in `within 10 cm of waist`"));
    return make_near(distance, argument("of", "an edge, line or point"));
  }

  /// A shape written as a value: a call, another region, or a group in parentheses.
  RegionShape read_value(const Expr& expr) {
    count_step(program_, expr.span);
    if (expr.kind == ExprKind::binary && (expr.text == "and" || expr.text == "or" || expr.text == "minus")) {
      const RegionKind kind = expr.text == "or" ? RegionKind::any_of : expr.text == "and" ? RegionKind::all_of : RegionKind::minus;
      RegionShape first = read_value(expr.children[0]);
      return joined(kind, std::move(first), read_value(expr.children[1]));
    }
    if (expr.kind == ExprKind::unary && expr.text == "not") return opposite(read_value(expr.children[0]));
    if (expr.kind == ExprKind::call && expr.children[0].kind == ExprKind::name) {
      const std::string& name = expr.children[0].text;
      const auto arguments = expr.children.size() - 1;
      auto need = [&](std::size_t count, const char* form) {
        if (arguments != count)
          fail(program_, Message("G1101", "the shape is written `" + std::string(form) + "`", expr.span));
      };
      if (name == "circle")
        return need(2, "circle(CENTRE, RADIUS)"), make_circle(expr.children[1], expr.children[2]);
      if (name == "within")
        return need(2, "within(DISTANCE, EDGE)"), make_near(expr.children[1], expr.children[2]);
      if (name == "above" || name == "below")
        return need(1, "above(POINT)"), make_height(name, expr.children[1]);
      if (name == "left_of" || name == "right_of")
        return need(1, "left_of(LINE)"), make_side(name.substr(0, name.find('_')), expr.children[1]);
      if (name == "polygon") return make_polygon(expr);
    }
    if (expr.kind == ExprKind::name && find_local(scope_, expr.text) == nullptr &&
        find_declaration(scope_, expr.text) == nullptr) {
      const std::string hint = did_you_mean(expr.text, {"within", "above", "below", "left", "right", "circle",
                                                        "polygon", "not", "left_of", "right_of"});
      if (!hint.empty())
        fail(program_,
             Message("G0301", "there is no shape or region `" + expr.text + "`", expr.span).help(hint));
    }
    return take_region(expr);
  }

  // ---- shapes

  RegionShape take_region(const Expr& expr) {
    const int index = eval_region(program_, expr, scope_, "a region's shape");
    for (const design::RegionPart& part : program_.garment.regions[static_cast<std::size_t>(index)].parts)
      if (part.panel == on_.panel) return part.shape;
    return leaf(RegionKind::nowhere);
  }

  double length(const Expr& expr, const char* what, double least) {
    const double x = eval_quantity(program_, expr, scope_, kLength, what).value;
    if (!(x >= least && x <= kLongest))
      fail(program_,
           Message("G0309",
                   std::string(what) + " is " + format_quantity(x, kLength) + "; it must lie in " +
                       format_quantity(least, kLength) + " .. " + format_quantity(kLongest, kLength),
                   expr.span));
    return x;
  }

  /// Point of this panel; nothing where it lies on another panel of the region.
  std::optional<design::Point2> point(const Expr& expr, RegionShape& shape, const char* what) {
    const PointValue p = eval_point(program_, expr, scope_, 2, kLength, what);
    if (p.panel >= 0 && !is_here(p.panel, expr.span)) return std::nullopt;
    if (p.panel < 0 || is_bare(expr)) shape.drawn_side = drawn_side();
    return design::Point2(p.at[0], p.at[1]);
  }

  bool is_here(int panel, Span span) {
    if (panel == on_.panel) return true;
    for (const PanelPart& other : others_)
      if (other.panel == panel) return false;
    const std::string& name = program_.panels[static_cast<std::size_t>(panel)].panel.name;
    fail(program_,
         Message("G1104", "this lies on panel `" + name + "`, which the region does not speak of", span)
             .help("write `in " + info_.panel.name + ", " + name + "`, or take a place of `" +
                   info_.panel.name + "`"));
  }

  /// Parts of edges of this panel; empty where they are of another panel of the region.
  std::vector<design::EdgePart> lines(const Expr& expr, const EdgeValue& edge, RegionShape& shape) {
    std::vector<design::EdgePart> parts;
    for (const EdgeSpan& span : edge.spans) {
      if (!is_here(span.panel, expr.span)) continue;
      const EdgeSpan walked = span.backwards ? reversed(span) : span;
      parts.insert(parts.end(), walked.parts.begin(), walked.parts.end());
    }
    if (is_bare(expr)) shape.drawn_side = drawn_side();
    return parts;
  }

  RegionShape make_near(const Expr& distance, const Expr& target) {
    RegionShape shape = leaf(RegionKind::near);
    shape.size = length(distance, "`within`", 1e-4);
    const Value value = eval(program_, target, scope_);
    if (value.as<PointValue>() != nullptr) {
      const auto p = point(target, shape, "`of`");
      if (!p) return leaf(RegionKind::nowhere);
      shape.points.push_back(*p);
      return shape;
    }
    const auto* edge = value.as<EdgeValue>();
    if (edge == nullptr) fail_target(target, value, "`of` takes an edge, line or point");
    shape.parts = lines(target, *edge, shape);
    return shape.parts.empty() ? leaf(RegionKind::nowhere) : shape;
  }

  [[noreturn]] void fail_target(const Expr& expr, const Value& value, const char* wanted) {
    std::string names;
    for (const std::string& name : edge_names(info_)) names += (names.empty() ? "" : ", ") + name;
    fail(program_, Message("G0306", kind_of(value) + " where " + wanted, expr.span)
                       .help("edges and lines of `" + info_.panel.name + "` are " + names));
  }

  RegionShape make_height(const std::string& word, const Expr& expr) {
    RegionShape shape = leaf(word == "above" ? RegionKind::above : RegionKind::below);
    const Value value = eval(program_, expr, scope_);
    if (value.as<Quantity>() != nullptr) {
      shape.size = as_quantity(program_, value, expr.span, kLength, "`" + word + "`").value;
      return shape;
    }
    if (value.as<EdgeValue>() != nullptr)
      fail(program_, Message("G0306", "an edge where `" + word + "` takes a point or a height", expr.span)
                         .help("take one of its points, `" + std::string(program_.sources.text(expr.span)) +
                               ".start`, or `left of` and `right of` it"));
    const auto p = point(expr, shape, word == "above" ? "`above`" : "`below`");
    if (!p) return leaf(RegionKind::nowhere);
    shape.size = p->y();
    return shape;
  }

  /// The right round of a `both` is the image of the left one. Lines keep their way in it, so its left is the image's right.
  bool mirrored() const {
    for (const Scope* at = &scope_; at != nullptr; at = at->parent)
      if (!at->half.empty()) return at->half == "right";
    return false;
  }

  RegionShape make_side(const std::string& word, const Expr& expr) {
    RegionShape shape = leaf((word == "left") != mirrored() ? RegionKind::left_of : RegionKind::right_of);
    const Value value = eval(program_, expr, scope_);
    const auto* edge = value.as<EdgeValue>();
    if (edge == nullptr) fail_target(expr, value, "`of` takes an edge or line");
    shape.parts = lines(expr, *edge, shape);
    return shape.parts.empty() ? leaf(RegionKind::nowhere) : shape;
  }

  RegionShape make_circle(const Expr& centre, const Expr& radius) {
    RegionShape shape = leaf(RegionKind::circle);
    const auto p = point(centre, shape, "the centre of a circle");
    shape.size = length(radius, "the radius", 1e-4);
    if (!p) return leaf(RegionKind::nowhere);
    shape.points.push_back(*p);
    return shape;
  }

  RegionShape make_polygon(const Expr& call) {
    if (call.children.size() < 4)
      fail(program_, Message("G1101",
                             "a polygon has " + std::to_string(call.children.size() - 1) +
                                 " corners; it needs 3 at least",
                             call.span)
                         .help("write `polygon(P, Q, R, ...)`"));
    RegionShape shape = leaf(RegionKind::polygon);
    for (std::size_t k = 1; k < call.children.size(); ++k) {
      const auto p = point(call.children[k], shape, "a corner of a polygon");
      if (!p) return leaf(RegionKind::nowhere);
      shape.points.push_back(*p);
    }
    return shape;
  }

  Program& program_;
  const Statement& statement_;
  PanelPart on_;
  const std::vector<PanelPart>& others_;
  const PanelInfo& info_;
  std::vector<Token> tokens_;
  std::size_t at_ = 0;
  Scope scope_;
};

}  // namespace

RegionShape half_shape(const Program& program, const PanelPart& on) {
  if (on.half.empty()) return RegionShape{};
  const PanelInfo& info = program.panels[static_cast<std::size_t>(on.panel)];
  RegionShape shape = leaf(RegionKind::beyond);  // everything on its side of the fold
  shape.size = info.panel.fold_x.value_or(0);
  shape.sign = (on.half == "left") != info.on_back ? 1 : -1;
  return shape;
}

RegionShape read_region_shape(Program& program, const Statement& statement, Scope& scope, const PanelPart& on,
                              const std::vector<PanelPart>& others) {
  RegionShape shape = ShapeReader(program, statement, scope, on, others).read();
  if (on.half.empty()) return shape;
  return joined(RegionKind::all_of, half_shape(program, on), std::move(shape));
}

}  // namespace garment::interpreter
