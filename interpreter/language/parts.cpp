#include "interpreter/language/parts.hpp"

#include <algorithm>

#include "interpreter/language/clauses.hpp"
#include "interpreter/language/declarations.hpp"
#include "interpreter/language/formal_parameters.hpp"
#include "interpreter/language/function_table.hpp"
#include "interpreter/language/word_lists.hpp"

namespace garment::interpreter {
namespace {

constexpr int kMaxPartDepth = 16;

const std::string& keyword_of(const Declaration& declaration) { return declaration.statement->keyword.text; }

Span part_span(const Declaration& declaration) {
  const Statement& statement = *declaration.statement;
  if (statement.name) return statement.name->span;
  return statement.operands.empty() ? statement.keyword.span : statement.operands[0].span;
}

std::vector<std::string> names_of(const Scope& scope, const char* keyword) {
  std::vector<std::string> names;
  for (const auto& [name, declaration] : scope.declared)
    if (keyword_of(*declaration) == keyword) names.push_back(name);
  return names;
}

[[noreturn]] void fail_component(Program& program, const std::string& name, Span span, const Scope& scope) {
  std::vector<std::string> names;
  for (const Scope* at = &scope; at != nullptr; at = at->parent)
    for (const std::string& known : names_of(*at, "component")) names.push_back(known);
  std::string hint = did_you_mean(name, names);
  if (hint.empty() && !names.empty()) hint = "the components are " + listed(names);
  if (hint.empty())
    hint = "declare it: `component " + name + "(...) { ... }`, or `use` the library that has it";
  fail(program, Message("G1220", "there is no component `" + name + "`", span).help(hint));
}

/// The component that `callee` names; nothing else of the script is evaluated.
Declaration& find_component(Program& program, const Expr& callee, Scope& scope) {
  Declaration* found = nullptr;
  if (callee.kind == ExprKind::name) {
    const std::string name = name_of(program, callee, scope);
    found = find_declaration(scope, name);
    if (found == nullptr && find_local(scope, name) == nullptr) {
      if (scope.module->has_broken) throw Stop{};
      fail_component(program, name, callee.span, scope);
    }
  } else if (callee.kind == ExprKind::member && callee.children[0].kind == ExprKind::name) {
    const Value* library = find_local(scope, callee.children[0].text);
    const auto* module = library == nullptr ? nullptr : library->as<ModuleValue>();
    if (module == nullptr && library == nullptr &&
        find_declaration(scope, callee.children[0].text) == nullptr)
      fail_unknown_name(program, callee.children[0].text, callee.children[0].span, scope);
    if (module != nullptr) {
      const auto at = module->module->scope->declared.find(callee.text);
      if (at != module->module->scope->declared.end()) found = at->second;
      if (found == nullptr && module->module->has_broken) throw Stop{};
      if (found == nullptr) fail_component(program, callee.text, callee.name_span, *module->module->scope);
    }
  }
  if (found == nullptr || keyword_of(*found) != "component") {
    Message message("G1221", "`" + std::string(program.sources.text(callee.span)) + "` is no component",
                    callee.span);
    if (found != nullptr)
      message.also(part_span(*found), "it is a " + keyword_of(*found)).help("`part NAME = COMPONENT(...)`");
    fail(program, message);
  }
  if (found->state == Declaration::State::failed) throw Stop{};
  return *found;
}

Value evaluate_argument(Program& program, Declaration& declaration) {
  const Statement& statement = *declaration.statement;
  const Expr* expr = &statement.clauses[0].values[0];
  Scope* scope = declaration.scope;
  for (Override& change : declaration.overrides) {
    if (!change.path.empty()) continue;
    change.used = true;
    expr = change.value;
    scope = change.scope;
  }
  const std::string kind = statement.operands.empty() ? "" : statement.operands[0].text;
  return checked_kind(program, statement.name->text, kind, eval(program, *expr, *scope), expr->span);
}

/// An argument is a declaration of the part's scope: evaluated when it is asked for, changed by assignment.
void declare_argument(Program& program, const Part& part, const FormalParameter& parameter, const Expr& value,
                      Scope& scope, Span span) {
  if (find_unit(parameter.name) || find_function(parameter.name) != nullptr)
    fail(program,
         Message("G0303", "the parameter `" + parameter.name + "` hides a unit or builtin", parameter.span));
  Statement& statement = program.made_statements.emplace_back();
  statement.keyword = {"let", span, {}};
  statement.name = grammar::Name{parameter.name, span, {}};
  statement.span = span;
  if (!parameter.kind.empty()) {
    Expr& kind = statement.operands.emplace_back();
    kind.kind = ExprKind::name;
    kind.text = parameter.kind;
    kind.span = span;
  }
  Clause& clause = statement.clauses.emplace_back();
  clause.word = {"=", span, {}};
  clause.values.push_back(value);
  clause.span = value.span;
  Declaration& declaration = program.declarations.emplace_back();
  declaration.name = part.name + '.' + parameter.name;
  declaration.statement = &statement;
  declaration.scope = &scope;
  declaration.module = scope.module;
  declaration.evaluate = evaluate_argument;
  part.scope->declared.emplace(parameter.name, &declaration);
}

void bind_arguments(Program& program, const Part& part, const Declaration& component, const Expr& call,
                    Scope& scope) {
  const Expr& head = component.statement->operands[0];
  const std::vector<FormalParameter> parameters = parameters_of(program, head);
  const std::vector<std::size_t> given =
      match_arguments(program, component.name, parameters, call, head.span);
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    const bool own = given[p] != 0;
    const Expr& value = own ? call.children[given[p]] : *parameters[p].standard;
    declare_argument(program, part, parameters[p], value, own ? scope : *part.scope,
                     own ? value.span : parameters[p].span);
  }
}

void check_depth(Program& program, const Part& part, const Expr& call) {
  if (part.depth <= kMaxPartDepth) return;
  part.component->state = Declaration::State::failed;  // said once, and no part of it any more
  std::string chain;
  bool itself = false;
  for (const Part* at = part.outer; at != nullptr; at = at->outer) {
    itself = itself || at->component == part.component;
    if (chain.size() < 60) chain += " in `" + at->component->name + "`";
  }
  fail(program,
       Message("G1222",
               itself ? "component `" + part.component->name + "` needs a part of itself"
                      : "parts are nested more than " + std::to_string(kMaxPartDepth) + " deep",
               call.span)
           .also(part_span(*part.component), "declared here")
           .help("`" + part.component->name + "`" + chain + " ...: end the recursion with an `if`, at most " +
                 std::to_string(kMaxPartDepth) + " deep"));
}

/// The words of `a.b.c`; empty if it is not of that shape.
std::vector<std::string> words_of(Program& program, const Expr& expr, Scope& scope) {
  if (expr.kind == ExprKind::name) return {name_of(program, expr, scope)};
  if (expr.kind != ExprKind::member || expr.children.empty()) return {};
  std::vector<std::string> words = words_of(program, expr.children[0], scope);
  if (!words.empty()) words.push_back(name_of(program, expr, scope));
  return words;
}

Declaration* first_of(Scope& scope, std::vector<std::string>& words, Declaration*& twin) {
  if (find_local(scope, words[0]) != nullptr) return nullptr;
  Declaration* found = find_declaration(scope, words[0]);
  std::size_t used = 1;
  if (found == nullptr && words.size() > 1) {
    found = find_declaration(scope, words[0] + '.' + words[1]);
    used = 2;
  }
  if (found == nullptr && !scope.half.empty()) {
    found = find_declaration(scope, words[0] + '.' + scope.half);
    used = 1;
  }
  if (found == nullptr && scope.half.empty()) {
    found = find_declaration(scope, words[0] + ".left");
    twin = find_declaration(scope, words[0] + ".right");
    if (twin == nullptr) found = nullptr;
    used = 1;
  }
  if (found != nullptr) words.erase(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(used));
  return found;
}

DeclaredPath follow(Program& program, std::vector<std::string> words, Scope& scope, int depth, bool through) {
  if (words.empty() || depth > kMaxPartDepth) return {};
  DeclaredPath path;
  path.declaration = first_of(scope, words, path.twin);
  while (path.declaration != nullptr) {
    Declaration& at = *path.declaration;
    if (is_argument(at) && (through || !words.empty()) && at.overrides.empty()) {
      const DeclaredPath meant = follow(
          program, words_of(program, at.statement->clauses[0].values[0], *at.scope), *at.scope, depth + 1, through);
      if (meant.declaration == nullptr) break;
      path.declaration = meant.declaration;
      path.twin = meant.twin;
      words.insert(words.begin(), meant.rest.begin(), meant.rest.end());
      continue;
    }
    if (keyword_of(at) != "part" || at.index < 0 || words.empty()) break;
    const Scope& inner = *program.parts[static_cast<std::size_t>(at.index)].scope;
    auto found = inner.declared.find(words[0]);
    std::size_t used = 1;
    if (found == inner.declared.end() && words.size() > 1) {
      found = inner.declared.find(words[0] + '.' + words[1]);
      used = 2;
    }
    if (found == inner.declared.end()) {
      found = inner.declared.find(words[0] + ".left");
      const auto right = inner.declared.find(words[0] + ".right");
      if (found == inner.declared.end() || right == inner.declared.end()) break;
      path.twin = right->second;
      used = 1;
    }
    path.declaration = found->second;
    words.erase(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(used));
  }
  path.rest = std::move(words);
  return path;
}

}  // namespace

