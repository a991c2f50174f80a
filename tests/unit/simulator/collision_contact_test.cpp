// Active contacts and their energy.
#include <catch2/catch.hpp>

#include "runtime/base/parallel.hpp"
#include "runtime/simulator/contact.hpp"
#include "tests/unit/simulator/collision_support.hpp"

using namespace garment;
using namespace garment::simulator;
using garment::test::Random;

namespace {

constexpr double kContactStiffness = 50;

double energy(const ContactMesh& mesh, const Candidates& candidates, const std::vector<Vector3d>& x,
              const std::vector<float>& shares) {
  std::vector<Contact> contacts;
  active_contacts(mesh, candidates, x, contacts, &shares);
  double sum = 0;
  for (const Contact& c : contacts)
    sum += c.share * contact_energy(c.distance, c.contact_distance, kContactStiffness).value;
  return sum;
}

/// Two sheets, the upper one `gap` above the lower one, turned and shifted so that nothing lies on a grid
/// line.
model::Model stacked(double gap, double thickness) {
  const model::Model a = test::sheet(9, 9, 0.01, thickness), b = test::sheet(6, 6, 0.01, thickness);
  model::Model m = test::join(a, b);
  for (std::size_t i = a.n_particles(); i < m.n_particles(); ++i) {
    const Vector3d p = m.start[i];
    m.start[i] = {0.011 + 0.96 * p[0] + 0.28 * p[2] + 0.012, gap, -0.0113 + 0.96 * p[2] - 0.28 * p[0]};
  }
  return m;
}

}  // namespace

TEST_CASE("a flat sheet at rest touches nothing, however thick", "[collision]") {
  for (double thickness : {0.0005, 0.005, 0.02, 0.1}) {
    const model::Model m = test::sheet(12, 12, 0.005, thickness);
    const ContactMesh mesh(m, {}, {.self_minimum = 0.002});
    Candidates candidates;
    candidates.rebuild(mesh, m.start, 0.02);
    CHECK(candidates.pairs().size() > 100);
    std::vector<Contact> contacts;
    active_contacts(mesh, candidates, m.start, contacts);
    CHECK(contacts.empty());
  }
}

TEST_CASE("slivers at rest touch nothing either", "[collision]") {
  model::Model m = test::sheet(8, 8, 0.005, 0.01);
  for (auto& uv : m.vertex_uv) uv[1] *= 0.2;  // angles of 11 degrees
  for (Vector3d& p : m.start) p[2] *= 0.2;
  const ContactMesh mesh(m, {});
  Candidates candidates;
  candidates.rebuild(mesh, m.start, 0.02);
  std::vector<Contact> contacts;
  active_contacts(mesh, candidates, m.start, contacts);
  CHECK(contacts.empty());
}

TEST_CASE("a particle above flat cloth is pushed off it, wherever it is, without jumps", "[collision]") {
  const model::Model a = test::sheet(7, 7, 0.01, 0.002);
  model::Model b = test::sheet(2, 2, 0.5, 0.002);  // one corner of a huge sheet that stands on its tip
  model::Model m = test::join(a, b);
  const auto tip = a.n_particles();
  const ContactMesh mesh(m, {});
  auto pushed = [&](const std::vector<Contact>& contacts) {
    Vector3d force = Vector3d::Zero();
    for (const Contact& c : contacts)
      for (int k = 0; k < 4; ++k)
        if (c.p[k] == static_cast<Index>(tip))
          force -= c.share * c.w[k] * contact_energy(c.distance, c.contact_distance, kContactStiffness).first * c.normal;
    return force;
  };
  auto force_at = [&](const Vector3d& place) {
    std::vector<Vector3d> x = m.start;
    x[tip] = place;
    x[tip + 1] = place + Vector3d(0.3, 0.4, 0);
    x[tip + 2] = place + Vector3d(-0.3, 0.4, 0);
    x[tip + 3] = place + Vector3d(0, 0.8, 0);
    Candidates candidates;
    candidates.rebuild(mesh, x, 0.004);
    std::vector<Contact> contacts;
    active_contacts(mesh, candidates, x, contacts);
    return pushed(contacts);
  };
  const Vector3d middle = force_at({0.034, 0.001, -0.0365});
  const double alone = -contact_energy(0.001, 0.002, kContactStiffness).first;  // of one triangle
  CHECK(middle.y() == Approx(alone).epsilon(2e-3));
  CHECK(std::abs(middle.x()) + std::abs(middle.z()) < 2e-3 * middle.y());
  // Along a line that crosses edges and runs over a corner.
  Vector3d last = force_at({0.011, 0.001, -0.03});
  for (int n = 1; n <= 20000; ++n) {
    const Vector3d f = force_at({0.011 + 0.038 * n / 20000.0, 0.001, -0.03 - 1e-5 * n / 20000.0});
    CHECK(f.y() > 0.99 * alone);
    CHECK(f.y() < 27 * alone);  // six triangles and thirteen edges at a corner
    CHECK((f - last).norm() < 0.05 * alone);
    last = f;
  }
}

