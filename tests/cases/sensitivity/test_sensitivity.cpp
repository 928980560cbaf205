// pfdm sensitivity, against closed forms: a bar that softens evenly, blocks that an interface joins.

#include "postproc/files/csv_table.h"
#include "tests/cases/sensitivity/closed_forms.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace pfdm::this_file {
namespace {

using ::testing::HasSubstr;

TEST(Sensitivity, OfABarThatSoftensEvenlyHasItsClosedForm) {
  const TemporaryCase directory(short_bar());
  const auto found = found_in(directory);
  const CsvTable table = read_csv(directory.results() / "sensitivity.csv", {.has_gaps = true});
  const std::vector<double>& u = table.column("displacement_m");
  ASSERT_EQ(u.size(), 51u);
  for (const auto& [key, value] : bar_values) {
    const std::vector<double>&e = table.column("elasticity_" + key), &error = table.column("error_" + key);
    for (std::size_t i = 1; i < u.size(); ++i) {
      if (std::isnan(e[i])) continue;
      const double due = elasticity_of([&](const Values& p) { return force_of_bar(p, u[i]); }, bar_values, key);
      EXPECT_NEAR(e[i], due, 1e-4 * std::max(1.0, std::abs(due))) << key << " at " << u[i];
      EXPECT_GT(3.0 * error[i] + 1e-6, std::abs(e[i] - due));
    }
    EXPECT_TRUE(std::isnan(e[0]));
    EXPECT_FALSE(std::isnan(e[25]));
  }
  // F = (9/16) (E Gc/(3 ell))^(1/2) A at e = (Gc/(3 E ell))^(1/2).
  const std::map<std::string, double> of_force{{E_key, 0.5}, {Gc_key, 0.5}, {ell_key, -0.5}};
  for (const auto& [key, due] : of_force) {
    EXPECT_NEAR(value_of(found, "greatest force", "force", key), due, 1e-3) << key;
    EXPECT_NEAR(value_of(found, "greatest force", "displacement", key), key == E_key ? -0.5 : due, 0.02) << key;
  }
  EXPECT_TRUE(found["remarks"].empty()) << found["remarks"];
}

TEST(Sensitivity, OfGluedBlocksHasItsClosedForm) {
  const TemporaryCase directory(finely_pulled_blocks());
  found_in(directory);
  const CsvTable table = read_csv(directory.results() / "sensitivity.csv", {.has_gaps = true});
  const std::vector<double>& u = table.column("displacement_m");
  const Values values{{modulus, 1e9}, {law_strength, strength}, {law_toughness, toughness}};
  int n = 0;
  for (const auto& [key, value] : values) {
    const std::vector<double>& e = table.column("elasticity_" + key);
    for (std::size_t i = 1; i < u.size(); ++i) {
      if (std::isnan(e[i]) || u[i] < 1e-5 || u[i] > 0.7e-4) continue;
      const double due = elasticity_of([&](const Values& p) { return force_of_blocks(p, u[i]); }, values, key);
      EXPECT_NEAR(e[i], due, 2e-3 * std::max(1.0, std::abs(due))) << key << " at " << u[i];
      ++n;
    }
  }
  EXPECT_GT(n, 60);
}

TEST(Sensitivity, GoesOnWithTheRunsThatAreThere) {
  const TemporaryCase directory(short_bar());
  const std::vector<std::string> words{"sensitivity", directory.path().string(), "--parameters", Gc_key, "--step",
                                       "0.02"};
  const Outcome first = run(words);
  ASSERT_EQ(first.status, 0) << first.err;
  EXPECT_THAT(first.out, HasSubstr("5 runs made, 0 reused"));
  const std::string table = content_of(directory.results() / "sensitivity.csv");
  std::filesystem::remove(std::filesystem::directory_iterator(directory.results() / "runs")->path() / "summary.json");
  const Outcome second = run(words);
  EXPECT_THAT(second.out, HasSubstr("1 runs made, 4 reused"));
  EXPECT_EQ(content_of(directory.results() / "sensitivity.csv"), table);
  const std::string page = content_of(directory.results() / "sensitivity/index.html");
  for (const char* part : {"Elasticity of the force", "Elasticities of events", "stuff.toughness"})
    EXPECT_THAT(page, HasSubstr(part));
}

TEST(Sensitivity, KeepsTheRatiosOfKeysThatAreJoined) {
  const TemporaryCase directory(replaced(bar_case(), "poisson_ratio = 0.2", "poisson_ratio = 0.0"));
  const auto found = found_in(
      directory, {"--parameters", "materials.concrete.toughness+regions.weak.toughness", "--set",
                  "loading.initial_increment=0.01", "--set", "loading.maximum_increment=0.01", "--step", "0.1"});
  EXPECT_EQ(found["parameters"][0]["keys"].size(), 2u);
  EXPECT_THAT(content_of(directory.results() / "sensitivity/index.html"),
              HasSubstr("materials.concrete.toughness + 1 more"));
  const auto jump = of_event(found, "jump 1", "displacement", "materials.concrete.toughness");
  EXPECT_NEAR(jump["elasticity"].get<double>(), 0.5, 2.0 * jump["error"].get<double>());
}

TEST(Sensitivity, OfACornerIsThatOfBothSides) {
  const TemporaryCase directory(finely_pulled_blocks());
  for (const std::string method : {"differences", "direct"})
    expect_corner_of_blocks(found_in(directory, {"--method", method, "--set", "loading.initial_increment=0.01", "--set",
                                                 "loading.maximum_increment=0.01"}));
  // Of load steps with too few rows before it the place is open by as much as they are long.
  const auto differences = found_in(directory);
  EXPECT_TRUE(of_event(differences, "greatest force", "displacement", modulus)["doubtful"].get<bool>());
  const auto direct = found_in(directory, {"--method", "direct"});
  EXPECT_TRUE(of_event(direct, "greatest force", "displacement", modulus)["elasticity"].is_null());
}

// Damage of AT1 begins at u = L (3 Gc/(8 E ell))^(1/2), at a corner of the curve.
TEST(Sensitivity, OfTheCornerOfAT1IsWithinItsError) {
  const TemporaryCase directory(replaced(replaced(short_bar(), "AT2", "AT1"), "\"0.002 mm\"", "\"0.003 mm\""));
  for (const std::string method : {"differences", "direct"}) {
    const auto found =
        found_in(directory, {"--method", method, "--parameters", Gc_key, "--set", "loading.initial_increment=0.005",
                             "--set", "loading.maximum_increment=0.005"});
    for (const char* figure : {"displacement", "force"}) {
      const auto of = of_event(found, "greatest force", figure, Gc_key);
      EXPECT_LT(of["error"].get<double>(), 0.02) << method;
      EXPECT_NEAR(of["elasticity"].get<double>(), 0.5, of["error"].get<double>()) << method;
    }
  }
}

TEST(Sensitivity, TurnsACurveOfNegativeDisplacements) {
  const TemporaryCase pressed(
      replaced(replaced(block_pulled_twice(), "\"0.002 mm\"", "\"-0.002 mm\""), "\"0.001 mm\"", "\"-0.001 mm\""));
  for (const std::string method : {"differences", "direct"}) {
    const auto found = found_in(pressed, {"--method", method, "--parameters", E_key});
    EXPECT_NEAR(found["parameters"][0]["mean_magnitude"].get<double>(), 1.0, 1e-4) << method;
    EXPECT_THAT(found["remarks"].dump(), HasSubstr("negative displacements")) << method;
  }
}

TEST(Sensitivity, LeavesOutRowsThatFallBack) {
  const TemporaryCase directory(
      replaced(block_pulled_twice(), "[\"0.002 mm\"", "[{ expr = \"0.002*sin(6.2831853*t)\", unit = \"mm\" }"));
  const std::vector<std::string> words{
      "--parameters", E_key, "--set", "loading.initial_increment=0.05", "--set", "loading.maximum_increment=0.05"};
  const auto found = found_in(directory, words);
  EXPECT_THAT(found["remarks"].dump(), HasSubstr("15 rows of the curve fell back"));
  std::vector<std::string> direct{"sensitivity", directory.path().string(), "--method", "direct"};
  direct.insert(direct.end(), words.begin(), words.end());
  const Outcome outcome = run(direct);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("the displacement of the curve falls in step 6"));
}

