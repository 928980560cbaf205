// Cases of kind plate whose modulus comes from a fit or a table.

#include "postproc/files/csv_table.h"
#include "postproc/fits/fit_json.h"
#include "postproc/vibration/vibration_fit.h"
#include "tests/cases/small_plate.h"
#include "tests/cases/temporary_case.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

namespace pfdm::this_file {
namespace {

using nlohmann::json;

// The modulus that a mass-material fit identified, as fit.json has it; also where a sweep moves the case.
TEST(Plate, TakesItsModulusFromAFit) {
  std::string text = replaced(small_plate(), "young_modulus = \"20 MPa\"\nloss_factor = 0.2",
                              "modulus = { fit = \"sample/fit.json\" }");
  text = text.substr(0, text.find("[heating]")) +
         "[sweep]\nmethod = \"list\"\n[[sweep.parameters]]\nkey = \"material.density\"\nvalues = [\"1200 kg/m^3\", "
         "\"4800 kg/m^3\"]\n";
  const TemporaryCase directory(text);
  FitReport fit{.case_name = "sample",
                .case_hash = "",
                .version = "",
                .method = "output_error",
                .found = {},
                .experiments = {},
                .own = {}};
  fit.own = own_findings(
      VibrationFindings{.structure = "1",
                        .passivity = {},
                        .orders = {},
                        .modulus = {{10.0, 20e6, 4e6}, {50.0, 20e6, 4e6}, {51.0, 80e6, 8e6}, {900.0, 80e6, 8e6}},
                        .ogden = {},
                        .repeats = {}});
  std::filesystem::create_directories(directory.path() / "sample");
  write_fit_json(directory.path() / "sample" / "fit.json", fit);
  summary_of(directory);
  const TemporaryCase plain(replaced(small_plate(), "\"20 MPa\"", "\"80 MPa\""));
  summary_of(plain);
  const double due = read_csv(plain.results() / "modes.csv").column("frequency_Hz")[0];
  const CsvTable modes = read_csv(directory.results() / "modes.csv");
  EXPECT_NEAR(modes.column("frequency_Hz")[0], due, 1e-6 * due);
  EXPECT_NEAR(modes.column("damping_ratio")[0], 0.05, 1e-9);

  const Outcome swept = run({"sweep", directory.path().string(), "--quiet"});
  ASSERT_EQ(swept.status, 0) << swept.err;
  const CsvTable table = read_csv(directory.results() / "sweep.csv");
  ASSERT_EQ(table.n_rows(), 2u);
  EXPECT_EQ(table.column("converged")[1], 1.0);
  EXPECT_NEAR(table.column("first_resonance_Hz")[0], due, 1e-6 * due);
  for (const auto& entry : std::filesystem::directory_iterator(directory.results() / "runs")) {
    const Outcome moved = run({"check", entry.path().string()});  // it names the fit from its own place
    EXPECT_EQ(moved.status, 0) << moved.err;
  }
}

// Four times the modulus at twice the frequency of a mode that then lies there; cooled in every way at once.
TEST(Plate, TakesItsModulusFromATableAndCools) {
  const std::string text =
      replaced(small_plate(), "young_modulus = \"20 MPa\"\nloss_factor = 0.2", "modulus = { csv = \"modulus.csv\" }") +
      R"(
[[cooling]]
patch = "zmin"
type = "insulation"
thickness = "19 mm"
conductivity = "0.035 W/m/K"
coefficient = "8 W/m^2/K"

[[cooling]]
patch = "zmax"
type = "convection"
coefficient = "5 W/m^2/K"
emissivity = 0.9

[[cooling]]
patch = "xmin"
type = "temperature"
temperature = "293.15 K"

[[cooling]]
patch = "xmax"
type = "conductance"
coefficient = "100 W/m^2/K"
)";
  const TemporaryCase directory(text);
  directory.write("modulus.csv",
                  "frequency_Hz,storage_Pa,loss_Pa\n10,20e6,4e6\n50,20e6,4e6\n51,80e6,8e6\n900,80e6,8e6\n");
  const json summary = summary_of(directory);
  const CsvTable modes = read_csv(directory.results() / "modes.csv");
  const TemporaryCase plain(replaced(small_plate(), "\"20 MPa\"", "\"80 MPa\""));
  summary_of(plain);
  const CsvTable due = read_csv(plain.results() / "modes.csv");
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(modes.column("frequency_Hz")[k] / due.column("frequency_Hz")[k], 1.0, 1e-6);
    EXPECT_NEAR(modes.column("damping_ratio")[k], 0.05, 1e-9);
  }
  EXPECT_NEAR(summary["heat_balance_error"], 0.0, 1e-10);
  EXPECT_GT(summary["heat_lost_J"], 0.5 * summary["heat_J"].get<double>());
}

}  // namespace
}  // namespace pfdm::this_file
