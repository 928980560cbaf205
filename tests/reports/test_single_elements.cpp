// One cell, or a column of them, as laws are tried.

#include "tests/reports/reported_case.h"

#include <gtest/gtest.h>

namespace pfdm::this_file {
namespace {

// E A u/L: uniaxial, as all that is held is at the centres of faces, or lies in planes of symmetry.
TEST(ReportedSingleElements, AreHeldBySymmetryAndByDisplacements) {
  for (const auto& [folder, force] : {std::pair{"symmetry", 100.0}, std::pair{"clamped", 50.0}}) {
    SCOPED_TRACE(folder);
    const ReportedCase element(std::string("28_single_element/") + folder);
    const Outcome run = element.run("run");
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_NEAR(element.json("summary.json")["peak_force_N"].get<double>(), force, 1e-4 * force);
  }
}

}  // namespace
}  // namespace pfdm::this_file
