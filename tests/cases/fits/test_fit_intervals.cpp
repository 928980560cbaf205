// Intervals by profile likelihood of pfdm fit, against those of the straight line that the model is.

#include "postproc/files/csv_table.h"
#include "tests/cases/temporary_case.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <random>

namespace pfdm::this_file {
namespace {

constexpr double deviation = 2.0;  // of the force [N]

std::string case_with(const std::string& intervals) {
  return bar_case() + R"(
[experiment]
stiffness_between = ["1 um", "5 um"]
offset = "0 um"
[[experiment.specimens]]
name = "one"
csv = "data.csv"
displacement = { column = "displacement_m" }
force = { column = "force_N" }
deviation = { column = "deviation_N" }

[fit]
)" + intervals +
         R"(
[[fit.parameters]]
key = "materials.concrete.young_modulus"
bounds = ["10 GPa", "90 GPa"]
[[fit.parameters]]
key = "experiment.offset"
bounds = ["-3 um", "3 um"]
[[fit.stages]]
name = "elastic"
between = ["0 um", "6 um"]
)";
}

struct Line {
  std::vector<double> u, force;  // [m], [N]
  double slope = 0.0;            // of the computed curve over the modulus [N/m/Pa]

  /// Least sum of squares, over its variance, over all offsets.
  double least_squares(double modulus) const {
    double mean = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < u.size(); ++i)
      mean += (force[i] - slope * modulus * u[i]) / static_cast<double>(u.size());
    for (std::size_t i = 0; i < u.size(); ++i)
      sum += std::pow((force[i] - slope * modulus * u[i] - mean) / deviation, 2);
    return sum;
  }
  /// Of the posterior of the modulus.
  double quantile(double share) const {
    constexpr double low = 10e9, step = 1e7;
    std::vector<double> sums{0.0};
    const double least = least_squares(33e9);
    for (double modulus = low; modulus < 90e9; modulus += step)
      sums.push_back(sums.back() + std::exp(0.5 * (least - least_squares(modulus))) * std::pow(33e9 / modulus, 2));
    const auto at = std::ranges::lower_bound(sums, share * sums.back()) - sums.begin();
    return low + step * static_cast<double>(at - 1);
  }
  double end_of_interval(double estimate, double beyond) const {
    const double least = least_squares(estimate);
    double in = estimate, out = beyond;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (in + out);
      (least_squares(middle) - least < 1.959964 * 1.959964 ? in : out) = middle;
    }
    return in;
  }
};

Line recorded(const TemporaryCase& directory) {
  if (run({"run", directory.path().string(), "--quiet"}).status != 0) throw std::logic_error("the bar's run fails");
  const CsvTable curve = read_csv(directory.results() / "force_displacement.csv");
  Line line{.u = {}, .force = {}, .slope = curve.column("force_x_N")[1] / curve.column("displacement_m")[1] / 30e9};
  std::mt19937 engine(5);
  std::normal_distribution<double> noise(0.0, deviation);
  for (int i = 0; i <= 60; ++i) {
    line.u.push_back(1e-7 * i);
    line.force.push_back(line.slope * 33e9 * line.u.back() + noise(engine));
  }
  CsvTable data;
  data.comments = {"SYNTHETIC, made by the test"};
  data.add("displacement_m", line.u);
  data.add("force_N", line.force);
  data.add("deviation_N", std::vector(line.u.size(), deviation));
  write_csv(directory.path() / "data.csv", data);
  return line;
}

