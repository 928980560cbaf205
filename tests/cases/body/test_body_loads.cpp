// [loads], densities, expansions and eigenstrains in case files: what they do, that a run goes on after a stop, and
// what is refused.

#include "tests/cases/temporary_case.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace pfdm::this_file {
namespace {

constexpr double modulus = 30e9 * 0.8 / (1.2 * 0.6);  // of a bar held at its sides [Pa]
constexpr double section = 1e-6, length = 20e-3;      // [m^2], [m]
const std::string poisson_ratio = "poisson_ratio = 0.2\n";

// Between rigid ends, elastic.
std::string held_bar(const std::string& of_material, const std::string& loads) {
  std::string text = replaced(bar_case(), "frames_at = [\"0.006 mm\"]\n", "");
  text = replaced(text, "\"0.015 mm\"", "\"0 mm\"");
  text = replaced(text, poisson_ratio, poisson_ratio + "damageable = false\n" + of_material);
  return text + "[loads]\n" + loads;
}

nlohmann::json summary_of(const std::string& case_toml) {
  const TemporaryCase directory(case_toml);
  const Outcome outcome = run({"run", directory.path().string(), "--quiet"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return nlohmann::json::parse(content_of(directory.results() / "summary.json"));
}

double final_force(const nlohmann::json& summary) { return summary.at("final_force_N").get<double>(); }

// Half of the weight on each end.
TEST(BodyLoads, GravityOnADensityAndAForceAreTheSame) {
  const std::string density = "density = \"2400 kg/m^3\"\n";
  const auto weight = summary_of(held_bar(density, "gravity = [\"1000 g0\", \"0 m/s^2\", \"0 m/s^2\"]\n"));
  const auto force = summary_of(
      held_bar("", "body_force = [{ expr = \"2400*9806.65*t\", unit = \"N/m^3\" }, \"0 N/m^3\", \"0 N/m^3\"]\n"));
  EXPECT_NEAR(final_force(weight), -0.5 * 2400.0 * 9806.65 * section * length, 1e-9);
  EXPECT_NEAR(final_force(force), final_force(weight), 1e-12);
  EXPECT_LT(weight.at("energy_balance_error").get<double>(), 1e-8);
}

TEST(BodyLoads, OfOverriddenRegionsCount) {
  const std::string density = "density = \"2400 kg/m^3\"\n",
                    loads = "gravity = [\"1 km/s^2\", \"0 m/s^2\", \"0 m/s^2\"]\n";
  const std::string text =
      replaced(held_bar(density, loads), "[regions.weak]\n", "[regions.weak]\ndensity = \"12000 kg/m^3\"\n");
  // One of 21 cells, in the middle, weighs five times as much.
  EXPECT_NEAR(final_force(summary_of(text)), -0.5 * 2400.0 * 1e3 * section * length * 25.0 / 21.0, 1e-8);
}

TEST(BodyLoads, HeatPressesTheBarAgainstItsEnds) {
  // Along x alone, as the bar is held at its sides as well.
  const auto heated =
      summary_of(held_bar("expansion = [\"1e-5 1/K\", \"0 1/K\", \"0 1/K\"]\n", "temperature_change = \"20 K\"\n"));
  const auto strained = summary_of(held_bar("eigenstrain = [2e-4, 0, 0]\n", ""));
  EXPECT_NEAR(final_force(heated) / (-modulus * 2e-4 * section), 1.0, 1e-9);
  EXPECT_NEAR(final_force(strained) / final_force(heated), 1.0, 1e-12);
  EXPECT_NEAR(heated.at("eigenstrain_work_J").get<double>(), 0.5 * modulus * 4e-8 * section * length, 1e-12);
  EXPECT_LT(heated.at("energy_balance_error").get<double>(), 1e-8);
  // Its mean over the bar acts on the ends.
  const auto graded = summary_of(held_bar("expansion = [\"1e-5 1/K\", \"0 1/K\", \"0 1/K\"]\n",
                                          "temperature_change = { expr = \"2e3*x*t\", unit = \"K\" }\n"));
  EXPECT_NEAR(final_force(graded) / final_force(heated), 1.0, 1e-9);
}

TEST(BodyLoads, FromTheStartDoNotGrow) {
  for (const char* loads : {"applied = \"from_start\"\ngravity = [\"1 km/s^2\", \"0 m/s^2\", \"0 m/s^2\"]\n",
                            "gravity = [{ expr = \"1000\", unit = \"m/s^2\" }, \"0 m/s^2\", \"0 m/s^2\"]\n"}) {
    const TemporaryCase directory(held_bar("density = \"2400 kg/m^3\"\n", loads));
    ASSERT_EQ(run({"run", directory.path().string(), "--quiet", "--max-steps", "1"}).status, 0);
    const auto summary = nlohmann::json::parse(content_of(directory.results() / "summary.json"));
    EXPECT_NEAR(final_force(summary), -0.5 * 2400.0 * 1e3 * section * length, 1e-9);
    EXPECT_LT(summary.at("energy_balance_error").get<double>(), 1e-8);
  }
}

TEST(BodyLoads, GoOnAfterAStopToTheSameCurve) {
  const std::string with_weight =
      replaced(bar_case(), poisson_ratio, poisson_ratio + "density = \"2400 kg/m^3\"\nexpansion = \"1e-5 1/K\"\n") +
      "[loads]\napplied = \"from_start\"\ngravity = [\"2 km/s^2\", \"0 m/s^2\", \"0 m/s^2\"]\n"
      "temperature_change = { expr = \"-2*t\", unit = \"K\" }\n";
  const TemporaryCase whole(with_weight), stopped(with_weight);
  ASSERT_EQ(run({"run", whole.path().string(), "--quiet"}).status, 0);
  ASSERT_EQ(run({"run", stopped.path().string(), "--quiet", "--max-steps", "4"}).status, 0);
  ASSERT_EQ(run({"run", stopped.path().string(), "--quiet", "--restart"}).status, 0);
  EXPECT_EQ(content_of(stopped.results() / "force_displacement.csv"),
            content_of(whole.results() / "force_displacement.csv"));
}

class BadBodyLoads : public testing::TestWithParam<BadInput> {};

TEST_P(BadBodyLoads, AreRefused) {
  const TemporaryCase directory(replaced(bar_case() + "[loads]\ngravity = [\"1 m/s^2\", \"0 m/s^2\", \"0 m/s^2\"]\n",
                                         GetParam().good, GetParam().bad));
  const Outcome outcome = run({"run", directory.path().string(), "--quiet", "--max-steps", "1"});
  EXPECT_EQ(outcome.status, 2);
  for (const std::string& part : GetParam().message)
    EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
}

const std::string gravity = "gravity = [\"1 m/s^2\", \"0 m/s^2\", \"0 m/s^2\"]\n";

INSTANTIATE_TEST_SUITE_P(
    , BadBodyLoads,
    testing::Values(BadInput{"gravity_without_density",
                             "kind = \"fracture\"",
                             "kind = \"fracture\"",
                             {"gravity: region \"bar\" has no density", "1030 kg/m^3"}},
                    BadInput{"temperature",
                             gravity.c_str(),
                             "temperature_change = \"20 degC\"\n",
                             {"temperature_change: a change of temperature is a difference: give it in K"}},
                    BadInput{"nothing_expands",
                             gravity.c_str(),
                             "temperature_change = \"20 K\"\n",
                             {"temperature_change: no material expands"}},
                    BadInput{
                        "force_across",
                        gravity.c_str(),
                        "body_force = [\"0 N/m^3\", \"0 N/m^3\", \"1 N/m^3\"]\n",
                        {"the body force ([loads] gravity or body_force) at", "acts across a mesh one cell thick"}},
                    BadInput{"wrong_dimension",
                             gravity.c_str(),
                             "body_force = [\"0 N/m^3\", \"0 N/m^3\", \"1 N\"]\n",
                             {"body_force[2]: \"1 N\" is a force; expected a force per volume"}},
                    BadInput{"five_numbers",
                             "poisson_ratio = 0.2\n",
                             "poisson_ratio = 0.2\neigenstrain = [0, 0, 0, 0, 0]\n",
                             {"eigenstrain: expected three numbers (xx, yy, zz) or six (and yz, xz, xy), found 5"}},
                    BadInput{"way",
                             gravity.c_str(),
                             "applied = \"always\"\n",
                             {"applied: \"always\" is not a way in which loads are applied", "with_load, from_start"}}),
    [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace pfdm::this_file