TEST(Sensitivity, RefusesWhatIsNoParameter) {
  const TemporaryCase directory(short_bar());
  const std::map<std::string, std::string> refused{{"materials.stuff.toughnes", "toughnes"},
                                                   {"mesh.region", "is not a quantity with a unit"},
                                                   {"materials.stuff.poisson_ratio", "it is not positive"},
                                                   {Gc_key + "," + Gc_key, "named twice"},
                                                   {Gc_key + "+" + E_key, "must have the same dimension"}};
  for (const auto& [word, message] : refused) {
    const Outcome outcome = run({"sensitivity", directory.path().string(), "--parameters", word});
    EXPECT_EQ(outcome.status, 2) << word;
    EXPECT_THAT(outcome.err, HasSubstr("--parameters ")) << word;
    EXPECT_THAT(outcome.err, HasSubstr(message)) << word;
  }
  EXPECT_EQ(run({"sensitivity", directory.path().string(), "--step", "0"}).status, 2);
  EXPECT_FALSE(std::filesystem::exists(directory.results()));
}

// What a step makes of a value may be none that the case allows.
TEST(Sensitivity, LeavesOutAParameterThatCannotBeGreater) {
  const TemporaryCase directory(replaced(short_bar(), "poisson_ratio = 0.0", "poisson_ratio = 0.499"));
  const auto found = found_in(directory, {"--parameters", "materials.stuff.poisson_ratio," + E_key});
  EXPECT_THAT(found["parameters"][1]["failure"].get<std::string>(), HasSubstr("at most 0.4999"));
  EXPECT_EQ(found["parameters"][0]["name"], E_key);
  EXPECT_EQ(found["parameters"][0]["failure"], "");
}

}  // namespace
}  // namespace pfdm::this_file
