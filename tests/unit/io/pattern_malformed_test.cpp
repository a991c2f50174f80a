#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/unit/io/pattern_support.hpp"

using namespace garment;
using nlohmann::json;
using pattern_test::all_messages;
using pattern_test::fixture;
using pattern_test::has_code;

namespace {

/// One change of a good file ("remove" where `value` is empty) and what must be said of it.
struct Fault {
  const char* pointer;
  const char* value;
  const char* code;
  const char* says;  ///< part of a message
};

const Fault kFaults[] = {
    {"/pattern", "", "G0943", "`pattern.panels` is missing"},
    {"/pattern", "[]", "G0943", "`pattern.panels` is missing"},
    {"/pattern/panels", "", "G0943", "`pattern.panels` is missing"},
    {"/pattern/panels", "7", "G0943", "`pattern.panels` is 7"},
    {"/pattern/panels", "{}", "G0944", "0 panels"},
    {"/pattern/panels/front", "null", "G0943", "panel `front`: `vertices` is missing"},
    {"/pattern/panels/front", "[1]", "G0943", "panel `front`: `vertices` is missing"},
    {"/pattern/panels/front/vertices", "", "G0943", "panel `front`: `vertices` is missing"},
    {"/pattern/panels/front/vertices", "\"many\"", "G0943", "the text `many`"},
    {"/pattern/panels/front/vertices", "[]", "G0944", "`vertices` has 0 items"},
    {"/pattern/panels/front/vertices/1", "[1]", "G0944", "panel `front`: vertex 1"},
    {"/pattern/panels/front/vertices/1", "[1, 2, 3]", "G0944", "panel `front`: vertex 1"},
    {"/pattern/panels/front/vertices/1", "[1, \"2\"]", "G0944", "panel `front`: vertex 1"},
    {"/pattern/panels/front/vertices/1", "[1, null]", "G0944", "panel `front`: vertex 1"},
    {"/pattern/panels/front/vertices/1", "[1e9, 0]", "G0944", "within 100 m"},
    {"/pattern/panels/front/vertices/1", "[-1e300, 0]", "G0944", "panel `front`: vertex 1"},
    {"/pattern/panels/front/vertices/1", "{}", "G0944", "vertex 1 is an object"},
    {"/pattern/panels/front/edges", "", "G0943", "panel `front`: `edges` is missing"},
    {"/pattern/panels/front/edges", "{}", "G0943", "`edges` is an object"},
    {"/pattern/panels/front/edges", "[]", "G0944", "`edges` has 0 items"},
    {"/pattern/panels/front/edges", "[{\"endpoints\": [0, 1]}]", "G0947", "1 edges of some length"},
    {"/pattern/panels/front/edges", "[{\"endpoints\": [0, 1]}, {\"endpoints\": [1, 0]}]", "G0952",
     "encloses 0 cm^2"},
    {"/pattern/panels/front/edges/2", "17", "G0943", "panel `front`, edge 2: `endpoints` is missing"},
    {"/pattern/panels/front/edges/2", "{}", "G0943", "panel `front`, edge 2: `endpoints` is missing"},
    {"/pattern/panels/front/edges/2/endpoints", "[2]", "G0943", "panel `front`, edge 2"},
    {"/pattern/panels/front/edges/2/endpoints", "[2, 3, 0]", "G0943", "a list of 3"},
    {"/pattern/panels/front/edges/2/endpoints", "[2, 9]", "G0945", "vertex numbers from 0 to 3"},
    {"/pattern/panels/front/edges/2/endpoints", "[-1, 3]", "G0945", "panel `front`, edge 2"},
    {"/pattern/panels/front/edges/2/endpoints", "[2.5, 3]", "G0945", "panel `front`, edge 2"},
    {"/pattern/panels/front/edges/2/endpoints", "[2, 18446744073709551615]", "G0945",
     "panel `front`, edge 2"},
    {"/pattern/panels/front/edges/2/endpoints", "[2, \"3\"]", "G0945", "the text `3`"},
    {"/pattern/panels/front/edges/2/endpoints", "[1, 3]", "G0947", "meet at vertex"},
    {"/pattern/panels/front/edges/2", "", "G0947", "panel `front`"},
    {"/pattern/panels/front/edges/2/curvature", "0.5", "G0948", "panel `front`, edge 2"},
    {"/pattern/panels/front/edges/2/curvature", "[0.5]", "G0948", "a list of 1"},
    {"/pattern/panels/front/edges/2/curvature", "[0.5, 1e6]", "G0948", "panel `front`, edge 2"},
    {"/pattern/panels/front/edges/2/curvature", "[0.5, \"x\"]", "G0948", "panel `front`, edge 2"},
    {"/pattern/panels/front/edges/2/curvature", "{\"type\": \"quadratic\"}", "G0948", "an object"},
    {"/pattern/panels/front/edges/2/curvature", "{\"type\": \"spiral\", \"params\": [[0, 0]]}", "G0948",
     "`spiral`"},
    {"/pattern/panels/front/edges/2/curvature", "{\"type\": 3, \"params\": [[0, 0]]}", "G0948", "an object"},
    {"/pattern/panels/front/edges/2/curvature", "{\"type\": \"quadratic\", \"params\": [0, 0]}", "G0948",
     "edge 2"},
    {"/pattern/panels/front/edges/2/curvature", "{\"type\": \"cubic\", \"params\": [[0, 0], []]}", "G0948",
     "edge 2"},
    {"/pattern/panels/front/edges/2/curvature", "{\"type\": \"circle\", \"params\": [10, 0, 0]}", "G0948",
     "radius 10 cm cannot join"},
    {"/pattern/panels/front/edges/2/curvature", "{\"type\": \"circle\", \"params\": [-40, 0, 0]}", "G0948",
     "edge 2"},
    {"/pattern/panels/front/edges/2/curvature", "{\"type\": \"circle\", \"params\": [40, 2, 0]}", "G0948",
     "edge 2"},
    {"/pattern/panels/front/edges/2/curvature", "{\"type\": \"circle\", \"params\": [1e9, 1, 0]}", "G0948",
     "edge 2"},
    {"/pattern/panels/front/translation", "[0, 0]", "G0944", "panel `front`: `translation` is [0,0]"},
    {"/pattern/panels/front/translation", "[0, 0, 1e7]", "G0944", "panel `front`: `translation`"},
    {"/pattern/panels/front/translation", "\"up\"", "G0944", "panel `front`: `translation`"},
    {"/pattern/panels/front/rotation", "[0, 0, \"90\"]", "G0944", "panel `front`: `rotation`"},
    {"/pattern/panels/front/rotation", "[0, 0, 1e12]", "G0944", "three finite angles"},
    {"/pattern/stitches", "{}", "G0943", "`pattern.stitches` is an object"},
    {"/pattern/stitches/0", "\"all\"", "G0943", "stitch 0"},
    {"/pattern/stitches/0", "[]", "G0943", "stitch 0: is a list of 0"},
    {"/pattern/stitches/0/1", "", "G0943", "stitch 0: is a list of 1"},
    {"/pattern/stitches/0/1", "5", "G0943", "stitch 0: a side is 5"},
    {"/pattern/stitches/0/1/panel", "", "G0943", "stitch 0: a side is an object"},
    {"/pattern/stitches/0/1/panel", "3", "G0943", "stitch 0"},
    {"/pattern/stitches/0/1/panel", "\"bakc\"", "G0953", "stitch 0: there is no panel `bakc`"},
    {"/pattern/stitches/0/1/edge", "", "G0943", "stitch 0"},
    {"/pattern/stitches/0/1/edge", "4", "G0945",
     "stitch 0: edge 4 of panel `back`, expected a number from 0 to 3"},
    {"/pattern/stitches/0/1/edge", "-1", "G0945", "stitch 0"},
    {"/pattern/stitches/0/1/edge", "\"3\"", "G0945", "stitch 0"},
    {"/pattern/stitches/1/2", "\"wrong_right\"", "G0955", "`wrong_right`"},
    {"/pattern/stitches/1/2", "1", "G0955", "stitch 1: its third item is 1"},
    {"/properties/units_in_meter", "0", "G0950", "is 0"},
    {"/properties/units_in_meter", "-100", "G0950", "is -100"},
    {"/properties/units_in_meter", "\"cm\"", "G0950", "the text `cm`"},
    {"/properties/units_in_meter", "1e-9", "G0950", "1e-09"},
    {"/properties/units_in_meter", "1e5", "G0952", "encloses"},
};

/// Changes that are said and survived.
const Fault kWarnings[] = {
    {"/properties", "", "G0950", "100 is taken"},
    {"/properties", "[]", "G0950", "100 is taken"},
    {"/pattern/panels/front/translation", "", "G0943", "panel `front`: `translation` is missing"},
    {"/pattern/panels/front/rotation", "", "G0943", "panel `front`: `rotation` is missing"},
    {"/pattern/panels/front/rotation", "[10, 20, 0]", "G0951", "panel `front`: turned by (10, 20, 0) deg"},
    {"/pattern/panels/front/edges/0/endpoints", "[1, 0]", "G0949", "panel `front`"},
    {"/pattern/panels/front/vertices/1", "[40, 55]", "G0957", "stitch 0: edge 1 of panel `front`"},
    {"/pattern/stitches/1/0/edge", "1", "G0956", "stitch 1: edge 1 of panel `front`"},
    {"/pattern/stitches/0/1", "{\"panel\": \"front\", \"edge\": 1}", "G0954",
     "edge 1 of panel `front` to itself"},
};

json changed(const Fault& fault) {
  json root = json::parse(fixture("right_wrong.json"));
  json::json_pointer pointer(fault.pointer);
  if (*fault.value) {
    root[pointer] = json::parse(fault.value);
  } else {
    json& parent = root[pointer.parent_pointer()];
    if (parent.is_array())
      parent.erase(std::stoul(pointer.back()));
    else
      parent.erase(pointer.back());
  }
  return root;
}

bool says(const Findings& findings, const std::string& code, const std::string& text) {
  for (const Finding& f : findings)
    if (f.code == code && f.message.find(text) != std::string::npos) return true;
  return false;
}

/// Two quads, `n` times, sewn to nothing.
std::string many_panels(int n) {
  std::string text = R"({"properties": {"units_in_meter": 100}, "pattern": {"panels": {)";
  for (int i = 0; i < n; ++i)
    text += (i ? "," : "") + ("\"p" + std::to_string(i)) +
            R"(": {"vertices": [[0,0],[9,0],[9,9]], "edges": [{"endpoints":[0,1]},{"endpoints":[1,2]},)"
            R"({"endpoints":[2,0]}], "translation": [0,0,0], "rotation": [0,0,0]})";
  return text + "}}}";
}

}  // namespace

TEST_CASE("faults of a pattern are named, with their place") {
  REQUIRE(std::size(kFaults) > 60);
  for (const Fault& fault : kFaults) {
    INFO(fault.pointer << " = " << fault.value);
    io::PatternResult result = io::read_pattern(changed(fault).dump());
    INFO(all_messages(result.findings));
    CHECK_FALSE(result.garment);
    CHECK(has_errors(result.findings));
    CHECK(says(result.findings, fault.code, fault.says));
  }
}

TEST_CASE("small faults of a pattern are warned of") {
  for (const Fault& fault : kWarnings) {
    INFO(fault.pointer << " = " << fault.value);
    io::PatternResult result = io::read_pattern(changed(fault).dump());
    INFO(all_messages(result.findings));
    CHECK(result.garment);
    CHECK(says(result.findings, fault.code, fault.says));
  }
}

TEST_CASE("a pattern without stitches is a set of pieces") {
  io::PatternResult result = io::read_pattern(changed({"/pattern/stitches", "", "", ""}).dump());
  REQUIRE(result.garment);
  CHECK(result.garment->seams.empty());
  CHECK(result.garment->panels[0].edges[1].free);
}

TEST_CASE("what is not JSON is refused with line and column") {
  struct Case {
    std::string text, code, says;
  };
  const std::string deep(100000, '[');
  const Case cases[] = {
      {"", "G0940", "line 1, column 1"},
      {"garment 1 \"skirt\"", "G0940", "line 1, column 1"},
      {"{\n  \"pattern\": {,}\n}", "G0940", "line 2, column 15"},
      {"{\"pattern\": NaN}", "G0940", "line 1, column"},
      {"{\"pattern\": 1e999}", "G0940", "number"},
      {"{\"pattern\": {}} {}", "G0940", "line 1, column 17"},
      {"{\"pattern\": {}", "G0940", "line 1"},
      {"{\"pattern\": \"\xff\xfe\"}", "G0940", "line 1"},
      {std::string("{\0}", 3), "G0940", "line 1, column 2"},
      {"\"\\u12", "G0940", "line 1"},
      {deep, "G0941", "more than 64 deep at line 1, column 65"},
      {"\n" + deep + std::string(100000, ']'), "G0941", "line 2, column 65"},
      {R"({"pattern": {"panels": {"a": 1, "a": 2}}})", "G0942", "`a` stands twice"},
      {"7", "G0943", "missing"},
      {"null", "G0943", "missing"},
      {"[{\"pattern\": {}}]", "G0943", "missing"},
  };
  for (const Case& c : cases) {
    INFO(c.text.substr(0, 60));
    io::PatternResult result = io::read_pattern(c.text);
    INFO(all_messages(result.findings));
    CHECK_FALSE(result.garment);
    CHECK(says(result.findings, c.code, c.says));
  }
}

TEST_CASE("sizes of a pattern are bounded") {
  CHECK(io::read_pattern(many_panels(200)).garment);
  io::PatternResult many = io::read_pattern(many_panels(4097));
  CHECK_FALSE(many.garment);
  CHECK(says(many.findings, "G0944", "4097 panels, expected 1 to 4096"));

  io::PatternOptions small;
  small.limits.max_bytes = 100;
  CHECK(says(io::read_pattern(many_panels(2), small).findings, "G0941", "at most 100"));
  small = {};
  small.limits.max_total = 4;
  CHECK(says(io::read_pattern(many_panels(9), small).findings, "G0944", "more than 4 edges"));
}

TEST_CASE("a long list of small objects takes no long time") {
  std::string text = "{\"a\": [{\"k\": 0}";
  for (int i = 0; i < 300000; ++i) text += ",{\"k\":0}";
  CHECK(says(io::read_pattern(text + "]}").findings, "G0943", "missing"));
}

TEST_CASE("one fault many times is said a few times and counted") {
  json root = json::parse(fixture("right_wrong.json"));
  for (int i = 0; i < 1000; ++i) root["pattern"]["stitches"].push_back("x");
  io::PatternResult result = io::read_pattern(root.dump());
  CHECK_FALSE(result.garment);
  CHECK(result.findings.size() < 20);
  CHECK(says(result.findings, "G0943", "988 more like these"));
}

TEST_CASE("names that no script could hold are replaced") {
  const std::vector<std::string> names = {"",  "1",     "a b", "\x01\x02",
                                          "ä", "seam!", "..",  std::string(500, 'x')};
  for (const std::string& name : names) {
    json root = json::parse(fixture("right_wrong.json"));
    root["pattern"]["panels"][name] = root["pattern"]["panels"]["front"];
    io::PatternResult result = io::read_pattern(root.dump());
    INFO(name << "\n" << all_messages(result.findings));
    REQUIRE(result.garment);
    for (const design::Panel& panel : result.garment->panels) {
      REQUIRE(!panel.name.empty());
      CHECK(panel.name.size() <= 70);
      CHECK(std::isalpha(static_cast<unsigned char>(panel.name[0])));
      for (char c : panel.name) CHECK((std::isalnum(static_cast<unsigned char>(c)) || c == '_'));
    }
  }
}

TEST_CASE("a truncated pattern is refused at every length") {
  std::string text = fixture("right_wrong.json");
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  for (std::size_t n = 0; n < text.size(); n += 3) {
    io::PatternResult result = io::read_pattern(text.substr(0, n));
    CHECK_FALSE(result.garment);
    CHECK(has_code(result.findings, "G0940"));
  }
}
