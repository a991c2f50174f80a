#pragma once
// `slash`, `move`, `scale`: statements that act on declared panels.
#include "interpreter/language/drawing.hpp"

namespace garment::interpreter {

/// Attaches each modifier of the module to the panels it acts on, in the order of the script and before anything is
/// evaluated: a panel is drawn with all its modifiers, whoever asks for it first. Reports what names no panel.
void collect_modifiers(Program& program, Module& module);

/// Applies the panel's modifiers to what was drawn, before a fold is opened, and checks the result. Reports; false where
/// something was wrong.
bool apply_modifiers(Drawing& drawing);

/// In the order of the script there is nothing left to do for a modifier.
void run_modifier(Program& program, const Item& item);

}  // namespace garment::interpreter
