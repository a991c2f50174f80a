#include "interpreter/language/recipe.hpp"

#include <algorithm>

#include "interpreter/language/clauses.hpp"
#include "interpreter/language/declarations.hpp"
#include "interpreter/language/panels.hpp"
#include "interpreter/language/word_lists.hpp"

namespace garment::interpreter {
namespace {

const std::vector<std::string> kValues = {"grain", "resolution", "label"};

bool is_value(const std::string& word) {
  return std::find(kValues.begin(), kValues.end(), word) != kValues.end();
}

template <class F>
void for_each_item(Recipe& recipe, const F& run) {
  for (std::vector<RecipeItem>* items : recipe.lists())
    for (RecipeItem& item : *items) run(item);
}

RecipeItem* find_item(Recipe& recipe, const std::string& name) {
  RecipeItem* found = nullptr;
  for_each_item(recipe, [&](RecipeItem& item) {
    if (item.name == name) found = &item;
  });
  return found;
}

std::vector<std::string> item_names(Recipe& recipe) {
  std::vector<std::string> names;
  for_each_item(recipe, [&](RecipeItem& item) { names.push_back(item.name); });
  return names;
}

class RecipeMaker {
 public:
  RecipeMaker(Program& program, Declaration& declaration)
      : program_(program),
        declaration_(declaration),
        scope_(declaration.pair_left != nullptr ? *declaration.pair_left->scope : *declaration.scope) {}

  Recipe make() {
    const Statement& statement = *declaration_.statement;
    Clauses clauses(program_, statement, scope_, &declaration_.overrides);
    const BoundClause* like = clauses.find("like");
    const bool mirrored = clauses.flag("mirrored");
    if (mirrored && like == nullptr)
      fail(program_, Message("G0313", "`mirrored` goes with `like PANEL`", statement.keyword.span));
    if (like != nullptr) take_source(clauses.value(*like), *like->scope);
    recipe_.mirrored = recipe_.mirrored != mirrored;
    if (const BoundClause* of = clauses.find("of"))
      recipe_.fabric = {&clauses.value(*of), of->scope, of->clause->span};
    if (const BoundClause* on = clauses.find("on")) take_fold(*on);
    for (const char* word : {"under", "over"}) clauses.skip(word);  // once all panels are known: settle_layers
    clauses.finish();
    if (!statement.operands.empty())
      fail(program_, Message("G0313", "`" + std::string(program_.sources.text(statement.operands[0].span)) + "` means nothing in a panel's head", statement.operands[0].span));
    inherited_ = like != nullptr;
    if (statement.body) take_body(*statement.body);
    for (Override& change : declaration_.overrides) assign(change);
    // One of a pair is the other's image: the right one, but behind the body the left one, as with the halves of a fold.
    const bool image = (declaration_.pair_left != nullptr) != program_.panels[static_cast<std::size_t>(declaration_.index)].on_back;
    if (statement.keyword.text == "pair panel" && image) recipe_.mirrored = !recipe_.mirrored;
    return std::move(recipe_);
  }

 private:
  void take_source(const Expr& expr, Scope& scope) {
    const int source = eval_panel(program_, expr, scope, "`like`");
    recipe_ = *program_.recipes[source];
  }

  void take_fold(const BoundClause& on) {
    const std::vector<Expr>& values = on.clause->values;
    if (values.size() != 2 || values[0].kind != ExprKind::name || values[0].text != "fold" ||
        values[1].kind != ExprKind::name)
      fail(program_,
           Message("G0313", "`on` takes `fold EDGE` here", on.clause->span).help("as in `on fold cf`"));
    recipe_.fold = name_of(program_, values[1], *on.scope);
    recipe_.fold_span = values[1].span;
  }

  void take_body(const grammar::Block& body) {
    std::vector<std::pair<const Statement*, Scope*>> statements;
    expand_block(program_, body, scope_, [&](const Statement& statement, Scope& scope) {
      statements.emplace_back(&statement, &scope);
    });
    // Changes of what is inherited come first: the block's own statements speak of the new names.
    for (const char* wanted : {"rename", "remove", "replace", ""})
      for (const auto& [statement, scope] : statements) {
        const std::string& keyword = statement->keyword.text;
        const bool change = keyword == "rename" || keyword == "remove" || keyword == "replace";
        if (change ? keyword != wanted : *wanted != '\0') continue;
        try {
          take(*statement, *scope);
        } catch (const Stop&) {
          failed_ = true;
        }
      }
    if (failed_) throw Stop{};
  }

