// Units, expressions, functions, names.
#include <cstdlib>

#include "interpreter/language/construct_table.hpp"
#include "interpreter/language/function_table.hpp"
#include "interpreter/language/units.hpp"
#include "tests/unit/interpreter/support.hpp"

using namespace garment;
using namespace garment::interpreter;
using namespace garment::interpreter::test;

namespace {

std::string only_value_of(const std::string& expr, const std::string& before = "") {
  const Trial trial(before + "\nmeasure answer = " + expr + "\n");
  INFO(expr);
  INFO(trial.text());
  REQUIRE(trial.result.ok());
  REQUIRE(trial.result.measures.size() == 1);
  return trial.result.measures[0].text;
}

}  // namespace

TEST_CASE("units convert exactly") {
  const struct {
    const char* text;
    double factor;
    Dimension dimension;
  } cases[] = {
      {"cm", 0.01, kLength},
      {"inch", 0.0254, kLength},
      {"ft", 0.3048, kLength},
      {"g/m^2", 1e-3, kArealDensity},
      {"mg/cm^2", 0.01, kArealDensity},
      {"gf/cm", 0.980665, kForcePerLength},
      {"gf*cm/cm^2", 0.980665, kForcePerLength},
      {"gf*cm^2/cm", 9.80665e-5, kMoment},
      {"gf*cm/cm", 9.80665e-3, kForce},
      {"gf/cm/deg", 56.187966, kShearRigidity},
      {"N*m", 1, kMoment},
      {"kgf", 9.80665, kForce},
      {"cN", 0.01, kForce},
      {"m/s^2", 1, kAcceleration},
      {"min", 60, kTime},
      {"%", 0.01, kNumber},
  };
  for (const auto& c : cases) {
    INFO(c.text);
    const auto unit = find_unit(c.text);
    REQUIRE(unit);
    CHECK(unit->factor == Approx(c.factor).epsilon(1e-8));
    CHECK(unit->dimension == c.dimension);
  }
  CHECK_FALSE(find_unit("cn"));
  CHECK_FALSE(find_unit("cm*"));
  CHECK_FALSE(find_unit("cm^x"));
  CHECK_FALSE(find_unit("m^9*m^9*m^9*m^9*m^9*m^9*m^9"));
}

TEST_CASE("expressions have the value a reader expects") {
  const std::pair<const char*, const char*> cases[] = {
      {"20 cm/4", "5 cm"},
      {"2 * 3 cm + 1 cm", "7 cm"},
      {"10 cm - 4", ""},
      {"(10 cm)^2", "100 cm^2"},
      {"20 cm / 5 cm", "4"},
      {"-3 cm", "-3 cm"},
      {"50%", "50%"},
      {"2 * 50%", "100%"},
      {"50% * 40 cm", "20 cm"},
      {"0.12 gf*cm^2/cm", "1.176798e-05 N*m"},
      {"sqrt(9 cm * 4 cm)", "6 cm"},
      {"sin(30 deg)", "0.5"},
      {"atan2(1 cm, 1 cm)", "45 deg"},
      {"min(3 cm, 2 cm, 5 cm)", "2 cm"},
      {"max([1, 7, 3])", "7"},
      {"min(0, 3 cm)", "0 cm"},
      {"abs(-2 cm)", "2 cm"},
      {"round(5.26 cm, 1 mm)", "5.3 cm"},
      {"floor(3.7)", "3"},
      {"ceil(3.2)", "4"},
      {"count([1, 2, 3])", "3"},
      {"[1 cm, 2 cm, 3 cm][2]", "2 cm"},
      {"distance((0, 0), (3 cm, 4 cm))", "5 cm"},
      {"toward((0, 0), (10 cm, 0), 1/4).x", "2.5 cm"},
      {"toward((0, 0), (10 cm, 0), 3 cm).x", "3 cm"},
      {"polar((0, 0), 90 deg, 5 cm).y", "5 cm"},
      {"(1 cm, 2 cm) + (3 cm, 4 cm)", "(4 cm, 6 cm)"},
      {"2 * (1 cm, 2 cm)", "(2 cm, 4 cm)"},
      {"if 3 > 2 { 1 cm } else { 2 cm }", "1 cm"},
      {"1 < 2 and not (2 < 1)", "true"},
      {"1 cm == 10 mm", "true"},
      {"\"a{1 + 1}b\"", "a2b"},
      {"1 .. 3", "1 .. 3"},
      {"2 ^ 10", "1024"},
  };
  for (const auto& [expr, text] : cases)
    if (*text != '\0') CHECK(only_value_of(expr) == text);
  CHECK(only_value_of("half(9 cm)", "fn half(x) = x / 2") == "4.5 cm");
  CHECK(only_value_of("area_of(w: 2 cm)", "fn area_of(w, h: length = 2 * w) = w * h") == "8 cm^2");
  CHECK(only_value_of("fact(10)", "fn fact(n) = if n < 2 { 1 } else { n * fact(n - 1) }") == "3628800");
  CHECK(only_value_of("r.b", "let r = { a = 1, b = 2 cm }") == "2 cm");
  CHECK(only_value_of("r.a", "let q = { a = 1, b = 2 cm }\nlet r = q with { a = 7 }") == "7");
  CHECK(only_value_of("a", "let a = b + 1 cm\nlet b = 2 cm") == "3 cm");
}

