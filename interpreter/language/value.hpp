#pragma once
// What an expression can be: numbers with dimension, text, points, lists, records, functions, and the things
// a garment is made of.
#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "interpreter/language/memory.hpp"
#include "interpreter/language/units.hpp"
#include "runtime/design/garment.hpp"

namespace garment::interpreter {

struct Value;
struct Declaration;
struct FunctionRecord;
struct Module;

struct Quantity {
  double value = 0;  ///< SI
  Dimension dimension;
  bool percent = false;  ///< written as 50%; only for printing and for `within`
};

/// 2 or 3 coordinates of one dimension; `panel` >= 0 where the point is known to lie on that panel.
struct PointValue {
  std::array<double, 3> at{};
  int size = 2;
  Dimension dimension = kLength;
  int panel = -1;
};

struct RangeValue {
  Quantity from, to;
};

/// Text, lists, records and curves are shared by their copies, and their memory is counted while they live: they are
/// made by `text_value`, `ListBuilder`, `record_value` and `curve_value` (collections.hpp, curve_values.hpp).
struct TextBody;
struct ListBody;    ///< is a std::vector<Value>
struct RecordBody;  ///< is a RecordFields
struct CurveBody;
using TextValue = std::shared_ptr<const TextBody>;
using ListValue = std::shared_ptr<const ListBody>;
using RecordFields = std::vector<std::pair<std::string, Value>>;
using RecordValue = std::shared_ptr<const RecordBody>;
/// A drafted curve, metres in the plane; `closed` where it is a ring.
using CurveValue = std::shared_ptr<const CurveBody>;

/// A declared `fn`, a builtin function, a used library file.
struct FunctionValue {
  const Declaration* declaration = nullptr;
};
struct BuiltinValue {
  const FunctionRecord* record = nullptr;
};
struct ModuleValue {
  Module* module = nullptr;
};

struct FabricValue {
  std::shared_ptr<const design::Fabric> fabric;
};
/// A shape not yet declared as a body: what `bodies.woman(...)` or `sphere(...)` gives.
struct ShapeValue {
  decltype(design::Body::shape) shape;
};
struct BodyValue {
  int body = -1;
};
/// A level or a part of a body ("waist", "arm.left"); which of the two is decided where it is used.
struct BodyPlaceValue {
  int body = -1;
  std::string path;
};

struct PanelValue {
  int panel = -1;
};
/// `front.left`: one half of a panel on the fold.
struct HalfValue {
  int panel = -1;
  std::string half;
};
/// A named edge or part of one, in drawn direction.
struct EdgeSpan {
  int panel = -1;
  std::string name;                     ///< "front.left.side"
  std::vector<design::EdgePart> parts;  ///< follow each other along the drawn direction
  bool backwards = false;               ///< a leading `-`: walked against the rule
};
/// One edge or a chain of edges.
struct EdgeValue {
  std::vector<EdgeSpan> spans;
};
struct DartValue {
  int panel = -1;
  std::string name;
};
struct NotchValue {
  int panel = -1;
  std::string name;
};
struct SeamValue {
  int seam = -1;
};
struct PinValue {
  int pin = -1;
};
/// Any other declared thing: a region, a layer, a button, a clamp. `index` is its place in the garment's list of its
/// kind.
struct ThingValue {
  std::string_view keyword;  ///< of its construct
  const Declaration* declaration = nullptr;
  int index = -1;
};
/// The word `all`, and `draped` (whose members ask the drape).
struct AllValue {};
struct DrapedValue {};

/// Copied, moved and destroyed out of line: every file of the room would else compile the visits of all kinds anew.
struct Value {
  using Data = std::variant<std::monostate, Quantity, bool, TextValue, PointValue, ListValue, RangeValue, RecordValue, CurveValue,
                            FunctionValue, BuiltinValue, ModuleValue, FabricValue, ShapeValue, BodyValue, BodyPlaceValue,
                            PanelValue, HalfValue, EdgeValue, DartValue, NotchValue, SeamValue, PinValue, ThingValue,
                            AllValue, DrapedValue>;
  Data data;

  Value() = default;
  template <class Kind>
    requires(!std::is_same_v<std::remove_cvref_t<Kind>, Value> && std::is_constructible_v<Data, Kind>)
  explicit Value(Kind&& kind) : data(std::forward<Kind>(kind)) {}
  Value(const Value&);
  Value(Value&&) noexcept;
  Value& operator=(const Value&);
  Value& operator=(Value&&) noexcept;
  ~Value();

  template <class T>
  const T* as() const {
    return std::get_if<T>(&data);
  }
};

struct TextBody {
  std::string text;
  Charge charge;
};
struct ListBody : std::vector<Value> {
  int depth = 1;  ///< of lists and records within each other
  Charge charge;
};
struct RecordBody : RecordFields {
  int depth = 1;
  Charge charge;
};
struct CurveBody {
  geometry::Curve curve;
  Charge charge;
};

/// Text is asked for as `as<std::string>()`.
template <>
inline const std::string* Value::as<std::string>() const {
  const auto* text = std::get_if<TextValue>(&data);
  return text == nullptr ? nullptr : &(*text)->text;
}

inline Value number_value(double value, Dimension dimension = {}, bool percent = false) {
  return Value{Quantity{value, dimension, percent}};
}

/// A literal 0 needs no unit: it fits every dimension.
inline bool is_plain_zero(const Quantity& q) { return q.value == 0 && q.dimension.none(); }

/// "a length", "a panel", "text": what kind of thing this is; for messages.
std::string kind_of(const Value& value);
/// The value as a person reads it ("58 cm", "[1, 2]", "panel"). At most about 200 characters.
std::string show(const Value& value);
/// Equality as `==` means it; false where the kinds differ.
bool same_value(const Value& a, const Value& b);

}  // namespace garment::interpreter
