#include "interpreter/language/files.hpp"

#include "interpreter/language/clauses.hpp"
#include "interpreter/language/declarations.hpp"

namespace garment::interpreter {
namespace {

constexpr std::uint64_t kMaxFile = 4u << 20;
constexpr int kMaxUseDepth = 16;

bool stays_below(const std::string& path) {
  if (path.empty() || path[0] == '/' || path.find('\\') != std::string::npos ||
      path.find('\0') != std::string::npos)
    return false;
  std::size_t at = 0;
  while (at <= path.size()) {
    std::size_t end = path.find('/', at);
    if (end == std::string::npos) end = path.size();
    if (path.compare(at, end - at, "..") == 0) return false;
    at = end + 1;
  }
  return true;
}

std::string stem(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  std::string name = slash == std::string::npos ? path : path.substr(slash + 1);
  return name.substr(0, name.find('.'));
}

Module& load(Program& program, const std::string& path, const std::string& name, int depth, Span span) {
  if (const auto found = program.loaded.find(path); found != program.loaded.end()) return *found->second;
  if (depth > kMaxUseDepth) fail(program, Message("G0318", "files use files more than 16 deep", span));
  const HostResult<std::string> text = program.host.read_file(path, kMaxFile);
  if (!text)
    fail(program,
         Message("G0318",
                 "`" + std::string(program.sources.text(span)) + "` cannot be used: " + text.error.message,
                 span)
             .help("libraries are fabrics and bodies; other files are named in quotes"));
  Module& module = program.modules.emplace_back();
  module.name = name;
  module.library = true;
  module.depth = depth;
  program.loaded.emplace(path, &module);
  const grammar::SourceId source = program.sources.add(path, *text.value);
  grammar::ParseResult parsed = grammar::parse(program.sources, source, vocabulary());
  for (Diagnostic& diagnostic : parsed.diagnostics) {
    program.has_error = program.has_error || diagnostic.severity == Severity::error;
    program.diagnostics.push_back(std::move(diagnostic));
  }
  module.script = std::move(parsed.script);
  register_module(program, module);
  return module;
}

void bind_library(Program& program, Scope& scope, const std::string& name, Module& module, Span span) {
  check_new_name(program, name, span, scope);
  scope.values.emplace(name, Value{ModuleValue{&module}});
}

}  // namespace

std::string checked_path(Program& program, const std::string& path, Span span) {
  if (path.empty() || path.find('\0') != std::string::npos)
    fail(program, Message("G0328", "the file name is empty", span));
  if (!program.options.any_path && !stays_below(path))
    fail(program,
         Message("G0328", "`" + path + "` lies outside the script's folder", span)
             .help("put the file beside the script and name it without `/` at the start and without `..`"));
  return path;
}

void run_use(Program& program, const Statement& statement, Scope& scope) {
  Clauses clauses(program, statement, scope);
  const int depth = scope.module->depth + 1;
  const BoundClause* as = clauses.find("as");
  if (as != nullptr && statement.operands.size() != 1)
    fail(program, Message("G0313", "`as` names one library", as->clause->span));
  for (const Expr& operand : statement.operands) {
    std::string name, path;
    if (operand.kind == ExprKind::name) {
      name = operand.text;
      path = program.options.stdlib_dir + '/' + name + ".garment";
    } else if (operand.kind == ExprKind::string) {
      const std::string file =
          checked_path(program, eval_text(program, operand, scope, "`use`"), operand.span);
      path = program.options.script_dir.empty() || file[0] == '/' ? file
                                                                  : program.options.script_dir + '/' + file;
      name = stem(file);
    } else {
      fail(program, Message("G0306", "`use` takes a library's name or a file in quotes", operand.span));
    }
    if (as != nullptr) {
      const Expr& given = clauses.value(*as);
      if (given.kind != ExprKind::name) fail(program, Message("G0306", "`as` takes a name", given.span));
      name = given.text;
    }
    bind_library(program, scope, name, load(program, path, name, depth, operand.span), operand.span);
  }
  if (statement.operands.empty())
    fail(program, Message("G0312", "`use` needs a library's name", statement.keyword.span));
  clauses.finish();
}

}  // namespace garment::interpreter
