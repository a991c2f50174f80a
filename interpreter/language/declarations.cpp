#include "interpreter/language/declarations.hpp"

#include <algorithm>
#include <cmath>

#include "interpreter/language/evaluate.hpp"
#include "interpreter/language/function_table.hpp"
#include "interpreter/language/libraries.hpp"
#include "interpreter/language/parts.hpp"
#include "interpreter/language/word_lists.hpp"

namespace garment::interpreter {
namespace {

bool is_control(const Statement& statement) {
  return statement.keyword.text == "for" || statement.keyword.text == "if";
}

void count_expanded(Program& program, Span span) {
  count_step(program, span);
  if (++program.expanded <= kMaxStatements) return;
  report(program, Message("G0327", "loops made more than 100000 statements", span).help("shorten the range"));
  throw Exhausted{};
}

/// Values that `for NAME in ...` runs through.
std::vector<Value> loop_values(Program& program, const Statement& statement, Scope& scope) {
  if (statement.clauses.empty() || statement.clauses[0].values.size() != 1)
    fail(program, Message("G0312", "`for` needs `in` and a range or list", statement.keyword.span));
  const Expr& expr = statement.clauses[0].values[0];
  const Value value = eval(program, expr, scope);
  if (const auto* list = value.as<ListValue>()) {
    if ((*list)->size() > kMaxStatements)
      fail(program, Message("G0327", "the loop would run " + std::to_string((*list)->size()) + " times", expr.span)
                        .help("at most 100000"));
    return **list;
  }
  const auto* range = value.as<RangeValue>();
  if (range == nullptr || !range->from.dimension.none())
    fail(program, Message("G0306", kind_of(value) + " where `for` takes a range of whole numbers or a list",
                          expr.span)
                      .help("as in `for i in 1 .. 6 { ... }`; lengths are `for x in steps(0 cm .. 10 cm, 2 cm) { ... }`"));
  const double from = range->from.value, to = range->to.value;
  if (from != std::floor(from) || std::fabs(from) > 1e9)
    fail(program, Message("G0309", "a loop starts at a whole number, this at " + format_quantity(from, {}),
                          expr.span)
                      .help("count whole numbers and compute from them: `for i in 1 .. 6 { ... i / 2 ... }`"));
  if (to - from > static_cast<double>(kMaxStatements))
    fail(program,
         Message("G0327",
                 "the loop would run " +
                     std::to_string(static_cast<long long>(std::min(to - from, 1e15)) + 1) + " times",
                 expr.span)
             .help("at most 100000"));
  std::vector<Value> values;
  for (double x = from; x <= to; x += 1) values.push_back(number_value(x));
  return values;
}

/// Name of a statement that declares one; the function's name for `fn f(x)`.
const grammar::Name* declared_name(const Statement& statement, grammar::Name& made) {
  if (statement.name) return &*statement.name;
  const bool called = statement.keyword.text == "fn" || statement.keyword.text == "component";
  if (called && !statement.operands.empty()) {
    const Expr& head = statement.operands[0];
    const Expr& name = head.kind == ExprKind::call ? head.children[0] : head;
    if (name.kind != ExprKind::name) return nullptr;
    made = {name.text, name.span, {}};
    return &made;
  }
  return nullptr;
}

class Registrar {
 public:
  /// Takes statements of `module` into `root`; of a part, under its name.
  Registrar(Program& program, Module& module, Scope& root, Part* part)
      : program_(program),
        module_(module),
        root_(root),
        part_(part),
        all_(part == nullptr ? module.items : program.main->items) {}

