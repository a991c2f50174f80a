// Specifications written again: from the file at once, and by way of the script text.
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <set>

#include "interpreter/language/interpret.hpp"
#include "interpreter/language/unparse.hpp"
#include "interpreter/language/unparse_text.hpp"
#include "runtime/io/pattern_extension.hpp"
#include "runtime/io/pattern_layout.hpp"
#include "runtime/io/pattern_writer.hpp"
#include "tests/unit/io/pattern_support.hpp"

using namespace garment;
using nlohmann::json;

namespace {

constexpr double kTolerance = 1e-6;  // cm

io::PatternOptions options() {
  io::PatternOptions o;
  o.fabric = io::import_fabric();
  return o;
}

design::Garment evaluate(const std::string& script) {
  grammar::Sources sources;
  interpreter::InterpretOptions o;
  o.stdlib_dir = GARMENT_STDLIB_DIR;
  interpreter::Interpretation result =
      interpreter::interpret(sources, sources.add("x", script), system_host(), o);
  std::string told;
  for (const auto& d : result.diagnostics)
    if (d.severity == Severity::error &&
        d.code != "G0510")  // random seams may twist: `export` only warns of that
      told += grammar::render(d, sources, false);
  INFO(told);
  REQUIRE(told.empty());
  return result.garment;
}

/// Where the two documents differ first, or nothing.
std::string difference(const json& a, const json& b) {
  if (io::same_numbers(a, b, kTolerance)) return {};
  if (a.is_object() && b.is_object()) {
    for (const auto& [key, value] : a.items())
      if (!b.contains(key) || !io::same_numbers(value, b[key], kTolerance))
        return key + "/" + (b.contains(key) ? difference(value, b[key]) : "missing");
    for (const auto& [key, value] : b.items())
      if (!a.contains(key)) return key + "/ came from nowhere: " + value.dump().substr(0, 100);
  }
  if (a.is_array() && b.is_array() && a.size() == b.size())
    for (std::size_t i = 0; i < a.size(); ++i)
      if (!io::same_numbers(a[i], b[i], kTolerance)) return std::to_string(i) + "/" + difference(a[i], b[i]);
  return a.dump().substr(0, 200) + " against " + b.dump().substr(0, 200);
}

void check_both_routes(const std::string& text) {
  const json before = json::parse(text);
  io::PatternResult read = io::read_pattern(text, options());
  INFO(pattern_test::all_messages(read.findings));
  REQUIRE(read.garment);
  REQUIRE(read.layout);
  const json at_once = json::parse(io::write_pattern_json(*read.garment, read.layout.get()).text);
  CHECK(difference(before, at_once) == "");

  interpreter::UnparseOptions print;
  print.title = "x";
  const auto names = interpreter::text::make_names(*read.garment);
  for (std::size_t p = 0; p < names.panels.size(); ++p)
    REQUIRE(names.panels[p] == read.garment->panels[p].name);
  for (const std::string& line : io::layout_lines(*read.layout, *read.garment))
    print.trailer.push_back(std::string(io::kLayoutMark) + line);
  const std::string script = interpreter::unparse(*read.garment, print);
  bool found = false;
  const io::PatternLayout layout = io::layout_of_script(script, found);
  REQUIRE(found);
  const json by_script = json::parse(io::write_pattern_json(evaluate(script), &layout).text);
  CHECK(difference(before, by_script) == "");
}

/// Specifications with everything that is seen in the wild, and more.
class Wild {
 public:
  explicit Wild(unsigned seed) : random_(seed) {}

  json make() {
    const bool pairs = chance(0.3), absolute = !pairs && chance(0.15);
    unit_ = chance(0.7) ? 100 : chance(0.5) ? 300 : 1;
    json root;
    json& pattern = root["pattern"];
    const int n = 1 + pick(3);
    for (int p = 0; p < n; ++p) pattern["panels"][name(p)] = panel(pairs, absolute);
    if (chance(0.8)) {
      pattern["panel_order"] = json::array();
      for (int p = n - 1; p >= 0; --p) pattern["panel_order"].push_back(name(p));
    }
    if (chance(0.9)) pattern["stitches"] = stitches(pattern["panels"], n);
    root["properties"] = {{"units_in_meter", unit_},
                          {"curvature_coords", absolute ? "absolute" : "relative"}};
    if (chance(0.5))
      root["parameters"] = {
          {"length",
           {{"value", 1.25}, {"influence", json::array({{{"panel", "p0"}, {"edge_list", {0, 1}}}})}}}};
    if (chance(0.3)) root["parameter_order"] = {"length"};
    if (chance(0.3)) root["constraints"] = json::object();
    if (chance(0.3)) root["note \u00e9"] = "kept {as} \"it\" is";
    return root;
  }

 private:
  double real(double low, double high) { return std::uniform_real_distribution<>(low, high)(random_); }
  int pick(int n) { return std::uniform_int_distribution<>(0, n - 1)(random_); }
  bool chance(double p) { return real(0, 1) < p; }
  static std::string name(int p) { return p == 1 ? "Panel 1" : "p" + std::to_string(p); }