Value evaluate_component(Program& program, Declaration& declaration) {
  const Statement& statement = *declaration.statement;
  if (statement.operands.size() != 1)
    fail(program, Message("G0313", "a component has one head: `component NAME(PARAMETERS) { ... }`",
                          statement.operands[1].span));
  if (!statement.body)
    fail(program,
         Message("G0312", "component `" + declaration.name + "` needs a block", statement.keyword.span)
             .help("write `component " + declaration.name + "(...) { panel ...; port ... }`"));
  parameters_of(program, statement.operands[0]);
  return Value{ThingValue{"component", &declaration, -1}};
}

Value evaluate_part(Program& program, Declaration& declaration) {
  Clauses clauses(program, *declaration.statement, *declaration.scope);
  clauses.value(clauses.need("="));
  clauses.finish();
  return Value{ThingValue{"part", &declaration, declaration.index}};
}

Value evaluate_port(Program& program, Declaration& declaration) {
  Clauses clauses(program, *declaration.statement, *declaration.scope);
  const Expr& expr = clauses.value(clauses.need("="));
  clauses.finish();
  Value value = eval(program, expr, *declaration.scope);
  if (value.as<EdgeValue>() != nullptr) return value;
  fail(program,
       Message("G1223",
               kind_of(value) + " where port `" + declaration.statement->name->text + "` takes an edge",
               expr.span)
           .help("a port is an edge, a part of one, a line or a chain: `port cap = upper.cap`"));
}

