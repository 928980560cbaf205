// Debonding as others compute it.

#include "postproc/files/csv_table.h"
#include "tests/reports/reported_case.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pfdm::this_file {
namespace {

// Forces of linear elements with cohesive lines, the same law and contact; on meshes of 0.02 and 0.01 mm 17.965 and
// 17.962, 24.364 and 24.340, 15.92 and 15.60, 9.750 and 9.603, 13.93 and 13.77 N. Here uniform meshes of 0.02 and 0.01
// mm give 17.948 and 17.955, 24.317 and 24.328, 15.27 and 15.44, 9.460 and 9.524, 13.63 and 13.69 N.
TEST(ReportedInterfaces, OfTwoInclusionsDebondBySmithAndFerrantesLaw) {
  const ReportedCase inclusions("two_inclusions");
  const Outcome run = inclusions.run("run");
  ASSERT_EQ(run.status, 0) << run.err;
  const CsvTable curve = read_csv(inclusions.results() / "force_displacement.csv");
  const std::vector<double>&u = curve.column("displacement_m"), &F = curve.column("force_x_N");
  const auto force_at = [&](double displacement) {
    const auto near = std::ranges::min_element(u, {}, [&](double x) { return std::abs(x - displacement); });
    EXPECT_NEAR(*near, displacement, 1e-9);
    return F[near - u.begin()];
  };
  EXPECT_NEAR(force_at(10e-6), 17.96, 0.003 * 17.96);
  EXPECT_NEAR(force_at(16e-6), 24.33, 0.003 * 24.33);
  // One inclusion has debonded at a jump.
  EXPECT_NEAR(force_at(17e-6), 15.5, 0.015 * 15.5);
  EXPECT_NEAR(force_at(23e-6), 9.55, 0.015 * 9.55);
  EXPECT_NEAR(force_at(40e-6), 13.7, 0.015 * 13.7);
  EXPECT_EQ(std::min_element(F.begin() + 17, F.end()) - F.begin(), 23);
}

}  // namespace
}  // namespace pfdm::this_file
