#include "interpreter/service/names.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "interpreter/language/program.hpp"
#include "interpreter/service/symbols.hpp"

namespace garment::service {
namespace {

using namespace interpreter;

constexpr int kMaxLike = 64;  // panels that are like panels that are like ...

using Table = std::map<std::string, int, std::less<>>;  // name -> thing

bool is_control(const Statement& statement) { return is_any(statement.keyword.text, {"if", "for", "both"}); }
bool is_panel(std::string_view keyword) { return is_any(keyword, {"panel", "pair panel"}); }

template <class F>
void for_each_statement(const grammar::Block& block, const F& run) {
  for (const Statement& statement : block) {
    if (!is_control(statement)) {
      run(statement);
      continue;
    }
    if (statement.body) for_each_statement(*statement.body, run);
    if (statement.else_body) for_each_statement(*statement.else_body, run);
  }
}

/// Names of one file or component: what its statements declare.
struct Home {
  const Module* module = nullptr;
  const Home* outer = nullptr;  ///< of a component: the file that it is written in
  Table names;
};

class Builder {
 public:
  Builder(Program& program, Names& names) : program_(program), names_(names) {}

  void build() {
    for (const Declaration& declaration : program_.declarations)
      if (declaration.statement != nullptr) declarations_.emplace(declaration.statement, &declaration);
    for (const Module& module : program_.modules) declare_module(module);
    for (const Module& module : program_.modules) {
      Home& home = homes_[&module];
      std::vector<Table> locals;
      walk_block(module.script.statements, home, locals, -1);
    }
    auto place = [](const NameUse& use) {
      return std::tuple(use.span.source, use.span.begin, use.span.end, use.thing);
    };
    std::sort(names_.uses.begin(), names_.uses.end(),
              [&](const NameUse& a, const NameUse& b) { return place(a) < place(b); });
    names_.uses.erase(std::unique(names_.uses.begin(), names_.uses.end(),
                                  [&](const NameUse& a, const NameUse& b) { return place(a) == place(b); }),
                      names_.uses.end());
  }

 private:
  // ---- things

  int add_thing(std::string keyword, Span name, Span statement, std::string doc, const std::string& owner,
                int part_of) {
    const auto key = std::pair(name.source, name.begin);
    if (const auto found = by_place_.find(key); found != by_place_.end()) return found->second;
    Named thing;
    thing.name = std::string(program_.sources.text(name));
    thing.keyword = std::move(keyword);
    thing.owner = owner;
    thing.definition = name;
    thing.statement = statement;
    thing.doc = std::move(doc);
    thing.part_of = part_of;
    thing.in_library = program_.in_library(name);
    thing.composed = thing.name.find('{') != std::string::npos;
    names_.things.push_back(std::move(thing));
    const int id = static_cast<int>(names_.things.size()) - 1;
    by_place_[key] = id;
    names_.uses.push_back({name, id, true});
    return id;
  }

  int add_declared(const Statement& statement, const std::string& owner, int part_of) {
    const Span* name = declared_span(statement);
    if (name == nullptr || name->begin == name->end) return -1;
    return add_thing(statement.keyword.text, *name, statement.span, statement.doc, owner, part_of);
  }

  void use(Span span, int thing) {
    if (thing >= 0) names_.uses.push_back({span, thing, false});
  }

  void declare_module(const Module& module) {
    Home& home = homes_[&module];
    home.module = &module;
    declare_block(module.script.statements, home, "");
  }

  /// All declarations of a block but the `let` and `fn` of inner blocks, which are local.
  void declare_block(const grammar::Block& block, Home& home, const std::string& owner) {
    for (const Statement& statement : block)
      if (statement.keyword.text == "use") declare_use(statement, home);
    for_each_statement(block, [&](const Statement& statement) {
      const int id = add_declared(statement, owner, -1);
      if (id < 0) return;
      const std::string& name = names_.things[static_cast<std::size_t>(id)].name;
      home.names.emplace(name, id);
      statements_[id] = &statement;
      homes_of_things_[id] = &home;
      if (statement.keyword.text == "component" && statement.body) declare_component(statement, id, home);
    });
  }

  void declare_component(const Statement& statement, int id, Home& home) {
    if (component_homes_.contains(id)) return;
    Home& inside = component_homes_[id];
    inside.module = home.module;
    inside.outer = &home;
    inside.names = parameters(statement);
    declare_block(*statement.body, inside, names_.things[static_cast<std::size_t>(id)].name);
  }

