// `join PORT to EDGE`: a seam whose first side is a port.
#include "interpreter/language/clauses.hpp"
#include "interpreter/language/edges.hpp"
#include "interpreter/language/parts.hpp"
#include "interpreter/language/seams.hpp"

namespace garment::interpreter {
namespace {

const Expr& without_part(const Expr& expr) {
  return expr.kind == ExprKind::range_index && !expr.children.empty() ? without_part(expr.children[0]) : expr;
}

/// The port that an operand names; null for other edges.
const Declaration* port_of(Program& program, const Expr& expr, Scope& scope) {
  const DeclaredPath path = find_path(program, without_part(expr), scope);
  const bool port = path.declaration != nullptr && path.declaration->statement->keyword.text == "port";
  return port && path.rest.empty() ? path.declaration : nullptr;
}

/// A join that cannot be sewn shows where its ports come from.
void show_ports(Program& program, const Statement& statement, Scope& scope, std::size_t first) {
  for (std::size_t k = first; k < program.diagnostics.size(); ++k) {
    Diagnostic& diagnostic = program.diagnostics[k];
    if (diagnostic.code.compare(0, 3, "G05") != 0) continue;
    for (const Clause& clause : statement.clauses) {
      if ((clause.word.text != ":" && clause.word.text != "to") || clause.values.size() != 1) continue;
      const Declaration* port = port_of(program, clause.values[0], scope);
      if (port == nullptr) continue;
      std::string label = "port `" + port->name + "`";
      if (port->state == Declaration::State::done)
        if (const auto* edge = port->value.as<EdgeValue>())
          label += " is `" + show(port->value) + "`, " + format_mm(sewn_length(program, *edge));
      diagnostic.labels.push_back({port->statement->span, label});
    }
  }
}

}  // namespace

const Statement& make_join(Program& program, const Statement& statement) {
  if (statement.operands.size() != 1)
    fail(program, Message(statement.operands.empty() ? "G0312" : "G0313", "`join` takes one port before `to`",
                          statement.operands.empty() ? statement.keyword.span : statement.operands[1].span)
                      .help("write `join PORT to EDGE`"));
  Statement& seam = program.made_statements.emplace_back(statement);
  seam.keyword.text = "seam";
  seam.operands.clear();
  seam.clauses.clear();
  Clause& side = seam.clauses.emplace_back();
  side.word = {":", statement.operands[0].span, {}};
  side.values = {statement.operands[0]};
  side.span = statement.operands[0].span;
  // A relation speaks of the port, wherever it stands.
  for (const char* round : {"relations", "sides"})
    for (const Clause& clause : statement.clauses)
      if ((clause.word.text == "to") == (std::string_view(round) == "sides")) seam.clauses.push_back(clause);
  return seam;
}

std::string join_name(Program& program, const Statement& statement, Scope& scope) {
  const Expr& port = without_part(statement.operands[0]);
  std::string name;
  for (const Expr* at = &port; at != nullptr;) {
    if (at->kind != ExprKind::name && at->kind != ExprKind::member)
      return std::string(program.sources.text(port.span));
    name = name_of(program, *at, scope) + (name.empty() ? "" : "." + name);
    at = at->kind == ExprKind::member ? &at->children[0] : nullptr;
  }
  return name;
}

Value evaluate_join(Program& program, Declaration& declaration) {
  const Statement& statement = *declaration.statement;
  const std::size_t first = program.diagnostics.size();
  const Expr& side = statement.clauses[0].values[0];
  if (port_of(program, side, *declaration.scope) == nullptr) {
    for (const Part& part : program.parts)
      if (part.broken) throw Stop{};                              // the port may be what was refused
    const Value value = eval(program, side, *declaration.scope);  // a name that is not there is said first
    fail(program,
         Message("G1226",
                 "`" + std::string(program.sources.text(side.span)) + "` is " + kind_of(value) +
                     ", no port of a part",
                 side.span)
             .help("join ports of parts, as in `join left_sleeve.cap to front.armhole`; sew other edges "
                   "with `seam NAME: EDGE to EDGE`"));
  }
  try {
    return evaluate_seam(program, declaration);
  } catch (const Stop&) {
    show_ports(program, statement, *declaration.scope, first);
    throw;
  }
}

}  // namespace garment::interpreter
