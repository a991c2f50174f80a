#include "interpreter/language/dependencies.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "interpreter/language/panels.hpp"

namespace garment::interpreter {
namespace {

/// Takes away fabrics from `first` on that neither a panel nor a layer is cut from, as far as none behind them is used.
void drop_unused_fabrics(Program& program, std::size_t first) {
  std::size_t used = first;
  for (const PanelInfo& info : program.panels)
    used = std::max(used, static_cast<std::size_t>(info.panel.fabric) + 1);
  for (const design::Layer& layer : program.garment.layers)
    used = std::max(used, static_cast<std::size_t>(layer.fabric) + 1);
  if (used >= program.garment.fabrics.size()) return;
  std::erase_if(program.fabric_index, [&](const auto& entry) { return static_cast<std::size_t>(entry.second) >= used; });
  program.garment.fabrics.resize(used);
}

bool is_panel(const Declaration& declaration) {
  const std::string& keyword = declaration.statement->keyword.text;
  return declaration.evaluate == nullptr && (keyword == "panel" || keyword == "pair");
}

}  // namespace

std::vector<Declaration*> dependents_of(Program& program, const Declaration& changed) {
  std::map<const Declaration*, std::vector<const Declaration*>> users;
  for (const Declaration& declaration : program.declarations)
    for (const Declaration* needed : declaration.needs) users[needed].push_back(&declaration);
  std::set<const Declaration*> reached;
  std::vector<const Declaration*> open{&changed};
  while (!open.empty()) {
    const auto found = users.find(open.back());
    open.pop_back();
    if (found == users.end()) continue;
    for (const Declaration* user : found->second)
      if (reached.insert(user).second) open.push_back(user);
  }
  reached.erase(&changed);
  std::vector<Declaration*> dependents;
  for (Declaration& declaration : program.declarations)
    if (reached.contains(&declaration)) dependents.push_back(&declaration);
  return dependents;
}

bool can_be_evaluated_again(const Declaration& declaration) {
  const ConstructRecord* record = find_construct(declaration.statement->keyword.text);
  return declaration.evaluate != nullptr || (record != nullptr && record->forget != nullptr);
}

void forget_value(Program&, Declaration&) {}

void forget(Program& program, Declaration& declaration) {
  const ConstructRecord* record = find_construct(declaration.statement->keyword.text);
  if (declaration.evaluate == nullptr && record != nullptr && record->forget != nullptr) record->forget(program, declaration);
  declaration.state = Declaration::State::waiting;
  declaration.value = Value{};
  declaration.needs.clear();
}

Trial::Trial(Program& program, Declaration& subject)
    : program_(program), subject_(subject), running_(std::move(program.running)), fabrics_(program.garment.fabrics.size()) {
  program_.running = {&subject_};
  for (Declaration* declaration : running_) {
    if (declaration == &subject_) continue;
    Held held;
    held.declaration = declaration;
    held.value = std::move(declaration->value);
    held.needs = std::move(declaration->needs);
    if (is_panel(*declaration) && declaration->index >= 0) {
      PanelInfo& info = program_.panels[static_cast<std::size_t>(declaration->index)];
      held.panel = std::move(info);  // moved, not copied: who draws it holds references to its edges
      for (const Item& item : program_.panel_places)
        if (item.declaration == declaration) held.places.push_back(item);
      forget_panel(program_, *declaration);
    }
    declaration->state = Declaration::State::waiting;
    held_.push_back(std::move(held));
  }
}

Trial::~Trial() {
  for (Held& held : held_) {
    Declaration& declaration = *held.declaration;
    if (is_panel(declaration) && declaration.index >= 0) {
      program_.panels[static_cast<std::size_t>(declaration.index)] = std::move(held.panel);
      program_.recipes.erase(declaration.index);
      std::erase_if(program_.panel_places, [&](const Item& item) { return item.declaration == &declaration; });
      program_.panel_places.insert(program_.panel_places.end(), held.places.begin(), held.places.end());
    }
    declaration.state = Declaration::State::running;
    declaration.value = std::move(held.value);
    declaration.needs = std::move(held.needs);
  }
  program_.running = std::move(running_);
  drop_unused_fabrics(program_, fabrics_);
}

void Trial::set(Value value) {
  subject_.value = std::move(value);
  subject_.state = Declaration::State::done;
}

const Declaration* Trial::forget_trial() {
  const Declaration* stuck = nullptr;
  for (Declaration* declaration : dependents_of(program_, subject_)) {
    if (declaration->state == Declaration::State::waiting) continue;
    if (!can_be_evaluated_again(*declaration)) {
      stuck = declaration;
      continue;
    }
    forget(program_, *declaration);
  }
  // What was being evaluated and does not depend on the subject was evaluated to its end just now: it is made again
  // when the trial is over, like the others.
  for (const Held& held : held_) {
    if (held.declaration->state == Declaration::State::waiting) continue;
    if (can_be_evaluated_again(*held.declaration))
      forget(program_, *held.declaration);
    else
      stuck = held.declaration;
  }
  subject_.state = Declaration::State::running;
  subject_.value = Value{};
  return stuck;
}

}  // namespace garment::interpreter
