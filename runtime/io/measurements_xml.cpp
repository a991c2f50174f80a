#include "runtime/io/measurements_xml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <pugixml.hpp>
#include <tuple>

#include "runtime/base/number.hpp"
#include "runtime/base/portable_math.hpp"
#include "runtime/io/measure_formula.hpp"

namespace garment::io {
namespace {

constexpr double kSizeStep = 0.02, kHeightStep = 0.06;  // m
constexpr std::size_t kMaxMeasurements = 10'000;

class MeasurementsReader {
 public:
  MeasurementsReader(std::string_view text, const MeasurementOptions& options, const std::string& name,
                     OriginId origin)
      : text_(text), options_(options), name_(name), origin_(origin) {}

  MeasurementsResult run() {
    const pugi::xml_parse_result parsed =
        document_.load_buffer(text_.data(), text_.size(), pugi::parse_default, pugi::encoding_utf8);
    if (!parsed) {
      fail("G0720", parsed.offset, fmt::format("no XML: {}", parsed.description()),
           "save it anew in Seamly or Valentina");
      return std::move(result_);
    }
    const pugi::xml_node root = document_.document_element();
    const std::string kind = root.name();
    const bool multisize = kind == "smms" || kind == "vst";
    if (!multisize && kind != "smis" && kind != "vit") {
      fail("G0720", root.offset_debug(), fmt::format("the root is `{}`", kind.substr(0, 40)),
           "measurement files have the root smis, vit (individual), smms or vst (multisize)");
      return std::move(result_);
    }
    const bool dimensions = multisize && root.child("dimensions");
    if (!read_unit(root, multisize && !dimensions)) return std::move(result_);
    if (!multisize && (options_.size || options_.height)) {
      fail("G0720", root.offset_debug(), "an individual file has no sizes", "leave `size` and `height` out");
      return std::move(result_);
    }
    if (collect(root)) dimensions ? shift(root) : multisize ? grade(root) : compute();
    return std::move(result_);
  }

 private:
  struct Entry {
    pugi::xml_node node;
    std::string name;
    enum class State { waiting, running, done } state = State::waiting;
    double value = 0;  ///< in the file's unit
  };

  std::size_t line_of(std::ptrdiff_t offset) const {
    const auto end =
        text_.begin() + std::clamp<std::ptrdiff_t>(offset, 0, static_cast<std::ptrdiff_t>(text_.size()));
    return 1 + static_cast<std::size_t>(std::count(text_.begin(), end, '\n'));
  }

  void fail(const char* code, std::ptrdiff_t offset, const std::string& what, std::string help) {
    result_.findings.push_back({code,
                                Severity::error,
                                fmt::format("`{}` line {}: {}", name_, line_of(offset), what),
                                {{origin_, ""}},
                                std::move(help)});
  }

  bool read_unit(const pugi::xml_node& root, bool centimetres) {
    const std::string unit = root.child("unit").text().as_string();
    unit_ = unit == "cm" ? 0.01 : unit == "mm" ? 0.001 : unit == "inch" ? 0.0254 : 0;
    const pugi::xml_node place = root.child("unit") ? root.child("unit") : root;
    if (unit_ == 0)
      fail("G0720", place.offset_debug(),
           fmt::format("the unit is `{}`; it must be cm, mm or inch", unit.substr(0, 40)),
           "state it, as in <unit>cm</unit>");
    else if (centimetres && unit == "inch")
      fail("G0720", place.offset_debug(), "a multisize file in inches: sizes are graded by centimetres",
           "convert it to cm");
    return result_.findings.empty();
  }

  bool collect(const pugi::xml_node& root) {
    const pugi::xml_node body = root.child("body-measurements");
    if (!body)
      fail("G0720", root.offset_debug(), "there is no <body-measurements>",
           "save it anew in Seamly or Valentina");
    for (const pugi::xml_node& m : body.children("m")) {
      if (std::string_view(m.attribute("type").as_string()) == "separator") continue;  // a headline between measures
      std::string name = m.attribute("name").as_string();
      if (!name.empty() && (name[0] == '@' || name[0] == '#')) name.erase(0, 1);
      if (name.empty() || entries_.size() >= kMaxMeasurements) {
        fail("G0720", m.offset_debug(), name.empty() ? "a measure has no name" : "more than 10,000 measures",
             "name it");
        return false;
      }
      if (!by_name_.emplace(name, entries_.size()).second) {
        fail("G0720", m.offset_debug(), fmt::format("`{}` is stated twice", name), "leave one of the two");
        return false;
      }
      entries_.push_back({m, name});
    }
    return result_.findings.empty();
  }

