#pragma once
// Which declarations were made from which, and evaluating some of them again.
#include <vector>

#include "interpreter/language/program.hpp"

namespace garment::interpreter {

/// The declarations whose values were made with that of `changed`, directly or by way of others, in the order of their
/// declaration; `changed` itself is not among them. What was never evaluated is not known and not listed.
std::vector<Declaration*> dependents_of(Program& program, const Declaration& changed);

/// True where `forget` can be called: what its evaluation left in the garment can be taken back.
bool can_be_evaluated_again(const Declaration& declaration);

/// For constructs whose evaluation leaves nothing in the garment.
void forget_value(Program& program, Declaration& declaration);

/// Back to before the evaluation: the next `force` evaluates it again. Takes back what it put into the garment.
void forget(Program& program, Declaration& declaration);

/// Evaluations for trial. While it lives, declarations that are being evaluated may be evaluated afresh; afterwards
/// they go on where they were, with what they had made so far. Fabrics that only trials used are dropped. `forget_trial` ends one trial.
class Trial {
 public:
  /// `subject` is the declaration whose value is tried.
  Trial(Program& program, Declaration& subject);
  Trial(const Trial&) = delete;
  Trial& operator=(const Trial&) = delete;
  ~Trial();

  /// Gives the subject this value.
  void set(Value value);
  /// Forgets all that was made with the value of the subject. Returns what cannot be made again, or null.
  const Declaration* forget_trial();

 private:
  struct Held {
    Declaration* declaration = nullptr;
    PanelInfo panel;
    std::vector<Item> places;  ///< `place` statements of a panel that is half drawn
    Value value;
    std::set<Declaration*> needs;
  };
  Program& program_;
  Declaration& subject_;
  std::vector<Held> held_;
  std::vector<Declaration*> running_;
  std::size_t fabrics_ = 0;
};

}  // namespace garment::interpreter
