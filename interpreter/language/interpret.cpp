#include "interpreter/language/interpret.hpp"

#include <algorithm>

#include "interpreter/language/acts.hpp"
#include "interpreter/language/bodies.hpp"
#include "interpreter/language/cascades.hpp"
#include "interpreter/language/clauses.hpp"
#include "interpreter/language/closures.hpp"
#include "interpreter/language/declarations.hpp"
#include "interpreter/language/fabrics.hpp"
#include "interpreter/language/fit.hpp"
#include "interpreter/language/layers.hpp"
#include "interpreter/language/libraries.hpp"
#include "interpreter/language/modifiers.hpp"
#include "interpreter/language/notch_order.hpp"
#include "interpreter/language/panel_marks.hpp"
#include "interpreter/language/panels.hpp"
#include "interpreter/language/parameters.hpp"
#include "interpreter/language/parts.hpp"
#include "interpreter/language/placements.hpp"
#include "interpreter/language/recipe.hpp"
#include "interpreter/language/remedies.hpp"
#include "interpreter/language/seams.hpp"
#include "interpreter/language/studies.hpp"
#include "interpreter/language/support.hpp"
#include "interpreter/language/unused_names.hpp"

namespace garment::interpreter {
namespace {

template <class F>
void guarded(const F& run) {
  try {
    run();
  } catch (const Stop&) {
  }
}

void run_item(Program& program, const Item& item) {
  const Statement& statement = *item.statement;
  const ConstructRecord* record = find_construct(statement.keyword.text);
  PartGuard guard(program, item.scope->part);
  if (item.declaration != nullptr && (record == nullptr || record->run == nullptr)) {
    force(program, *item.declaration, statement.span);
    return;
  }
  if (record != nullptr && record->run != nullptr) return record->run(program, item);
  if (statement.keyword.text != "=")
    fail(program, Message("G0322", "`" + statement.keyword.text + "` cannot stand here", statement.keyword.span));
}

void check_both(Program& program) {
  // A `both` whose two rounds ran and found no operand with halves would state one thing twice.
  for (const Item& item : program.main->items) {
    const Scope& scope = *item.scope;
    const bool made = !scope.half.empty() && (scope.parent == nullptr || scope.parent->half.empty());
    if (!made || scope.half_used || scope.half != "left") continue;
    if (item.declaration != nullptr && item.declaration->state == Declaration::State::failed) continue;
    report(program,
           Message("G0330", "`both` finds no operand that has a left and a right half", item.statement->span)
               .help("panels on the fold have halves; leave `both` out otherwise"));
  }
}

void run_all(Program& program) {
  Module& module = *program.main;
  register_module(program, module);
  check_libraries(program);
  settle_declarations(program, module);
  collect_modifiers(program, module);
  apply_study(program);
  find_backs(program);
  check_given_parameters(program);
  for (const Item& item : module.items)
    if (item.declaration != nullptr && item.statement->keyword.text == "fabric")
      guarded([&] {
        const Value fabric = force(program, *item.declaration, item.statement->span);
        fabric_index(program, fabric.as<FabricValue>()->fabric);
      });
  for (const Item& item : module.items) guarded([&] { run_item(program, item); });
  const std::vector<Item> places = program.panel_places;
  for (const Item& item : places)
    guarded([&] {
      PartGuard guard(program, item.scope->part);
      run_place(program, item);
    });
  check_assignments(program, module);
  if (program.has_error) return;  // what follows would speak of things that are not there
  check_both(program);
  check_components(program);
  settle_layers(program);
  check_buttons(program);
  check_chains(program);
  check_notch_order(program);
  if (!program.has_error) take_seam_allowances(program);
  if (!program.has_error) check_unsewn(program);
  check_bodies(program);
  if (!program.has_error) check_support(program);
  if (!program.has_error && program.options.warn_unused && !is_library(program.main->script)) check_unused(program);
  if (!program.has_error) check_fit(program);
}

void sort_parameters(Program& program) {
  std::vector<Parameter> sorted;
  for (const Item& item : program.main->items)
    for (const Parameter& parameter : program.parameters)
      if (item.declaration != nullptr && item.declaration->name == parameter.name &&
          item.statement->keyword.text == "param")
        sorted.push_back(parameter);
  program.parameters = std::move(sorted);
}

std::vector<const grammar::Script*> scripts_of(const Program& program) {
  std::vector<const grammar::Script*> scripts;
  for (const Module& module : program.modules) scripts.push_back(&module.script);
  return scripts;
}

}  // namespace

bool Interpretation::ok() const {
  return std::none_of(diagnostics.begin(), diagnostics.end(),
                      [](const grammar::Diagnostic& d) { return d.severity == Severity::error; });
}

namespace {

/// A program with the host it reads files by.
struct ConfinedProgram {
  ConfinedHost host;
  Program program;
  ConfinedProgram(grammar::Sources& sources, Host& outer, const InterpretOptions& options)
      : host(outer, readable(options)), program(sources, host, options) {}

