// Cases of kind mass_material whose records, or whose base, come from a file.

#include "cases/program/input/case_files/case_file.h"
#include "cases/program/vibration/mass_material_case.h"
#include "tests/cases/soft_sample.h"
#include "tests/cases/temporary_case.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <filesystem>
#include <sstream>
#include <string>

namespace pfdm::this_file {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

TEST(MassMaterialProgram, FitsARecordFromAFile) {
  const TemporaryCase directory(soft_case());
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  fs::create_directories(directory.path() / "data");
  fs::copy_file(directory.results() / "up.csv", directory.path() / "data/a.csv");
  const std::string text = replaced(
      soft_case(),
      "excitation = { type = \"swept_sine\", level = \"2 g0\", from = \"10 Hz\", to = \"70 Hz\", duration = \"6 s\" }",
      "record = { file = \"data/a.csv\", from = \"10 Hz\", to = \"70 Hz\" }");
  directory.write("case.toml", text);
  const Outcome outcome = run({"fit", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NEAR(parsed(directory.results() / "fit.json")["parameters"][5]["estimate"].get<double>(), 40.0, 0.02);
  // A bad one is refused by file and name of the fault.
  std::string spoilt = content_of(directory.path() / "data/a.csv");
  const std::size_t line = spoilt.find("\n3,");
  spoilt.erase(line, spoilt.find("\n3.1,") - line);
  directory.write("data/a.csv", spoilt);
  const Outcome refused = run({"fit", directory.path().string()});
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("a.csv: gap: 0.1 s are missing"), std::string::npos) << refused.err;
}

// As integers of a recorder whose channels have full scales of 20 and 50 g0.
TEST(MassMaterialProgram, ReadsChannelsInUnitsOfTheirOwn) {
  const TemporaryCase directory(soft_case());
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  std::istringstream lines(content_of(directory.results() / "up.csv"));
  std::string scaled = "time,base_acceleration,relative_acceleration\ns,1,1\n";
  for (std::string line; std::getline(lines, line);) {
    double time = 0.0, base = 0.0, relative = 0.0;
    if (std::sscanf(line.c_str(), "%lf,%lf,%lf", &time, &base, &relative) == 3)
      scaled += fmt::format("{},{},{}\n", time, base / (20.0 * 9.80665), relative / (50.0 * 9.80665));
  }
  directory.write("scaled.csv", scaled);
  const auto fit = [&](const char* units) {
    directory.write(
        "case.toml",
        replaced(soft_case(),
                 "excitation = { type = \"swept_sine\", level = \"2 g0\", from = \"10 Hz\", to = \"70 Hz\", "
                 "duration = \"6 s\" }",
                 fmt::format("record = {{ file = \"scaled.csv\", from = \"10 Hz\", to = \"70 Hz\", {} }}", units)));
    return run({"fit", directory.path().string()});
  };
  EXPECT_EQ(fit("base_unit = \"20 g0\", relative_unit = \"50 g0\"").status, 0);
  EXPECT_NEAR(parsed(directory.results() / "fit.json")["parameters"][5]["estimate"].get<double>(), 40.0, 0.02);
  EXPECT_EQ(fit("unit = \"20 g0\", relative_unit = \"50 g0\"").status, 0);
  EXPECT_NEAR(parsed(directory.results() / "fit.json")["parameters"][5]["estimate"].get<double>(), 40.0, 0.02);
  const Outcome refused = fit("unit = \"50 g0\", base_unit = \"20 mm\"");
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("scaled.csv: column \"base_acceleration\""), std::string::npos) << refused.err;
}

// The same record, with the mass's own acceleration x'' = y'' + z'' in the place of z''.
TEST(MassMaterialProgram, FitsARecordOfTheAbsoluteAcceleration) {
  const TemporaryCase directory(soft_case());
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  std::istringstream lines(content_of(directory.results() / "up.csv"));
  std::string absolute;
  for (std::string line; std::getline(lines, line);) {
    double time = 0.0, base = 0.0, relative = 0.0;
    absolute += std::sscanf(line.c_str(), "%lf,%lf,%lf", &time, &base, &relative) == 3
                    ? fmt::format("{},{},{}\n", time, base, base + relative)
                    : line + "\n";
  }
  directory.write("absolute.csv", absolute);
  const auto fitted = [&](const char* key) {
    directory.write(
        "case.toml",
        replaced(soft_case(),
                 "excitation = { type = \"swept_sine\", level = \"2 g0\", from = \"10 Hz\", to = \"70 Hz\", "
                 "duration = \"6 s\" }",
                 fmt::format("record = {{ file = \"absolute.csv\", from = \"10 Hz\", to = \"70 Hz\"{} }}", key)));
    EXPECT_EQ(run({"fit", directory.path().string()}).status, 0);
    return parsed(directory.results() / "fit.json");
  };
  const json right = fitted(", acceleration = \"absolute\"");
  EXPECT_EQ(right["verdict"], "sound") << right["reasons"];
  EXPECT_NEAR(right["parameters"][5]["estimate"].get<double>(), 40.0, 0.02);
  const json wrong = fitted("");
  EXPECT_EQ(wrong["verdict"], "questionable");
  EXPECT_NE(wrong["reasons"][0].get<std::string>().find("(absolute) acceleration"), std::string::npos);
}

TEST(MassMaterialProgram, ShakesWithAMeasuredBase) {
  const TemporaryCase directory(soft_case());
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  fs::copy_file(directory.results() / "up.csv", directory.path() / "base.csv");
  const std::string text = replaced(
      soft_case(), "type = \"swept_sine\", level = \"2 g0\", from = \"10 Hz\", to = \"70 Hz\", duration = \"6 s\"",
      "type = \"measured\", file = \"base.csv\", from = \"10 Hz\", to = \"70 Hz\"");
  directory.write("case.toml", text);
  const fs::path again = directory.path() / "again";
  const Outcome outcome = run({"run", directory.path().string(), "--output", again.string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const double first = parsed(directory.results() / "summary.json")["tests"][0]["peak_relative_displacement_m"];
  const double second = parsed(again / "summary.json")["tests"][0]["peak_relative_displacement_m"];
  EXPECT_NEAR(second, first, 1e-3 * first);
}

}  // namespace
}  // namespace pfdm::this_file
