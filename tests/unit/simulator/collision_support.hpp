#pragma once
// Sheets, balls and random numbers for the tests of contact.
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "runtime/body/body.hpp"
#include "runtime/simulator/contact_mesh.hpp"
#include "tests/support/grid_model.hpp"

namespace garment::test {

using Eigen::Vector3d;
using model::Index;
using model::Indices;

/// xorshift64*: the same numbers everywhere.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed * 0x9E3779B97F4A7C15ull + 1) {}
  double uniform(double low, double high) {
    state_ ^= state_ >> 12;
    state_ ^= state_ << 25;
    state_ ^= state_ >> 27;
    return low + (high - low) * static_cast<double>((state_ * 0x2545F4914F6CDD1Dull) >> 11) * 0x1p-53;
  }
  Vector3d vector(double size) { return {uniform(-size, size), uniform(-size, size), uniform(-size, size)}; }

 private:
  std::uint64_t state_;
};

inline model::Model sheet(int nx, int ny, double h, double thickness = 1e-3) {
  SheetSpec spec;
  spec.nx = nx;
  spec.ny = ny;
  spec.h = h;
  spec.thickness = thickness;
  spec.plane = SheetPlane::horizontal;
  return make_sheet(spec);
}

/// Both models side by side in one.
inline model::Model join(const model::Model& a, const model::Model& b) {
  model::Model m = a;
  const auto particles = static_cast<Index>(a.n_particles()), vertices = static_cast<Index>(a.n_vertices());
  auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  append(m.mass, b.mass);
  append(m.start, b.start);
  append(m.thickness, b.thickness);
  append(m.friction, b.friction);
  append(m.vertex_uv, b.vertex_uv);
  for (Index p : b.vertex_particle) m.vertex_particle.push_back(p + particles);
  for (Index p : b.vertex_panel) m.vertex_panel.push_back(p + 1);
  for (const Indices<3>& t : b.triangle)
    m.triangle.push_back({t[0] + vertices, t[1] + vertices, t[2] + vertices});
  return m;
}

/// A closed ball of rings and segments around `center`.
inline body::Body ball(double radius, const Vector3d& center, int rings = 12, int around = 20) {
  body::Body out;
  out.name = "ball";
  auto& v = out.mesh.vertices;
  auto& t = out.mesh.triangles;
  v.emplace_back(center + Vector3d(0, radius, 0));
  for (int i = 1; i < rings; ++i)
    for (int j = 0; j < around; ++j) {
      const double a = std::numbers::pi * i / rings, b = 2 * std::numbers::pi * j / around;
      v.emplace_back(center +
                     radius * Vector3d(std::sin(a) * std::sin(b), std::cos(a), std::sin(a) * std::cos(b)));
    }
  v.emplace_back(center - Vector3d(0, radius, 0));
  const int last = static_cast<int>(v.size()) - 1;
  auto at = [&](int i, int j) { return 1 + (i - 1) * around + j % around; };
  for (int j = 0; j < around; ++j) {
    t.push_back({0, at(1, j), at(1, j + 1)});
    t.push_back({last, at(rings - 1, j + 1), at(rings - 1, j)});
    for (int i = 1; i + 1 < rings; ++i) {
      t.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      t.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  body::build_index(out);
  return out;
}

}  // namespace garment::test