  static std::vector<std::string> readable(const InterpretOptions& options) {
    std::vector<std::string> folders = options.allow_read;
    folders.push_back(options.script_dir.empty() ? "." : options.script_dir);
    folders.insert(folders.end(), options.library_dirs.begin(), options.library_dirs.end());
    if (!options.stdlib_dir.empty()) folders.push_back(options.stdlib_dir);
    return folders;
  }
};

}  // namespace

bool may_be_library(const grammar::Script& script) {
  return std::all_of(script.statements.begin(), script.statements.end(), [](const Statement& statement) {
    const ConstructRecord* record = find_construct(statement.keyword.text);
    return statement.broken || (record != nullptr && record->in_library);
  });
}

bool is_library(const grammar::Script& script) {
  return may_be_library(script) &&
         std::any_of(script.statements.begin(), script.statements.end(), [](const Statement& statement) {
           const std::string& word = statement.keyword.text;
           return word == "fabric" || word == "component" || word == "fn";
         });
}

Interpretation interpret(grammar::Sources& sources, grammar::SourceId source, Host& host,
                         const InterpretOptions& options) {
  Interpretation result;
  const auto confined = std::make_shared<ConfinedProgram>(sources, host, options);
  result.program = std::shared_ptr<Program>(confined, &confined->program);
  Program& program = *result.program;
  grammar::ParseResult parsed = grammar::parse(sources, source, vocabulary());
  program.main = &program.modules.emplace_back();
  program.main->script = std::move(parsed.script);
  program.diagnostics = std::move(parsed.diagnostics);
  program.has_error = std::any_of(program.diagnostics.begin(), program.diagnostics.end(),
                                  [](const Diagnostic& d) { return d.severity == Severity::error; });
  try {
    run_all(program);
  } catch (const Exhausted&) {
    program.has_error = true;
  } catch (const Stop&) {
    program.has_error = true;
  }
  sort_parameters(program);
  // As a reader meets them: top to bottom, the script before its libraries.
  std::stable_sort(program.diagnostics.begin(), program.diagnostics.end(),
                   [](const Diagnostic& a, const Diagnostic& b) {
                     if (a.labels.empty() || b.labels.empty()) return !a.labels.empty() && b.labels.empty();
                     const Span &x = a.labels[0].span, &y = b.labels[0].span;
                     return x.source != y.source ? x.source < y.source : x.begin < y.begin;
                   });
  drop_cascades(program.diagnostics, sources);
  add_remedies(program.diagnostics, scripts_of(program));
  for (const PanelInfo& info : program.panels) program.garment.panels.push_back(info.panel);
  for (const SeamInfo& info : program.seams)
    if (info.ready) program.garment.seams.push_back(info.seam);
  for (const auto& body : program.built) result.bodies.push_back(body != nullptr ? *body : body::Body{});
  result.garment = program.garment;
  result.acts = options.study ? program.study_acts : program.acts;
  if (options.study)  // what the script measures is asked in each round
    for (const Act& act : program.acts)
      if (std::holds_alternative<MeasureAct>(act.act)) result.acts.push_back(act);
  result.parameters = program.parameters;
  result.measures = program.measures;
  result.solved = program.solved;
  result.diagnostics = program.diagnostics;
  result.origins = program.origins;
  result.script = &program.main->script;
  return result;
}

namespace {

/// Runs a question to the drape with fresh diagnostics and budgets.
template <class F>
grammar::Diagnostics ask(Program& program, const DrapeMeasures& measures, const F& run) {
  grammar::Diagnostics kept = std::move(program.diagnostics);
  program.diagnostics.clear();
  program.drape = &measures;
  program.steps = 0;
  try {
    run();
  } catch (const Stop&) {
  } catch (const Exhausted&) {
  }
  program.drape = nullptr;
  grammar::Diagnostics found = std::move(program.diagnostics);
  program.diagnostics = std::move(kept);
  add_remedies(found, scripts_of(program));
  return found;
}

}  // namespace

ExpectResult evaluate_expect(Interpretation& interpretation, const Act& act, const DrapeMeasures& measures) {
  ExpectResult result;
  const auto* expect = std::get_if<ExpectAct>(&act.act);
  if (expect == nullptr) return result;
  Program& program = *interpretation.program;
  Scope& scope = *static_cast<Scope*>(expect->scope);
  result.text = expect->text;
  result.diagnostics = ask(program, measures, [&] {
    const Verdict verdict = judge(program, *expect->statement, scope);
    result.passed = verdict.passed;
    result.found = verdict.found;
    result.expected = verdict.expected;
    result.value = verdict.value;
    if (!verdict.passed)
      report(program,
             Message("G0331", "`" + expect->text + "` does not hold", expect->statement->operands[0].span,
                     "found " + verdict.found + ", expected " + verdict.expected));
  });
  return result;
}

CurvePoint evaluate_curve(Interpretation& interpretation, const RecordAct& act, const DrapeMeasures& measures) {
  CurvePoint point;
  Program& program = *interpretation.program;
  Scope& scope = *static_cast<Scope*>(act.scope);
  auto number = [&](const Expr& expr, double& value, std::string& unit) {
    const MeasureValue found = measure_value("", eval(program, expr, scope));
    if (!found.value)
      fail(program, Message("G0306", "`" + std::string(program.sources.text(expr.span)) + "` is no number", expr.span)
                        .help("a curve is drawn of numbers, such as `position(corner).y` or `reaction(jaw).y`"));
    value = *found.value;
    unit = found.unit;
  };
  point.diagnostics = ask(program, measures, [&] {
    number(act.statement->operands[1], point.x, point.x_unit);
    number(act.statement->operands[2], point.y, point.y_unit);
  });
  return point;
}

MeasureResult evaluate_measure(Interpretation& interpretation, const Act& act,
                               const DrapeMeasures& measures) {
  MeasureResult result;
  const auto* measure = std::get_if<MeasureAct>(&act.act);
  if (measure == nullptr) return result;
  Program& program = *interpretation.program;
  Scope& scope = *static_cast<Scope*>(measure->scope);
  result.measure.name = measure->name;
  result.diagnostics = ask(program, measures, [&] {
    const Value value = eval(program, measure->statement->clauses[0].values[0], scope);
    result.measure = measure_value(measure->name, value);
  });
  return result;
}

}  // namespace garment::interpreter
