#include "interpreter/language/seam_relations.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "interpreter/language/clauses.hpp"
#include "interpreter/language/edges.hpp"
#include "interpreter/language/evaluate.hpp"

namespace garment::interpreter {
namespace {

constexpr double kPlainTolerance = 2e-3;   // m, sides without a relation
constexpr double kStatedTolerance = 0.01;  // of the length, sides with one

/// True where the link is walked as it was drawn. A single edge counts from its drawn start; in a chain every
/// link runs with its loop.
bool walked_as_drawn(const Program& program, const SeamSideDraft& side, std::size_t link) {
  if (side.edge.spans.size() == 1) return true;
  const EdgeSpan& span = side.edge.spans[link];
  const EdgeSpan turned = counter_clockwise(program, span);
  const bool as_drawn = turned.parts.empty() || (turned.parts[0].from == span.parts[0].from);
  return as_drawn != span.backwards;
}

/// Position of a named mark along the side as written, of a mirrored one along its image.
std::optional<double> mark_on(const Program& program, const SeamSideDraft& side, std::string_view name) {
  const double length = cut_length(side.edge);
  if (name == "start") return 0.0;
  if (name == "end") return length;
  double done = 0;
  for (std::size_t k = 0; k < side.edge.spans.size(); ++k) {
    const EdgeSpan& span = side.edge.spans[k];
    if (const auto at = notch_position(program, span, name)) {
      const double walked = done + (walked_as_drawn(program, side, k) ? *at : cut_length(span) - *at);
      return side.mirrored ? length - walked : walked;
    }
    done += cut_length(span);
  }
  return std::nullopt;
}

void take_range(Program& program, Scope& scope, const SeamSideDraft& side, const Expr& list,
                PartRelation& part) {
  if (list.kind != ExprKind::list || list.children.size() != 1 || list.children[0].kind != ExprKind::range)
    fail(program, Message("G0313", "after its value a relation takes the part that it holds for", list.span)
                      .help("as in `ease 6% [notch_f .. notch_b]`"));
  const double length = cut_length(side.edge);
  auto position = [&](const Expr& expr) {
    auto mark = [&](std::string_view name) { return mark_on(program, side, name); };
    // A name that is no mark of the side may be a value of the script.
    if (expr.kind == ExprKind::name && !mark(expr.text) && find_local(scope, expr.text) == nullptr &&
        find_declaration(scope, expr.text) == nullptr)
      fail(program, Message("G0301", "there is no mark `" + expr.text + "` on this side", expr.span)
                        .help("marks are start, end and the notches of the side's edges"));
    const double at = eval_position(program, {expr}, scope, length, mark, expr.span, "a part of a side");
    if (!(at >= -1e-6 && at <= length + 1e-6))
      fail(program,
           Message("G0309",
                   format_quantity(at, kLength) + " along a side of " + format_quantity(length, kLength),
                   expr.span));
    return std::clamp(at, 0.0, length);
  };
  part.from = position(list.children[0].children[0]);
  part.to = position(list.children[0].children[1]);
  if (!(part.to - part.from > 1e-6))
    fail(program,
         Message("G0309",
                 "a part from " + format_quantity(part.from, kLength) + " to " +
                     format_quantity(part.to, kLength) + " has no length",
                 list.span)
             .help(
                 side.edge.spans.size() > 1
                     ? "in a chain, parts run the way the chain is walked: counter-clockwise round each panel"
                     : "parts run in the drawn direction, from the smaller to the larger position"));
  if (side.mirrored) {
    std::swap(part.from, part.to);
    part.from = length - part.from;
    part.to = length - part.to;
  }
}

double factor_of(const std::string& word, double x) {
  if (word == "ease") return 1 + x;
  return word == "gather" ? x : 1 / (1 + x);
}

std::string percent(double x) { return format_quantity(std::round(1000 * x) / 1000, kNumber, true); }

/// "`ease 6%`" for a side that is `ratio` times the seam.
std::string relation_for(double ratio, bool gathered) {
  if (gathered && ratio >= 1) return "gather " + format_quantity(ratio, kNumber, false, 3);
  return ratio >= 1 ? "ease " + percent(ratio - 1) : "stretch " + percent(1 / ratio - 1);
}

class LengthCheck {
 public:
  LengthCheck(Program& program, const std::string& seam, const SeamSideDraft& side, const SeamSideDraft& last)
      : program_(program), seam_(seam), side_(side), last_(last) {
    length_ = plain_length(program, side);
    other_ = plain_length(program, last);
    wanted_ = side.factor / last.factor * other_;
  }

