#include "interpreter/language/program.hpp"

namespace garment::interpreter {
namespace {
constexpr std::size_t kMaxSteps = 50'000'000;
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

void report(Program& program, Message message) {
  Diagnostic& d = message.diagnostic;
  // What goes wrong inside a library is the caller's news: the call in the script is the primary place.
  if (!d.labels.empty() && program.in_library(d.labels[0].span)) {
    for (std::size_t k = program.calls.size(); k-- > 0;) {
      if (program.in_library(program.calls[k])) continue;
      d.labels.insert(d.labels.begin(), {program.calls[k], "in this call"});
      break;
    }
  }
  if (d.severity == Severity::error) program.has_error = true;
  for (const Diagnostic& old : program.diagnostics)
    if (old.code == d.code && !old.labels.empty() && old.labels[0].span == d.labels[0].span &&
        old.message == d.message)
      return;
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
