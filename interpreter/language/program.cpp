#include "interpreter/language/program.hpp"

#include <algorithm>
#include <string_view>

namespace garment::interpreter {
namespace {
constexpr std::size_t kMaxDiagnostics = 200;
}  // namespace

Scope& Program::new_scope(Scope* parent) {
  Scope& scope = scopes.emplace_back();
  scope.parent = parent;
  if (parent != nullptr) {
    scope.module = parent->module;
    scope.half = parent->half;
    scope.part = parent->part;
  }
  return scope;
}

bool Program::in_library(Span span) const {
  for (const Module& module : modules)
    if (module.library && module.script.source == span.source) return true;
  return false;
}

Message::Message(std::string code, std::string text, Span span, std::string label) {
  diagnostic.code = std::move(code);
  diagnostic.message = std::move(text);
  diagnostic.labels.push_back({span, std::move(label)});
}
Message& Message::warning() {
  diagnostic.severity = Severity::warning;
  return *this;
}
Message& Message::also(Span span, std::string label) {
  diagnostic.labels.push_back({span, std::move(label)});
  return *this;
}
Message& Message::help(std::string text) {
  diagnostic.help = std::move(text);
  return *this;
}

namespace {

/// What goes wrong inside a library is the caller's news: the call or part in the script is the primary
/// place. In a component of the script the place stays, and the part is shown beside it.
std::optional<Caller> caller_of(const Program& program, Span place) {
  auto is_part = [&](Span span) {
    for (const Part* at = program.part; at != nullptr; at = at->outer)
      if (at->span == span) return true;
    return false;
  };
  auto is_use = [&](Span span) {
    for (const Module& module : program.modules)
      if (module.library && module.used_at == span) return true;
    return false;
  };
  if (!program.in_library(place)) {
    if (program.part == nullptr || program.in_library(program.part->span) || program.part->span == place) return {};
    return Caller{{program.part->span, "in this part"}, false};
  }
  for (std::size_t k = program.calls.size(); k-- > 0;) {
    const Span call = program.calls[k];
    if (program.in_library(call)) continue;
    return Caller{{call, is_part(call) ? "in this part" : is_use(call) ? "used here" : "in this call"}, true};
  }
  return {};
}

void show_caller(const Program& program, Diagnostic& d) {
  const std::optional<Caller> caller = caller_of(program, d.labels[0].span);
  if (!caller) return;
  for (const grammar::Label& label : d.labels)
    if (label.span == caller->label.span) return;
  d.labels.insert(caller->first ? d.labels.begin() : d.labels.end(), caller->label);
}

/// Mistakes of a drawing or a value that are found by computing: one wrong figure leads to many.
bool is_computed(const std::string& code) {
  constexpr std::string_view kCodes[] = {"G0309", "G0319", "G0320", "G0340", "G0341", "G0342", "G0344", "G0346", "G0347", "G0348",
                                         "G0402", "G0403", "G0405", "G0406", "G0407", "G0408", "G0413", "G0501"};
  return std::find(std::begin(kCodes), std::end(kCodes), code) != std::end(kCodes);
}

/// The values and functions that a declaration was made from, by way of others too.
void collect_needs(const Declaration& declaration, std::set<const Declaration*>& seen, std::set<const Declaration*>& values) {
  for (const Declaration* needed : declaration.needs) {
    if (!seen.insert(needed).second || needed->statement == nullptr) continue;
    const std::string& keyword = needed->statement->keyword.text;
    if (keyword == "let" || keyword == "fn") values.insert(needed);
    collect_needs(*needed, seen, values);
  }
}

std::set<const Declaration*> values_under(const Declaration& declaration) {
  std::set<const Declaration*> seen, values;
  collect_needs(declaration, seen, values);
  return values;
}

/// An error of the same code was told of something made from the same value or function: that one is wrong, most likely,
/// and correcting it corrects both.
bool has_common_cause(const Program& program, const Diagnostic& d) {
  if (d.severity != Severity::error || program.running.empty() || !is_computed(d.code)) return false;
  std::set<const Declaration*> values;
  for (const Declaration& declaration : program.declarations) {
    if (declaration.statement == nullptr || declaration.state != Declaration::State::failed) continue;
    const Span whole = declaration.statement->span;
    const bool told = std::any_of(program.diagnostics.begin(), program.diagnostics.end(), [&](const Diagnostic& old) {
      if (old.code != d.code || old.severity != Severity::error || old.labels.empty()) return false;
      const Span& place = old.labels[0].span;
      return place.source == whole.source && whole.begin <= place.begin && place.end <= whole.end;
    });
    if (!told) continue;
    if (values.empty()) values = values_under(*program.running.back());
    for (const Declaration* value : values_under(declaration))
      if (values.contains(value)) return true;
  }
  return false;
}

}  // namespace

OriginId Program::origin(Span span) { return origins.add(span, caller_of(*this, span)); }

void report(Program& program, Message message) {
  Diagnostic& d = message.diagnostic;
  const Span place = d.labels.empty() ? Span{} : d.labels[0].span;
  if (!d.labels.empty()) show_caller(program, d);
  if (d.severity == Severity::error) program.has_error = true;
  if (has_common_cause(program, d)) return;
  for (const Diagnostic& old : program.diagnostics) {
    if (old.code != d.code || old.labels.empty() || d.labels.empty()) continue;
    // Two parts of one component say the same mistake twice, each under its own name; in a library the parts come first.
    const bool again = program.part != nullptr && std::any_of(old.labels.begin(), old.labels.end(),
                                                              [&](const auto& label) { return label.span == place; }) &&
                       (d.labels[0].span == place || old.labels[0].span != d.labels[0].span);
    if (again || (old.labels[0].span == d.labels[0].span && old.message == d.message)) return;
  }
  if (program.diagnostics.size() < kMaxDiagnostics) program.diagnostics.push_back(std::move(d));
}

void fail(Program& program, Message message) {
  report(program, std::move(message));
  throw Stop{};
}

void count_step(Program& program, Span span) {
  if (++program.steps <= kMaxSteps) return;
  report(program, Message("G0317", "the script took 50 million steps and is not done", span)
                      .help("shorten the loops or the recursion that lead here"));
  throw Exhausted{};
}

}  // namespace garment::interpreter
