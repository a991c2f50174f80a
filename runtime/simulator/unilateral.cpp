#include "runtime/simulator/unilateral.hpp"

#include <algorithm>
#include <cmath>

namespace garment::simulator {
namespace {

using Eigen::Vector3d;
using Vectors = std::vector<Vector3d>;

constexpr int kImpulseSweeps = 200;
constexpr double kStill = 1e-12;      // m/s, change of a speed in a sweep that ends them
constexpr double kBeta = 0.2;         // share of what is too near that is made good in a step
constexpr double kFastestOut = 0.1;   // m/s, at which it is

struct Impulse {
  double inverse_mass = 0;  // sum w^2 / m
  double normal = 0;        // N s
  Vector3d tangential{0, 0, 0};
};

Vector3d speed(const Touching& c, const Vectors& v) {
  Vector3d u = -c.base;
  for (int k = 0; k < 4; ++k)
    if (c.particle[k] >= 0) u += c.weight[k] * v[c.particle[k]];
  return u;
}

}  // namespace

std::vector<Touching> contacts_of(const MovingCloth& cloth, const Vectors& x, double h) {
  std::vector<Touching> out;
  for (const Push& p : cloth.pushes()) {
    Touching c;
    c.particle[0] = static_cast<Index>(p.particle);
    c.weight[0] = 1;
    c.normal = p.normal;
    c.base = cloth.body_velocity(p, x[p.particle], h);
    c.gap = -p.depth(x);
    c.friction = p.friction;
    out.push_back(c);
  }
  for (const Contact& found : cloth.contacts()) {
    Touching c;
    c.particle = found.p;
    c.weight = found.w;
    c.normal = found.normal;
    c.gap = found.distance - found.contact_distance;
    c.friction = found.friction;
    out.push_back(c);
  }
  return out;
}

double part(const model::Model& m, const Holds& holds, const std::vector<Touching>& contacts, double h, Vectors& v) {
  std::vector<Impulse> impulse(contacts.size());
  auto mobile = [&](const Touching& c, int k) { return c.particle[k] >= 0 && !holds.is_fixed(static_cast<std::size_t>(c.particle[k])); };
  for (std::size_t j = 0; j < contacts.size(); ++j)
    for (int k = 0; k < 4; ++k)
      if (mobile(contacts[j], k)) impulse[j].inverse_mass += contacts[j].weight[k] * contacts[j].weight[k] / m.mass[contacts[j].particle[k]];
  auto push = [&](const Touching& c, const Vector3d& p) {
    for (int k = 0; k < 4; ++k)
      if (mobile(c, k)) {
        const auto i = static_cast<std::size_t>(c.particle[k]);
        v[i] += holds.filtered(i, Vector3d(c.weight[k] / m.mass[i] * p));
      }
  };
  std::vector<Vector3d> slip(contacts.size());
  for (std::size_t j = 0; j < contacts.size(); ++j) slip[j] = speed(contacts[j], v);
  for (int sweep = 0; sweep < kImpulseSweeps; ++sweep) {
    double change = 0;
    for (std::size_t j = 0; j < contacts.size(); ++j) {
      const Touching& c = contacts[j];
      Impulse& p = impulse[j];
      if (!(p.inverse_mass > 0)) continue;
      const double aim = c.gap >= 0 ? -c.gap / h : std::min(kBeta * -c.gap / h, kFastestOut);
      const double normal = std::max(0.0, p.normal + (aim - c.normal.dot(speed(c, v))) / p.inverse_mass);
      push(c, (normal - p.normal) * c.normal);
      change = std::max(change, std::abs(normal - p.normal) * p.inverse_mass);
      p.normal = normal;
      Vector3d u = speed(c, v);
      u -= u.dot(c.normal) * c.normal;
      Vector3d tangential = p.tangential - u / p.inverse_mass;
      const double size = tangential.norm(), most = c.friction * p.normal;
      if (size > most) tangential *= most / size;
      push(c, tangential - p.tangential);
      change = std::max(change, (tangential - p.tangential).norm() * p.inverse_mass);
      p.tangential = tangential;
    }
    if (change < kStill) break;
  }
  double heat = 0;
  for (std::size_t j = 0; j < contacts.size(); ++j)
    if (impulse[j].normal > 0) heat -= 0.5 * impulse[j].tangential.dot(slip[j] + speed(contacts[j], v));
  return heat;
}

}  // namespace garment::simulator
