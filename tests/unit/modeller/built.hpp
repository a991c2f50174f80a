#pragma once
// Models of garments that must be buildable.
#include <catch2/catch.hpp>

#include "runtime/modeller/modeller.hpp"

namespace garment::test {

/// The model of `g`; the test fails, with what was found, where there is none.
inline model::Model build(const design::Garment& g) {
  modeller::ModelResult result = modeller::build_model(g, {});
  for (const Finding& f : result.findings) UNSCOPED_INFO(f.code << " " << f.message);
  REQUIRE(result.model);
  return *result.model;
}

}  // namespace garment::test
