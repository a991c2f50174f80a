// Fabrics by Kawabata and SI figures; drape, expect, save, assert, measure.
#include <cmath>

#include "tests/unit/interpreter/support.hpp"

using namespace garment;
using namespace garment::interpreter;
using namespace garment::interpreter::test;

namespace {

design::Fabric fabric(const std::string& definition, const std::string& more = "") {
  const Trial trial("use fabrics\nfabric mine = " + definition + "\n" + more);
  INFO(trial.text());
  REQUIRE(trial.result.ok());
  REQUIRE(trial.result.garment.fabrics.size() >= 1);
  return trial.result.garment.fabrics[0];
}

/// Answers as a finished drape would.
class Drape : public DrapeMeasures {
 public:
  std::optional<double> strain(const std::string& panel) const override {
    return panel.empty() ? 0.062 : 0.05;
  }
  std::optional<double> shear(const std::string&) const override { return 0.2; }
  std::optional<double> length(const std::vector<design::EdgePart>& parts) const override {
    double sum = 0;
    for (const auto& part : parts) sum += std::fabs(part.to - part.from);
    return 1.02 * sum;
  }
  std::optional<double> area(const std::string&) const override { return 0.5; }
  std::optional<double> mass(const std::string&) const override { return 0.3; }
  std::optional<double> clearance(const std::string& panel) const override {
    return panel.empty() ? std::nullopt : std::optional<double>(0.002);
  }
  std::optional<double> energy() const override { return 1.5; }
  std::optional<double> penetrations() const override { return 0; }
  std::optional<Eigen::Vector3d> position(int) const override { return Eigen::Vector3d(0.1, 1, 0); }
  std::optional<Eigen::Vector3d> position(int, const design::Point2& p) const override {
    return Eigen::Vector3d(p.x(), p.y(), 0);
  }
};

const std::string kCloth =
    "use fabrics\npanel cloth of fabrics.poplin {\n outline from (0, 0) {\n edge bottom to (20 cm, 0) free\n "
    "edge r to (20 cm, 30 cm) free\n edge "
    "top to (0, 30 cm) free\n close l free\n }\n}\npin p on cloth at cloth.top.start\n";

ExpectResult ask(const std::string& expect) {
  Trial trial(kCloth + expect + "\n");
  INFO(trial.text());
  REQUIRE(trial.result.ok());
  REQUIRE(trial.result.acts.size() == 1);
  return evaluate_expect(trial.result, trial.result.acts[0], Drape());
}

}  // namespace

TEST_CASE("figures that no drape uses are told in a script, not in a library") {
  const Trial told(std::string("use fabrics\n") + "fabric mine = fabrics.denim with { two_HB = 0.03 gf*cm/cm, damping = 10 ms }\n");
  REQUIRE(told.result.diagnostics.size() == 1);
  CHECK(told.result.diagnostics[0].code == "G0461");
  CHECK(told.result.diagnostics[0].severity == Severity::note);
  CHECK(told.result.diagnostics[0].message.starts_with("`two_HB` is kept"));
  CHECK(told.result.diagnostics[0].labels.size() == 1);
  CHECK(Trial(std::string("use fabrics\n") + "fabric mine = fabrics.denim\n").result.diagnostics.empty());
}

TEST_CASE("Kawabata figures become SI") {
  const design::Fabric f = fabric(
      "{ W = 263.5 g/m^2, T = 0.746 mm, EM_warp = 6.03%, EM_weft = 5%, LT = 0.608, RT = 62.2%, G = 0.859 "
      "gf/cm/deg, two_HG = 0.885 gf/cm, "
      "two_HG5 = 1.793 gf/cm, B_warp = 0.1357 gf*cm^2/cm, B_weft = 0.1 gf*cm^2/cm, two_HB = 0.0622 gf*cm/cm, "
      "MIU = 0.21 }");
  CHECK(f.areal_density == Approx(0.2635));
  CHECK(f.thickness == Approx(0.746e-3));
  CHECK(f.tensile[0].max_strain == Approx(0.0603));
  CHECK(f.tensile[1].max_strain == Approx(0.05));
  CHECK(f.tensile[0].linearity == 0.608);
  CHECK(f.tensile[0].max_force == Approx(490.3325));
  CHECK(f.tensile[0].resilience == Approx(0.622));
  CHECK(f.shear_rigidity == Approx(48.2655).epsilon(1e-5));
  CHECK(f.shear_friction == Approx(0.433944).epsilon(1e-5));
  CHECK(f.shear_friction_5 == Approx(0.879166).epsilon(1e-5));
  CHECK(f.bending_rigidity[0] == Approx(1.3308e-5).epsilon(1e-4));
  CHECK(f.bending_friction[0] == Approx(0.000304987).epsilon(1e-5));
  CHECK(f.friction == 0.21);
  CHECK(f.kind == "stated");
  CHECK(f.name == "mine");
}

