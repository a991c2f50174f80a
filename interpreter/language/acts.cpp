#include "interpreter/language/acts.hpp"

#include <algorithm>
#include <cmath>

#include "interpreter/language/clauses.hpp"
#include "interpreter/language/files.hpp"
#include "interpreter/language/word_lists.hpp"

namespace garment::interpreter {
namespace {

constexpr double kSameNumber = 1e-9;  // relative; what `==` forgives without `within`

/// Answers every question with 1, so that a script's expectations are checked for sense before anything is
/// simulated.
class AnyDrape : public DrapeMeasures {
 public:
  bool stand_in() const override { return true; }
  std::optional<double> strain(const std::string&) const override { return 1; }
  std::optional<double> shear(const std::string&) const override { return 1; }
  std::optional<double> stress(const std::string&) const override { return 1; }
  std::optional<double> length(const std::vector<design::EdgePart>&) const override { return 1; }
  std::optional<double> area(const std::string&) const override { return 1; }
  std::optional<double> mass(const std::string&) const override { return 1; }
  std::optional<double> clearance(const std::string&) const override { return 1; }
  std::optional<double> energy() const override { return 1; }
  std::optional<double> penetrations() const override { return 1; }
  std::optional<double> drape_coefficient(int) const override { return 1; }
  std::optional<double> nodes(int) const override { return 1; }
  std::optional<Eigen::Vector3d> position(int) const override { return Eigen::Vector3d(1, 1, 1); }
  std::optional<Eigen::Vector3d> reaction(const std::string&) const override { return Eigen::Vector3d(1, 1, 1); }
  std::optional<Eigen::Vector3d> moment(const std::string&) const override { return Eigen::Vector3d(1, 1, 1); }
  std::optional<double> elapsed() const override { return 1; }
  std::optional<Eigen::Vector3d> position(int, const design::Point2&) const override {
    return Eigen::Vector3d(1, 1, 1);
  }
};

struct DrapeGuard {
  Program& program;
  DrapeGuard(Program& p, const DrapeMeasures& drape) : program(p) { p.drape = &drape; }
  DrapeGuard(const DrapeGuard&) = delete;
  DrapeGuard& operator=(const DrapeGuard&) = delete;
  ~DrapeGuard() { program.drape = nullptr; }
};

/// Mistakes that may come of the stand-in answers alone: no finite number, outside a table, outside a list or its like.
bool hangs_on_values(const grammar::Diagnostic& diagnostic) {
  return diagnostic.code == "G0319" || diagnostic.code == "G0352" || diagnostic.code == "G0309" ||
         diagnostic.code == "G0342";
}

/// Evaluates what asks the drape with stand-in answers. What is wrong whatever the answers are is reported; what hangs on
/// them is judged when the drape is there.
template <class Question>
void try_question(Program& program, const Question& question) {
  const AnyDrape any;
  const DrapeGuard guard(program, any);
  const std::size_t before = program.diagnostics.size();
  const bool had_error = program.has_error;
  try {
    question();
  } catch (const Stop&) {
    const auto first = program.diagnostics.begin() + static_cast<std::ptrdiff_t>(before);
    if (first == program.diagnostics.end() || !std::all_of(first, program.diagnostics.end(), hangs_on_values)) throw;
    program.diagnostics.erase(first, program.diagnostics.end());
    program.has_error = had_error;
  }
}

bool is_comparison(const Expr& expr) {
  static const char* const words[] = {"==", "!=", "<", "<=", ">", ">=", "is"};
  for (const char* word : words)
    if (expr.kind == ExprKind::binary && expr.text == word) return true;
  return false;
}

/// How far apart two values are; for numbers and points.
double difference(Program& program, const Expr& expr, const Value& a, const Value& b) {
  Expr minus = expr;
  minus.text = "-";
  const Value d = apply_binary(program, minus, a, b);
  if (const auto* q = d.as<Quantity>()) return std::fabs(q->value);
  const auto* p = d.as<PointValue>();
  return p == nullptr ? 0 : std::sqrt(p->at[0] * p->at[0] + p->at[1] * p->at[1] + p->at[2] * p->at[2]);
}

double size_of(const Value& value) {
  if (const auto* q = value.as<Quantity>()) return std::fabs(q->value);
  const auto* p = value.as<PointValue>();
  return p == nullptr ? 0 : std::sqrt(p->at[0] * p->at[0] + p->at[1] * p->at[1] + p->at[2] * p->at[2]);
}

/// The share or distance that `within` allows between `a` and `b`.
double tolerance(Program& program, const Expr& expr, const BoundClause* within, const Value& b,
                 std::string& text) {
  if (within == nullptr) return kSameNumber * size_of(b);
  if (expr.text != "==" && expr.text != "is")
    fail(program, Message("G0313", "`within` goes with `==`", within->clause->span));
  if (within->clause->values.size() != 1)
    fail(program, Message("G0312", "`within` takes one value", within->clause->span)
                      .help("as in `within 2%` or `within 1 mm`"));
  const Value value = eval(program, within->clause->values[0], *within->scope);
  const auto* w = value.as<Quantity>();
  const auto* q = b.as<Quantity>();
  const auto* p = b.as<PointValue>();
  if (w == nullptr || (q == nullptr && p == nullptr))
    fail(program, Message("G0306", "`within` compares numbers and points", within->clause->span));
  text = " within " + show(value);
  const Dimension dimension = q != nullptr ? q->dimension : p->dimension;
  if (w->percent) return w->value * size_of(b);
  if (w->dimension != dimension && !is_plain_zero(*w))
    fail(program, Message("G0305",
                          "`within` takes " + describe(w->dimension) + " where " + describe(dimension) +
                              " is compared",
                          within->clause->span)
                      .help("take a percentage or " + describe(dimension)));
  return w->value;
}

}  // namespace

Verdict judge(Program& program, const Statement& statement, Scope& scope) {
  Clauses clauses(program, statement, scope);
  if (statement.operands.empty())
    fail(program,
         Message("G0312", "`" + statement.keyword.text + "` needs a condition", statement.keyword.span));
  const Expr& expr = statement.operands[0];
  const BoundClause* within = clauses.find("within");
  clauses.finish();
  Verdict verdict;
  if (!is_comparison(expr)) {
    if (within != nullptr) fail(program, Message("G0313", "`within` goes with `==`", within->clause->span));
    verdict.passed = eval_truth(program, expr, scope, "`" + statement.keyword.text + "`");
    verdict.found = verdict.passed ? "true" : "false";
    verdict.expected = "true";
    return verdict;
  }
  const Value a = eval(program, expr.children[0], scope), b = eval(program, expr.children[1], scope);
  std::string about;
  const bool numbers = (a.as<Quantity>() != nullptr && b.as<Quantity>() != nullptr) ||
                       (a.as<PointValue>() != nullptr && b.as<PointValue>() != nullptr);
  if (numbers && (expr.text == "==" || expr.text == "is")) {
    const double allowed = tolerance(program, expr, within, b, about);
    verdict.passed = difference(program, expr, a, b) <= allowed;
  } else {
    if (within != nullptr)
      fail(program, Message("G0313", "`within` goes with `==` between numbers", within->clause->span));
    verdict.passed = *apply_binary(program, expr, a, b).as<bool>();
  }
  verdict.found = show(a);
  verdict.expected = expr.text + ' ' + show(b) + about;
  if (const auto* q = a.as<Quantity>()) verdict.value = q->value;
  return verdict;
}

void check_questions(Program& program, const std::vector<const Expr*>& questions, Scope& scope) {
  for (const Expr* question : questions)
    try_question(program, [&] {
      const Value value = eval(program, *question, scope);
      if (value.as<Quantity>() == nullptr)
        fail(program, Message("G0306", kind_of(value) + " where a curve takes a number", question->span)
                          .help("as in `position(corner).y` or `reaction(jaw).y`"));
    });
}

void run_garment(Program& program, const Item& item) {
  const Statement& statement = *item.statement;
  Scope& scope = *item.scope;
  Module& module = *scope.module;
  if (module.titled) fail(program, Message("G0314", "`garment` is given twice", statement.keyword.span));
  module.titled = true;
  if (statement.operands.empty() || statement.operands.size() > 2)
    fail(program, Message("G0312", "`garment` takes the edition and a title", statement.keyword.span)
                      .help("as in `garment 1 \"skirt\"`"));
  const Expr& edition = statement.operands[0];
  if (edition.kind == ExprKind::string)
    fail(program, Message("G0312", "`garment` takes the edition of the language before the title", edition.span)
                      .help("write `garment 1 " + std::string(program.sources.text(edition.span)) + "`"));
  const Quantity q = eval_quantity(program, edition, scope, kNumber, "the edition");
  if (q.value != 1)
    report(program, Message("G0323",
                            "edition " + format_quantity(q.value, {}) +
                                " of the language; this program knows edition 1",
                            edition.span)
                        .help("write `garment 1`, or use a newer program"));
  if (statement.operands.size() < 2) return;
  const std::string title = eval_text(program, statement.operands[1], scope, "the title");
  if (!module.library) program.garment.title = title;
}

void run_drape(Program& program, const Item& item) {
  const Statement& statement = *item.statement;
  Scope& scope = *item.scope;
  Clauses clauses(program, statement, scope);
  DrapeAct act;
  const BoundClause* until = clauses.find("until");
  const auto duration = clauses.quantity("for");
  if ((until != nullptr) == duration.has_value())
    fail(program, Message("G0312", "`drape` goes `until rest` or `for TIME`", statement.span));
  if (until != nullptr) {
    const Expr& word = clauses.value(*until);
    if (word.kind != ExprKind::name || word.text != "rest")
      fail(program, Message("G0313", "`until` takes `rest`", word.span));
  } else {
    act.until_rest = false;
    act.duration = *duration;
  }
  if (const BoundClause* settle = clauses.find("settle")) {
    const Expr& word = clauses.value(*settle);
    const std::vector<std::string> words = {"preview", "equilibrium", "exact"};
    const std::string name = word.kind == ExprKind::name ? word.text : "";
    if (name == "preview")
      act.settle = simulator::Settle::preview;
    else if (name == "exact")
      act.settle = simulator::Settle::exact;
    else if (name != "equilibrium")
      fail(program, Message("G0313", "`settle` takes preview, equilibrium or exact", word.span)
                        .help(meant_or_listed(name, words, "it is one of")));
    if (!act.until_rest)
      fail(program, Message("G0313", "`settle` goes with `until rest`", settle->clause->span));
  }
  clauses.finish();
  if (!statement.operands.empty())
    fail(program, Message("G0313", "`drape` takes no value here", statement.operands[0].span));
  program.acts.push_back({act, statement.span});
}

void run_expect(Program& program, const Item& item) {
  const Statement& statement = *item.statement;
  Scope& scope = *item.scope;
  if (statement.operands.size() > 1)
    fail(program, Message("G0313", "`expect` takes one condition", statement.operands[1].span));
  try_question(program, [&] { judge(program, statement, scope); });
  Span span = statement.operands[0].span;
  if (!statement.clauses.empty()) span = grammar::cover(span, statement.clauses.back().span);
  program.acts.push_back(
      {ExpectAct{&statement, &scope, std::string(program.sources.text(span))}, statement.span});
}

void run_save(Program& program, const Item& item) {
  const Statement& statement = *item.statement;
  Scope& scope = *item.scope;
  SaveAct act;
  for (const Expr& operand : statement.operands) {
    if (operand.kind == ExprKind::member || operand.kind == ExprKind::name)
      if (const std::string text(program.sources.text(operand.span)); text.find('.') != std::string::npos)
        fail(program, Message("G0306", "`" + text + "` where `save` takes a file name in quotes", operand.span)
                          .help("write `save \"" + text + "\"`"));
    const std::string path = eval_text(program, operand, scope, "`save`");
    act.paths.push_back(writable_path(program, path, operand.span));
    const std::size_t slash = path.rfind('/'), dot = path.rfind('.');
    if (dot == std::string::npos || dot + 1 == path.size() || (slash != std::string::npos && dot < slash))
      fail(program,
           Message("G0309", "`" + path + "` has no extension; the kind of file is known by it", operand.span)
               .help("as in `save \"skirt.glb\"`"));
    const std::string_view kind = std::string_view(path).substr(dot);
    for (const char* later : {".vtk", ".html"})
      if (kind == later)
        fail(program, Message("G0905", "`" + std::string(kind) + "` cannot be written yet", operand.span)
                          .help("use .obj, .glb, .ply, .svg, .pdf, .dxf, .json, .png or .csv"));
    constexpr std::string_view kWritten[] = {".csv", ".obj", ".glb", ".ply", ".svg", ".pdf", ".png", ".dxf", ".json"};
    if (std::find(std::begin(kWritten), std::end(kWritten), kind) == std::end(kWritten))
      fail(program,
           Message("G0905", "`" + std::string(kind) + "` is no format that can be written", operand.span)
               .help("use .obj, .glb, .ply, .svg, .pdf, .dxf, .json, .png or .csv"));
  }
  if (act.paths.empty())
    fail(program, Message("G0312", "`save` needs a file name in quotes", statement.keyword.span));
  program.acts.push_back({act, statement.span});
}

void run_assert(Program& program, const Item& item) {
  const Statement& statement = *item.statement;
  Scope& scope = *item.scope;
  std::string what;
  if (statement.operands.size() > 2)
    fail(program, Message("G0313", "`assert` takes one condition and one text", statement.operands[2].span));
  if (statement.operands.size() == 2)
    what = eval_text(program, statement.operands[1], scope, "what must hold");
  if (!statement.operands.empty() && asks_drape(statement.operands[0], scope)) {
    try_question(program, [&] { judge(program, statement, scope); });
    program.acts.push_back(
        {ExpectAct{&statement, &scope, std::string(program.sources.text(statement.operands[0].span))},
         statement.span});
    return;
  }
  const Verdict verdict = judge(program, statement, scope);
  if (verdict.passed) return;
  report(program,
         Message("G0320", what.empty() ? "the assertion does not hold" : what, statement.operands[0].span,
                 "found " + verdict.found + ", expected " + verdict.expected));
}

MeasureValue measure_value(const std::string& name, const Value& value) {
  MeasureValue measure{name, show(value), std::nullopt, ""};
  const auto* q = value.as<Quantity>();
  if (q == nullptr) return measure;
  measure.text = format_quantity(q->value, q->dimension, q->percent, 7);
  measure.value = q->value;
  static const std::pair<Dimension, const char*> units[] = {
      {kLength, "m"},          {kArea, "m^2"},
      {kAngle, "rad"},         {kTime, "s"},
      {kMass, "kg"},           {kForce, "N"},
      {kMoment, "J"},          {kArealDensity, "kg/m^2"},
      {kPressure, "Pa"},       {kForcePerLength, "N/m"},
      {kAcceleration, "m/s^2"}};
  for (const auto& [dimension, unit] : units)
    if (dimension == q->dimension) measure.unit = unit;
  return measure;
}

void run_measure(Program& program, const Item& item) {
  Declaration& declaration = *item.declaration;
  const Statement& statement = *declaration.statement;
  const bool later = !statement.clauses.empty() && !statement.clauses[0].values.empty() &&
                     asks_drape(statement.clauses[0].values[0], *declaration.scope);
  if (!later) {
    program.measures.push_back(measure_value(declaration.name, force(program, declaration, statement.span)));
    return;
  }
  try_question(program, [&] { force(program, declaration, statement.span); });
  program.acts.push_back({MeasureAct{declaration.name, &statement, declaration.scope,
                                     std::string(program.sources.text(statement.clauses[0].values[0].span))},
                          statement.span});
}

}  // namespace garment::interpreter