  void declare_use(const Statement& statement, Home& home) {
    if (home.module == nullptr || home.module->scope == nullptr) return;
    auto bind = [&](const std::string& name, Span span) {
      const auto value = home.module->scope->values.find(name);
      if (value == home.module->scope->values.end()) return;
      const auto* module = value->second.as<ModuleValue>();
      if (module == nullptr) return;
      const int id = add_thing("library", span, statement.span, "", "", -1);
      names_.things[static_cast<std::size_t>(id)].in_library = true;
      home.names.emplace(name, id);
      libraries_[id] = module->module;
    };
    for (const Expr& operand : statement.operands)
      if (operand.kind == ExprKind::name) bind(operand.text, operand.span);
    for (const Clause& clause : statement.clauses)
      for (const Expr& value : clause.values)
        if (value.kind == ExprKind::name) bind(value.text, value.span);
  }

  // ---- members of panels

  static const Clause* clause_of(const Statement& statement, std::string_view word) {
    for (const Clause& clause : statement.clauses)
      if (clause.word.text == word) return &clause;
    return nullptr;
  }

  /// Edges, darts, notches ... of a panel by name, those of the panel that it is like included.
  const Table& members(int panel, int depth = 0) {
    if (const auto found = members_.find(panel); found != members_.end()) return found->second;
    Table table;
    const auto statement = statements_.find(panel);
    if (statement == statements_.end() || depth > kMaxLike) return members_[panel] = table;
    members_[panel] = {};  // a panel like itself has none
    const Statement& panel_statement = *statement->second;
    if (const Clause* like = clause_of(panel_statement, "like"); like != nullptr && !like->values.empty())
      table = members(source_panel(panel, like->values[0]), depth + 1);
    if (panel_statement.body) take_members(*panel_statement.body, panel, table);
    return members_[panel] = table;
  }

  int source_panel(int panel, const Expr& expr) {
    const bool half = expr.kind == ExprKind::member && is_any(expr.text, {"left", "right"});
    return find_name(half ? expr.children[0] : expr, *homes_of_things_[panel], {});
  }

  void take_members(const grammar::Block& body, int panel, Table& table) {
    const Table inherited = table;
    const std::string owner = names_.things[static_cast<std::size_t>(panel)].name;
    for_each_statement(body, [&](const Statement& statement) { change_inherited(statement, panel, table); });
    for_each_statement(body, [&](const Statement& statement) {
      if (statement.keyword.text == "outline") {
        for (const auto& [name, id] : inherited)
          if (is_any(names_.things[static_cast<std::size_t>(id)].keyword, {"edge", "close"}))
            table.erase(name);
        if (const Clause* as = clause_of(statement, "as"); as != nullptr && !as->values.empty())
          if (as->values[0].kind == ExprKind::name)
            table[as->values[0].text] =
                add_thing("edge", as->values[0].span, statement.span, statement.doc, owner, panel);
      }
      take_member(statement, owner, panel, table);
      if (statement.body)
        for_each_statement(*statement.body,
                           [&](const Statement& inner) { take_member(inner, owner, panel, table); });
    });
  }

  void take_member(const Statement& statement, const std::string& owner, int panel, Table& table) {
    if (is_any(statement.keyword.text, {"let", "fn"})) return;
    const int id = add_declared(statement, owner, panel);
    if (id >= 0) table[names_.things[static_cast<std::size_t>(id)].name] = id;
  }

  /// `rename OLD as NEW`, `remove NAME`, `replace edge NAME` in the block of a panel like another.
  void change_inherited(const Statement& statement, int panel, Table& table) {
    const std::string& keyword = statement.keyword.text;
    const std::vector<Expr>& operands = statement.operands;
    if (operands.empty()) return;
    auto take = [&](const Expr& expr) {
      const auto found = table.find(expr.text);
      const int id = found == table.end() ? -1 : found->second;
      use(expr.span, id);
      if (keyword != "replace" && id >= 0) table.erase(expr.text);
      return id;
    };
    if (keyword == "replace" && operands.size() > 1) take(operands[1]);
    if (keyword == "remove")
      for (const Expr& operand : operands) take(operand);
    const Clause* as = clause_of(statement, "as");
    if (keyword != "rename" || as == nullptr || as->values.empty()) return;
    const int id = take(operands[0]);
    const Expr& name = as->values[0];
    if (id < 0 || name.kind != ExprKind::name) return;
    const Named old = names_.things[static_cast<std::size_t>(id)];
    table[name.text] = add_thing(old.keyword, name.span, statement.span, old.doc,
                                 names_.things[static_cast<std::size_t>(panel)].name, panel);
  }