TEST_CASE("other ways to say a fabric") {
  const design::Fabric linear =
      fabric("{ stretch_warp = 2000 N/m, stretch_weft = 1000 N/m, shear = 40 N/m, color = \"#ff0080\" }");
  CHECK(linear.tensile[0].linearity == 1);
  CHECK(linear.tensile[0].max_force / linear.tensile[0].max_strain == Approx(2000));
  CHECK(linear.tensile[1].max_force / linear.tensile[1].max_strain == Approx(1000));
  CHECK(linear.shear_rigidity == 40);
  CHECK(linear.color[0] == 1);
  CHECK(linear.color[2] == Approx(128 / 255.0));
  const design::Fabric stiff = fabric("fabrics.denim with { bend_warp = 3 * fabrics.denim.bend_warp }");
  CHECK(stiff.bending_rigidity[0] == Approx(3 * 5.884e-5).epsilon(1e-4));
  CHECK(stiff.bending_rigidity[1] == Approx(3.4323e-5).epsilon(1e-4));
  CHECK(stiff.areal_density == Approx(0.407));
  // WT alone gives LT.
  CHECK(fabric("{ EM = 5%, WT = 8.5 gf*cm/cm^2 }").tensile[0].linearity == Approx(0.68));
  CHECK(fabric("fabrics.poplin", "mine.stretch_warp = 2000 N/m\n").tensile[0].linearity == 1);
}

TEST_CASE("what a fabric may not be") {
  const std::string head = "use fabrics\nfabric mine = ";
  refuses(head + "{ «BB» = 1 gf*cm^2/cm }\n", "G0311");
  refuses(head + "fabrics.denim with { «bend_wrap» = 1e-5 N*m }\n", "G0311", "did you mean `bend_warp`?");
  refuses(head + "{ W = «0.2» }\n", "G0308", "0.2 g/m^2");
  refuses(head + "{ W = «200 kg/m^2» }\n", "G0309", "5000 g/m^2");
  refuses(head + "{ B = 0.1 gf*cm^2/cm, «bend_warp» = 1e-5 N*m }\n", "G0314");
  refuses(head + "{ stretch_warp = «2000 N/m», EM_warp = 5% }\n", "G0314");
  refuses(head + "{ color = «\"red\"» }\n", "G0309", "#rrggbb");
  refuses(head + "«3 cm»\n", "G0306");
  refuses(head + "{ EM = 5%, WT = «100 gf*cm/cm^2» }\n", "G0309", "LT");
  const Trial odd(head + "{ W = 200 g/m^2, T = 0.5 mm, G = 40 N/m, B = 1e-5 N*m, EM = 5%, LT = 0.8, WT = 5 "
                         "gf*cm/cm^2 }\n");
  CHECK(odd.result.ok());
  REQUIRE(odd.result.diagnostics.size() == 1);
  CHECK(odd.result.diagnostics[0].code == "G0329");
}

