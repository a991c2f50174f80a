#include "interpreter/language/seams.hpp"

#include <algorithm>
#include <cmath>

#include "interpreter/language/clauses.hpp"
#include "interpreter/language/edges.hpp"

namespace garment::interpreter {
namespace {

constexpr double kPlainTolerance = 2e-3;   // m, sides without a relation
constexpr double kStatedTolerance = 0.01;  // of the length, sides with one

/// A side as the statement gives it.
struct Side {
  const Expr* expr = nullptr;
  EdgeValue edge;
  const Clause* relation = nullptr;
  double factor = 1;  ///< the side is this many times the seam
  bool reversed = false;
};

class SeamMaker {
 public:
  SeamMaker(Program& program, Declaration& declaration)
      : program_(program),
        declaration_(declaration),
        statement_(*declaration.statement),
        scope_(*declaration.scope) {}

  void make(SeamInfo& info) {
    for (const Clause& clause : statement_.clauses) take(clause);
    if (!statement_.operands.empty())
      fail(program_,
           Message("G0313", "this means nothing before the first side", statement_.operands[0].span));
    if (sides_.size() < 2)
      fail(program_, Message("G0507",
                             "seam `" + declaration_.name + "` has " + std::to_string(sides_.size()) +
                                 (sides_.size() == 1 ? " side" : " sides"),
                             statement_.keyword.span)
                         .help("write `seam NAME: EDGE to EDGE`"));
    info.seam.name = declaration_.name;
    info.seam.origin = program_.origin(statement_.span);
    for (std::size_t k = 0; k < sides_.size(); ++k) {
      info.sides.push_back(sides_[k].edge);
      info.spans.push_back(sides_[k].expr->span);
      info.seam.sides.push_back({program_.origin(sides_[k].expr->span), oriented(sides_[k], k > 0), false});
      info.seam.ratio.push_back(sides_[k].factor / sides_.back().factor);
    }
    check_lengths();
    info.ready = true;
  }

 private:
  void take(const Clause& clause) {
    const std::string& word = clause.word.text;
    if (word == ":" || word == "to") return take_side(clause);
    const ClauseRecord* record = find_clause(*find_construct("seam"), word);
    if (record != nullptr && record->doc.empty())
      fail(program_,
           Message("G0315", "`" + word + "` of `seam` is not supported yet", clause.span).help(kStillToCome));
    if (sides_.empty()) fail(program_, Message("G0313", "`" + word + "` stands after its side", clause.span));
    Side& side = sides_.back();
    if (word == "reversed") {
      if (side.reversed) fail(program_, Message("G0314", "`reversed` is given twice", clause.span));
      if (!clause.values.empty())
        fail(program_, Message("G0313", "`reversed` stands alone", clause.values[0].span));
      side.reversed = true;
      return;
    }
    if (side.relation != nullptr)
      fail(program_, Message("G0314", "the side has two relations", clause.span)
                         .also(side.relation->span, "first here"));
    side.relation = &clause;
    take_relation(side, clause, *record);
  }

  void take_side(const Clause& clause) {
    if (clause.values.size() != 1) {
      const Span span = clause.values.empty() ? clause.word.span : clause.values[1].span;
      fail(program_,
           Message(clause.values.empty() ? "G0312" : "G0313",
                   clause.values.empty() ? "a side of the seam is missing" : "a side is one edge or chain",
                   span)
               .help("chains are written `a + b`"));
    }
    Side side;
    side.expr = &clause.values[0];
    side.edge = eval_edges(program_, *side.expr, scope_, "a side of a seam");
    sides_.push_back(std::move(side));
  }

  void take_relation(Side& side, const Clause& clause, const ClauseRecord& record) {
    if (clause.values.empty())
      fail(program_, Message("G0312", "`" + clause.word.text + "` needs a value", clause.word.span));
    if (clause.values.size() > 1)
      fail(program_,
           Message("G0315", "a relation on part of a side is not supported yet", clause.values[1].span)
               .help("state it for the whole side"));
    const Quantity q =
        eval_quantity(program_, clause.values[0], scope_, kNumber, "`" + clause.word.text + "`");
    const double x = checked_quantity(program_, record, q, clause.values[0].span);
    if (clause.word.text == "ease") side.factor = 1 + x;
    if (clause.word.text == "gather") side.factor = x;
    if (clause.word.text == "stretch") side.factor = 1 / (1 + x);
  }