  json curve(bool pairs, bool absolute, double ax, double ay, double bx, double by) {
    const double length = std::hypot(bx - ax, by - ay);
    auto control = [&](double t) -> json {
      const double along = t + real(-0.05, 0.05), side = real(-0.08, 0.08);
      if (!absolute) return {along, side};
      return {ax + along * (bx - ax) - side * (by - ay), ay + along * (by - ay) + side * (bx - ax)};
    };
    if (pairs) return control(0.5);
    switch (pick(4)) {
      case 0:
        return {{"type", "quadratic"}, {"params", json::array({control(0.5)})}};
      case 1:
        return {{"type", "cubic"}, {"params", json::array({control(0.33), control(0.66)})}};
      case 2:
        return {{"type", "circle"},
                {"params", {length * real(2, 300), chance(0.5) ? json(0) : json(false), pick(2)}}};
      default:
        return nullptr;
    }
  }

  /// A star-shaped loop of either sense with a cut in the order and numbers of its edges.
  json panel(bool pairs, bool absolute) {
    const int n = 3 + pick(6);
    std::vector<std::array<double, 2>> points;
    const double radius = 0.3 * unit_, sense = chance(0.5) ? 1 : -1, x = real(-1, 1) * radius,
                 y = real(-1, 1) * radius;
    for (int i = 0; i < n; ++i) {
      const double angle = sense * 2 * 3.14159265358979 * i / n, r = radius * real(0.8, 1.2);
      points.push_back({x + r * std::cos(angle), y + r * std::sin(angle)});
    }
    std::vector<int> number(n);  // of each corner
    for (int i = 0; i < n; ++i) number[i] = i;
    const bool shuffled = chance(0.3);
    if (shuffled) std::shuffle(number.begin(), number.end(), random_);
    json out;
    out["vertices"] = json::array();
    for (int i = 0; i < n; ++i) out["vertices"].push_back(nullptr);
    for (int i = 0; i < n; ++i) out["vertices"][number[i]] = {points[i][0], points[i][1]};
    if (chance(0.2)) out["vertices"].push_back({12.5, -3.25});  // nobody's
    std::vector<json> edges;
    for (int i = 0; i < n; ++i) {
      int a = i, b = (i + 1) % n;
      if (chance(0.15)) std::swap(a, b);  // drawn backwards
      json edge{{"endpoints", {number[a], number[b]}}};
      if (chance(0.5))
        edge["curvature"] = curve(pairs, absolute, points[a][0], points[a][1], points[b][0], points[b][1]);
      if (chance(0.2)) edge["label"] = "left_collar";
      if (chance(0.1)) edge["stray"] = {1, "two"};
      edges.push_back(edge);
    }
    if (chance(0.15)) {  // one corner twice, with an edge of no length between
      const int v = number[1];
      out["vertices"].push_back({points[1][0] + (chance(0.5) ? 1e-7 : 6e-5) * unit_, points[1][1]});
      const int twin = static_cast<int>(out["vertices"].size()) - 1;
      if (edges[1]["endpoints"][0] == v) {
        edges[1]["endpoints"][0] = twin;
        edges.push_back({{"endpoints", {v, twin}}});
      }
    }
    if (chance(0.2)) std::shuffle(edges.begin(), edges.end(), random_);
    out["edges"] = edges;
    if (!chance(0.05)) out["translation"] = {real(-100, 100), real(-100, 100), real(-100, 100)};
    const double turn[] = {0, 90, 180, -180, 270, real(-180, 180)};
    if (!chance(0.05))
      out["rotation"] = chance(0.5) ? json{0, 0, 0} : json{turn[pick(6)], turn[pick(6)], turn[pick(6)]};
    if (chance(0.2)) out["label"] = "body";
    if (chance(0.2)) out["label2"] = nullptr;
    return out;
  }

  json stitches(const json& panels, int n) {
    json out = json::array();
    std::set<std::pair<int, int>> used;
    auto side = [&]() -> json {
      for (int tries = 0; tries < 20; ++tries) {
        const int p = pick(n), e = pick(static_cast<int>(panels[name(p)]["edges"].size()));
        if (used.insert({p, e}).second) return {{"panel", name(p)}, {"edge", e}};
      }
      return nullptr;
    };
    for (int k = pick(4); k > 0; --k) {
      json a = side(), b = side();
      if (a.is_null() || b.is_null()) break;
      if (chance(0.1)) a["stray"] = 1;
      if (chance(0.1)) b = a;  // an edge sewn to itself: nothing to sew, but it stands in the file
      out.push_back(chance(0.25) ? json::array({a, b, "right_wrong"}) : json::array({a, b}));
    }
    return out;
  }

  std::mt19937 random_;
  double unit_ = 100;
};

}  // namespace

