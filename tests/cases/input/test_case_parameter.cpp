// Values of a case that are found, and written anew, by their keys.

#include "cases/program/input/case_files/case_parameter.h"
#include "cases/program/session/terminal/side_by_side.h"
#include "tests/cases/temporary_case.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <csignal>

namespace pfdm::this_file {
namespace {

constexpr const char* text = R"(# größe: a comment in UTF-8
[glass]
E = "70 GPa" # stiff
nu = 0.3
[[part]]
size = ["1 mm", "2 mm"]
[[part]]
size = [ "3 mm" , '4 mm']  # [1] is in other quotes
"ä" = { a = 1, b = 2 }
)";

TEST(CaseParameter, WritesValuesAnewAndLeavesAllElse) {
  EXPECT_EQ(with_value(text, "glass.E", "\"71.5 GPa\""), replaced(text, "\"70 GPa\"", "\"71.5 GPa\""));
  EXPECT_EQ(with_value(text, "glass.nu", "0.25"), replaced(text, "0.3", "0.25"));
  EXPECT_EQ(with_value(text, "part[0].size[1]", "\"5 mm\""), replaced(text, "\"2 mm\"", "\"5 mm\""));
  EXPECT_EQ(with_value(text, "part[1].size[0]", "\"5 mm\""), replaced(text, "\"3 mm\"", "\"5 mm\""));
  EXPECT_EQ(with_value(text, "part[1].size[1]", "\"5 mm\""), replaced(text, "'4 mm'", "\"5 mm\""));
  EXPECT_EQ(with_value(text, "part[1].ä.b", "7"), replaced(text, "b = 2", "b = 7"));
  EXPECT_THROW(with_value(text, "part[1].size", "1"), InputError);
  EXPECT_THROW(with_value(text, "part.size", "1"), InputError);
  EXPECT_THROW(with_value(text, "part[x]", "1"), InputError);
}

// Quotes before the last three belong to a long text, and so does one behind a backslash.
TEST(CaseParameter, WritesLongTextsAnew) {
  for (const char* old : {R"("""a""""")", R"("""a\"""b""")", "'''a\\''''", "\"\"\"\n\"\"\"", "\"\"", "\"\\\"\""}) {
    constexpr const char* document = "x = 1\nt = {} # a\ny = \"b\"\n";
    EXPECT_EQ(with_value(fmt::format(document, old), "t", "2"), fmt::format(document, "2")) << old;
  }
}

const std::string list_of_keys = R"(
keys = ["materials.concrete.toughness", "regions.weak.toughness"]
)";

TEST(CaseParameter, KeepsRatiosAndUnits) {
  const TemporaryCase directory(list_of_keys + bar_case());
  const CaseFile file = open_case(directory.path());
  const CaseParameter parameter = read_case_parameter(file.config.root().at("keys"), file);
  EXPECT_DOUBLE_EQ(parameter.value, 100.0);
  EXPECT_EQ(parameter.shown(123.456789012), "123.45679 J/m^2");
  const std::array values{150.0};
  const std::string changed = with_values(file, {&parameter, 1}, values).text;
  EXPECT_EQ(changed, replaced(replaced(file.text, "\"100 J/m^2\"", "\"150 J/m^2\""), "\"80 J/m^2\"", "\"120 J/m^2\""));
}

// ---- Processes

TEST(SideBySide, RunsEachJobOnceAndSharesTheCores) {
  std::vector<int> threads(5, 0);
  std::vector<Job> jobs;
  for (std::size_t i = 0; i < threads.size(); ++i)
    jobs.push_back({.work = [i](int n) { return static_cast<int>(10 * i) + n; },
                    .ended = [i, &threads](const JobEnd& end) { threads[i] = end.status; }});
  run_side_by_side(jobs, 4);
  for (std::size_t i = 0; i < threads.size(); ++i) {
    EXPECT_EQ(threads[i] / 10, static_cast<int>(i));
    EXPECT_GE(threads[i] % 10, 1);
  }
  std::vector<Job> alone{jobs.begin(), jobs.begin() + 1};
  run_side_by_side(alone, 4);
  EXPECT_EQ(threads[0], 4);
}

TEST(SideBySide, TellsOfJobsThatDieOrThrow) {
  std::vector<JobEnd> ends(3);
  std::vector<Job> jobs;
  for (std::size_t i = 0; i < ends.size(); ++i)
    jobs.push_back({.work =
                        [i](int) {
                          if (i == 0) std::raise(SIGKILL);
                          if (i == 1) throw std::runtime_error("no");
                          return 7;
                        },
                    .ended = [i, &ends](const JobEnd& end) { ends[i] = end; }});
  run_side_by_side(jobs, 2);
  EXPECT_EQ(ends[0].signal, SIGKILL);
  EXPECT_EQ(ends[1].status, -1);
  EXPECT_EQ(ends[1].signal, 0);
  EXPECT_EQ(ends[2].status, 7);
}

}  // namespace
}  // namespace pfdm::this_file
