// Measurement files of Seamly and Valentina: formulas, grading, what is wrong with a line.
#include "runtime/io/measurements_xml.hpp"

#include <catch2/catch.hpp>
#include <map>

#include "runtime/io/measure_formula.hpp"

using namespace garment;
using io::read_measurements;

namespace {

std::string smis(const std::string& rows, const std::string& unit = "cm", const std::string& root = "smis") {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<" + root + ">\n<version>0.3.4</version>\n<unit>" +
         unit + "</unit>\n<body-measurements>\n" + rows + "</body-measurements>\n</" + root + ">\n";
}
std::string m(const std::string& name, const std::string& value) {
  return "<m name=\"" + name + "\" value=\"" + value + "\"/>\n";
}

std::map<std::string, double> values(const std::string& text, const io::MeasurementOptions& options = {}) {
  const io::MeasurementsResult read = read_measurements(text, options, "anna.smis", {});
  for (const Finding& f : read.findings) FAIL(f.code << " " << f.message);
  REQUIRE(read.measurements);
  std::map<std::string, double> out;
  for (const io::Measurement& one : *read.measurements) out[one.name] = one.value;
  return out;
}

void refused(const std::string& text, const char* code, const char* says,
             const io::MeasurementOptions& options = {}) {
  const io::MeasurementsResult read = read_measurements(text, options, "anna.smis", {});
  CHECK_FALSE(read.measurements);
  REQUIRE(read.findings.size() == 1);
  CHECK(read.findings[0].code == code);
  CHECK_THAT(read.findings[0].message, Catch::Contains(says));
}

double formula(const std::string& text) {
  const io::FormulaResult r = io::compute_formula(text, [](const std::string& name) -> io::FormulaResult {
    if (name == "a") return {3, ""};
    return {std::nullopt, "`" + name + "` is unknown"};
  });
  INFO(text << ": " << r.error);
  REQUIRE(r.value);
  return *r.value;
}

}  // namespace

TEST_CASE("formulas are computed as on paper") {
  CHECK(formula("1 + 2 * 3") == 7);
  CHECK(formula("(1 + 2) * 3") == 9);
  CHECK(formula("2 - 3 - 4") == -5);
  CHECK(formula("12 / 3 / 2") == 2);
  CHECK(formula("2 ^ 3 ^ 2") == Approx(512));
  CHECK(formula("-2 ^ 2") == Approx(-4));
  CHECK(formula("2 ^ -1") == Approx(0.5));
  CHECK(formula("-a + +a - -a") == 3);
  CHECK(formula("@a + #a") == 6);
  CHECK(formula("min(4; 2, 3)") == 2);
  CHECK(formula("max(a, 2) + avg(1, 2) + sum(1, 2, 3)") == Approx(10.5));
  CHECK(formula("sqrt(abs(-16))") == 4);
  CHECK(formula("sinD(30) + cos(0)") == Approx(1.5));
  CHECK(formula(".5*a") == 1.5);
}

TEST_CASE("an individual file gives metres whatever its unit") {
  auto cm =
      values(smis(m("bust_circ", "102") + m("waist_circ", "bust_circ - 20") + m("@half", "waist_circ / 2") +
                  m("#third", "(@half + half) / 3") + m("shoulder_slope_neck_side_angle", "22.5")));
  CHECK(cm["bust_circ"] == Approx(1.02));
  CHECK(cm["waist_circ"] == Approx(0.82));
  CHECK(cm["half"] == Approx(0.41));
  CHECK(cm["third"] == Approx(0.82 / 3));
  CHECK(cm["shoulder_slope_neck_side_angle"] == Approx(0.3926990817));
  CHECK(values(smis(m("height", "1700"), "mm"))["height"] == Approx(1.7));
  CHECK(values(smis(m("height", "67"), "inch", "vit"))["height"] == Approx(1.7018));
}