  void take_block(const grammar::Block& block, Scope& scope, bool nested) {
    // Plain declarations first, so that loop ranges may speak of what stands below them.
    std::vector<std::vector<Item>> items(block.size());
    for (std::size_t k = 0; k < block.size(); ++k) {
      if (is_control(block[k])) continue;
      guarded([&] { take(block[k], scope, nested, items[k]); });
    }
    for (std::size_t k = 0; k < block.size(); ++k) {
      all_.insert(all_.end(), items[k].begin(), items[k].end());
      if (is_control(block[k])) guarded([&] { expand(block[k], scope); });
      for (const Item& item : items[k])
        if (item.statement->keyword.text == "part" && item.declaration != nullptr)
          guarded([&] { expand_part(program_, item); });
    }
  }

 private:
  template <class F>
  void guarded(const F& run) {
    try {
      run();
    } catch (const Stop&) {
      if (part_ != nullptr) part_->broken = true;
    }
  }

  void expand(const Statement& statement, Scope& scope) {
    if (statement.broken) {
      module_.has_broken = true;
      return;
    }
    if (statement.keyword.text == "if") {
      if (statement.operands.empty()) throw Stop{};
      const bool holds = eval_truth(program_, statement.operands[0], scope, "`if`");
      if (holds && statement.body) take_block(*statement.body, program_.new_scope(&scope), true);
      if (!holds && statement.else_body) take_block(*statement.else_body, program_.new_scope(&scope), true);
      return;
    }
    if (!statement.name || !statement.body) throw Stop{};
    for (const Value& value : loop_values(program_, statement, scope)) {
      count_expanded(program_, statement.keyword.span);
      Scope& round = program_.new_scope(&scope);
      round.values.emplace(statement.name->text, value);
      take_block(*statement.body, round, true);
    }
  }

  void take(const Statement& statement, Scope& scope, bool nested, std::vector<Item>& items) {
    const std::string& keyword = statement.keyword.text;
    if (nested) count_expanded(program_, statement.keyword.span);
    if (keyword == "both") {
      if (statement.broken || !statement.body || statement.body->empty()) return;
      for (const char* half : {"left", "right"}) {
        Scope& side = program_.new_scope(&scope);
        side.half = half;
        take_plain(statement.body->front(), side, nested, std::string(".") + half, items);
      }
      return;
    }
    take_plain(statement, scope, nested, "", items);
  }

  void take_plain(const Statement& statement, Scope& scope, bool nested, const std::string& suffix,
                  std::vector<Item>& items) {
    const std::string& keyword = statement.keyword.text;
    const ConstructRecord* record = find_construct(keyword);
    if (record == nullptr && keyword != "=") {
      if (statement.broken || is_control(statement)) module_.has_broken = true;
      if (!statement.broken)
        report(program_, Message("G0322", "`" + keyword + "` cannot stand here", statement.keyword.span));
      return;
    }
    const bool unsupported = record != nullptr && !record->supported;
    if (unsupported && !statement.broken)
      report(program_, Message("G0315", "`" + keyword + "` is not supported yet", statement.keyword.span)
                           .help(kStillToCome));
    if (!statement.broken && !unsupported) {
      if (module_.library && part_ == nullptr && (record == nullptr || !record->in_library))
        fail(program_, Message("G0322", "a used file may not have `" + keyword + "`", statement.keyword.span)
                           .help("it may have use, let, fn, fabric, component and assert"));
      if (keyword == "use") return use(statement, scope);
      if (nested && (keyword == "param" || keyword == "garment"))
        fail(program_,
             Message("G0322", "`" + keyword + "` stands at the top level only", statement.keyword.span));
    }
    if (keyword == "join" && !statement.broken) return take_join(statement, scope, suffix, items);
    if (keyword == "pair panel") return take_pair(statement, scope, nested, items);
    Item item{&statement, &scope, nullptr};
    grammar::Name made;
    const grammar::Name* name = declared_name(statement, made);
    if (name != nullptr) {
      item.declaration = declare(*name, statement, scope, nested, suffix);
      if (statement.broken || unsupported) item.declaration->state = Declaration::State::failed;
    } else if (statement.broken) {
      module_.has_broken = module_.has_broken || record == nullptr || record->declares_name ||
                           keyword == "fn" || keyword == "use";
    }
    if (!statement.broken && !unsupported) items.push_back(item);
  }

