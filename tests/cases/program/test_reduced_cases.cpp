// What pfdm reduce makes of doubtful input.

#include "tests/cases/bar_fit.h"
#include "tests/cases/temporary_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <filesystem>

namespace pfdm::this_file {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// 1 N and 0.1 mm more in each row.
std::string rising_rows() {
  std::string text = "u;f\n";
  for (int i = 0; i <= 40; ++i) text += fmt::format("{:.4f};{:.4f}\n", 0.1 * i, 1.0 * i);
  return text;
}

/// A case whose record has its dimensions in `table`.
std::string with_reduction(const std::string& table) {
  return bar_case() + measured_specimen() + "\n[experiment.reduction]\n" + table;
}

const std::string beam =
    "specimen = \"double_cantilever_beam\"\nwidth = \"25 mm\"\nthickness = \"3 mm\"\ncrack_length = \"50 mm\"\n";

TEST(ReducedCases, NeedAllKeysThatAreMeantTogether) {
  for (const auto& [key, message] : {std::pair("block_offset = \"5 mm\"", "block_offset and block_length"),
                                     {"block_length = \"10 mm\"", "block_offset and block_length"},
                                     {"young_modulus = \"130 GPa\"", "young_modulus"}}) {
    const TemporaryCase directory(with_reduction(beam + key + "\n"));
    fs::create_directories(directory.path() / "data");
    directory.write("data/one.csv", rising_rows());
    const Outcome outcome = run({"reduce", directory.path().string()});
    EXPECT_EQ(outcome.status, 2) << key;
    EXPECT_THAT(outcome.err, HasSubstr(message));
  }
  const TemporaryCase directory(with_reduction(beam + "block_offset = \"5 mm\"\nblock_length = \"10 mm\"\n"));
  fs::create_directories(directory.path() / "data");
  directory.write("data/one.csv", rising_rows());
  EXPECT_EQ(run({"reduce", directory.path().string()}).status, 0);
}

// No row lies below half of the greatest force: enough for a fit of the modulus.
TEST(ReducedCases, NeedNoReductionForAFit) {
  const std::string start = bar_fit.substr(0, bar_fit.find("[fit]"));
  const TemporaryCase directory(BarFit::marked_bar() + start + "[experiment.reduction]\n" + beam +
                                "[fit]\n[[fit.parameters]]\nkey = \"materials.concrete.young_modulus\"\n"
                                "bounds = [\"10 GPa\", \"90 GPa\"]\n"
                                "[[fit.stages]]\nname = \"elastic\"\nbetween = [\"0 um\", \"6 um\"]\n");
  std::string rows = "displacement_m,force_N\n";
  for (int i = 8; i <= 12; ++i) rows += fmt::format("{},{}\n", 0.5e-6 * i, 33e9 / 0.9 * 1e-6 / 20e-3 * 0.5e-6 * i);
  directory.write("data.csv", rows);
  const Outcome checked = run({"check", directory.path().string()});
  EXPECT_EQ(checked.status, 0) << checked.err;
  EXPECT_THAT(checked.out, HasSubstr("initial compliance needs three"));
  const Outcome fitted = run({"fit", directory.path().string()});
  EXPECT_EQ(fitted.status, 0) << fitted.err;
  EXPECT_THAT(fitted.out, HasSubstr("initial compliance needs three"));
  EXPECT_TRUE(fs::exists(directory.results() / "fit.json"));
  EXPECT_EQ(run({"reduce", directory.path().string()}).status, 2);
}

}  // namespace
}  // namespace pfdm::this_file