TEST_CASE("a multisize file is graded by 2 cm of size and 6 cm of height") {
  const std::string text =
      "<smms>\n<unit>cm</unit>\n<size base=\"50\"/>\n<height base=\"176\"/>\n<body-measurements>\n"
      "<m name=\"bust_circ\" base=\"104.4\" size_increase=\"3.8\" height_increase=\"0.2\"/>\n"
      "</body-measurements>\n</smms>\n";
  CHECK(values(text)["bust_circ"] == Approx(1.044));
  CHECK(values(text, {0.54, std::nullopt})["bust_circ"] == Approx(1.12));
  CHECK(values(text, {0.48, 1.70})["bust_circ"] == Approx(1.004));
}

TEST_CASE("increments may change along the sizes and heights") {
  const std::string text =
      "<smms><unit>cm</unit><size base=\"50\"/><height base=\"176\"/><body-measurements>"
      "<m name=\"a\" base=\"100\" size_increase=\"4\" height_increase=\"1\">"
      "<sizeRules><break threshold=\"56\" increment=\"6\"/><break threshold=\"52\" increment=\"5\"/></sizeRules>"
      "<heightRules><break threshold=\"182\" increment=\"0.5\"/></heightRules></m>"
      "<m name=\"b\" base=\"100\" size_increase=\"4\" height_increase=\"1\"/></body-measurements></smms>";
  auto a = [&](double size, double height) { return values(text, {size / 100, height / 100})["a"] * 100; };
  CHECK(a(50, 176) == Approx(100));
  CHECK(a(52, 176) == Approx(104));  // the step from 50
  CHECK(a(54, 176) == Approx(109));  // and the one from 52
  CHECK(a(60, 176) == Approx(100 + 4 + 5 + 5 + 6 + 6));
  CHECK(a(53, 176) == Approx(106.5));  // half a step
  CHECK(a(46, 176) == Approx(92));
  CHECK(a(50, 188) == Approx(101.5));
  CHECK(a(54, 170) == Approx(108));
  CHECK(values(text, {0.60, 1.88})["b"] * 100 == Approx(122));
  // Down from a base beyond a threshold: each step counts where it begins.
  std::string large = text;
  large.replace(large.find("base=\"50\""), 9, "base=\"56\"");
  CHECK(values(large, {0.50, 1.76})["a"] * 100 == Approx(100 - 6 - 5 - 5));
  CHECK(values(large, {0.48, 1.76})["a"] * 100 == Approx(100 - 6 - 5 - 5 - 4));
  std::string wrong = text;
  wrong.replace(wrong.find("increment=\"6\""), 13, "increase=\"6\" ");
  refused(wrong, "G0721", "`increment` of <break> is ``, no number");
  refused(text, "G0720", "more than 1000 steps", {100, std::nullopt});  // m
  // Millimetres: thresholds and bases are in the unit of the file, steps are 2 cm and 6 cm all the same.
  const std::string mm =
      "<vst><unit>mm</unit><size base=\"500\"/><height base=\"1760\"/><body-measurements><m name=\"a\" base=\"1000\" "
      "size_increase=\"40\" height_increase=\"0\"><sizeRules><break threshold=\"520\" increment=\"50\"/></sizeRules></m>"
      "</body-measurements></vst>";
  CHECK(values(mm, {0.54, std::nullopt})["a"] == Approx(1.09));
}

