#include "runtime/simulator/drape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "runtime/base/number.hpp"
#include "runtime/simulator/certificate.hpp"
#include "runtime/simulator/relaxation.hpp"

namespace garment::simulator {
namespace {

using Eigen::Vector3d;
using Vectors = std::vector<Vector3d>;

constexpr double kSoftTensile = 0.1;       // share of the tensile stiffness in the first settling (continuation)
constexpr double kSoftResidual = 0.5;      // residual at which the true stiffness comes in
constexpr int kSoftSteps = 60;
constexpr double kRestStep = 0.5e-3;       // m, largest Newton step of a garment at rest
constexpr double kRestTimeStep = 0.25;     // s, the step is judged with little regularisation only
constexpr int kDressingSteps = 600;
constexpr int kDressingCheck = 5;          // steps between two looks whether everything is free
constexpr double kExtraOffset = 1e-3;      // m, by which a particle of a pierced part is pushed farther, each look
constexpr double kMostExtraOffset = 20e-3; // m

double target_residual(Settle settle) {
  switch (settle) {
    case Settle::preview: return 0.3;
    case Settle::equilibrium: return 0.05;
    case Settle::exact: return 1e-6;
  }
  return 0.05;
}

bool all_finite(const Vectors& x) {
  return std::all_of(x.begin(), x.end(), [](const Vector3d& p) { return p.allFinite(); });
}

/// What the loops of one drape share.
struct Drape {
  const model::Model& model;
  const std::vector<body::Body>& bodies;
  const DrapeSettings& settings;
  DrapeReport& report;
  Vectors x;

