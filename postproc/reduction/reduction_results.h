#pragma once
// reduction.json and reduction.csv: what data reduction found.

#include "postproc/reduction/reduced_test.h"

#include <filesystem>
#include <span>
#include <string>

namespace pfdm {

inline constexpr const char* reduction_file = "reduction.json";

struct ReductionReport {
  std::string case_name, case_hash, version;
  std::span<const ReducedTest> tests;
  /// Of fit.json, where the case was fitted: names and estimates of toughnesses [J/m^2].
  struct Fitted {
    std::string name, verdict;
    double estimate = not_given, lower = not_given, upper = not_given;
  };
  std::vector<Fitted> fitted{};
};

/// reduction.json: figures of each test and method. reduction.csv: a row for each point of each test, with the crack
/// length and G of every method, numbered as the comments say. Throws ComputationError.
void write_reduction(const std::filesystem::path& results, const ReductionReport& report);

/// A line for each method, and what is doubtful.
std::vector<std::string> reduction_text(const ReducedTest& test);

}  // namespace pfdm
