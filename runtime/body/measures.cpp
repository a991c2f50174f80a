// Which measures a figure needs, and what they may be.
#include <fmt/format.h>

#include <cmath>

#include "runtime/base/number.hpp"
#include "runtime/body/mannequin.hpp"

namespace garment::body {
namespace {

/// Ranges in fractions of the stature, wide enough for every adult and for odd wishes, narrow enough to catch
/// a wrong unit.
struct Rule {
  const char* name;
  double FigureMeasures::*place;
  double low, high;
};

constexpr Rule kRules[] = {
    {"stature", &FigureMeasures::stature, 0, 0},
    {"bust_chest", &FigureMeasures::bust_chest, 0.35, 1.1},
    {"underbust", &FigureMeasures::underbust, 0.3, 1.0},
    {"waist", &FigureMeasures::waist, 0.25, 1.1},
    {"hip", &FigureMeasures::hip, 0.35, 1.2},
    {"neckcircumference", &FigureMeasures::neckcircumference, 0.12, 0.4},
    {"neckcircumferencebase", &FigureMeasures::neckcircumferencebase, 0.13, 0.45},
    {"headcircumference", &FigureMeasures::headcircumference, 0.25, 0.5},
    {"biacromialbreadth", &FigureMeasures::biacromialbreadth, 0.15, 0.35},
    {"bideltoidbreadth", &FigureMeasures::bideltoidbreadth, 0.18, 0.45},
    {"sleeveoutseam", &FigureMeasures::sleeveoutseam, 0.22, 0.5},
    {"acromionradialelength", &FigureMeasures::acromionradialelength, 0.12, 0.3},
    {"bicepscircumferenceflexed", &FigureMeasures::bicepscircumferenceflexed, 0.09, 0.35},
    {"wristcircumference", &FigureMeasures::wristcircumference, 0.06, 0.16},
    {"thighcircumference", &FigureMeasures::thighcircumference, 0.2, 0.6},
    {"lowerthighcircumference", &FigureMeasures::lowerthighcircumference, 0.14, 0.42},
    {"calfcircumference", &FigureMeasures::calfcircumference, 0.13, 0.4},
    {"anklecircumference", &FigureMeasures::anklecircumference, 0.08, 0.24},
    {"crotchheight", &FigureMeasures::crotchheight, 0.38, 0.56},
    {"trochanterionheight", &FigureMeasures::trochanterionheight, 0.42, 0.6},
    {"waistheightomphalion", &FigureMeasures::waistheightomphalion, 0.52, 0.68},
    {"kneeheightmidpatella", &FigureMeasures::kneeheightmidpatella, 0.2, 0.34},
    {"cervicaleheight", &FigureMeasures::cervicaleheight, 0.78, 0.92},
    {"acromialheight", &FigureMeasures::acromialheight, 0.74, 0.88},
    {"axillaheight", &FigureMeasures::axillaheight, 0.68, 0.82},
    {"chestheight", &FigureMeasures::chestheight, 0.62, 0.8},
    {"chestbreadth", &FigureMeasures::chestbreadth, 0.1, 0.35},
    {"chestdepth", &FigureMeasures::chestdepth, 0.08, 0.35},
    {"waistbreadth", &FigureMeasures::waistbreadth, 0.09, 0.4},
    {"waistdepth", &FigureMeasures::waistdepth, 0.06, 0.35},
    {"hipbreadth", &FigureMeasures::hipbreadth, 0.12, 0.42},
    {"buttockdepth", &FigureMeasures::buttockdepth, 0.07, 0.36},
};

constexpr double kLeastStature = 0.9, kMostStature = 2.4;  // m

/// Heights that must follow each other upwards with at least this much of the stature between them.
struct Order {
  const char *lower, *upper;
  double gap;
};
constexpr Order kOrder[] = {
    {"kneeheightmidpatella", "crotchheight", 0.1},
    {"crotchheight", "trochanterionheight", 0.015},
    {"trochanterionheight", "waistheightomphalion", 0.03},
    {"waistheightomphalion", "chestheight", 0.07},
    {"chestheight", "axillaheight", 0.012},
    {"axillaheight", "acromialheight", 0.025},
    {"acromialheight", "cervicaleheight", 0.008},
};

bool is_optional(const Rule& rule, bool woman) {
  return !woman && std::string_view(rule.name) == "underbust";
}

std::string shown_cm(double metres) { return format_number(100 * metres, 4) + " cm"; }

}  // namespace

MeasuresResult check_measures(const design::Mannequin& mannequin, const std::string& name, OriginId origin) {
  MeasuresResult result;
  auto fail = [&](const char* code, std::string message, std::string help) {
    result.findings.push_back({code, Severity::error, std::move(message), {{origin, ""}}, std::move(help)});
  };
  FigureMeasures m;
  m.woman = mannequin.sex == design::Mannequin::Sex::woman;
  std::string missing;
  for (const Rule& rule : kRules) {
    auto given = mannequin.measures.find(rule.name);
    if (given != mannequin.measures.end()) {
      m.*rule.place = given->second;
    } else if (!is_optional(rule, m.woman)) {
      missing += fmt::format("{}`{}`", missing.empty() ? "" : ", ", rule.name);
    }
  }
  if (!missing.empty()) {
    fail("G0710", fmt::format("body `{}` lacks {}", name, missing),
         "start from a size, `bodies.woman(size: 38)`, and override single measures");
    return result;
  }
  auto check = [&](const char* what, double value, double low, double high) {
    if (value >= low && value <= high) return;
    fail("G0711",
         fmt::format("`{}` of body `{}` is {}; between {} and {} is possible", what, name, shown_cm(value),
                     shown_cm(low), shown_cm(high)),
         "check the unit and the name of the measure");
  };
  check("stature", m.stature, kLeastStature, kMostStature);
  if (!result.findings.empty()) return result;
  for (const Rule& rule : kRules) {
    if (rule.high == 0 || (is_optional(rule, m.woman) && !mannequin.measures.count(rule.name))) continue;
    check(rule.name, m.*rule.place, rule.low * m.stature, rule.high * m.stature);
  }
  if (!result.findings.empty()) return result;
  for (const Order& order : kOrder) {
    double lower = mannequin.measures.at(order.lower), upper = mannequin.measures.at(order.upper);
    if (upper - lower < order.gap * m.stature)
      fail("G0711",
           fmt::format("`{}` of body `{}` is {}, `{}` {}; it must lie at least {} higher", order.upper, name,
                       shown_cm(upper), order.lower, shown_cm(lower), shown_cm(order.gap * m.stature)),
           "check the two heights");
  }
  if (m.woman && m.bust_chest < 1.02 * m.underbust)
    fail("G0711",
         fmt::format("`bust_chest` of body `{}` is {}, `underbust` {}; the bust must be larger", name,
                     shown_cm(m.bust_chest), shown_cm(m.underbust)),
         "raise `bust_chest` or lower `underbust`");
  if (result.findings.empty()) result.measures = m;
  return result;
}

}  // namespace garment::body
