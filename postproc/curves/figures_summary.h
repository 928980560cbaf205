#pragma once
// summary.json of a run that has no force-displacement curve. SI units, units in the names. Files are written whole or
// not at all; numbers that are not finite become null.

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace pfdm {

struct NamedFigures {
  std::string name;                       ///< of a test
  std::map<std::string, double> figures;  ///< with the unit in the name
  std::map<std::string, std::int64_t> counts{};
};

struct FiguresSummary {
  std::string case_name;
  std::string status;
  std::string version;
  std::string case_hash;
  int threads = 0;
  double wall_seconds = 0.0;
  std::map<std::string, double> figures;  ///< of the whole case
  std::vector<NamedFigures> tests;        ///< of a vibration case
};
void write_figures_summary(const std::filesystem::path& path, const FiguresSummary& summary);

/// The tests of a summary with their figures; numbers that are not finite are NaN. Throws InputError that names the
/// file for what is no such summary.
std::vector<NamedFigures> read_test_figures(const std::filesystem::path& path);

/// The names of the tests whose results a summary tells of; none if the file is no such summary.
std::vector<std::string> tests_of_figures_summary(const std::filesystem::path& path);

}  // namespace pfdm