  // ---- names in expressions

  static int find_in(const Table& table, std::string_view name) {
    const auto found = table.find(name);
    return found == table.end() ? -1 : found->second;
  }

  /// A name that a loop made ("gore_1"), by the declaration that the evaluator knows under it.
  int find_made(const std::string& name, const Home& home) {
    if (home.module == nullptr || home.module->scope == nullptr) return -1;
    const auto& declared = home.module->scope->declared;
    auto found = declared.find(name);
    if (found == declared.end()) found = declared.find(name + ".left");
    if (found == declared.end() || found->second->statement == nullptr) return -1;
    const Span* span = declared_span(*found->second->statement);
    if (span == nullptr) return -1;
    const auto id = by_place_.find(std::pair(span->source, span->begin));
    return id == by_place_.end() ? -1 : id->second;
  }

  int find_name(const Expr& expr, Home& home, const std::vector<Table>& locals) {
    if (expr.kind != ExprKind::name) return -1;
    // A name with braces means what is declared with the same braces.
    const std::string name =
        expr.children.empty() ? expr.text : std::string(program_.sources.text(expr.span));
    for (auto at = locals.rbegin(); at != locals.rend(); ++at)
      if (const int id = find_in(*at, name); id >= 0) return id;
    for (const Home* at = &home; at != nullptr; at = at->outer)
      if (const int id = find_in(at->names, name); id >= 0) return id;
    return find_made(name, home);
  }

  int keep_panel(int id) {
    if (id < 0) return -1;
    const Named& thing = names_.things[static_cast<std::size_t>(id)];
    if (is_panel(thing.keyword)) return id;
    if (thing.part_of >= 0) return thing.part_of;
    // `let p = front`: by its value.
    if (const auto statement = statements_.find(id); statement != statements_.end() && thing.keyword == "let")
      if (const auto known = declarations_.find(statement->second); known != declarations_.end())
        return panel_of_value(known->second->value);
    return -1;
  }

  int panel_of_value(const Value& value) {
    int index = -1;
    if (const auto* v = value.as<PanelValue>()) index = v->panel;
    if (const auto* v = value.as<HalfValue>()) index = v->panel;
    if (const auto* v = value.as<EdgeValue>(); v != nullptr && v->spans.size() == 1)
      index = v->spans[0].panel;
    if (index < 0) return -1;
    return find_made(program_.panels[static_cast<std::size_t>(index)].panel.name, homes_[program_.main]);
  }

  /// Walks an operand or a clause's value: a bare name there is first of all one of the panel's own.
  int walk_value(const Expr& expr, Home& home, std::vector<Table>& locals, int panel) {
    direct_ = true;
    return walk(expr, home, locals, panel);
  }

  /// Walks an expression and notes its names; gives the panel that it speaks of, or -1.
  int walk(const Expr& expr, Home& home, std::vector<Table>& locals, int panel) {
    const bool direct = direct_;
    direct_ = false;
    switch (expr.kind) {
      case ExprKind::name: {
        for (const Expr& part : expr.children) walk(part, home, locals, panel);
        const bool own = panel >= 0 && !is_local(expr.text, locals);
        int id = own && direct ? find_in(members(panel), expr.text) : -1;
        if (id < 0) id = find_name(expr, home, locals);
        if (id < 0 && own) id = find_in(members(panel), expr.text);
        if (id < 0) id = find_mentioned(expr);
        use(expr.span, id);
        last_ = id;
        const int found = keep_panel(id);
        if (found >= 0) mentioned_.insert(found);
        return found;
      }
      case ExprKind::member:
        return walk_member(expr, home, locals, panel);
      case ExprKind::range_index:
      case ExprKind::index: {
        const int base = walk(expr.children[0], home, locals, panel);
        for (std::size_t k = 1; k < expr.children.size(); ++k)
          walk_value(expr.children[k], home, locals, base >= 0 ? base : panel);
        last_ = -1;
        return base;
      }
      case ExprKind::call:
        return walk_call(expr, home, locals, panel);
      default:
        for (const Expr& child : expr.children) walk(child, home, locals, panel);
        last_ = -1;
        return -1;
    }
  }

  static bool is_local(const std::string& name, const std::vector<Table>& locals) {
    return std::any_of(locals.begin(), locals.end(), [&](const Table& t) { return t.contains(name); });
  }

  /// `region r in front: within 10 cm of waist`: an edge of a panel that the statement spoke of before.
  int find_mentioned(const Expr& expr) {
    int found = -1;
    for (const int panel : mentioned_) {
      const int id = find_in(members(panel), expr.text);
      if (id >= 0 && found >= 0 && id != found) use(expr.span, id);
      if (found < 0) found = id;
    }
    return found;
  }