  bool holds() const {
    const double tolerance =
        stated() ? std::max(kPlainTolerance, kStatedTolerance * wanted_) : kPlainTolerance;
    return std::fabs(length_ - wanted_) <= tolerance + 1e-9;
  }

  void say() const {
    const double excess = length_ - wanted_;
    Message message("G0501",
                    "seam `" + seam_ + "` is " + format_mm(std::fabs(excess)) +
                        (excess > 0 ? " too long" : " too short") + " on the `" + show(Value{side_.edge}) +
                        "` side",
                    side_.expr->span, lengths(side_));
    message.also(last_.expr->span, expected());
    report(program_, message.help(remedy()));
  }

 private:
  bool stated() const { return side_.related() || last_.related(); }

  /// "224 mm + 252 mm".
  std::string lengths(const SeamSideDraft& side) const {
    std::string text;
    for (const EdgeSpan& span : side.edge.spans)
      text += (text.empty() ? "" : " + ") + format_mm(sewn_length(program_, span));
    if (!side.parts.empty()) text += ", laid flat " + format_mm(plain_length(program_, side));
    return text;
  }

  std::string relation_text(const SeamSideDraft& side) const {
    if (side.relation == nullptr) return "";
    return std::string(program_.sources.text(side.relation->span));
  }

  std::string expected() const {
    std::string text = lengths(last_);
    const std::string one = relation_text(side_), two = relation_text(last_);
    if (one.empty() && two.empty()) return text;
    return text + ", with " + one + (one.empty() || two.empty() ? "" : " and ") + two + ' ' +
           format_mm(wanted_);
  }

  /// The figure of the one partial relation that would make the sides fit.
  std::string part_remedy() const {
    const PartRelation& part = side_.parts[0];
    double inside = 0;
    for (const SidePiece& piece : pieces_along(program_, side_, false))
      if (piece.fullness == part.factor) inside += sewn_length(program_, piece.span);
    const double flat = inside / part.factor - (length_ - wanted_);
    if (!(flat > 0) || inside / flat > 10 || inside / flat < 0.5) return "make the sides alike";
    return "`" + relation_for(inside / flat, part.clause->word.text == "gather") + "` on that part would fit";
  }

  /// The side as it is written: what can be pasted into the seam, of both halves too.
  std::string written(const SeamSideDraft& side) const { return std::string(program_.sources.text(side.expr->span)); }

  /// `written` with the relation that makes it fit; `ratio` is its length over that of the seam.
  std::string with_relation(const SeamSideDraft& side, double ratio, bool gathered) const {
    return "`" + written(side) + ' ' + relation_for(ratio, gathered) + "`";
  }

  std::string remedy() const {
    if (other_ <= 0 || length_ <= 0) return "a side has no length";
    if (stated() && side_.parts.empty() && last_.parts.empty() && std::fabs(length_ - other_) <= kPlainTolerance) {
      const std::string one = relation_text(side_), two = relation_text(last_);
      return "the sides are as long without it: leave `" + (one.empty() ? two : one) + "` out";
    }
    if (side_.parts.size() == 1 && !last_.related()) return part_remedy();
    const double ratio = length_ / other_ * last_.factor;  // of this side, the other's relation kept
    const bool longer = length_ > other_;
    const SeamSideDraft& related = side_.relation != nullptr ? side_ : last_;
    const bool one_related = (side_.relation != nullptr) != (last_.relation != nullptr) && side_.parts.empty() && last_.parts.empty();
    if (one_related && related.factor > 1 && (&related == &side_) != longer)
      return "`" + relation_text(related) + "` stands at the shorter side; it belongs to the longer one: " +
             with_relation(longer ? side_ : last_, longer ? length_ / other_ : other_ / length_, related.relation->word.text == "gather");
    if (side_.relation != nullptr && !last_.related())
      return "`" + relation_for(ratio, side_.relation->word.text == "gather") + "` would fit";
    if (ratio > 1.3) return "make the sides alike, or gather: " + with_relation(side_, ratio, true);
    if (ratio > 1) return "make the sides alike, or state the difference: " + with_relation(side_, ratio, false);
    return "make the sides alike, or state the difference on the longer side: `" + written(last_) + " ease " +
           percent(last_.factor / ratio - 1) + "`";
  }

