// [heat] in case files: the tables and figures of cycles of load, that a run goes on after a stop, and what is refused.

#include "postproc/files/csv_table.h"
#include "tests/cases/temporary_case.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <numbers>

namespace pfdm::this_file {
namespace {

// A viscoelastic block, sheared to and fro; w tau = 1.
const std::string heated_block = R"toml(kind = "fracture"
title = "a sheared block that warms"
[mesh]
generator = "box_hexes"
x = [{ length = "1 mm", cells = 2 }]
y = [{ length = "1 mm", cells = 2 }]
z = [{ length = "1 mm", cells = 2 }]
[materials.binder]
regions = ["body"]
law = "prony"
young_modulus = "2 MPa"
poisson_ratio = 0.4
shear_branches = [{ modulus = "1 MPa", time = "1 ms" }]
damageable = false
density = "1000 kg/m^3"
conductivity = "0.2 W/m/K"
specific_heat = "1500 J/kg/K"
[fracture]
split = "none"
[[boundary]]
patches = ["xmin", "xmax", "ymin", "ymax", "zmin", "zmax"]
displacement = [{ expr = "1e-3*y*1e6*sin(2*pi*t)", unit = "um" }, "0 um", "0 um"]
[loading]
end = 8
duration = "6.283185307 ms"
initial_increment = 0.025
maximum_increment = 0.025
[heat]
cycle = 1
repeats_within = 0.01
time = "400 s"
time_steps = 20
[[heat.boundary]]
patch = "ymin"
heat_transfer = "50 W/m^2/K"
[output]
curve = { patch = "ymax", component = "x" }
)toml";

TEST(HeatCase, CyclesWarmABlockForALongTime) {
  const TemporaryCase directory(heated_block);
  const Outcome outcome = run({"run", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto summary = nlohmann::json::parse(content_of(directory.results() / "summary.json"));
  EXPECT_EQ(summary.at("status"), "complete");
  const auto figure = [&](const char* name) { return summary.at(name).get<double>(); };
  const double power = 0.5 * 0.5e6 * 1e-6 * 1e3 * 1e-9;  // G'' gamma_0^2 w/2 over the volume [W]
  EXPECT_NEAR(figure("heating_of_cycles_W"), power, 5e-3 * power);
  EXPECT_NEAR(figure("after_time_heat_J"), 400.0 * figure("heating_of_cycles_W"), 1e-9 * 400.0 * power);
  EXPECT_NEAR(figure("after_time_stored_heat_J") + figure("after_time_lost_heat_J"), figure("after_time_heat_J"),
              1e-6 * 400.0 * power);
  // It has come to rest (a time constant of 30 s): all leaves by the patch. In two cells across the mean is 3/8 q L^2/k
  // above it, for 1/3.
  const double q = figure("heating_of_cycles_W") / 1e-9, at_patch = q * 1e-3 / 50.0, through = q * 1e-6 / 0.2;
  EXPECT_NEAR(figure("after_time_mean_rise_K"), at_patch + 0.375 * through, 1e-3 * at_patch);
  EXPECT_GT(figure("after_time_y_m"), 0.5e-3);
  EXPECT_LT(figure("final_load"), 7.5);  // it repeated before
  const CsvTable steps = read_csv(directory.results() / "heat.csv");
  EXPECT_EQ(steps.column("heat_J").back(), figure("final_heat_J"));
  EXPECT_NEAR(steps.column("time_s").back(), figure("final_load") * 6.283185307e-3, 1e-12);
  EXPECT_EQ(read_csv(directory.results() / "heat_over_time.csv").column("time_s").size(), 21u);
  EXPECT_TRUE(std::filesystem::exists(directory.results() / "heated.vtu"));
  EXPECT_NE(outcome.out.find("warm the body in 400 s"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(directory.results() / "fields" / "step_000120.vtu"));  // its last state
  const std::string told = content_of(directory.results() / "summary.json");
  const Outcome again = run({"run", directory.path().string(), "--restart"});
  EXPECT_NE(again.out.find("is complete already"), std::string::npos) << again.out;
  EXPECT_EQ(content_of(directory.results() / "summary.json"), told);
  EXPECT_NE(outcome.out.find("Greatest temperature rise "), std::string::npos) << outcome.out;
  ASSERT_EQ(run({"report", directory.path().string(), "--quiet"}).status, 0);
  const std::string page = content_of(directory.results() / "report" / "index.html");
  for (const char* caption : {"\"Greatest temperature rise\"", "after 400 s, at ", "\"Temperature rise\"", "\"Heat\"",
                              "Temperature rise under the mean heat of the last cycle", "\"temperature rise\""})
    EXPECT_NE(page.find(caption), std::string::npos) << caption;
}

TEST(HeatCase, GoesOnAfterAStopToTheSameHeat) {
  const std::string text = replaced(heated_block, "maximum_increment = 0.025", "maximum_increment = 0.1");
  const TemporaryCase whole(replaced(text, "initial_increment = 0.025", "initial_increment = 0.1")),
      stopped(replaced(text, "initial_increment = 0.025", "initial_increment = 0.1"));
  ASSERT_EQ(run({"run", whole.path().string(), "--quiet"}).status, 0);
  ASSERT_EQ(run({"run", stopped.path().string(), "--quiet", "--max-steps", "13"}).status, 0);
  EXPECT_FALSE(std::filesystem::exists(stopped.results() / "heat_over_time.csv"));
  ASSERT_EQ(run({"run", stopped.path().string(), "--quiet", "--restart"}).status, 0);
  for (const char* file : {"heat.csv", "heat_over_time.csv"}) {
    EXPECT_NE(content_of(whole.results() / file), "");
    EXPECT_EQ(content_of(whole.results() / file), content_of(stopped.results() / file)) << file;
  }
}

TEST(HeatCase, ItsTimesStayWhenItGoesOn) {
  const TemporaryCase directory(heated_block);
  ASSERT_EQ(run({"run", directory.path().string(), "--quiet", "--max-steps", "3"}).status, 0);
  const Outcome outcome = run({"run", directory.path().string(), "--restart", "--set", "loading.duration=1 ms"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("duration = \"0.00628319 s\", which cannot change on the way"), std::string::npos)
      << outcome.err;
}

TEST(HeatCase, SaysThatCyclesDoNotRepeat) {
  std::string text = replaced(heated_block, "repeats_within = 0.01", "repeats_within = 1e-9");
  text = replaced(text, "maximum_increment = 0.025", "maximum_increment = 0.1");
  text = replaced(replaced(text, "initial_increment = 0.025", "initial_increment = 0.1"), "end = 8", "end = 2");
  const TemporaryCase directory(text);
  const Outcome outcome = run({"run", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE((outcome.out + outcome.err).find("more than heat.repeats_within"), std::string::npos);
}

TEST(HeatCase, SaysThatTemperaturesMakeNoStrains) {
  const TemporaryCase directory(
      replaced(heated_block, "damageable = false\n", "damageable = false\nexpansion = \"3e-4 1/K\"\n"));
  const Outcome outcome = run({"check", directory.path().string()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("make no strains"), std::string::npos) << outcome.out;
}

// Times that shift by some tens of per cent within the rises of the block.
const std::string acts_back = [] {
  std::string text = replaced(heated_block, "damageable = false\n",
                              "damageable = false\nexpansion = \"3e-4 1/K\"\ntemperature_shift = { law = "
                              "\"arrhenius\", reference = \"20 degC\", activation_energy = \"200 kJ/mol\" }\n");
  text = replaced(text, "[loading]", "[loads]\nstart_temperature = \"20 degC\"\n[loading]");
  text = replaced(text, "1e-3*y*1e6", "3e-2*y*1e6");
  text = replaced(replaced(text, "end = 8", "end = 60"), "time_steps = 20", "time_steps = 40\ncoupling = \"two_way\"");
  text = replaced(text, "maximum_increment = 0.025", "maximum_increment = 0.1");
  return replaced(text, "initial_increment = 0.025", "initial_increment = 0.1");
}();

TEST(HeatCase, ActsBackAndGoesOnAfterAStop) {
  const TemporaryCase whole(acts_back), stopped(acts_back);
  const Outcome outcome = run({"run", whole.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("in 400 s the body has become warmer by at most"), std::string::npos) << outcome.out;
  const CsvTable steps = read_csv(whole.results() / "heat.csv");
  EXPECT_NEAR(steps.column("time_s").back(), 400.0, 1e-9);
  const auto summary = nlohmann::json::parse(content_of(whole.results() / "summary.json"));
  const double one_way = 0.25e6 * 3e-2 * 3e-2 * 1e3 * 1e-3 / 50.0;  // G'' gamma_0^2 w/2 L/h, at rest
  EXPECT_GT(summary.at("final_mean_rise_K").get<double>(), 0.3 * one_way);
  EXPECT_LT(summary.at("final_mean_rise_K").get<double>(), 0.97 * one_way);
  EXPECT_LT(summary.at("final_load").get<double>(), 60.0);
  ASSERT_EQ(run({"run", stopped.path().string(), "--quiet", "--max-steps", "57"}).status, 0);
  ASSERT_EQ(run({"run", stopped.path().string(), "--quiet", "--restart"}).status, 0);
  for (const char* file : {"heat.csv", "force_displacement.csv"})
    EXPECT_EQ(content_of(whole.results() / file), content_of(stopped.results() / file)) << file;
}

// The same of rubber at finite strain, sheared by 3 %: cycles, rises and shifts are those of small strain to its
// square.
TEST(HeatCase, OfRubberAtFiniteStrainIsThatOfSmallStrain) {
  const TemporaryCase small(acts_back), finite(replaced(acts_back, "law = \"prony\"", "law = \"neo_hookean\""));
  std::array<nlohmann::json, 2> summary;
  for (const TemporaryCase* directory : {&small, &finite}) {
    const Outcome outcome = run({"run", directory->path().string(), "--quiet"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    summary.at(directory == &small ? 0 : 1) = nlohmann::json::parse(content_of(directory->results() / "summary.json"));
  }
  EXPECT_EQ(read_csv(finite.results() / "heat.csv").column("time_s").back(), 400.0);
  for (const char* name : {"final_mean_rise_K", "final_greatest_rise_K", "final_heat_J", "final_lost_heat_J"}) {
    const double due = summary[0].at(name).get<double>();
    EXPECT_NEAR(summary[1].at(name).get<double>(), due, 5e-3 * due) << name;
  }
  ASSERT_EQ(run({"report", finite.path().string(), "--quiet"}).status, 0);
  const std::string page = content_of(finite.results() / "report" / "index.html");
  for (const char* caption : {"\"Greatest temperature rise\"", "\"Temperature rise\"", "\"temperature rise\""})
    EXPECT_NE(page.find(caption), std::string::npos) << caption;
}

TEST(HeatCase, SaysThatTheLoadEndsBeforeTheTime) {
  const TemporaryCase directory(replaced(acts_back, "end = 60", "end = 4"));
  const Outcome outcome = run({"run", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE((outcome.out + outcome.err).find("of the 400 s of heat.time had gone by"), std::string::npos);
}

TEST(HeatCase, ThatActsBackIsRefused) {
  for (const BadInput& input : std::vector<BadInput>{
           {"no start", "[loads]\nstart_temperature = \"20 degC\"\n", "", {"body", "start_temperature"}},
           {"start alone",
            "temperature_shift = { law = \"arrhenius\", reference = \"20 degC\", activation_energy = \"200 kJ/mol\" "
            "}\n",
            "",
            {"start_temperature", "temperature_shift"}},
           {"no branches",
            "law = \"prony\"\nyoung_modulus = \"2 MPa\"\npoisson_ratio = 0.4\nshear_branches = [{ modulus = \"1 MPa\", "
            "time "
            "= \"1 ms\" }]\n",
            "law = \"neo_hookean\"\nyoung_modulus = \"2 MPa\"\npoisson_ratio = 0.4\n",
            {"neo_hookean", "temperature_shift", "shear_branches"}},
           {"energy", "\"200 kJ/mol\"", "\"200 kJ\"", {"activation_energy", "60 kJ/mol"}},
           {"law", "\"arrhenius\"", "\"vogel\"", {"vogel", "wlf", "arrhenius"}},
           {"too cold",
            "law = \"arrhenius\", reference = \"20 degC\", activation_energy = \"200 kJ/mol\"",
            "law = \"wlf\", reference = \"100 degC\", C1 = 17, C2 = \"50 K\"",
            {"start_temperature", "323.15 K"}},
           {"no difference",
            "law = \"arrhenius\", reference = \"20 degC\", activation_energy = \"200 kJ/mol\"",
            "law = \"wlf\", reference = \"0 degC\", C1 = 17, C2 = \"50 degC\"",
            {"difference", "20 K"}},
           {"changes",
            "coupling = \"two_way\"",
            "coupling = \"one_way\"\nchanges_within = 0.01",
            {"changes_within", "two_way"}}})
    expect_refused(TemporaryCase(replaced(acts_back, input.good, input.bad)), input);
}

TEST(HeatCase, IsRefused) {
  for (const BadInput& input : std::vector<BadInput>{
           {"none", "heat_transfer = \"50 W/m^2/K\"\n", "", {"one of rise, flux and heat_transfer"}},
           {"two", "heat_transfer =", "rise = \"1 K\"\nheat_transfer =", {"one of rise, flux and heat_transfer"}},
           {"degrees", "heat_transfer = \"50 W/m^2/K\"", "rise = \"20 degC\"", {"a difference", "20 K"}},
           {"patch", "patch = \"ymin\"\nheat", "patch = \"below\"\nheat", {"below", "ymin"}},
           {"once", "end = 8", "end = 1", {"cycle", "loading.end = 2"}},
           {"no cycle", "cycle = 1\nrepeats_within = 0.01\n", "", {"cycle = 1"}},
           {"no conductivity", "conductivity = \"0.2 W/m/K\"\n", "", {"conductivity", "body"}},
           {"no duration", "duration = \"6.283185307 ms\"\n", "", {"duration"}},
           {"share", "cycle = 1\n", "cycle = 1\ndebonding_share = 2\n", {"debonding_share", "2"}}})
    expect_refused(TemporaryCase(replaced(heated_block, input.good, input.bad)), input);
}

}  // namespace
}  // namespace pfdm::this_file
