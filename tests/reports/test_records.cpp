// Vibration records as other programs write them.

#include "tests/reports/reported_case.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>

namespace pfdm::this_file {
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

/// Rows at 200 samples/s from this time on: { 0.005 i, sine }.
std::string sine_csv(const std::string& head, double from, int n, double frequency) {
  std::string text = head;
  for (int i = 0; i < n; ++i) {
    const double t = from + i / 200.0;
    text += fmt::format("{},{}\n", t, std::sin(6.283185307 * frequency * t) + 0.3 * std::sin(71.0 * t));
  }
  return text;
}

// Two loggers with one clock; neither simulates anything.
TEST(ReportedRecords, MayHaveBaseAndMassInTwoFiles) {
  const ReportedCase reported("21_imu_csv");
  std::ofstream(reported.path() / "base.csv") << sine_csv("Time,ACC\ns,m/s^2\n", 9.9, 820, 10.0);
  std::ofstream(reported.path() / "mass.csv") << sine_csv("time [s],Acc [m/s^2]\n", 10.0, 800, 12.0);
  std::string text = content_of(reported.path() / "case.toml");
  text.erase(text.find("[sampling]"), text.find("[[test]]") - text.find("[sampling]"));
  const std::size_t at = text.find("record = ");
  text.replace(at, text.find('\n', at) - at,
               "record = { file = \"mass.csv\", base_file = \"base.csv\", base = \"acc\", relative = \"acc\", from = "
               "\"8 Hz\", to = \"30 Hz\" }");
  std::ofstream(reported.path() / "case.toml") << text;
  const Outcome check = reported.run("check");
  EXPECT_EQ(check.status, 0) << check.err;
  EXPECT_THAT(check.out, AllOf(HasSubstr("the base's file has 820 samples, the mass's 800: 800 that both have from the "
                                         "base's sample 21 on"),
                               HasSubstr("record of 4 s at 200 samples/s")));
}

TEST(ReportedRecords, OfTwoFilesHaveOneRate) {
  const ReportedCase reported("21_imu_csv");
  std::ofstream(reported.path() / "base.csv") << "time,a\ns,m/s^2\n0,1\n0.01,2\n0.02,1\n";
  std::ofstream(reported.path() / "mass.csv") << "time,a\ns,m/s^2\n0,1\n0.02,2\n0.04,1\n";
  std::string text = content_of(reported.path() / "case.toml");
  const std::size_t at = text.find("record = ");
  text.replace(at, text.find('\n', at) - at,
               "record = { file = \"mass.csv\", base_file = \"base.csv\", base = \"a\", relative = \"a\", from = \"8 "
               "Hz\", to = \"30 Hz\" }");
  std::ofstream(reported.path() / "case.toml") << text;
  EXPECT_THAT(reported.run("check").err, HasSubstr("base.csv: it has 100 samples per second, the other file 50"));
}

TEST(ReportedRecords, SayWhichColumnsThereAre) {
  const ReportedCase reported("17_uff_padded");
  std::string text = content_of(reported.path() / "case.toml");
  text.replace(text.find("\"relative_acceleration\""), 23, "\"relative\"");
  std::ofstream(reported.path() / "case.toml") << text;
  EXPECT_THAT(reported.run("check").err,
              HasSubstr("there is no column \"relative\" (available: time, base_acceleration, relative_acceleration)"));
  text.replace(text.find("relative = \"relative\""), 21, "time = \"clock\"");
  std::ofstream(reported.path() / "case.toml") << text;
  EXPECT_THAT(reported.run("check").err, HasSubstr("there is no column \"clock\" (available: time, "));
}

// 25 Hz, 5 % of critical damping, 0.5 % of noise.
TEST(ReportedRecords, MayBeginInMotion) {
  const ReportedCase reported("20_record_in_motion");
  const Outcome fit = reported.run("fit");
  EXPECT_EQ(fit.status, 0) << fit.err;
  EXPECT_THAT(fit.out, HasSubstr("test t1 begins in motion: its first displacement and velocity are estimated too"));
  const auto json = reported.json("fit.json");
  EXPECT_EQ(json["verdict"], "sound") << fit.out;
  EXPECT_LT(json["experiments"][0]["relative_misfit"].get<double>(), 0.007);
  const auto parameter = [&](std::size_t i, const char* name, double right, double within) {
    const auto& found = json["parameters"][i];
    EXPECT_EQ(found["name"], name);
    EXPECT_NEAR(found["estimate"].get<double>() / right, 1.0, within);
    const double width = found["upper"].get<double>() - found["lower"].get<double>();
    EXPECT_LT(std::abs(found["estimate"].get<double>() - right), width);  // twice the half width of the interval
    EXPECT_LT(width, 0.02 * right);
  };
  parameter(0, "k1_N_per_m", 24674.0, 1e-3);
  parameter(1, "c_N_s_per_m", 15.708, 1e-2);
}

}  // namespace
}  // namespace pfdm::this_file
