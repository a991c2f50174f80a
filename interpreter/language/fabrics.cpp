#include "interpreter/language/fabrics.hpp"

#include <cmath>

#include "interpreter/language/clauses.hpp"
#include "interpreter/language/collections.hpp"
#include "interpreter/language/fabric_fields.hpp"

namespace garment::interpreter {
namespace {

struct SlotInfo {
  Slot slot;
  Dimension dimension;
  double min, max;  // SI
  bool percent;
};
constexpr SlotInfo kSlots[] = {
    {Slot::W, kArealDensity, 1e-3, 5, false},
    {Slot::T, kLength, 1e-5, 0.05, false},
    {Slot::G, kShearRigidity, 1e-2, 1e5, false},
    {Slot::HG, kForcePerLength, 0, 1e3, false},
    {Slot::HG5, kForcePerLength, 0, 1e3, false},
    {Slot::B, kMoment, 1e-9, 1, false},
    {Slot::HB, kForce, 0, 1, false},
    {Slot::twist, kMoment, 0, 1, false},
    {Slot::EM, kNumber, 1e-4, 5, true},
    {Slot::LT, kNumber, 0.1, 1.5, false},
    {Slot::WT, kForcePerLength, 1e-4, 1e4, false},
    {Slot::RT, kNumber, 0, 1, true},
    {Slot::Fm, kForcePerLength, 0.1, 1e5, false},
    {Slot::stretch, kForcePerLength, 1, 1e7, false},
    {Slot::friction, kNumber, 0, 2, false},
    {Slot::damping, kTime, 0, 10, false},
    {Slot::E5, kNumber, 1e-5, 5, true},
    {Slot::E20, kNumber, 1e-5, 5, true},
    {Slot::E100, kNumber, 1e-4, 5, true},
    {Slot::EB5, kNumber, 1e-4, 5, true},
    {Slot::bending_length, kLength, 1e-3, 0.2, false},
    {Slot::T100, kLength, 1e-5, 0.05, false},
};

/// Directions: 0 warp, 1 weft, 2 both, 3 none.
struct FieldName {
  std::string_view name;
  Slot slot;
  int direction;
};
constexpr FieldName kFields[] = {
    {"W", Slot::W, 3},
    {"T", Slot::T, 3},
    {"thickness", Slot::T, 3},
    {"EM_warp", Slot::EM, 0},
    {"EM_weft", Slot::EM, 1},
    {"EM", Slot::EM, 2},
    {"LT_warp", Slot::LT, 0},
    {"LT_weft", Slot::LT, 1},
    {"LT", Slot::LT, 2},
    {"WT_warp", Slot::WT, 0},
    {"WT_weft", Slot::WT, 1},
    {"WT", Slot::WT, 2},
    {"RT_warp", Slot::RT, 0},
    {"RT_weft", Slot::RT, 1},
    {"RT", Slot::RT, 2},
    {"Fm", Slot::Fm, 2},
    {"stretch_warp", Slot::stretch, 0},
    {"stretch_weft", Slot::stretch, 1},
    {"stretch", Slot::stretch, 2},
    {"G", Slot::G, 3},
    {"shear", Slot::G, 3},
    {"two_HG", Slot::HG, 3},
    {"two_HG5", Slot::HG5, 3},
    {"B_warp", Slot::B, 0},
    {"B_weft", Slot::B, 1},
    {"B", Slot::B, 2},
    {"bend_warp", Slot::B, 0},
    {"bend_weft", Slot::B, 1},
    {"bend", Slot::B, 2},
    {"two_HB_warp", Slot::HB, 0},
    {"two_HB_weft", Slot::HB, 1},
    {"two_HB", Slot::HB, 2},
    {"twist", Slot::twist, 3},
    {"MIU", Slot::friction, 3},
    {"friction", Slot::friction, 3},
    {"damping", Slot::damping, 3},
    {"E5_warp", Slot::E5, 0},
    {"E5_weft", Slot::E5, 1},
    {"E5", Slot::E5, 2},
    {"E20_warp", Slot::E20, 0},
    {"E20_weft", Slot::E20, 1},
    {"E20", Slot::E20, 2},
    {"E100_warp", Slot::E100, 0},
    {"E100_weft", Slot::E100, 1},
    {"E100", Slot::E100, 2},
    {"EB5", Slot::EB5, 3},
    {"c_warp", Slot::bending_length, 0},
    {"c_weft", Slot::bending_length, 1},
    {"c", Slot::bending_length, 2},
    {"T2", Slot::T, 3},
    {"T100", Slot::T100, 3},
};

const SlotInfo& info_of(Slot slot) { return kSlots[static_cast<std::size_t>(slot)]; }

const FieldName* find_field(std::string_view name) {
  for (const FieldName& field : kFields)
    if (field.name == name) return &field;
  return nullptr;
}

double get(const design::Fabric& f, Slot slot, std::size_t d) {
  const design::Tensile& t = f.tensile[d];
  switch (slot) {
    case Slot::W:
      return f.areal_density;
    case Slot::T:
      return f.thickness;
    case Slot::G:
      return f.shear_rigidity;
    case Slot::HG:
      return 2 * f.shear_friction;
    case Slot::HG5:
      return 2 * f.shear_friction_5;
    case Slot::B:
      return f.bending_rigidity[d];
    case Slot::HB:
      return 2 * f.bending_friction[d];
    case Slot::twist:
      return f.twist_rigidity;
    case Slot::EM:
      return t.max_strain;
    case Slot::LT:
      return t.linearity;
    case Slot::WT:
      return t.linearity * t.max_force * t.max_strain / 2;
    case Slot::RT:
      return t.resilience;
    case Slot::Fm:
      return t.max_force;
    case Slot::stretch:
      return t.max_force / t.max_strain;
    case Slot::friction:
      return f.friction;
    case Slot::damping:
      return f.damping;
    default:  // FAST figures are read only
      return 0;
  }
}

void apply_plain(design::Fabric& f, Given& given) {
  auto take = [&](Slot slot, double& member, double factor = 1) {
    if (const auto& x = given.at(slot, 0)) member = factor * *x;
  };
  take(Slot::W, f.areal_density);
  take(Slot::T, f.thickness);
  take(Slot::G, f.shear_rigidity);
  take(Slot::HG, f.shear_friction, 0.5);
  take(Slot::HG5, f.shear_friction_5, 0.5);
  take(Slot::twist, f.twist_rigidity);
  take(Slot::friction, f.friction);
  take(Slot::damping, f.damping);
  for (std::size_t d = 0; d < 2; ++d) {
    if (const auto& x = given.at(Slot::B, d)) f.bending_rigidity[d] = *x;
    if (const auto& x = given.at(Slot::HB, d)) f.bending_friction[d] = *x / 2;
  }
}

void apply_tensile(Program& program, design::Fabric& f, Given& given) {
  for (std::size_t d = 0; d < 2; ++d) {
    design::Tensile& t = f.tensile[d];
    if (const auto& x = given.at(Slot::Fm, d)) t.max_force = *x;
    if (const auto& x = given.at(Slot::RT, d)) t.resilience = *x;
    if (const auto& x = given.at(Slot::EM, d)) t.max_strain = *x;
    if (const auto& x = given.at(Slot::LT, d)) t.linearity = *x;
    const std::size_t stretch = static_cast<std::size_t>(Slot::stretch),
                      em = static_cast<std::size_t>(Slot::EM);
    if (const auto& x = given.at(Slot::stretch, d)) {
      for (Slot other : {Slot::EM, Slot::LT, Slot::WT})
        if (given.at(other, d))
          fail(program, Message("G0314", "`stretch` and a Kawabata tensile figure say the same thing twice",
                                given.span[stretch][d])
                            .also(given.span[static_cast<std::size_t>(other)][d], "here too")
                            .help("give either EM, LT, WT or `stretch`"));
      t.linearity = 1;
      t.max_strain = t.max_force / *x;
    }
    if (const auto& wt = given.at(Slot::WT, d)) {
      const double linearity = 2 * *wt / (t.max_force * t.max_strain);
      const Span span = given.span[static_cast<std::size_t>(Slot::WT)][d];
      if (!given.at(Slot::LT, d)) {
        if (!(linearity >= 0.1 && linearity <= 1.5))
          fail(program, Message("G0309",
                                "WT, EM and Fm give a linearity LT of " + format_quantity(linearity, {}) +
                                    "; it must lie in 0.1 .. 1.5",
                                span)
                            .help("LT = 2 WT / (Fm EM); is a unit wrong?"));
        t.linearity = linearity;
      } else if (std::fabs(linearity - t.linearity) > 0.03 * t.linearity) {
        report(program, Message("G0329",
                                "WT says LT = " + format_quantity(linearity, {}) + ", LT says " +
                                    format_quantity(t.linearity, {}),
                                span)
                            .also(given.span[em][d], "")
                            .help("WT = LT Fm EM / 2 must hold; LT is taken")
                            .warning());
      }
    }
  }
}

std::array<double, 3> eval_color(Program& program, const std::string& text, Span span) {
  std::array<double, 3> color{};
  bool good = text.size() == 7 && text[0] == '#';
  for (std::size_t k = 0; good && k < 3; ++k) {
    int value = 0;
    for (std::size_t j = 1 + 2 * k; j < 3 + 2 * k; ++j) {
      const std::size_t digit =
          std::string_view("0123456789abcdef")
              .find(text[j] >= 'A' && text[j] <= 'F' ? static_cast<char>(text[j] + 32) : text[j]);
      good = good && digit != std::string_view::npos;
      value = 16 * value + static_cast<int>(digit & 15);
    }
    color[k] = value / 255.0;
  }
  if (!good) fail(program, Message("G0309", "`" + text + "` is no colour", span).help("write \"#rrggbb\""));
  return color;
}

void apply_record(Program& program, design::Fabric& fabric, Given& given, const Expr& record, Scope& scope) {
  for (std::size_t k = 0; k < record.children.size() && k < record.labels.size(); ++k) {
    const Expr& expr = record.children[k];
    take_field(program, fabric, given, record.labels[k].text, record.labels[k].span,
               eval(program, expr, scope), expr.span);
  }
  apply_given(program, fabric, given);
}

/// `color`, `kind`, `source`, `pattern`, `repeat`; false for any other field.
bool take_text_field(Program& program, design::Fabric& fabric, const std::string& name, const Value& value,
                     Span span) {
  if (name == "repeat") {
    const double x = as_quantity(program, value, span, kLength, "`repeat`").value;
    if (!(x >= 1e-3 && x <= 10))
      fail(program,
           Message("G0309", "`repeat` is " + format_quantity(x, kLength) + "; it must lie in 1 mm .. 10 m",
                   span));
    fabric.pattern_repeat = x;
    return true;
  }
  if (name != "color" && name != "kind" && name != "source" && name != "pattern") return false;
  const auto* text = value.as<std::string>();
  if (text == nullptr)
    fail(program, Message("G0306", kind_of(value) + " where `" + name + "` takes text in quotes", span));
  if (name == "color") fabric.color = eval_color(program, *text, span);
  if (name == "kind") fabric.kind = *text;
  if (name == "source") fabric.source = *text;
  if (name == "pattern") {
    check_pattern(program, *text, span);
    fabric.pattern = *text;
  }
  return true;
}

bool is_fast(Slot slot) { return slot >= Slot::E5; }

}  // namespace

void take_field(Program& program, design::Fabric& fabric, Given& given, const std::string& name,
                Span name_span, const Value& value, Span value_span) {
  if (take_text_field(program, fabric, name, value, value_span)) return;
  const FieldName* field = find_field(name);
  if (field == nullptr) {
    std::string hint = did_you_mean(name, fabric_field_names());
    if (hint.empty())
      hint =
          "fields are W T EM LT WT RT Fm G two_HG two_HG5 B two_HB, stretch, bend, shear, friction, and "
          "FAST's E5 E20 "
          "E100 EB5 c T2 T100";
    fail(program, Message("G0311", "a fabric has no `" + name + "`", name_span).help(hint));
  }
  const SlotInfo& info = info_of(field->slot);
  const auto* q = value.as<Quantity>();
  // N/m per radian and N/m are the same number: a radian is a ratio.
  const bool shear_as_force = field->slot == Slot::G && q != nullptr && q->dimension == kForcePerLength;
  const double x = shear_as_force
                       ? q->value
                       : as_quantity(program, value, value_span, info.dimension, "`" + name + "`").value;
  if (!(x >= info.min && x <= info.max))
    fail(program, Message("G0309",
                          "`" + name + "` is " + format_quantity(x, info.dimension, info.percent) +
                              "; it must lie in " + format_quantity(info.min, info.dimension, info.percent) +
                              " .. " + format_quantity(info.max, info.dimension, info.percent),
                          value_span));
  for (std::size_t d = 0; d < 2; ++d) {
    if (field->direction == 3 ? d == 1 : field->direction != 2 && field->direction != static_cast<int>(d))
      continue;
    const std::size_t slot = static_cast<std::size_t>(field->slot);
    if (given.value[slot][d])
      fail(program, Message("G0314", "`" + name + "` says again what is already given", name_span)
                        .also(given.span[slot][d], "first here"));
    given.value[slot][d] = x;
    given.span[slot][d] = value_span;
  }
}

void apply_given(Program& program, design::Fabric& fabric, Given& given) {
  apply_plain(fabric, given);
  apply_fast(program, fabric, given);
  apply_tensile(program, fabric, given);
  note_unused(program, given);
}

std::optional<Value> fabric_field(const design::Fabric& fabric, const std::string& name) {
  if (name == "kind") return own_text(fabric.kind);
  if (name == "source") return own_text(fabric.source);
  const FieldName* field = find_field(name);
  if (field == nullptr || is_fast(field->slot)) return std::nullopt;
  const SlotInfo& info = info_of(field->slot);
  const std::size_t d = field->direction == 1 ? 1 : 0;
  double value = get(fabric, field->slot, d);
  if (field->direction == 2) value = (value + get(fabric, field->slot, 1)) / 2;
  return number_value(value, info.dimension, info.percent);
}

std::vector<std::string> fabric_field_names() {
  std::vector<std::string> names;
  for (const FieldName& field : kFields) names.emplace_back(field.name);
  names.insert(names.end(), {"kind", "source", "color", "pattern", "repeat"});
  return names;
}

std::shared_ptr<const design::Fabric> fabric_from_record(Program& program, const design::Fabric* base,
                                                         const Expr& record, Scope& scope) {
  auto fabric = std::make_shared<design::Fabric>(base != nullptr ? *base : design::Fabric{});
  if (base == nullptr) fabric->kind = "stated";
  Given given;
  apply_record(program, *fabric, given, record, scope);
  return fabric;
}

Value eval_with(Program& program, const Expr& expr, Scope& scope) {
  const Value base = eval(program, expr.children[0], scope);
  const Expr& changes = expr.children[1];
  if (const auto* fabric = base.as<FabricValue>())
    return Value{FabricValue{fabric_from_record(program, fabric->fabric.get(), changes, scope)}};
  const auto* record = base.as<RecordValue>();
  if (record == nullptr)
    fail(program,
         Message("G0306", kind_of(base) + " where `with` takes a fabric or a record", expr.children[0].span));
  RecordFields fields = **record;
  const Value given = eval(program, changes, scope);
  for (const auto& [name, value] : **given.as<RecordValue>()) {
    Value* known = nullptr;
    for (auto& field : fields)
      if (field.first == name) known = &field.second;
    if (known != nullptr)
      *known = value;
    else
      fields.emplace_back(name, value);
  }
  return record_value(program, std::move(fields), expr.span);
}

namespace {

/// Assignments and clauses: each field on top of what is there.
void change_field(Program& program, design::Fabric& fabric, Given& all, const std::string& name,
                  Span name_span, const Expr& expr, Scope& scope) {
  Given one;
  take_field(program, fabric, one, name, name_span, eval(program, expr, scope), expr.span);
  apply_given(program, fabric, one);
  for (std::size_t slot = 0; slot < kSlotCount; ++slot)
    for (std::size_t d = 0; d < 2; ++d)
      if (one.value[slot][d]) all.value[slot][d] = one.value[slot][d], all.span[slot][d] = one.span[slot][d];
}

}  // namespace

Value evaluate_fabric(Program& program, Declaration& declaration) {
  const Statement& statement = *declaration.statement;
  Scope& scope = *declaration.scope;
  Clauses clauses(program, statement, scope);
  const Expr& expr = clauses.value(clauses.need("="));
  auto fabric = std::make_shared<design::Fabric>();
  Given given;
  const bool whole = expr.kind == ExprKind::record;
  if (whole) {
    fabric->kind = "stated";
    apply_record(program, *fabric, given, expr, scope);
  } else {
    const Value value = eval(program, expr, scope);
    const auto* known = value.as<FabricValue>();
    if (known == nullptr)
      fail(program, Message("G0306", kind_of(value) + " where `fabric` takes a fabric", expr.span)
                        .help("write `fabrics.denim`, a record `{ W = 200 g/m^2, ... }`, `X with { ... }` or "
                              "`csv(\"FILE\", row: "
                              "\"NAME\")`"));
    *fabric = *known->fabric;
  }
  for (const char* word : {"pattern", "repeat"})
    if (const BoundClause* clause = clauses.find(word))
      change_field(program, *fabric, given, word, clause->clause->word.span, clauses.value(*clause),
                   *clause->scope);
  clauses.finish();
  for (Override& change : declaration.overrides) {
    if (change.path.size() != 1) continue;
    change.used = true;
    change_field(program, *fabric, given, change.path[0], change.span, *change.value, *change.scope);
  }
  if (!program.in_library(statement.span)) {
    const Span name = statement.name ? statement.name->span : statement.keyword.span;
    if (whole) warn_defaults(program, given, declaration.name, name);
    if (whole || !declaration.overrides.empty()) warn_implausible(program, *fabric, given, declaration.name);
    if (!fabric->pattern.empty())
      report(program, Message("G0460",
                              "the picture on fabric `" + declaration.name +
                                  "` is declared, but is not drawn yet: pictures and meshes show its colour",
                              name)
                          .warning()
                          .help("nothing else depends on it"));
  }
  fabric->name = declaration.name;
  fabric->origin = program.origin(statement.span);
  return Value{FabricValue{fabric}};
}

int fabric_index(Program& program, const std::shared_ptr<const design::Fabric>& fabric) {
  const auto [found, inserted] =
      program.fabric_index.emplace(fabric, static_cast<int>(program.garment.fabrics.size()));
  if (inserted) program.garment.fabrics.push_back(*fabric);
  return found->second;
}

}  // namespace garment::interpreter
