#include "runtime/simulator/cloth_contact.hpp"

#include <algorithm>

namespace garment::simulator {

using Eigen::Matrix3d;
using Eigen::Vector3d;

const std::vector<body::Body>& no_bodies() {
  static const std::vector<body::Body> none;
  return none;
}

double mean_edge(const model::Model& model) {
  double sum = 0;
  std::size_t n = 0;
  for (const auto& t : model.triangle)
    for (int k = 0; k < 3; ++k, ++n) sum += (model.vertex_uv[t[k]] - model.vertex_uv[t[(k + 1) % 3]]).norm();
  return n ? sum / static_cast<double>(n) : 0.01;
}

double largest_thread_strain(const model::Model& model, const std::vector<Vector3d>& x) {
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

void add_contact_forces(const std::vector<Contact>& contacts, double stiffness, std::vector<Vector3d>& force, BlockMatrix* matrix,
                        std::vector<ContactStiffness>& rows) {
  rows.clear();
  const auto n = static_cast<Index>(force.size());
  for (const Contact& c : contacts) {
    const ContactEnergy e = contact_energy(c.distance, c.contact_distance, stiffness);
    ContactStiffness s{{-1, -1, -1, -1}, {0, 0, 0, 0}, c.normal.cast<float>(), static_cast<float>(c.share * e.second)};
    for (int k = 0; k < 4; ++k) {
      if (c.p[k] < 0 || c.p[k] >= n || c.w[k] == 0) continue;
      force[c.p[k]] -= c.share * e.first * c.w[k] * c.normal;
      if (matrix == nullptr) continue;
      s.particle[k] = c.p[k];
      s.weight[k] = static_cast<float>(c.w[k]);
      matrix->add_diagonal(static_cast<std::size_t>(c.p[k]),
                           Matrix3d(c.share * e.second * c.w[k] * c.w[k] * c.normal * c.normal.transpose()));
    }
    if (matrix != nullptr) rows.push_back(s);
  }
}

}  // namespace garment::simulator
