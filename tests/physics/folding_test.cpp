// What is folded at rest: lines that the mesh follows, seams, pleats, slits - from the declared garment to the forces.
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <set>

#include "runtime/base/portable_math.hpp"
#include "runtime/modeller/modeller.hpp"
#include "runtime/modeller/pleats.hpp"
#include "runtime/simulator/certificate.hpp"
#include "runtime/simulator/elastic.hpp"
#include "tests/unit/modeller/built.hpp"
#include "tests/unit/modeller/garments.hpp"

using namespace garment;
using design::Press;
using Eigen::Vector3d;
using test::ironed;
using test::Point2;

namespace {

using Positions = std::vector<Vector3d>;

model::Model built(const design::Garment& g, std::size_t findings = 0) { return test::build(g, findings); }

/// The plane z = 0 folded along the line through `at` with direction `along`: what lies to its left turns to the back.
Vector3d folded(const Vector3d& p, const Point2& at, const Point2& along, double angle) {
  const Point2 t = along.normalized(), left(-t.y(), t.x());
  const double off = (Point2(p.x(), p.y()) - at).dot(left), on = (Point2(p.x(), p.y()) - at).dot(t);
  if (off <= 0) return p;
  const Point2 flat = at + on * t + std::cos(angle) * off * left;
  return {flat.x(), flat.y(), -std::sin(angle) * off};
}

Positions fold_all(const Positions& flat, const Point2& at, const Point2& along, double angle) {
  Positions x;
  for (const Vector3d& p : flat) x.push_back(folded(p, at, along, angle));
  return x;
}

double energy(const model::Model& m, const Positions& x) {
  simulator::ElasticModel elastic(m);
  elastic.follow(x);
  return elastic.energy(x);
}

double mass_of(const model::Model& m) {
  double sum = 0;
  for (double mass : m.mass) sum += mass;
  return sum;
}

}  // namespace

TEST_CASE("a fold at any slant costs nothing where it is folded as ironed") {
  struct Case {
    Point2 from, to;
  };
  for (const Case& c : {Case{{0.083, 0}, {0.083, 0.3}}, Case{{0.08, 0}, {0.08, 0.3}}, Case{{0.03, 0}, {0.17, 0.3}},
                        Case{{0, 0.05}, {0.2, 0.25}}, Case{{0, 0.213}, {0.2, 0.19}}}) {
    for (double angle : {0.5, 2.0}) {
      const model::Model m = built(ironed(c.from, c.to, angle));
      CHECK(mass_of(m) == Approx(0.2 * 0.2 * 0.3).epsilon(1e-12));
      const Point2 along = c.to - c.from;
      const double flat = energy(m, m.start), right = energy(m, fold_all(m.start, c.from, along, angle));
      INFO("line to (" << c.to.x() << ", " << c.to.y() << "), " << angle << " rad");
      CHECK(flat > 1e-5);
      CHECK(right < 1e-9 * flat);
      const double half = energy(m, fold_all(m.start, c.from, along, 0.5 * angle));
      CHECK(half < 0.8 * flat);
      CHECK(energy(m, fold_all(m.start, c.from, along, -0.5 * angle)) > 1.5 * half);
    }
  }
}

TEST_CASE("a slanted fold is as stiff as one along the threads") {
  // One rigidity in all directions; the same length of line.
  std::vector<double> stiffness;
  for (double slope : {0.0, 0.3, 0.7}) {
    const double length = 0.16;
    const Point2 way = length * Point2(std::sin(slope), std::cos(slope)), from = Point2(0.103, 0.147) - 0.5 * way;
    design::Garment g = ironed(from, from + way, 1);
    g.fabrics[0].bending_rigidity = {1e-5, 1e-5};
    g.fabrics[0].twist_rigidity = 0.5e-5;
    const model::Model m = built(g);
    stiffness.push_back(energy(m, m.start));
  }
  CHECK(stiffness[1] == Approx(stiffness[0]).epsilon(0.35));
  CHECK(stiffness[2] == Approx(stiffness[0]).epsilon(0.35));
}

