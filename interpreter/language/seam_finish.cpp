#include "interpreter/language/seam_finish.hpp"

#include <algorithm>

#include "interpreter/language/clauses.hpp"
#include "interpreter/language/evaluate.hpp"

namespace garment::interpreter {
namespace {

using Ironed = design::SeamFinish::Ironed;

constexpr const char* kOwn[] = {"start",   "turned", "lapped",    "fold",     "ironed",
                                "tension", "slack",  "stiffness", "allowance"};

bool is_side_word(const Expr& expr) {
  return expr.kind == ExprKind::name && (expr.text == "face" || expr.text == "back");
}

}  // namespace

design::Facing eval_facing(Program& program, const Clause& clause, const std::string& what) {
  if (clause.values.size() != 1 || !is_side_word(clause.values[0]))
    fail(program, Message("G0313", what + " goes to `face` or to `back`", clause.span)
                      .help("the face is the side that looks out, the back lies towards the body"));
  return clause.values[0].text == "face" ? design::Facing::face : design::Facing::back;
}

SeamFinishReader::SeamFinishReader(Program& program, Declaration& declaration)
    : program_(program), declaration_(declaration), scope_(*declaration.scope) {}

bool SeamFinishReader::take(const Clause& clause, std::size_t sides) {
  const std::string& word = clause.word.text;
  if (word == "to" && after_fold_) {
    after_fold_ = false;
    if (clause.values.size() == 1 && is_side_word(clause.values[0])) {
      finish_.fold_to = eval_facing(program_, clause, "`fold`");
      return true;
    }
  }
  after_fold_ = word == "fold";
  if (std::find(std::begin(kOwn), std::end(kOwn), word) == std::end(kOwn)) return false;
  if (sides == 0) fail(program_, Message("G0313", "`" + word + "` stands after the sides", clause.span));
  if (const Clause* first = find(word))
    fail(program_, Message("G0314", "`" + word + "` is given twice", clause.word.span)
                       .also(first->word.span, "first here"));
  clauses_.push_back(&clause);
  if (word == "turned") {
    if (!clause.values.empty())
      fail(program_, Message("G0313", "`turned` stands alone", clause.values[0].span));
    finish_.turned = true;
  }
  if (word == "start") take_start(clause);
  return true;
}

const Clause* SeamFinishReader::find(const std::string& word) const {
  for (const Clause* clause : clauses_)
    if (clause->word.text == word) return clause;
  return nullptr;
}

void SeamFinishReader::take_start(const Clause& clause) {
  if (clause.values.size() < 2 || clause.values[0].kind != ExprKind::name || clause.values[0].text != "at")
    fail(program_, Message("G0313", "`start` takes `at` and a place", clause.span)
                       .help("as in `start at placket` or `start at front.hip`"));
  for (std::size_t k = 1; k < clause.values.size(); ++k) {
    const Expr& expr = clause.values[k];
    SeamStart start;
    start.span = expr.span;
    const Value value = eval(program_, expr, scope_);
    if (const auto* seam = value.as<SeamValue>()) {
      start.seam = seam->seam;
    } else if (const auto* thing = value.as<ThingValue>(); thing != nullptr && thing->keyword == "zip") {
      start.zip = thing->index;
    } else if (const auto* point = value.as<PointValue>(); point != nullptr && point->panel >= 0) {
      start.panel = point->panel;
      start.point = {point->at[0], point->at[1]};
    } else if (const auto* notch = value.as<NotchValue>()) {
      const design::Panel& panel = program_.panels[static_cast<std::size_t>(notch->panel)].panel;
      start.panel = notch->panel;
      for (const design::Notch& mark : panel.notches)
        for (const design::Edge& edge : panel.edges)
          if (mark.name == notch->name && edge.name == mark.edge) start.point = edge.curve.point_at(mark.at);
    } else {
      fail(program_,
           Message("G0306", kind_of(value) + " where `start at` takes a seam, a zip or a notch", expr.span));
    }
    starts_.push_back(start);
  }
}

double SeamFinishReader::number(const std::string& word, const Clause* clause, const Override* change) const {
  const ClauseRecord& record = *find_clause(*find_construct("seam"), word);
  if (change == nullptr && clause->values.empty())
    fail(program_, Message("G0312", "`" + word + "` needs a value", clause->word.span));
  if (change == nullptr && clause->values.size() > 1)
    fail(program_, Message("G0313", "`" + word + "` takes one value, here is more", clause->values[1].span)
                       .help(clause->values[1].kind == ExprKind::name ? words_hint(*find_construct("seam"), clause->values[1].text) : ""));
  const Expr& expr = change != nullptr ? *change->value : clause->values[0];
  const Quantity q = eval_quantity(program_, expr, change != nullptr ? *change->scope : scope_,
                                   record.dimension, "`" + word + "`");
  return checked_quantity(program_, record, q, expr.span);
}

void SeamFinishReader::take_numbers() {
  auto read = [&](const char* word, const auto& set) {
    const Override* change = nullptr;
    for (Override& o : declaration_.overrides)
      if (o.path.size() == 1 && o.path[0] == word) o.used = true, change = &o;
    const Clause* clause = find(word);
    if (clause != nullptr || change != nullptr) set(number(word, clause, change));
  };
  read("lapped", [&](double x) { finish_.lap = x; });
  read("fold", [&](double x) { finish_.fold_angle = x; });
  read("tension", [&](double x) { finish_.tension = x; });
  read("slack", [&](double x) { finish_.slack = x; });
  read("stiffness", [&](double x) { finish_.stiffness = x; });
  read("allowance", [&](double x) { finish_.allowance = x; });
}

void SeamFinishReader::take_ironed(const SeamInfo& info) {
  const Clause* clause = find("ironed");
  if (clause == nullptr) return;
  const std::string word =
      !clause->values.empty() && clause->values[0].kind == ExprKind::name ? clause->values[0].text : "";
  if (word == "open" && clause->values.size() == 1) {
    finish_.ironed = Ironed::open;
    return;
  }
  if (word != "toward" || clause->values.size() != 2)
    fail(program_, Message("G0313", "`ironed` takes `open` or `toward SIDE`", clause->span)
                       .help("as in `ironed open` or `ironed toward back.side`"));
  finish_.ironed = Ironed::toward;
  const Expr& expr = clause->values[1];
  const EdgeValue edge = eval_edges(program_, expr, scope_, "`toward`");
  for (std::size_t k = 0; k < info.seam.sides.size(); ++k)
    for (const design::EdgePart& part : info.seam.sides[k].parts)
      if (!edge.spans[0].parts.empty() && part.panel == edge.spans[0].panel &&
          part.edge == edge.spans[0].parts[0].edge && part.on == edge.spans[0].parts[0].on) {
        finish_.ironed_toward = static_cast<int>(k);
        return;
      }
  Message message("G0514", "`" + show(Value{edge}) + "` is no side of seam `" + declaration_.name + "`",
                  expr.span);
  fail(program_,
       message.also(info.spans[0], "one side").help("the allowances lie toward one of the seam's own sides"));
}

void SeamFinishReader::check_exclusions() const {
  static constexpr std::pair<const char*, const char*> pairs[] = {{"lapped", "turned"},
                                                                  {"lapped", "ironed"},
                                                                  {"lapped", "fold"},
                                                                  {"slack", "lapped"},
                                                                  {"slack", "turned"}};
  for (const auto& [one, two] : pairs) {
    const Clause *a = find(one), *b = find(two);
    if (a == nullptr || b == nullptr) continue;
    if (a->span.begin > b->span.begin) std::swap(a, b);
    fail(program_, Message("G0513", "a seam is not both `" + a->word.text + "` and `" + b->word.text + "`",
                           b->word.span)
                       .also(a->word.span, "and here")
                       .help("leave one of them out"));
  }
}

design::SeamFinish SeamFinishReader::finish(const SeamInfo& info) {
  take_numbers();
  take_ironed(info);
  check_exclusions();
  return finish_;
}

}  // namespace garment::interpreter
