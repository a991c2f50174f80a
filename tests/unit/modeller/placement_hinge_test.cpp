// Collars in small: a leaf turned over a stand that stands on a cloth.
#include <catch2/catch.hpp>

#include "runtime/geometry/self_crossings.hpp"
#include "runtime/modeller/flat_start.hpp"
#include "runtime/modeller/modeller.hpp"
#include "runtime/modeller/placement_hinge.hpp"
#include "tests/unit/modeller/garments.hpp"

using namespace garment;
using Eigen::Vector3d;

namespace {

constexpr double kStand = 0.04, kLeaf = 0.06;  // m, how high they are

/// A stand of 20 cm in the plane z = 0 with its foot at y = 0, a leaf sewn to its upper edge, and below them a cloth that slopes
/// away from the stand's foot towards its face.
struct Collar {
  design::Garment garment;
  model::Model model;
  std::vector<Vector3d> flat, place;

  explicit Collar(double slope) {
    garment.fabrics = {test::cloth()};
    garment.panels = {test::rectangle("stand", 0.2, kStand, 0.01, {-0.1, 0}), test::rectangle("leaf", 0.2, kLeaf, 0.01, {-0.1, 0}),
                      test::rectangle("shoulder", 0.3, 0.2, 0.01, {-0.15, 0})};
    garment.panels[1].placement = {};
    garment.seams = {test::seam("turn", {test::whole(garment, 0, 2)}, {test::whole(garment, 1, 0, true)})};
    garment.stackings = {{{}, 1, 0, true}};
    modeller::ModelResult built = modeller::build_model(garment, {});
    REQUIRE(built.model);
    model = std::move(*built.model);
    flat = modeller::flat_start(garment, model);
    for (std::size_t v = 0; v < model.n_vertices(); ++v) {
      const Eigen::Vector2d uv = model.vertex_uv[v];
      place.push_back(model.vertex_panel[v] == 2 ? Vector3d(uv.x(), -0.002 - slope * uv.y(), uv.y() - 0.002) : Vector3d(uv.x(), uv.y(), 0));
    }
  }

  modeller::HingedPanel leaf() const { return {model, 1, 0, true, {true, false, true}, flat}; }

  std::vector<geometry::TrianglePair> crossings() const {
    std::vector<model::Indices<3>> triangles;
    for (std::size_t t = 0; t < model.n_triangles(); ++t) triangles.push_back(model.triangle[t]);
    return geometry::self_crossings(triangles, place, 10'000).pairs;
  }

  template <class F>
  void each_of_leaf(const F& f) const {
    for (model::Index v = model.panels[1].first_vertex; v < model.panels[1].first_vertex + model.panels[1].n_vertices; ++v)
      f(model.vertex_uv[v], place[v]);
  }
};

}  // namespace

TEST_CASE("a leaf lies along its stand, on the face, and keeps its lengths") {
  Collar c(5);  // the cloth falls away steeply: nothing is in the way
  const modeller::HingedPanel leaf = c.leaf();
  REQUIRE(leaf.hinged());
  leaf.lay(c.place);
  CHECK(c.crossings().empty());
  c.each_of_leaf([&](const Eigen::Vector2d& uv, const Vector3d& at) {
    CHECK(at.x() == Approx(uv.x()).margin(1e-9));
    CHECK(at.y() == Approx(kStand - uv.y() * std::cos(0.2094)).margin(1e-4));  // 12 degrees from the stand
    CHECK(at.z() == Approx(uv.y() * std::sin(0.2094)).margin(1e-4));
  });
}

TEST_CASE("a leaf opens beyond its stand's foot as far as the cloth there asks for, and not before it") {
  Collar c(0.3);
  modeller::HingedPanel leaf = c.leaf();
  leaf.lay(c.place);
  REQUIRE_FALSE(c.crossings().empty());
  for (int round = 0; round < 40 && leaf.open(c.crossings()); ++round) leaf.lay(c.place);
  CHECK(c.crossings().empty());
  c.each_of_leaf([&](const Eigen::Vector2d& uv, const Vector3d& at) {
    if (uv.y() < 0.03) {
      CHECK(at.z() == Approx(uv.y() * std::sin(0.2094)).margin(1e-4));
    } else if (uv.y() > kLeaf - 1e-6) {
      CHECK(at.z() > 0.02);
      CHECK(at.y() < kStand / 2);
    }
  });
}

TEST_CASE("a leaf over the stand's back lies behind it, and one that shares no seam cannot be laid") {
  Collar c(5);
  modeller::HingedPanel(c.model, 1, 0, false, {true, false, true}, c.flat).lay(c.place);
  c.each_of_leaf([&](const Eigen::Vector2d& uv, const Vector3d& at) { CHECK(at.z() == Approx(-uv.y() * std::sin(0.2094)).margin(1e-4)); });
  CHECK_FALSE(modeller::HingedPanel(c.model, 1, 2, true, {true, false, true}, c.flat).hinged());
}

TEST_CASE("turned onto none, a panel carries the surface on that it is sewn to") {
  Collar c(5);
  modeller::HingedPanel stand(c.model, 1, {true, false, true}, c.flat);
  REQUIRE(stand.hinged());
  stand.lay(c.place);
  c.each_of_leaf([&](const Eigen::Vector2d& uv, const Vector3d& at) {
    CHECK((at - Vector3d(uv.x(), kStand + uv.y(), 0)).norm() < 1e-6);
  });
}
