#include "interpreter/language/bodies.hpp"

#include <algorithm>

#include "interpreter/language/clauses.hpp"
#include "interpreter/language/word_lists.hpp"

namespace garment::interpreter {
namespace {

std::vector<std::string> level_names(const body::Body& body) {
  std::vector<std::string> names;
  for (const auto& [name, level] : body.levels) names.push_back(name);
  return names;
}

std::vector<std::string> part_names(const body::Body& body) {
  std::vector<std::string> names;
  for (const auto& [name, part] : body.parts) names.push_back(name);
  return names;
}

std::string help_for(const std::string& name, const std::vector<std::string>& names,
                     const std::string& what) {
  std::string hint = did_you_mean(name, names);
  if (hint.empty())
    hint = names.empty() ? "a plain shape has no " + what : "its " + what + " are " + listed(names);
  return hint;
}

bool is_side(std::string_view path) {
  return path == "front" || path == "back" || path == "left" || path == "right";
}

}  // namespace

int reserve_body(Program& program, const Declaration& declaration) {
  program.garment.bodies.emplace_back().name = declaration.name;
  program.built.emplace_back();
  program.build_failed.push_back(false);
  return static_cast<int>(program.garment.bodies.size()) - 1;
}

Value evaluate_body(Program& program, Declaration& declaration) {
  const Statement& statement = *declaration.statement;
  Scope& scope = *declaration.scope;
  design::Body& made = program.garment.bodies[static_cast<std::size_t>(declaration.index)];
  made.name = declaration.name;
  made.origin = program.origin(statement.span);
  Clauses clauses(program, statement, scope, &declaration.overrides);
  const Expr& expr = clauses.value(clauses.need("="));
  const Value value = eval(program, expr, scope);
  const auto* shape = value.as<ShapeValue>();
  if (shape == nullptr)
    fail(program,
         Message("G0306", kind_of(value) + " where `body` takes a shape", expr.span)
             .help("shapes are bodies.woman(...), bodies.man(...), mesh(\"file.obj\"), sphere, ellipsoid, "
                   "cylinder, box, floor"));
  made.shape = shape->shape;
  if (const BoundClause* at = clauses.find("at")) {
    const PointValue p = eval_point(program, clauses.value(*at), *at->scope, 3, kLength, "`at`");
    made.position = {p.at[0], p.at[1], p.at[2]};
  }
  if (const auto friction = clauses.quantity("friction")) made.friction = *friction;
  clauses.finish();
  return Value{BodyValue{declaration.index}};
}

void forget_body(Program& program, Declaration& declaration) {
  const std::size_t k = static_cast<std::size_t>(declaration.index);
  program.garment.bodies[k] = design::Body{};
  program.garment.bodies[k].name = declaration.name;
  program.built[k] = nullptr;
  program.build_failed[k] = false;
}

const body::Body* built_body(Program& program, int index, Span asked_at) {
  const std::size_t k = static_cast<std::size_t>(index);
  if (program.built[k] != nullptr) return program.built[k].get();
  if (program.build_failed[k]) return nullptr;
  const design::Body& declared = program.garment.bodies[k];
  body::BodyResult result =
      program.options.build_body
          ? program.options.build_body(declared, program.host, program.options.script_dir)
          : body::build_body(declared, program.host, program.options.script_dir);
  for (Diagnostic& diagnostic : to_diagnostics(result.findings, program.origins)) {
    if (diagnostic.labels.empty()) diagnostic.labels.push_back({asked_at, ""});
    Message message("", "", asked_at);
    message.diagnostic = std::move(diagnostic);
    report(program, std::move(message));
  }
  if (!result.body) {
    program.build_failed[k] = true;
    if (result.findings.empty()) report(program, Message("G0306", "the body cannot be built", asked_at));
    return nullptr;
  }
  program.built[k] = std::make_shared<const body::Body>(std::move(*result.body));
  return program.built[k].get();
}

namespace {

/// What a body offers by name.
struct Offer {
  std::string body;
  std::vector<std::string> levels, parts;
  const body::Frame* frame = nullptr;  ///< of a mannequin
};

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The frame of a mannequin, which takes a hundredth of the time that its surface takes; null for other
/// bodies.
const body::Frame* frame_of(Program& program, int index) {
  if (const auto known = program.frames.find(index); known != program.frames.end()) return &known->second;
  const std::size_t k = static_cast<std::size_t>(index);
  if (program.build_failed[k]) return nullptr;
  body::FrameResult made = body::make_frame(program.garment.bodies[k]);
  for (Diagnostic& diagnostic : to_diagnostics(made.findings, program.origins)) {
    Message message("", "", Span{});
    message.diagnostic = std::move(diagnostic);
    report(program, std::move(message));
    program.build_failed[k] = true;
  }
  if (!made.frame) return nullptr;
  return &program.frames.emplace(index, std::move(*made.frame)).first->second;
}

Offer offer_of(Program& program, int index, Span asked_at) {
  Offer offer;
  offer.body = program.garment.bodies[static_cast<std::size_t>(index)].name;
  offer.frame = frame_of(program, index);
  if (offer.frame != nullptr) {
    for (const auto& [name, level] : offer.frame->levels) offer.levels.push_back(name);
    offer.parts = offer.frame->parts;
    return offer;
  }
  const body::Body* body = built_body(program, index, asked_at);
  if (body == nullptr) throw Stop{};
  offer.levels = level_names(*body);
  offer.parts = part_names(*body);
  return offer;
}

[[noreturn]] void fail_level(Program& program, const Offer& offer, const std::string& name, Span span) {
  fail(program, Message("G0611", "body `" + offer.body + "` has no level `" + name + "`", span)
                    .help(help_for(name, offer.levels, "levels")));
}

}  // namespace

Value body_member(Program& program, const Expr& expr, int index, const std::string& path,
                  const std::string& name) {
  const bool figure = name == "girth" || name == "height";
  if (path.empty() && !figure)
    if (const body::Frame* frame = frame_of(program, index))
      if (const auto length = frame->lengths.find(name); length != frame->lengths.end())
        return number_value(length->second, kLength);
  if (path.empty() || !figure) return Value{BodyPlaceValue{index, path.empty() ? name : path + '.' + name}};
  const Span place = expr.children[0].span;
  const Offer offer = offer_of(program, index, expr.span);
  if (!has(offer.levels, path)) fail_level(program, offer, path, place);
  if (offer.frame != nullptr) {
    const body::FrameLevel& level = offer.frame->levels.at(path);
    const std::optional<double>& known = name == "girth" ? level.girth : level.height;
    if (known) return number_value(*known, kLength);
  }
  const body::Body* body = built_body(program, index, expr.span);
  if (body == nullptr) throw Stop{};
  const auto level = body->levels.find(path);
  if (level == body->levels.end()) fail_level(program, offer, path, place);
  return number_value(name == "girth" ? level->second.girth : level->second.height, kLength);
}

std::string checked_level(Program& program, const BodyPlaceValue& place, Span span) {
  const Offer offer = offer_of(program, place.body, span);
  if (!has(offer.levels, place.path)) fail_level(program, offer, place.path, span);
  return place.path;
}

bool is_plain(Program& program, int body, Span span) { return offer_of(program, body, span).parts.empty(); }

std::string checked_part(Program& program, const BodyPlaceValue& place, Span span, bool side) {
  Offer offer = offer_of(program, place.body, span);
  const bool torso = has(offer.parts, "torso");
  const bool good = is_side(place.path) ? side && torso : has(offer.parts, place.path);
  if (side && torso) offer.parts.insert(offer.parts.end(), {"front", "back", "left", "right"});
  if (!good)
    fail(program, Message("G0611", "body `" + offer.body + "` has no part `" + place.path + "`", span)
                      .help(help_for(place.path, offer.parts, "parts")));
  return place.path;
}

void check_bodies(Program& program) {
  for (std::size_t k = 0; k < program.garment.bodies.size(); ++k) {
    const int index = static_cast<int>(k);
    if (program.options.build_bodies || frame_of(program, index) == nullptr)
      built_body(program, index, program.origins[program.garment.bodies[k].origin.value]);
  }
}

}  // namespace garment::interpreter