  /// Value of a measure in the file's unit, by its formula.
  FormulaResult value_of(std::size_t k, int depth) {
    Entry& e = entries_[k];
    if (e.state == Entry::State::done) return {e.value, ""};
    if (e.state == Entry::State::running || depth > kMaxNesting)
      return {std::nullopt, depth > kMaxNesting ? "more than 60 measures that need each other"
                                                : fmt::format("`{}` is made from itself", e.name)};
    e.state = Entry::State::running;
    const FormulaResult made = compute_formula(
        e.node.attribute("value").as_string(), [&](const std::string& other) -> FormulaResult {
          const auto found = by_name_.find(other);
          if (found == by_name_.end())
            return {std::nullopt, fmt::format("`{}` is no measure of this file", other.substr(0, 60))};
          return value_of(found->second, depth + 1);
        });
    e.state = made.value ? Entry::State::done : Entry::State::waiting;
    e.value = made.value.value_or(0);
    return made;
  }

  void compute() {
    for (std::size_t k = 0; k < entries_.size(); ++k) {
      const FormulaResult made = value_of(k, 0);
      if (made.value) continue;
      fail("G0721", entries_[k].node.offset_debug(), fmt::format("`{}`: {}", entries_[k].name, made.error),
           "correct the formula in Seamly or Valentina, or state a number");
      return;
    }
    finish();
  }

  std::optional<double> number(const pugi::xml_node& node, const char* attribute) {
    const auto value = parse_number(node.attribute(attribute).as_string());
    if (!value)
      fail("G0721", node.offset_debug(),
           fmt::format("`{}` of <{}> is `{}`, no number", attribute, node.name(),
                       std::string(node.attribute(attribute).as_string()).substr(0, 40)),
           "state a number with a point");
    return value;
  }

  /// `number` where an attribute may be left out: 0 then.
  std::optional<double> number_or_none(const pugi::xml_node& node, const char* attribute) {
    return node.attribute(attribute) ? number(node, attribute) : std::optional<double>(0);
  }

  /// Increments that change along the sizes or heights: from a threshold on, another one for each step.
  struct Rule {
    double threshold, increment;  ///< in the file's unit
  };

  std::optional<std::vector<Rule>> rules_of(const pugi::xml_node& list) {
    std::vector<Rule> rules;
    for (const pugi::xml_node& node : list.children("break")) {
      const auto threshold = number(node, "threshold"), increment = number(node, "increment");
      if (!threshold || !increment) return std::nullopt;
      rules.push_back({*threshold, *increment});
    }
    std::stable_sort(rules.begin(), rules.end(), [](const Rule& a, const Rule& b) { return a.threshold < b.threshold; });
    return rules;
  }

  /// What `steps` steps of `step` away from `base` add: each counts with the increment that holds where it begins.
  static double graded(double base, double step, double steps, double increment, const std::vector<Rule>& rules) {
    if (rules.empty()) return steps * increment;
    const double sense = steps < 0 ? -1 : 1, whole = std::fabs(steps);
    double sum = 0;
    for (double k = 0; k < whole; ++k) {
      double here = increment;
      for (const Rule& rule : rules)
        if (base + sense * k * step >= rule.threshold - 1e-3) here = rule.increment;
      sum += sense * here * std::min(1.0, whole - k);
    }
    return sum;
  }

  void grade(const pugi::xml_node& root) {
    const auto base_size = number(root.child("size"), "base"),
               base_height = number(root.child("height"), "base");
    if (!base_size || !base_height) return;
    const double sizes = steps_to(options_.size, *base_size, kSizeStep / unit_);
    const double heights = steps_to(options_.height, *base_height, kHeightStep / unit_);
    if (std::fabs(sizes) > kMaxSteps || std::fabs(heights) > kMaxSteps) {
      fail("G0720", root.child("size").offset_debug(), "a size or height more than 1000 steps from the base",
           "state it as the file does: half the chest's girth, the stature");
      return;
    }
    for (Entry& e : entries_) {
      const auto base = number(e.node, "base"), size = number(e.node, "size_increase"),
                 height = number(e.node, "height_increase");
      if (!base || !size || !height) return;
      const auto size_rules = rules_of(e.node.child("sizeRules")), height_rules = rules_of(e.node.child("heightRules"));
      if (!size_rules || !height_rules) return;
      e.value = *base + graded(*base_size, kSizeStep / unit_, sizes, *size, *size_rules) +
                graded(*base_height, kHeightStep / unit_, heights, *height, *height_rules);
      if (!check_finite(e)) return;
    }
    finish();
  }

  double steps_to(const std::optional<double>& wanted, double base, double step) const {
    return wanted ? (*wanted / unit_ - base) / step : 0;
  }

