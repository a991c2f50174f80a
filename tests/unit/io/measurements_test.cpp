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
  const std::string breaks =
      "<vst><unit>cm</unit><size base=\"50\"/><height base=\"176\"/><body-measurements><m name=\"a\" "
      "base=\"1\" "
      "size_increase=\"1\" height_increase=\"0\"><sizeRules><break threshold=\"54\" "
      "increase=\"2\"/></sizeRules></m>"
      "</body-measurements></vst>";
  refused(breaks, "G0720", "graded in breaks");
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