TEST_CASE("what an expression may not say") {
  refuses("let a = «3 cm + 2»\n", "G0305", "`2 cm`");
  refuses("let a = «3 cm < 2 s»\n", "G0305");
  refuses("let a = «nothing»\n", "G0301", "nothing");
  refuses("let width = 3 cm\nlet a = «widht»\n", "G0301", "did you mean `width`?");
  refuses("let a = «3 / 0»\n", "G0319", "zero");
  refuses("let a = sqrt(«-1 cm^2»)\n", "G0309");
  refuses("let a = sqrt(«2 cm»)\n", "G0305");
  refuses("let a = sin(«30»)\n", "G0308", "30 deg");
  refuses("let a = [1, 2][«3»]\n", "G0309", "1 .. 2");
  refuses("let a = «\"x\" + 1»\n", "G0306");
  refuses("let a = if «3» { 1 } else { 2 }\n", "G0306");
  refuses("let a = (1 cm, «2»)\n", "G0305", "2 cm");
  refuses("let a = (1 cm, 2 cm).«z»\n", "G0311");
  refuses("let a = «length»\n", "G0306", "length(EDGE | CURVE | POINT)");
  refuses("let a = min(1, «2 cm»)\n", "G0305");
  refuses("let a = round(«3 cm»)\n", "G0308", "round(x, 1 cm)");
  refuses("fn f(x) = x\nlet a = f(1, «2»)\n", "G0307");
  refuses("fn f(x) = x\nlet a = «f()»\n", "G0307", "needs `x`");
  refuses("fn f(x) = x\nlet a = f(«y»: 2)\n", "G0307", "takes no `y`");
  refuses("fn f(x: length) = x\nlet a = f(«2»)\n", "G0308", "2 cm");
  refuses("fn f(x: text) = x\nlet a = f(«2»)\n", "G0306");
  refuses("fn f(x: «lenght») = x\nlet a = f(2 cm)\n", "G0301", "did you mean `length`?");
  refuses("fn f(n) = f(n + 1)\nlet a = f(1)\n", "G0316", "256");
  refuses("let a = «strain(all)»\n", "G0325", "measure");
  refuses("let x = 3\nlet a = «x»(2)\n", "G0306");
}

TEST_CASE("names are declared once and hide nothing") {
  refuses("let a = 1\nlet «a» = 2\n", "G0302");
  refuses("let «cm» = 1\n", "G0303", "unit");
  refuses("let «pi» = 3\n", "G0303", "builtin");
  refuses("let «start» = 3\n", "G0303");
  refuses("for i in 1 .. 2 { measure «aa» = i }\n", "G0302");
  accepts(Trial("for i in 1 .. 3 { measure m_{i} = i }\nassert m_3 == 3\n"));
  accepts(Trial("for i in 1 .. 3 { let k = 2 * i; measure m_{i} = k }\nassert m_2 == 4\n"));
  accepts(Trial("if 2 > 1 { measure a = 1 } else { measure b = 1 }\nassert a == 1\n"));
  accepts(Trial("for n in [\"x\", \"y\"] { measure m_{n} = 1 }\nassert m_y == 1\n"));
  refuses("for i in «1 cm .. 3 cm» { measure m_{i} = i }\n", "G0306");
  refuses("for i in «1 .. 1000000» { measure m_{i} = i }\n", "G0327");
  refuses("let a = b\nlet b = c\nlet c = «a»\n", "G0304", "`a` -> `b` -> `c` -> `a`");
}

TEST_CASE("a failed name is told once") {
  refuses("let a = «nothing»\nlet b = a + 1\nlet c = b * 2\nmeasure d = c\n", "G0301");
}

