// pfdm fit of plates: twin data, computed by a run with known values and noise, so synthetic.

#include "postproc/files/csv_table.h"
#include "tests/cases/temporary_case.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <complex>
#include <random>

namespace pfdm::this_file {
namespace {

using nlohmann::json;

constexpr double modulus = 20e6, loss = 0.2, convection = 10.0;

std::string plate_of(double modulus_MPa, double loss_factor, double coefficient) {
  return fmt::format(R"(kind = "plate"
title = "a small plate"
mesh.generator = "box_hexes"
mesh.x = [{{ length = "10 cm", cells = 14 }}]
mesh.y = [{{ length = "8 cm", cells = 10 }}]
mesh.z = [{{ length = "8 mm", cells = 4 }}]

[material]
density = "1200 kg/m^3"
young_modulus = "{} MPa"
loss_factor = {}
poisson_ratio = 0.3
conductivity = "0.25 W/m/K"
specific_heat = "1600 J/kg/K"

[[support]]
patches = ["xmin", "xmax"]
type = "clamped"

[base]
motion = "harmonic"
level = "2 g0"
frequency = "60 Hz"

[response]
from = "20 Hz"
to = "300 Hz"
frequencies = 60
modes = 3

[[response.points]]
name = "centre"
at = ["5 cm", "4 cm", "8 mm"]

[heating]
duration = "60 min"
step = "2 min"
surface = "zmax"

[[cooling]]
patches = ["zmin", "zmax"]
type = "convection"
coefficient = "{} W/m^2/K"
)",
                     modulus_MPa, loss_factor, coefficient);
}

const std::string fit_of_three = R"(
[fit]
[[fit.parameters]]
key = "material.young_modulus"
bounds = ["5 MPa", "80 MPa"]
[[fit.parameters]]
key = "material.loss_factor"
bounds = [0.02, 0.8]
[[fit.parameters]]
key = "cooling[0].coefficient"
bounds = ["1 W/m^2/K", "100 W/m^2/K"]

[[fit.responses]]
name = "sweep"
csv = "H1.csv"
point = "centre"
frequency = { column = "frequency_Hz" }
magnitude = { column = "magnitude" }
phase = { column = "phase_rad", unit = "radian" }
deviation = 0.01

[[fit.temperatures]]
name = "camera"
csv = "rise.csv"
of = "mean"
time = { column = "time_s" }
rise = { column = "rise_K" }
deviation = "0.005 K"
)";

