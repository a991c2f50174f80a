#include "interpreter/language/seams.hpp"

#include <algorithm>
#include <cmath>

#include "interpreter/language/clauses.hpp"
#include "interpreter/language/edges.hpp"
#include "interpreter/language/seam_finish.hpp"
#include "interpreter/language/seam_relations.hpp"

namespace garment::interpreter {
namespace {

constexpr double kOverlap = 2e-3;  // m of an edge that may be sewn twice unsaid

bool is_relation(const std::string& word) { return word == "ease" || word == "gather" || word == "stretch"; }

class SeamMaker {
 public:
  SeamMaker(Program& program, Declaration& declaration)
      : program_(program),
        declaration_(declaration),
        statement_(*declaration.statement),
        scope_(*declaration.scope) {}

  void make(SeamInfo& info) {
    SeamFinishReader finish(program_, declaration_);
    for (std::size_t k = 0; k < statement_.clauses.size(); ++k) {
      const Clause& clause = statement_.clauses[k];
      if (!finish.take(clause, sides_.size())) take(clause);
    }
    if (!statement_.operands.empty() && sides_.size() == 1)
      fail(program_, Message("G0313", "a `:` is missing after `" + declaration_.name + "`", statement_.operands[0].span)
                         .help("write `seam " + declaration_.name + ": " +
                               std::string(program_.sources.text(statement_.operands[0].span)) + " to ...`"));
    if (!statement_.operands.empty())
      fail(program_,
           Message("G0313", "`" + std::string(program_.sources.text(statement_.operands[0].span)) + "` means nothing before the first side", statement_.operands[0].span));
    if (sides_.size() < 2)
      fail(program_, Message("G0507",
                             "seam `" + declaration_.name + "` has " + std::to_string(sides_.size()) +
                                 (sides_.size() == 1 ? " side" : " sides"),
                             statement_.keyword.span)
                         .help("write `seam NAME: EDGE to EDGE`"));
    add_assigned();
    info.seam.name = declaration_.name;
    info.seam.origin = program_.origin(statement_.span);
    for (std::size_t k = 0; k < sides_.size(); ++k) add_side(info, k);
    check_itself(info);
    info.seam.finish = finish.finish(info);
    info.starts = finish.starts();
    if (!check_side_lengths(program_, declaration_.name, sides_)) throw Stop{};
    info.ready = true;
  }

 private:
  void take(const Clause& clause) {
    const std::string& word = clause.word.text;
    if (word == ":" || word == "to") return take_side(clause);
    if (sides_.empty()) fail(program_, Message("G0313", "`" + word + "` stands after its side", clause.span));
    SeamSideDraft& side = sides_.back();
    if (is_relation(word)) return take_relation(program_, scope_, side, clause, assigned(word));
    if (side.reversed) fail(program_, Message("G0314", "`reversed` is given twice", clause.span));
    if (!clause.values.empty())
      fail(program_, Message("G0313", "`reversed` stands alone", clause.values[0].span));
    side.reversed = true;
  }

  /// `armhole.ease = 5%` changes the first such relation of the seam.
  const Override* assigned(const std::string& word) {
    for (Override& change : declaration_.overrides) {
      if (change.used || change.path.size() != 1 || change.path[0] != word) continue;
      change.used = true;
      return &change;
    }
    return nullptr;
  }

  /// A relation that the statement does not have is put to its first side.
  void add_assigned() {
    for (Override& change : declaration_.overrides) {
      if (change.used || change.path.size() != 1 || !is_relation(change.path[0])) continue;
      change.used = true;
      Clause& made = program_.made_clauses.emplace_back();
      made.word = {change.path[0], change.span, {}};
      made.values.push_back(*change.value);
      made.span = change.span;
      take_relation(program_, scope_, sides_[0], made, &change);
    }
  }

  void take_side(const Clause& clause) {
    if (clause.values.empty())
      fail(program_, Message("G0312", "a side of the seam is missing", clause.word.span)
                         .help("chains are written `a + b`"));
    if (clause.values.size() > 1) {
      std::vector<std::string> words;
      for (const ClauseRecord& known : find_construct("seam")->clauses) words.emplace_back(known.word);
      const std::string hint = did_you_mean(clause.values[1].text, words);
      fail(program_, Message("G0313", "a side is one edge or chain", clause.values[1].span)
                         .help(hint.empty() ? "chains are written `a + b`" : hint));
    }
    SeamSideDraft side;
    side.expr = &clause.values[0];
    side.edge = eval_edges(program_, *side.expr, scope_, "a side of a seam");
    mirror(side);
    sides_.push_back(std::move(side));
  }

