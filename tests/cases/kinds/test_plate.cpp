// Cases of kind plate from end to end: a small plate that is computed, and what is wrong with others said.

#include "postproc/files/csv_table.h"
#include "postproc/fits/fit_json.h"
#include "tests/cases/page_data.h"
#include "tests/cases/small_plate.h"
#include "tests/cases/temporary_case.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>

namespace pfdm::this_file {
namespace {

using nlohmann::json;

TEST(Plate, SaysWhatItsLayersDoToItsFrequencies) {
  const auto words_of = [](const std::string& text) {
    const TemporaryCase directory(text);
    const Outcome outcome = run({"check", directory.path().string()});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.out;
  };
  EXPECT_THAT(words_of(replaced(small_plate(), "cells = 6", "cells = 1")),
              testing::HasSubstr("1 layer of hexahedra: it hardly resists bending"));
  EXPECT_THAT(words_of(replaced(small_plate(), "cells = 6", "cells = 4")),
              testing::Not(testing::HasSubstr("of hexahedra")));
  EXPECT_THAT(words_of(replaced(small_plate(), "poisson_ratio = 0.3", "poisson_ratio = 0.49")),
              testing::HasSubstr("6 layers of hexahedra at nu = 0.49: where cells carry a pressure"));
}

TEST(Plate, SaysWhichModesHaveFewCells) {
  const auto said = [](const std::string& text) {
    const TemporaryCase directory(text);
    const Outcome outcome = run({"run", directory.path().string()});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.out;
  };
  const std::string cold = small_plate().substr(0, small_plate().find("[heating]"));
  EXPECT_THAT(said(replaced(cold, "modes = 3", "modes = 2")), testing::Not(testing::HasSubstr("half wave")));
  EXPECT_THAT(said(replaced(cold, "cells = 20", "cells = 6")),
              testing::HasSubstr("cells to a half wave along x: frequencies of such modes are up to"));
}

// Insulated, the rise is m_eff/m A^2 t/(2 eta omega_1 c_p) of the first mode, to within what the other modes add, and
// uniform, as the conductivity is large.
TEST(Plate, HeatsUpAtItsResonanceAsTheClosedFormSays) {
  const TemporaryCase directory(small_plate());
  const json summary = summary_of(directory);
  const CsvTable modes = read_csv(directory.results() / "modes.csv");
  const double f1 = modes.column("frequency_Hz")[0], mass = modes.column("effective_mass_z")[0];
  EXPECT_NEAR(modes.column("damping_ratio")[0], 0.1, 1e-12);
  const double A = 2.0 * 9.80665;
  const double rise = mass * A * A * 3600.0 / (2.0 * 0.2 * 2.0 * std::numbers::pi * f1 * 1600.0);
  EXPECT_NEAR(summary["surface_mean_rise_K"], rise, 0.02 * rise);
  EXPECT_NEAR(summary["heat_balance_error"], 0.0, 1e-10);
  EXPECT_NEAR(summary["heat_J"].get<double>() / summary["mechanical_work_J"].get<double>(), 1.0, 1e-9);
  EXPECT_NEAR(summary["heat_source_correction"], 0.0, 5e-3);
  EXPECT_EQ(summary["heat_lost_J"], 0.0);
  EXPECT_NEAR(summary["driving_frequency_Hz"], f1, 0.02 * f1);

  const CsvTable response = read_csv(directory.results() / "response.csv");
  const auto& H1 = response.column("centre_H1_magnitude");
  const auto peak = std::ranges::max_element(H1) - H1.begin();
  EXPECT_NEAR(response.column("frequency_Hz")[peak], f1, 0.05 * f1);
  EXPECT_NEAR(H1.front(), 1.0, 0.1);  // far below, the plate moves with its base

  const Outcome report = run({"report", directory.path().string(), "--quiet"});
  EXPECT_EQ(report.status, 0) << report.err;
  EXPECT_TRUE(std::filesystem::exists(directory.results() / "report/report.pdf"));
}

TEST(Plate, HasAPageWithTheBodyThatVibrates) {
  const TemporaryCase directory(small_plate());
  const json summary = summary_of(directory);
  ASSERT_EQ(run({"report", directory.path().string(), "--quiet"}).status, 0);
  const json data = data_of_page(content_of(directory.results() / "report" / "index.html"));
  const json body = data["body"];
  EXPECT_EQ(body["vibrates"], true);
  EXPECT_EQ(body["fields"][0]["name"], "temperature rise");
  const CsvTable heating = read_csv(directory.results() / "temperature.csv");
  EXPECT_EQ(data["steps"].size(), heating.n_rows());
  EXPECT_EQ(body["frames"].front(), 0);
  EXPECT_EQ(body["frames"].back(), heating.n_rows() - 1);
  EXPECT_NEAR(body["fields"][0]["values"]["to"].get<double>(), summary["largest_rise_K"].get<double>(),
              1e-6 * summary["largest_rise_K"].get<double>());
  EXPECT_THAT(data["headline"][1].get<std::string>(), testing::HasSubstr("with 2 g0"));
  const auto& charts = data["blocks"];
  const auto surface =
      std::ranges::find_if(charts, [](const json& b) { return b["caption"] == "Surface temperature"; });
  ASSERT_NE(surface, charts.end());
  EXPECT_EQ((*surface)["series"][0]["of_steps"], true);
}

/// What a browser shows at two phases of the vibration, and at two times.
constexpr const char* probe = R"(async () => {
  for (let i = 0; i < 300 && !document.documentElement.dataset.body; ++i) await after(50);
  const pixels = () => document.querySelector(".scene canvas").toDataURL();
  const slide = (label, to) => {
    const slider = document.querySelector(`input[aria-label="${label}"]`);
    slider.value = to;
    slider.dispatchEvent(new Event("input"));
    return pixels();
  };
  const first = pixels();
  const other_phase = slide("phase of the vibration", 12);
  const again = slide("phase of the vibration", 0);
  return { body: document.documentElement.dataset.body, phase: other_phase !== first, returns: again === first,
           time: slide("step", 0) !== first };
})";

