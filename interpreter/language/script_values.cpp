#include "interpreter/language/script_values.hpp"

#include "interpreter/language/acts.hpp"
#include "interpreter/language/evaluate.hpp"

namespace garment::interpreter {

std::map<std::size_t, std::string> values_by_line(Interpretation& interpretation,
                                                  const grammar::Sources& sources) {
  std::map<std::size_t, std::string> values;
  Program& program = *interpretation.program;
  const grammar::Diagnostics kept = program.diagnostics;
  for (const Item& item : program.main->items) {
    const std::string& keyword = item.statement->keyword.text;
    if (item.declaration == nullptr || (keyword != "let" && keyword != "param" && keyword != "measure"))
      continue;
    const Clause* value = item.statement->clauses.empty() ? nullptr : &item.statement->clauses[0];
    if (value != nullptr && !value->values.empty() && asks_drape(value->values[0], *item.scope)) continue;
    try {
      const Value& found = force(program, *item.declaration, item.statement->span);
      const Span& span = item.statement->span;
      values[sources.place(span.source, span.begin).line] = measure_value(item.declaration->name, found).text;
    } catch (const Stop&) {
    } catch (const Exhausted&) {
      break;
    }
  }
  program.diagnostics = kept;
  return values;
}

}  // namespace garment::interpreter