  /// Parts along the seam. The first side runs counter-clockwise, the others against it.
  std::vector<design::EdgePart> oriented(const Side& side, bool against) const {
    std::vector<design::EdgePart> parts;
    for (const EdgeSpan& span : side.edge.spans) {
      EdgeSpan turned = counter_clockwise(program_, span);
      if (span.backwards) turned = reversed(turned);
      parts.insert(parts.end(), turned.parts.begin(), turned.parts.end());
    }
    if (against != side.reversed) {
      std::reverse(parts.begin(), parts.end());
      for (design::EdgePart& part : parts) std::swap(part.from, part.to);
    }
    return parts;
  }

  /// "224 mm + 252 mm".
  std::string lengths(const Side& side) const {
    std::string text;
    for (const EdgeSpan& span : side.edge.spans)
      text += (text.empty() ? "" : " + ") + format_mm(sewn_length(program_, span));
    return text;
  }

  std::string relation_text(const Side& side) const {
    if (side.relation == nullptr) return "";
    return std::string(program_.sources.text(side.relation->span));
  }

  void check_lengths() {
    const Side& last = sides_.back();
    for (std::size_t k = 0; k + 1 < sides_.size(); ++k) {
      const Side& side = sides_[k];
      const double length = sewn_length(program_, side.edge), other = sewn_length(program_, last.edge);
      const double wanted = side.factor / last.factor * other, excess = length - wanted;
      const bool stated = side.relation != nullptr || last.relation != nullptr;
      const double tolerance =
          stated ? std::max(kPlainTolerance, kStatedTolerance * wanted) : kPlainTolerance;
      if (std::fabs(excess) <= tolerance + 1e-9) continue;
      report_lengths(side, last, length, other, wanted);
      failed_ = true;
    }
    if (failed_) throw Stop{};
  }

  void report_lengths(const Side& side, const Side& last, double length, double other, double wanted) {
    const double excess = length - wanted;
    std::string expected = lengths(last);
    const bool stated = side.relation != nullptr || last.relation != nullptr;
    if (stated) {
      expected += ", with ";
      if (side.relation != nullptr) expected += relation_text(side);
      if (side.relation != nullptr && last.relation != nullptr) expected += " and ";
      if (last.relation != nullptr) expected += relation_text(last);
      expected += ' ' + format_mm(wanted);
    }
    Message message("G0501",
                    "seam `" + declaration_.name + "` is " + format_mm(std::fabs(excess)) +
                        (excess > 0 ? " too long" : " too short") + " on the `" + name_of_side(side) +
                        "` side",
                    side.expr->span, lengths(side));
    message.also(last.expr->span, expected);
    fail_with_remedy(message, side, last, length, other);
  }

  static std::string name_of_side(const Side& side) { return show(Value{side.edge}); }

  static std::string percent(double x) { return format_quantity(std::round(1000 * x) / 1000, kNumber, true); }

  void fail_with_remedy(Message& message, const Side& side, const Side& last, double length, double other) {
    const double ratio = length / other * last.factor;  // of this side, the other's relation kept
    const std::string name = name_of_side(side);
    std::string help;
    if (other <= 0 || length <= 0) {
      help = "a side has no length";
    } else if (side.relation != nullptr && last.relation == nullptr) {
      const std::string& word = side.relation->word.text;
      if (word == "gather" && ratio >= 1)
        help = "`gather " + format_quantity(ratio, kNumber, false, 3) + "` would fit";
      else if (ratio >= 1)
        help = "`ease " + percent(ratio - 1) + "` would fit";
      else
        help = "`stretch " + percent(1 / ratio - 1) + "` would fit";
    } else if (ratio > 1.3) {
      help = "make the sides alike, or gather: `" + name + " gather " +
             format_quantity(ratio, kNumber, false, 3) + "`";
    } else if (ratio > 1) {
      help = "make the sides alike, or state the difference: `" + name + " ease " + percent(ratio - 1) + "`";
    } else {
      help = "make the sides alike, or state the difference on the longer side: `" + name_of_side(last) +
             " ease " + percent(last.factor / ratio - 1) + "`";
    }
    report(program_, message.help(help));
  }

  Program& program_;
  Declaration& declaration_;
  const Statement& statement_;
  Scope& scope_;
  std::vector<Side> sides_;
  bool failed_ = false;
};

}  // namespace

int reserve_seam(Program& program, const Declaration& declaration) {
  SeamInfo& info = program.seams.emplace_back();
  info.seam.name = declaration.name;
  info.part = declaration.scope->part;
  return static_cast<int>(program.seams.size()) - 1;
}

Value evaluate_seam(Program& program, Declaration& declaration) {
  SeamMaker(program, declaration).make(program.seams[static_cast<std::size_t>(declaration.index)]);
  return Value{SeamValue{declaration.index}};
}

}  // namespace garment::interpreter