TEST_CASE("a file of Valentina with dimensions has steps of its own, and corrections") {
  auto file = [](const std::string& dimensions, const std::string& unit = "cm") {
    return "<vst>\n<version>0.6.2</version><unit>" + unit + "</unit>\n<dimensions>" + dimensions +
           "</dimensions><restrictions/><body-measurements>\n"
           "<m type=\"separator\" name=\"head\"/>"
           "<m name=\"height\" base=\"176\" shiftA=\"6\"/>"
           "<m name=\"bust_circ\" base=\"100\" shiftA=\"0.5\" shiftB=\"4\" shiftC=\"0.25\"><corrections>"
           "<correction coordinates=\"176;54;94\" correction=\"0.75\"/><correction coordinates=\"176;52;94\" alias=\"M\"/>"
           "</corrections></m>"
           "<m name=\"slope\" base=\"20\" shiftB=\"1\" specialUnits=\"true\"/></body-measurements></vst>";
  };
  const std::string x = "<dimension type=\"x\" base=\"176\" min=\"158\" max=\"188\" step=\"6\"/>",
                    y = "<dimension type=\"y\" base=\"50\" min=\"40\" max=\"60\" step=\"2\"/>",
                    z = "<dimension type=\"z\" base=\"94\" min=\"80\" max=\"110\" step=\"4\"/>";
  // The order in the file says nothing: shiftA is the height's.
  for (const std::string& text : {file(x + y + z), file(z + y + x)}) {
    CHECK(values(text).size() == 3);
    CHECK(values(text)["bust_circ"] == Approx(1));
    CHECK(values(text, {0.52, std::nullopt})["bust_circ"] == Approx(1.04));
    CHECK(values(text, {0.54, std::nullopt})["bust_circ"] == Approx(1.0875));
    CHECK(values(text, {0.54, 1.82})["bust_circ"] == Approx(1.085));
    CHECK(values(text, {std::nullopt, 1.64})["height"] == Approx(1.64));
    CHECK(values(text, {0.54, std::nullopt})["slope"] == Approx(22 * 3.14159265358979 / 180));
  }
  CHECK(values(file(y), {0.54, std::nullopt})["bust_circ"] == Approx(1.01));  // shiftA is the size's now
  CHECK(values(file(y, "inch"))["bust_circ"] == Approx(2.54));
  refused(file(y), "G0720", "not graded by height", {std::nullopt, 1.7});
  refused(file(x), "G0720", "not graded by size", {0.5, std::nullopt});
  refused(file(""), "G0720", "0 dimensions");
  refused(file(x + y + z + "<dimension type=\"w\" base=\"98\" step=\"4\"/>"), "G0720", "4 dimensions");
  refused(file("<dimension type=\"x\" base=\"tall\" step=\"6\"/>"), "G0721", "is `tall`, no number");
}

TEST_CASE("what is wrong is told with its line") {
  refused("", "G0720", "line 1");
  refused("<smis>\n<unit>cm</unit>\n<body", "G0720", "line 3: no XML");
  refused("<html/>", "G0720", "the root is `html`");
  refused(smis("", "parsec"), "G0720", "line 4: the unit is `parsec`");
  refused(smis(m("a", "1") + m("a", "2")), "G0720", "line 7: `a` is stated twice");
  refused(smis(m("a", "1")), "G0720", "no sizes", {0.5, std::nullopt});
  refused(smis(m("a", "waits_circ")), "G0721", "line 6: `a`: `waits_circ` is no measure");
  refused(smis(m("a", "b") + m("b", "c / 2") + m("c", "a")), "G0721", "made from itself");
  refused(smis(m("a", "1 / (2 - 2)")), "G0721", "division by zero");
  refused(smis(m("a", "sqrt(-1)")), "G0721", "no finite value");
  refused(smis(m("a", "9 ^ 9 ^ 9")), "G0721", "no finite value");
  refused(smis(m("a", "1 +")), "G0721", "ends too early");
  refused(smis(m("a", "1 2")), "G0721", "should end");
  refused(smis(m("a", "cosh(1)")), "G0721", "no function");
  refused(smis(m("a", std::string(5000, '('))), "G0721", "nested");
  refused(smis(m("a", "")), "G0721", "ends too early");
}

TEST_CASE("long chains and entity bombs come to an end") {
  std::string rows = m("m0", "1");
  for (int k = 1; k < 5000; ++k) rows += m("m" + std::to_string(k), "m" + std::to_string(k - 1) + " + 1");
  CHECK(values(smis(rows))["m4999"] == Approx(50));
  std::string backwards;
  for (int k = 5000; k > 0; --k) backwards += m("m" + std::to_string(k), "m" + std::to_string(k - 1));
  refused(smis(backwards + m("m0", "1")), "G0721", "more than 60");
  const std::string bomb =
      "<?xml version=\"1.0\"?>\n<!DOCTYPE smis [<!ENTITY a \"1111111111\"><!ENTITY b \"&a;&a;&a;&a;\">]>\n" +
      smis(m("a", "&b;")).substr(39);
  refused(bomb, "G0721", "where a number");
}
