// Declarations on demand: each evaluated once, cycles told with their path.
#include <algorithm>

#include "interpreter/language/clauses.hpp"
#include "interpreter/language/declarations.hpp"
#include "interpreter/language/evaluate.hpp"
#include "interpreter/language/parts.hpp"

namespace garment::interpreter {
namespace {

Span name_span(const Declaration& declaration) {
  const Statement& statement = *declaration.statement;
  return statement.name ? statement.name->span : statement.keyword.span;
}

[[gnu::noinline]] const Expr& defining_value(Program& program, const Declaration& declaration) {
  Clauses clauses(program, *declaration.statement, *declaration.scope);
  const Expr& expr = clauses.value(clauses.need("="));
  clauses.finish();
  return expr;
}

[[noreturn]] [[gnu::noinline]] void fail_no_value(Program& program, const Declaration& declaration) {
  fail(program,
       Message("G0306",
               "`" + declaration.name + "` is a " + declaration.statement->keyword.text + " and has no value",
               name_span(declaration)));
}

[[gnu::noinline]] Value evaluate(Program& program, Declaration& declaration) {
  if (declaration.evaluate != nullptr) return declaration.evaluate(program, declaration);
  const ConstructRecord* record = find_construct(declaration.statement->keyword.text);
  if (record == nullptr || record->evaluate == nullptr) fail_no_value(program, declaration);
  // The condition of an `if` may ask before all declarations have their places.
  if (record->reserve != nullptr && declaration.index < 0) declaration.index = record->reserve(program, declaration);
  return record->evaluate(program, declaration);
}

[[noreturn]] [[gnu::noinline]] void fail_cycle(Program& program, const Declaration& declaration,
                                               Span asked_at) {
  const auto first = std::find(program.running.begin(), program.running.end(), &declaration);
  std::string path;
  for (auto at = first; at != program.running.end(); ++at) path += '`' + (*at)->name + "` -> ";
  Message message("G0304", "`" + declaration.name + "` needs itself: " + path + '`' + declaration.name + '`',
                  asked_at);
  for (auto at = first; at != program.running.end(); ++at) message.also(name_span(**at), "");
  fail(program, message.help("break the circle: one of these must not depend on the next"));
}

struct RunningGuard {
  Program& program;
  RunningGuard(Program& p, Declaration& d) : program(p) { p.running.push_back(&d); }
  RunningGuard(const RunningGuard&) = delete;
  RunningGuard& operator=(const RunningGuard&) = delete;
  ~RunningGuard() { program.running.pop_back(); }
};

/// A measure that asks the drape has another value after each drape: it is never kept.
bool changes(const Declaration& declaration) {
  return declaration.statement->keyword.text == "measure" && !declaration.statement->clauses.empty() &&
         !declaration.statement->clauses[0].values.empty() &&
         asks_drape(declaration.statement->clauses[0].values[0], *declaration.scope);
}

}  // namespace

Value evaluate_let(Program& program, Declaration& declaration) {
  return eval(program, defining_value(program, declaration), *declaration.scope);
}

Value evaluate_function(Program& program, Declaration& declaration) {
  check_function(program, declaration);
  return Value{FunctionValue{&declaration}};
}

const Value& force(Program& program, Declaration& declaration, Span asked_at) {
  using State = Declaration::State;
  if (!program.running.empty()) program.running.back()->needs.insert(&declaration);
  if (declaration.state == State::done) return declaration.value;
  if (declaration.state == State::failed) throw Stop{};
  if (declaration.state == State::running) fail_cycle(program, declaration, asked_at);
  RunningGuard guard(program, declaration);
  PartGuard part(program, declaration.scope->part);
  const bool keep = !changes(declaration);
  declaration.state = State::running;
  try {
    declaration.value = evaluate(program, declaration);
  } catch (const Stop&) {
    declaration.state = keep ? State::failed : State::waiting;
    throw;
  }
  declaration.state = keep ? State::done : State::waiting;
  return declaration.value;
}

}  // namespace garment::interpreter
