#include "runtime/io/pattern_curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runtime/base/number.hpp"
#include "runtime/io/pattern_document.hpp"

namespace garment::io {
namespace {

using geometry::Arc;
using geometry::Cubic;
using geometry::Curve;
using geometry::Line;
using geometry::Point2;
using geometry::Quadratic;
using nlohmann::json;
using Shape = std::optional<Curve::Shape>;

constexpr double kMaxRelative = 1000;  ///< of a control point, in lengths of its edge

struct CurveReader {
  Point2 start, end;
  const PatternUnits& units;
  const PatternLimits& limits;
  const std::string& where;
  PatternReport& report;

  void refuse(const json& found) const {
    report.error(
        "G0948",
        fmt::format("{}: its curvature is {}, expected `quadratic` with one pair, `cubic` with two, `circle` "
                    "with [radius, large_arc, right], or a plain pair",
                    where, describe(found)),
        "the numbers must be finite; control points lie within 1000 lengths of the edge");
  }

  std::optional<Point2> control(const json& pair) const {
    double limit = units.relative_curves ? kMaxRelative : limits.max_coordinate * units.per_metre;
    auto a = number_at(pair, 0, limit), b = number_at(pair, 1, limit);
    if (!a || !b || pair.size() != 2) return std::nullopt;
    if (!units.relative_curves) return Point2(*a, *b) / units.per_metre;
    Point2 d = end - start, q(-d.y(), d.x());
    Point2 point = start + *a * d + *b * q;
    if (point.cwiseAbs().maxCoeff() > limits.max_coordinate) return std::nullopt;
    return point;
  }

  Shape quadratic(const json& pair, const json& found) const {
    if (auto c = control(pair)) return Curve::Shape(Quadratic{*c});
    refuse(found);
    return std::nullopt;
  }

  Shape cubic(const json& pairs, const json& found) const {
    auto c1 = control(pairs[0]), c2 = control(pairs[1]);
    if (c1 && c2) return Curve::Shape(Cubic{*c1, *c2});
    refuse(found);
    return std::nullopt;
  }

  Shape circle(const json& params, const json& found) const {
    auto radius = number_at(params, 0, 1e9 * units.per_metre);
    auto large = flag(params[1]), right = flag(params[2]);
    if (!radius || *radius <= 0 || !large || !right) {
      refuse(found);
      return std::nullopt;
    }
    double r = *radius / units.per_metre, half = (end - start).norm() / 2;
    // Writers print the radius in a few digits: a half circle may come out a little too small for its chord.
    if (r < half * 0.99) {
      report.error("G0948",
                   fmt::format("{}: a circle of radius {} cm cannot join two points {} cm apart", where,
                               format_number(r * 100, 6), format_number(half * 200, 6)),
                   "the radius must be at least half of that distance");
      return std::nullopt;
    }
    r = std::max(r, half);
    double rise = std::sqrt((r - half) * (r + half));  // from the chord to the centre
    // A small sagitta as the difference of two large numbers would lose its digits: r - rise = half^2 / (r +
    // rise).
    double sagitta = *large ? r + rise : half * half / (r + rise);
    if (sagitta > limits.max_coordinate) {
      refuse(found);
      return std::nullopt;
    }
    if (sagitta < 1e-9) return Curve::Shape(Line{});
    return Curve::Shape(
        Arc{*right ? -sagitta : sagitta});  // counter-clockwise bulges to the right of the chord
  }

  /// 0, 1, false, true, and 0.0 and 1.0 as some writers put them.
  static std::optional<bool> flag(const json& value) {
    if (value.is_boolean()) return value.get<bool>();
    if (!value.is_number()) return std::nullopt;
    double number = value.get<double>();
    if (number == 0) return false;
    if (number == 1) return true;
    return std::nullopt;
  }
};

}  // namespace

Shape read_pattern_curve(const json* curvature, const Point2& start, const Point2& end,
                         const PatternUnits& units, const PatternLimits& limits, const std::string& where,
                         PatternReport& report) {
  if (!curvature || curvature->is_null()) return Curve::Shape(Line{});
  CurveReader reader{start, end, units, limits, where, report};
  const json& c = *curvature;
  if (c.is_array() && c.size() == 2) return reader.quadratic(c, c);
  const json* type = member(c, "type");
  const json* params = member(c, "params");
  if (type && type->is_string() && params && params->is_array()) {
    const std::string& kind = type->get_ref<const std::string&>();
    if (kind == "quadratic" && params->size() == 1) return reader.quadratic((*params)[0], c);
    if (kind == "cubic" && params->size() == 2) return reader.cubic(*params, c);
    if (kind == "circle" && params->size() == 3) return reader.circle(*params, c);
    reader.refuse(*type);
    return std::nullopt;
  }
  reader.refuse(c);
  return std::nullopt;
}

}  // namespace garment::io
