#include "runtime/io/pattern_document.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>

namespace garment::io {
namespace {

using nlohmann::json;

struct LineColumn {
  std::size_t line = 1, column = 1;
};

LineColumn place_of(std::string_view text, std::size_t offset) {
  LineColumn at;
  for (std::size_t i = 0; i < offset && i < text.size(); ++i) {
    if (text[i] == '\n') {
      ++at.line;
      at.column = 1;
    } else if ((static_cast<unsigned char>(text[i]) & 0xC0) != 0x80) {
      ++at.column;
    }
  }
  return at;
}

/// Offset of the bracket that goes deeper than `max_depth`; nothing if none does. Strings are skipped.
std::optional<std::size_t> too_deep_at(std::string_view text, int max_depth) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '[' || c == '{') {
      if (++depth > max_depth) return i;
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
  return std::nullopt;
}

/// Walks the text once more for what the value does not keep: keys that stand twice in one object (the later
/// would silently win), and the order of the panels. Not the parser's own callback: that scans the parent
/// after every object, which takes minutes on a list of a million.
class KeyWatch final : public nlohmann::json_sax<json> {
 public:
  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool start_object(std::size_t) override {
    objects_.push_back({});
    return true;
  }
  bool end_object() override {
    objects_.pop_back();
    return true;
  }
  bool start_array(std::size_t) override {
    ++arrays_;
    return true;
  }
  bool end_array() override {
    --arrays_;
    return true;
  }
  bool key(string_t& key) override {
    Object& object = objects_.back();
    object.current = key;
    if (!object.keys.insert(key).second && !doubled) doubled = key;
    if (objects_.size() == 3 && arrays_ == 0 && objects_[0].current == "pattern" &&
        objects_[1].current == "panels")
      panel_order.push_back(key);
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override {
    return false;
  }

  std::optional<std::string> doubled;
  std::vector<std::string> panel_order;

 private:
  struct Object {
    std::set<std::string> keys;
    std::string current;
  };

  std::vector<Object> objects_;
  int arrays_ = 0;
};

/// The reason in the parser's words, without its own prefix and place.
std::string reason_of(const json::exception& e) {
  std::string_view what = e.what();
  if (auto at = what.find("] "); at != std::string_view::npos) what.remove_prefix(at + 2);
  if (what.starts_with("parse error at line"))
    if (auto at = what.find(": "); at != std::string_view::npos) what.remove_prefix(at + 2);
  std::string reason;
  for (char c : what.substr(0, 200)) reason += static_cast<unsigned char>(c) < 0x20 ? '?' : c;
  return reason;
}

}  // namespace

std::optional<PatternDocument> parse_pattern_document(std::string_view text, const PatternLimits& limits,
                                                      PatternReport& report) {
  if (text.size() > limits.max_bytes) {
    report.error("G0941",
                 fmt::format("the pattern has {} bytes, at most {} are read", text.size(), limits.max_bytes),
                 "a sewing pattern is text of some hundred kilobytes; is this the right file?");
    return std::nullopt;
  }
  if (auto at = too_deep_at(text, limits.max_depth)) {
    LineColumn place = place_of(text, *at);
    report.error("G0941",
                 fmt::format("lists and objects are nested more than {} deep at line {}, column {}",
                             limits.max_depth, place.line, place.column),
                 "a sewing pattern is nested about 8 deep; is this the right file?");
    return std::nullopt;
  }
  PatternDocument document;
  KeyWatch watch;
  try {
    document.root = json::parse(text.begin(), text.end());
    json::sax_parse(text.begin(), text.end(), &watch);
  } catch (const json::parse_error& e) {
    LineColumn place = place_of(text, e.byte > 0 ? e.byte - 1 : 0);
    report.error("G0940",
                 fmt::format("not JSON at line {}, column {}: {}", place.line, place.column, reason_of(e)),
                 "JSON knows no NaN, no Infinity, no comments and no comma after the last item");
    return std::nullopt;
  } catch (const json::exception& e) {  // a number that no double can hold
    report.error("G0940", fmt::format("not JSON that can be read: {}", reason_of(e)),
                 "numbers must fit a double: at most about 1.8e308");
    return std::nullopt;
  }
  if (watch.doubled) {
    report.error("G0942", fmt::format("the key {} stands twice in one object", in_ticks(*watch.doubled)),
                 "rename one of them: a reader would silently drop the first");
    return std::nullopt;
  }
  document.panel_order = std::move(watch.panel_order);
  return document;
}

const json* member(const json& object, const char* key) {
  if (!object.is_object()) return nullptr;
  auto it = object.find(key);
  return it == object.end() ? nullptr : &*it;
}

std::string describe(const json& value) {
  switch (value.type()) {
    case json::value_t::null:
      return "null";
    case json::value_t::boolean:
      return value.get<bool>() ? "true" : "false";
    case json::value_t::string:
      return "the text " + in_ticks(value.get_ref<const std::string&>());
    case json::value_t::array:
      return fmt::format("a list of {}", value.size());
    case json::value_t::object:
      return "an object";
    default:
      return value.is_number() ? value.dump() : "something else";
  }
}

std::optional<double> number_at(const json& list, std::size_t i, double limit) {
  if (!list.is_array() || i >= list.size() || !list[i].is_number()) return std::nullopt;
  double value = list[i].get<double>();
  if (!std::isfinite(value) || std::abs(value) > limit) return std::nullopt;
  return value;
}

std::optional<int> index_below(const json& value, std::size_t end) {
  if (!value.is_number_integer()) return std::nullopt;
  if (value.is_number_unsigned()) {
    auto index = value.get<std::uint64_t>();
    if (index < end) return static_cast<int>(index);
    return std::nullopt;
  }
  auto index = value.get<std::int64_t>();
  if (index >= 0 && static_cast<std::uint64_t>(index) < end) return static_cast<int>(index);
  return std::nullopt;
}

}  // namespace garment::io
