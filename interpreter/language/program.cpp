#include "interpreter/language/program.hpp"

namespace garment::interpreter {
namespace {
constexpr std::size_t kMaxDiagnostics = 200;
}  // namespace

OriginId Program::origin(Span span) {
  origins.push_back(span);
  return OriginId{static_cast<std::uint32_t>(origins.size() - 1)};
}

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
void show_caller(const Program& program, Diagnostic& d) {
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
  if (!program.in_library(d.labels[0].span)) {
    if (program.part != nullptr && !program.in_library(program.part->span) &&
        program.part->span != d.labels[0].span)
      d.labels.push_back({program.part->span, "in this part"});
    return;
  }
  for (std::size_t k = program.calls.size(); k-- > 0;) {
    if (program.in_library(program.calls[k])) continue;
    d.labels.insert(d.labels.begin(), {program.calls[k], is_part(program.calls[k])  ? "in this part"
                                                         : is_use(program.calls[k]) ? "used here"
                                                                                    : "in this call"});
    return;
  }
}

}  // namespace

void report(Program& program, Message message) {
  Diagnostic& d = message.diagnostic;
  const Span place = d.labels.empty() ? Span{} : d.labels[0].span;
  if (!d.labels.empty()) show_caller(program, d);
  if (d.severity == Severity::error) program.has_error = true;
  for (const Diagnostic& old : program.diagnostics) {
    if (old.code != d.code || old.labels.empty() || d.labels.empty()) continue;
    // Two parts of one component say the same mistake twice, each under its own name.
    const bool again = program.part != nullptr && old.labels[0].span == place && d.labels[0].span == place;
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
