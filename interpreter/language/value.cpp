#include "interpreter/language/value.hpp"

#include "runtime/base/number.hpp"

namespace garment::interpreter {

Value::Value(const Value&) = default;
Value::Value(Value&&) noexcept = default;
Value& Value::operator=(const Value&) = default;
Value& Value::operator=(Value&&) noexcept = default;
Value::~Value() = default;
namespace {

constexpr std::size_t kShownText = 200;

struct KindNamer {
  std::string operator()(std::monostate) const { return "nothing"; }
  std::string operator()(const Quantity& q) const { return describe(q.dimension); }
  std::string operator()(bool) const { return "a truth value"; }
  std::string operator()(const TextValue&) const { return "text"; }
  std::string operator()(const PointValue& p) const {
    return p.size == 2 ? "a point in the plane" : "a point in space";
  }
  std::string operator()(const ListValue&) const { return "a list"; }
  std::string operator()(const RangeValue&) const { return "a range"; }
  std::string operator()(const CurveValue&) const { return "a curve"; }
  std::string operator()(const RecordValue&) const { return "a record"; }
  std::string operator()(const FunctionValue&) const { return "a function"; }
  std::string operator()(const BuiltinValue&) const { return "a builtin function"; }
  std::string operator()(const ModuleValue&) const { return "a library"; }
  std::string operator()(const FabricValue&) const { return "a fabric"; }
  std::string operator()(const ShapeValue&) const { return "a body shape"; }
  std::string operator()(const BodyValue&) const { return "a body"; }
  std::string operator()(const BodyPlaceValue&) const { return "a level or part of a body"; }
  std::string operator()(const PanelValue&) const { return "a panel"; }
  std::string operator()(const HalfValue&) const { return "half a panel"; }
  std::string operator()(const EdgeValue& e) const {
    return e.spans.size() > 1 ? "a chain of edges" : "an edge";
  }
  std::string operator()(const DartValue&) const { return "a dart"; }
  std::string operator()(const NotchValue&) const { return "a notch"; }
  std::string operator()(const SeamValue&) const { return "a seam"; }
  std::string operator()(const PinValue&) const { return "a pin"; }
  std::string operator()(const ThingValue& t) const { return "a " + std::string(t.keyword); }
  std::string operator()(const AllValue&) const { return "`all`"; }
  std::string operator()(const DrapedValue&) const { return "`draped`"; }
};

std::string show_point(const PointValue& p) {
  std::string text = "(";
  for (int k = 0; k < p.size; ++k) text += (k > 0 ? ", " : "") + format_quantity(p.at[k], p.dimension);
  return text + ")";
}

/// At most kShownText bytes, never cut inside a character.
std::string shortened(const std::string& text) {
  if (text.size() <= kShownText) return text;
  std::size_t end = kShownText;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return text.substr(0, end) + "...";
}

void show_into(const Value& value, std::string& out, int depth) {
  if (out.size() > kShownText || depth > 4) {
    out += "...";
    return;
  }
  if (const auto* q = value.as<Quantity>()) {
    out += format_quantity(q->value, q->dimension, q->percent);
  } else if (const auto* b = value.as<bool>()) {
    out += *b ? "true" : "false";
  } else if (const auto* s = value.as<std::string>()) {
    out += shortened(*s);
  } else if (const auto* p = value.as<PointValue>()) {
    out += show_point(*p);
  } else if (const auto* r = value.as<RangeValue>()) {
    out += format_quantity(r->from.value, r->from.dimension, r->from.percent) + " .. " +
           format_quantity(r->to.value, r->to.dimension, r->to.percent);
  } else if (const auto* list = value.as<ListValue>()) {
    out += '[';
    for (std::size_t k = 0; k < (*list)->size() && out.size() <= kShownText; ++k) {
      if (k > 0) out += ", ";
      show_into((**list)[k], out, depth + 1);
    }
    out += ']';
  } else if (const auto* record = value.as<RecordValue>()) {
    out += '{';
    for (std::size_t k = 0; k < (*record)->size() && out.size() <= kShownText; ++k) {
      out += (k > 0 ? ", " : "") + (**record)[k].first + " = ";
      show_into((**record)[k].second, out, depth + 1);
    }
    out += '}';
  } else if (const auto* edge = value.as<EdgeValue>()) {
    for (std::size_t k = 0; k < edge->spans.size() && out.size() <= kShownText; ++k) {
      if (edge->spans[k].backwards)
        out += k > 0 ? " - " : "-";
      else if (k > 0)
        out += " + ";
      out += edge->spans[k].name;
    }
  } else if (const auto* fabric = value.as<FabricValue>()) {
    out += "fabric " + fabric->fabric->name;
  } else {
    out += kind_of(value);
  }
}

}  // namespace

std::string kind_of(const Value& value) { return std::visit(KindNamer{}, value.data); }

std::string show(const Value& value) {
  std::string out;
  show_into(value, out, 0);
  return out;
}

bool same_value(const Value& a, const Value& b) {
  if (const auto* p = a.as<Quantity>(), *q = b.as<Quantity>(); p && q)
    return p->value == q->value && (p->dimension == q->dimension || p->value == 0);
  if (const auto* p = a.as<bool>(), *q = b.as<bool>(); p && q) return *p == *q;
  if (const auto* p = a.as<std::string>(), *q = b.as<std::string>(); p && q) return *p == *q;
  if (const auto* p = a.as<PointValue>(), *q = b.as<PointValue>(); p && q)
    return p->size == q->size && p->dimension == q->dimension && p->at == q->at;
  if (const auto* p = a.as<FabricValue>(), *q = b.as<FabricValue>(); p && q) return p->fabric == q->fabric;
  if (const auto* p = a.as<ListValue>(), *q = b.as<ListValue>(); p && q) {
    if ((*p)->size() != (*q)->size()) return false;
    for (std::size_t k = 0; k < (*p)->size(); ++k)
      if (!same_value((**p)[k], (**q)[k])) return false;
    return true;
  }
  return false;
}

}  // namespace garment::interpreter
