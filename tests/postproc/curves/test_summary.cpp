#include "postproc/curves/summary.h"

#include "physics/error.h"
#include "postproc/files/atomic_file.h"
#include "tests/postproc/temporary_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <fstream>
#include <regex>
#include <utility>
#include <vector>

namespace pfdm::test::this_file {
namespace {

// Linear up to 6 N at 3 um, then broken; 25 % of the work goes astray in step 1, 0 at the peak, 10 % at the end.
std::vector<CurveRow> broken_bar() {
  return {{0, 0.0, 0.0, Vector(0, 0, 0), {0.0, 0.0, 0.0}, 0.0, 0.0, 1},
          {1, 0.25, 1e-6, Vector(0, 2, 9), {0.75e-6, 0.0, 1e-6}, 0.125, 0.0, 3},
          {2, 0.75, 3e-6, Vector(0, 6, 9), {9e-6, 0.0, 9e-6}, 0.5, 1e-15, 20},
          {3, 1.0, 4e-6, Vector(0, 0.5, 9), {1e-6, 8e-6, 10e-6}, 1.0, 1e-12, 90}};
}

TEST(Headlines, of_a_bar_that_breaks) {
  const Headlines f = headlines(broken_bar(), 1);
  EXPECT_EQ(f.peak_force, 6.0);
  EXPECT_EQ(f.displacement_at_peak, 3e-6);
  EXPECT_EQ(f.load_at_peak, 0.75);
  EXPECT_EQ(f.peak_force_at_most, 8.0);  // 4 N in half the load, then a quarter
  EXPECT_DOUBLE_EQ(f.initial_stiffness, 2e6);
  EXPECT_EQ(f.final_force, 0.5);
  EXPECT_EQ(f.final_displacement, 4e-6);
  EXPECT_EQ(f.final_load, 1.0);
  EXPECT_EQ(f.energy.elastic, 1e-6);
  EXPECT_EQ(f.energy.fracture, 8e-6);
  EXPECT_EQ(f.energy.external_work, 10e-6);
  EXPECT_EQ(f.max_damage, 1.0);
  EXPECT_EQ(f.damaged_volume, 1e-12);
  EXPECT_NEAR(f.energy_balance_error, 0.1, 1e-12);
  EXPECT_NEAR(f.max_energy_balance_error, 0.25, 1e-12);
  EXPECT_NEAR(f.released_energy, 1e-6, 1e-18);
  EXPECT_EQ(f.displacement_at_release, 4e-6);
}

TEST(Headlines, count_dissipation_in_the_balance) {
  std::vector<CurveRow> rows = broken_bar();
  rows.back().energy.viscous_dissipation = 0.5e-6;
  rows.back().energy.plastic_dissipation = 0.25e-6;
  const Headlines f = headlines(rows, 1);
  EXPECT_EQ(f.energy.viscous_dissipation, 0.5e-6);
  EXPECT_EQ(f.energy.plastic_dissipation, 0.25e-6);
  EXPECT_NEAR(f.energy_balance_error, 0.025, 1e-12);
}

TEST(Headlines, of_a_bar_that_softens_have_no_other_peak) {
  std::vector<CurveRow> rows = broken_bar();
  rows.back().force[1] = 5.5;
  EXPECT_EQ(headlines(rows, 1).peak_force_at_most, 6.0);
}

TEST(Headlines, in_compression_keep_the_sign_of_the_force) {
  std::vector<CurveRow> rows = broken_bar();
  for (CurveRow& row : rows) {
    row.force = -row.force;
    row.displacement = -row.displacement;
  }
  const Headlines f = headlines(rows, 1);
  EXPECT_EQ(f.peak_force, -6.0);
  EXPECT_EQ(f.peak_force_at_most, -8.0);
  EXPECT_EQ(f.displacement_at_peak, -3e-6);
  EXPECT_DOUBLE_EQ(f.initial_stiffness, 2e6);
}

// Cooled in two steps, then pulled from the middle of the third on.
TEST(Headlines, of_a_body_that_is_loaded_otherwise_first_have_the_stiffness_of_the_pull) {
  std::vector<CurveRow> rows;
  int step = 0;
  for (const auto& [u, force] : {std::pair{0.0, 0.0}, {0.0, 3.0}, {0.0, 6.0}, {1e-6, 9.5}, {3e-6, 13.5}}) {
    rows.push_back({step, 0.25 * step, u, Vector(0, force, 0), {}, 0.0, 0.0, 1});
    ++step;
  }
  EXPECT_DOUBLE_EQ(headlines(rows, 1).initial_stiffness, 2e6);
  rows.pop_back();
  EXPECT_DOUBLE_EQ(headlines(rows, 1).initial_stiffness, 3.5e6);
}

TEST(Headlines, of_no_curve_or_an_unloaded_one_are_not_numbers) {
  EXPECT_TRUE(std::isnan(headlines({}, 0).peak_force));
  const std::vector<CurveRow> unloaded{broken_bar().front()};
  const Headlines f = headlines(unloaded, 1);
  EXPECT_EQ(f.peak_force, 0.0);
  EXPECT_TRUE(std::isnan(f.initial_stiffness));
  EXPECT_TRUE(std::isnan(f.energy_balance_error));
  EXPECT_TRUE(std::isnan(f.max_energy_balance_error));
  EXPECT_TRUE(std::isnan(f.released_energy));
}

TEST(Summary, has_units_in_its_names_and_null_for_what_is_not_a_number) {
  const TemporaryFolder folder;
  RunSummary s;
  s.case_name = "bar";
  s.version = "1.2.3";
  s.case_hash = "abc";
  s.threads = 2;
  s.cells = 123000;
  s.cpu_seconds_by_stage = {{"damage", 1.5}, {"momentum", 20.25}};
  s.peak_memory = 1e9;
  s.figures = headlines(broken_bar(), 1);
  s.figures->initial_stiffness = Headlines::none;
  s.other_figures = {{"debonded_area_m2", 1e-9}};
  write_summary(folder / "summary.json", s);
  const auto json = nlohmann::json::parse(content_of(folder / "summary.json"));
  EXPECT_EQ(json.at("version"), "1.2.3");
  EXPECT_EQ(json.at("case_hash"), "abc");
  EXPECT_EQ(json.at("cells"), 123000);
  EXPECT_EQ(json.at("cpu_seconds_by_stage").at("momentum"), 20.25);
  EXPECT_EQ(json.at("peak_force_N").get<double>(), 6.0);
  EXPECT_EQ(json.at("displacement_at_peak_m").get<double>(), 3e-6);
  EXPECT_EQ(json.at("energy_balance_error").get<double>(), s.figures->energy_balance_error);
  EXPECT_TRUE(json.at("initial_stiffness_N_per_m").is_null());
  EXPECT_EQ(json.at("debonded_area_m2"), 1e-9);
}

TEST(Summary, has_whole_numbers_where_it_counts) {
  const TemporaryFolder folder;
  RunSummary s;
  s.peak_memory = 1e9;
  s.other_figures = {{"final_time_s", 3.0}};
  s.other_counts = {{"newton_iterations", 18482}};
  write_summary(folder / "summary.json", s);
  const std::string text = content_of(folder / "summary.json");
  for (const char* line :
       {"\"newton_iterations\": 18482", "\"peak_memory_bytes\": 1000000000", "\"final_time_s\": 3.0"})
    EXPECT_NE(text.find(line), std::string::npos) << line << " is missing in " << text;
  EXPECT_EQ(text.find("18482.0"), std::string::npos);
  const RunSummary again = read_run_summary(folder / "summary.json");
  EXPECT_EQ(again.other_counts, s.other_counts);
  EXPECT_EQ(again.other_figures, s.other_figures);
}

TEST(Summary, is_read_again) {
  const TemporaryFolder folder;
  EXPECT_FALSE(read_summary(folder / "summary.json"));
  RunSummary s;
  s.status = "complete";
  s.cells = 42;
  s.figures = headlines(broken_bar(), 1);
  s.figures->initial_stiffness = Headlines::none;
  write_summary(folder / "summary.json", s);
  const auto summary = read_summary(folder / "summary.json");
  ASSERT_TRUE(summary);
  EXPECT_EQ(summary->status, "complete");
  EXPECT_EQ(summary->numbers.front(), std::pair(std::string("threads"), 0.0));
  for (const auto& [name, value] : summary->numbers) {
    if (name == "cells") {
      EXPECT_EQ(value, 42.0);
    }
    EXPECT_EQ(std::isnan(value), name == "initial_stiffness_N_per_m") << name;
  }
  write_file(folder / "summary.json", "{");
  EXPECT_THROW(read_summary(folder / "summary.json"), InputError);
}

/// In use at present, whatever was before [bytes].
double memory_in_use() {
  std::ifstream statm("/proc/self/statm");
  double size = 0.0, resident = 0.0;
  statm >> size >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

TEST(Summary, measures_this_process) {
  const double before = peak_memory(), cpu = cpu_seconds(), in_use = memory_in_use(), growth = 5e7;
  EXPECT_GT(in_use, 1e6);
  EXPECT_GE(before, in_use - 1e6);
  const double size = before - in_use + growth;  // so that the peak grows by this much, whatever other tests took
  std::vector<char> much(static_cast<std::size_t>(size), 'x');
  EXPECT_EQ(std::count(much.begin(), much.end(), 'x'), static_cast<std::ptrdiff_t>(much.size()));
  EXPECT_NEAR(peak_memory(), before + growth, 1e7);
  const std::clock_t start = std::clock();
  while (std::clock() - start < CLOCKS_PER_SEC / 20) {
  }
  const double used = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  EXPECT_GE(cpu_seconds() - cpu, used - 0.01);
}

TEST(Summary, comes_back) {
  const TemporaryFolder folder;
  RunSummary summary;
  summary.case_name = "bar";
  summary.status = "complete";
  summary.case_hash = "0123";
  summary.cells = 7;
  summary.wall_seconds = 1.5;
  summary.wall_seconds_by_stage = {{"mesh", 0.5}, {"solve", 1.0}};
  summary.figures = headlines(broken_bar(), 1);
  summary.other_figures = {{"damaged_area_m2", 0.25}};
  write_summary(folder / "summary.json", summary);
  const RunSummary back = read_run_summary(folder / "summary.json");
  EXPECT_EQ(back.case_name, "bar");
  EXPECT_EQ(back.status, "complete");
  EXPECT_EQ(back.case_hash, "0123");
  EXPECT_EQ(back.cells, 7);
  EXPECT_EQ(back.wall_seconds, 1.5);
  EXPECT_EQ(back.wall_seconds_by_stage, summary.wall_seconds_by_stage);
  EXPECT_EQ(back.other_figures.at("damaged_area_m2"), 0.25);
  EXPECT_EQ(back.other_figures.at("peak_force_N"), 6.0);
  EXPECT_EQ(back.other_figures.count("cells"), 0u);
  put(folder / "bad.json", "{\"case\": 3}");
  EXPECT_NE(message_of<InputError>([&] { read_run_summary(folder / "bad.json"); }).find("bad.json"), std::string::npos);
  for (const char* cells : {"1e300", "-1e300", "2147483648", "1.5"}) {
    put(folder / "bad.json", std::regex_replace(content_of(folder / "summary.json"), std::regex("\"cells\": 7"),
                                                fmt::format("\"cells\": {}", cells)));
    EXPECT_NE(message_of<InputError>([&] { read_run_summary(folder / "bad.json"); }).find("is not a whole number"),
              std::string::npos)
        << cells;
  }
}

}  // namespace
}  // namespace pfdm::test::this_file
