// `base.name`, and parts of edges `edge[from .. to]`.
#include <algorithm>
#include <cmath>

#include "interpreter/language/bodies.hpp"
#include "interpreter/language/curve_values.hpp"
#include "interpreter/language/edges.hpp"
#include "interpreter/language/evaluate.hpp"
#include "interpreter/language/fabrics.hpp"
#include "interpreter/language/function_table.hpp"
#include "interpreter/language/parts.hpp"
#include "interpreter/language/regions.hpp"

namespace garment::interpreter {
namespace {

[[noreturn]] void fail_member(Program& program, const Expr& expr, const std::string& what,
                              const std::string& name, const std::vector<std::string>& candidates) {
  Message message("G0311", what + " has no `" + name + "`", expr.name_span);
  std::string hint = did_you_mean(name, candidates);
  if (hint.empty() && !candidates.empty() && candidates.size() <= 24) {
    hint = "it has ";
    for (std::size_t k = 0; k < candidates.size(); ++k) hint += (k > 0 ? ", " : "") + candidates[k];
  }
  fail(program, message.help(hint));
}

Value module_member(Program& program, const Expr& expr, Module& module, const std::string& name) {
  const auto found = module.scope->declared.find(name);
  if (found != module.scope->declared.end()) return force(program, *found->second, expr.name_span);
  if (module.has_broken) throw Stop{};
  std::vector<std::string> names;
  for (const auto& [key, declaration] : module.scope->declared)  // what has no doc line is the library's own business
    if (declaration->statement == nullptr || !declaration->statement->doc.empty() || !module.library) names.push_back(key);
  fail_member(program, expr, "`" + module.name + "`", name, names);
}

EdgeValue edge_value(int panel, const PanelInfo& info, const NamedEdge& edge) {
  EdgeSpan span;
  span.panel = panel;
  span.name = info.panel.name + '.' + (edge.half.empty() ? "" : edge.half + '.') + edge.name;
  span.parts = edge.parts;
  return EdgeValue{{span}};
}

std::optional<design::Point2> interior_point(const design::Panel& panel, const std::string& half,
                                             const std::string& name) {
  for (const design::InteriorPoint& point : panel.points)
    if (point.name == (half.empty() ? name : half + '.' + name)) return point.point;
  return std::nullopt;
}

Value panel_member(Program& program, const Expr& expr, int index, std::string half, const std::string& name,
                   Scope& scope) {
  const PanelInfo& info = program.panels[static_cast<std::size_t>(index)];
  const std::string what = "panel `" + info.panel.name + (half.empty() ? "" : '.' + half) + "`";
  if (half.empty() && info.folded && (name == "left" || name == "right"))
    return Value{HalfValue{index, name}};
  // `both` puts its half into every operand that has halves.
  if (half.empty() && info.folded && !scope.half.empty() &&
      (find_edge(info, scope.half, name) != nullptr || interior_point(info.panel, scope.half, name))) {
    half = scope.half;
    for (const Scope* at = &scope; at != nullptr; at = at->parent) at->half_used = true;
  }
  if (const NamedEdge* edge = find_edge(info, half, name)) return Value{edge_value(index, info, *edge)};
  if (half.empty() && info.folded && find_edge(info, "left", name) != nullptr)
    fail(program,
         Message("G0311", "`" + info.panel.name + '.' + name + "` is two edges, one on each half", expr.span)
             .help("write `" + info.panel.name + ".left." + name + "` or `" + info.panel.name + ".right." +
                   name + "`, or put `both` before the statement"));
  auto named = [&](const std::string& full) {
    return full == (half.empty() ? name : half + '.' + name) || (half.empty() && full == "left." + name);
  };
  for (const design::EdgeDart& dart : info.panel.darts)
    if (named(dart.name)) return Value{DartValue{index, dart.name}};
  for (const design::InsideDart& dart : info.panel.inside_darts)
    if (named(dart.name)) return Value{DartValue{index, dart.name}};
  for (const design::Notch& notch : info.panel.notches)
    if (named(notch.name)) return Value{NotchValue{index, notch.name}};
  if (const auto point = interior_point(info.panel, half, name))
    return Value{PointValue{{point->x(), point->y(), 0}, 2, kLength, index}};
  if (half.empty() && name == "resolution") return number_value(info.panel.resolution, kLength);
  if (half.empty() && info.folded && interior_point(info.panel, "left", name))
    fail(program,
         Message("G0311", "`" + info.panel.name + '.' + name + "` is two points, one on each half", expr.span)
             .help("write `" + info.panel.name + ".left." + name + "` or `" + info.panel.name + ".right." + name + "`"));
  std::vector<std::string> names = edge_names(info);
  for (const design::InteriorPoint& point : info.panel.points)
    if (half.empty())
      names.push_back(point.name);
    else if (point.name.starts_with(half + '.'))
      names.push_back(point.name.substr(half.size() + 1));
  if (half.empty() && info.folded) names.insert(names.end(), {"left", "right"});
  if (half.empty()) names.emplace_back("resolution");
  fail_member(program, expr, what, name, names);
}

/// Several edges in a chain have no points of their own: whose is meant?
[[noreturn]] void fail_chain_member(Program& program, const Expr& expr, const EdgeValue& edge, const std::string& name) {
  constexpr std::size_t kNamed = 3;
  std::string ways;
  for (std::size_t k = 0; k < std::min(kNamed, edge.spans.size()); ++k)
    ways += (k == 0 ? "`" : " or `") + show(Value{EdgeValue{{edge.spans[k]}}}) + ".middle`";
  fail(program, Message("G0311", "`" + show(Value{edge}) + "` is a chain of " + std::to_string(edge.spans.size()) + " edges, which has no `" + name + "`",
                        expr.name_span)
                    .help("take a point of one of them, as in " + ways));
}

Value edge_member(Program& program, const Expr& expr, const EdgeValue& edge, const std::string& name) {
  const EdgeSpan& first = edge.spans.front();
  const EdgeSpan& last = edge.spans.back();
  auto point = [&](const EdgeSpan& span, double s) {
    const design::Point2 p = point_at(program, span, s);
    return Value{PointValue{{p.x(), p.y(), 0}, 2, kLength, span.panel}};
  };
  if (edge.spans.size() == 1) {
    if (name == "start") return point(first, 0);
    if (name == "end") return point(last, cut_length(last));
    if (name == "middle") return point(first, cut_length(first) / 2);
    if (const auto at = notch_position(program, first, name)) return point(first, *at);
  }
  if (edge.spans.size() > 1) fail_chain_member(program, expr, edge, name);
  fail_member(program, expr, "edge `" + show(Value{edge}) + "`", name, {"start", "end", "middle", "at"});
}

Value curve_member(Program& program, const Expr& expr, const geometry::Curve& curve, const std::string& name) {
  auto point = [](const design::Point2& p) { return Value{PointValue{{p.x(), p.y(), 0}, 2, kLength, -1}}; };
  if (name == "start") return point(curve.start());
  if (name == "end") return point(curve.end());
  if (name == "middle") return point(curve.point_at(curve.length() / 2));
  fail_member(program, expr, "the curve", name, {"start", "end", "middle", "at"});
}

/// `curve[from .. to]`: walked backwards where from > to.
Value curve_part(Program& program, const Expr& expr, const geometry::Curve& curve, Scope& scope) {
  auto end_at = [&](const Expr& value, double missing) {
    if (value.kind == ExprKind::none) return missing;
    if (value.kind == ExprKind::name && value.text == "start") return 0.0;
    if (value.kind == ExprKind::name && value.text == "end") return curve.length();
    return position_along(program, eval(program, value, scope), curve.length(), value.span, "a part of a curve");
  };
  const double from = end_at(expr.children[1], 0), to = end_at(expr.children[2], curve.length());
  if (!(std::fabs(to - from) > 1e-6))
    fail(program, Message("G0309",
                          "a part from " + format_quantity(from, kLength) + " to " + format_quantity(to, kLength) +
                              " has no length",
                          expr.span));
  return curve_value(program, curve.part(from, to), expr.span);
}

Value dart_member(Program& program, const Expr& expr, const DartValue& value, const std::string& name) {
  for (const design::EdgeDart& dart : program.panels[static_cast<std::size_t>(value.panel)].panel.darts) {
    if (dart.name != value.name) continue;
    if (name == "width") return number_value(dart.width, kLength);
    if (name == "depth" && !dart.apex) return number_value(dart.depth, kLength);
    if (name == "at") return number_value(dart.at, kLength);
  }
  for (const design::InsideDart& dart :
       program.panels[static_cast<std::size_t>(value.panel)].panel.inside_darts) {
    if (dart.name != value.name) continue;
    const double length = (dart.to - dart.from).norm();
    if (name == "width") return number_value(dart.width, kLength);
    if (name == "length") return number_value(length, kLength);
    if (name == "at") return number_value(dart.at * length, kLength);
    fail_member(program, expr, "dart `" + value.name + "`", name, {"width", "length", "at"});
  }
  fail_member(program, expr, "dart `" + value.name + "`", name, {"width", "depth", "at"});
}

Value record_member(Program& program, const Expr& expr, const RecordFields& fields, const std::string& name) {
  std::vector<std::string> names;
  for (const auto& [key, value] : fields) {
    if (key == name) return value;
    names.push_back(key);
  }
  fail_member(program, expr, "the record", name, names);
}

Value point_member(Program& program, const Expr& expr, const PointValue& p, const std::string& name) {
  if (name == "x") return number_value(p.at[0], p.dimension);
  if (name == "y") return number_value(p.at[1], p.dimension);
  if (name == "z" && p.size == 3) return number_value(p.at[2], p.dimension);
  fail_member(program, expr, kind_of(Value{p}), name, {"x", "y", "z"});
}

/// Properties of the things that have no kind of value of their own.
Value thing_member(Program& program, const Expr& expr, const ThingValue& thing, const std::string& name) {
  std::vector<std::string> names;
  if (thing.keyword == "region") {
    const design::Region& region = program.garment.regions[static_cast<std::size_t>(thing.index)];
    if (const auto factor = region_member(region, name)) return *factor;
    names = region_factor_names();
  }
  fail_member(program, expr, std::string(thing.keyword) + " `" + thing.declaration->name + "`", name, names);
}

/// The part that `expr` names, itself or inside of other parts; null where it names none. Nothing else is evaluated for it.
const Part* named_part(Program& program, const Expr& expr, Scope& scope) {
  Declaration* declaration = nullptr;
  if (expr.kind == ExprKind::name) {
    declaration = find_declaration(scope, name_of(program, expr, scope));
  } else if (expr.kind == ExprKind::member) {
    const Part* outer = named_part(program, expr.children[0], scope);
    if (outer == nullptr) return nullptr;
    const auto found = outer->scope->declared.find(name_of(program, expr, scope));
    if (found != outer->scope->declared.end()) declaration = found->second;
  }
  if (declaration == nullptr || declaration->statement->keyword.text != "part") return nullptr;
  const Value value = force(program, *declaration, expr.span);
  const auto* thing = value.as<ThingValue>();
  return thing == nullptr ? nullptr : &program.parts[static_cast<std::size_t>(thing->index)];
}

/// `sleeves.upper.left` of a part whose component has a `pair panel upper`: a declared name of the part with a dot in it.
Declaration* dotted_declaration_of_part(Program& program, const Expr& expr, const std::string& name, Scope& scope) {
  const Expr& base = expr.children[0];
  if (base.kind != ExprKind::member || (name != "left" && name != "right")) return nullptr;
  const Part* part = named_part(program, base.children[0], scope);
  if (part == nullptr) return nullptr;
  const std::string member = name_of(program, base, scope);
  const auto& declared = part->scope->declared;
  if (declared.find(member) != declared.end()) return nullptr;
  const auto found = declared.find(member + '.' + name);
  return found == declared.end() ? nullptr : found->second;
}

/// `side.left`, the name that `both seam side` gives: one declared name with a dot in it.
Declaration* dotted_declaration(const Expr& expr, const std::string& name, Scope& scope) {
  const Expr& base = expr.children[0];
  if (base.kind != ExprKind::name || (name != "left" && name != "right")) return nullptr;
  if (find_local(scope, base.text) != nullptr || find_declaration(scope, base.text) != nullptr)
    return nullptr;
  return find_declaration(scope, base.text + '.' + name);
}

}  // namespace

Value eval_member(Program& program, const Expr& expr, Scope& scope) {
  const std::string name = name_of(program, expr, scope);
  if (Declaration* dotted = dotted_declaration(expr, name, scope)) return force(program, *dotted, expr.span);
  if (Declaration* dotted = dotted_declaration_of_part(program, expr, name, scope)) return force(program, *dotted, expr.span);
  const Value base = eval(program, expr.children[0], scope);
  if (const auto* v = base.as<ModuleValue>()) return module_member(program, expr, *v->module, name);
  if (const auto* v = base.as<PanelValue>()) return panel_member(program, expr, v->panel, "", name, scope);
  if (const auto* v = base.as<HalfValue>())
    return panel_member(program, expr, v->panel, v->half, name, scope);
  if (const auto* v = base.as<EdgeValue>()) return edge_member(program, expr, *v, name);
  if (const auto* v = base.as<CurveValue>()) return curve_member(program, expr, (*v)->curve, name);
  if (const auto* v = base.as<DartValue>()) return dart_member(program, expr, *v, name);
  if (const auto* v = base.as<RecordValue>()) return record_member(program, expr, **v, name);
  if (const auto* v = base.as<PointValue>()) return point_member(program, expr, *v, name);
  if (const auto* v = base.as<ThingValue>(); v != nullptr && v->keyword == "part")
    return part_member(program, expr, *v, name);
  if (const auto* v = base.as<FabricValue>()) {
    if (const auto field = fabric_field(*v->fabric, name)) return *field;
    fail_member(program, expr, "fabric `" + v->fabric->name + "`", name, fabric_field_names());
  }
  if (const auto* v = base.as<BodyValue>()) return body_member(program, expr, v->body, "", name);
  if (const auto* v = base.as<BodyPlaceValue>()) return body_member(program, expr, v->body, v->path, name);
  if (const auto* v = base.as<ThingValue>()) return thing_member(program, expr, *v, name);
  fail(program, Message("G0311", kind_of(base) + " has no `" + name + "`", expr.name_span));
}

Value eval_range_index(Program& program, const Expr& expr, Scope& scope) {
  const Value base = eval(program, expr.children[0], scope);
  if (const auto* curve = base.as<CurveValue>()) return curve_part(program, expr, (*curve)->curve, scope);
  const auto* edge = base.as<EdgeValue>();
  if (edge == nullptr || edge->spans.size() != 1)
    fail(program, Message("G0306", "only one edge or curve has parts `[from .. to]`, this is " + kind_of(base),
                          expr.children[0].span));
  const EdgeSpan& span = edge->spans[0];
  const double length = cut_length(span);
  auto mark = [&](std::string_view name) -> std::optional<double> {
    if (name == "start") return 0.0;
    if (name == "end") return length;
    return notch_position(program, span, name);
  };
  auto end_at = [&](const Expr& value, double missing) {
    if (value.kind == ExprKind::none) return missing;
    const double at = eval_position(program, {value}, scope, length, mark, value.span, "a part of an edge");
    if (!(at >= -1e-6 && at <= length + 1e-6))
      fail(program,
           Message("G0309",
                   format_quantity(at, kLength) + " along an edge of " + format_quantity(length, kLength),
                   value.span)
               .help("positions on `" + span.name + "` are 0 .. " + format_quantity(length, kLength)));
    return std::clamp(at, 0.0, length);
  };
  const double from = end_at(expr.children[1], 0), to = end_at(expr.children[2], length);
  if (!(to - from > 1e-6))
    fail(program, Message("G0309",
                          "a part from " + format_quantity(from, kLength) + " to " +
                              format_quantity(to, kLength) + " has no length",
                          expr.span)
                      .help("parts run in the drawn direction, from the smaller to the larger position"));
  EdgeSpan part = sub_span(span, from, to);
  part.name += "[..]";
  return Value{EdgeValue{{part}}};
}

}  // namespace garment::interpreter