TEST(FitIntervals, ByProfileLikelihoodAreThoseOfTheLine) {
  const TemporaryCase directory(case_with("intervals = \"profile\""));
  directory.write("data.csv", "displacement_m,force_N,deviation_N\n0,0,1\n1e-6,1,1\n");
  const Line line = recorded(directory);
  const Outcome outcome = run({"fit", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("; by profile likelihood between "), std::string::npos) << outcome.out;
  const auto fit = nlohmann::json::parse(content_of(directory.results() / "fit.json"));
  ASSERT_EQ(fit["verdict"], "sound") << fit["reasons"];
  const auto& modulus = fit["parameters"][0];
  const double estimate = modulus["estimate"];
  const double lower = line.end_of_interval(estimate, 10e9), upper = line.end_of_interval(estimate, 90e9);
  EXPECT_NEAR(modulus["profile"]["lower"].get<double>(), lower, 0.02 * (upper - lower));
  EXPECT_NEAR(modulus["profile"]["upper"].get<double>(), upper, 0.02 * (upper - lower));
  for (const auto& parameter : fit["parameters"]) {
    EXPECT_FALSE(parameter["profile"]["lower_open"].get<bool>());
    EXPECT_FALSE(parameter["profile"]["upper_open"].get<bool>());
    EXPECT_LT(parameter["profile"]["lower"].get<double>(), parameter["estimate"].get<double>());
    EXPECT_GT(parameter["profile"]["upper"].get<double>(), parameter["estimate"].get<double>());
  }
}

// Forces are slope E (u - offset). Over a uniform offset and a uniform logarithm of E the density of E is that of the
// noise over E^2.
TEST(FitIntervals, OfThePosteriorAreThoseOfTheLine) {
  const TemporaryCase directory(case_with("intervals = \"posterior\""));
  directory.write("data.csv", "displacement_m,force_N,deviation_N\n0,0,1\n1e-6,1,1\n");
  const Line line = recorded(directory);
  const Outcome outcome = run({"fit", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("; posterior: median "), std::string::npos) << outcome.out;
  const auto fit = nlohmann::json::parse(content_of(directory.results() / "fit.json"));
  ASSERT_EQ(fit["verdict"], "sound") << fit["reasons"];
  const auto& modulus = fit["parameters"][0];
  const double width = modulus["upper"].get<double>() - modulus["lower"].get<double>();
  EXPECT_NEAR(modulus["posterior"]["median"].get<double>(), line.quantile(0.5), 0.03 * width);
  EXPECT_NEAR(modulus["posterior"]["lower"].get<double>(), line.quantile(0.025), 0.06 * width);
  EXPECT_NEAR(modulus["posterior"]["upper"].get<double>(), line.quantile(0.975), 0.06 * width);
  EXPECT_LT(fit["posterior"]["emulator_error"].get<double>(), 0.03);
  EXPECT_GT(fit["posterior"]["effective_samples"].get<double>(), 1000.0);
  const CsvTable samples = read_csv(directory.results() / fit["posterior"]["file"].get<std::string>());
  EXPECT_GE(samples.n_rows(), 4000u);
  EXPECT_NO_THROW(samples.column("materials.concrete.young_modulus"));
  EXPECT_NO_THROW(samples.column("experiment.offset"));
  EXPECT_TRUE(fit["posterior"]["law_files"].empty());
}

// The estimate lies half a step, 9 %, from the grid of the differences. The standard error of a line is known.
TEST(FitIntervals, OfSharedDifferencesAreThoseOfTheLine) {
  const TemporaryCase directory(case_with("differences = \"shared\"\nstep = 0.18\n"));
  directory.write("data.csv", "displacement_m,force_N,deviation_N\n0,0,1\n1e-6,1,1\n");
  const Line line = recorded(directory);
  double mean = 0.0, squares = 0.0;
  for (const double u : line.u) mean += u / static_cast<double>(line.u.size());
  for (const double u : line.u) squares += std::pow(u - mean, 2);
  const double exact = deviation / (line.slope * std::sqrt(squares));
  nlohmann::json first;
  for (const std::string threads : {"1", "3"}) {
    const std::filesystem::path results = directory.path() / threads;
    const Outcome outcome = run({"fit", directory.path().string(), "--threads", threads, "--output", results.string()});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const auto fit = nlohmann::json::parse(content_of(results / "fit.json"));
    ASSERT_EQ(fit["verdict"], "sound") << fit["reasons"];
    EXPECT_NEAR(fit["parameters"][0]["standard_error"].get<double>(), exact, 0.015 * exact);
    if (first.is_null()) first = fit["parameters"];
    EXPECT_EQ(fit["parameters"], first);
  }
}

// A stage of two points is not sound. That matters where its estimate stays, not where the last stage estimates anew.
TEST(FitIntervals, AreMadeWhereTheLastStageMendsAnEarlierOne) {
  for (const bool anew : {true, false}) {
    const std::string stages = fmt::format(R"([[fit.stages]]
name = "few"
parameters = ["experiment.offset"]
between = ["0 um", "0.15 um"]
[[fit.stages]]
name = "elastic"
parameters = ["materials.concrete.young_modulus"{}]
)",
                                           anew ? ", \"experiment.offset\"" : "");
    const TemporaryCase directory(
        replaced(case_with("intervals = \"posterior\""), "[[fit.stages]]\nname = \"elastic\"\n", stages));
    directory.write("data.csv", "displacement_m,force_N,deviation_N\n0,0,1\n1e-6,1,1\n");
    recorded(directory);
    const Outcome outcome = run({"fit", directory.path().string()});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const auto fit = nlohmann::json::parse(content_of(directory.results() / "fit.json"));
    EXPECT_EQ(fit["verdict"], anew ? "sound" : "questionable") << fit["reasons"];
    EXPECT_EQ(fit.contains("posterior"), anew);
  }
}

TEST(FitIntervals, OfAnotherKindAreRefused) {
  const TemporaryCase directory(case_with("intervals = \"bayes\""));
  directory.write("data.csv", "displacement_m,force_N,deviation_N\n0,0,1\n1e-6,1,1\n");
  const Outcome outcome = run({"fit", directory.path().string()});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("\"bayes\" is not a kind of intervals (allowed: linear, profile, posterior, discrepancy)"),
            std::string::npos)
      << outcome.err;
}

}  // namespace
}  // namespace pfdm::this_file
