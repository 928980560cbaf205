// pfdm analyse: records without a fit.

#include "tests/cases/page_data.h"
#include "tests/cases/temporary_case.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <sstream>

namespace pfdm::this_file {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;

constexpr double pi = 3.14159265358979323846;

std::string measured_case() {
  return R"(kind = "mass_material"
title = "measured records"
[model]
structure = "1"
mass = "1 kg"
stiffness = ["54 kN/m"]
damping = "40 N s/m"
[sampling]
rate = "1 kHz"
[[test]]
name = "sweep"
date = "2016-09-14"
record = { file = "data/sweep.csv", from = "20 Hz", to = "60 Hz" }
[[test]]
name = "random"
excitation = { type = "random", density = "0.01 g0^2/Hz", from = "10 Hz", to = "100 Hz", duration = "30 s" }
[analysis]
segment = 2048
)";
}

/// 20 s from 20 to 60 Hz: base 10 m/s^2, relative 7 at the driving frequency and 2 at twice of it.
std::string sweep_record() {
  std::string text = "# synthetic: closed form\ntime,base_acceleration,relative_acceleration\ns,m/s^2,m/s^2\n";
  for (int i = 0; i < 20000; ++i) {
    const double t = 1e-3 * i, phase = 2.0 * pi * (20.0 * t + t * t);
    text +=
        fmt::format("{},{},{}\n", t, 10.0 * std::sin(phase), 7.0 * std::sin(phase - 0.4) + 2.0 * std::cos(2.0 * phase));
  }
  return text;
}

/// Rows of a table that analyse wrote, without remarks, names and units.
std::vector<std::vector<double>> rows_of(const fs::path& file) {
  std::istringstream text(content_of(file));
  std::vector<std::vector<double>> rows;
  int head = 2;
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with("#") || head-- > 0) continue;
    std::istringstream cells(line);
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(std::stod(cell));
  }
  return rows;
}

class Analysis : public testing::Test {
 protected:
  Analysis() {
    fs::create_directories(directory.path() / "data");
    directory.write("data/sweep.csv", sweep_record());
  }
  const TemporaryCase directory{measured_case()};
  const fs::path folder = directory.results() / "analysis";
};

TEST_F(Analysis, TellsOfEveryRecord) {
  const std::string path = directory.path().string();
  ASSERT_EQ(run({"run", path}).status, 0);
  const Outcome outcome = run({"analyse", path});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("Hann window"));
  const json report = json::parse(content_of(folder / "analysis.json"));
  ASSERT_EQ(report["records"].size(), 2u);
  const json& sweep = report["records"][0];
  EXPECT_EQ(sweep["date"], "2016-09-14");
  EXPECT_EQ(sweep["motion"], "sine");
  EXPECT_NEAR(sweep["level"]["sine_amplitude_g0"].get<double>(), 10.0 / 9.80665, 1e-3);
  EXPECT_NEAR(sweep["largest_response"]["relative_over_base"].get<double>(), 0.7, 0.01);
  EXPECT_NEAR(sweep["spectra"]["resolution_Hz"].get<double>(), 1000.0 / 2048.0, 1e-12);
  EXPECT_EQ(sweep["spectra"]["segments"], (20000 - 2048) / 1024 + 1);
  EXPECT_EQ(sweep["models"][0]["name"], "model_of_the_case");
  const json& random = report["records"][1];
  EXPECT_TRUE(random["date"].is_null());
  EXPECT_EQ(random["motion"], "random");
  EXPECT_NEAR(random["level"]["base_density_g0^2_per_Hz"].get<double>(), 0.01, 0.001);
  for (const char* file : {"sweep_spectra", "sweep_spectrogram", "sweep_harmonics", "sweep_envelopes", "random_spectra",
                           "random_spectrogram"})
    EXPECT_TRUE(fs::exists(folder / fmt::format("{}.csv", file))) << file;
  EXPECT_FALSE(fs::exists(folder / "random_harmonics.csv"));
}

TEST_F(Analysis, FindsTheHarmonicsOfASweep) {
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  ASSERT_EQ(run({"analyse", directory.path().string()}).status, 0);
  for (const auto& row : rows_of(folder / "sweep_harmonics.csv")) {
    const double t = row[0];
    if (t < 2.0 || t > 18.0) continue;  // the filters reach beyond the ends of the record
    EXPECT_NEAR(row[1], 20.0 + 2.0 * t, 0.01) << t;
    EXPECT_NEAR(row[2], 10.0, 0.01) << t;
    EXPECT_NEAR(row[3], 7.0, 0.01) << t;
    EXPECT_NEAR(row[4], 2.0, 0.01) << t;
    EXPECT_NEAR(row[5], 0.0, 0.01) << t;
  }
}

