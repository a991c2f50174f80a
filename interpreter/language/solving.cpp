#include "interpreter/language/solving.hpp"

#include <algorithm>
#include <cmath>

#include "interpreter/language/acts.hpp"
#include "interpreter/language/clauses.hpp"
#include "interpreter/language/dependencies.hpp"
#include "interpreter/language/evaluate.hpp"
#include "interpreter/language/root_finding.hpp"

namespace garment::interpreter {
namespace {

constexpr std::size_t kTrialSteps = 5000;  // drawing panels again takes longer than the steps of their values
constexpr int kScan = 16;             // parts of the range that are looked at where its ends agree in sign
constexpr double kHolds = 1e-9;       // relative difference that counts as equal at an end of the range
constexpr double kNoJump = 1e-6;      // relative difference that is left where the sides agree

/// The condition for one value.
struct Sides {
  Quantity left, right;
  double difference() const { return left.value - right.value; }
  double scale() const { return std::max(std::fabs(left.value), std::fabs(right.value)); }
  bool agree(double tolerance) const { return std::fabs(difference()) <= tolerance * scale(); }
};

class Solver {
 public:
  Solver(Program& program, Declaration& declaration)
      : program_(program), declaration_(declaration), clauses_(program, *declaration.statement, *declaration.scope) {}

  Value solve() {
    read();
    {
      Trial trial(program_, declaration_);
      trial_ = &trial;
      search();
      trial_ = nullptr;
    }
    record();
    return Value{quantity(found_)};
  }

 private:
  void read() {
    const BoundClause& in = clauses_.need("in");
    const Expr& range = clauses_.value(in);
    const Value value = eval(program_, range, *in.scope);
    const auto* limits = value.as<RangeValue>();
    if (limits == nullptr || !(limits->from.value < limits->to.value))
      fail(program_, Message("G1201",
                             (limits == nullptr ? kind_of(value) : "`" + show(value) + "`") +
                                 " where `in` takes a range from a smaller to a larger value",
                             range.span)
                         .help("as in `in 9 cm .. 18 cm`"));
    range_ = *limits;
    range_span_ = range.span;
    const BoundClause& so = clauses_.need("so");
    condition_ = &clauses_.value(so);
    scope_ = so.scope;
    clauses_.finish();
    static const char* const words[] = {"==", "is", "<=", ">="};
    if (condition_->kind != ExprKind::binary ||
        std::none_of(std::begin(words), std::end(words), [&](const char* word) { return condition_->text == word; }))
      fail(program_, Message("G1201", "`so` takes a comparison with ==, <= or >=", condition_->span)
                         .help("as in `so length(sleeve.cap) == 1.04 * armhole`"));
    if (asks_drape(*condition_, *scope_))
      fail(program_, Message("G0325", "the condition asks the drape, which comes later", condition_->span)
                         .help("solve for lengths of the pattern; after the drape use `expect`"));
  }

  Quantity quantity(double x) const { return {x, range_.from.dimension, range_.from.percent && range_.to.percent}; }
  std::string shown(double x) const {
    const Quantity q = quantity(x);
    return format_quantity(q.value, q.dimension, q.percent);
  }

  Quantity side(std::size_t k) {
    const Expr& expr = condition_->children[k];
    const Value value = eval(program_, expr, *scope_);
    if (const auto* q = value.as<Quantity>()) return *q;
    fail(program_, Message("G1201", kind_of(value) + " in the condition, which compares numbers", expr.span)
                       .help("as in `length(sleeve.cap) == 1.04 * armhole`"));
  }

  Sides evaluate_sides() {
    Sides sides{side(0), side(1)};
    if (sides.left.dimension != sides.right.dimension && !is_plain_zero(sides.left) && !is_plain_zero(sides.right))
      fail(program_, Message("G0305",
                             "the condition compares " + describe(sides.left.dimension) + " and " +
                                 describe(sides.right.dimension),
                             condition_->span)
                         .help("both sides must be of one kind"));
    if (is_plain_zero(sides.left)) sides.left.dimension = sides.right.dimension;
    return sides;
  }

