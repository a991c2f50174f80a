// Circle skirts, lapped fronts, flaps and welts begin as they are worn: whole, left as right, on their own side of the cloth.
#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <numeric>
#include <set>

#include "interpreter/language/interpret.hpp"
#include "runtime/base/host.hpp"
#include "runtime/modeller/modeller.hpp"
#include "runtime/simulator/certificate.hpp"
#include "tests/support/declared.hpp"

using namespace garment;
using Eigen::Vector3d;

namespace {

struct Started {
  design::Garment garment;
  std::vector<body::Body> bodies;
  model::Model model;

  const model::PanelRange& panel(const std::string& name) const {
    const auto found = std::find_if(model.panels.begin(), model.panels.end(), [&](const auto& p) { return p.name == name; });
    REQUIRE(found != model.panels.end());
    return *found;
  }
  const Vector3d& at(model::Index vertex) const { return model.start[model.vertex_particle[vertex]]; }
};

Started started(const std::string& script, const std::map<std::string, std::string>& params = {}, double coarsen = 1) {
  test::Declared result = test::declared(script, params);
  modeller::ModelOptions how;
  how.coarsen = coarsen;
  modeller::ModelResult built = modeller::build_model(result.garment, result.bodies, how);
  REQUIRE(built.model);
  for (const Finding& f : built.findings) CHECK(f.code != "G0608");
  return {std::move(result.garment), std::move(result.bodies), std::move(*built.model)};
}

std::string script_of(const std::string& path) {
  std::ifstream in(std::string(GARMENT_SOURCE_DIR) + path);
  REQUIRE(in);
  return {std::istreambuf_iterator<char>(in), {}};
}

void check_clear(const Started& s) {
  model::State state;
  state.position = s.model.start;
  const simulator::Certificate c = simulator::certify(s.model, state, s.bodies);
  CHECK(c.self_intersections == 0);
  CHECK(c.body_intersections == 0);
  CHECK(c.inside_body == 0);
}

/// Least and largest strain of the sides of triangles, those shorter than 2 mm left out.
std::array<double, 2> strains(const model::Model& m) {
  std::array<double, 2> found{0, 0};
  for (const auto& t : m.triangle)
    for (int k = 0; k < 3; ++k) {
      const model::Index a = t[k], b = t[(k + 1) % 3];
      const double flat = (m.vertex_uv[a] - m.vertex_uv[b]).norm();
      if (flat < 2e-3) continue;
      const double strain = (m.start[m.vertex_particle[a]] - m.start[m.vertex_particle[b]]).norm() / flat - 1;
      found = {std::min(found[0], strain), std::max(found[1], strain)};
    }
  return found;
}

/// Particles without a mirror image in x = 0, to the last bit.
std::size_t without_image(const model::Model& m) {
  std::set<std::array<double, 3>> places;
  for (const Vector3d& p : m.start) places.insert({p.x(), p.y(), p.z()});
  return std::count_if(m.start.begin(), m.start.end(), [&](const Vector3d& p) { return !places.contains({p.x() == 0 ? 0 : -p.x(), p.y(), p.z()}); });
}

void check_flared(const Started& s) {
  check_clear(s);
  const auto [least, largest] = strains(s.model);
  CHECK(least > -0.2);
  CHECK(largest < 0.12);
  const double waist = s.bodies[0].levels.at("waist").height;
  for (const Vector3d& p : s.model.start) REQUIRE(p.y() < waist + 1e-3);
}

/// Places along the hem of the front of a circle skirt that are farther out than those beside them.
int flutes_of_front(const Started& s) {
  const model::PanelRange& front = s.panel("lower.front");
  std::map<double, double> hem;  // distance from the axis, by angle in the pattern
  double longest = 0;
  for (model::Index v = front.first_vertex; v < front.first_vertex + front.n_vertices; ++v) longest = std::max(longest, s.model.vertex_uv[v].norm());
  for (model::Index v = front.first_vertex; v < front.first_vertex + front.n_vertices; ++v) {
    const Eigen::Vector2d& flat = s.model.vertex_uv[v];
    if (flat.norm() > longest - 1e-4) hem[std::atan2(flat.x(), -flat.y())] = std::hypot(s.at(v).x(), s.at(v).z());
  }
  int found = 0;
  double before = 0, last = 0;
  for (const auto& [angle, off] : hem) {
    found += before > 0 && last > before && last >= off;
    before = last, last = off;
  }
  return found;
}

/// A shirt whose fronts are wrapped on the chest; `offsets` of the right one and the left one.
std::string wrapped_shirt(const std::string& right, const std::string& left, bool buttons = true) {
  std::string script = script_of("/examples/shirt.garment");
  auto replace = [&](const std::string& line_with, const std::string& by) {
    const std::size_t found = script.find(line_with);
    REQUIRE(found != std::string::npos);
    script.replace(found, script.find('\n', found) - found, by);
  };
  replace("place front.right", "place front.right on form.front with shoulder at form.shoulder offset " + right);
  replace("place front.left", "place front.left on form.front with shoulder at form.shoulder offset " + left);
  replace("let floor_up", "");
  if (!buttons) replace("part closing", "");
  return script;
}

/// How far the left front lies before the right one near the centre front, at least, m.
double left_before_right(const Started& s) {
  const model::PanelRange &left = s.panel("front.left"), &right = s.panel("front.right");
  double least = 1;
  for (model::Index v = left.first_vertex; v < left.first_vertex + left.n_vertices; ++v) {
    if (s.model.vertex_uv[v].x() > 0.01) continue;
    for (model::Index w = right.first_vertex; w < right.first_vertex + right.n_vertices; ++w)
      if (std::hypot(s.at(v).x() - s.at(w).x(), s.at(v).y() - s.at(w).y()) < 4e-3) least = std::min(least, s.at(v).z() - s.at(w).z());
  }
  return least;
}

/// A flap and a welt on lines inside two fronts that are mirror images. Lines are drawn outwards on the one and inwards on the other.
std::string pocketed(const std::string& from, const std::string& to) {
  return R"(garment 1 "pockets"
use fabrics, bodies, details
body form = bodies.woman(size: 40)
pair panel front of fabrics.poplin {
  resolution 1 cm
  outline from (1 cm, 0) {
    edge hem to (23 cm, 0) free
    edge side to (23 cm, 50 cm) free
    edge top to (1 cm, 50 cm) free
    close middle free
  }
  line for_flap from )" + from + R"(
  line for_welt from )" + to + R"(
}
part flap_left = details.pocket_flap(fabrics.poplin, ground: front.left, opening: front.left.for_flap)
part flap_right = details.pocket_flap(fabrics.poplin, ground: front.right, opening: front.right.for_flap)
part welt_left = details.welt(fabrics.poplin, ground: front.left, opening: front.left.for_welt)
part welt_right = details.welt(fabrics.poplin, ground: front.right, opening: front.right.for_welt)
place front.left at (0, 70 cm, 19 cm)
place front.right at (0, 70 cm, 19 cm)
drape until rest
)";
}

