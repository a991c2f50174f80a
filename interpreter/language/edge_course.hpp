#pragma once
// An edge, part of one, chain of edges of one panel, or drafted curve as one curve.
#include "interpreter/language/evaluate.hpp"

namespace garment::interpreter {

/// The course of the edge, chain or drafted curve that the expression names, walked in its direction (`-a` backwards), as one curve in
/// the panel's coordinates. Refuses other values (G0306), chains over several panels and links that do not meet within
/// 0.01 mm (G0442).
geometry::Curve eval_course(Program& program, const Expr& expr, Scope& scope, const std::string& what);

}  // namespace garment::interpreter