TEST_CASE("a seam is folded at rest as its finish says") {
  for (const auto& [to, sign] : {std::pair{design::Facing::back, 1.0}, std::pair{design::Facing::face, -1.0}}) {
    design::Garment g;
    g.fabrics = {test::cloth()};
    g.panels = {test::rectangle("a", 0.1, 0.2, 0.01), test::rectangle("b", 0.1, 0.2, 0.013, {0.1, 0})};
    g.seams = {test::seam("middle", {test::whole(g, 0, 1)}, {test::whole(g, 1, 3, true)})};
    g.seams[0].finish.fold_angle = 1.5;
    g.seams[0].finish.fold_to = to;
    const model::Model m = built(g);
    CHECK_FALSE(m.fold_fit.empty());
    const double flat = energy(m, m.start);
    CHECK(energy(m, fold_all(m.start, {0.1, 0}, {0, 1}, sign * 1.5)) < 1e-9 * flat);
    CHECK(energy(m, fold_all(m.start, {0.1, 0}, {0, 1}, -sign * 1.5)) > 2 * flat);
  }
}

TEST_CASE("a turned seam knows face from back and holds what is folded over") {
  design::Garment g;
  g.fabrics = {test::cloth()};
  g.panels = {test::rectangle("a", 0.1, 0.2, 0.01), test::rectangle("b", 0.1, 0.2, 0.013, {0.1, 0})};
  g.seams = {test::seam("middle", {test::whole(g, 0, 1)}, {test::whole(g, 1, 3, true)})};
  g.seams[0].finish.turned = true;
  const model::Model m = built(g);
  auto at = [&](double angle) { return energy(m, fold_all(m.start, {0.1, 0}, {0, 1}, angle)); };
  CHECK(at(3.05) < 1e-9 * at(0));
  CHECK(at(2.05) > 0.15 * at(0));  // one radian open
  CHECK(at(-2) > 1.2 * at(2));
}

TEST_CASE("the forces of folds are minus the gradient of their energy, and turn nothing by themselves") {
  const model::Model m = built(ironed({0.03, 0}, {0.17, 0.3}, 2));
  simulator::ElasticModel elastic(m);
  Positions x = fold_all(m.start, {0.03, 0}, {0.14, 0.3}, 1.3), f;
  test::Random random(7);
  for (Vector3d& p : x) p += Vector3d(random(-1, 1), random(-1, 1), random(-1, 1)) * 2e-5;
  elastic.follow(x);
  elastic.energy_and_force(x, f);
  Vector3d sum = Vector3d::Zero(), torque = Vector3d::Zero();
  double size = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += f[i], torque += x[i].cross(f[i]), size = std::max(size, f[i].norm());
  CHECK(sum.norm() < 1e-9 * size);
  CHECK(torque.norm() < 1e-9 * size);
  for (std::size_t k = 0; k < m.fold_fit.size(); k += 17) {
    const model::Index i = m.fit_particle[m.fit_begin[m.fold_fit[k] + 1] - 1];
    for (int axis = 0; axis < 3; ++axis) {
      const double at = x[i][axis], d = 1e-7;
      x[i][axis] = at + d;
      const double up = elastic.energy(x);
      x[i][axis] = at - d;
      const double down = elastic.energy(x);
      x[i][axis] = at;
      CHECK(f[i][axis] == Approx(-(up - down) / (2 * d)).epsilon(1e-4).margin(1e-5 * size));
    }
  }
}

