#pragma once
// Models of garments that must be buildable.
#include <catch2/catch.hpp>

#include "runtime/modeller/modeller.hpp"
#include "tests/unit/modeller/garments.hpp"

namespace garment::test {

/// The model of `g`; the test fails, with what was found, where there is none.
inline model::Model build(const design::Garment& g) {
  modeller::ModelResult result = modeller::build_model(g, {});
  for (const Finding& f : result.findings) UNSCOPED_INFO(f.code << " " << f.message);
  REQUIRE(result.model);
  return *result.model;
}

/// The same, where just so many findings are told.
inline model::Model build(const design::Garment& g, std::size_t findings) {
  modeller::ModelResult result = modeller::build_model(g, {});
  for (const Finding& f : result.findings) UNSCOPED_INFO(f.code << " " << f.message);
  CHECK(result.findings.size() == findings);
  REQUIRE(result.model);
  return *result.model;
}

/// 20 x 30 cm with a line inside, ironed along it.
inline design::Garment ironed(const Point2& from, const Point2& to, double angle, double radius = 0) {
  design::Garment g = single(rectangle("cloth", 0.2, 0.3, 0.01));
  g.panels[0].lines = {edge("fold", from, to)};
  design::Press press;
  press.name = "crease";
  press.line = {{0, 0, 0, (to - from).norm(), design::EdgePart::On::line}};
  press.angle = angle;
  press.radius = radius;
  g.presses = {press};
  return g;
}

}  // namespace garment::test
