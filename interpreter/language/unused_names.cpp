#include "interpreter/language/unused_names.hpp"

#include <algorithm>
#include <set>

namespace garment::interpreter {
namespace {

struct Declared {
  std::string name, keyword;
  Span span;
};

/// Walks the whole tree: what is declared, what is written.
class Words {
 public:
  void take(const grammar::Block& block) {
    for (const Statement& statement : block) take(statement);
  }

  bool used(const std::string& name) const {
    if (written_.contains(name)) return true;
    return std::any_of(beginnings_.begin(), beginnings_.end(),
                       [&](const std::string& beginning) { return name.starts_with(beginning); });
  }

  const std::vector<Declared>& declared() const { return declared_; }

 private:
  void take(const Statement& statement) {
    const std::string& keyword = statement.keyword.text;
    if (statement.name) {
      for (const Expr& part : statement.name->parts) take(part);
      if (statement.name->parts.empty() && (keyword == "let" || keyword == "line" || keyword == "point"))
        declared_.push_back({statement.name->text, keyword, statement.name->span});
    }
    // A function's head is written as a call of it.
    const bool head = (keyword == "fn" || keyword == "component") && !statement.operands.empty() &&
                      statement.operands[0].kind == ExprKind::call && !statement.operands[0].children.empty();
    if (head) {
      const Expr& name = statement.operands[0].children[0];
      if (keyword == "fn" && name.kind == ExprKind::name && name.children.empty())
        declared_.push_back({name.text, keyword, name.span});
      for (std::size_t k = 1; k < statement.operands[0].children.size(); ++k) take(statement.operands[0].children[k]);
    }
    for (std::size_t k = head ? 1 : 0; k < statement.operands.size(); ++k) take(statement.operands[k]);
    for (const Clause& clause : statement.clauses)
      for (const Expr& value : clause.values) take(value);
    if (statement.body) take(*statement.body);
    if (statement.else_body) take(*statement.else_body);
  }

  void take(const Expr& expr) {
    if (expr.kind == ExprKind::name || expr.kind == ExprKind::member) {
      const std::size_t first = expr.kind == ExprKind::member ? 1 : 0;
      if (expr.children.size() == first)
        written_.insert(expr.text);
      else  // with braces: only its beginning is known
        beginnings_.push_back(expr.children[first].kind == ExprKind::text ? expr.children[first].text : "");
    }
    for (const Expr& child : expr.children) take(child);
  }

  std::set<std::string> written_;
  std::vector<std::string> beginnings_;
  std::vector<Declared> declared_;
};

}  // namespace

void check_unused(Program& program) {
  Words words;
  words.take(program.main->script.statements);
  constexpr std::size_t kTold = 10;  // more would bury what else is to be said
  std::vector<const Declared*> unused;
  for (const Declared& declared : words.declared())
    if (!words.used(declared.name)) unused.push_back(&declared);
  for (std::size_t k = 0; k < std::min(unused.size(), kTold); ++k) {
    const Declared& declared = *unused[k];
    const bool drawn = declared.keyword == "line" || declared.keyword == "point";
    report(program, Message("G0439", "`" + declared.name + "` is declared and never used", declared.span)
                        .warning()
                        .help(drawn ? "it is drawn on the pattern and changes nothing else"
                                    : "use it, or leave it out; is the name of another meant?"));
  }
  if (unused.size() > kTold)
    report(program, Message("G0439", std::to_string(unused.size() - kTold) + " more names are declared and never used",
                            unused[kTold]->span, "the first of them")
                        .warning()
                        .help("use them, or leave them out"));
}

}  // namespace garment::interpreter