namespace {

/// Pieces of cloth that hang together, by their triangles.
int pieces_of(const model::Model& m) {
  std::vector<model::Index> root(m.n_particles());
  for (std::size_t i = 0; i < root.size(); ++i) root[i] = static_cast<model::Index>(i);
  auto find = [&](model::Index i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  for (std::size_t t = 0; t < m.n_triangles(); ++t) {
    const auto c = m.corners(t);
    root[find(c[1])] = find(c[0]);
    root[find(c[2])] = find(c[0]);
  }
  int pieces = 0;
  for (std::size_t i = 0; i < root.size(); ++i) pieces += find(static_cast<model::Index>(i)) == static_cast<model::Index>(i);
  return pieces;
}

/// Number of particles within 0.2 mm of a place.
int particles_at(const model::Model& m, const Point2& p) {
  std::set<model::Index> found;
  for (std::size_t v = 0; v < m.n_vertices(); ++v)
    if ((m.vertex_uv[v] - p).norm() < 2e-4) found.insert(m.vertex_particle[v]);
  return static_cast<int>(found.size());
}

/// Length of the sides of triangles that no other triangle has: the outline, and both lips of the slits.
double open_length(const model::Model& m) {
  std::map<std::pair<model::Index, model::Index>, int> sides;
  for (std::size_t t = 0; t < m.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k) {
      const auto c = m.corners(t);
      ++sides[std::minmax(c[k], c[(k + 1) % 3])];
    }
  double open = 0;
  for (const auto& [side, n] : sides) {
    CHECK(n <= 2);
    if (n == 1) open += (m.start[side.first] - m.start[side.second]).norm();
  }
  return open;
}

/// Area of the pattern, each of whose triangles is the right way up.
double flat_area(const model::Model& m) {
  double area = 0;
  for (std::size_t t = 0; t < m.n_triangles(); ++t) {
    const auto& v = m.triangle[t];
    const Point2 a = m.vertex_uv[v[1]] - m.vertex_uv[v[0]], b = m.vertex_uv[v[2]] - m.vertex_uv[v[0]];
    CHECK(a.x() * b.y() - a.y() * b.x() > 0);
    area += (a.x() * b.y() - a.y() * b.x()) / 2;
  }
  return area;
}

}  // namespace

TEST_CASE("a slit opens the cloth along its line and nowhere else") {
  design::Garment g = test::single(test::rectangle("cloth", 0.2, 0.3, 0.01));
  g.panels[0].lines = {test::edge("inside", {0.05, 0.1}, {0.13, 0.16}), test::edge("vent", {0.1, 0}, {0.104, 0.12})};
  g.panels[0].slits = {{"a", {}, 0}, {"b", {}, 1}};
  const model::Model m = built(g);
  CHECK(mass_of(m) == Approx(0.2 * 0.2 * 0.3).epsilon(1e-12));
  CHECK(open_length(m) == Approx(2 * (0.2 + 0.3) + 2 * (0.1 + std::hypot(0.004, 0.12))).epsilon(1e-3));
  simulator::Certificate certificate = simulator::certify(m, {m.start, Positions(m.n_particles(), Vector3d::Zero())}, {});
  CHECK(certificate.self_intersections == 0);
  flat_area(m);
}

TEST_CASE("where slits meet the cloth is cut along both") {
  using Lines = std::vector<design::Edge>;
  struct Case {
    const char* name;
    Lines lines;
    Point2 meet;
    int particles, pieces;
    double cut;  // m
  };
  const double slant = std::hypot(0.1, 0.06);
  const std::vector<Case> cases{
      {"T", {test::edge("bar", {0.05, 0.2}, {0.15, 0.2}), test::edge("stem", {0.1, 0.2}, {0.1, 0.08})}, {0.1, 0.2}, 3, 1, 0.22},
      {"T, the stem drawn first and the other way",
       {test::edge("stem", {0.093, 0.08}, {0.093, 0.2}), test::edge("bar", {0.15, 0.2}, {0.05, 0.2})}, {0.093, 0.2}, 3, 1, 0.22},
      {"X", {test::edge("a", {0.05, 0.15}, {0.15, 0.15}), test::edge("b", {0.1, 0.08}, {0.1, 0.22})}, {0.1, 0.15}, 4, 1, 0.24},
      {"slanted X", {test::edge("a", {0.05, 0.12}, {0.15, 0.18}), test::edge("b", {0.15, 0.12}, {0.05, 0.18})}, {0.1, 0.15}, 4, 1, 2 * slant},
      {"L", {test::edge("a", {0.05, 0.2}, {0.15, 0.2}), test::edge("b", {0.15, 0.2}, {0.15, 0.1})}, {0.15, 0.2}, 2, 1, 0.2},
      {"star", {test::edge("a", {0.05, 0.15}, {0.15, 0.15}), test::edge("b", {0.1, 0.08}, {0.1, 0.22}), test::edge("c", {0.1, 0.15}, {0.16, 0.21})},
       {0.1, 0.15}, 5, 1, 0.24 + std::hypot(0.06, 0.06)},
      {"T on the edge: a slit to it and one off that",
       {test::edge("a", {0.1, 0}, {0.1, 0.16}), test::edge("b", {0.1, 0.1}, {0.16, 0.1})}, {0.1, 0.1}, 3, 1, 0.22},
      {"two slits from one place of the edge", {test::edge("a", {0.1, 0}, {0.06, 0.1}), test::edge("b", {0.1, 0}, {0.14, 0.1})},
       {0.1, 0}, 3, 1, 2 * std::hypot(0.04, 0.1)},
      {"a frame that lets a piece go",
       {test::edge("a", {0.04, 0.1}, {0.16, 0.1}), test::edge("b", {0.04, 0.2}, {0.16, 0.2}), test::edge("c", {0.05, 0.08}, {0.05, 0.22}),
        test::edge("d", {0.15, 0.08}, {0.15, 0.22})},
       {0.05, 0.1}, 4, 2, 0.52},
      {"the same line twice", {test::edge("a", {0.05, 0.15}, {0.15, 0.15}), test::edge("b", {0.05, 0.15}, {0.15, 0.15})}, {0.1, 0.15}, 2, 1, 0.1},
  };
  for (const Case& c : cases) {
    INFO(c.name);
    design::Garment g = test::single(test::rectangle("cloth", 0.2, 0.3, 0.01));
    g.panels[0].lines = c.lines;
    for (std::size_t k = 0; k < c.lines.size(); ++k) g.panels[0].slits.push_back({c.lines[k].name, {}, static_cast<int>(k)});
    const model::Model m = built(g);
    CHECK(mass_of(m) == Approx(0.2 * 0.2 * 0.3).epsilon(1e-12));
    CHECK(flat_area(m) == Approx(0.2 * 0.3 - 1e-4 * c.cut).margin(0.3e-4 * c.cut));  // the slits are 0.1 mm wide
    CHECK(particles_at(m, c.meet) == c.particles);
    CHECK(pieces_of(m) == c.pieces);
    CHECK(open_length(m) == Approx(2 * (0.2 + 0.3) + 2 * c.cut).margin(2e-3));
    const simulator::Certificate at_start = simulator::certify(m, {m.start, Positions(m.n_particles(), Vector3d::Zero())}, {});
    CHECK(at_start.self_intersections == 0);
  }
}

TEST_CASE("pleats fold without stretching, close on the edge and start without crossing") {
  using Kind = design::Pleat::Kind;
  for (Kind kind : {Kind::knife, Kind::box, Kind::inverted, Kind::tuck})
    for (double spacing : {0.185, 0.075})
    for (int toward : {1, -1})
      for (bool ironed : {false, true}) {
        const bool knife = kind == Kind::knife || kind == Kind::tuck;
        if (!knife && spacing < 0.18) continue;  // boxes would lie over each other; knives reach under one another
        design::Garment g = test::single(test::rectangle("cloth", 0.6, 0.3, 0.01));
        design::Pleat pleat;
        pleat.name = "p";
        pleat.edge = "top";
        pleat.kind = kind;
        pleat.underlay = 0.03;
        pleat.count = 3;
        pleat.spacing = spacing;
        pleat.at = 0.1;
        pleat.toward = toward;
        pleat.length = kind == Kind::tuck || ironed ? 0.08 : 0;
        pleat.ironed = ironed && kind != Kind::tuck;
        g.panels[0].pleats = {pleat};
        INFO("kind " << static_cast<int>(kind) << ", toward " << toward << ", ironed " << ironed);
        const model::Model m = built(g);
        CHECK(mass_of(m) == Approx(0.2 * 0.6 * 0.3).epsilon(1e-12));
        double low = 1e300, high = -1e300;
        for (std::size_t v = 0; v < m.n_vertices(); ++v)
          if (m.vertex_uv[v].y() > 0.3 - 1e-9) {
            low = std::min(low, m.start[m.vertex_particle[v]].x());
            high = std::max(high, m.start[m.vertex_particle[v]].x());
          }
        CHECK(high - low == Approx(0.6 - 3 * pleat.take()).margin(1e-3));
        const simulator::Certificate c = simulator::certify(m, {m.start, Positions(m.n_particles(), Vector3d::Zero())}, {});
        // Where pleats reach under one another the edge holds five layers together: beside it some still touch.
        CHECK(c.self_intersections <= (spacing > 0.1 ? 0 : 8));
        // The start is the cloth folded: away from the folds and the edge no length has changed.
        const std::vector<modeller::LaidPleat> laid = modeller::laid_pleats(g.panels[0]);
        CHECK(laid.size() == 3);
        for (const modeller::LaidPleat& p : laid) {
          CHECK(p.strips.front().from == Approx(p.from));
          CHECK(p.strips.back().to == Approx(p.to));
          for (const modeller::LaidPleat::Strip& s : p.strips) {
            const double y = 0.1, a = 0.6 - (s.from + 2e-6), b = 0.6 - (s.to - 2e-6);  // `top` is drawn from right to left
            const Vector3d pa = modeller::fold_pleats(laid, {a, y}, 0.002), pb = modeller::fold_pleats(laid, {b, y}, 0.002);
            CHECK((pa - pb).head<2>().norm() == Approx(std::abs(a - b)).epsilon(1e-6));  // and up or down under its neighbours
          }
        }
        CHECK(m.fold_fit.empty() == !pleat.ironed);
      }
}

TEST_CASE("a pleat that is held at both ends folds once") {
  design::Garment g = test::single(test::rectangle("cloth", 0.3, 0.3, 0.01));
  design::Pleat pleat;
  pleat.name = "above";
  pleat.edge = "top";
  pleat.underlay = 0.03;
  pleat.at = 0.15;
  pleat.ironed = true;
  g.panels[0].pleats = {pleat};
  pleat.name = "below";
  pleat.edge = "bottom";
  pleat.toward = -1;  // drawn the other way
  g.panels[0].pleats.push_back(pleat);
  const model::Model m = built(g);
  double low = 1e300, high = -1e300, stretch = 0;
  for (const Vector3d& x : m.start) low = std::min(low, x.x()), high = std::max(high, x.x());
  CHECK(high - low == Approx(0.3 - 0.06).margin(1e-3));
  for (const auto& t : m.triangle)
    for (int k = 0; k < 3; ++k) {
      const model::Index a = t[k], b = t[(k + 1) % 3];
      stretch = std::max(stretch, (m.start[m.vertex_particle[a]] - m.start[m.vertex_particle[b]]).norm() / (m.vertex_uv[a] - m.vertex_uv[b]).norm());
    }
  CHECK(stretch < 1.15);  // layers part by 4 mm within a cell
  CHECK(simulator::certify(m, {m.start, Positions(m.n_particles(), Vector3d::Zero())}, {}).self_intersections == 0);
}

TEST_CASE("slack, lapped and drawn-in seams are ties of the lengths that they state") {
  auto garment_with = [](const design::SeamFinish& finish) {
    design::Garment g;
    g.fabrics = {test::cloth()};
    g.panels = {test::rectangle("a", 0.1, 0.2, 0.01), test::rectangle("b", 0.1, 0.2, 0.013, {0.1, 0})};
    g.panels[1].placement = test::flat(0, 0.004);
    g.seams = {test::seam("middle", {test::whole(g, 0, 1)}, {test::whole(g, 1, 3, true)})};
    g.seams[0].finish = finish;
    return built(g);
  };
  const std::size_t merged = garment_with({}).n_particles();
  design::SeamFinish slack;
  slack.slack = 0.003;
  model::Model m = garment_with(slack);
  CHECK(m.tie.size() >= 16);
  CHECK(m.n_particles() == merged + m.tie.size());
  for (double length : m.tie_length) CHECK(length == Approx(0.003));
  for (std::size_t t = 0; t < m.tie.size(); ++t) CHECK(m.tie_span(t, m.start).norm() == Approx(0.004));

  design::SeamFinish lapped;
  lapped.lap = 0.015;
  m = garment_with(lapped);
  CHECK(m.n_particles() > merged);
  for (std::size_t t = 0; t < m.tie.size(); ++t) {
    Vector3d first = Vector3d::Zero(), second = Vector3d::Zero();
    for (int k = 0; k < 3; ++k) {
      first += m.tie_weights[t][k] * m.start[m.tie[t][k]];
      second += m.tie_weights[t][3 + k] * m.start[m.tie[t][3 + k]];
    }
    CHECK(first.x() == Approx(0.1));  // the edge of one side, 15 mm inside that of the other
    CHECK(std::abs(second.x() - 0.1) == Approx(0.015).epsilon(1e-6));
    CHECK(second.y() == Approx(first.y()).margin(1e-6));
  }

  design::SeamFinish drawn_in;
  drawn_in.tension = -0.02;
  m = garment_with(drawn_in);
  CHECK(m.n_particles() == merged);
  double thread = 0;
  for (double length : m.tie_length) thread += length;
  CHECK(thread == Approx(0.98 * 0.2));
}

TEST_CASE("a pad keeps cloth off the body by its profile") {
  design::Garment g = test::single(test::rectangle("cloth", 0.3, 0.3, 0.01));
  design::Pad pad;
  pad.name = "pad";
  pad.panel = 0;
  pad.centre = {0.15, 0.15};
  pad.radius = 0.1;
  pad.thickness = {0.012, 0.008, 0.002};
  g.pads = {pad};
  const model::Model m = built(g);
  REQUIRE_FALSE(m.pad_particle.empty());
  for (std::size_t k = 0; k < m.pad_particle.size(); ++k) {
    const Vector3d& at = m.start[m.pad_particle[k]];
    const double r = std::hypot(at.x() - 0.15, at.y() - 0.15);
    CHECK(m.pad_thickness[k] == Approx(r < 0.05 ? 0.012 - 0.004 * r / 0.05 : 0.008 - 0.006 * (r - 0.05) / 0.05));
  }
  // The same circle as a region.
  design::Region region;
  region.parts = {{0, {}}};
  region.parts[0].shape.kind = design::RegionShape::Kind::circle;
  region.parts[0].shape.points = {{0.15, 0.15}};
  region.parts[0].shape.size = 0.1;
  g.regions = {region};
  g.pads[0].region = 0;
  const model::Model again = built(g);
  REQUIRE(again.pad_particle.size() == m.pad_particle.size());
  for (std::size_t k = 0; k < m.pad_particle.size(); ++k)
    CHECK(again.pad_thickness[k] == Approx(m.pad_thickness[k]).margin(4e-4));
}