  void use(const Statement& statement, Scope& scope) {
    try {
      run_use(program_, statement, scope);
    } catch (const Stop&) {  // the name it should have brought is no second mistake
      module_.has_broken = true;
      throw;
    }
  }

  /// A join declares a seam that is called as its port.
  void take_join(const Statement& statement, Scope& scope, const std::string& suffix,
                 std::vector<Item>& items) {
    const Statement& seam = make_join(program_, statement);
    Declaration& declaration = program_.declarations.emplace_back();
    declaration.name = prefix() + join_name(program_, statement, scope) + suffix;
    declaration.statement = &seam;
    declaration.scope = &scope;
    declaration.module = &module_;
    declaration.evaluate = evaluate_join;
    items.push_back({&seam, &scope, &declaration});
  }

  std::string prefix() const { return part_ == nullptr ? "" : part_->name + '.'; }

  /// `pair panel NAME`: NAME.left as drawn, and NAME.right, its image.
  void take_pair(const Statement& statement, Scope& scope, bool nested, std::vector<Item>& items) {
    if (!statement.name) {
      module_.has_broken = module_.has_broken || statement.broken;
      return;
    }
    if (!scope.half.empty())
      fail(program_, Message("G0322", "`pair panel` makes a left and a right panel already", statement.keyword.span)
                         .help("leave `both` out"));
    check_new_name(program_, fill_name(program_, *statement.name, scope), statement.name->span, root_);
    Declaration* left = nullptr;
    for (const char* half : {"left", "right"}) {
      Scope& side = program_.new_scope(&scope);
      side.half = half;
      side.half_used = true;
      Item item{&statement, &side, declare(*statement.name, statement, side, nested, std::string(".") + half)};
      item.declaration->pair_left = left;
      if (left == nullptr) left = item.declaration;
      if (statement.broken)
        item.declaration->state = Declaration::State::failed;
      else
        items.push_back(item);
    }
  }

  Declaration* declare(const grammar::Name& written, const Statement& statement, Scope& scope, bool nested,
                       const std::string& suffix) {
    const std::string name = fill_name(program_, written, scope) + suffix;
    const std::string& keyword = statement.keyword.text;
    const bool local = nested && (keyword == "let" || keyword == "fn");
    Scope& target = local ? scope : root_;
    try {
      check_new_name(program_, name, written.span, target);
    } catch (const Stop&) {  // what speaks of a refused name is no second mistake
      module_.has_broken = true;
      throw;
    }
    Declaration& declaration = program_.declarations.emplace_back();
    declaration.name = prefix() + name;
    declaration.statement = &statement;
    declaration.scope = &scope;
    declaration.module = &module_;
    target.declared.emplace(name, &declaration);
    return &declaration;
  }

