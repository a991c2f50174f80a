// Collars that are turned over, lapels and layers begin without a cut, in all sizes and whatever the order of declarations.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <numeric>

#include "interpreter/language/interpret.hpp"
#include "runtime/base/host.hpp"
#include "runtime/modeller/modeller.hpp"
#include "runtime/simulator/certificate.hpp"
#include "tests/support/declared.hpp"

using namespace garment;

namespace {

using test::Declared;
using test::declared;

std::string example(const std::string& name) {
  std::ifstream in(std::string(GARMENT_SOURCE_DIR) + "/examples/" + name + ".garment");
  return {std::istreambuf_iterator<char>(in), {}};
}

model::Model modelled(const Declared& d, double coarsen = 1) {
  modeller::ModelOptions options;
  options.coarsen = coarsen;
  modeller::ModelResult built = modeller::build_model(d.garment, d.bodies, options);
  REQUIRE(built.model);
  for (const Finding& f : built.findings) CHECK((f.code != "G0608" && f.code != "G0609" && f.code != "G0552"));
  return std::move(*built.model);
}

void starts_clear(const std::string& name, const std::map<std::string, std::string>& params) {
  const Declared d = declared(example(name), params);
  for (const double coarsen : {1.0, 2.0}) {
    INFO(name << ", a grid coarser by " << coarsen);
    const model::Model m = modelled(d, coarsen);
    model::State state;
    state.position = m.start;
    const simulator::Certificate c = simulator::certify(m, state, d.bodies);
    CHECK(c.self_intersections == 0);
    CHECK(c.body_intersections == 0);
    CHECK(c.inside_body == 0);
  }
}

/// The same garment with its panels and stackings declared in another order, stripped of what has no part in where it starts.
design::Garment permuted(design::Garment g, const std::vector<int>& order) {
  g.buttons.clear(), g.regions.clear(), g.layers.clear(), g.pads.clear(), g.hems.clear();
  std::vector<int> now(order.size());  // number of a panel that was declared as k
  std::vector<design::Panel> panels;
  for (std::size_t k = 0; k < order.size(); ++k) {
    now[order[k]] = static_cast<int>(k);
    panels.push_back(g.panels[order[k]]);
  }
  g.panels = std::move(panels);
  for (design::Seam& seam : g.seams)
    for (design::SeamSide& side : seam.sides)
      for (design::EdgePart& part : side.parts) part.panel = now[part.panel];
  for (design::Press& press : g.presses)
    for (design::EdgePart& part : press.line) part.panel = now[part.panel];
  for (design::Stacking& s : g.stackings) s.panel = now[s.panel], s.other = now[s.other];
  if (order[0] != 0) std::reverse(g.stackings.begin(), g.stackings.end());
  return g;
}

/// Furthest that a vertex starts from where it starts in the other model, m.
double largest_difference(const model::Model& a, const model::Model& b) {
  double most = 0;
  for (const model::PanelRange& pa : a.panels) {
    const auto pb = std::find_if(b.panels.begin(), b.panels.end(), [&](const model::PanelRange& p) { return p.name == pa.name; });
    REQUIRE(pb != b.panels.end());
    REQUIRE(pb->n_vertices == pa.n_vertices);
    for (model::Index v = 0; v < pa.n_vertices; ++v)
      most = std::max(most, (a.start[a.vertex_particle[pa.first_vertex + v]] - b.start[b.vertex_particle[pb->first_vertex + v]]).norm());
  }
  return most;
}

}  // namespace

TEST_CASE("shirts and jackets begin without a cut, their collars turned over, from size 44 to 58") {
  for (const char* name : {"shirt", "jacket"})
    for (const char* size : {"44", "50", "58"}) {
      INFO("size " << size);
      starts_clear(name, {{"size", size}});
    }
  starts_clear("collar_study", {});
}

TEST_CASE("a shirt's collar begins along its stand, on the outside, evenly left and right") {
  const Declared d = declared(example("shirt"));
  const model::Model m = modelled(d);
  auto range = [&](const std::string& name) {
    return *std::find_if(m.panels.begin(), m.panels.end(), [&](const model::PanelRange& p) { return p.name == name; });
  };
  const model::PanelRange leaf = range("collar.leaf"), stand = range("collar.stand");
  auto at = [&](model::Index v) { return m.start[m.vertex_particle[v]]; };
  std::size_t compared = 0;
  for (model::Index v = leaf.first_vertex; v < leaf.first_vertex + leaf.n_vertices; ++v) {
    // The seam runs along y = 0 behind the neck, the leaf's outer edge at 4.5 cm; the stand's foot lies 3 cm below its seam.
    if (std::abs(m.vertex_uv[v].x()) > 0.06 || m.vertex_uv[v].y() < 0.005 || m.vertex_uv[v].y() > 0.025) continue;
    double nearest = 1, behind = 0;
    for (model::Index w = stand.first_vertex; w < stand.first_vertex + stand.n_vertices; ++w) {
      const double distance = (at(v) - at(w)).norm();
      if (distance < nearest) nearest = distance, behind = at(w).z() - at(v).z();
    }
    CHECK(nearest < 0.02);
    CHECK(behind > 0);  // at the nape the outside is where z is less
    ++compared;
  }
  CHECK(compared > 20);
}

TEST_CASE("where a garment starts does not depend on the order in which its panels are declared") {
  for (const char* name : {"shirt", "waistcoat", "jacket"}) {
    INFO(name);
    Declared d = declared(example(name));
    std::vector<int> order(d.garment.panels.size());
    std::iota(order.begin(), order.end(), 0);
    const design::Garment as_written = d.garment;
    d.garment = permuted(as_written, order);
    const model::Model first = modelled(d);
    for (int round = 0; round < 2; ++round) {
      if (round == 0) std::reverse(order.begin(), order.end());
      else std::rotate(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(order.size()) / 3, order.end());
      d.garment = permuted(as_written, order);
      CHECK(largest_difference(first, modelled(d)) < 1e-6);
    }
  }
}
