#include "interpreter/language/clauses.hpp"

namespace garment::interpreter {

Clauses::Clauses(Program& program, const Statement& statement, Scope& scope, std::vector<Override>* overrides)
    : program_(program),
      statement_(statement),
      scope_(scope),
      record_(find_construct(statement.keyword.text)) {
  for (const Clause& clause : statement.clauses) {
    for (const Entry& entry : entries_)
      if (entry.bound.clause->word.text == clause.word.text) {
        if (clause.word.text == "=")
          fail(program, Message("G0314", "a second `=` in one statement", clause.word.span)
                            .also(entry.bound.clause->word.span, "first here")
                            .help("begin the next statement in a new line, or put `;` before it"));
        fail(program, Message("G0314", "`" + clause.word.text + "` is given twice", clause.word.span)
                          .also(entry.bound.clause->word.span, "first here"));
      }
    entries_.push_back({{&clause, &scope}});
  }
  if (overrides == nullptr || record_ == nullptr) return;
  for (Override& change : *overrides) {
    if (change.path.size() != 1 || find_clause(*record_, change.path[0]) == nullptr) continue;
    change.used = true;
    Clause& made = program.made_clauses.emplace_back();
    made.word = {change.path[0], change.span, {}};
    made.values.push_back(*change.value);
    made.span = change.span;
    Entry* entry = nullptr;
    for (Entry& known : entries_)
      if (known.bound.clause->word.text == change.path[0]) entry = &known;
    if (entry == nullptr) entry = &entries_.emplace_back();
    entry->bound = {&made, change.scope};
  }
}

bool Clauses::has(std::string_view word) const {
  for (const Entry& entry : entries_)
    if (entry.bound.clause->word.text == word) return true;
  return false;
}

const BoundClause* Clauses::find(std::string_view word) {
  for (Entry& entry : entries_) {
    if (entry.bound.clause->word.text != word) continue;
    entry.read = true;
    return &entry.bound;
  }
  return nullptr;
}

const BoundClause& Clauses::need(std::string_view word) {
  if (const BoundClause* found = find(word)) return *found;
  Message message("G0312", "`" + statement_.keyword.text + "` needs `" + std::string(word) + "`",
                  statement_.keyword.span);
  if (record_ != nullptr) message.help("write `" + std::string(record_->form) + "`");
  fail(program_, message);
}

bool Clauses::flag(std::string_view word) {
  const BoundClause* found = find(word);
  if (found != nullptr && !found->clause->values.empty())
    fail_extra(Message("G0313", "`" + std::string(word) + "` stands alone here", found->clause->values[0].span),
               found->clause->values[0], "");
  return found != nullptr;
}

void Clauses::fail_extra(Message message, const Expr& extra, const std::string& otherwise) const {
  // A clause word with a slip in it, or of another construct, reads as one more value.
  const std::string hint = record_ != nullptr && extra.kind == ExprKind::name ? words_hint(*record_, extra.text) : "";
  fail(program_, message.help(hint.empty() ? otherwise : hint));
}

const Expr& Clauses::value(const BoundClause& bound) const {
  const Clause& clause = *bound.clause;
  if (clause.values.size() == 1) return clause.values[0];
  const std::string takes = record_ != nullptr && find_clause(*record_, clause.word.text) != nullptr
                                ? std::string(find_clause(*record_, clause.word.text)->takes)
                                : "one value";
  if (clause.values.empty())
    fail(program_, Message("G0312", "`" + clause.word.text + "` needs a value", clause.word.span)
                       .help("`" + clause.word.text + ' ' + takes + "`"));
  const Expr &first = clause.values[0], &second = clause.values[1];
  if (first.kind == ExprKind::number && first.unit.empty() && second.kind == ExprKind::name) {
    const std::string near = did_you_mean(second.text, unit_names());
    fail(program_, Message("G0105", "unknown unit `" + second.text + "`", second.span, "after a number")
                       .help(second.text == "in" ? "the inch is written `inch`"
                             : near.empty()      ? "to multiply, write the sign: `2 * width`"
                                                 : near));
  }
  // A value without its word: `turn` is missing in `hem low on front.hem 4 cm`.
  const bool plain = record_ != nullptr && (second.kind == ExprKind::number || second.kind == ExprKind::name);
  fail_extra(Message("G0313", "`" + clause.word.text + "` takes one value, here is more", second.span), second,
             clause.word.text == "=" ? "put an operator between the two, or begin a new line"
             : plain                 ? "is a word missing before it? the form is `" + std::string(record_->form) + "`"
                                     : "`" + clause.word.text + ' ' + takes + "`");
}

double checked_quantity(Program& program, const ClauseRecord& record, const Quantity& q, Span span) {
  if (record.min <= record.max && !(q.value >= record.min && q.value <= record.max)) {
    const bool percent = record.takes.find('%') != std::string_view::npos;
    const bool forgot = percent && !q.percent && q.value / 100 >= record.min && q.value / 100 <= record.max;
    fail(program, Message("G0309",
                          "`" + std::string(record.word) + "` is " +
                              format_quantity(q.value, q.dimension, percent || q.percent) +
                              "; it must lie in " + format_quantity(record.min, record.dimension, percent) +
                              " .. " + format_quantity(record.max, record.dimension, percent),
                          span)
                      .help(forgot ? "is it " + format_quantity(q.value / 100, {}, true) + "? a share is written with its sign" : ""));
  }
  return q.value;
}

std::optional<double> Clauses::quantity(std::string_view word) {
  const BoundClause* found = find(word);
  if (found == nullptr) return std::nullopt;
  const ClauseRecord& record = *find_clause(*record_, word);
  const Expr& expr = value(*found);
  const Quantity q =
      eval_quantity(program_, expr, *found->scope, record.dimension, "`" + std::string(word) + "`");
  return checked_quantity(program_, record, q, expr.span);
}

void Clauses::skip(std::string_view word) { find(word); }

void Clauses::finish() {
  for (const Entry& entry : entries_) {
    if (entry.read) continue;
    const std::string& word = entry.bound.clause->word.text;
    const ClauseRecord* known = record_ == nullptr ? nullptr : find_clause(*record_, word);
    if (known != nullptr && known->doc.empty()) {
      report(program_,
             Message("G0315", "`" + word + "` of `" + statement_.keyword.text + "` is not supported yet",
                     entry.bound.clause->span)
                 .help(kStillToCome));
      continue;
    }
    Message message("G0313", "`" + word + "` has no meaning in this `" + statement_.keyword.text + "`",
                    entry.bound.clause->word.span);
    if (record_ != nullptr) message.help("the form is `" + std::string(record_->form) + "`");
    report(program_, message);
  }
}

}  // namespace garment::interpreter