  Program& program_;
  Module& module_;
  Scope& root_;
  Part* part_;
  std::vector<Item>& all_;
};

/// An argument or a param: what can be set as a whole.
bool is_settable(const Declaration& declaration) {
  return declaration.statement->keyword.text == "param" || is_argument(declaration);
}

[[noreturn]] void fail_target(Program& program, const Expr& target, Scope& scope) {
  const Expr* first = &target;
  while (first->kind == ExprKind::member && !first->children.empty()) first = &first->children[0];
  if (first->kind != ExprKind::name)
    fail(program, Message("G0311", "`" + std::string(program.sources.text(target.span)) + "` cannot be assigned to", target.span)
                      .help("what is assigned is a name or a property: `long = 70 cm`, `front.waist_dart.depth = 11 cm`"));
  const std::string name = name_of(program, *first, scope);
  if (find_local(scope, name) != nullptr)
    fail(program, Message("G0311", "a library cannot be changed", target.span)
                      .help("make your own: `fabric mine = fabrics.denim with { ... }`"));
  if (first == &target && find_declaration(scope, name) == nullptr && !known_name_is_near(program, name, scope))
    fail(program, Message("G0301", "nothing to assign to is named `" + name + "`", target.span)
                      .help("a new value is declared: `let " + name + " = ...`"));
  fail_unknown_name(program, name, target.span, scope);
}

/// Puts the assignment `item` to what it changes of `declaration`.
void assign_to(Program& program, const Item& item, const std::vector<std::string>& rest, Declaration& declaration) {
  const Statement& statement = *item.statement;
  const Expr& target = statement.operands[0];
  const int depth = item.scope->part == nullptr ? 0 : item.scope->part->depth;
  for (Override& other : declaration.overrides) {
    if (other.path != rest) continue;
    if (other.depth == depth)
      fail(program,
           Message("G0321", "`" + std::string(program.sources.text(target.span)) + "` is assigned twice",
                   target.span)
               .also(other.span, "first here"));
    // What is said outside a part holds over what its component says.
    if (depth < other.depth)
      other = {rest, &statement.operands[1], item.scope, target.span, false, depth};
    return;
  }
  declaration.overrides.push_back({rest, &statement.operands[1], item.scope, target.span, false, depth});
}

void attach_assignment(Program& program, const Item& item) {
  const Statement& statement = *item.statement;
  if (statement.operands.size() != 2) throw Stop{};
  const Expr& target = statement.operands[0];
  const DeclaredPath path = find_path(program, target, *item.scope);
  if (path.declaration == nullptr) fail_target(program, target, *item.scope);
  Declaration& declaration = *path.declaration;
  if (declaration.state == Declaration::State::failed) throw Stop{};
  if (!path.rest.empty() && declaration.statement->keyword.text == "part")
    fail_part_member(program, program.parts[static_cast<std::size_t>(declaration.index)], path.rest[0],
                     target.span);
  if (path.rest.empty() && !is_settable(declaration))
    fail(program, Message("G0311",
                          "`" + declaration.name + "` is a " + declaration.statement->keyword.text +
                              "; only a param can be set as a whole",
                          target.span)
                      .also(declaration.statement->span, "declared here")
                      .help("change it where it is declared, make it a `param`, or assign one of its properties"));
  assign_to(program, item, path.rest, declaration);
  if (path.twin != nullptr) assign_to(program, item, path.rest, *path.twin);
}

}  // namespace

void check_new_name(Program& program, const std::string& name, Span span, Scope& scope) {
  const char* const longer = "take a longer name";
  if (find_unit(name))
    fail(program, Message("G0303", "`" + name + "` is a unit and cannot be a name", span).help(longer));
  if (find_function(name) != nullptr)
    fail(program, Message("G0303", "`" + name + "` is a builtin and cannot be a name", span).help(longer));
  if (name == "start" || name == "end" || name == "true" || name == "false")
    fail(program,
         Message("G0303", "`" + name + "` has a meaning of its own and cannot be a name", span).help(longer));
  auto declared = scope.declared.find(name);
  if (declared == scope.declared.end()) {  // a pair takes the name of both
    const auto pair = scope.declared.find(name + ".left");
    if (pair != scope.declared.end() && pair->second->statement->keyword.text == "pair panel") declared = pair;
  }
  if (declared != scope.declared.end() || scope.values.contains(name)) {
    Message message("G0302", "the name `" + name + "` is taken", span);
    if (declared != scope.declared.end() && declared->second->statement != nullptr) {
      const Statement& first = *declared->second->statement;
      message.also(first.name ? first.name->span : first.keyword.span, "first here");
    }
    fail(program, message.help("every name is declared once"));
  }
}

void register_module(Program& program, Module& module) {
  module.scope = &program.new_scope(nullptr);
  module.scope->module = &module;
  Registrar(program, module, *module.scope, nullptr)
      .take_block(module.script.statements, *module.scope, false);
}

void register_part(Program& program, Part& part, const grammar::Block& block) {
  Registrar(program, *part.component->module, *part.scope, &part).take_block(block, *part.scope, false);
}

void settle_declarations(Program& program, Module& module) {
  for (const Item& item : module.items) {
    if (item.declaration == nullptr) continue;
    const ConstructRecord* record = find_construct(item.statement->keyword.text);
    if (record != nullptr && record->reserve != nullptr && item.declaration->index < 0)
      item.declaration->index = record->reserve(program, *item.declaration);
  }
  for (const Item& item : module.items) {
    if (item.statement->keyword.text != "=") continue;
    PartGuard guard(program, item.scope->part);
    try {
      attach_assignment(program, item);
    } catch (const Stop&) {
    }
  }
}

namespace {

/// What of a declared thing can be assigned: its clauses, or of a panel its values and what is drawn in it.
std::vector<std::string> assignable(const Program& program, const Declaration& declaration, const ConstructRecord* record) {
  std::vector<std::string> words;
  if (record == nullptr) return words;
  const bool is_panel = std::find(record->body_keywords.begin(), record->body_keywords.end(), "grain") != record->body_keywords.end();
  if (is_panel && declaration.index >= 0) {
    words = {"resolution", "grain", "label"};
    for (const auto& [name, span] : program.panels[static_cast<std::size_t>(declaration.index)].spans) words.push_back(name);
  } else {
    for (const ClauseRecord& clause : record->clauses) words.emplace_back(clause.word);
  }
  return words;
}

}  // namespace

void check_assignments(Program& program, Module& module) {
  std::vector<Span> told;  // what changes a left and a right thing is wrong once
  for (const Item& item : module.items) {
    if (item.declaration == nullptr || item.declaration->state != Declaration::State::done) continue;
    const ConstructRecord* record = find_construct(item.statement->keyword.text);
    PartGuard guard(program, item.scope->part);
    for (const Override& change : item.declaration->overrides) {
      const bool twin = std::find(told.begin(), told.end(), change.span) != told.end();
      if (change.used || twin) continue;
      told.push_back(change.span);
      std::string path = item.declaration->name;
      for (const std::string& word : change.path) path += '.' + word;
      std::vector<std::string> words = assignable(program, *item.declaration, record);
      std::size_t at = 0;  // the word of the path that is not there
      if (change.path.size() > 1 && std::find(words.begin(), words.end(), change.path[0]) != words.end()) {
        at = 1;
        words.clear();
        for (const char* drawn : {"dart", "pleat", "tuck", "notch", "edge"})
          for (const ClauseRecord& clause : find_construct(drawn)->clauses) words.emplace_back(clause.word);
      }
      report(program, Message("G0311", "there is no `" + path + "` to assign to", change.span)
                          .help(meant_or_listed(change.path.empty() ? "" : change.path[at], words, "what can be assigned is")));
    }
  }
}

void expand_block(Program& program, const grammar::Block& block, Scope& scope,
                  const std::function<void(const Statement&, Scope&)>& take) {
  for (const Statement& statement : block) {
    count_step(program, statement.span);
    if (statement.broken) throw Stop{};  // what remains would be judged on half its text
    if (!is_control(statement)) {
      take(statement, scope);
      continue;
    }
    if (statement.keyword.text == "if") {
      if (statement.operands.empty()) throw Stop{};
      const bool holds = eval_truth(program, statement.operands[0], scope, "`if`");
      if (holds && statement.body) expand_block(program, *statement.body, program.new_scope(&scope), take);
      if (!holds && statement.else_body)
        expand_block(program, *statement.else_body, program.new_scope(&scope), take);
      continue;
    }
    if (!statement.name || !statement.body) throw Stop{};
    for (const Value& value : loop_values(program, statement, scope)) {
      count_expanded(program, statement.keyword.span);
      Scope& round = program.new_scope(&scope);
      round.values.emplace(statement.name->text, value);
      expand_block(program, *statement.body, round, take);
    }
  }
}

}  // namespace garment::interpreter