TEST_CASE("the library's fabrics are those of the table") {
  const std::string path = std::string(GARMENT_DATA_DIR) + "/tables/fabrics_si.csv";
  const auto text = system_host().read_file(path, 1 << 20);
  if (!text) {
    WARN("skipped: " << path << " is not there");
    return;
  }
  const std::map<std::string, std::string> names = {{"JTE_B", "wool_tropical"},
                                                    {"JTE_C", "polyester_tropical"},
                                                    {"FAST_LAB_WOOL", "plain_wool"},
                                                    {"HESC_MW_MEAN", "wool_suiting"},
                                                    {"HESC_MS_MEAN", "summer_suiting"},
                                                    {"TYP_POPLIN", "poplin"},
                                                    {"TYP_DENIM12", "denim"},
                                                    {"TYP_LINEN", "linen"},
                                                    {"TYP_HABOTAI8", "habotai"},
                                                    {"TYP_SATIN19", "satin"},
                                                    {"TYP_LINING", "lining"},
                                                    {"TYP_BEMBERG", "bemberg"},
                                                    {"TYP_HAIRCANVAS", "hair_canvas"},
                                                    {"TYP_FUSIBLE_W", "fusible"},
                                                    {"TYP_FELT_UC", "felt"},
                                                    {"TYP_FLANNEL", "flannel"},
                                                    {"TYP_GABARDINE", "gabardine"}};
  int seen = 0;
  std::string line;
  for (char c : *text.value + "\n") {
    if (c != '\n') {
      line += c;
      continue;
    }
    std::vector<std::string> cells(1);
    for (char d : line) {
      if (d == ',')
        cells.emplace_back();
      else
        cells.back() += d;
    }
    line.clear();
    if (!names.contains(cells[0])) continue;
    ++seen;
    INFO(cells[0]);
    const design::Fabric f = fabric("fabrics." + names.at(cells[0]));
    auto same = [&](std::size_t k, double value) {
      if (!cells[k].empty()) CHECK(value == Approx(std::stod(cells[k])).epsilon(1e-4));
    };
    same(1, f.areal_density);
    same(2, f.thickness);
    same(3, f.tensile[0].max_force / f.tensile[0].max_strain);
    same(4, f.tensile[1].max_force / f.tensile[1].max_strain);
    same(5, f.shear_rigidity);
    same(6, f.shear_friction);
    same(7, f.shear_friction_5);
    same(8, f.bending_rigidity[0]);
    same(9, f.bending_rigidity[1]);
    same(10, f.bending_friction[0]);
    same(11, f.bending_friction[1]);
    CHECK_FALSE(f.source.empty());
    CHECK((f.kind == "class-typical") == (cells[0].substr(0, 4) == "TYP_"));
  }
  CHECK(seen == static_cast<int>(names.size()));
}

TEST_CASE("expectations are judged on the drape") {
  const ExpectResult low = ask("expect strain(all) < 8%");
  CHECK(low.passed);
  CHECK(low.found == "6.2%");
  CHECK(low.expected == "< 8%");
  CHECK(low.text == "strain(all) < 8%");
  CHECK(*low.value == Approx(0.062));
  const ExpectResult high = ask("expect strain(cloth) < 4%");
  CHECK_FALSE(high.passed);
  REQUIRE(high.diagnostics.size() == 1);
  CHECK(high.diagnostics[0].code == "G0331");
  CHECK(high.diagnostics[0].labels[0].text == "found 5%, expected < 4%");
  CHECK(ask("expect mass == 305 g within 2%").passed);
  CHECK_FALSE(ask("expect mass == 310 g within 2%").passed);
  CHECK(ask("expect draped.length(cloth.top) == 20 cm within 5 mm").passed);
  CHECK_FALSE(ask("expect draped.length(cloth.top) == 20 cm within 3 mm").passed);
  CHECK(ask("expect position(p).y == 1 m").passed);
  CHECK(ask("expect position(p) == (10 cm, 1 m, 0) within 1 mm").passed);
  CHECK(ask("expect position(cloth.top.end).y == 30 cm").passed);
  CHECK(ask("expect penetrations == 0").passed);
  CHECK(ask("expect energy > 1 J and shear(cloth) < 20 deg").passed);
  CHECK_FALSE(ask("expect clearance < 1 mm").passed);
  CHECK(ask("expect clearance < 1 mm").diagnostics[0].code == "G0325");
  CHECK(ask("expect clearance(cloth) > 1 mm").passed);
  CHECK(ask("expect draped.area(all) > 0.4 m^2").passed);
}

TEST_CASE("expectations are checked for sense before anything is simulated") {
  refuses(kCloth + "expect strain(«cloht») < 8%\n", "G0301", "did you mean `cloth`?");
  refuses(kCloth + "expect «strain(all) < 8 cm»\n", "G0305");
  refuses(kCloth + "expect strain(«p») < 8%\n", "G0306");
  refuses(kCloth + "expect strain(all) < 8% «within 2%»\n", "G0313");
  refuses(kCloth + "expect mass == 300 g «within 2 mm»\n", "G0305");
  refuses(kCloth + "expect «strain(all)»\n", "G0306", "compare");
  refuses(kCloth + "expect draped.«lenght»(cloth.top) < 3 cm\n", "G0311");
}