// Densities in both units; the mean over the excited band is the level that was asked for.
TEST_F(Analysis, WritesDensitiesInMultiplesOfGravity) {
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  ASSERT_EQ(run({"analyse", directory.path().string()}).status, 0);
  double largest = 0.0;
  for (const auto& row : rows_of(folder / "random_spectra.csv")) {
    EXPECT_NEAR(row[3] * 9.80665 * 9.80665, row[1], 1e-12 * row[1]);
    EXPECT_NEAR(row[4] * 9.80665 * 9.80665, row[2], 1e-12 * row[2]);
    EXPECT_LE(row[6], row[5]);
    EXPECT_GE(row[7], row[5]);
    EXPECT_LE(row[13], row[12] + 1e-12);
    if (row[0] < 15.0 || row[0] > 90.0) continue;
    const double w = 2.0 * pi * row[0], H = w * w / std::hypot(54e3 - w * w, 40.0 * w);
    for (const int estimator : {5, 8, 9}) EXPECT_NEAR(row[estimator], H, 0.03 * H) << row[0];
    EXPECT_GT(row[12], 0.98);  // segments of 2 s cut off a little of a resonance that rings for 0.05 s
    largest = std::max(largest, row[3]);
  }
  EXPECT_GT(largest, 0.01);
}

TEST_F(Analysis, MakesAPageOfEachTest) {
  const std::string path = directory.path().string();
  ASSERT_EQ(run({"run", path}).status, 0);
  ASSERT_EQ(run({"report", path}).status, 0);
  EXPECT_FALSE(fs::exists(directory.results() / "report/sweep/report.pdf"));
  ASSERT_EQ(run({"analyse", path}).status, 0);
  const Outcome outcome = run({"report", path});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  for (const char* file : {"report.pdf", "sweep/report.pdf", "sweep/report.png", "random/report.pdf"})
    EXPECT_TRUE(fs::exists(directory.results() / "report" / file)) << file;
  const json analysed = json::parse(content_of(directory.results() / "analysis/analysis.json"));
  for (const json& record : analysed["records"]) {
    const fs::path file = directory.results() / "report" / record["name"].get<std::string>() / "index.html";
    const json& largest = record["largest_response"];
    EXPECT_EQ(data_of_page(content_of(file))["headline"][0],
              fmt::format("Largest response {:.4g} times the base at {:.4g} Hz.",
                          largest["relative_over_base"].get<double>(), largest["frequency_Hz"].get<double>()));
  }
  // A new run takes what belongs to the old one away.
  ASSERT_EQ(run({"run", path}).status, 0);
  EXPECT_FALSE(fs::exists(folder));
  EXPECT_FALSE(fs::exists(directory.results() / "report"));
}

// Marks that the case names are taken as they are, and not looked for.
TEST_F(Analysis, ReadsRecordsWithTheMarksThatTheCaseNames) {
  std::string text = "time;base_acceleration;relative_acceleration\ns;m/s^2;m/s^2\n";
  for (int i = 0; i < 4000; ++i) {
    const double phase = 2.0 * pi * 40.0 * 1e-3 * i;
    std::string row = fmt::format("{:.3f};{:.3f};{:.3f}\n", 1e-3 * i, 5.0 * std::sin(phase), 4.0 * std::cos(phase));
    for (char& c : row) c = c == '.' ? ',' : c;
    text += row;
  }
  directory.write("data/sweep.csv", text);
  const std::string named = replaced(measured_case(), "from = \"20 Hz\", to = \"60 Hz\"",
                                     "separator = \";\", decimal = \",\", from = \"20 Hz\", to = \"60 Hz\"");
  directory.write("case.toml", named);
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  const Outcome outcome = run({"analyse", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json report = json::parse(content_of(folder / "analysis.json"));
  EXPECT_NEAR(report["records"][0]["level"]["peak_base_acceleration_m_per_s2"].get<double>(), 5.0, 0.1);
  EXPECT_EQ(report["records"][0]["samples"], 4000);
  directory.write("case.toml", replaced(named, "decimal = \",\"", "decimal = \".\""));
  const Outcome other = run({"analyse", directory.path().string()});
  EXPECT_EQ(other.status, 2);
  EXPECT_THAT(other.err, HasSubstr("sweep.csv, line 3: \"0,000\""));
  directory.write("case.toml", replaced(named, "separator = \";\"", "separator = \",\""));
  const Outcome both = run({"analyse", directory.path().string()});
  EXPECT_EQ(both.status, 2);
  EXPECT_THAT(both.err, HasSubstr("a comma cannot separate entries and be the decimal mark"));
}

TEST_F(Analysis, SaysWhatIsWrong) {
  const BadInput rows[] = {
      {"no_date", "\"2016-09-14\"", "\"14.9.2016\"", {"is no date; expected one as \"2016-09-14\""}},
      {"no_such_day", "\"2016-09-14\"", "\"2016-02-30\"", {"is no date"}},
      {"unknown_key", "segment = 2048", "segments = 2048", {"[analysis] \"segments\"", "did you mean \"segment\"?"}},
      {"too_short", "segment = 2048", "segment = 2", {"between 16 and 16777216"}},
      {"all_overlap", "segment = 2048", "overlap = 1.0", {"between 0 and 0.95"}},
      {"no_harmonics", "segment = 2048", "harmonics = 0", {"between 1 and 10"}}};
  for (const BadInput& row : rows) {
    SCOPED_TRACE(row.name);
    directory.write("case.toml", replaced(measured_case(), row.good, row.bad));
    const Outcome outcome = run({"analyse", directory.path().string()});
    EXPECT_EQ(outcome.status, 2);
    for (const std::string& message : row.message) EXPECT_THAT(outcome.err, HasSubstr(message));
  }
  const TemporaryCase bar(bar_case());
  const Outcome outcome = run({"analyse", bar.path().string()});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("this kind of case has no \"analyse\""));
}

}  // namespace
}  // namespace pfdm::this_file