  void take(const Statement& statement, Scope& scope) {
    const std::string& keyword = statement.keyword.text;
    const ConstructRecord* record = find_construct(keyword);
    if (record != nullptr && !record->supported)
      fail(program_, Message("G0315", "`" + keyword + "` is not supported yet", statement.keyword.span)
                         .help(kStillToCome));
    if (keyword == "rename" || keyword == "remove" || keyword == "replace") {
      if (!inherited_)
        fail(program_, Message("G0322", "`" + keyword + "` stands in the block of `like PANEL` only",
                               statement.keyword.span)
                           .help("this panel is drawn here: correct its own statements, or make it `like` another one"));
      if (keyword == "rename") return rename(statement, scope);
      if (keyword == "remove") return remove(statement, scope);
      return replace(statement, scope);
    }
    if (keyword == "outline") return take_outline(statement, scope);
    if (keyword == "notch") return add(recipe_.notches, statement, scope);
    if (keyword == "dart") return add(recipe_.darts, statement, scope);
    if (keyword == "pleat" || keyword == "tuck") return add(recipe_.pleats, statement, scope);
    if (keyword == "line" || keyword == "point" || keyword == "slit")
      return add(recipe_.interior, statement, scope);
    if (keyword == "hole") return take_hole(statement, scope);
    if (keyword == "allowance")
      return recipe_.allowances.push_back({&statement, &scope, "", {}, {}, ""}), void();
    if (keyword == "place") return take_place(statement, scope);
    if (is_value(keyword)) return take_value(statement, scope);
    if (keyword == "=") return take_assignment(statement, scope);
    fail(program_, Message("G0322", "`" + keyword + "` cannot stand in a panel", statement.keyword.span));
  }

  void take_place(const Statement& statement, Scope& scope) {
    Scope* where = &scope;
    if (declaration_.pair_left != nullptr) {  // its own side of the body
      where = &program_.new_scope(&scope);
      where->half = declaration_.scope->half;
      where->half_used = true;
    }
    program_.panel_places.push_back({&statement, where, &declaration_});
  }

  void take_outline(const Statement& statement, Scope& scope) {
    if (recipe_.outline.statement != nullptr && !(inherited_ && !own_outline_))
      fail(program_, Message("G0314", "a panel has one outline", statement.keyword.span)
                         .also(recipe_.outline.statement->keyword.span, "first here"));
    own_outline_ = true;
    recipe_.outline = {&statement, &scope, "", {}, {}, ""};
    recipe_.edges.clear();
    take_loop(statement, scope, recipe_.edges, "");
  }

  void take_loop(const Statement& statement, Scope& scope, std::vector<RecipeItem>& edges,
                 const std::string& owner) {
    if (!statement.body) return;
    expand_block(program_, *statement.body, scope, [&](const Statement& edge, Scope& inner) {
      if (edge.keyword.text != "edge" && edge.keyword.text != "close")
        fail(program_, Message("G0322",
                               "`" + edge.keyword.text + "` cannot stand in " +
                                   (owner.empty() ? "an outline" : "a hole"),
                               edge.keyword.span)
                           .help("it has `edge NAME to POINT` and, last, `close NAME`"));
      add(edges, edge, inner);
      edges.back().owner = owner;
    });
  }

  void take_hole(const Statement& statement, Scope& scope) {
    add(recipe_.interior, statement, scope);
    take_loop(statement, scope, recipe_.hole_edges, recipe_.interior.back().name);
  }

  void add(std::vector<RecipeItem>& items, const Statement& statement, Scope& scope) {
    if (!statement.name)
      fail(program_,
           Message("G0312", "`" + statement.keyword.text + "` needs a name", statement.keyword.span));
    const std::string name = fill_name(program_, *statement.name, scope);
    for (const char* reserved : {"left", "right", "start", "end", "resolution"})
      if (name == reserved)
        fail(program_, Message("G0303", "`" + name + "` has a meaning of its own and cannot be a name here",
                               statement.name->span)
                           .help("take a longer name"));
    if (const RecipeItem* other = find_item(recipe_, name)) {
      Message message("G0302", "the name `" + name + "` is taken in this panel", statement.name->span);
      if (other->statement->name) message.also(other->statement->name->span, "first here");
      fail(program_, message);
    }
    items.push_back({&statement, &scope, name, {}, {}, ""});
  }

  void take_value(const Statement& statement, Scope& scope) {
    if (statement.operands.size() != 1)
      fail(program_, Message("G0312", "`" + statement.keyword.text + "` takes one value", statement.span));
    if (const auto old = recipe_.values.find(statement.keyword.text);
        old != recipe_.values.end() && !inherited_)
      fail(program_,
           Message("G0314", "`" + statement.keyword.text + "` is given twice", statement.keyword.span)
               .also(old->second.span, "first here"));
    recipe_.values[statement.keyword.text] = {&statement.operands[0], &scope, statement.span};
  }

