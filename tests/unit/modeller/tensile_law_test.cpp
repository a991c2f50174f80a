#include "runtime/modeller/tensile_law.hpp"

#include <catch2/catch.hpp>

using namespace garment;

namespace {

double work_to(const model::TensileLaw& law, double strain) {
  const int n = 20000;
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += modeller::tensile_force(law, strain * (i + 0.5) / n);
  return sum * strain / n;
}

}  // namespace

TEST_CASE("the tensile law meets Fm, EM and WT of the record") {
  for (double linearity : {0.3, 0.45, 0.62, 0.8, 0.97, 1.0, 1.1, 1.25}) {
    for (double em : {0.02, 0.06, 0.25}) {
      design::Tensile record{em, linearity, 490.3325, 0.6};
      model::TensileLaw law = modeller::make_tensile_law(record);
      INFO("LT " << linearity << " EM " << em);
      CHECK(modeller::tensile_force(law, em) == record.max_force);
      CHECK(work_to(law, em) == Approx(linearity * record.max_force * em / 2).epsilon(1e-3));
      CHECK(modeller::tensile_force(law, 0) == 0);
    }
  }
}

TEST_CASE("the tensile law rises everywhere and has no kink") {
  for (double linearity : {0.05, 0.3, 0.62, 0.9, 1.0, 1.2, 2.0}) {
    model::TensileLaw law = modeller::make_tensile_law({0.06, linearity, 490.3325, 0.6});
    double before = modeller::tensile_force(law, -0.02), slope_before = 0;
    for (int i = 1; i <= 3000; ++i) {
      double e = -0.02 + 0.12 * i / 3000, now = modeller::tensile_force(law, e);
      double slope = (now - before) / (0.12 / 3000);
      REQUIRE(slope > 0);
      if (i > 1) REQUIRE(std::abs(slope - slope_before) < 0.25 * (slope + slope_before));
      before = now;
      slope_before = slope;
    }
  }
}

TEST_CASE("a linear record gives Hooke's law in tension and compression") {
  model::TensileLaw law = modeller::make_tensile_law({0.05, 1.0, 100, 0.6});
  for (double e : {-0.3, -0.01, 0.0, 0.003, 0.02, 0.05, 0.4})
    CHECK(modeller::tensile_force(law, e) == Approx(2000 * e).margin(1e-10));
}
