// Vibration records as other programs write them.

#include "tests/reports/reported_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace pfdm {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(ReportedRecords, MayFillTheLastLineOfAUniversalFile) {
  const Outcome check = ReportedCase("17_uff_padded").run("check");
  EXPECT_EQ(check.status, 0) << check.err;
  EXPECT_THAT(check.out, AllOf(HasSubstr("record of 3.598 s at 500 samples/s"),
                               HasSubstr("what follows its 1799 values (1 zero) is left out")));
}

// The record is read, and then found too short: 2.5 s.
TEST(ReportedRecords, MayBeInMultiplesOfGravity) {
  const Outcome check = ReportedCase("19_uff_unit_g").run("check");
  EXPECT_THAT(check.out, HasSubstr("\"1\" is an acceleration in g: multiples of gravity (g0)"));
  EXPECT_THAT(check.err, HasSubstr("too_short: 2.5 s contain 7.5 periods of 3 Hz"));
}

// Likewise: 3.33 s at the 120 samples/s of the case, by a clock that counts microseconds and does not say so.
TEST(ReportedRecords, MayHaveNoRowOfUnits) {
  const ReportedCase reported("21_imu_csv");
  const Outcome check = reported.run("check");
  EXPECT_THAT(check.out, HasSubstr("the times in \"SampleTimeFine\" have no unit: us gives the rate that is stated"));
  EXPECT_THAT(check.err, HasSubstr("too_short: 3.33 s contain 3.3 periods of 1 Hz"));
}

}  // namespace
}  // namespace pfdm