  /// What goes wrong for one value is told once, at the `solve`.
  [[noreturn]] void fail_trial(double x, grammar::Diagnostics& kept, bool had_error) {
    grammar::Diagnostics raised = std::move(program_.diagnostics);
    program_.diagnostics = std::move(kept);
    program_.has_error = had_error;
    const auto error = std::find_if(raised.begin(), raised.end(),
                                    [](const Diagnostic& d) { return d.severity == Severity::error; });
    // What is wrong with the condition itself, whatever the value, is told as it stands.
    const bool own = error != raised.end() && !error->labels.empty() && trials_ <= 1 &&
                     error->labels[0].span.source == condition_->span.source &&
                     error->labels[0].span.begin >= condition_->span.begin &&
                     error->labels[0].span.end <= condition_->span.end;
    if (error == raised.end()) throw Stop{};
    if (own || error->code.starts_with("G12")) {
      Message message("", "", condition_->span);
      message.diagnostic = std::move(*error);
      fail(program_, std::move(message));
    }
    Message message("G1205", "`" + declaration_.name + "` = " + shown(x) + " cannot be tried: " + error->message,
                    range_span_);
    for (const auto& label : error->labels) message.also(label.span, label.text);
    fail(program_, message.help("narrow the range to values for which everything can be drawn" +
                                (error->help.empty() ? "" : "; there: " + error->help)));
  }

  Sides at(double x) {
    ++trials_;
    program_.steps += kTrialSteps;
    count_step(program_, condition_->span);
    grammar::Diagnostics kept = std::move(program_.diagnostics);
    program_.diagnostics.clear();
    const bool had_error = program_.has_error;
    trial_->set(Value{quantity(x)});
    Sides sides;
    bool failed = false;
    try {
      sides = evaluate_sides();
    } catch (const Stop&) {
      failed = true;
    }
    if (trials_ == 1 && !failed) note_dependence();
    const Declaration* stuck = trial_->forget_trial();
    if (failed) fail_trial(x, kept, had_error);
    program_.diagnostics = std::move(kept);
    program_.has_error = had_error;
    if (stuck != nullptr)
      fail(program_, Message("G1205", "`" + declaration_.name + "` cannot be tried: the condition depends on it by way of the " +
                                          stuck->statement->keyword.text + " `" + stuck->name + "`, which is made once only",
                             condition_->span)
                         .also(stuck->statement->span, "declared here")
                         .help("let the condition speak of panels, edges and values"));
    return sides;
  }

  void note_dependence() {
    const std::vector<Declaration*> dependents = dependents_of(program_, declaration_);
    depends_ = declaration_.needs.contains(&declaration_);
    for (Declaration* dependent : dependents) depends_ = depends_ || declaration_.needs.contains(dependent);
  }

  bool holds(const Sides& sides) const {
    if (condition_->text == ">=") return sides.difference() >= 0;
    if (condition_->text == "<=") return sides.difference() <= 0;
    return sides.agree(kHolds);
  }

  void take(double x, const Sides& sides, const char* bound = "") {
    found_ = x;
    sides_ = sides;
    bound_ = bound;
  }

  void search() {
    const double low = range_.from.value, high = range_.to.value;
    const Sides first = at(low);
    if (!depends_)
      fail(program_, Message("G1203", "the condition does not depend on `" + declaration_.name + "`", condition_->span,
                             "left " + show(Value{first.left}) + ", right " + show(Value{first.right}) + ", whatever it is")
                         .help("use `" + declaration_.name + "` in what the condition speaks of"));
    if (holds(first)) return take(low, first, "low");
    const Sides last = at(high);
    Bracket bracket{low, first.difference(), high, last.difference()};
    const bool apart = (first.difference() > 0) != (last.difference() > 0);
    if (condition_->text == "==" || condition_->text == "is") {
      if (holds(last)) return take(high, last, "high");
      if (!apart && !scan(bracket)) fail_range(first, last);
    } else if (!apart && !scan(bracket)) {
      fail_range(first, last);
    }
    refine(bracket);
  }

  /// The first part of the range over which the difference changes its sign.
  bool scan(Bracket& bracket) {
    const double low = range_.from.value, high = range_.to.value;
    double before = low, f_before = bracket.f_low;
    for (int k = 1; k < kScan; ++k) {
      const double x = low + (high - low) * k / kScan, f = at(x).difference();
      if ((f > 0) != (f_before > 0) || f == 0) {
        bracket = {before, f_before, x, f};
        return true;
      }
      before = x;
      f_before = f;
    }
    return false;
  }

