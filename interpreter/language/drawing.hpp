#pragma once
// A panel while it is drawn: what of it exists so far is known in its own block by its plain names.
#include <optional>
#include <string>

#include "interpreter/language/recipe.hpp"

namespace garment::interpreter {

/// What the functions that draw a panel's items share. `panel` is drawn as stated: not yet mirrored, not yet opened.
struct Drawing {
  Program& program;
  int index = -1;  ///< of the panel
  PanelInfo& info;
  design::Panel& panel;
  const Recipe& recipe;
};

/// The scope of an item's values: below the statement's own, it knows the edges, lines and points drawn so far.
Scope& drawing_scope(Program& program, Scope& scope, int panel, const RecipeItem& item);

/// An edge, line or point of the panel that is being drawn at this place; nothing if there is none of that name.
std::optional<Value> drawn_member(Program& program, const Scope& scope, const std::string& name);

/// Place of the item's name.
Span name_span(const RecipeItem& item);
/// Today's name of what the item's text calls `name`.
std::string renamed(const RecipeItem& item, const std::string& name);

/// The edge, interior line or hole's edge of that name; null if there is none.
const design::Edge* find_drawn_edge(const design::Panel& panel, std::string_view name);
/// Names of all of them.
std::vector<std::string> drawn_edge_names(const design::Panel& panel);

/// "(3 cm, 4 cm)".
std::string format_point(const design::Point2& p);

}  // namespace garment::interpreter