  /// A chain of right halves is the image of that of the left ones: what the left one walks first, counter-clockwise,
  /// is what the right one comes to last.
  void mirror(SeamSideDraft& side) {
    if (scope_.half != "right" || side.edge.spans.size() < 2 || side.expr->kind != ExprKind::binary) return;
    for (const EdgeSpan& span : side.edge.spans)
      if (!is_image(span)) return;
    std::vector<EdgeSpan> image;
    take_image(*side.expr, image);
    side.edge.spans = std::move(image);
    side.mirrored = true;
  }

  /// Lies on the right half of a panel on the fold, or on the right panel of a pair.
  bool is_image(const EdgeSpan& span) const {
    if (program_.panels[static_cast<std::size_t>(span.panel)].folded) return true;
    return std::any_of(program_.declarations.begin(), program_.declarations.end(), [&](const Declaration& d) {
      return d.pair_left != nullptr && d.index == span.panel;
    });
  }

  void take_image(const Expr& expr, std::vector<EdgeSpan>& image) {
    if (expr.kind != ExprKind::binary || (expr.text != "+" && expr.text != "-")) {
      const EdgeValue link = eval_edges(program_, expr, scope_, "a side of a seam");
      image.insert(image.end(), link.spans.begin(), link.spans.end());
      return;
    }
    if (expr.text == "+") {
      take_image(expr.children[1], image);
    } else {
      EdgeValue link = eval_edges(program_, expr.children[1], scope_, "a side of a seam");
      std::reverse(link.spans.begin(), link.spans.end());
      for (EdgeSpan& span : link.spans) span.backwards = !span.backwards;
      image.insert(image.end(), link.spans.begin(), link.spans.end());
    }
    take_image(expr.children[0], image);
  }

  /// A line inside a panel has cloth on both sides: what is sewn onto it lies over it.
  bool on_a_line() const {
    for (const SeamSideDraft& side : sides_)
      for (const EdgeSpan& span : side.edge.spans)
        for (const design::EdgePart& part : span.parts)
          if (part.on == design::EdgePart::On::line) return true;
    return false;
  }

  /// Parts along the seam. The first side runs counter-clockwise, the others against it; where a line is sewn to, all run
  /// counter-clockwise, and the line as drawn.
  void add_side(SeamInfo& info, std::size_t k) {
    const SeamSideDraft& draft = sides_[k];
    info.sides.push_back(draft.edge);
    info.spans.push_back(draft.expr->span);
    design::SeamSide side;
    side.origin = program_.origin(draft.expr->span);
    for (const SidePiece& piece : pieces_along(program_, draft, (k > 0 && !on_a_line()) != draft.reversed))
      for (const design::EdgePart& part : piece.span.parts) {
        side.parts.push_back(part);
        if (!draft.parts.empty()) side.fullness.push_back(piece.fullness);
      }
    info.seam.sides.push_back(std::move(side));
    info.seam.ratio.push_back(draft.factor / sides_.back().factor);
  }

  /// One stretch of cloth cannot be sewn to itself.
  void check_itself(const SeamInfo& info) {
    std::vector<std::pair<design::EdgePart, std::size_t>> seen;
    for (std::size_t k = 0; k < info.seam.sides.size(); ++k)
      for (const design::EdgePart& part : info.seam.sides[k].parts) {
        for (const auto& [other, side] : seen) {
          if (other.panel != part.panel || other.edge != part.edge || other.on != part.on) continue;
          const double low = std::max(std::min(part.from, part.to), std::min(other.from, other.to));
          const double high = std::min(std::max(part.from, part.to), std::max(other.from, other.to));
          if (high - low < kOverlap) continue;
          Message message("G0509",
                          "seam `" + declaration_.name + "` sews " + format_mm(high - low) + " of `" +
                              show(Value{sides_[k].edge}) + "` to itself",
                          sides_[k].expr->span);
          if (side != k) message.also(sides_[side].expr->span, "the same cloth");
          fail(program_,
               message.help("name the other edge, or two parts of it that do not overlap: `e[start .. "
                            "middle]` to `e[middle .. end]`"));
        }
        seen.emplace_back(part, k);
      }
  }

  Program& program_;
  Declaration& declaration_;
  const Statement& statement_;
  Scope& scope_;
  std::vector<SeamSideDraft> sides_;
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
