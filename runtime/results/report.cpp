#include "runtime/results/report.hpp"

#include <nlohmann/json.hpp>

#include "runtime/model/dump.hpp"

namespace garment::results {
namespace {

using Json = nlohmann::ordered_json;

const char* settle_name(simulator::Settle settle) {
  switch (settle) {
    case simulator::Settle::preview:
      return "preview";
    case simulator::Settle::equilibrium:
      return "equilibrium";
    case simulator::Settle::exact:
      return "exact";
  }
  return "";
}

Json hashes(const std::vector<SourceHash>& files) {
  Json out = Json::array();
  for (const SourceHash& f : files) out.push_back({{"name", f.name}, {"sha256", f.sha256}});
  return out;
}

Json parameters(const std::vector<ParameterValue>& values) {
  Json out = Json::array();
  for (const ParameterValue& p : values)
    out.push_back({{"name", p.name}, {"value", p.value}, {"stated", p.stated}});
  return out;
}

Json tension(const Tension& t) { return {{"largest", t.largest}, {"p99", t.p99}}; }

Json panel(const PanelMeasure& m, const PanelStrain& s) {
  Json out = {{"name", m.panel},
              {"mass", m.mass},
              {"flat_area", m.flat_area},
              {"draped_area", m.draped_area},
              {"strain", {{"largest", s.any.largest}, {"p99", s.any.p99}}},
              {"strain_warp", tension(s.warp)},
              {"strain_weft", tension(s.weft)},
              {"largest_shear", s.largest_shear}};
  out["clearance"] =
      m.clearance ? Json{{"least", m.clearance->least}, {"mean", m.clearance->mean}} : Json(nullptr);
  return out;
}

Json seams(const std::vector<SeamMeasure>& all) {
  Json out = Json::array();
  for (const SeamMeasure& s : all)
    out.push_back({{"name", s.seam},
                   {"sewn_length", s.sewn_length},
                   {"draped_length", s.draped_length},
                   {"gap", s.gap}});
  return out;
}

Json ties(const std::vector<TieMeasure>& all) {
  Json out = Json::array();
  for (const TieMeasure& t : all) out.push_back({{"name", t.closure}, {"gap", t.gap}});
  return out;
}

Json findings(const Findings& all) {
  Json out = Json::array();
  for (const Finding& f : all) {
    const char* severity = f.severity == Severity::error     ? "error"
                           : f.severity == Severity::warning ? "warning"
                                                             : "note";
    out.push_back({{"code", f.code}, {"severity", severity}, {"message", f.message}, {"help", f.help}});
  }
  return out;
}

/// Of a drape for a time; null of one to rest.
Json motion(const simulator::MotionReport& m) {
  if (!(m.seconds > 0)) return nullptr;
  const simulator::EnergyBalance& b = m.balance;
  return {{"seconds", m.seconds},
          {"steps", m.steps},
          {"iterations", m.iterations},
          {"least_step", m.least_step},
          {"largest_step", m.largest_step},
          {"stable_step", m.stable_step > 0 ? Json(m.stable_step) : Json(nullptr)},
          {"energy",
           {{"kinetic", b.kinetic},
            {"stored", b.stored},
            {"kinetic_at_start", b.kinetic_start},
            {"stored_at_start", b.stored_start},
            {"work", b.work},
            {"damping", b.damping},
            {"friction", b.friction},
            {"numerical", b.numerical}}}};
}

Json drape(const Report& r) {
  return {{"settle", settle_name(r.settle)},
          {"status", status_name(r.drape.status)},
          {"steps", r.drape.steps},
          {"residual_over_weight", r.drape.residual},
          {"newton_step", r.drape.newton_step},
          {"energy", r.drape.energy},
          {"self_intersections", r.drape.self_intersections},
          {"body_intersections", r.drape.body_intersections},
          {"inside_body", r.drape.inside_body},
          {"symmetric", r.drape.symmetric},
          {"motion", motion(r.drape.motion)},
          {"findings", findings(r.drape.findings)}};
}

Json expects(const std::vector<ExpectOutcome>& all) {
  Json out = Json::array();
  for (const ExpectOutcome& e : all)
    out.push_back({{"text", e.text},
                   {"value", e.value ? Json(*e.value) : Json(nullptr)},
                   {"shown", e.shown},
                   {"expected", e.expected},
                   {"passed", e.passed}});
  return out;
}

Json stated_measures(const std::vector<MeasureOutcome>& all) {
  Json out = Json::array();
  for (const MeasureOutcome& m : all)
    out.push_back({{"name", m.name},
                   {"value", m.value ? Json(*m.value) : Json(nullptr)},
                   {"unit", m.unit},
                   {"shown", m.shown}});
  return out;
}

Json solves(const std::vector<SolveOutcome>& all) {
  Json out = Json::array();
  for (const SolveOutcome& s : all)
    out.push_back({{"name", s.name},
                   {"value", s.value},
                   {"shown", s.shown},
                   {"residual", s.residual},
                   {"shown_residual", s.shown_residual},
                   {"bound", s.bound.empty() ? Json(nullptr) : Json(s.bound)}});
  return out;
}

Json outputs(const std::vector<OutputFile>& all) {
  Json out = Json::array();
  for (const OutputFile& f : all) out.push_back({{"name", f.name}, {"bytes", f.bytes}, {"sha256", f.sha256}});
  return out;
}

Json timings(const Report& r) {
  Json phases = Json::object();
  double total = 0;
  for (const PhaseTime& p : r.phases) {
    phases[p.phase] = phases.value(p.phase, 0.0) + p.seconds;
    total += p.seconds;
  }
  return {{"seconds", std::move(phases)}, {"total_seconds", total}, {"peak_memory_bytes", r.peak_memory}};
}

}  // namespace

const char* status_name(simulator::DrapeStatus status) {
  switch (status) {
    case simulator::DrapeStatus::at_rest:
      return "at rest";
    case simulator::DrapeStatus::interrupted:
      return "interrupted";
    case simulator::DrapeStatus::not_settled:
      return "not settled";
    case simulator::DrapeStatus::tangled:
      return "tangled";
    case simulator::DrapeStatus::diverged:
      return "diverged";
    case simulator::DrapeStatus::ran:
      return "ran for its time";
    case simulator::DrapeStatus::not_resumed:
      return "not resumed";
  }
  return "";
}

void fill_results(Report& report, const model::Model& model, const model::State& state,
                  const std::vector<body::Body>& bodies) {
  report.particles = model.n_particles();
  report.triangles = model.n_triangles();
  report.strain = measure_strain(model, state);
  report.measures = measure(model, state, bodies);
  report.state_hash = model::hash_text(model::state_hash(state));
}

std::string report_json(const Report& r) {
  Json panels = Json::array();
  for (std::size_t p = 0; p < r.measures.panels.size() && p < r.strain.panels.size(); ++p)
    panels.push_back(panel(r.measures.panels[p], r.strain.panels[p]));
  Json garment = panel(r.measures.all, r.strain.all);
  garment.erase("name");
  const Json out = {{"schema", kReportSchema},
                    {"program", {{"name", "garment"}, {"version", GARMENT_VERSION}}},
                    {"title", r.title},
                    {"script", r.script},
                    {"sources", hashes(r.sources)},
                    {"library", hashes(r.library)},
                    {"parameters", parameters(r.parameters)},
                    {"particles", r.particles},
                    {"triangles", r.triangles},
                    {"drape", drape(r)},
                    {"garment", std::move(garment)},
                    {"panels", std::move(panels)},
                    {"seams", seams(r.measures.seams)},
                    {"ties", ties(r.measures.ties)},
                    {"solves", solves(r.solves)},
                    {"measures", stated_measures(r.stated_measures)},
                    {"expects", expects(r.expects)},
                    {"outputs", outputs(r.outputs)},
                    {"state_hash", r.state_hash},
                    {"timings", timings(r)}};
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace garment::results