  bool stop_asked() const { return settings.interrupted && settings.interrupted(); }
  void tell(const StepReport& step, const char* phase) const {
    if (!settings.progress) return;
    settings.progress({report.steps, x.size(), step.residual, target_residual(settings.settle), step.largest_motion, phase});
  }
};

double largest_spring_strain(const model::Model& model, const Vectors& x) {
  double worst = 0;
  for (std::size_t s = 0; s < model.spring.size(); ++s)
    worst = std::max(worst, (x[model.spring[s][0]] - x[model.spring[s][1]]).norm() / model.spring_rest[s] - 1);
  for (std::size_t m = 0; m < model.membrane.size(); ++m) {
    const auto& w = model.membrane_weights[m];
    Vector3d u = Vector3d::Zero(), v = Vector3d::Zero();
    for (int k = 0; k < 3; ++k) {
      u += w[k] * x[model.membrane[m][k]];
      v += w[3 + k] * x[model.membrane[m][k]];
    }
    worst = std::max({worst, u.norm() - 1, v.norm() - 1});
  }
  return worst;
}

/// Names of the panels that hold the particles of a tangle, for messages.
std::string panels_of(const model::Model& model, const ContactMesh& mesh, const Tangle& tangle, OriginId& origin) {
  std::vector<bool> hit(model.n_particles(), false);
  auto mark = [&](Index p) {
    if (p >= 0 && p < mesh.n_particles) hit[p] = true;
  };
  for (const EdgeHit& h : tangle.hits) {
    for (Index p : mesh.edge[h.edge]) mark(p);
    for (Index p : mesh.triangle[h.triangle]) mark(p);
  }
  for (std::size_t i = 0; i < tangle.inside.size(); ++i)
    if (tangle.inside[i]) hit[i] = true;
  std::map<Index, int> count;
  for (std::size_t v = 0; v < model.n_vertices(); ++v)
    if (hit[model.vertex_particle[v]]) ++count[model.vertex_panel[v]];
  std::string names;
  int most = 0;
  for (auto [panel, n] : count) {
    names += (names.empty() ? "`" : ", `") + model.panels[panel].name + "`";
    if (n > most) most = n, origin = model.panels[panel].origin;
  }
  return names.empty() ? "the garment" : names;
}

/// Brings a tangled or penetrating start onto the body: seams contract, bodies push out, cloth that cuts cloth is taken
/// apart. Returns true when nothing cuts anything any more.
bool dress(Drape& d, const ContactMesh& walls) {
  RelaxationSettings settings;
  settings.self_collision = d.settings.self_collision;
  settings.bodies_are_walls = false;
  settings.body_offset = 3e-3;
  settings.gravity_scale = 0;
  Relaxation relaxation(d.model, d.bodies, settings);
  relaxation.set_tensile_scale(kSoftTensile);
  static const std::vector<body::Body> kNoBodies;
  if (settings.self_collision) relaxation.set_tangle(find_tangle(relaxation.mesh(), kNoBodies, d.x));
  bool weighted = false;
  for (int k = 1; k <= kDressingSteps; ++k) {
    if (d.stop_asked()) return false;
    StepReport step = relaxation.step(d.x);
    ++d.report.steps;
    d.tell(step, "dressing");
    if (!all_finite(d.x)) return false;
    if (k % kDressingCheck != 0) continue;
    double strain = largest_spring_strain(d.model, d.x);
    if (!weighted && strain < 0.3) {
      relaxation.set_gravity_scale(1);
      weighted = true;
    }
    Tangle tangle = find_tangle(walls, d.bodies, d.x);
    if (tangle.empty()) return true;
    if (strain > 0.5 && k < kDressingSteps / 2) continue;
    for (const EdgeHit& h : tangle.hits)
      for (Index p : {walls.edge[h.edge][0], walls.edge[h.edge][1], walls.triangle[h.triangle][0],
                      walls.triangle[h.triangle][1], walls.triangle[h.triangle][2]})
        if (!walls.is_body(p) && (walls.is_body(walls.edge[h.edge][0]) || walls.is_body(walls.triangle[h.triangle][0])))
          relaxation.extra_offset()[p] = std::min(kMostExtraOffset, relaxation.extra_offset()[p] + kExtraOffset);
  }
  return false;
}

/// Settles an intersection-free garment to rest. Nothing is allowed to pass anything.
DrapeStatus settle(Drape& d) {
  RelaxationSettings settings;
  settings.self_collision = d.settings.self_collision;
  Relaxation relaxation(d.model, d.bodies, settings);
  relaxation.set_tensile_scale(kSoftTensile);
  bool soft = true;
  int soft_steps = 0, refused = 0;
  double target = target_residual(d.settings.settle);
  while (d.report.steps < d.settings.max_steps) {
    if (d.stop_asked()) return DrapeStatus::interrupted;
    Vectors before = d.x;
    StepReport step = relaxation.step(d.x);
    ++d.report.steps;
    if (!all_finite(d.x)) {
      d.x = std::move(before);
      return DrapeStatus::diverged;
    }
    d.tell(step, "settling");
    d.report.newton_step = step.newton_step;
    if (soft && (step.residual < std::max(kSoftResidual, target) || ++soft_steps > kSoftSteps)) {
      relaxation.set_tensile_scale(1);
      relaxation.set_time_step(1.0 / 60);
      soft = false;
      continue;
    }
    bool judged = step.time_step >= kRestTimeStep;
    if (!soft && step.residual <= target && (judged || d.settings.settle == Settle::preview) &&
        (step.newton_step < kRestStep || d.settings.settle == Settle::preview)) {
      d.x = std::move(before);  // the state that was judged
      return DrapeStatus::at_rest;
    }
    refused = step.accepted ? 0 : refused + 1;
    if (refused > 6) return DrapeStatus::not_settled;
  }
  return DrapeStatus::not_settled;
}

void explain(Drape& d, const ContactMesh& walls) {
  Findings& findings = d.report.findings;
  if (d.report.status == DrapeStatus::tangled) {
    Tangle tangle = find_tangle(walls, d.bodies, d.x);
    OriginId origin;
    std::string names = panels_of(d.model, walls, tangle, origin);
    findings.push_back({"G0801", Severity::error,
                        fmt::format("{} could not be freed: {} places cut cloth or body, {} particles lie inside a body",
                                    names, tangle.hits.size(), tangle.n_inside),
                        {{origin, "the panel with most of them"}},
                        "place the panels farther from the body and from each other, or in the order in which they are worn"});
  }
  if (d.report.status == DrapeStatus::not_settled)
    findings.push_back({"G0802", Severity::error,
                        fmt::format("after {} steps the residual is {} of the weight, {} is rest", d.report.steps,
                                    format_number(d.report.residual, 3),
                                    format_number(target_residual(d.settings.settle), 3)),
                        {},
                        "a garment without support falls for ever: attach or pin it; or allow more steps"});
  if (d.report.status == DrapeStatus::diverged)
    findings.push_back({"G0803", Severity::error, "the positions became infinite; the last finite state was kept", {},
                        "check the fabric for extreme stiffness or density, and the resolution"});
}

}  // namespace

DrapeReport drape(const model::Model& model, const std::vector<body::Body>& bodies, model::State& state,
                  const DrapeSettings& settings) {
  DrapeReport report;
  Drape d{model, bodies, settings, report, state.position.empty() ? model.start : state.position};
  ContactMesh walls(model, bodies, ContactOptions{settings.self_collision, 0, 0});
  bool free = find_tangle(walls, bodies, d.x).empty();
  if (!free) free = dress(d, walls);
  if (free)
    report.status = settle(d);
  else
    report.status = d.stop_asked() ? DrapeStatus::interrupted : DrapeStatus::tangled;

  RelaxationSettings as_written;
  as_written.self_collision = settings.self_collision;
  as_written.bodies_are_walls = free;
  Relaxation judge(model, bodies, as_written);
  Vectors force;
  report.residual = judge.residual(d.x, force);
  report.energy = judge.energy(d.x);
  state.position = d.x;
  state.velocity.assign(d.x.size(), Vector3d::Zero());
  Certificate certificate = certify(model, state, bodies);
  report.self_intersections = certificate.self_intersections;
  report.body_intersections = certificate.body_intersections;
  report.inside_body = certificate.inside_body;
  if (!certificate.clean() && report.status == DrapeStatus::at_rest) report.status = DrapeStatus::tangled;
  explain(d, walls);
  return report;
}

}  // namespace garment::simulator