void expand_part(Program& program, const Item& item) {
  Declaration& declaration = *item.declaration;
  const Statement& statement = *item.statement;
  declaration.state = Declaration::State::failed;  // until its block is taken in
  Clauses clauses(program, statement, *item.scope);
  const Expr& call = clauses.value(clauses.need("="));
  Declaration& component =
      find_component(program, call.kind == ExprKind::call ? call.children[0] : call, *item.scope);
  if (component.statement->operands.size() != 1 || !component.statement->body) throw Stop{};  // said of it
  count_step(program, statement.span);
  Part& part = program.parts.emplace_back();
  part.name = declaration.name;
  part.outer = item.scope->part;
  part.component = &component;
  part.span = statement.span;
  part.depth = part.outer == nullptr ? 1 : part.outer->depth + 1;
  check_depth(program, part, call);
  part.scope = &program.new_scope(component.scope);
  part.scope->module = component.module;
  part.scope->half.clear();
  part.scope->part = &part;
  const int index = static_cast<int>(program.parts.size()) - 1;
  bind_arguments(program, part, component, call, *item.scope);
  declaration.index = index;
  declaration.state = Declaration::State::waiting;
  PartGuard guard(program, &part);
  register_part(program, part, *component.statement->body);
}

bool is_argument(const Declaration& declaration) { return declaration.evaluate == evaluate_argument; }

DeclaredPath find_path(Program& program, const Expr& expr, Scope& scope, bool through) {
  return follow(program, words_of(program, expr, scope), scope, 0, through);
}

Value part_member(Program& program, const Expr& expr, const ThingValue& thing, const std::string& name) {
  const Part& part = program.parts[static_cast<std::size_t>(thing.index)];
  const auto found = part.scope->declared.find(name);
  if (found != part.scope->declared.end()) return force(program, *found->second, expr.name_span);
  fail_part_member(program, part, name, expr.name_span);
}

void fail_part_member(Program& program, const Part& part, const std::string& name, Span span) {
  if (part.broken || part.component->module->has_broken) throw Stop{};
  std::vector<std::string> names;
  for (const auto& [key, declaration] : part.scope->declared) names.push_back(key);
  const std::vector<std::string> ports = names_of(*part.scope, "port");
  std::string hint = did_you_mean(name, names);
  if (hint.empty()) hint = ports.empty() ? "it has no ports" : "its ports are " + listed(ports);
  fail(program, Message("G1224", "part `" + part.name + "` has no `" + name + "`", span)
                    .also(part_span(*part.component), "its component")
                    .help(hint));
}

void check_components(Program& program) {
  if (is_library(program.main->script)) return;
  for (const Item& item : program.main->items) {
    if (item.declaration == nullptr || keyword_of(*item.declaration) != "component" ||
        item.scope->part != nullptr)
      continue;
    const bool used = std::any_of(program.parts.begin(), program.parts.end(),
                                  [&](const Part& part) { return part.component == item.declaration; });
    if (!used)
      report(program,
             Message("G1225", "component `" + item.declaration->name + "` is declared and never used",
                     part_span(*item.declaration))
                 .warning()
                 .help("write `part NAME = " + item.declaration->name +
                       "(...)`; what its block says is checked only then"));
  }
}

PartGuard::PartGuard(Program& program, const Part* part)
    : program_(program), before_(program.part), calls_(program.calls.size()) {
  program.part = part;
  if (part == before_) return;
  std::vector<Span> chain;
  for (const Part* at = part; at != nullptr; at = at->outer) chain.push_back(at->span);
  program.calls.insert(program.calls.end(), chain.rbegin(), chain.rend());
}

PartGuard::~PartGuard() {
  program_.part = before_;
  program_.calls.resize(calls_);
}

}  // namespace garment::interpreter
