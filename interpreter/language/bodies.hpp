#pragma once
// Bodies: shapes to design::Body, built at the first question about a level or girth.
#include <memory>
#include <string>

#include "interpreter/language/evaluate.hpp"

namespace garment::interpreter {

int reserve_body(Program& program, const Declaration& declaration);
/// `body NAME = SHAPE at ... friction ...`; fills its place in Garment::bodies.
Value evaluate_body(Program& program, Declaration& declaration);
/// The body back to what `reserve_body` made.
void forget_body(Program& program, Declaration& declaration);

/// The built body; null where it could not be built (said once).
const body::Body* built_body(Program& program, int index, Span asked_at);

/// Builds the bodies that nobody asked for yet. Without `build_bodies` mannequins are left unbuilt: their measures are
/// checked.
void check_bodies(Program& program);

/// `form.waist`, `form.arm.left`, `form.waist.girth`, `form.back_length`.
Value body_member(Program& program, const Expr& expr, int index, const std::string& path,
                  const std::string& name);

/// A level that the body has, or a report and Stop.
std::string checked_level(Program& program, const BodyPlaceValue& place, Span span);
/// True where the body has no parts: a plain shape.
bool is_plain(Program& program, int body, Span span);
/// A part that cloth can be put on: "front", "back", "left", "right" need a torso; others must be parts of
/// the body.
std::string checked_part(Program& program, const BodyPlaceValue& place, Span span, bool side);

}  // namespace garment::interpreter
