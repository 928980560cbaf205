// Material parameters and initial damage that are functions of the place.

#include "tests/cases/temporary_case.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace pfdm::this_file {
namespace {

constexpr double length = 20e-3, section = 1e-6;      // [m], [m^2]
constexpr double modulus = 30e9 * 0.8 / (1.2 * 0.6);  // of a bar held at its sides [Pa]
const std::string young_modulus = "young_modulus = \"30 GPa\"";
const std::string two_steps = "[loading]\nend = 0.2\ninitial_increment = 0.1";

std::string short_bar() {
  const std::string text = replaced(bar_case(), "[loading]\ninitial_increment = 0.1", two_steps);
  return replaced(text, "frames_at = [\"0.006 mm\"]\n", "");
}

nlohmann::json summary_of(const std::string& case_toml) {
  const TemporaryCase directory(case_toml);
  const Outcome outcome = run({"run", directory.path().string(), "--quiet"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return nlohmann::json::parse(content_of(directory.results() / "summary.json"));
}

double stiffness(const nlohmann::json& summary) { return summary.at("initial_stiffness_N_per_m").get<double>(); }

TEST(VaryingMaterials, BarWhoseCompliancesRiseLinearlyHasTheirMean) {
  const auto summary =
      summary_of(replaced(short_bar(), young_modulus, "young_modulus = { expr = \"30/(1 + 50*x)\", unit = \"GPa\" }"));
  EXPECT_NEAR(stiffness(summary) / (modulus * section / length), 1.0 / (1.0 + 50.0 * length / 2.0), 1e-7);
}

TEST(VaryingMaterials, OfOnePlaceAreThoseOfAPlainValue) {
  std::string text = replaced(bar_case(), young_modulus, "young_modulus = { expr = \"30 + 0*x\", unit = \"GPa\" }");
  text = replaced(text, "poisson_ratio = 0.2", "poisson_ratio = { expr = \"0.2 + 0*y\" }");
  text = replaced(text, "toughness = \"100 J/m^2\"", "toughness = { expr = \"100 + 0*z\", unit = \"J/m^2\" }");
  const TemporaryCase varying(text), plain(bar_case());
  for (const TemporaryCase* directory : {&varying, &plain})
    ASSERT_EQ(run({"run", directory->path().string(), "--quiet"}).status, 0);
  EXPECT_EQ(content_of(varying.results() / "force_displacement.csv"),
            content_of(plain.results() / "force_displacement.csv"));
}

TEST(VaryingMaterials, BarBreaksWhereItIsWeakest) {
  // The toughness falls towards x = 5 mm; the bar of plain values breaks at 10 mm.
  const std::string text = replaced(bar_case(), "toughness = \"100 J/m^2\"",
                                    "toughness = { expr = \"abs(x - 0.005) < 0.0005 ? 50 : 100\", unit = \"J/m^2\" }");
  const double weak = summary_of(text).at("peak_force_N"), plain = summary_of(bar_case()).at("peak_force_N");
  EXPECT_LT(weak, 0.9 * plain);
}

TEST(InitialDamage, SoftensTheBar) {
  const auto summary = summary_of(short_bar() + "[initial]\ndamage = 0.5\n");
  EXPECT_NEAR(stiffness(summary) / (modulus * section / length), 0.25, 1e-5);
  EXPECT_LT(summary.at("energy_balance_error").get<double>(), 1e-6);
}

TEST(InitialDamage, OfAPlaneIsACrack) {
  const auto summary = summary_of(short_bar() + "[initial]\ndamage = { expr = \"abs(x - 0.01) < 0.0004 ? 1 : 0\" }\n");
  EXPECT_LT(stiffness(summary), 1e-3 * modulus * section / length);
}

}  // namespace
}  // namespace pfdm::this_file