TEST_CASE("the contact energy and its derivatives", "[collision]") {
  const double r = 1e-3, k = 200;
  for (double d : {0.02e-3, 0.1e-3, 0.3e-3, 0.499e-3, 0.501e-3, 0.8e-3, 0.99e-3}) {
    const ContactEnergy e = contact_energy(d, r, k);
    const double step = d * 1e-5;
    const ContactEnergy plus = contact_energy(d + step, r, k), minus = contact_energy(d - step, r, k);
    CHECK(e.first == Approx((plus.value - minus.value) / (2 * step)).epsilon(1e-6));
    CHECK(e.second == Approx((plus.first - minus.first) / (2 * step)).epsilon(1e-6));
    CHECK(e.first < 0);
    CHECK(e.second > 0);
  }
  const double half = 0.5 * r;
  const ContactEnergy below = contact_energy(half * (1 - 1e-12), r, k), above = contact_energy(half, r, k);
  CHECK(below.value == Approx(above.value).epsilon(1e-9));
  CHECK(below.first == Approx(above.first).epsilon(1e-9));
  CHECK(below.second == Approx(above.second).epsilon(1e-9));
  CHECK(contact_energy(r, r, k).value == 0);
  CHECK(contact_energy(2 * r, r, k).first == 0);
  CHECK(contact_energy(1e-8, r, k).value > contact_energy(1e-6, r, k).value);
  CHECK(std::isfinite(contact_energy(0, r, k).value));
}

TEST_CASE("a step's coming contacts are those that it closes, not those that act or that it leaves open", "[collision]") {
  const model::Model m = stacked(0.003, 0.001);  // 3 mm apart, 1 mm thick
  const ContactMesh mesh(m, {});
  Candidates candidates;
  candidates.rebuild(mesh, m.start, 0.02);
  const std::size_t lower = 81;  // particles of the lower sheet
  auto coming = [&](double down) {
    std::vector<Vector3d> dx(m.n_particles(), Vector3d::Zero());
    for (std::size_t i = lower; i < dx.size(); ++i) dx[i] = {0.001, -down, 0};
    std::vector<Contact> contacts;
    coming_contacts(mesh, candidates, m.start, dx, contacts);
    return contacts;
  };
  CHECK(coming(0.0015).empty());
  CHECK(coming(-0.0015).empty());
  const std::vector<Contact> closed = coming(0.0025);
  CHECK(closed.size() >= 36);  // every particle of the upper sheet at least
  for (const Contact& c : closed) {
    CHECK(c.distance >= c.contact_distance);
    double after = c.distance;
    for (int k = 0; k < 4; ++k)
      if (c.p[k] >= static_cast<Index>(lower)) after += c.w[k] * c.normal.dot(Vector3d(0.001, -0.0025, 0));
    CHECK(after < c.contact_distance);
  }
}