  void take_assignment(const Statement& statement, Scope& scope) {
    if (statement.operands.size() != 2) throw Stop{};
    Override change;
    const Expr& target = statement.operands[0];
    for (const Expr* at = &target; at != nullptr;
         at = at->kind == ExprKind::member ? &at->children[0] : nullptr) {
      if (at->kind != ExprKind::member && at->kind != ExprKind::name)
        fail(program_, Message("G0311", "`" + std::string(program_.sources.text(target.span)) + "` cannot be assigned to",
                                target.span)
                           .help("what is assigned is a property: `waist_dart.depth = 11 cm`, `resolution = 5 mm`"));
      change.path.insert(change.path.begin(), name_of(program_, *at, scope));
    }
    change.value = &statement.operands[1];
    change.scope = &scope;
    change.span = target.span;
    for (const Override& other : own_)
      if (other.path == change.path)
        fail(program_,
             Message("G0321", "`" + std::string(program_.sources.text(target.span)) + "` is assigned twice", target.span).also(other.span, "first here"));
    own_.push_back(change);
    assign(change);
    if (!change.used)
      fail(program_,
           Message("G0311", "there is no `" + std::string(program_.sources.text(target.span)) + "` here",
                   target.span)
               .help(meant_or_listed(change.path[0], item_names(recipe_), "the panel has")));
  }

  void assign(Override& change) {
    if (change.path.size() == 1 && is_value(change.path[0])) {
      change.used = true;
      recipe_.values[change.path[0]] = {change.value, change.scope, change.span};
    }
    if (change.path.size() != 2) return;
    RecipeItem* item = find_item(recipe_, change.path[0]);
    if (item == nullptr) return;
    const ConstructRecord* record = find_construct(item->statement->keyword.text);
    if (record == nullptr || find_clause(*record, change.path[1]) == nullptr) return;
    change.used = true;
    Override inner = change;
    inner.path = {change.path[1]};
    std::erase_if(item->overrides, [&](const Override& other) { return other.path == inner.path; });
    item->overrides.push_back(inner);
  }

  void rename(const Statement& statement, Scope& scope) {
    Clauses clauses(program_, statement, scope);
    const Expr& as = clauses.value(clauses.need("as"));
    if (statement.operands.size() != 1 || statement.operands[0].kind != ExprKind::name ||
        as.kind != ExprKind::name)
      fail(program_, Message("G0313", "write `rename OLD as NEW`", statement.span));
    const std::string from = name_of(program_, statement.operands[0], scope),
                      to = name_of(program_, as, scope);
    RecipeItem& item = inherited_item(from, statement.operands[0].span);
    if (find_item(recipe_, to) != nullptr)
      fail(program_, Message("G0302", "the name `" + to + "` is taken in this panel", as.span));
    item.name = to;
    auto follow = [&](RecipeItem& other) {
      bool known = false;
      for (auto& [text, name] : other.renamed)
        if (name == from) name = to, known = true;
      if (!known) other.renamed[from] = to;
      if (other.owner == from) other.owner = to;
    };
    for_each_item(recipe_, follow);
    for (RecipeItem& allowance : recipe_.allowances) follow(allowance);
    if (recipe_.fold == from) recipe_.fold = to;
    clauses.finish();
  }

  void remove(const Statement& statement, Scope& scope) {
    for (const Expr& operand : statement.operands) {
      const std::string name = operand.kind == ExprKind::name ? name_of(program_, operand, scope) : "";
      inherited_item(name, operand.span);
      for (std::vector<RecipeItem>* items : recipe_.lists())
        std::erase_if(*items, [&](const RecipeItem& item) { return item.name == name || item.owner == name; });
    }
  }

  void replace(const Statement& statement, Scope& scope) {
    const std::vector<Expr>& operands = statement.operands;
    if (operands.size() != 2 || operands[0].kind != ExprKind::name || operands[0].text != "edge" ||
        operands[1].kind != ExprKind::name)
      fail(program_, Message("G0313", "write `replace edge NAME to POINT ...`", statement.span));
    const std::string name = name_of(program_, operands[1], scope);
    inherited_item(name, operands[1].span);
    for (std::vector<RecipeItem>* edges : {&recipe_.edges, &recipe_.hole_edges})
      for (RecipeItem& item : *edges) {
        if (item.name != name) continue;
        item.statement = &statement;
        item.scope = &scope;
        item.overrides.clear();
        item.renamed.clear();
        return;
      }
    fail(program_, Message("G0311", "`" + name + "` is no edge", operands[1].span));
  }

  RecipeItem& inherited_item(const std::string& name, Span span) {
    if (RecipeItem* item = find_item(recipe_, name)) return *item;
    fail(program_, Message("G0416", "the panel has nothing named `" + name + "`", span)
                       .help(meant_or_listed(name, item_names(recipe_), "the panel has")));
  }

  Program& program_;
  Declaration& declaration_;
  Scope& scope_;  ///< of the statements
  Recipe recipe_;
  std::vector<Override> own_;
  bool inherited_ = false, own_outline_ = false, failed_ = false;
};

}  // namespace

Recipe make_recipe(Program& program, Declaration& declaration) {
  return RecipeMaker(program, declaration).make();
}

}  // namespace garment::interpreter