  bool check_finite(const Entry& e) {
    if (!std::isfinite(e.value))
      fail("G0721", e.node.offset_debug(), fmt::format("`{}` has no finite value", e.name),
           "state a number of its size");
    return std::isfinite(e.value);
  }

  /// One of the sizes by which a newer Valentina grades: `type` x is the height, y the chest's size, w the hip, z the waist.
  struct Dimension {
    char type;
    double base, step, here;  ///< in the file's unit
  };

  std::optional<std::vector<Dimension>> dimensions_of(const pugi::xml_node& root) {
    std::vector<Dimension> found;
    for (const char* type : {"x", "y", "w", "z"})  // shiftA belongs to the first of them, in this order
      for (const pugi::xml_node& node : root.child("dimensions").children("dimension")) {
        if (std::string_view(node.attribute("type").as_string()) != type) continue;
        const auto base = number(node, "base"), step = number(node, "step");
        if (!base || !step) return std::nullopt;
        const std::optional<double>& wanted = *type == 'x' ? options_.height : *type == 'y' ? options_.size : kNone;
        found.push_back({*type, *base, *step, wanted ? *wanted / unit_ : *base});
      }
    const pugi::xml_node place = root.child("dimensions");
    if (found.empty() || found.size() > 3) {
      fail("G0720", place.offset_debug(), fmt::format("{} dimensions of size, expected 1 to 3", found.size()),
           "save it anew in Valentina");
      return std::nullopt;
    }
    auto graded_by = [&](char type) {
      return std::any_of(found.begin(), found.end(), [&](const Dimension& d) { return d.type == type; });
    };
    for (const auto& [wanted, type, word] : {std::tuple(options_.size, 'y', "size"), std::tuple(options_.height, 'x', "height")})
      if (wanted && !graded_by(type)) {
        fail("G0720", place.offset_debug(), fmt::format("the file is not graded by {}", word),
             fmt::format("leave `{}` out", word));
        return std::nullopt;
      }
    return found;
  }

  /// value = base + shift of each dimension times its steps + the correction of just these sizes
  /// (Valentina, `VMeasurement::CalcValue`).
  void shift(const pugi::xml_node& root) {
    const auto dimensions = dimensions_of(root);
    if (!dimensions) return;
    for (Entry& e : entries_) {
      const auto base = number_or_none(e.node, "base");
      if (!base) return;
      e.value = *base;
      for (std::size_t k = 0; k < dimensions->size(); ++k) {
        const Dimension& d = (*dimensions)[k];
        constexpr const char* kShifts[] = {"shiftA", "shiftB", "shiftC"};
        const auto by = number_or_none(e.node, kShifts[k]);
        if (!by) return;
        if (d.step > 0) e.value += (d.here - d.base) / d.step * *by;
      }
      for (const pugi::xml_node& node : e.node.child("corrections").children("correction")) {
        if (!stands_at(node.attribute("coordinates").as_string(), *dimensions)) continue;
        const auto by = number_or_none(node, "correction");
        if (!by) return;
        e.value += *by;
        break;
      }
      if (!check_finite(e)) return;
    }
    finish();
  }

  /// Are `coordinates`, "176;50", the sizes at hand?
  static bool stands_at(std::string_view coordinates, const std::vector<Dimension>& dimensions) {
    for (std::size_t k = 0; k < dimensions.size(); ++k) {
      const std::size_t end = coordinates.find(';');
      const auto value = parse_number(coordinates.substr(0, end));
      if (!value || std::fabs(*value - dimensions[k].here) > 1e-6 || (end == std::string_view::npos) != (k + 1 == dimensions.size()))
        return false;
      coordinates.remove_prefix(std::min(coordinates.size(), end == std::string_view::npos ? end : end + 1));
    }
    return true;
  }

  void finish() {
    result_.measurements.emplace();
    for (const Entry& e : entries_) {
      const bool angle = e.name.ends_with("_angle") || e.node.attribute("specialUnits").as_bool();
      result_.measurements->push_back({e.name, e.value * (angle ? portable::kPi / 180 : unit_), angle});
    }
  }

  static constexpr int kMaxNesting = 60;
  static constexpr double kMaxSteps = 1000;
  static constexpr std::optional<double> kNone{};

  std::string_view text_;
  const MeasurementOptions& options_;
  const std::string& name_;
  OriginId origin_;
  pugi::xml_document document_;
  double unit_ = 0;  ///< m
  std::vector<Entry> entries_;
  std::map<std::string, std::size_t> by_name_;
  MeasurementsResult result_;
};

}  // namespace

MeasurementsResult read_measurements(std::string_view text, const MeasurementOptions& options,
                                     const std::string& name, OriginId origin) {
  return MeasurementsReader(text, options, name, origin).run();
}

}  // namespace garment::io
