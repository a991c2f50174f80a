// `iron`: folds pressed along a line, and what steam does to a region.
#include "interpreter/language/clauses.hpp"
#include "interpreter/language/edges.hpp"
#include "interpreter/language/layers.hpp"
#include "interpreter/language/regions.hpp"
#include "interpreter/language/seam_finish.hpp"

namespace garment::interpreter {
namespace {

using PressKind = design::Press::Kind;

class IronReader {
 public:
  IronReader(Program& program, Declaration& declaration)
      : program_(program),
        statement_(*declaration.statement),
        clauses_(program, statement_, *declaration.scope, &declaration.overrides) {
    press_.name = declaration.name;
    press_.origin = program.origin(statement_.span);
  }

  design::Press read() {
    if (!statement_.operands.empty())
      fail(program_,
           Message("G0313", "`" + std::string(program_.sources.text(statement_.operands[0].span)) + "` means nothing before `along` or `in`", statement_.operands[0].span));
    const BoundClause *along = clauses_.find("along"), *in = clauses_.find("in");
    if ((along == nullptr) == (in == nullptr))
      fail(program_,
           Message("G1120", "iron goes `along LINE` or `in REGION`", statement_.keyword.span)
               .help("write `iron crease along front.roll fold 180 deg to back`, or `iron hip in yoke shrink "
                     "warp 1%`"));
    if (along != nullptr)
      read_fold(*along);
    else
      read_region(*in);
    if (const auto factor = clauses_.quantity("factor")) press_.factor = *factor;
    clauses_.finish();
    return press_;
  }

 private:
  std::vector<design::EdgePart> line(const BoundClause& clause, const std::string& what) {
    std::vector<design::EdgePart> parts;
    for (const EdgeSpan& span : eval_edges(program_, clauses_.value(clause), *clause.scope, what).spans) {
      const EdgeSpan walked = span.backwards ? reversed(span) : span;
      parts.insert(parts.end(), walked.parts.begin(), walked.parts.end());
    }
    return parts;
  }

  void read_fold(const BoundClause& along) {
    press_.kind = PressKind::fold;
    press_.line = line(along, "`along`");
    const auto angle = clauses_.quantity("fold");
    if (!angle) clauses_.need("fold");
    press_.angle = *angle;
    if (const BoundClause* to = clauses_.find("to")) press_.to = eval_facing(program_, *to->clause, "a fold");
    if (const auto radius = clauses_.quantity("radius")) press_.radius = *radius;
    if (const auto set = clauses_.quantity("set")) press_.set = *set;
  }

  void read_region(const BoundClause& in) {
    press_.region = eval_region(program_, clauses_.value(in), *in.scope, "`in`");
    static constexpr std::pair<const char*, PressKind> kinds[] = {
        {"shrink", PressKind::shrink}, {"extend", PressKind::extend}, {"flat", PressKind::flat}, {"curl", PressKind::curl}};
    const BoundClause* chosen = nullptr;
    for (const auto& [word, kind] : kinds) {
      const BoundClause* found = clauses_.find(word);
      if (found == nullptr) continue;
      if (chosen != nullptr)
        fail(program_, Message("G1120", "one iron does one thing to a region", found->clause->word.span)
                           .also(chosen->clause->word.span, "first here")
                           .help("iron it again under another name"));
      clauses_.flag(word);
      chosen = found;
      press_.kind = kind;
    }
    if (chosen == nullptr)
      fail(program_,
           Message("G1120", "iron in a region needs what it does", statement_.keyword.span)
               .help("add `shrink warp 1% weft 3%`, `extend ...`, `flat` or `curl radius 5 cm about LINE`"));
    if (press_.kind == PressKind::shrink || press_.kind == PressKind::extend) read_lengths(*chosen);
    if (press_.kind == PressKind::curl) read_curl();
  }

  void read_lengths(const BoundClause& chosen) {
    const auto warp = clauses_.quantity("warp"), weft = clauses_.quantity("weft");
    if (!warp && !weft)
      fail(program_,
           Message("G0312", "`" + chosen.clause->word.text + "` needs `warp` or `weft`", chosen.clause->span)
               .help("as in `" + chosen.clause->word.text + " warp 1% weft 3%`"));
    press_.warp = warp.value_or(0);
    press_.weft = weft.value_or(0);
  }

  void read_curl() {
    const auto radius = clauses_.quantity("radius");
    if (!radius) clauses_.need("radius");
    press_.radius = *radius;
    press_.line = line(clauses_.need("about"), "`about`");
    if (const BoundClause* to = clauses_.find("to")) press_.to = eval_facing(program_, *to->clause, "a curl");
  }

  Program& program_;
  const Statement& statement_;
  Clauses clauses_;
  design::Press press_;
};

}  // namespace

int reserve_iron(Program& program, const Declaration& declaration) {
  program.garment.presses.emplace_back().name = declaration.name;
  return static_cast<int>(program.garment.presses.size()) - 1;
}

Value evaluate_iron(Program& program, Declaration& declaration) {
  design::Press press = IronReader(program, declaration).read();
  program.garment.presses[static_cast<std::size_t>(declaration.index)] = std::move(press);
  return Value{ThingValue{"iron", &declaration, declaration.index}};
}

}  // namespace garment::interpreter
