#pragma once
// What a seam statement says besides its sides: how it is made up, and where rings start.
#include <string>
#include <vector>

#include "interpreter/language/program.hpp"

namespace garment::interpreter {

/// Reads the clauses of a seam that concern all of it, with the assignments that change them.
class SeamFinishReader {
 public:
  SeamFinishReader(Program& program, Declaration& declaration);

  /// Takes the clause if it is one of its own; `sides` have been read so far. Reports and throws Stop.
  bool take(const Clause& clause, std::size_t sides);
  /// All that was read, once the sides of `info` are known.
  design::SeamFinish finish(const SeamInfo& info);
  const std::vector<SeamStart>& starts() const { return starts_; }

 private:
  void take_start(const Clause& clause);
  void take_ironed(const SeamInfo& info);
  void take_numbers();
  double number(const std::string& word, const Clause* clause, const Override* change) const;
  const Clause* find(const std::string& word) const;
  void check_exclusions() const;

  Program& program_;
  Declaration& declaration_;
  Scope& scope_;
  std::vector<const Clause*> clauses_;
  bool after_fold_ = false;
  design::SeamFinish finish_;
  std::vector<SeamStart> starts_;
};

/// `face` or `back` after `to`; `what` names the statement's part ("`turn`").
design::Facing eval_facing(Program& program, const Clause& clause, const std::string& what);

}  // namespace garment::interpreter
