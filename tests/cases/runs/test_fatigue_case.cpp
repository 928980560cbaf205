// Fatigue in case files: what a run writes of it, that a run goes on after a stop and after a jump over cycles, and
// what is refused.

#include "postproc/files/csv_table.h"
#include "tests/cases/temporary_case.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pfdm::this_file {
namespace {

// A bar that breaks after some 35 cycles.
const std::string weakened_bar = R"toml(kind = "fracture"
title = "a bar under cycles of tension"
[mesh]
generator = "box_hexes"
x = [{ length = "20 mm", cells = 21 }]
y = [{ length = "1 mm", cells = 1 }]
z = [{ length = "1 mm", cells = 1 }]
[materials.stone]
regions = ["body"]
young_modulus = "30 GPa"
poisson_ratio = 0.2
toughness = "100 J/m^2"
fatigue = { law = "asymptotic", threshold = "20 kJ/m^3" }
[fracture]
model = "AT1"
split = "none"
length = "5 mm"
perturbation = 0.02
[[boundary]]
patches = ["xmin", "ymin", "zmin"]
type = "symmetry"
[[boundary]]
patch = "xmax"
displacement = [{ expr = "6e-3*sin(pi*t)^2", unit = "mm" }, "free", "free"]
[loading]
end = 40
initial_increment = 0.5
maximum_increment = 0.5
[fatigue]
cycle = 1
steps = 2
jump_tolerance = 0.05
[output]
curve = { patch = "xmax", component = "x" }
frames_at = [20.5]
)toml";

