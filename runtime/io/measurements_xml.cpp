#include "runtime/io/measurements_xml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <pugixml.hpp>

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
    if (!read_unit(root, multisize)) return std::move(result_);
    if (!multisize && (options_.size || options_.height)) {
      fail("G0720", root.offset_debug(), "an individual file has no sizes", "leave `size` and `height` out");
      return std::move(result_);
    }
    if (collect(root)) multisize ? grade(root) : compute();
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

  bool read_unit(const pugi::xml_node& root, bool multisize) {
    const std::string unit = root.child("unit").text().as_string();
    unit_ = unit == "cm" ? 0.01 : unit == "mm" ? 0.001 : unit == "inch" ? 0.0254 : 0;
    const pugi::xml_node place = root.child("unit") ? root.child("unit") : root;
    if (unit_ == 0)
      fail("G0720", place.offset_debug(),
           fmt::format("the unit is `{}`; it must be cm, mm or inch", unit.substr(0, 40)),
           "state it, as in <unit>cm</unit>");
    else if (multisize && unit == "inch")
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

  void grade(const pugi::xml_node& root) {
    const auto base_size = number(root.child("size"), "base"),
               base_height = number(root.child("height"), "base");
    if (!base_size || !base_height) return;
    const double sizes = options_.size ? (*options_.size - unit_ * *base_size) / kSizeStep : 0;
    const double heights = options_.height ? (*options_.height - unit_ * *base_height) / kHeightStep : 0;
    for (Entry& e : entries_) {
      if (e.node.child("sizeRules").child("break") || e.node.child("heightRules").child("break")) {
        fail("G0720", e.node.offset_debug(),
             fmt::format("`{}` is graded in breaks, which are not read", e.name),
             "grade it with one size_increase and one height_increase");
        return;
      }
      const auto base = number(e.node, "base"), size = number(e.node, "size_increase"),
                 height = number(e.node, "height_increase");
      if (!base || !size || !height) return;
      e.value = *base + sizes * *size + heights * *height;
      if (!std::isfinite(e.value)) {
        fail("G0721", e.node.offset_debug(), fmt::format("`{}` has no finite value", e.name),
             "state a number of its size");
        return;
      }
    }
    finish();
  }

  void finish() {
    result_.measurements.emplace();
    for (const Entry& e : entries_) {
      const bool angle = e.name.ends_with("_angle");
      result_.measurements->push_back({e.name, e.value * (angle ? portable::kPi / 180 : unit_), angle});
    }
  }

  static constexpr int kMaxNesting = 60;

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