TEST(Plate, VibratesInTheBrowser) {
  const TemporaryCase directory(small_plate());
  summary_of(directory);
  ASSERT_EQ(run({"report", directory.path().string(), "--quiet"}).status, 0);
  const auto told = told_by_browser(directory.path(), content_of(directory.results() / "report" / "index.html"), probe);
  if (!told) GTEST_SKIP() << "chromium is not installed";
  EXPECT_EQ((*told)["body"], "shown");
  EXPECT_EQ((*told)["phase"], true);
  EXPECT_EQ((*told)["returns"], true);
  EXPECT_EQ((*told)["time"], true);
  EXPECT_TRUE((*told)["errors"].empty()) << (*told)["errors"];
}

// A modulus that falls lowers the resonance; at the frequency of the cold plate it then takes less power.
TEST(Plate, SoftensAsItWarms) {
  const TemporaryCase directory(
      replaced(small_plate(), "loss_factor = 0.2\n",
               "loss_factor = 0.2\ntemperature = { reference = \"20 degC\", modulus = \"-0.05 1/K\" }\n"));
  const json summary = summary_of(directory);
  const CsvTable heating = read_csv(directory.results() / "temperature.csv");
  const auto last = heating.n_rows() - 1;
  const double rise = heating.column("mean_rise_K")[last], f0 = summary["first_resonance_Hz"];
  EXPECT_NEAR(heating.column("resonance_Hz")[last], f0 * std::sqrt(1.0 - 0.05 * rise), 1e-3 * f0);
  EXPECT_LT(heating.column("mechanical_power_W")[last], 0.97 * heating.column("mechanical_power_W")[0]);
}

// Random motion of a density S about a resonance of little damping: the power is that of white noise, pi/2 m_eff S per
// (one-sided, in Hz) 2 pi rad: P = m_eff S/4 in all, whatever the damping.
TEST(Plate, RandomMotionPutsInThePowerOfWhiteNoise) {
  std::string text = replaced(small_plate(), "motion = \"harmonic\"\nlevel = \"2 g0\"",
                              "motion = \"random\"\ndensity = \"1 m^2/s^4/Hz\"\nfrom = \"20 Hz\"\nto = \"200 Hz\"");
  text = replaced(text, "loss_factor = 0.2", "loss_factor = 0.05");
  const TemporaryCase directory(text);
  const json summary = summary_of(directory);
  const CsvTable modes = read_csv(directory.results() / "modes.csv");
  const double effective = modes.column("effective_mass_z")[0] * summary["mass_kg"].get<double>();
  EXPECT_NEAR(summary["mechanical_power_W"], 0.25 * effective, 0.05 * 0.25 * effective);
}

// A slow sweep is the mean over the band: A^2 m_eff/8 over its width, of little damping; of one in equal ratios over
// f_1 times their logarithm.
TEST(Plate, SweepsPutInTheMeanPowerOfTheirBand) {
  for (const bool logarithmic : {false, true}) {
    std::string text =
        replaced(small_plate(), "motion = \"harmonic\"", "motion = \"sweep\"\nfrom = \"20 Hz\"\nto = \"200 Hz\"");
    if (logarithmic) text = replaced(text, "motion = \"sweep\"", "motion = \"sweep\"\nlaw = \"logarithmic\"");
    const TemporaryCase directory(replaced(text, "loss_factor = 0.2", "loss_factor = 0.05"));
    const json summary = summary_of(directory);
    const CsvTable modes = read_csv(directory.results() / "modes.csv");
    const double effective = modes.column("effective_mass_z")[0] * summary["mass_kg"].get<double>();
    const double A = 2.0 * 9.80665;
    const double width = logarithmic ? modes.column("frequency_Hz")[0] * std::log(10.0) : 180.0;
    const double power = A * A * effective / (8.0 * width);
    EXPECT_NEAR(summary["mechanical_power_W"], power, 0.05 * power) << logarithmic;
  }
}

