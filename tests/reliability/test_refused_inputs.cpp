// Inputs on which the program, or a library that it uses, crashed, took all memory, or did not end.

#include "tests/cases/temporary_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

namespace pfdm::this_file {
namespace {

namespace fs = std::filesystem;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;

struct Refused {
  const char* folder;  ///< of tests/reliability/inputs
  const char* command;
  std::vector<std::string> options;
  const char* words;  ///< of the message
  int status = 2;
};

void PrintTo(const Refused& input, std::ostream* stream) { *stream << input.folder; }

class RefusedInput : public testing::TestWithParam<Refused> {};

TEST_P(RefusedInput, GetsOneMessage) {
  const Refused& input = GetParam();
  const TemporaryCase directory("");
  fs::copy(fs::path(PFDM_INPUTS_DIR) / input.folder, directory.path(),
           fs::copy_options::recursive | fs::copy_options::overwrite_existing);
  std::vector<std::string> arguments{input.command, directory.path().string()};
  arguments.insert(arguments.end(), input.options.begin(), input.options.end());
  const Outcome outcome = run(arguments);
  EXPECT_EQ(outcome.status, input.status) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr(input.words));
  EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
  constexpr std::size_t longest = 300;
  EXPECT_LE(outcome.err.size(), longest + directory.path().string().size()) << outcome.err;
}

const std::vector<std::string> abaqus{"--export", "abaqus"};

std::vector<std::string> abaqus_with(const std::string& option, const std::string& value) {
  std::vector<std::string> options = abaqus;
  options.insert(options.end(), {option, value});
  return options;
}

#ifdef __SANITIZE_ADDRESS__  // which ends a process that asks for more memory than there is
constexpr const char* too_many_values = "r.h5: it is damaged: reading it crashes, or takes more than 20 s or 1.1 GB";
#else
constexpr const char* too_many_values = "r.h5: there is not enough memory for the values of \"extra\"";
#endif

// What a foreign reader does to a damaged file depends on its version, and on what is in memory beyond the file.
const Refused inputs[] = {
    {"odd_cells_size_short", "check", {}, "m.vtk"},
    {"odd_polyhedron_count_huge", "check", {}, "m.vtu"},
    {"odd_polyhedron_negative", "check", {}, "m.vtu"},
    {"odd_polyhedron_offset_huge", "check", {}, "m.vtu"},
    {"odd_polyhedron_open", "check", {}, "m.vtu"},
    {"vtu_segv", "check", {}, "m.vtu"},
    {"vtk_bad_free", "check", {}, "m.vtk"},
    {"h5_4_GB", "analyse", {}, too_many_values},
    {"mat_slow", "analyse", {}, "r.mat"},
    {"thin_layer", "check", {}, "TetGen crashes between the surfaces of the mesh"},
    {"stl_nearly_flat", "check", {}, "TetGen crashes between the surfaces of the mesh"},
    {"stl_layers_1e-9_mm", "check", {}, "TetGen crashes between the surfaces of the mesh"},
    {"bead_layers_1e-9_um", "check", {}, "TetGen crashes between the surfaces of the mesh"},
    {"stl_1e150", "check", {}, "coordinates may be up to 1000 km"},
    {"stl_needle", "run", {}, "the linear solver came no closer to balance", 1},
    {"wav_unit_1e300", "fit", {}, "a record has less than 1e+09 m/s^2"},
    {"point_twice", "check", {}, "there is another point \"centre\""},
    {"chain_figure_missing", "check", {}, "\"nothing.json\" is not a file of numbers in a step's results"},
    {"export_stiffness_1e24", "cohesive", abaqus_with("--stiffness", "1e24 Pa/m"), "at most 1e+06 strength^2 / (2 GI)"},
    {"export_stiffness_1e24", "cohesive", abaqus_with("--exponent", ""), "--exponent: a value is required"},
    {"export_stiffness_1e24", "check", {"--threads", "100000"}, "--threads: Value 100000 not in range"},
};

INSTANTIATE_TEST_SUITE_P(Inputs, RefusedInput, testing::ValuesIn(inputs));

TEST(NeedleCells, AreWarnedOf) {
  const Outcome outcome = run({"check", (fs::path(PFDM_INPUTS_DIR) / "stl_needle").string()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, ContainsRegex("is flat or a needle: two of its faces meet at 0\\.0[0-9]+ degrees"));
}

}  // namespace
}  // namespace pfdm::this_file