Vector3d middle_of(const Started& s, const std::string& panel) {
  const model::PanelRange& range = s.panel(panel);
  Vector3d sum = Vector3d::Zero();
  for (model::Index v = range.first_vertex; v < range.first_vertex + range.n_vertices; ++v) sum += s.at(v) / range.n_vertices;
  return sum;
}

}  // namespace

TEST_CASE("circle skirts begin below the waist and inside of the arms, hardly strained, left as right") {
  const std::string skirt = script_of("/examples/circle_skirt.garment");
  for (const char* size : {"34", "48"})
    for (const char* share : {"0.5", "0.7", "1"})
      for (const double coarsen : {1.0, 2.0}) {
        INFO("size " << size << ", share " << share << ", a grid coarser by " << coarsen);
        const Started s = started(skirt, {{"size", size}, {"share", share}}, coarsen);
        check_flared(s);
        CHECK(without_image(s.model) == 0);
      }
}

TEST_CASE("a whole circle in four gores or in one piece, lined or held by a band, begins as one in two pieces does") {
  check_flared(started(script_of("/tests/wardrobe/gored_circle.garment")));
  check_flared(started(script_of("/tests/wardrobe/circle_of_one_piece.garment")));
  const Started lined = started(script_of("/tests/wardrobe/lined_circle.garment"));
  check_clear(lined);
  CHECK(without_image(lined.model) == 0);
  check_clear(started(script_of("/tests/wardrobe/banded_circle.garment")));
}

