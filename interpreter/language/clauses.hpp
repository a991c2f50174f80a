#pragma once
// Reading the clauses of one statement: each once, in range, and none left unread.
#include <optional>
#include <string>
#include <vector>

#include "interpreter/language/evaluate.hpp"

namespace garment::interpreter {

class Clauses {
 public:
  /// Clauses of `statement`, those of `overrides` with a path of one word in place of its own.
  Clauses(Program& program, const Statement& statement, Scope& scope,
          std::vector<Override>* overrides = nullptr);

  const Statement& statement() const { return statement_; }
  Scope& scope() const { return scope_; }
  bool has(std::string_view word) const;
  /// The clause, marked as read; nothing if it is not there.
  const BoundClause* find(std::string_view word);
  /// As `find`, but its absence is an error.
  const BoundClause& need(std::string_view word);
  /// A word that stands alone.
  bool flag(std::string_view word);
  /// The one value of a clause.
  const Expr& value(const BoundClause& clause) const;
  /// The one quantity of a clause, with dimension and range of the construct table; nothing if it is not
  /// there.
  std::optional<double> quantity(std::string_view word);
  /// Marks as read what is handled elsewhere.
  void skip(std::string_view word);
  /// Reports clauses that nobody read.
  void finish();

 private:
  [[noreturn]] void fail_extra(Message message, const Expr& extra, const std::string& otherwise) const;
  struct Entry {
    BoundClause bound;
    bool read = false;
  };
  Program& program_;
  const Statement& statement_;
  Scope& scope_;
  const ConstructRecord* record_;
  std::vector<Entry> entries_;
};

/// A quantity in the range of the clause's record, else a report and Stop.
double checked_quantity(Program& program, const ClauseRecord& record, const Quantity& q, Span span);

}  // namespace garment::interpreter
