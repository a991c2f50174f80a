#pragma once
// The inside of a panel: interior lines, named points, holes and slits.
#include "interpreter/language/drawing.hpp"

namespace garment::interpreter {

/// Draws lines, points, holes and slits of the recipe in the order written. Reports what is wrong; false where something
/// was.
bool draw_interior(Drawing& drawing);

/// Lines and points must lie inside the panel, holes clear of its outline and of each other; slits on lines that lie
/// inside. Reports; false where something was wrong. To be asked of the panel as drawn, before a fold is opened.
bool check_interior(Drawing& drawing);

/// Makes lines and holes of the finished panel known as edges (PanelInfo::edges), per half and joined where they meet
/// the fold.
void name_interior(PanelInfo& info, int panel);

}  // namespace garment::interpreter
