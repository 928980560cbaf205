// Interfaces that depend on the rate, in case files: what they say, what they write, and what is refused.

#include "postproc/files/csv_table.h"
#include "tests/cases/glued_blocks.h"

#include <gtest/gtest.h>

#include <string>

namespace pfdm::this_file {
namespace {

const std::string with_rate = linear_glue +
                              "rate = { law = \"power\", reference_rate = \"1 mm/s\", m = 0.2 }\n"
                              "branches = [{ stiffness = \"1e11 Pa/m\", time = \"10 ms\" }]\n";

std::string timed(const std::string& interface) {
  return replaced(glued_blocks(interface), "[loading]\n", "[loading]\nduration = \"0.1 s\"\n");
}

TEST(InterfaceRates, AreWrittenAndGoOnFromACheckpoint) {
  const TemporaryCase whole(timed(with_rate)), parts(timed(with_rate));
  const Outcome outcome = run({"run", whole.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  ASSERT_EQ(run({"run", parts.path().string(), "--max-steps", "4"}).status, 0);
  ASSERT_EQ(run({"run", parts.path().string(), "--restart"}).status, 0);
  const std::string curve = content_of(whole.results() / "force_displacement.csv");
  EXPECT_EQ(content_of(parts.results() / "force_displacement.csv"), curve);
  const CsvTable table = read_csv(whole.results() / "force_displacement.csv");
  EXPECT_GT(table.column("interface_viscous_dissipation_J").back(), 0.1 * 1e-6 * toughness);
  EXPECT_NE(content_of(whole.results() / "summary.json").find("interface_viscous_dissipation_J"), std::string::npos);
}

// The end moves by 12 um in a step, a tenth of the law; by 60 um in one of the coarse steps, half of it.
TEST(InterfaceRates, AreSaidToBeUnresolvedByLongSteps) {
  const std::string words = "interface \"interface_1\" depends on the rate";
  const TemporaryCase fine(timed(with_rate));
  EXPECT_EQ(run({"check", fine.path().string()}).out.find(words), std::string::npos);
  const TemporaryCase coarse(replaced(timed(with_rate), "initial_increment = 0.1\nmaximum_increment = 0.1\n",
                                      "initial_increment = 0.5\nmaximum_increment = 0.5\n"));
  EXPECT_NE(run({"check", coarse.path().string()}).out.find(words), std::string::npos);
  const Outcome outcome = run({"run", coarse.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE((outcome.out + outcome.err).find("its rate is a mean over that"), std::string::npos) << outcome.out;
}

TEST(InterfaceRates, NeedADuration) {
  for (const char* only : {"rate", "branches"}) {
    const std::string key = std::string(only) == "rate"
                                ? "rate = { law = \"logarithmic\", reference_rate = \"1 mm/s\", c = 0.1 }\n"
                                : "branches = [{ stiffness = \"1e11 Pa/m\", time = \"10 ms\" }]\n";
    const TemporaryCase directory(glued_blocks(linear_glue + key));
    expect_refused(directory,
                   {.name = only, .good = "", .bad = "", .message = {"interface", only, "duration = \"1 s\""}});
  }
  const TemporaryCase led_back(replaced(timed(with_rate), "maximum_increment = 0.1\n",
                                        "maximum_increment = 0.1\nmaximum_dissipation = \"1 uJ\"\n"));
  expect_refused(led_back, {.name = "path", .good = "", .bad = "", .message = {"maximum_dissipation", "time cannot"}});
}

TEST(InterfaceRates, NeedARuleOfMixedModeThatTakesWorkWhileItOpens) {
  const std::string ratio = "mixed_mode = \"equal_stiffness\"\nshear_ratio = ";
  for (const bool is_one : {true, false}) {
    const TemporaryCase directory(timed(with_rate + ratio + (is_one ? "1.0\n" : "0.5\n")));
    const Outcome outcome = run({"check", directory.path().string()});
    EXPECT_EQ(outcome.status, is_one ? 0 : 2) << outcome.err;
    EXPECT_EQ(outcome.err.find("cannot be combined with mixed_mode = \"equal_stiffness\" and a shear_ratio") ==
                  std::string::npos,
              is_one)
        << outcome.err;
  }
}

TEST(InterfaceRates, AreNotExported) {
  const TemporaryCase directory(timed(with_rate));
  const Outcome outcome = run({"cohesive", directory.path().string(), "--export", "abaqus"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::string deck = content_of(directory.results() / "cohesive_law" / "abaqus.inp");
  EXPECT_NE(deck.find("Rate: power of the case"), std::string::npos) << deck;
  EXPECT_NE(deck.find("Maxwell branches of the case"), std::string::npos) << deck;
}

}  // namespace
}  // namespace pfdm::this_file
