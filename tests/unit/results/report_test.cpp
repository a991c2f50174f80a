#include "runtime/results/report.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/support/grid_model.hpp"

using namespace garment;
using nlohmann::json;

namespace {

results::Report sample() {
  test::SheetSpec spec;
  spec.nx = 5;
  spec.ny = 6;
  const model::Model m = test::make_sheet(spec);
  model::State s;
  s.position = m.start;
  s.velocity.assign(m.n_particles(), model::Vector3d::Zero());
  results::Report r;
  r.title = "a \"quoted\" title";
  r.script = "skirt.garment";
  r.sources = {{"skirt.garment", "00"}};
  r.parameters = {{"long", "58 cm", true}};
  r.drape.status = simulator::DrapeStatus::at_rest;
  r.drape.steps = 12;
  r.drape.residual = 0.04;
  r.stated_measures = {{"hem", 0.58, "m", "58 cm"}, {"title", {}, "", "\"skirt\""}};
  r.expects = {{"expect strain(all) < 8%", 0.031, "3.1 %", "< 8 %", true},
               {"expect mass < 1 kg", {}, "", "", false}};
  r.phases = {{"model", 0.5}, {"drape", 2.0}, {"drape", 1.0}};
  results::fill_results(r, m, s, {});
  return r;
}

}  // namespace

TEST_CASE("the report holds what was measured", "[report]") {
  const json j = json::parse(results::report_json(sample()));
  CHECK(j["schema"] == results::kReportSchema);
  CHECK(j["program"]["version"] == GARMENT_VERSION);
  CHECK(j["particles"] == 30);
  CHECK(j["triangles"] == 40);
  CHECK(j["drape"]["status"] == "at rest");
  CHECK(j["drape"]["residual_over_weight"] == 0.04);
  CHECK(j["panels"].size() == 1);
  CHECK(j["garment"]["strain"]["largest"].get<double>() < 1e-12);
  CHECK(j["garment"]["clearance"].is_null());
  CHECK(j["measures"][0] == json{{"name", "hem"}, {"value", 0.58}, {"unit", "m"}, {"shown", "58 cm"}});
  CHECK(j["measures"][1]["value"].is_null());
  CHECK(j["expects"][0]["value"] == 0.031);
  CHECK(j["expects"][1]["value"].is_null());
  CHECK(j["state_hash"].get<std::string>().size() == 16);
  CHECK(j["timings"]["seconds"]["drape"] == 3.0);
}

TEST_CASE("runs differ in their timings only", "[report]") {
  results::Report a = sample(), b = sample();
  b.phases[0].seconds = 9;
  b.peak_memory = 123;
  json x = json::parse(results::report_json(a)), y = json::parse(results::report_json(b));
  CHECK(x != y);
  x.erase("timings");
  y.erase("timings");
  CHECK(x == y);
}

TEST_CASE("text that is not UTF-8 does not break the report", "[report]") {
  results::Report r = sample();
  r.title = "bad \xff byte";
  CHECK(json::parse(results::report_json(r))["schema"] == 1);
}
