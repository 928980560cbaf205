// Intervals of pfdm fit where noise grows with the force, or a row was dropped. SYNTHETIC data: a straight line with
// noise.

#include "tests/cases/temporary_case.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <random>
#include <string>

namespace pfdm::this_file {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// The bar is held on all sides: it is stiffer by 1/0.9.
constexpr double stiffness_33_GPa = 33e9 / 0.9 * 1e-6 / 20e-3;  // [N/m]

json fitted(const std::string& record, const std::string& deviation) {
  const TemporaryCase directory(bar_case() + R"(
[experiment]
stiffness_between = ["1 um", "5 um"]
[[experiment.specimens]]
name = "one"
csv = "one.csv"
displacement = { column = "u_m" }
force = { column = "F_N" }
)" + deviation + R"(
[fit]
[[fit.parameters]]
key = "materials.concrete.young_modulus"
bounds = ["10 GPa", "90 GPa"]
[[fit.stages]]
name = "elastic"
between = ["0 um", "6 um"]
)");
  directory.write("one.csv", record);
  const Outcome outcome = run({"fit", directory.path().string(), "--quiet"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return json::parse(content_of(directory.results() / "fit.json"));
}

// A slope rests on the rows with the largest forces: even noise would leave intervals 1.34 times too narrow.
TEST(FitScatter, NoiseThatGrowsWithTheForceWidensTheInterval) {
  std::mt19937 engine(3);
  std::normal_distribution<double> normal(0.0, 0.08);
  std::string record = "# SYNTHETIC\nu_m,F_N,s\n";
  for (int i = 1; i <= 200; ++i) {
    const double force = stiffness_33_GPa * 3e-8 * i;
    record += fmt::format("{},{},{}\n", 3e-8 * i, force * (1.0 + normal(engine)), 0.08 * force);
  }
  const json unstated = fitted(record, ""), stated = fitted(record, "deviation = { column = \"s\" }\n");
  EXPECT_EQ(unstated["verdict"], "sound") << unstated["reasons"];
  EXPECT_NEAR(unstated["parameters"][0]["widened_by"], 1.34, 0.1);
  EXPECT_LT(unstated["parameters"][0]["lower"], 33e9);
  EXPECT_GT(unstated["parameters"][0]["upper"], 33e9);
  EXPECT_THAT(unstated["warnings"].dump(), HasSubstr("the intervals are widened for it, up to 1.3 times"));
  EXPECT_THAT(unstated["warnings"].dump(), HasSubstr("the deviation of each row, stated"));
  EXPECT_EQ(stated["verdict"], "sound") << stated["reasons"];
  EXPECT_LT(stated["parameters"][0]["standard_error"], unstated["parameters"][0]["standard_error"]);
}

// A row that the machine dropped moves the slope by several standard errors.
TEST(FitScatter, ADroppedRowIsNamed) {
  std::mt19937 engine(4);
  std::normal_distribution<double> normal(0.0, 0.01 * stiffness_33_GPa * 6e-6);
  const auto record = [&](int dropped) {
    std::string rows = "# SYNTHETIC\nu_m,F_N\n";
    for (int i = 1; i <= 200; ++i)
      rows += fmt::format("{},{}\n", 3e-8 * i, i == dropped ? 0.0 : stiffness_33_GPa * 3e-8 * i + normal(engine));
    return rows;
  };
  const json whole = fitted(record(0), ""), lacking = fitted(record(180), "");
  EXPECT_EQ(whole["verdict"], "sound") << whole["reasons"];
  EXPECT_EQ(lacking["verdict"], "questionable") << lacking["reasons"];
  EXPECT_THAT(lacking["reasons"].dump(), HasSubstr("the row of one with 0 N at 5.4 um lies "));
  EXPECT_THAT(lacking["reasons"].dump(), HasSubstr("leave it out if it is an error of the record"));
}

}  // namespace
}  // namespace pfdm::this_file
