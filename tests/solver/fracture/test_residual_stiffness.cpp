// When the stiffness that broken cells keep is said to matter, and when it is all that is left.

#include "solver/fracture/damage/residual_stiffness.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfdm::this_file {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(ResidualStiffness, IsSaidOnceToFalsifyForces) {
  ResidualStiffness watch(1e-6);
  EXPECT_THAT(watch.remark({.elastic = 1.0, .residual = 0.019, .traction_work = 0.0}, 1.0, 0.1), IsEmpty());
  // 30 % at 1e-6 are 1 % at 1e-6 * 0.01 * 0.7/0.3 = 2.3e-8.
  EXPECT_THAT(watch.remark({.elastic = 4.0, .residual = 1.2, .traction_work = 0.0}, 4.0, 0.2),
              testing::AllOf(HasSubstr("30 %"), HasSubstr("2e-08 instead of 1e-06")));
  EXPECT_THAT(watch.remark({.elastic = 4.0, .residual = 1.2, .traction_work = 0.0}, 4.0, 0.3), IsEmpty());
}

TEST(ResidualStiffness, OfABrokenBodyIsSmallAgainstItsPeak) {
  ResidualStiffness watch(1e-6);
  EXPECT_THAT(watch.remark({.elastic = 1.0, .residual = 0.0, .traction_work = 0.0}, 1.0, 0.5), IsEmpty());
  EXPECT_THAT(watch.remark({.elastic = 1e-4, .residual = 1e-4, .traction_work = 0.0}, 1e-4, 0.6), IsEmpty());
}

TEST(ResidualStiffness, OfABodyThatBreaksInOneStepIsSmallAgainstWhatItCarriedBefore) {
  ResidualStiffness watch(1e-6);
  EXPECT_THAT(watch.remark({.elastic = 1e-3, .residual = 1e-3, .traction_work = 0.0}, 1.0, 3.0), IsEmpty());
  EXPECT_THAT(watch.remark({.elastic = 3e-2, .residual = 3e-2, .traction_work = 0.0}, 1.0, 3.0),
              HasSubstr("through the whole body"));
}

// After a thousand cycles the load parameter, which counts them, says nothing of the force.
TEST(ResidualStiffness, OfATiredBodyIsComparedWithItsGreatestEnergy) {
  ResidualStiffness watch(1e-6, false);
  EXPECT_THAT(watch.remark({.elastic = 1.0, .residual = 0.0, .traction_work = 0.0}, 1.0, 0.25), IsEmpty());
  EXPECT_THAT(watch.remark({.elastic = 0.9, .residual = 0.019, .traction_work = 0.0}, 0.9, 1000.25), IsEmpty());
  EXPECT_THAT(watch.remark({.elastic = 0.9, .residual = 0.09, .traction_work = 0.0}, 0.9, 2000.25),
              HasSubstr("10 % of the elastic energy"));
}

TEST(ResidualStiffness, OfABodyThatIsInTwoFromTheBeginning) {
  ResidualStiffness watch(1e-6);
  EXPECT_THAT(watch.remark({.elastic = 1.0, .residual = 0.999, .traction_work = 0.0}, 1.0, 0.1),
              HasSubstr("through the whole body"));
}

TEST(ResidualStiffness, OfABodyThatIsBentFreelyIsNone) {
  ResidualStiffness watch(1e-6);
  EXPECT_THAT(watch.remark({.elastic = -1e-9, .residual = 1e-15, .traction_work = 0.0}, -1e-9, 0.1), IsEmpty());
  EXPECT_FALSE(holds_all(1e-15, -1e-9));
}

TEST(ResidualStiffness, HoldsDeadLoadsOnlyWhereAllIsLost) {
  EXPECT_TRUE(has_collapsed({.elastic = 1.0, .residual = 0.99, .traction_work = 2.0}));
  EXPECT_FALSE(
      has_collapsed({.elastic = 1.0, .residual = 0.99, .traction_work = 0.0}));  // displacements are prescribed
  EXPECT_FALSE(has_collapsed({.elastic = 1.0, .residual = 0.3, .traction_work = 2.0}));
  // Broken cells of finite strain may store less than none.
  EXPECT_FALSE(has_collapsed({.elastic = -1e-9, .residual = 0.0, .traction_work = 0.0}));
}

}  // namespace
}  // namespace pfdm::this_file