/// What the run of a case says, with noise, in the folder of another.
void write_twin_data(const std::string& truth, const TemporaryCase& into) {
  const TemporaryCase directory(truth);
  const Outcome outcome = run({"run", directory.path().string(), "--quiet"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  std::mt19937 engine(3);
  std::normal_distribution<double> normal;
  const CsvTable response = read_csv(directory.results() / "response.csv");
  std::string text = "# synthetic: computed with known values, with noise\nfrequency_Hz,magnitude,phase_rad\n";
  for (std::size_t i = 0; i < response.n_rows(); ++i) {
    const double magnitude = response.column("centre_H1_magnitude")[i] * std::exp(0.01 * normal(engine));
    const double phase = response.column("centre_H1_phase_rad")[i] + 0.01 * normal(engine);
    text += fmt::format("{},{},{}\n", response.column("frequency_Hz")[i], magnitude, phase);
  }
  into.write("H1.csv", text);
  const CsvTable heating = read_csv(directory.results() / "temperature.csv");
  text = "# synthetic: computed with known values, with noise\ntime_s,rise_K\n";
  for (std::size_t i = 0; i < heating.n_rows(); ++i)
    text += fmt::format("{},{}\n", heating.column("time_s")[i],
                        heating.column("surface_mean_rise_K")[i] + 0.005 * normal(engine));
  into.write("rise.csv", text);
}

json fitted(const TemporaryCase& directory) {
  const Outcome outcome = run({"fit", directory.path().string(), "--quiet"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return json::parse(content_of(directory.results() / "fit.json"));
}

TEST(PlateFit, FindsModulusLossFactorAndConvection) {
  const TemporaryCase directory(plate_of(14, 0.3, 4) + fit_of_three);
  write_twin_data(plate_of(20, 0.2, 10), directory);
  const json fit = fitted(directory);
  EXPECT_EQ(fit["verdict"], "sound") << fit["reasons"];
  const double due[] = {modulus, loss, convection};
  for (std::size_t j = 0; j < 3; ++j) {
    const json& p = fit["parameters"][j];
    const double error = p["standard_error"];
    EXPECT_NEAR(p["estimate"], due[j], 4.0 * error) << p["name"];
    EXPECT_LT(error, (j < 2 ? 0.01 : 0.08) * due[j]) << p["name"];
    EXPECT_LT(p["lower"], p["upper"]);
    RecordProperty(p["name"].get<std::string>(), fmt::format("{:.5g} +- {:.2g}", p["estimate"].get<double>(), error));
  }
  EXPECT_NEAR(fit["rms_residual"], 1.0, 0.2);
  const Outcome again = run({"check", (directory.results() / "case.fitted.toml").string()});
  EXPECT_EQ(again.status, 0) << again.err;
  const Outcome report = run({"report", directory.path().string(), "--quiet"});
  EXPECT_EQ(report.status, 0) << report.err;
  EXPECT_TRUE(std::filesystem::exists(directory.results() / "report/report.pdf"));
}

// The plate's modulus rises with the frequency; that of the model does not.
TEST(PlateFit, NamesAModulusThatChangesWithTheFrequency) {
  std::string truth = replaced(plate_of(20, 0.2, 10), "young_modulus = \"20 MPa\"\nloss_factor = 0.2",
                               "modulus = { csv = \"modulus.csv\" }");
  const TemporaryCase directory(plate_of(14, 0.3, 4) + fit_of_three);
  std::string table = "frequency_Hz,storage_Pa,loss_Pa\n";
  for (double f = 10.0; f < 700.0; f *= 1.1) {
    const double storage = modulus * std::pow(f / 60.0, 0.15);
    table += fmt::format("{},{},{}\n", f, storage, loss * storage);
  }
  const std::string file = (directory.path() / "modulus.csv").string();
  directory.write("modulus.csv", table);
  write_twin_data(replaced(truth, "modulus.csv", file), directory);
  const json fit = fitted(directory);
  EXPECT_EQ(fit["verdict"], "questionable");
  EXPECT_TRUE(fit["parameters"][0]["lower"].is_null());
  EXPECT_EQ(fit["plate"]["suspects"][0]["what"], "a modulus that changes with the frequency") << fit["plate"];
  EXPECT_THAT(fit["reasons"].dump(), testing::HasSubstr("a modulus that changes with the frequency"));
}

// Supports that are not those of the model: nothing that is tried explains it.
TEST(PlateFit, CallsAWrongSupportIntoQuestion) {
  const TemporaryCase directory(plate_of(14, 0.3, 4) + fit_of_three);
  write_twin_data(replaced(plate_of(20, 0.2, 10), "patches = [\"xmin\", \"xmax\"]\ntype = \"clamped\"",
                           "patches = [\"xmin\", \"xmax\", \"ymin\"]\ntype = \"clamped\""),
                  directory);
  const json fit = fitted(directory);
  EXPECT_NE(fit["verdict"], "sound");
  EXPECT_FALSE(fit["reasons"].empty());
}

/// H1.csv with every value changed.
template <class Change>
void change_H1(const TemporaryCase& directory, const Change& change) {
  const CsvTable table = read_csv(directory.path() / "H1.csv");
  std::string text = "# synthetic\nfrequency_Hz,magnitude,phase_rad\n";
  for (std::size_t i = 0; i < table.n_rows(); ++i) {
    const std::complex<double> H = change(std::polar(table.column("magnitude")[i], table.column("phase_rad")[i]));
    text += fmt::format("{},{},{}\n", table.column("frequency_Hz")[i], std::abs(H), std::arg(H));
  }
  directory.write("H1.csv", text);
}

TEST(PlateFit, NamesTheOtherSignOfPhaseAndARelativeH1) {
  const TemporaryCase directory(plate_of(14, 0.3, 4) + fit_of_three);
  write_twin_data(plate_of(20, 0.2, 10), directory);
  change_H1(directory, [](std::complex<double> H) { return std::conj(H); });
  json fit = fitted(directory);
  EXPECT_NE(fit["verdict"], "sound");
  EXPECT_THAT(fit["reasons"].dump(), testing::HasSubstr("H1 of the other sign of phase"));
  change_H1(directory, [](std::complex<double> H) { return std::conj(H) - 1.0; });
  fit = fitted(directory);
  EXPECT_NE(fit["verdict"], "sound");
  EXPECT_THAT(fit["reasons"].dump(), testing::HasSubstr("H1 of the acceleration relative to the base: it is to be"));
  EXPECT_TRUE(fit["parameters"][0]["lower"].is_null());
}

// As a tone of the mains in one line of an analyser.
TEST(PlateFit, NamesARowThatLiesOffTheOthers) {
  const TemporaryCase directory(plate_of(14, 0.3, 4) + fit_of_three);
  write_twin_data(plate_of(20, 0.2, 10), directory);
  int row = 0;
  change_H1(directory, [&](std::complex<double> H) { return H * (++row == 20 ? 1.3 : 1.0); });
  const json fit = fitted(directory);
  EXPECT_EQ(fit["verdict"], "questionable") << fit["reasons"];
  const CsvTable table = read_csv(directory.path() / "H1.csv");
  EXPECT_THAT(fit["reasons"].dump(),
              testing::HasSubstr(fmt::format("the row of sweep with a magnitude of {:.4g} at {:.4g} Hz lies ",
                                             table.column("magnitude")[19], table.column("frequency_Hz")[19])));
}

// Data of a plate of seven layers, which are those that four are compared with.
TEST(PlateFit, TellsTheErrorOfItsMeshBesideTheInterval) {
  const TemporaryCase directory(plate_of(14, 0.3, 4) + fit_of_three);
  write_twin_data(replaced(plate_of(20, 0.2, 10), "length = \"8 mm\", cells = 4", "length = \"8 mm\", cells = 7"),
                  directory);
  const json fit = fitted(directory);
  EXPECT_EQ(fit["verdict"], "sound") << fit["reasons"];
  EXPECT_EQ(fit["finer"], "mesh.z[0].cells = 7");
  const json& p = fit["parameters"][0];
  EXPECT_NEAR(p["estimate"].get<double>() + p["moved_by_finer"].get<double>(), modulus, 0.01 * modulus);
  RecordProperty("estimate", p.dump());
}

TEST(PlateFit, SaysWhatIsWrong) {
  const std::string good = plate_of(14, 0.3, 4) + fit_of_three;
  const BadInput rows[] = {
      {"key",
       "key = \"material.young_modulus\"\nbounds = [\"5 MPa\", \"80 MPa\"]",
       "key = \"material.density\"\nbounds = [\"1000 kg/m^3\", \"2000 kg/m^3\"]",
       {"material.density", "cannot be estimated"}},
      {"point", "point = \"centre\"", "point = \"center\"", {"center", "did you mean", "centre"}},
      {"bounds", "bounds = [0.02, 0.8]", "bounds = [0.4, 0.8]", {"0.3", "outside these bounds"}},
      {"unit", "[\"1 W/m^2/K\", \"100 W/m^2/K\"]", "[\"1 W/m/K\", \"100 W/m/K\"]", {"heat transfer coefficient"}},
      {"column", "column = \"magnitude\"", "column = \"magnitud\"", {"magnitud"}},
      {"time", "duration = \"60 min\"", "duration = \"30 min\"", {"times", "1800"}},
  };
  for (const BadInput& row : rows) {
    const TemporaryCase directory(replaced(good, row.good, row.bad));
    directory.write("H1.csv", "frequency_Hz,magnitude,phase_rad\n20,1.1,-0.1\n60,3,-1.5\n");
    directory.write("rise.csv", "time_s,rise_K\n0,0\n3600,0.5\n");
    const Outcome outcome = run({"fit", directory.path().string()});
    EXPECT_EQ(outcome.status, 2) << row.name << ": " << outcome.err;
    for (const std::string& words : row.message) EXPECT_THAT(outcome.err, testing::HasSubstr(words)) << row.name;
  }
}

}  // namespace
}  // namespace pfdm::this_file
