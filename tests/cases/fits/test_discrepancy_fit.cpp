// Fits whose posterior holds a discrepancy of the model ([fit] intervals = "discrepancy").

#include "postproc/files/csv_table.h"
#include "tests/cases/fits/glued_fit.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pfdm::this_file {
namespace {

using ::testing::HasSubstr;

// What is added to the force at u that no linear law has [N].
double bend(double u) { return 0.05 * std::sin(std::numbers::pi * (u - 13e-6) / 40e-6); }

// The fit is questionable, and its intervals would miss the truth. Those of the posterior hold it, and the band of the
// discrepancy holds what the model lacks.
TEST(DiscrepancyFit, HoldsTheTruthOfAModelThatLacksSomething) {
  const TemporaryCase directory(glued_fit(glue_guess, "discrepancy"));
  record_glue(directory, bend);
  const std::string place = directory.path().string();
  const Outcome outcome = run({"fit", place});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("discrepancy of the model in the posterior: "));
  EXPECT_THAT(outcome.out, HasSubstr("Only the posterior, which holds a discrepancy of the model, gives intervals"));
  const auto fit = nlohmann::json::parse(content_of(directory.results() / "fit.json"));
  ASSERT_EQ(fit["verdict"], "questionable");
  const double due[] = {strength, toughness};
  for (std::size_t k = 0; k < 2; ++k) {
    const auto& p = fit["parameters"][k];
    EXPECT_TRUE(p["lower"].is_null()) << p["name"];
    const double lower = p["posterior"]["lower"], upper = p["posterior"]["upper"];
    EXPECT_LT(lower, due[k]) << p["name"];
    EXPECT_GT(upper, due[k]) << p["name"];
    EXPECT_LT(upper - lower, 0.5 * due[k]) << p["name"];
  }
  const auto& discrepancy = fit["posterior"]["discrepancy"];
  EXPECT_LT(discrepancy["amplitude_N"]["lower"].get<double>(), 0.05);
  EXPECT_GT(discrepancy["amplitude_N"]["upper"].get<double>(), 0.05 / std::numbers::sqrt2);
  const CsvTable table = read_csv(directory.results() / discrepancy["file"].get<std::string>());
  const std::vector<double>& at = table.column("displacement_m");
  int within = 0;
  for (std::size_t i = 0; i < at.size(); ++i)
    within += table.column("lower_force_N")[i] < bend(at[i]) && bend(at[i]) < table.column("upper_force_N")[i] ? 1 : 0;
  EXPECT_GT(within, std::ssize(at) * 9 / 10);
  ASSERT_EQ(run({"report", place}).status, 0);
  const std::string page = content_of(directory.results() / "report" / "index.html");
  EXPECT_THAT(page, HasSubstr("questionable, intervals with a discrepancy of the model only"));
  EXPECT_THAT(page, HasSubstr("What the model lacks"));
}

// A model that lacks nothing: a sound fit, whose posterior is wider for what the model might lack.
TEST(DiscrepancyFit, IsSoundWhereTheModelIsRight) {
  const TemporaryCase directory(glued_fit(glue_guess, "discrepancy"));
  record_glue(directory);
  ASSERT_EQ(run({"fit", directory.path().string()}).status, 0);
  const auto fit = nlohmann::json::parse(content_of(directory.results() / "fit.json"));
  ASSERT_EQ(fit["verdict"], "sound") << fit["reasons"];
  EXPECT_LT(fit["posterior"]["discrepancy"]["amplitude_N"]["median"].get<double>(), glue_deviation);
  const double due[] = {strength, toughness};
  for (std::size_t k = 0; k < 2; ++k) {
    const auto& p = fit["parameters"][k];
    const double linear = p["upper"].get<double>() - p["lower"].get<double>();
    const double lower = p["posterior"]["lower"], upper = p["posterior"]["upper"];
    EXPECT_GT(upper - lower, linear) << p["name"];
    EXPECT_LT(upper - lower, 10.0 * linear) << p["name"];
    EXPECT_LT(lower, due[k]) << p["name"];
    EXPECT_GT(upper, due[k]) << p["name"];
  }
}

TEST(DiscrepancyFit, IsOfTheCurveAlone) {
  const TemporaryCase directory(glued_fit(glue_guess, "discrepancy", "[[experiment.events]]\nevent = \"jump\"\n"));
  record_glue(directory);
  const Outcome outcome = run({"fit", directory.path().string()});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("intervals"));
  EXPECT_THAT(outcome.err, HasSubstr("does not go with [[experiment.events]]"));
}

}  // namespace
}  // namespace pfdm::this_file
