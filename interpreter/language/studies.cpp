#include "interpreter/language/studies.hpp"

#include "interpreter/language/acts.hpp"
#include "interpreter/language/clauses.hpp"
#include "interpreter/language/declarations.hpp"
#include "interpreter/language/files.hpp"
#include "interpreter/language/parts.hpp"

namespace garment::interpreter {
namespace {

constexpr std::size_t kMostValues = 100;

const Expr& one_operand(Program& program, const Statement& statement, const char* example) {
  if (statement.operands.size() == 1) return statement.operands[0];
  const bool none = statement.operands.empty();
  fail(program, Message(none ? "G0312" : "G0313", "`" + statement.keyword.text + "` takes one name",
                        none ? statement.keyword.span : statement.operands[1].span)
                    .help("as in `" + std::string(example) + "`"));
}

/// What `vary` may change: a param, an argument of a part, or a property of something declared.
void check_target(Program& program, const Expr& target, Scope& scope) {
  const DeclaredPath path = find_path(program, target, scope);
  if (path.declaration == nullptr) {
    const Expr* first = &target;
    while (first->kind == ExprKind::member && !first->children.empty()) first = &first->children[0];
    if (first->kind == ExprKind::name)
      fail_unknown_name(program, name_of(program, *first, scope), first->span, scope);
    fail(program, Message("G0311", "this cannot be varied", target.span).help("name a param or a property"));
  }
  const std::string& keyword = path.declaration->statement->keyword.text;
  if (path.rest.empty() && keyword != "param" && !is_argument(*path.declaration))
    fail(program, Message("G0311",
                          "`" + path.declaration->name + "` is a " + keyword +
                              "; only a param can be varied as a whole",
                          target.span)
                      .also(path.declaration->statement->span, "declared here")
                      .help("name one of its properties, or make it a param"));
}

/// The acts of a block, run for the first time, so that what is wrong with them is said before anything is
/// draped.
std::vector<Act> acts_of(Program& program, const Statement& statement, Scope& scope) {
  std::vector<Act> others = std::move(program.acts);
  program.acts.clear();
  bool draped = false;
  const auto put_back = [&] {
    std::swap(program.acts, others);
    return std::move(others);
  };
  try {
    expand_block(program, *statement.body, scope, [&](const Statement& inner, Scope& at) {
      const ConstructRecord* record = find_construct(inner.keyword.text);
      if (record == nullptr || record->run == nullptr || record->declares_name ||
          inner.keyword.text == "vary")
        fail(program,
             Message("G0322", "`" + inner.keyword.text + "` cannot stand in `vary`", inner.keyword.span));
      draped = draped || inner.keyword.text == "drape";
      record->run(program, Item{&inner, &at, nullptr});
    });
  } catch (const Stop&) {
    put_back();
    throw;
  }
  if (!draped)
    report(program, Message("G1322", "nothing is draped in this `vary`", statement.keyword.span)
                        .help("each round starts anew: begin its block with `drape until rest`"));
  return put_back();
}

/// The values that an operand of `over` stands for, each as text: itself, or the numbers of a list.
std::vector<std::string> texts_of(Program& program, const Value& value, const Expr& expr) {
  if (value.as<RangeValue>() != nullptr)
    fail(program, Message("G0306", "a range where `over` takes values", expr.span)
                      .help("say how far apart they are: `steps(" + std::string(program.sources.text(expr.span)) + ", STEP)`"));
  const auto* list = value.as<ListValue>();
  if (list == nullptr) return {std::string(program.sources.text(expr.span))};
  std::vector<std::string> texts;
  for (const Value& item : **list) {
    const auto* q = item.as<Quantity>();
    if (q == nullptr)
      fail(program, Message("G0306", kind_of(item) + " in a list of values; a list in `over` holds numbers", expr.span)
                        .help("write the values one by one: `over A, B`"));
    texts.push_back(format_quantity(q->value, q->dimension, q->percent, 12));
    if (texts.size() > kMostValues) break;  // told as too many
  }
  return texts;
}

}  // namespace

void run_release(Program& program, const Item& item) {
  const Statement& statement = *item.statement;
  const Expr& expr = one_operand(program, statement, "release corner");
  const Value value = eval(program, expr, *item.scope);
  ReleaseAct act;
  if (const auto* pin = value.as<PinValue>()) {
    act.pin = pin->pin;
  } else if (const auto* thing = value.as<ThingValue>(); thing != nullptr && thing->keyword == "clamp") {
    act.clamp = thing->index;
  } else {
    fail(program, Message("G0306", kind_of(value) + " where `release` takes a pin or a clamp", expr.span));
  }
  for (const Act& other : program.acts) {
    const auto* released = std::get_if<ReleaseAct>(&other.act);
    if (released == nullptr || released->pin != act.pin || released->clamp != act.clamp) continue;
    fail(program,
         Message("G1320", "`" + std::string(program.sources.text(expr.span)) + "` is released already",
                 expr.span)
             .also(other.span, "here"));
  }
  program.acts.push_back({act, statement.span});
}

void run_record(Program& program, const Item& item) {
  const Statement& statement = *item.statement;
  Clauses clauses(program, statement, *item.scope);
  auto says = [&](const char* word) {
    return !statement.operands.empty() && statement.operands[0].kind == ExprKind::name && statement.operands[0].text == word;
  };
  RecordAct act;
  act.frames = says("frames") && statement.operands.size() == 1;
  if (!act.frames && (!says("curve") || statement.operands.size() != 3))
    fail(program,
         Message("G0312", "`record` takes `curve` and two values, or `frames`", statement.keyword.span)
             .help("as in `record curve position(jaw).y, reaction(jaw).y every 10 ms as \"pull.csv\"`"));
  act.statement = &statement;
  act.scope = item.scope;
  clauses.need("every");
  act.every = *clauses.quantity("every");
  const BoundClause& as = clauses.need("as");
  if (as.clause->values.empty()) clauses.value(as);  // says that it is missing
  for (const Expr& name : as.clause->values) {
    const std::string path = eval_text(program, name, *as.scope, "`as`");
    writable_path(program, path, name.span);
    if (!act.frames && path.ends_with(".svg") && path.size() > 4)
      act.plots.push_back(path);
    else if (act.path.empty())
      act.path = path;
    else
      fail(program, Message("G1321", "`" + path + "` beside `" + act.path + "`", name.span)
                        .help("a record has one file, and a curve may have pictures of it as well, whose names end in `.svg`"));
  }
  clauses.finish();
  auto ends = [&](std::string_view ending) { return act.path.size() > ending.size() && act.path.ends_with(ending); };
  if (act.frames && !(ends(".obj") || ends(".ply") || ends(".glb") || ends(".csv") || ends(".png")))
    fail(program,
         Message("G1321", "frames are written as shapes, `" + act.path + "` is none", as.clause->values[0].span)
             .help("give it a name that ends in `.obj`, `.ply`, `.glb`, `.csv` or `.png`"));
  if (act.frames) {
    program.acts.push_back({act, statement.span});
    return;
  }
  if (!ends(".csv"))
    fail(program, Message("G1321", act.path.empty() ? "a curve is written as a table, and as a picture beside it"
                                                    : "a curve is written as a table, `" + act.path + "` is none",
                          as.clause->values[0].span)
                      .help("give it a name that ends in `.csv`; a picture is added as in `as \"pull.csv\", \"pull.svg\"`"));
  check_questions(program, {&statement.operands[1], &statement.operands[2]}, *item.scope);
  act.x = std::string(program.sources.text(statement.operands[1].span));
  act.y = std::string(program.sources.text(statement.operands[2].span));
  program.acts.push_back({act, statement.span});
}

void run_vary(Program& program, const Item& item) {
  const Statement& statement = *item.statement;
  Scope& scope = *item.scope;
  const Expr& target = one_operand(program, statement, "vary long over 50 cm, 60 cm { drape until rest }");
  check_target(program, target, scope);
  Clauses clauses(program, statement, scope);
  const BoundClause& over = clauses.need("over");
  clauses.finish();
  VaryAct act;
  act.ordinal = program.studies++;
  act.target = std::string(program.sources.text(target.span));
  if (over.clause->values.empty())
    fail(program, Message("G0312", "`over` needs values", over.clause->span).help("as in `over 0.2, 1, 5`"));
  std::vector<Span> stated;
  for (const Expr& expr : over.clause->values) {
    const Value value = eval(program, expr, scope);
    for (std::string& text : texts_of(program, value, expr)) {
      for (std::size_t k = 0; k < act.values.size(); ++k)
        if (act.values[k] == text)
          fail(program, Message("G1323", "`" + text + "` stands twice in `over`", expr.span).also(stated[k], "first here"));
      act.values.push_back(std::move(text));
      stated.push_back(expr.span);
    }
  }
  if (act.values.size() > kMostValues)
    fail(program, Message("G1324", std::to_string(act.values.size()) + " values; a study has 100 at most",
                          over.clause->span));
  if (!statement.body)
    fail(program, Message("G0312", "`vary` needs a block of acts", statement.keyword.span)
                      .help("as in `vary long over 50 cm, 60 cm { drape until rest; save \"skirt.png\" }`"));
  std::vector<Act> acts = acts_of(program, statement, scope);
  const auto& study = program.options.study;
  if (study && study->ordinal == act.ordinal) program.study_acts = std::move(acts);
  program.acts.push_back({act, statement.span});
}

void apply_study(Program& program) {
  const auto& study = program.options.study;
  if (!study) return;
  Statement& made = program.made_statements.emplace_back();
  made.keyword = {"=", {}, {}};
  for (const std::string* text : {&study->target, &study->value}) {
    const grammar::SourceId source = program.sources.add("vary " + study->target, *text);
    grammar::ExpressionResult parsed = grammar::parse_expression(program.sources, source, vocabulary());
    if (!parsed.diagnostics.empty()) throw Stop{};  // the script that holds it was refused
    made.operands.push_back(std::move(parsed.expr));
  }
  made.span = made.operands[0].span;
  const DeclaredPath path = find_path(program, made.operands[0], *program.main->scope);
  if (path.declaration == nullptr) throw Stop{};
  const Override change{path.rest, &made.operands[1], program.main->scope, made.operands[1].span, false, -1};
  for (Override& other : path.declaration->overrides)
    if (other.path == path.rest) {
      other = change;
      return;
    }
  path.declaration->overrides.push_back(change);
}

}  // namespace garment::interpreter