  void refine(Bracket bracket) {
    bracket = narrow(bracket, [&](double x) { return at(x).difference(); });
    const bool equal = condition_->text == "==" || condition_->text == "is";
    double x = std::fabs(bracket.f_low) <= std::fabs(bracket.f_high) ? bracket.low : bracket.high;
    if (!equal) x = (condition_->text == ">=") == (bracket.f_low >= 0) || bracket.f_low == 0 ? bracket.low : bracket.high;
    const Sides sides = at(x);
    if (equal && !sides.agree(kNoJump)) {
      const Sides other = at(x == bracket.low ? bracket.high : bracket.low);
      fail(program_, Message("G1204",
                             "the condition jumps over its solution at `" + declaration_.name + "` = " + shown(x) +
                                 ": the left side goes from " + show(Value{sides.left}) + " to " + show(Value{other.left}) +
                                 ", the right one is " + show(Value{sides.right}),
                             condition_->span)
                         .help("take `round`, `floor` or `if` out of what the condition speaks of, or ask for `>=`"));
    }
    take(x, sides);
  }

  std::string told(const Sides& sides) const {
    const double d = sides.difference();
    return "the left side is " + format_quantity(std::fabs(d), sides.left.dimension, sides.left.percent) +
           (d > 0 ? " more" : " less") + " than the right one";
  }

  [[noreturn]] void fail_range(const Sides& first, const Sides& last) {
    const bool at_high = std::fabs(last.difference()) < std::fabs(first.difference());
    const Sides& near = at_high ? last : first;
    fail(program_, Message("G1202",
                           "no `" + declaration_.name + "` in " + show(Value{range_}) + ": at " +
                               shown(range_.from.value) + " " + told(first) + ", at " + shown(range_.to.value) + " " +
                               told(last),
                           condition_->span,
                           "at " + shown(at_high ? range_.to.value : range_.from.value) + ": left " +
                               show(Value{near.left}) + ", right " + show(Value{near.right}))
                       .also(range_span_, "")
                       .help(std::string("widen the range at its ") + (at_high ? "high" : "low") +
                             " end, or change what is asked for"));
  }

  void record() {
    SolvedValue solved;
    const MeasureValue value = measure_value(declaration_.name, Value{quantity(found_)});
    const MeasureValue residual =
        measure_value(declaration_.name, Value{Quantity{sides_.difference(), sides_.left.dimension, false}});
    solved.name = declaration_.name;
    solved.text = value.text;
    solved.value = found_;
    solved.unit = value.unit;
    solved.residual = residual.text;
    solved.residual_value = sides_.difference();
    solved.residual_unit = residual.unit;
    solved.bound = bound_;
    solved.trials = trials_;
    program_.solved.push_back(std::move(solved));
  }

  Program& program_;
  Declaration& declaration_;
  Clauses clauses_;
  RangeValue range_;
  Span range_span_;
  const Expr* condition_ = nullptr;
  Scope* scope_ = nullptr;
  Trial* trial_ = nullptr;
  Sides sides_;
  double found_ = 0;
  std::string bound_;
  int trials_ = 0;
  bool depends_ = false;
};

struct SolveDepthGuard {
  Program& program;
  SolveDepthGuard(Program& p, Span span) : program(p) {
    if (p.solving >= kMaxSolveDepth)
      fail(p, Message("G1207", "solves need each other more than " + std::to_string(kMaxSolveDepth) + " deep", span)
                  .help("compute one of the values directly"));
    ++p.solving;
  }
  SolveDepthGuard(const SolveDepthGuard&) = delete;
  SolveDepthGuard& operator=(const SolveDepthGuard&) = delete;
  ~SolveDepthGuard() { --program.solving; }
};

}  // namespace

Value evaluate_solve(Program& program, Declaration& declaration) {
  SolveDepthGuard guard(program, declaration.statement->keyword.span);
  return Solver(program, declaration).solve();
}

void forget_solve(Program& program, Declaration& declaration) {
  std::erase_if(program.solved, [&](const SolvedValue& solved) { return solved.name == declaration.name; });
}

}  // namespace garment::interpreter