TEST_CASE("contact forces are minus the gradient of the contact energy", "[collision]") {
  Random random(8);
  for (int trial = 0; trial < 6; ++trial) {
    const double thickness = trial < 3 ? 0.003 : 0.001;
    model::Model m = stacked(0.6 * thickness, thickness);
    const std::vector<body::Body> bodies{test::ball(0.03, {0.04, -0.0308, -0.04}, 8, 12)};
    std::vector<Vector3d> x = m.start;
    for (Vector3d& p : x) p += random.vector(0.2 * thickness);
    const ContactMesh mesh(m, bodies, {.body_minimum = 0.001});
    Candidates candidates;
    candidates.rebuild(mesh, x, 0.004);
    std::vector<Contact> contacts;
    active_contacts(mesh, candidates, x, contacts);
    REQUIRE(contacts.size() > 20);
    std::vector<float> shares(candidates.pairs().size(), 0.0F);  // those of x, as through one step
    for (const Contact& c : contacts) shares[c.pair] = static_cast<float>(c.share);
    active_contacts(mesh, candidates, x, contacts, &shares);
    std::vector<Vector3d> force(x.size(), Vector3d::Zero());
    double largest = 0;
    for (const Contact& c : contacts) {
      const double slope = c.share * contact_energy(c.distance, c.contact_distance, kContactStiffness).first;
      CHECK(c.w[0] + c.w[1] + c.w[2] + c.w[3] == Approx(0).margin(1e-14));
      CHECK(c.normal.norm() == Approx(1));
      Vector3d gap = Vector3d::Zero();
      for (int k = 0; k < 4; ++k) {
        gap += c.w[k] * mesh.at(x, c.p[k]);
        if (!mesh.is_body(c.p[k])) force[c.p[k]] -= slope * c.w[k] * c.normal;
      }
      CHECK((gap - c.distance * c.normal).norm() < 1e-12);
      CHECK(c.body == (mesh.is_body(c.p[0]) || mesh.is_body(c.p[2])));
    }
    for (const Vector3d& f : force) largest = std::max(largest, f.norm());
    int wrong = 0;
    for (int n = 0; n < 200; ++n) {
      const auto i = static_cast<std::size_t>(random.uniform(0, static_cast<double>(x.size()) - 0.001));
      const int axis = n % 3;
      const double step = 1e-8;
      std::vector<Vector3d> y = x;
      y[i][axis] += step;
      const double plus = energy(mesh, candidates, y, shares);
      y[i][axis] -= 2 * step;
      const double minus = energy(mesh, candidates, y, shares);
      const double expected = -(plus - minus) / (2 * step);
      if (std::fabs(force[i][axis] - expected) > 1e-4 * largest) ++wrong;
    }
    CHECK(wrong == 0);
  }
}

TEST_CASE("contacts are complete and the same for any thread count", "[collision]") {
  const model::Model m = stacked(0.0006, 0.001);
  const std::vector<body::Body> bodies{test::ball(0.03, {0.04, -0.0305, -0.04}, 8, 12)};
  const ContactMesh mesh(m, bodies, {.body_minimum = 0.001});
  Candidates candidates, exact;
  std::vector<Vector3d> x = m.start;
  Random random(9);
  candidates.rebuild(mesh, x, 0.006);
  for (Vector3d& p : x) p += random.vector(1e-4);
  REQUIRE(candidates.complete(mesh, x, nullptr, mesh.largest_contact_distance));
  exact.rebuild(mesh, x, 0.0011);
  std::vector<Contact> one, four, fresh;
  const int before = thread_count();
  set_thread_count(1);
  active_contacts(mesh, candidates, x, one);
  set_thread_count(4);
  active_contacts(mesh, candidates, x, four);
  set_thread_count(before);
  active_contacts(mesh, exact, x, fresh);
  REQUIRE(one.size() == four.size());
  CHECK(one.size() == fresh.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    CHECK(one[i].p == four[i].p);
    CHECK(one[i].w == four[i].w);
    CHECK(one[i].normal == four[i].normal);
    CHECK(one[i].distance == four[i].distance);
    CHECK(one[i].share == four[i].share);
  }
}

TEST_CASE("friction of a contact is the geometric mean of both sides", "[collision]") {
  model::Model m = test::sheet(5, 5, 0.01, 0.001);
  for (double& mu : m.friction) mu = 0.2;
  std::vector<body::Body> bodies{test::ball(0.03, {0.02, -0.0302, -0.02})};
  bodies[0].friction = 0.45;
  const ContactMesh mesh(m, bodies);
  Candidates candidates;
  candidates.rebuild(mesh, m.start, 0.005);
  std::vector<Contact> contacts;
  active_contacts(mesh, candidates, m.start, contacts);
  REQUIRE_FALSE(contacts.empty());
  for (const Contact& c : contacts) {
    CHECK(c.body);
    CHECK(c.friction == Approx(0.3));
  }
}
