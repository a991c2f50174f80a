// Entries that change the script, and expressions.
#include <fmt/format.h>

#include <algorithm>

#include "interpreter/language/construct_table.hpp"
#include "interpreter/session/changes.hpp"
#include "interpreter/session/session.hpp"
#include "runtime/model/dump.hpp"

namespace garment::session {
namespace {

using interpreter::Value;

constexpr std::size_t kMostListed = 6;  // panels in one line
constexpr int kExactDigits = 15;        // of a number that is written into the script
constexpr std::size_t kShortText = 60;  // bytes of a value in the answer

int count_errors(const grammar::Diagnostics& diagnostics) {
  return static_cast<int>(
      std::count_if(diagnostics.begin(), diagnostics.end(),
                    [](const grammar::Diagnostic& d) { return d.severity == Severity::error; }));
}

/// Those that were not said before.
grammar::Diagnostics news(const grammar::Diagnostics& now, const grammar::Diagnostics& before) {
  grammar::Diagnostics fresh;
  for (const grammar::Diagnostic& d : now) {
    const bool old = std::any_of(before.begin(), before.end(), [&](const grammar::Diagnostic& b) {
      return b.code == d.code && b.message == d.message;
    });
    if (!old) fresh.push_back(d);
  }
  return fresh;
}

/// As it can be written in a script; empty where it cannot.
std::string literal(const Value& value) {
  if (const auto* q = value.as<interpreter::Quantity>())
    return interpreter::format_quantity(q->value, q->dimension, q->percent, kExactDigits);
  if (const auto* truth = value.as<bool>()) return *truth ? "true" : "false";
  if (const auto* text = value.as<std::string>())
    return text->find_first_of("\"\\{\n") == std::string::npos ? '"' + *text + '"' : "";
  const auto* p = value.as<interpreter::PointValue>();
  if (p == nullptr) return "";
  std::string text = "(";
  for (int k = 0; k < p->size; ++k)
    text += (k > 0 ? ", " : "") + interpreter::format_quantity(p->at[k], p->dimension, false, kExactDigits);
  return text + ")";
}

std::string one_line(const std::string& text) {
  const std::size_t end = text.find('\n');
  if (end == std::string::npos && text.size() <= kShortText) return text;
  std::size_t cut = std::min(end, kShortText);
  while (cut > 0 && (static_cast<unsigned char>(text[cut]) & 0xC0) == 0x80) --cut;
  return text.substr(0, cut) + " ...";
}

bool mentions_it(const grammar::Expr& expr) {
  bool found = false;
  for_each_expr(expr, [&](const grammar::Expr& e) {
    found = found || (e.kind == grammar::ExprKind::name && e.text == "it");
  });
  return found;
}

}  // namespace

/// The entry with `it` filled in, so that the script does not speak of the prompt.
std::string Session::with_it(const Entry& entry) const {
  const auto it = it_.find("it");
  if (it == it_.end() && it_text_.empty()) return entry.text;
  for (const interpreter::DeclaredThing& thing : interpreter::declared_things(stage_.evaluated->result))
    if (thing.name == "it") return entry.text;
  const std::string text = it != it_.end() ? literal(it->second) : it_text_;
  if (text.empty()) return entry.text;
  std::vector<grammar::Span> places;
  for (const grammar::Statement& statement : entry.script.statements) {
    if (is_act(statement)) continue;
    for_each_expr(statement, [&](const grammar::Expr& expr) {
      if (expr.kind == grammar::ExprKind::name && expr.text == "it" && expr.children.empty())
        places.push_back(expr.span);
    });
  }
  std::sort(places.begin(), places.end(), [](auto a, auto b) { return a.begin > b.begin; });
  std::string filled = entry.text;
  for (const grammar::Span& place : places) filled.replace(place.begin, place.end - place.begin, text);
  return filled;
}

Answer Session::change(const Entry& entry) {
  Patch patch(stage_.text);
  std::vector<ScriptEdit> edits;
  for (const TypedStatement& typed : cut_entry(entry.script.statements, entry.text)) {
    const grammar::Statement& statement = *typed.statement;
    if (is_act(statement))
      return refuse("G1503",
                    fmt::format("`{}` stands among declarations in one entry", statement.keyword.text),
                    "type it as an entry of its own: acts run at once and are not written into the script");
    const bool asks = statement.keyword.text == "measure" && !statement.clauses.empty() &&
                      !statement.clauses[0].values.empty() &&
                      interpreter::asks_drape(stage_.evaluated->result, statement.clauses[0].values[0]);
    edits.push_back(write_statement(patch, typed, entry.text, asks));
  }
  Answer answer = commit(std::move(patch), entry.text, edits);
  if (answer.outcome != Outcome::done) return answer;
  for (const grammar::Statement& statement : entry.script.statements) {
    if (statement.keyword.text != "measure" || declared_name(statement).empty()) continue;
    const Answer value = ask(read_entry(declared_name(statement)));
    if (value.outcome == Outcome::done) answer.text += declared_name(statement) + " = " + value.text;
  }
  return answer;
}

std::string Session::describe_edits(const std::vector<ScriptEdit>& edits) const {
  std::string text;
  for (const ScriptEdit& edit : edits) {
    if (edit.kind == EditKind::value)
      text += fmt::format("{}: {} -> {}\n", edit.name, one_line(edit.before), one_line(edit.after));
    else if (edit.kind == EditKind::replaced)
      text += fmt::format("replaced {}\n", edit.name);
    else
      text += edit.declares ? fmt::format("added {}\n", edit.name)
                            : fmt::format("added {} = {}\n", edit.name, one_line(edit.after));
  }
  return text;
}

Answer Session::commit(Patch patch, const std::string& entry, const std::vector<ScriptEdit>& edits) {
  if (patch.text() == stage_.text) return {Outcome::done, "nothing changed\n"};
  const double begun = host_.seconds();
  Stage next;
  next.text = patch.text();
  next.entry = entry;
  next.released = stage_.released;
  next.evaluated = workshop_.evaluate(next.text);
  Evaluated& evaluated = *next.evaluated;
  const int errors = count_errors(evaluated.result.diagnostics);
  const int errors_before = count_errors(stage_.evaluated->result.diagnostics);
  grammar::Diagnostics fresh = news(evaluated.result.diagnostics, stage_.evaluated->result.diagnostics);
  show_as_typed(evaluated, fresh, patch, entry);
  // A script that was broken may be mended step by step, but not broken further.
  if (errors > 0 && (errors_before == 0 || errors > errors_before || count_errors(fresh) > 0)) {
    if (count_errors(fresh) == 0) fresh = evaluated.result.diagnostics;
    return {Outcome::refused, shown(fresh, evaluated.sources, Severity::error)};
  }
  // A garment that hangs keeps its shape: where its panels would start is not asked.
  const bool quick = (stage_.shape.draped || stage_.shape.carried) && stage_.modelled->model &&
                     !start_matters(*stage_.modelled->model);
  std::shared_ptr<Modelled> modelled = std::make_shared<Modelled>(workshop_.build(evaluated, next.released, !quick));
  grammar::Diagnostics of_model = news(modelled->diagnostics, stage_.modelled->diagnostics);
  show_as_typed(evaluated, of_model, patch, entry);
  const bool declares_only = std::all_of(edits.begin(), edits.end(), [](const ScriptEdit& e) {
    return e.declares && e.kind == EditKind::added;
  });
  if (modelled->failed && stage_.modelled->model && !declares_only)
    return {Outcome::refused, shown(of_model, evaluated.sources, Severity::error)};
  if (modelled->failed)  // what was declared may wait for more: a panel for its place
    for (grammar::Diagnostic& d : of_model) d.severity = Severity::warning;
  next.modelled = modelled;
  Answer answer;
  answer.text = describe_edits(edits) + shown(fresh, evaluated.sources, Severity::warning) +
                shown(of_model, evaluated.sources, Severity::warning);
  if (errors > 0)
    answer.text += fmt::format("the script has {} more error{}\n", errors, errors == 1 ? "" : "s");
  answer.outcome = settle_shape(next, begun, answer.text);
  take(std::move(next));
  return answer;
}

Outcome Session::settle_shape(Stage& next, double begun, std::string& text) {
  if (!next.modelled->model) {
    if (stage_.modelled->model) text += "no model until that is mended; `:undo` brings it back\n";
    return Outcome::done;
  }
  const model::Model& model = *next.modelled->model;
  Stage from = stage_;
  if (!from.modelled->model) {  // the last shape before the model was lost
    for (std::size_t k = undo_.size(); k-- > 0 && !from.shape.draped;) from = undo_[k];
    from = restored(std::move(from));
  }
  if (!from.modelled->model || !from.shape.state) {
    text += fmt::format("model: {} particles{}\n", with_commas(model.n_particles()), seconds_since(begun));
    next.shape.state = start_state(model);
    return Outcome::done;
  }
  // Where a garment that hangs would start does not matter to its shape.
  const bool hangs = from.shape.draped || from.shape.carried;
  if (hangs ? same_model(*from.modelled->model, model)
            : model::model_hash(*from.modelled->model) == model::model_hash(model)) {
    next.shape = from.shape;
    text += fmt::format("model: as it was{}\n", seconds_since(begun));
    return Outcome::done;
  }
  const PanelChanges changes = compare_panels(*from.modelled->model, model);
  text += fmt::format("model: {} particles", with_commas(model.n_particles()));
  if (!changes.meshed.empty()) text += "; meshed again: " + listed(changes.meshed, kMostListed);
  if (!changes.kept.empty()) text += "; kept: " + listed(changes.kept, kMostListed);
  if (!changes.gone.empty()) text += "; gone: " + listed(changes.gone, kMostListed);
  text += seconds_since(begun) + '\n';
  return carry_on(from, next, text);
}

Answer Session::ask(const Entry& entry) {
  Evaluated& evaluated = *stage_.evaluated;
  interpreter::Locals locals = it_;
  if (!it_text_.empty()) {
    const Entry last = read_entry(it_text_);
    if (interpreter::Asked it = interpreter::ask(evaluated.result, last.expr, {}, nullptr); it.value)
      locals["it"] = *it.value;
  }
  // The tree's places must lie in the sources of the script for what goes wrong in both.
  const grammar::SourceId id = evaluated.sources.add("<prompt>", entry.text);
  grammar::ExpressionResult parsed =
      grammar::parse_expression(evaluated.sources, id, interpreter::vocabulary());
  std::optional<DrapeAnswers> answers;
  if (stage_.shape.draped && stage_.modelled->model)
    answers.emplace(evaluated.result.garment, evaluated.result.bodies, *stage_.modelled->model,
                    *stage_.shape.state, stage_.shape.report);
  const interpreter::DrapeMeasures* drape = answers ? &*answers : nullptr;
  interpreter::Asked asked = interpreter::ask(evaluated.result, parsed.expr, locals, drape);
  if (!asked.value) {
    if (asked.diagnostics.empty())  // what it asks for was not evaluated: the script says why
      asked.diagnostics = evaluated.result.diagnostics;
    return {Outcome::refused, shown(asked.diagnostics, evaluated.sources, Severity::error)};
  }
  const std::string text = interpreter::describe_value(evaluated.result, *asked.value, drape);
  if (interpreter::is_plain(*asked.value)) {
    it_["it"] = *asked.value;
    it_text_.clear();
  } else if (!mentions_it(parsed.expr)) {
    it_.clear();
    it_text_ = entry.text;
  }
  return {Outcome::done, text + '\n'};
}

}  // namespace garment::session