TEST_CASE("wild specifications come back by both routes") {
  for (unsigned seed = 1; seed <= 300; ++seed) {
    INFO("seed " << seed);
    const json root = Wild(seed).make();
    INFO(root.dump());
    check_both_routes(root.dump());
  }
}

TEST_CASE("the reference specifications come back by both routes") {
  const std::vector<std::string> files = pattern_test::data_files();
  if (files.empty()) {
    WARN("skipped: no pattern files below " GARMENT_DATA_DIR);
    return;
  }
  CHECK(files.size() == 27);
  for (const std::string& file : files) {
    INFO(file);
    check_both_routes(pattern_test::read_text(file));
  }
}

TEST_CASE("a garment that is edited is written as it is, not as it was") {
  const json root = json::parse(pattern_test::fixture("clockwise_skirt.json"));
  io::PatternResult read = io::read_pattern(root.dump(), options());
  REQUIRE(read.garment);
  design::Garment moved = *read.garment;
  moved.panels[0].placement.translation.x() += 0.01;
  const json after = json::parse(io::write_pattern_json(moved, read.layout.get()).text);
  const std::string key = read.layout->panels[0].key;
  const double scale = root["properties"]["units_in_meter"].get<double>();
  CHECK(after["pattern"]["panels"][key]["translation"][0].get<double>() ==
        Approx(root["pattern"]["panels"][key]["translation"][0].get<double>() + 0.01 * scale));
  CHECK(after["pattern"]["panels"][key]["vertices"] == root["pattern"]["panels"][key]["vertices"]);
}

TEST_CASE("what the format lacks goes into a block that is read back") {
  const design::Garment garment = evaluate(R"(garment 1 "skirt"
fabric poplin = { W = 0.12 kg/m^2, B_warp = 3e-6 N*m, B_weft = 3e-6 N*m }
panel front of poplin {
  outline from (0, 0) { edge hem to (30 cm, 0)
    edge side to (25 cm, 60 cm) through (31 cm, 30 cm)
    edge waist to (0, 60 cm)
    close middle }
  grain 45 deg
  notch hip on side at 40 cm
  dart tuck_in on waist at 12 cm width 3 cm depth 9 cm
}
panel back of poplin {
  outline from (0, 0) { edge hem to (30 cm, 0)
    edge side to (25 cm, 60 cm) through (31 cm, 30 cm)
    edge waist to (0, 60 cm)
    close middle }
}
seam side: front.side[start .. 20 cm] to back.side[start .. 20 cm] reversed
hem low on front.hem turn 2 cm to back
)");
  const io::PatternText written = io::write_pattern_json(garment);
  REQUIRE(written.findings.size() == 1);
  CHECK(written.findings[0].code == "G0906");
  CHECK(written.findings[0].message.find("hem low") != std::string::npos);
  const io::PatternResult back = io::read_pattern(written.text, options());
  INFO(pattern_test::all_messages(back.findings));
  REQUIRE(back.garment);
  const design::Garment& again = *back.garment;
  CHECK(again.fabrics[0].name == "poplin");
  CHECK(again.fabrics[0].areal_density == 0.12);
  CHECK(again.panels[0].grain_angle == Approx(garment.panels[0].grain_angle));
  REQUIRE(again.panels[0].notches.size() == 1);
  const io::CutGarment cut = io::cut_garment(garment);
  CHECK(again.panels[0].edges.size() == cut.panels[0].edges.size());
  // The dart is cut away and sewn: half of its mouth times its depth is missing.
  CHECK(io::signed_area(garment.panels[0].edges) - io::signed_area(again.panels[0].edges) ==
        Approx(0.5 * 0.03 * 0.09));
  CHECK(io::signed_area(again.panels[1].edges) == Approx(io::signed_area(garment.panels[1].edges)));
  CHECK(again.seams.size() >= 2);
  double sewn = 0;
  for (std::size_t s = 0; s + 1 < again.seams.size(); ++s) sewn += again.seams[s].sides[0].parts[0].to;
  CHECK(sewn == Approx(0.2));
  // Written again, it is the same pattern.
  const json first = json::parse(written.text),
             second = json::parse(io::write_pattern_json(again, back.layout.get()).text);
  CHECK(difference(first["pattern"], second["pattern"]) == "");
}

TEST_CASE("a damaged block is passed over") {
  json root = json::parse(pattern_test::fixture("clockwise_skirt.json"));
  for (const char* text :
       {"3", R"({"fabrics":4})", R"({"fabrics":[{"name":"a","thickness":"x"}]})", R"({"panels":[]})",
        R"({"seams":{}})", R"({"seams":[3]})", R"({"fabrics":[{"kind":1}]})"}) {
    root["garment"] = json::parse(text);
    const io::PatternResult result = io::read_pattern(root.dump(), options());
    INFO(text);
    CHECK(result.garment);
    CHECK(pattern_test::has_code(result.findings, "G0958"));
  }
}