TEST_CASE("parameters") {
  InterpretOptions options;
  options.params = {{"long", "70cm"}};
  const Trial given("param long = 58 cm in 30 cm .. 110 cm \"waist to hem\"\nmeasure a = 2 * long\n",
                    options);
  accepts(given);
  CHECK(given.result.measures[0].text == "140 cm");
  CHECK(given.result.parameters[0].range == "30 cm .. 110 cm");
  CHECK(Trial("param long = 58 cm\nlong = 60 cm\nmeasure a = long\n").result.measures[0].text == "60 cm");
  options.params = {{"fit", "loose"}};
  const Trial choice("param fit = \"slim\" in [\"slim\", \"loose\"]\nmeasure a = fit\n", options);
  accepts(choice);
  CHECK(choice.result.measures[0].text == "loose");
  options.params = {{"cloth", "fabrics.habotai"}};
  accepts(Trial("use fabrics\nparam cloth = fabrics.denim\nassert cloth.W < 50 g/m^2\n", options));

  options.params = {{"long", "2 m"}};
  refuses("param long = 58 cm in 30 cm .. 110 cm\n", "G0310", "30 cm .. 110 cm", options);
  options.params = {{"long", "70"}};
  refuses("param long = 58 cm\n", "G0308", "70 cm", options);
  options.params = {{"logn", "70 cm"}};
  refuses("param long = 58 cm\n", "G0324", "did you mean `long`?", options);
  options.params = {{"fit", "losoe"}};
  refuses("param fit = \"slim\" in [\"slim\", \"loose\"]\n", "G0310", "did you mean `loose`?", options);
  options.params = {{"long", "70 cm\nlet evil = 3"}};
  const Trial injected("param long = 58 cm\n", options);
  CHECK_FALSE(injected.result.ok());
  refuses("param long = «200 cm» in 30 cm .. 110 cm\n", "G0310");
  refuses("param long = 58 cm\nlong = 60 cm\n«long» = 61 cm\n", "G0321");
  refuses("let a = 1\n«a» = 2\n", "G0311", "only a param");
}

TEST_CASE("used files and libraries") {
  const std::map<std::string, std::string> files = {
      {"here/mine.garment", "let w = 20 cm\nfn twice(x) = 2 * x\nfn bad(x) = x + 1 cm\n"},
      {"here/panel.garment", "panel p of f { }\n"},
      {"here/loop.garment", "use \"loop.garment\" as me\nlet a = 1\n"}};
  InterpretOptions options;
  options.script_dir = "here";
  const Trial good("use \"mine.garment\"\nmeasure a = mine.twice(mine.w)\n", options, files);
  accepts(good);
  CHECK(good.result.measures[0].text == "40 cm");
  const Trial loop("use \"loop.garment\" as l\nmeasure a = l.a\n", options, files);
  REQUIRE_FALSE(loop.result.diagnostics.empty());
  CHECK(loop.result.diagnostics[0].code == "G1230");
  // What goes wrong inside a library is shown at the call.
  const Trial inside("use \"mine.garment\" as mine\nlet a = «mine.bad(3)»\n", options, files);
  REQUIRE(inside.result.diagnostics.size() == 1);
  CHECK(inside.result.diagnostics[0].code == "G0305");
  CHECK(inside.result.diagnostics[0].labels[0].span == inside.mark);
  CHECK(inside.result.diagnostics[0].labels.size() == 2);
  const Trial panel("use \"panel.garment\" as p\n", options, files);
  REQUIRE(panel.result.diagnostics.size() == 1);
  CHECK(panel.result.diagnostics[0].code == "G0322");
  refuses("use «\"../etc/passwd\"» as p\n", "G0328");
  refuses("use «\"/etc/passwd\"» as p\n", "G0328");
  refuses("use «nolib»\n", "G0318");
  refuses("use fabrics, «fabrics»\n", "G1231");
  refuses("use fabrics\nlet a = fabrics.«demin»\n", "G0311", "did you mean `denim`?");
  refuses("let a = «fabrics».denim\n", "G0301", "use fabrics");
}

TEST_CASE("words of the language that have no meaning yet are refused once, in place") {
  for (const ConstructRecord& record : construct_table()) {
    if (record.supported || !record.top) continue;
    const std::string statement = "«" + std::string(record.keyword) + "» thing\n";
    refuses(statement, "G0315");
    // The name is known, so its use gives no second error.
    if (record.declares_name) refuses(statement + "let a = thing\n", "G0315");
  }
}

TEST_CASE("the table describes itself") {
  const grammar::Vocabulary& words = vocabulary();
  CHECK(words.top.size() > 20);
  CHECK(help_text("pin").find("pin NAME on PANEL at POINT") != std::string::npos);
  CHECK(help_text("dart").find("default 50%") != std::string::npos);
  CHECK(help_text("place").find("0 cm .. 50 cm") != std::string::npos);
  CHECK(help_text("zip").find("not supported yet") == std::string::npos);
  CHECK(help_text("length").find("darts closed") != std::string::npos);
  CHECK(help_text("nonsense").empty());
  for (const ConstructRecord& record : construct_table()) {
    INFO(record.keyword);
    CHECK_FALSE(record.form.empty());
    CHECK_FALSE(record.doc.empty());
    if (record.supported) CHECK_FALSE(record.example.empty());
    if (!record.supported) CHECK(help_text(record.keyword).find("not supported yet") != std::string::npos);
    for (std::string_view word : record.body_keywords) CHECK(find_construct(word) != nullptr);
    // A line is one thing inside a panel and in a drawing; the pressure that a drape is asked for is the one that acts.
    if (record.keyword == "line" || record.keyword == "pressure") continue;
    CHECK(find_function(record.keyword) == nullptr);
  }
  CHECK(did_you_mean("waits", {"waist", "hip"}) == "did you mean `waist`?");
  CHECK(did_you_mean("ab", {"waist", "hip"}).empty());
}
