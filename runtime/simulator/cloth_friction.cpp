#include "runtime/simulator/cloth_friction.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace garment::simulator {
namespace {

std::uint64_t key_of(const Pair& pair, bool is_vertex_triangle) {
  return (is_vertex_triangle ? 0 : std::uint64_t{1} << 63) | (static_cast<std::uint64_t>(pair.a) << 32) |
         static_cast<std::uint64_t>(pair.b);
}

}  // namespace

ClothFriction::ClothFriction(const model::Model& model, Rubbing rubbing, double give, double most_stiffness)
    : model_(model),
      rubbing_(rubbing),
      give_(give),
      most_stiffness_(most_stiffness),
      idle_(rubbing == Rubbing::stated && model.rub_panels.empty()) {
  if (idle_) return;
  panel_.assign(model.n_particles(), -1);
  for (std::size_t v = 0; v < model.n_vertices(); ++v)
    if (panel_[model.vertex_particle[v]] < 0) panel_[model.vertex_particle[v]] = model.vertex_panel[v];
  const std::size_t n = model.panels.size();
  factor_.assign(n * n, -1);
  for (std::size_t k = 0; k < model.rub_panels.size(); ++k) {
    const auto [a, b] = model.rub_panels[k];
    factor_[a * n + b] = factor_[b * n + a] = model.rub_panels_factor[k];
  }
}

double ClothFriction::friction_of(const Contact& contact) const {
  // One side has positive weights, the other negative ones.
  Index a = -1, b = -1;
  for (int k = 0; k < 4; ++k) {
    if (contact.p[k] < 0 || contact.w[k] == 0) continue;
    Index& side = contact.w[k] > 0 ? a : b;
    if (side < 0) side = panel_[contact.p[k]];
  }
  const double stated = a < 0 || b < 0 ? -1 : factor_[static_cast<std::size_t>(a) * model_.panels.size() + b];
  if (stated >= 0) return stated;
  return rubbing_ == Rubbing::all ? contact.friction : 0;
}

void ClothFriction::begin(const ContactMesh& mesh, const Candidates& candidates, const std::vector<Contact>& contacts,
                          double k) {
  if (idle_) return;
  before_.swap(touches_);
  touches_.clear();
  const auto edges = static_cast<Index>(candidates.begin(PairKind::cloth_ee));
  for (const Contact& c : contacts) {
    if (c.body || std::any_of(c.p.begin(), c.p.end(), [&](Index p) { return p >= mesh.n_particles; })) continue;
    const double mu = friction_of(c), force = -c.share * contact_energy(c.distance, c.contact_distance, k).first;
    if (!(mu * force > 0)) continue;
    Touch t;
    t.key = key_of(candidates.pairs()[c.pair], c.pair < edges);
    t.p = c.p;
    t.w = c.w;
    t.normal = c.normal;
    t.gap = c.distance * c.normal;
    t.limit = mu * force;
    t.stiffness = std::clamp(t.limit / give_, kLeastAnchorStiffness, most_stiffness_);
    touches_.push_back(t);
  }
  std::sort(touches_.begin(), touches_.end(), [](const Touch& a, const Touch& b) { return a.key < b.key; });
  auto old = before_.begin();
  for (Touch& t : touches_) {
    while (old != before_.end() && old->key < t.key) ++old;
    if (old == before_.end() || old->key != t.key) continue;
    t.stretch = old->stretch - old->stretch.dot(t.normal) * t.normal;
    const double most = t.limit / t.stiffness, size = t.stretch.norm();
    if (size > most) t.stretch *= most / size;
  }
}

Vector3d ClothFriction::stretch(const Touch& t, const std::vector<Vector3d>& x) const {
  Vector3d moved = -t.gap;
  for (int k = 0; k < 4; ++k)
    if (t.p[k] >= 0 && t.w[k] != 0) moved += t.w[k] * x[t.p[k]];
  return t.stretch + moved - moved.dot(t.normal) * t.normal;
}

double ClothFriction::energy(const std::vector<Vector3d>& x) const {
  double sum = 0;
  for (const Touch& t : touches_) {
    const double u = stretch(t, x).norm(), sticking = t.limit / t.stiffness;
    sum += u <= sticking ? 0.5 * t.stiffness * u * u : t.limit * (u - 0.5 * sticking);
  }
  return sum;
}

void ClothFriction::add_force(const std::vector<Vector3d>& x, std::vector<Vector3d>& force, BlockMatrix* matrix,
                              std::vector<ContactStiffness>* stiffness) const {
  for (const Touch& t : touches_) {
    const Vector3d u = stretch(t, x);
    const double size = u.norm();
    const bool slips = t.stiffness * size > t.limit;
    const double k = slips ? t.limit / size : t.stiffness;
    for (int a = 0; a < 4; ++a)
      if (t.p[a] >= 0 && t.w[a] != 0) force[t.p[a]] -= k * t.w[a] * u;
    if (!matrix) continue;
    const Vector3d along = size > 0 ? Vector3d(u / size) : t.normal.unitOrthogonal(), across = t.normal.cross(along);
    for (const auto& [way, share] : {std::pair{along, slips ? kSlipShare : 1.0}, std::pair{across, 1.0}}) {
      ContactStiffness s{{-1, -1, -1, -1}, {0, 0, 0, 0}, way.cast<float>(), static_cast<float>(share * k)};
      for (int a = 0; a < 4; ++a) {
        if (t.p[a] < 0 || t.w[a] == 0) continue;
        s.particle[a] = t.p[a];
        s.weight[a] = static_cast<float>(t.w[a]);
        matrix->add_diagonal(static_cast<std::size_t>(t.p[a]), Eigen::Matrix3d(share * k * t.w[a] * t.w[a] * way * way.transpose()));
      }
      stiffness->push_back(s);
    }
  }
}

double ClothFriction::follow(const std::vector<Vector3d>& x) {
  double heat = 0;
  for (Touch& t : touches_) {
    const Vector3d u = stretch(t, x);
    const double size = u.norm(), sticking = t.limit / t.stiffness;
    t.stretch = u;
    if (size <= sticking) continue;
    heat += t.limit * (size - sticking);
    t.stretch *= sticking / size;
  }
  return heat;
}

}  // namespace garment::simulator
