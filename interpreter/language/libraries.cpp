#include "interpreter/language/libraries.hpp"

#include "interpreter/language/clauses.hpp"
#include "interpreter/language/declarations.hpp"
#include "interpreter/language/files.hpp"
#include "interpreter/language/standard_libraries.hpp"

namespace garment::interpreter {
namespace {

std::string stem(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  std::string name = slash == std::string::npos ? path : path.substr(slash + 1);
  return name.substr(0, name.find('.'));
}

/// `a` -> `b` -> `a`: the libraries being loaded, from the one that is met again.
std::string circle(const Program& program, const Module& met) {
  std::string path;
  bool inside = false;
  for (const Module& module : program.modules) {
    inside = inside || &module == &met;
    if (inside && module.loading) path += '`' + module.name + "` -> ";
  }
  return path + '`' + met.name + '`';
}

/// The text of the first of `paths` that can be read.
struct Found {
  std::string path, text;
};
Found read_first(Program& program, const std::vector<std::string>& paths, const std::string& name,
                 Span span) {
  std::string why;
  for (const std::string& path : paths) {
    HostResult<std::string> text = program.host.read_file(path, kMaxSourceBytes);
    if (text) return {path, std::move(*text.value)};
    why = text.error.message;
    if (text.error.denied)
      fail(program, Message("G0328", name + " lies outside the script's folder: a link leads out of it", span)
                        .help("put the file itself beside the script, or grant its folder with `--allow-read`"));
  }
  std::string hint = "libraries are " + standard_library_names() + "; other files are named in quotes";
  if (paths.size() > 1) hint += "; looked in `--library` folders and the standard library";
  fail(program, Message("G0318", "`" + name + "` cannot be used: " + why, span).help(hint));
}

Module& load(Program& program, const std::vector<std::string>& paths, const std::string& name,
             const Module& from, Span span) {
  const std::string written(program.sources.text(span));
  for (const std::string& path : paths)
    if (const auto known = program.loaded.find(path); known != program.loaded.end()) {
      if (known->second->loading)
        fail(
            program,
            Message("G1230", "libraries use each other in a circle: " + circle(program, *known->second), span)
                .help("move what both need into a third file"));
      return *known->second;
    }
  if (from.depth + 1 > kMaxUseDepth)
    fail(program,
         Message("G0318", "files use files more than " + std::to_string(kMaxUseDepth) + " deep", span));
  Found found = read_first(program, paths, written, span);
  Module& module = program.modules.emplace_back();
  module.name = name;
  module.library = true;
  module.loading = true;
  module.depth = from.depth + 1;
  module.used_at = from.library ? from.used_at : span;
  program.loaded.emplace(found.path, &module);
  const grammar::SourceId source = program.sources.add(found.path, std::move(found.text));
  grammar::ParseResult parsed = grammar::parse(program.sources, source, vocabulary());
  for (Diagnostic& diagnostic : parsed.diagnostics) {
    program.has_error = program.has_error || diagnostic.severity == Severity::error;
    program.diagnostics.push_back(std::move(diagnostic));
  }
  module.script = std::move(parsed.script);
  program.calls.push_back(span);
  register_module(program, module);
  program.calls.pop_back();
  module.loading = false;
  return module;
}

void bind_library(Program& program, Scope& scope, const std::string& name, Module& module, Span span) {
  if (const auto used = scope.module->uses.find(name); used != scope.module->uses.end())
    fail(program, Message("G1231", "a library is used as `" + name + "` already", span)
                      .also(used->second, "first here")
                      .help("once is enough; another file gets another name: `use \"FILE\" as NAME`"));
  check_new_name(program, name, span, scope);
  scope.values.emplace(name, Value{ModuleValue{&module}});
  scope.module->uses.emplace(name, span);
}

std::vector<std::string> places_of(const Program& program, const std::string& name) {
  std::vector<std::string> paths;
  for (const std::string& folder : program.options.library_dirs)
    paths.push_back(folder + '/' + name + ".garment");
  paths.push_back(program.options.stdlib_dir + '/' + name + ".garment");
  return paths;
}

void use_one(Program& program, const Expr& operand, const std::string& as, Scope& scope) {
  std::string name;
  std::vector<std::string> paths;
  if (operand.kind == ExprKind::name) {
    name = operand.text;
    paths = places_of(program, name);
  } else if (operand.kind == ExprKind::string) {
    const std::string file = readable_path(program, eval_text(program, operand, scope, "`use`"), operand.span);
    paths.push_back(program.options.script_dir.empty() || file[0] == '/'
                        ? file
                        : program.options.script_dir + '/' + file);
    name = stem(file);
  } else {
    fail(program, Message("G0306", "`use` takes a library's name or a file in quotes", operand.span));
  }
  if (!as.empty()) name = as;
  bind_library(program, scope, name, load(program, paths, name, *scope.module, operand.span), operand.span);
}

}  // namespace

void run_use(Program& program, const Statement& statement, Scope& scope) {
  Clauses clauses(program, statement, scope);
  const BoundClause* as = clauses.find("as");
  if (as != nullptr && statement.operands.size() != 1)
    fail(program, Message("G0313", "`as` names one library", as->clause->span));
  std::string name;
  if (as != nullptr) {
    const Expr& given = clauses.value(*as);
    if (given.kind != ExprKind::name) fail(program, Message("G0306", "`as` takes a name", given.span));
    name = given.text;
  }
  for (const Expr& operand : statement.operands) use_one(program, operand, name, scope);
  if (statement.operands.empty())
    fail(program, Message("G0312", "`use` needs a library's name", statement.keyword.span));
  clauses.finish();
}

void check_libraries(Program& program) {
  for (Module& module : program.modules) {
    if (!module.library) continue;
    program.calls.push_back(module.used_at);
    for (const Item& item : module.items) {
      const ConstructRecord* record = find_construct(item.statement->keyword.text);
      if (item.declaration != nullptr || record == nullptr || record->run == nullptr) continue;
      try {
        record->run(program, item);
      } catch (const Stop&) {
      }
    }
    program.calls.pop_back();
  }
}

}  // namespace garment::interpreter