  int walk_member(const Expr& expr, Home& home, std::vector<Table>& locals, int panel) {
    const int base = walk(expr.children[0], home, locals, panel);
    const int thing = last_;
    for (std::size_t k = 1; k < expr.children.size(); ++k) walk(expr.children[k], home, locals, panel);
    last_ = -1;
    if (const auto library = libraries_.find(thing); library != libraries_.end()) {
      last_ = find_in(homes_[library->second].names, expr.text);
      use(expr.name_span, last_);
      return -1;
    }
    if (is_any(expr.text, {"left", "right"})) {
      last_ = thing;
      return base;
    }
    if (const Home* inside = home_of_part(thing)) {
      last_ = find_in(inside->names, expr.text);
      use(expr.name_span, last_);
      return keep_panel(last_);
    }
    if (base < 0) return -1;
    last_ = find_in(members(base), expr.text);
    use(expr.name_span, last_);
    return base;
  }

  /// The names of the component that a `part` uses; null for other things.
  const Home* home_of_part(int thing) {
    if (thing < 0 || names_.things[static_cast<std::size_t>(thing)].keyword != "part") return nullptr;
    const auto statement = statements_.find(thing);
    if (statement == statements_.end()) return nullptr;
    const Clause* value = clause_of(*statement->second, "=");
    if (value == nullptr || value->values.empty()) return nullptr;
    const Expr& expr = value->values[0];
    const int component =
        find_called(expr.kind == ExprKind::call ? expr.children[0] : expr, *homes_of_things_[thing]);
    const auto inside = component_homes_.find(component);
    return inside == component_homes_.end() ? nullptr : &inside->second;
  }

  /// The thing that `sleeve` or `blocks.sleeve` names.
  int find_called(const Expr& expr, Home& home) {
    if (expr.kind != ExprKind::member) return find_name(expr, home, {});
    const auto library = libraries_.find(find_name(expr.children[0], home, {}));
    return library == libraries_.end() ? -1 : find_in(homes_[library->second].names, expr.text);
  }

  int walk_call(const Expr& expr, Home& home, std::vector<Table>& locals, int panel) {
    const int base = walk(expr.children[0], home, locals, panel);
    const int function = last_;
    const bool marks =
        expr.children[0].kind == ExprKind::member && expr.children[0].text == "at" && base >= 0;
    for (std::size_t k = 1; k < expr.children.size(); ++k) {
      if (k - 1 < expr.labels.size() && !expr.labels[k - 1].text.empty())
        use(expr.labels[k - 1].span, parameter_of(function, expr.labels[k - 1].text));
      direct_ = marks;
      walk(expr.children[k], home, locals, marks ? base : panel);
    }
    last_ = -1;
    return -1;
  }

  int parameter_of(int function, const std::string& name) {
    const auto statement = statements_.find(function);
    if (statement == statements_.end()) return -1;
    return find_in(parameters(*statement->second), name);
  }

  /// Parameters of a `fn` or `component`, as things.
  Table parameters(const Statement& statement) {
    Table table;
    if (statement.operands.empty() || statement.operands[0].kind != ExprKind::call) return table;
    const Expr& head = statement.operands[0];
    for (std::size_t k = 1; k < head.children.size(); ++k) {
      const bool labelled = k - 1 < head.labels.size() && !head.labels[k - 1].text.empty();
      if (!labelled && head.children[k].kind != ExprKind::name) continue;
      const Span span = labelled ? head.labels[k - 1].span : head.children[k].span;
      const int id = add_thing("parameter", span, cover(span, head.children[k].span), "",
                               std::string(head.children[0].text), -1);
      table.emplace(names_.things[static_cast<std::size_t>(id)].name, id);
    }
    return table;
  }

  // ---- statements

  void walk_block(const grammar::Block& block, Home& home, std::vector<Table>& locals, int panel) {
    for (const Statement& statement : block) walk_statement(statement, home, locals, panel);
  }