TEST(FatigueCase, WritesItsCycles) {
  const TemporaryCase directory(weakened_bar);
  const Outcome outcome = run({"run", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const CsvTable table = read_csv(directory.results() / "fatigue.csv");
  const std::vector<double>&load = table.column("load"), &jumped = table.column("jumped_cycles");
  EXPECT_EQ(load.back(), 40.0);
  EXPECT_EQ(table.column("cycles").back(), 40.0);
  EXPECT_GT(jumped.back(), 10.0);
  EXPECT_LT(load.size(), 60u);                           // of 81 without jumps
  EXPECT_NE(std::ranges::find(load, 20.5), load.end());  // no jump goes past a frame
  const double psi = 0.5 * 30e9 * 3e-4 * 3e-4;           // of each cycle, until the bar breaks
  const auto whole = static_cast<std::size_t>(std::ranges::find(load, 20.5) - load.begin());
  EXPECT_NEAR(table.column("greatest_energy_over_threshold")[whole], 21.0 * psi / 20e3, 1e-6);
  EXPECT_NEAR(table.column("least_toughness_factor")[whole], std::pow(2.0 / (1.0 + 21.0 * psi / 20e3), 2), 1e-6);
  EXPECT_GT(read_csv(directory.results() / "force_displacement.csv").column("max_damage").back(), 0.9);
  const std::string frame = content_of(directory.results() / "fields" / fmt::format("step_{:06}.vtu", whole));
  for (const char* field : {"\"fatigue_energy", "\"toughness_factor"})
    EXPECT_NE(frame.find(field), frame.npos) << field;
}

TEST(FatigueCase, GoesOnAfterAStopToTheSameCycles) {
  const TemporaryCase whole(weakened_bar), stopped(weakened_bar);
  ASSERT_EQ(run({"run", whole.path().string(), "--quiet"}).status, 0);
  for (const char* steps : {"3", "4", "9"})  // within a cycle, at the end of one, and after a jump
    ASSERT_EQ(run({"run", stopped.path().string(), "--quiet", "--restart", "--max-steps", steps}).status, 0);
  EXPECT_NE(content_of(whole.results() / "fatigue.csv"), content_of(stopped.results() / "fatigue.csv"));
  ASSERT_EQ(run({"run", stopped.path().string(), "--quiet", "--restart"}).status, 0);
  for (const char* file : {"fatigue.csv", "force_displacement.csv", "checkpoint.bin"}) {
    EXPECT_NE(content_of(whole.results() / file), "");
    EXPECT_EQ(content_of(whole.results() / file), content_of(stopped.results() / file)) << file;
  }
}

TEST(FatigueCase, MayHaveARegionThatIsNotDamageable) {
  const std::string split = replaced(
      replaced(
          weakened_bar, "[materials.stone]\nregions = [\"body\"]\n",
          "[[mesh.regions]]\nname = \"end\"\nlower = [\"15 mm\", \"-1 mm\", \"-1 mm\"]\nupper = [\"30 mm\", \"2 mm\", "
          "\"2 mm\"]\n[materials.stone]\nregions = [\"body\", \"end\"]\n"),
      "[fracture]\n", "[regions.end]\ndamageable = false\n[fracture]\n");
  EXPECT_EQ(run({"check", TemporaryCase(split).path().string()}).err, "");
}

TEST(FatigueCase, IsRefused) {
  const char* const fatigue = "fatigue = { law = \"asymptotic\", threshold = \"20 kJ/m^3\" }";
  const std::string undamageable = "damageable = false\n" + std::string(fatigue);
  for (const BadInput& input : std::vector<BadInput>{
           {"law", "\"asymptotic\"", "\"linear\"", {"fatigue law", "linear", "asymptotic", "logarithmic"}},
           {"no threshold", ", threshold = \"20 kJ/m^3\"", "", {"threshold"}},
           {"zero", "\"20 kJ/m^3\"", "\"0 J/m^3\"", {"threshold", "positive"}},
           {"unit", "\"20 kJ/m^3\"", "\"20 J/m^2\"", {"energy per volume", "50 kJ/m^3"}},
           {"kappa", "\"asymptotic\"", "\"asymptotic\", kappa = 0.5", {"kappa"}},
           {"no kappa", "\"asymptotic\"", "\"logarithmic\"", {"kappa"}},
           {"no fatigue", fatigue, "", {"no damageable material has fatigue", "threshold"}},
           {"no cycle", "cycle = 1\n", "", {"cycle"}},
           {"no jumps", "jump_tolerance = 0.05", "computed_cycles = 3", {"jump_tolerance"}},
           {"tolerance", "jump_tolerance = 0.05", "jump_tolerance = 1", {"jump_tolerance", "below 1"}},
           {"history",
            "toughness =",
            "law = \"j2_plasticity\"\nyield_stress = \"50 MPa\"\ntoughness =",
            {"fatigue", "j2_plasticity", "linear elastic"}},
           {"finite strain",
            "toughness =",
            "law = \"neo_hookean\"\ntoughness =",
            {"fatigue", "neo_hookean", "linear elastic"}},
           {"undamageable", fatigue, undamageable.c_str(), {"fatigue", "can be damaged", "damageable = false"}},
           {"ramp", "6e-3*sin(pi*t)^2", "6e-3*t", {"jump_tolerance", "same in every cycle", "patch \"xmax\""}},
           {"slow ramp", "sin(pi*t)^2", "sin(pi*t)^2*(1 + 1e-4*t)", {"same in every cycle", "patch \"xmax\""}},
           {"two cycles", "cycle = 1", "cycle = 1.5", {"same in every cycle", "patch \"xmax\""}},
           {"long cycle", "cycle = 1", "cycle = 41", {"fatigue.cycle", "41", "loading.end"}},
           {"dissipation", "end = 40", "end = 40\nmaximum_dissipation = \"1 uJ\"", {"maximum_dissipation"}}})
    expect_refused(TemporaryCase(replaced(weakened_bar, input.good, input.bad)), input);
  const std::string strong =
      replaced(weakened_bar, "toughness =", "strength = \"3 MPa\"\ncompressive_strength = \"30 MPa\"\ntoughness =");
  const BadInput strength{"strength", "\"AT1\"", "\"strength\"", {"fatigue", "a model of strength"}};
  expect_refused(TemporaryCase(replaced(strong, strength.good, strength.bad)), strength);
  const std::string timed = replaced(weakened_bar, "end = 40\n", "end = 40\nduration = \"1 s\"\n");
  const BadInput viscosity{
      "viscosity", "split = \"none\"", "split = \"none\"\nviscosity = \"1 kPa s\"", {"jump_tolerance", "viscosity"}};
  expect_refused(TemporaryCase(replaced(timed, viscosity.good, viscosity.bad)), viscosity);
  const std::string computed = replaced(timed, "jump_tolerance = 0.05\n", "");
  const std::string warm = replaced(
      computed, "toughness =",
      "density = \"2400 kg/m^3\"\nconductivity = \"2 W/(m K)\"\nspecific_heat = \"800 J/(kg K)\"\ntoughness =");
  const BadInput heat{"heat", "[fatigue]", "[heat]\ncycle = 1\n[fatigue]", {"fatigue", "[heat] cycle", "repeats"}};
  expect_refused(TemporaryCase(replaced(warm, heat.good, heat.bad)), heat);
}

}  // namespace
}  // namespace pfdm::this_file
