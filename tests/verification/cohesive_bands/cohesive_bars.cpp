// Bars whose phase field is made to produce a cohesive law (PF-CZM): traction against separation follows the law
// whatever the length ell (literature.md 3.5).

#include "tests/verification/bar.h"
#include "tests/verification/cohesive_bands/cohesive_bar.h"

#include <algorithm>
#include <string>

namespace pfdm::verification::this_file {
namespace {

struct LawError {
  double largest = 0.0;  // of the stress, over the strength
  double lowest_stress = 1.0;
  double peak = 0.0;
};

// Separations may be shorter than the law's, down to `least` times them.
LawError law_error(const std::string& label, const BarSettings& settings, double least = 1.0) {
  const Bar bar(settings);
  const SofteningLaw& law = softening_law(settings.softening);
  LawError error;
  for (const BarState& state : bar.run({{0.99, 1}, {1.05, 6}, {4.3, 50}})) {
    error.peak = std::max(error.peak, state.stress);
    if (state.separation < 1e-6) continue;
    error.lowest_stress = std::min(error.lowest_stress, state.stress);
    error.largest = std::max({error.largest, state.stress - produced_stress(law, state.separation),
                              produced_stress(law, state.separation / least) - state.stress});
  }
  report_row("PF-CZM " + label,
             {{"largest error/ft", error.largest}, {"peak/ft", error.peak}, {"down to stress", error.lowest_stress}});
  return error;
}

void expect_law(const std::string& softening, double irwin_lengths) {
  const LawError error = law_error(softening + ", E Gc/(ft^2 ell) = " + std::to_string(int(irwin_lengths)),
                                   cohesive_bar(softening, irwin_lengths));
  EXPECT_LE(error.largest, irwin_lengths > 20.0 ? 0.01 : 0.005);
  EXPECT_NEAR(error.peak, 1.0, 0.01 + 1e-9);  // the last elastic state is at 0.99
  EXPECT_LE(error.lowest_stress, softening == "linear" ? 0.01 : 0.15);
}

class CohesiveBars : public ::testing::TestWithParam<const char*> {};
TEST_P(CohesiveBars, FollowTheProducedLaw) { expect_law(GetParam(), 20.0); }
INSTANTIATE_TEST_SUITE_P(Laws, CohesiveBars, ::testing::Values("linear", "exponential", "hyperbolic", "cornelissen"));

class CohesiveBarsOfLength : public ::testing::TestWithParam<double> {};
TEST_P(CohesiveBarsOfLength, FollowTheSameLaw) { expect_law("linear", GetParam()); }
INSTANTIATE_TEST_SUITE_P(Lengths, CohesiveBarsOfLength, ::testing::Values(40.0, 80.0));

// A bar that may contract breaks at ft whatever Poisson's ratio: the law's E is the material's. Then the crack's sound
// neighbours hold it from contracting along itself, against them it opens by up to nu^2 less: with M = E/(1 - nu^2) in
// place of E.
class CohesiveBarsInPlaneStress : public ::testing::TestWithParam<const char*> {};
TEST_P(CohesiveBarsInPlaneStress, HaveTheStrengthOfTheLaw) {
  BarSettings settings = cohesive_bar("linear", 20.0);
  settings.poisson_ratio = 0.3;
  settings.plane_stress = true;
  settings.split = GetParam();
  const double nu = settings.poisson_ratio;
  const LawError error = law_error("linear, plane stress, split " + settings.split, settings, 1.0 - nu * nu);
  EXPECT_NEAR(error.peak, 1.0, 0.01 + 1e-9);  // the last elastic state is at 0.99
  EXPECT_LE(error.largest, 0.01);
  EXPECT_LE(error.lowest_stress, 0.01);
}
INSTANTIATE_TEST_SUITE_P(Splits, CohesiveBarsInPlaneStress, ::testing::Values("none", "rankine"));

}  // namespace
}  // namespace pfdm::verification::this_file