  Program& program_;
  const std::string& seam_;
  const SeamSideDraft &side_, &last_;
  double length_ = 0, other_ = 0, wanted_ = 0;
};

}  // namespace

std::vector<SidePiece> pieces_along(const Program& program, const SeamSideDraft& side, bool against) {
  std::vector<SidePiece> pieces;
  double done = 0;
  for (std::size_t k = 0; k < side.edge.spans.size(); ++k) {
    const EdgeSpan& span = side.edge.spans[k];
    const double length = cut_length(span);
    const bool as_drawn = walked_as_drawn(program, side, k);
    std::vector<double> cuts = {0, length};
    for (const PartRelation& part : side.parts)
      for (double at : {part.from - done, part.to - done})
        if (at > 1e-6 && at < length - 1e-6) cuts.push_back(as_drawn ? at : length - at);
    std::sort(cuts.begin(), cuts.end());
    std::vector<SidePiece> own;
    for (std::size_t c = 0; c + 1 < cuts.size(); ++c) {
      if (cuts[c + 1] - cuts[c] < 1e-9) continue;
      SidePiece piece{cuts.size() == 2 ? span : sub_span(span, cuts[c], cuts[c + 1]), 1};
      const double middle = (cuts[c] + cuts[c + 1]) / 2, along = done + (as_drawn ? middle : length - middle);
      for (const PartRelation& part : side.parts)
        if (along > part.from && along < part.to) piece.fullness = part.factor;
      own.push_back(std::move(piece));
    }
    const EdgeSpan turned = counter_clockwise(program, span);
    const bool flip = (turned.parts.empty() || turned.parts[0].from == span.parts[0].from) == span.backwards;
    if (flip) {
      std::reverse(own.begin(), own.end());
      for (SidePiece& piece : own) piece.span = reversed(piece.span);
    }
    pieces.insert(pieces.end(), own.begin(), own.end());
    done += length;
  }
  if (against) {
    std::reverse(pieces.begin(), pieces.end());
    for (SidePiece& piece : pieces) piece.span = reversed(piece.span);
  }
  return pieces;
}

double plain_length(const Program& program, const SeamSideDraft& side) {
  if (side.parts.empty()) return sewn_length(program, side.edge);
  double sum = 0;
  for (const SidePiece& piece : pieces_along(program, side, false))
    sum += sewn_length(program, piece.span) / piece.fullness;
  return sum;
}

void take_relation(Program& program, Scope& scope, SeamSideDraft& side, const Clause& clause,
                   const Override* change) {
  const std::string& word = clause.word.text;
  const ClauseRecord& record = *find_clause(*find_construct("seam"), word);
  if (clause.values.empty())
    fail(program, Message("G0312", "`" + word + "` needs a value", clause.word.span));
  if (clause.values.size() > 2)
    fail(program,
         Message("G0313", "`" + word + "` takes a value and the part it holds for", clause.values[2].span));
  const Expr& expr = change != nullptr ? *change->value : clause.values[0];
  const Quantity q =
      eval_quantity(program, expr, change != nullptr ? *change->scope : scope, kNumber, "`" + word + "`");
  const double factor = factor_of(word, checked_quantity(program, record, q, expr.span));
  const bool on_part = clause.values.size() == 2;
  if (side.relation != nullptr || (!on_part && !side.parts.empty()))
    fail(program, Message("G0314", "the side has two relations", clause.span)
                      .also(side.relation != nullptr ? side.relation->span : side.parts[0].clause->span,
                            "first here"));
  if (!on_part) {
    side.relation = &clause;
    side.factor = factor;
    return;
  }
  PartRelation part{&clause, factor, 0, 0};
  take_range(program, scope, side, clause.values[1], part);
  for (const PartRelation& other : side.parts)
    if (part.from < other.to - 1e-6 && other.from < part.to - 1e-6)
      fail(program,
           Message("G0516", "two relations hold for the same part of the side", clause.values[1].span)
               .also(other.clause->values[1].span, "also here")
               .help("let one end where the other begins"));
  side.parts.push_back(part);
}

bool check_side_lengths(Program& program, const std::string& seam, const std::vector<SeamSideDraft>& sides) {
  bool good = true;
  for (std::size_t k = 0; k + 1 < sides.size(); ++k) {
    const LengthCheck check(program, seam, sides[k], sides.back());
    if (check.holds()) continue;
    check.say();
    good = false;
  }
  return good;
}

}  // namespace garment::interpreter