/// omega of a plate strip on two simple supports, with shear deformation and rotary inertia (Mindlin), in n half waves.
double strip_omega(int n, double L, double h, double E, double nu, double rho) {
  const double k = n * std::numbers::pi / L, shear = 5.0 / 6.0 * E / (2.0 * (1.0 + nu)) * h;
  const double bending = E / (1.0 - nu * nu) * h * h * h / 12.0, rotary = rho * h * h * h / 12.0, mass = rho * h;
  const double a = mass * rotary / shear, b = mass + rotary * k * k + mass * bending * k * k / shear;
  return std::sqrt((b - std::sqrt(b * b - 4.0 * a * bending * k * k * k * k)) / (2.0 * a));
}

// Half a strip in plane strain: symmetric about its middle, so that it has one and three half waves. The first carries
// 8/pi^2 of the mass.
TEST(Plate, PinnedEdgesAreSimpleSupports) {
  std::string text = replaced(small_plate(), "length = \"10 cm\", cells = 20", "length = \"5 cm\", cells = 40");
  text = replaced(text, "length = \"8 cm\", cells = 16", "length = \"1 cm\", cells = 1");
  text = replaced(text, "length = \"8 mm\", cells = 6", "length = \"4 mm\", cells = 8");
  text = replaced(text, "patches = [\"xmin\", \"xmax\"]\ntype = \"clamped\"",
                  "patch = \"xmin\"\ntype = \"pinned\"\n[[support]]\npatches = [\"xmax\", \"ymin\", \"ymax\"]\n"
                  "type = \"symmetry\"");
  text = replaced(text, "at = [\"5 cm\", \"4 cm\", \"8 mm\"]", "at = [\"5 cm\", \"5 mm\", \"4 mm\"]");
  text = replaced(text, "from = \"20 Hz\"", "from = \"5 Hz\"");
  const TemporaryCase directory(text.substr(0, text.find("[heating]")));
  summary_of(directory);
  const CsvTable modes = read_csv(directory.results() / "modes.csv");
  for (const int n : {1, 3}) {
    const double due = strip_omega(n, 0.1, 4e-3, 20e6, 0.3, 1200.0) / (2.0 * std::numbers::pi);
    const double found = modes.column("frequency_Hz")[n == 1 ? 0 : 1];
    EXPECT_NEAR(found / due, 1.0, n == 1 ? 0.01 : 0.02) << n;
    RecordProperty(fmt::format("mode_{}", n), fmt::format("{:.4f} of {:.4f} Hz", found, due));
  }
  EXPECT_NEAR(modes.column("effective_mass_z")[0], 8.0 / std::pow(std::numbers::pi, 2), 0.01);
}

TEST(Plate, SaysWhatIsWrong) {
  const BadInput rows[] = {
      {"patch", "patches = [\"xmin\", \"xmax\"]", "patches = [\"xmin\", \"xmaks\"]", {"xmaks", "did you mean", "xmax"}},
      {"motion", "motion = \"harmonic\"", "motion = \"harmonik\"", {"harmonik", "did you mean", "harmonic"}},
      {"loss", "loss_factor = 0.2", "loss_factor = 0.0", {"loss_factor", "above 0 and below 2"}},
      {"band", "to = \"400 Hz\"", "to = \"10 Hz\"", {"must end above"}},
      {"points",
       "[[response.points]]\nname = \"centre\"\nat = [\"5 cm\", \"4 cm\", \"8 mm\"]\n",
       "",
       {"[[response.points]]"}},
      {"held",
       "patches = [\"xmin\", \"xmax\"]\ntype = \"clamped\"",
       "patches = [\"xmin\"]\ntype = \"symmetry\"",
       {"rigidly"}},
      {"resonance", "from = \"20 Hz\"", "from = \"200 Hz\"", {"no resonance lies between"}},
  };
  for (const BadInput& row : rows) {
    const TemporaryCase directory(replaced(small_plate(), row.good, row.bad));
    const Outcome outcome = run({"run", directory.path().string()});
    EXPECT_EQ(outcome.status, 2) << row.name << ": " << outcome.err;
    for (const std::string& words : row.message) EXPECT_THAT(outcome.err, testing::HasSubstr(words)) << row.name;
    EXPECT_FALSE(std::filesystem::exists(directory.results() / "summary.json")) << row.name;
  }
}

}  // namespace
}  // namespace pfdm::this_file