  void walk_statement(const Statement& statement, Home& home, std::vector<Table>& locals, int panel) {
    mentioned_.clear();
    const std::string& keyword = statement.keyword.text;
    if (is_any(keyword, {"rename", "remove", "replace"}) && panel >= 0) {
      members(panel);  // notes its names
      if (keyword == "replace") walk_clauses(statement, home, locals, panel);
      return;
    }
    if (keyword == "use") return;
    const bool has_parameters = keyword == "fn" || keyword == "component";
    if (has_parameters) locals.push_back(parameters(statement));
    if (statement.name)
      for (const Expr& part : statement.name->parts) walk(part, home, locals, panel);
    int placed = panel;
    if (has_parameters)
      walk_defaults(statement, home, locals, panel);
    else
      for (const Expr& operand : statement.operands) {
        const int found = walk_value(operand, home, locals, panel);
        if (found >= 0 && keyword == "place") placed = found;
      }
    const int own = is_panel(keyword) ? thing_of(statement) : placed;
    walk_clauses(statement, home, locals, own);
    if (keyword == "for" && statement.name)
      locals.push_back({{statement.name->text,
                         add_thing("variable", statement.name->span, statement.name->span, "", "", -1)}});
    walk_bodies(statement, home, locals, is_panel(keyword) ? own : panel);
    if (has_parameters || (keyword == "for" && statement.name)) locals.pop_back();
  }

  void walk_defaults(const Statement& statement, Home& home, std::vector<Table>& locals, int panel) {
    if (statement.operands.empty() || statement.operands[0].kind != ExprKind::call) return;
    const Expr& head = statement.operands[0];
    for (std::size_t k = 1; k < head.children.size(); ++k)
      if (head.children[k].kind == ExprKind::binary && head.children[k].children.size() == 2)
        walk(head.children[k].children[1], home, locals, panel);
  }

  void walk_clauses(const Statement& statement, Home& home, std::vector<Table>& locals, int panel) {
    for (const Clause& clause : statement.clauses)
      for (const Expr& value : clause.values) {
        // The head of a panel speaks of its fabric and its source; its own edges come after `fold`.
        const bool head = is_panel(statement.keyword.text) && clause.word.text != "on";
        walk_value(value, home, locals, head ? -1 : panel);
      }
  }

  void walk_bodies(const Statement& statement, Home& home, std::vector<Table>& locals, int panel) {
    for (const auto* body : {&statement.body, &statement.else_body}) {
      if (!*body) continue;
      const std::string& keyword = statement.keyword.text;
      if (const auto inside = component_homes_.find(thing_of(statement));
          keyword == "component" && inside != component_homes_.end()) {
        walk_block(**body, inside->second, locals, -1);
        continue;
      }
      locals.push_back(local_names(**body, is_control(statement)));
      walk_block(**body, home, locals, panel);
      locals.pop_back();
    }
  }

  /// `let` and `fn` of an inner block are known in it alone.
  Table local_names(const grammar::Block& block, bool control) {
    Table table;
    if (!control) return table;
    for (const Statement& statement : block)
      if (is_any(statement.keyword.text, {"let", "fn"})) {
        const int id = add_declared(statement, "", -1);
        if (id >= 0) table.emplace(names_.things[static_cast<std::size_t>(id)].name, id);
      }
    return table;
  }

  int thing_of(const Statement& statement) {
    const Span* span = declared_span(statement);
    if (span == nullptr) return -1;
    const auto found = by_place_.find(std::pair(span->source, span->begin));
    return found == by_place_.end() ? -1 : found->second;
  }

  Program& program_;
  Names& names_;
  std::map<const Module*, Home> homes_;
  std::map<int, Home> component_homes_;  ///< by component
  std::map<std::pair<grammar::SourceId, std::uint32_t>, int> by_place_;
  std::map<int, const Statement*> statements_;
  std::map<const Statement*, const Declaration*> declarations_;  ///< looked up only
  std::map<int, Home*> homes_of_things_;
  std::map<int, const Module*> libraries_;
  std::map<int, Table> members_;
  std::set<int> mentioned_;  ///< panels that the statement spoke of so far
  bool direct_ = false;      ///< the expression to walk next is a whole value
  int last_ = -1;            ///< the thing that the expression just walked names
};

}  // namespace

std::vector<const NameUse*> Names::at(grammar::SourceId source, std::uint32_t offset) const {
  std::vector<const NameUse*> found;
  for (const NameUse& use : uses)
    if (use.span.source == source && use.span.begin <= offset && offset <= use.span.end)
      found.push_back(&use);
  return found;
}

std::vector<const NameUse*> Names::of(int thing) const {
  std::vector<const NameUse*> found;
  for (const NameUse& use : uses)
    if (use.thing == thing) found.push_back(&use);
  return found;
}

Names names_of(const interpreter::Interpretation& interpretation) {
  Names names;
  Builder(*interpretation.program, names).build();
  return names;
}

}  // namespace garment::service
