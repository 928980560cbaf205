// The laws against their names' definitions, the coefficients against the published ones.

#include "physics/damage/softening_law.h"

#include <cmath>

#include "tests/physics/physics_checks.h"

namespace pfdm::this_file {
namespace {

TEST(SofteningLaw, FallsFromOneAndReleasesItsToughness) {
  for (const SofteningLaw& law : softening_laws()) {
    SCOPED_TRACE(law.name);
    EXPECT_NEAR(law.traction(0.0), 1.0, 1e-12);
    const double end = std::isfinite(law.final_opening) ? law.final_opening : 4000.0;
    // w = end x^4 crowds the points where the law is steep.
    constexpr int n = 200000;
    double area = 0.0;
    for (int i = 0; i < n; ++i) {
      const double x = (i + 0.5) / n;
      area += law.traction(end * std::pow(x, 4)) * end * 4.0 * std::pow(x, 3) / n;
    }
    EXPECT_NEAR(area, 1.0, 3e-4);
    EXPECT_NEAR(law.traction(end), 0.0, 1e-6);
  }
}

TEST(SofteningLaw, InitialSlopeIsThatOfTheLaw) {
  for (const SofteningLaw& law : softening_laws())
    EXPECT_NEAR(law.initial_slope, -(law.traction(1e-6) - law.traction(0.0)) / 1e-6, 2e-3) << law.name;
}

// Wu, J. Mech. Phys. Solids 103 (2017) 72, table 1.
TEST(SofteningLaw, CoefficientsAreThePublishedOnes) {
  struct Row {
    std::string_view name;
    double p, a2, a3;
  };
  for (const Row& row : {Row{"linear", 2.0, -0.5, 0.0}, Row{"exponential", 2.5, 0.1748, 0.0},
                         Row{"hyperbolic", 4.0, 0.5397, 0.0}, Row{"cornelissen", 2.0, 1.3868, 0.6567}}) {
    const RationalCoefficients c = rational_coefficients(softening_law(row.name), 30e9, 120.0, 3e6, 0.02);
    EXPECT_NEAR(c.p, row.p, 1e-12) << row.name;
    EXPECT_NEAR(c.a2, row.a2, 1e-4) << row.name;
    EXPECT_NEAR(c.a3, row.a3, 2e-4) << row.name;
    EXPECT_NEAR(c.a1, 25.4648, 1e-4) << row.name;  // 4 l_ch / (pi ell), l_ch = 400 mm
  }
}

TEST(SofteningLaw, UnknownNamesAreAnsweredWithThoseThereAre) {
  expect_unknown_name_is_answered(softening_laws(), softening_law);
}

}  // namespace
}  // namespace pfdm::this_file
