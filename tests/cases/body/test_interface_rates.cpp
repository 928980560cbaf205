// Interfaces that depend on the rate, in case files: what they say, what they write, and what is refused.

#include "postproc/files/csv_table.h"
#include "tests/cases/glued_blocks.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

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

/// Of bead_rates with few faces.
struct Debonding {
  double stiffness, displacement;  // [N/m], [m] where the force first falls
};

Debonding debonding_of(const std::string& file, const std::string& duration) {
  const TemporaryCase place("");
  const std::filesystem::path path = std::filesystem::path(PFDM_CASES_DIR) / "bead_rates" / file;
  const Outcome outcome = run({"run", path.string(), "--output", place.results().string(), "--quiet", "--set",
                               "loading.duration=" + duration, "--set", "mesh.particles[0].subdivisions=2"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const CsvTable curve = read_csv(place.results() / "force_displacement.csv");
  const std::vector<double>&u = curve.column("displacement_m"), &force = curve.column("force_z_N");
  std::size_t i = 1;
  while (i + 1 < u.size() && force[i + 1] > force[i]) ++i;
  return {force[1] / u[1], u[i]};
}

// A faster test is stiffer and debonds earlier by the binder, debonds later at the same stiffness by the interface.
TEST(InterfaceRates, OfBeadRatesTellBinderFromInterface) {
  const Debonding slow = debonding_of("case.toml", "100 s"), fast = debonding_of("case.toml", "10 ms");
  EXPECT_NEAR(fast.stiffness, slow.stiffness, 1e-3 * slow.stiffness);
  EXPECT_GT(fast.displacement, 1.5 * slow.displacement);
  EXPECT_LT(fast.displacement, 350e-6);
  const Debonding slow_binder = debonding_of("binder.toml", "100 s"),
                  fast_binder = debonding_of("binder.toml", "10 ms");
  EXPECT_GT(fast_binder.stiffness, 1.3 * slow_binder.stiffness);
  EXPECT_LT(fast_binder.displacement, 0.9 * slow_binder.displacement);
}

}  // namespace
}  // namespace pfdm::this_file
