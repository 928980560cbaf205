// Rows that a machine dropped, and noise that grows with what was measured, in fits of materials. SYNTHETIC data.

#include "postproc/files/csv_table.h"
#include "tests/cases/endochronic_fit.h"
#include "tests/cases/viscoelastic_fit.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <random>
#include <string>

namespace pfdm::this_file {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// What was measured in row i, with noise.
using Measured = std::function<double(std::size_t i, double value)>;

/// With even noise of this deviation; zero in the row that is dropped, if there is one.
Measured record(double deviation, std::optional<std::size_t> dropped = std::nullopt) {
  return [dropped, engine = std::mt19937(3), normal = std::normal_distribution<double>(0.0, deviation)](
             std::size_t i, double value) mutable { return i == dropped ? 0.0 : value + normal(engine); };
}

/// Of all estimates.
double widest_of(const json& found) {
  double widest = 1.0;
  for (const json& p : found["parameters"]) widest = std::max(widest, p.value("widened_by", 1.0));
  return widest;
}

json fitted(const TemporaryCase& directory) {
  const Outcome outcome = run({"fit", directory.path().string(), "--quiet"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return json::parse(content_of(directory.results() / "fit.json"));
}

const std::string relaxation_fit = R"(
[fit]
branches = [1, 4]
[fit.bounds]
young_modulus = ["10 kPa", "1 GPa"]
[[fit.experiments]]
name = "relaxation"
csv = "relaxation.csv"
deformation = "shear"
time = "t_s"
strain = { column = "gamma", unit = "1" }
stress = { column = "tau", unit = "Pa" }
)";

/// A fit to the relaxation of two branches.
json relaxation_fitted(const Measured& measured) {
  const TemporaryCase directory(bulk_case + relaxation_fit);
  const PronyLaw law{.relaxed = from_young_poisson(3e5, 0.49), .shear = {{1.5e6, 0.05}, {0.8e6, 2.0}}};
  const ViscoelasticExperiment exact = relaxation_test(law, 0.0, 1, 20.0);
  std::string text = "# SYNTHETIC\nt_s,gamma,tau\n";
  for (std::size_t i = 0; i < exact.times.size(); ++i)
    text += fmt::format("{},{},{}\n", exact.times[i], exact.followed[i], measured(i, exact.channels[0].values[i]));
  directory.write("relaxation.csv", text);
  return fitted(directory);
}

TEST(RecordDoubts, ADroppedRowOfARelaxationIsNamed) {
  const json whole = relaxation_fitted(record(500.0)), lacking = relaxation_fitted(record(500.0, 80));
  EXPECT_EQ(whole["verdict"], "sound") << whole["reasons"];
  EXPECT_EQ(lacking["verdict"], "questionable") << lacking["reasons"];
  EXPECT_THAT(lacking["reasons"].dump(), HasSubstr("the row of relaxation with a stress of 0 Pa at 396.7 ms lies "));
}

TEST(RecordDoubts, NoiseOfARelaxationThatGrowsWithTheStressWidensIntervals) {
  std::mt19937 engine(4);
  std::normal_distribution<double> normal(0.0, 0.01);
  const json found = relaxation_fitted([&](std::size_t, double value) { return value * (1.0 + normal(engine)); });
  EXPECT_EQ(found["verdict"], "sound") << found["reasons"];
  EXPECT_THAT(found["warnings"].dump(), HasSubstr("a relative_noise, stated, makes the estimates exacter"));
  const double widest = widest_of(found);
  EXPECT_GT(widest, 1.25);
  EXPECT_LT(widest, 3.0);
}

/// A fit to cycles of 0.5 % strain, by a case of its own if there is one.
json cycles_fitted(const Measured& measured, const std::string& own_case = "") {
  const FitCase fit;
  const CsvTable exact = read_csv(fit.directory.path() / "cycles.csv");
  std::string text = "# SYNTHETIC\ntime_s,strain_xx,stress_xx_Pa\n";
  for (std::size_t i = 0; i < exact.n_rows(); ++i)
    text += fmt::format("{},{},{}\n", exact.column("time_s")[i], exact.column("strain_xx")[i],
                        measured(i, exact.column("stress_xx_Pa")[i]));
  fit.directory.write("cycles.csv", text);
  if (!own_case.empty()) fit.directory.write("case.toml", own_case);
  return fitted(fit.directory);
}

TEST(RecordDoubts, ADroppedRowOfCyclesIsNamed) {
  const json whole = cycles_fitted(record(5e5)), lacking = cycles_fitted(record(5e5, 23));
  EXPECT_EQ(whole["verdict"], "sound") << whole["reasons"];
  EXPECT_EQ(lacking["verdict"], "questionable") << lacking["reasons"];
  EXPECT_THAT(lacking["reasons"].dump(), HasSubstr("the row of cycles 0.5 % with a stress of 0 Pa at 766.7 ms lies "));
}

// The hardening rests on the rows with the largest stresses. Ninety rows tell so of some noise only.
TEST(RecordDoubts, NoiseOfCyclesThatGrowsWithTheStressWidensIntervals) {
  constexpr double large = 170e6;
  const std::string of_hardening = cyclic_case(true_kernel, "1.5") + replaced(replaced(fit_table, "[\"kernel\", ", "["),
                                                                              "C_1 = [\"1 GPa\", \"500 GPa\"]\n", "");
  std::mt19937 engine(6);
  std::normal_distribution<double> normal(0.0, 1e6);
  int told = 0;
  for (int k = 0; k < 10; ++k) {
    const json found = cycles_fitted(
        [&](std::size_t, double value) { return value + std::pow(value / large, 8) * normal(engine); }, of_hardening);
    const bool is_told = found["warnings"].dump().find("large values were measured") != std::string::npos;
    EXPECT_EQ(is_told, found["verdict"] == "sound" && widest_of(found) > 1.25) << found["verdict"] << found["warnings"];
    told += is_told ? 1 : 0;
  }
  EXPECT_GE(told, 2) << "of 10";
}

}  // namespace
}  // namespace pfdm::this_file
