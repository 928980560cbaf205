// Beams of few or long cells.

#include "tests/reports/reported_case.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pfdm::this_file {
namespace {

nlohmann::json summary_of(const std::string& beam) {
  const ReportedCase reported("31_bending_few_cells/" + beam);
  const Outcome run = reported.run("run");
  EXPECT_EQ(run.status, 0) << run.err;
  return reported.json("summary.json");
}

// Stored in a beam under the load q per length: q^2 L^5/(1440 E I) + q^2 L^3/(24 k mu A) if both ends are clamped,
// q^2 L^5/(40 E I) + q^2 L^3/(6 k mu A) if one is; k = 5/6.
TEST(ReportedBeams, ClampedAtBothEndsUnderPressureInTwoLayers) {
  const double q = 1000.0, L = 10.0, E = 206.9e9, A = 0.1 * 0.25, I = 0.1 * std::pow(0.25, 3) / 12.0;
  const double shear = 5.0 / 6.0 * E / (2.0 * 1.29) * A;
  const double due = q * q * (std::pow(L, 5) / (1440.0 * E * I) + std::pow(L, 3) / (24.0 * shear));
  EXPECT_NEAR(summary_of("kratos_80x2")["final_elastic_energy_J"].get<double>(), due, 0.01 * due);
}

TEST(ReportedBeams, FlapUnderTractionOnItsSide) {
  const double q = 10.0, E = 4e6 / 0.91, I = std::pow(0.1, 3) / 12.0, shear = 5.0 / 6.0 * 4e6 / 2.6 * 0.1;
  const double due = q * q * (1.0 / (40.0 * E * I) + 1.0 / (6.0 * shear));
  EXPECT_NEAR(summary_of("flap_6x15")["final_elastic_energy_J"].get<double>(), due, 0.015 * due);
}

// Peaks of 3.329 and 2.645 N. The arms of the first have cells three times as long as thick; each cell of 0.25 mm that
// opens in front of them is a tooth of 1 % in its curve.
TEST(ReportedBeams, CohesiveDoubleCantileversOfFlatCells) {
  const nlohmann::json summary = summary_of("dcb_flat_cells");
  EXPECT_NEAR(summary["peak_force_N"].get<double>(), 3.329, 0.02 * 3.329);
  EXPECT_LT(summary["load_at_peak"].get<double>(), 0.51);
}

TEST(ReportedBeams, CohesiveDoubleCantileversOfSquareCells) {
  const nlohmann::json summary = summary_of("dcb_square_cells");
  EXPECT_NEAR(summary["peak_force_N"].get<double>(), 2.645, 0.01 * 2.645);
  EXPECT_NEAR(summary["load_at_peak"].get<double>(), 0.8, 1e-9);
}

}  // namespace
}  // namespace pfdm::this_file
