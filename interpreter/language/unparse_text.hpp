#pragma once
// Pieces of script text: quantities, points, names that the language accepts.
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/design/garment.hpp"

namespace garment::interpreter::text {

/// Length in centimetres with ten decimals at most ("12.5 cm"), plain 0 for zero.
std::string length(double metres);
/// "(12.5 cm, 0)".
std::string point(const design::Point2& p);
std::string point(const Eigen::Vector3d& p);
/// Curves that follow each other as an expression: "line(P, Q) + arc(P, Q, bulge: 1 cm)".
std::string curves(const std::vector<geometry::Curve>& links);
/// Angle in degrees with ten decimals at most ("30 deg"), plain 0 for zero.
std::string angle_deg(double degrees);
/// Number with twelve significant digits at most.
std::string number(double value);
/// `text` in quotes. Strings have no escapes: what would end or fill the string is replaced by a like
/// character.
std::string in_quotes(std::string_view text);

/// True for words that a declared name may not be: keywords, units, builtin functions, words of expressions.
bool is_kept_word(std::string_view word);

/// True for words that stand for something else inside a panel: `left`, `start`, the clauses of `edge`,
/// units.
bool is_kept_in_panel(std::string_view word);

/// `name` as an identifier that is neither kept nor in `taken`, which it joins.
std::string fresh_name(std::string_view name, std::string_view fallback, std::set<std::string>& taken,
                       bool (*kept)(std::string_view) = is_kept_word);

/// The names of one garment as a script can spell them.
struct Names {
  std::vector<std::string> fabrics, bodies, panels, seams, pins;
  std::vector<std::vector<std::string>> edges, darts, notches;  ///< [panel][edge] and so on
  std::vector<std::vector<std::string>> hole_edges, holes, lines, points, slits, inside_darts, leg_darts, pleats;
  std::vector<std::string> undeclared_bodies;                   ///< named by attachments or placements only
};
/// Name of the edge, line or hole's edge that a part belongs to, without its panel.
const std::string& edge_name(const Names& names, const design::EdgePart& part);
/// `also_body` is a body to be declared though nothing names it; empty: none.
Names make_names(const design::Garment& garment, const std::string& also_body = {});

}  // namespace garment::interpreter::text