TEST_CASE("drapes, files, assertions and measures") {
  const Trial trial(kCloth +
                    "drape until rest settle exact\nsave \"a.glb\", \"out/b.svg\"\ndrape for 2 s\nmeasure ss "
                    "= 2 * strain(all)\nmeasure w = "
                    "length(cloth.top)\nassert w > 10 cm \"too small\"\nassert strain(all) < 50%\n");
  INFO(trial.text());
  REQUIRE(trial.result.ok());
  REQUIRE(trial.result.acts.size() == 5);
  CHECK(std::get<DrapeAct>(trial.result.acts[0].act).settle == simulator::Settle::exact);
  CHECK(std::get<SaveAct>(trial.result.acts[1].act).paths == std::vector<std::string>{"a.glb", "out/b.svg"});
  CHECK(std::get<DrapeAct>(trial.result.acts[2].act).duration == 2);
  Trial again(kCloth + "measure ss = 2 * strain(all)\nmeasure tt = ss + 1%\n");
  REQUIRE(again.result.acts.size() == 2);
  const MeasureResult s = evaluate_measure(again.result, again.result.acts[1], Drape());
  CHECK(*s.measure.value == Approx(0.134));
  CHECK(trial.result.measures.size() == 1);
  CHECK(trial.result.measures[0].unit == "m");

  refuses(kCloth + "measure w = length(cloth.top)\nassert «w > 30 cm» \"too small\"\n", "G0320", "too small");
  refuses("assert «1 == 2»\n", "G0320");
  refuses("«drape»\n", "G0312");
  refuses("drape until «dawn»\n", "G0313");
  refuses("drape until rest settle «exactly»\n", "G0313");
  refuses("drape for «2»\n", "G0308");
  refuses("save «\"../x.glb\"»\n", "G0328");
  refuses("save «\"/x.glb\"»\n", "G0328");
  refuses("save «\"x\"»\n", "G0309", "extension");
  refuses("garment «2» \"x\"\n", "G0323");
  refuses("garment 1\n«garment» 1\n", "G0314");
}

TEST_CASE("nothing a script says can hang or crash the evaluation") {
  std::string deep = "let a = 1";
  for (int k = 0; k < 150; ++k) deep += " + 1";
  accepts(Trial(deep + "\n"));
  std::string chain = "let x_0 = 1\n";
  for (int k = 3000; k > 0; --k)
    chain += "let x_" + std::to_string(k) + " = x_" + std::to_string(k - 1) + "\n";
  const Trial chained(chain);
  CHECK_FALSE(chained.result.ok());
  CHECK(chained.result.diagnostics[0].code == "G0316");
  const Trial work("fn f(n) = if n < 1 { 0 } else { f(n - 1) + f(n - 1) }\nlet a = f(40)\n");
  REQUIRE(work.result.diagnostics.size() == 1);
  CHECK(work.result.diagnostics[0].code == "G0317");
  const Trial loops("for i in 1 .. 1000 { for j in 1 .. 1000 { assert i > 0 } }\n");
  REQUIRE(loops.result.diagnostics.size() == 1);
  CHECK(loops.result.diagnostics[0].code == "G0327");
  const Trial text(
      "let a = \"xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx\"\nfn d(t, n) = if n < 1 { t } else { d(\"{t}{t}\", n - 1) "
      "}\nlet b = d(a, 60)\n");
  REQUIRE(text.result.diagnostics.size() == 1);
  CHECK(text.result.diagnostics[0].code == "G0326");
}

TEST_CASE("the same script gives the same garment, whatever the order of its declarations") {
  const std::string a = "use fabrics\nfabric f = fabrics.poplin\n";
  const std::string p =
      "panel p of f { outline from (0, 0) { edge b to (w, 0) free; edge s to (0, 2 * w) free; close c free } "
      "}\n";
  const std::string w = "let w = 20 cm\n";
  const Trial one(a + w + p), two(p + w + a);
  REQUIRE(one.result.ok());
  REQUIRE(two.result.ok());
  for (std::size_t k = 0; k < 3; ++k)
    CHECK(one.result.garment.panels[0].edges[k].curve.end() ==
          two.result.garment.panels[0].edges[k].curve.end());
}

TEST_CASE("broken lines give their own error and nothing more") {
  const Trial trial(
      "use fabrics\nlet w = \nlet h = 2 * w\nfabric f = fabrics.poplin\npanel p of f { outline circle((0, "
      "0), w) free }\nseam s_1: p.rim to\n");
  for (const auto& d : trial.result.diagnostics) {
    INFO(trial.text());
    CHECK((d.code[1] == '0' && (d.code[2] == '1' || d.code[2] == '2')));
  }
}