TEST_CASE("a whole circle of a softer cloth begins in more flutes") {
  std::string skirt = script_of("/examples/circle_skirt.garment");
  const std::string cloth = "fabrics.wool_tropical";
  const std::size_t found = skirt.find(cloth);
  REQUIRE(found != std::string::npos);
  std::vector<int> flutes;
  for (const char* other : {"fabrics.denim", "fabrics.wool_suiting", "fabrics.habotai"}) {
    std::string changed = skirt;
    changed.replace(found, cloth.size(), other);
    flutes.push_back(flutes_of_front(started(changed, {{"share", "1"}})));
  }
  INFO(flutes[0] << ", " << flutes[1] << ", " << flutes[2]);
  CHECK(flutes[0] >= 3);
  CHECK(flutes[1] >= flutes[0]);
  CHECK(flutes[2] >= flutes[1]);
  CHECK(flutes[2] > flutes[0]);
}

TEST_CASE("fronts that are wrapped on the chest lap as their buttons say, else as their offsets do") {
  for (const char* size : {"44", "50", "58"}) {
    INFO("size " << size);
    const Started s = started(wrapped_shirt("2 cm", "3 cm"), {{"size", size}});
    check_clear(s);
    CHECK(left_before_right(s) > 1e-3);
  }
  for (const auto& [right, left] : {std::pair{"2 cm", "2 cm"}, std::pair{"3 cm", "2 cm"}}) {
    INFO("offsets " << right << " and " << left);
    const Started s = started(wrapped_shirt(right, left));
    check_clear(s);
    CHECK(left_before_right(s) > 1e-3);
  }
  CHECK(left_before_right(started(wrapped_shirt("2 cm", "3 cm", false))) > 1e-3);
  CHECK(left_before_right(started(wrapped_shirt("3 cm", "2 cm", false))) < -1e-3);
}

TEST_CASE("flaps hang from straight lines and welts stand on them, whichever way the lines are drawn") {
  for (const bool outwards : {true, false})
    for (const double high : {0.12, 0.25, 0.40}) {
      INFO((outwards ? "outwards" : "inwards") << " at " << high);
      auto line = [&](double y) {
        const std::string a = "(5 cm, " + std::to_string(y) + " m)", b = "(17 cm, " + std::to_string(y + 0.004) + " m)";
        return outwards ? a + " to " + b : b + " to " + a;
      };
      const Started s = started(pocketed(line(high), line(high - 0.09)));
      for (const std::string side : {"left", "right"}) {
        INFO(side);
        const Vector3d flap = middle_of(s, "flap_" + side + ".flap"), welt = middle_of(s, "welt_" + side + ".strip");
        CHECK(flap.y() < 0.7 + high - 0.02);
        CHECK(welt.y() > 0.7 + high - 0.09 + 0.01);
        CHECK(flap.z() > 0.19 + 1e-4);
        CHECK(welt.z() > 0.19 + 1e-4);
      }
      const Vector3d left = middle_of(s, "flap_left.flap"), right = middle_of(s, "flap_right.flap");
      CHECK((left - Vector3d(-right.x(), right.y(), right.z())).norm() < 1e-9);
    }
}
