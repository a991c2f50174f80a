#include "interpreter/language/ask.hpp"

#include <algorithm>

#include "interpreter/language/evaluate.hpp"

namespace garment::interpreter {
namespace {

/// Lends the program to a question: its diagnostics are put aside, the drape is there for as long.
class Question {
 public:
  Question(Program& program, const DrapeMeasures* drape)
      : program_(program), diagnostics_(std::move(program.diagnostics)), has_error_(program.has_error) {
    program.diagnostics.clear();
    program.drape = drape;
    program.steps = 0;
    program.depth = 0;
  }
  Question(const Question&) = delete;
  Question& operator=(const Question&) = delete;
  ~Question() {
    program_.diagnostics = std::move(diagnostics_);
    program_.has_error = has_error_;
    program_.drape = nullptr;
  }
  grammar::Diagnostics found() { return std::move(program_.diagnostics); }

 private:
  Program& program_;
  grammar::Diagnostics diagnostics_;
  bool has_error_;
};

}  // namespace

Asked ask(Interpretation& interpretation, const grammar::Expr& expr, const Locals& locals,
          const DrapeMeasures* drape) {
  Asked asked;
  Program& program = *interpretation.program;
  if (program.main == nullptr || program.main->scope == nullptr) return asked;
  Scope scope;
  scope.parent = program.main->scope;
  scope.module = program.main->scope->module;
  for (const auto& [name, value] : locals) scope.values.emplace(name, value);
  Question question(program, drape);
  try {
    asked.value = eval(program, expr, scope);
  } catch (const Stop&) {
  } catch (const Exhausted&) {
  }
  asked.diagnostics = question.found();
  return asked;
}

bool asks_drape(const Interpretation& interpretation, const grammar::Expr& expr) {
  const Program& program = *interpretation.program;
  if (program.main == nullptr || program.main->scope == nullptr) return false;
  return asks_drape(expr, *program.main->scope);
}

bool is_plain(const Value& value) {
  if (const auto* list = value.as<ListValue>())
    return std::all_of((*list)->begin(), (*list)->end(), is_plain);
  if (const auto* record = value.as<RecordValue>())
    return std::all_of((*record)->begin(), (*record)->end(),
                       [](const auto& field) { return is_plain(field.second); });
  return value.as<Quantity>() != nullptr || value.as<bool>() != nullptr ||
         value.as<std::string>() != nullptr || value.as<PointValue>() != nullptr ||
         value.as<RangeValue>() != nullptr;
}

std::vector<DeclaredThing> declared_things(const Interpretation& interpretation) {
  std::vector<DeclaredThing> things;
  const Program& program = *interpretation.program;
  if (program.main == nullptr) return things;
  for (const Item& item : program.main->items) {
    if (item.declaration == nullptr) continue;
    const bool done = item.declaration->state == Declaration::State::done;
    things.push_back({item.declaration->name, item.statement->keyword.text, item.statement,
                      done ? &item.declaration->value : nullptr});
  }
  return things;
}

}  // namespace garment::interpreter
