// Cases of kind "viscoelastic" from end to end.

#include "cases/program/input/case_files/case_file.h"
#include "cases/program/viscoelastic/viscoelastic_case.h"
#include "cases/program/viscoelastic/viscoelastic_report.h"
#include "tests/cases/page_data.h"
#include "tests/cases/viscoelastic_fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <complex>

namespace pfdm::this_file {
namespace {

TEST(ViscoelasticCase, RunsARampThatIsHeldAndComplexModuli) {
  const TemporaryCase directory(relaxing_case);
  const Outcome outcome = run({"run", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const PronyLaw law{.relaxed = from_young_poisson(3e6, 0.49), .shear = {{1.5e6, 0.05}, {0.8e6, 2.0}}};
  const CsvTable history = read_csv(directory.results() / "history.csv");
  ASSERT_EQ(history.n_rows(), 20u);
  for (std::size_t i = 1; i < history.n_rows(); ++i) {
    const double expected = ramped(law, 0.02, 0.3, history.column("time_s")[i]);
    EXPECT_NEAR(history.column("stress_Pa")[i], expected, 1e-12 * expected);
  }
  EXPECT_NEAR(history.column("time_s").back(), 20.3, 1e-12);
  const CsvTable moduli = read_csv(directory.results() / "complex_modulus.csv");
  ASSERT_EQ(moduli.n_rows(), 31u);
  const double K = law.relaxed.bulk_modulus();
  for (std::size_t i = 0; i < moduli.n_rows(); ++i) {
    const double w = moduli.column("angular_frequency_rad_per_s")[i];
    EXPECT_NEAR(w, 2.0 * std::numbers::pi * moduli.column("frequency_Hz")[i], 1e-12 * w);
    std::complex<double> G = law.relaxed.mu;
    for (const auto& [mu, tau] : law.shear) G += mu * std::complex(0.0, w * tau) / std::complex(1.0, w * tau);
    const auto E = 9.0 * K * G / (3.0 * K + G);
    EXPECT_NEAR(moduli.column("shear_storage_modulus_Pa")[i], G.real(), 1e-10 * G.real());
    EXPECT_NEAR(moduli.column("shear_loss_modulus_Pa")[i], G.imag(), 1e-10 * G.imag());
    EXPECT_NEAR(moduli.column("young_storage_modulus_Pa")[i], E.real(), 1e-10 * E.real());
    EXPECT_NEAR(moduli.column("young_loss_factor")[i], E.imag() / E.real(), 1e-10);
  }
  const auto summary = nlohmann::json::parse(content_of(directory.results() / "summary.json"));
  EXPECT_EQ(summary["status"], "complete");
  EXPECT_NEAR(summary["instantaneous_shear_modulus_Pa"].get<double>(), law.relaxed.mu + 2.3e6, 1e-3);
  EXPECT_EQ(run({"report", directory.path().string()}).status, 0);
  const auto page = data_of_page(content_of(directory.results() / "report" / "index.html"));
  EXPECT_THAT(page["headline"][0].get<std::string>(), testing::MatchesRegex("Young's modulus .* relaxed, .* at once."));
  EXPECT_THAT(page["headline"].back().get<std::string>(), testing::StartsWith("Largest loss factor in shear "));
}

TEST(ViscoelasticCase, CreepsUnderAStressByFormula) {
  const TemporaryCase directory(replaced(replaced(relaxing_case,
                                                  "strain = \"2 %\"\n[[loading.segments]]\nduration = \"20 "
                                                  "s\"\nincrements = 12\nspacing = \"logarithmic\"\nstrain = \"2 %\"\n",
                                                  "stress = { expr = \"30*t\", unit = \"kPa\" }\n"),
                                         "\"shear\"", "\"tension\""));
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  const CsvTable history = read_csv(directory.results() / "history.csv");
  EXPECT_NEAR(history.column("stress_Pa").back(), 9e3, 1e-9);
  EXPECT_GT(history.column("strain").back(), 9e3 / 9.9e6);
  EXPECT_LT(history.column("strain").back(), 9e3 / 3e6);
}

const std::string pulled_material =
    "young_modulus = \"2 MPa\"\npoisson_ratio = 0.3\n"
    "shear_branches = [{ modulus = \"3 MPa\", time = \"0.1 s\" }, { modulus = \"1 MPa\", time = \"3 s\" }]\n"
    "bulk_branches = [{ modulus = \"2 MPa\", time = \"0.5 s\" }]\n";

/// Stress of a bar with free sides by the fracture program over that of the point, less 1, at the end of each of n
/// steps; the largest.
double difference_of_body(int n) {
  const std::string increment = std::to_string(1.0 / n);
  const TemporaryCase body(
      "kind = \"fracture\"\ntitle = \"bar\"\n[materials.rubber]\nregions = [\"body\"]\nlaw = \"prony\"\n" +
      pulled_material + R"(damageable = false
[mesh]
generator = "box_hexes"
x = [{ length = "2 mm", cells = 2 }]
y = [{ length = "1 mm", cells = 1 }]
z = [{ length = "1 mm", cells = 1 }]
[fracture]
split = "none"
[[boundary]]
patches = ["xmin", "ymin", "zmin"]
type = "symmetry"
[[boundary]]
patch = "xmax"
displacement = ["20 um", "free", "free"]
[output]
curve = { patch = "xmax", component = "x" }
[loading]
duration = "1 s"
)" +
      "initial_increment = " + increment + "\nmaximum_increment = " + increment + "\n");
  const TemporaryCase point("kind = \"viscoelastic\"\ntitle = \"bar\"\n[material]\n" + pulled_material +
                            "[[loading.segments]]\nduration = \"1 s\"\nincrements = " + std::to_string(n) +
                            "\nstrain = \"1 %\"\n");
  for (const TemporaryCase* due : {&body, &point}) EXPECT_EQ(run({"run", due->path().string(), "--quiet"}).status, 0);
  const CsvTable curve = read_csv(body.results() / "force_displacement.csv");
  const CsvTable history = read_csv(point.results() / "history.csv");
  EXPECT_EQ(curve.n_rows(), history.n_rows());
  double largest = 0.0;
  for (std::size_t i = 1; i < curve.n_rows(); ++i) {
    EXPECT_NEAR(curve.column("displacement_m")[i] / 2e-3, history.column("strain")[i], 1e-12) << i;
    const double stress = curve.column("force_x_N")[i] / 1e-6;
    largest = std::max(largest, std::abs(stress / history.column("stress_Pa")[i] - 1.0));
  }
  return largest;
}

// The same branches, the same stress. The transverse strain of the body is linear in a step, so that its stress comes
// with the second order of the steps.
TEST(ViscoelasticCase, ABodyOfTheFractureProgramHasTheSameStress) {
  const double error = difference_of_body(100), half = difference_of_body(200);
  EXPECT_LT(error, 1e-4);
  EXPECT_LT(half, 0.3 * error);
}

/// Within four standard errors.
void expect_truth(const nlohmann::json& fit) {
  const std::vector<FitParameter> truth = fit_parameters(true_series, {}, {});
  ASSERT_EQ(fit["parameters"].size(), truth.size());
  for (std::size_t j = 0; j < truth.size(); ++j) {
    const auto& p = fit["parameters"][j];
    EXPECT_EQ(p["name"], truth[j].name);
    EXPECT_NEAR(p["estimate"].get<double>(), truth[j].first, 4.0 * p["standard_error"].get<double>()) << truth[j].name;
    EXPECT_LT(p["standard_error"].get<double>(), 0.05 * truth[j].first) << truth[j].name;
  }
}

TEST(ViscoelasticCase, FitsFilesAsInstrumentsWriteThemAndSaysTheMaterial) {
  for (const char* unit : {"rad/s", "Hz"}) {
    const BulkFitCase fit(bulk_fit, unit);
    const Outcome outcome = run({"fit", fit.directory.path().string(), "--strict"});
    ASSERT_EQ(outcome.status, 0) << outcome.err << outcome.out;
    EXPECT_NE(outcome.out.find("law = \"prony\""), std::string::npos) << outcome.out;
    const auto json = nlohmann::json::parse(content_of(fit.directory.results() / "fit.json"));
    EXPECT_EQ(json["kind"], "viscoelastic");
    EXPECT_EQ(json["viscoelastic"]["branches_tried"].size(), 5u);
    EXPECT_EQ(json["correlation"].size(), 7u);
    EXPECT_TRUE(json["noise_is_known"].get<bool>());
    expect_truth(json);
    EXPECT_EQ(read_csv(fit.directory.results() / "fit_DMA.csv").n_rows(), 41u);
    const std::filesystem::path fitted = fit.directory.results() / "case.fitted.toml";
    EXPECT_EQ(run({"run", fitted.string()}).status, 0);
    EXPECT_EQ(run({"report", fit.directory.path().string()}).status, 0);
  }
}

TEST(ViscoelasticCase, ItsMaterialIsOneOfAFractureCase) {
  const BulkFitCase fit;
  ASSERT_EQ(run({"fit", fit.directory.path().string()}).status, 0);
  const std::string text = content_of(fit.directory.results() / "case.fitted.toml");
  const std::size_t from = text.find("young_modulus"), to = text.find("[frequency_sweep]");
  std::string bar = bar_case();
  const std::size_t E = bar.find("young_modulus"), nu = bar.find('\n', bar.find("poisson_ratio")) + 1;
  bar.replace(E, nu - E, "law = \"prony\"\n" + text.substr(from, to - from));
  const TemporaryCase fracture(replaced(bar, "[loading]\n", "[loading]\nduration = \"1 s\"\n"));
  const Outcome outcome = run({"check", fracture.path().string()});
  EXPECT_EQ(outcome.status, 0) << outcome.err << bar;
}

TEST(ViscoelasticCase, WithoutStatedNoiseTheScatterOfEachColumnCounts) {
  std::string text = bulk_fit;
  for (const char* noise : {", noise = \"0.7862 kPa\"", ", relative_noise = \"1.4 %\"", ", relative_noise = 0.014"})
    text = replaced(text, noise, "");
  const BulkFitCase fit(text);
  ASSERT_EQ(run({"fit", fit.directory.path().string(), "--strict"}).status, 0);
  const auto json = nlohmann::json::parse(content_of(fit.directory.results() / "fit.json"));
  EXPECT_FALSE(json["noise_is_known"].get<bool>());
  EXPECT_NEAR(json["rms_residual"].get<double>(), 1.0, 0.02);
  expect_truth(json);
}

TEST(ViscoelasticCase, BranchesOutsideOfTheWindowAreSaid) {
  // The bounds keep the time of a branch beyond the 600 s of the relaxation.
  std::string text = replaced(bulk_fit, "[1, 5]", "[3, 3]");
  text = replaced(text, "[fit.bounds]\nyoung_modulus = [\"10 kPa\", \"1 GPa\"]\n",
                  "[fit.bounds]\ntime_3 = [\"2000 s\", \"4000 s\"]\n");
  const BulkFitCase fit(text);
  const Outcome outcome = run({"fit", fit.directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto json = nlohmann::json::parse(content_of(fit.directory.results() / "fit.json"));
  EXPECT_EQ(json["verdict"], "questionable");
  EXPECT_NE(json["reasons"].dump().find("outside of the window of the data"), std::string::npos) << json["reasons"];
}

}  // namespace
}  // namespace pfdm::this_file
