// Endochronic materials in a case of kind "fracture".

#include "postproc/files/csv_table.h"
#include "tests/cases/temporary_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace pfdm::this_file {
namespace {

using ::testing::HasSubstr;

const std::string kernel = R"(kernel = [{ C = "20 GPa", alpha = 2000 }, { C = "5 GPa", alpha = 0 }]
)";

// The bar of a material with a history, pulled to and fro, and then until it breaks: with this ell at once. With
// shorter ones several equilibria compete, and rounding decides which is found.
std::string plastic_bar() {
  std::string text = replaced(bar_case(), "toughness = \"100 J/m^2\"\n", "toughness = \"100 J/m^2\"\n" + kernel);
  text = replaced(text, "displacement = [\"0.015 mm\", \"free\", \"free\"]",
                  R"(displacement = [{ expr = "0.007*sin(8*pi*t) + 0.03*t", unit = "mm" }, "free", "free"])");
  text = replaced(text, "length = \"4 mm\"", "length = \"6 mm\"");
  text = replaced(text, "frames_at = [\"0.006 mm\"]", "frames_every = 5");
  return replaced(text, "initial_increment = 0.1\nmaximum_increment = 0.1",
                  "initial_increment = 0.01\nmaximum_increment = 0.01");
}

TEST(EndochronicFracture, BarBreaksAndItsWorkIsAccountedFor) {
  const TemporaryCase directory(plastic_bar());
  const Outcome outcome = run({"run", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const CsvTable curve = read_csv(directory.results() / "force_displacement.csv");
  const auto& force = curve.column("force_x_N");
  const auto& heat = curve.column("plastic_dissipation_J");
  EXPECT_LT(std::ranges::min(force), 0.0);
  EXPECT_LT(force.back(), 0.05 * std::ranges::max(force));
  EXPECT_TRUE(std::ranges::is_sorted(heat));
  const auto broken = std::ranges::find_if(curve.column("max_damage"), [](double d) { return d > 0.9; });
  const auto last_sound = static_cast<std::size_t>(broken - curve.column("max_damage").begin()) - 1;
  const auto at = [&](const char* name) { return curve.column(name)[last_sound]; };
  EXPECT_NEAR(at("elastic_energy_J") + at("fracture_energy_J") + at("plastic_dissipation_J"), at("external_work_J"),
              0.005 * at("external_work_J"));
  EXPECT_GT(at("plastic_dissipation_J"), 0.03 * at("external_work_J"));
  // At the break energy is released, and none appears.
  EXPECT_LT(curve.column("elastic_energy_J").back() + curve.column("fracture_energy_J").back() + heat.back(),
            curve.column("external_work_J").back());
  EXPECT_THAT(content_of(directory.results() / "fields" / "step_000005.vtu"), HasSubstr("plastic_strain"));
}

TEST(EndochronicFracture, ARunThatIsGoneOnWithEqualsAnUnbrokenOne) {
  const TemporaryCase unbroken(plastic_bar()), broken(plastic_bar());
  ASSERT_EQ(run({"run", unbroken.path().string(), "--quiet"}).status, 0);
  const std::string place = broken.path().string();
  ASSERT_EQ(run({"run", place, "--max-steps", "7", "--quiet"}).status, 0);
  ASSERT_EQ(run({"run", place, "--restart", "--quiet"}).status, 0);
  EXPECT_EQ(content_of(broken.results() / "force_displacement.csv"),
            content_of(unbroken.results() / "force_displacement.csv"));
}

class RefusedHistory : public ::testing::TestWithParam<BadInput> {};

TEST_P(RefusedHistory, IsNamed) {
  const BadInput& input = GetParam();
  expect_refused(TemporaryCase(replaced(plastic_bar(), input.good, input.bad)), input);
}

INSTANTIATE_TEST_SUITE_P(
    EndochronicFracture, RefusedHistory,
    ::testing::Values(
        BadInput{"Split", "split = \"none\"", "split = \"spectral\"", {"regions", "\"spectral\"", "allowed: none"}},
        BadInput{"OtherModulus",
                 "toughness = \"80 J/m^2\"",
                 "young_modulus = \"20 GPa\"",
                 {"weak", "endochronic", "material of its own"}},
        BadInput{"VaryingModulus",
                 "young_modulus = \"30 GPa\"",
                 "young_modulus = { expr = \"30 + x\", unit = \"GPa\" }",
                 {"young_modulus"}},
        BadInput{"RateWithoutTime",
                 "[regions.weak]",
                 "rate = { law = \"logarithmic\", c = 0.1, reference_rate = \"1e-3 1/s\" }\n[regions.weak]",
                 {"depends on the rate", "duration"}},
        BadInput{"Dissipation",
                 "initial_increment = 0.01\n",
                 "initial_increment = 0.01\nmaximum_dissipation = \"1 uJ\"\n",
                 {"maximum_dissipation", "endochronic"}},
        BadInput{"Kernel", "alpha = 0 }", "alpha = -1 }", {"alpha", "-1"}}),
    [](const auto& input) { return input.param.name; });

}  // namespace
}  // namespace pfdm::this_file
