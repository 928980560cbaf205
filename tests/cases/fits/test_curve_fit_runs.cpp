// The runs of pfdm fit: found again, gone on with after a kill, shared by stages and samples.

#include "physics/error.h"
#include "postproc/files/csv_table.h"
#include "postproc/files/folder_lock.h"
#include "tests/cases/bar_fit.h"
#include "tests/cases/temporary_case.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace pfdm::this_file {
namespace {

namespace fs = std::filesystem;

/// All that a fit found, but for the time it took and the runs it found there.
nlohmann::json findings(const fs::path& results) {
  auto json = fit_in(results);
  json.erase("wall_seconds");
  json["fracture"].erase("runs");
  return json;
}

TEST(CurveFit, ReusesRunsAndDoesNotDependOnThreads) {
  const BarFit fit;
  ASSERT_EQ(run({"fit", fit.path(), "--threads", "1"}).status, 0);
  const auto first = findings(fit.directory.results());
  const int made = fit_in(fit.directory.results())["fracture"]["runs"]["made"];
  ASSERT_EQ(run({"fit", fit.path()}).status, 0);
  EXPECT_EQ(findings(fit.directory.results()), first);
  EXPECT_EQ(fit_in(fit.directory.results())["fracture"]["runs"]["made"], 0);
  EXPECT_EQ(fit_in(fit.directory.results())["fracture"]["runs"]["reused"], made);
  const fs::path other = fit.directory.path() / "other";
  ASSERT_EQ(run({"fit", fit.path(), "--threads", "3", "--output", other.string()}).status, 0);
  EXPECT_EQ(findings(other), first);
}

/// When the runs of a folder were last at work, of those that are complete.
std::map<std::string, fs::file_time_type> complete_runs(const fs::path& results) {
  std::map<std::string, fs::file_time_type> times;
  if (!fs::exists(results / "runs")) return times;
  for (const auto& entry : fs::directory_iterator(results / "runs"))
    if (content_of(entry.path() / "summary.json").find("\"complete\"") != std::string::npos)
      times[entry.path().filename()] = fs::last_write_time(entry.path() / "checkpoint.bin");
  return times;
}

void wait_until_free(const fs::path& results) {
  for (int i = 0; i < 200; ++i) {
    try {
      const FolderLock lock(results);
      return;
    } catch (const InputError&) {
      usleep(50000);
    }
  }
}

TEST(CurveFit, GoesOnAfterAKillToTheSameResult) {
  const BarFit whole;
  ASSERT_EQ(run({"fit", whole.path()}).status, 0);
  const auto expected = findings(whole.directory.results());
  const int made = fit_in(whole.directory.results())["fracture"]["runs"]["made"];
  const double seconds = fit_in(whole.directory.results())["wall_seconds"];
  std::mt19937 engine(7);
  for (int i = 0; i < 3; ++i) {
    const fs::path results = whole.directory.path() / ("killed_" + std::to_string(i));
    const pid_t pid = fork();
    if (pid == 0) _exit(run({"fit", whole.path(), "--output", results.string()}).status);
    usleep(static_cast<useconds_t>(1e6 * seconds * std::uniform_real_distribution<double>(0.1, 0.9)(engine)));
    kill(pid, SIGKILL);
    waitpid(pid, nullptr, 0);
    wait_until_free(results);  // its runs die with it
    const auto before = complete_runs(results);
    ASSERT_EQ(run({"fit", whole.path(), "--output", results.string()}).status, 0);
    EXPECT_EQ(findings(results), expected);
    const auto after = complete_runs(results);
    for (const auto& [name, time] : before) EXPECT_EQ(after.at(name), time) << name << " was run again";
    const auto runs = fit_in(results)["fracture"]["runs"];
    EXPECT_EQ(runs["made"].get<int>() + runs["reused"].get<int>(), made);
  }
}

TEST(CurveFit, GoesOnInTheSecondStageWithTheRunsOfTheFirst) {
  const BarFit fit(bar_fit + two_stages + "parameters = [\"materials.concrete.toughness\"]\n");
  const Outcome outcome = run({"fit", fit.path()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto json = fit_in(fit.directory.results());
  EXPECT_EQ(json["fracture"]["earlier_stages"][0]["name"], "elastic");
  EXPECT_NEAR(estimate(json, modulus_key), 33e9, 1e-4 * 33e9);
  EXPECT_NEAR(estimate(json, toughness_key), 110.0, 1.0);
  EXPECT_NE(json["warnings"].dump().find("was estimated in stage \\\"elastic\\\""), std::string::npos);
  EXPECT_NE(outcome.out.find("continued"), std::string::npos) << outcome.out;
  const auto& elastic = json["fracture"]["earlier_stages"][0];
  EXPECT_GT(elastic["first_guess_rms_residual"].get<double>(), 100.0 * elastic["rms_residual"].get<double>());
}

TEST(CurveFit, ShowsTheFirstGuessOfTheCaseInEveryStage) {
  const BarFit fit(bar_fit + two_stages);
  const Outcome outcome = run({"fit", fit.path()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto json = fit_in(fit.directory.results());
  EXPECT_NEAR(parameter(json, modulus_key)["first_guess"].get<double>(), 30e9, 1.0);
  EXPECT_NE(outcome.out.find("first guess 30\n"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("with the first guess "), std::string::npos) << outcome.out;
  EXPECT_GT(json["first_guess_rms_residual"].get<double>(), 5.0 * json["rms_residual"].get<double>());
}

/// Two stages: the modulus; the toughness from a sample, where the bar breaks at another displacement each time.
const std::string screened_fit = "[fit]\ndifferences = \"shared\"\ntolerance = 0.02\nspread = 0.4\n" +
                                 bar_fit.substr(bar_fit.find("[[fit.parameters]]")) + two_stages +
                                 "screened = 9\nstarts = 2\n";

TEST(CurveFit, ScreensInTheStageThatAsksForIt) {
  const BarFit fit(bar_fit.substr(0, bar_fit.find("[fit]")) + screened_fit);
  const Outcome outcome = run({"fit", fit.path()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto json = fit_in(fit.directory.results());
  EXPECT_NEAR(estimate(json, toughness_key), 110.0, 2.0);
  EXPECT_NEAR(estimate(json, modulus_key), 33e9, 5e-3 * 33e9);
  EXPECT_EQ(json["start_rms_residual"].size(), 2u);
  EXPECT_FALSE(json["fracture"]["earlier_stages"][0].contains("screened"));
  ASSERT_EQ(json["screened"].size(), 9u);
  const double rounded = 30e9 * std::exp(0.02 * std::round(50.0 * std::log(33.0 / 30.0)));
  std::set<double> values;
  for (const auto& point : json["screened"]) {
    EXPECT_NEAR(point["parameters"][0].get<double>(), rounded, 1e-9 * rounded);  // known from the stage before
    values.insert(point["parameters"][1].get<double>());
  }
  EXPECT_EQ(values.size(), 9u);
  EXPECT_NEAR(*values.begin(), 100.0 * std::exp(-0.4), 15.0);
  EXPECT_NEAR(*values.rbegin(), 100.0 * std::exp(0.4), 15.0);
}

TEST(CurveFit, FitsToOtherDataReuseTheRunsOfTheSample) {
  const BarFit fit(bar_fit.substr(0, bar_fit.find("[fit]")) + screened_fit);
  ASSERT_EQ(run({"fit", fit.path()}).status, 0);
  const auto first = fit_in(fit.directory.results());
  CsvTable data = read_csv(fit.directory.path() / "data.csv"), noisy;
  std::vector<double> force = data.column("force_N");
  std::mt19937 engine(3);
  std::normal_distribution<double> noise(0.0, 0.005 * std::ranges::max(force));
  for (double& f : force) f += noise(engine);
  noisy.comments = {"made by the test, with noise"};
  noisy.add("displacement_m", data.column("displacement_m"));
  noisy.add("force_N", force);
  write_csv(fit.directory.path() / "data.csv", noisy);
  ASSERT_EQ(run({"fit", fit.path()}).status, 0);
  const auto second = fit_in(fit.directory.results());
  EXPECT_NE(estimate(first, modulus_key), estimate(second, modulus_key));
  const int made = second["fracture"]["runs"]["made"], reused = second["fracture"]["runs"]["reused"];
  EXPECT_GT(reused, made) << made << " made, " << reused << " reused";
}

}  // namespace
}  // namespace pfdm::this_file
