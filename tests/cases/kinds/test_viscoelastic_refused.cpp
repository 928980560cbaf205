// What cases of bulk material refuse.

#include "tests/cases/viscoelastic_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace pfdm::this_file {
namespace {

const BadInput bad_fits[] = {
    {"frequency_without_unit",
     "frequency = { column = \"f\" }",
     "frequency = { column = \"G1\" }",
     {"\"MPa\" is no unit of a frequency here: \"Hz\", with any prefix, or \"rad/s\""}},
    {"two_units",
     "frequency = { column = \"f\" }",
     "frequency = { column = \"f\", unit = \"Hz\" }",
     {"the file itself says that the unit of \"f\" is \"rad/s\""}},
    {"stress_of_dma", "storage_modulus =", "stress =", {"a test with a frequency is DMA"}},
    {"modulus_without_frequency",
     "frequency = { column = \"f\" }\n",
     "",
     {"a modulus of DMA needs the column of its frequency"}},
    {"noise_of_some", ", relative_noise = \"1.4 %\"", "", {"noise is given for 2 of 3 measured columns"}},
    {"both_noises",
     "relative_noise = \"1.4 %\"",
     "relative_noise = \"1.4 %\", noise = \"1 kPa\"",
     {"either noise or relative_noise, not both"}},
    {"noise_of_the_strain", "unit = \"%\" }", "unit = \"%\", noise = 0.1 }", {"\"noise\" is not known here"}},
    {"branches", "[1, 5]", "[5, 1]", {"the first number of branches is larger than the second"}},
    {"no_column", "\"gamma\"", "\"gama\"", {"there is no column \"gama\""}},
    {"deformation",
     "deformation = \"shear\"\ntime =",
     "deformation = \"torsion\"\ntime =",
     {"\"torsion\" is not a deformation"}},
    {"bound_of_none",
     "young_modulus = [\"10 kPa\", \"1 GPa\"]",
     "modulus_9 = [\"10 kPa\", \"1 GPa\"]",
     {"\"modulus_9\" is not estimated (available: young_modulus, modulus_1, time_1"}},
    {"unit_of_a_bound",
     "young_modulus = [\"10 kPa\", \"1 GPa\"]",
     "time_1 = [\"10 kPa\", \"1 GPa\"]",
     {"expected a time"}},
    {"times_of_bounds",
     "young_modulus = [\"10 kPa\", \"1 GPa\"]",
     "time_1 = [\"10 s\", \"20 s\"]\ntime_2 = [\"0.1 s\", \"2 s\"]",
     {"branches are numbered by rising times"}},
    {"same_file", "name = \"DMA\"", "name = \"relaxation\"", {"would have the same file, fit_relaxation.csv"}},
    {"ramp", "time = \"t\"", "time = \"t\"\nramp = \"-1 s\"", {"must be zero or positive"}},
};

class BadViscoelasticFit : public testing::TestWithParam<BadInput> {};

TEST_P(BadViscoelasticFit, IsRefusedWithOneMessage) {
  const BulkFitCase fit(replaced(bulk_fit, GetParam().good, GetParam().bad));
  expect_refused(fit.directory, GetParam());
}

INSTANTIATE_TEST_SUITE_P(ViscoelasticCase, BadViscoelasticFit, testing::ValuesIn(bad_fits),
                         [](const auto& test) { return test.param.name; });

TEST(ViscoelasticCase, AModulusThatIsHeldStays) {
  const std::string held =
      replaced(replaced(bulk_fit, "branches = [1, 5]", "branches = [1, 2]"),
               "[fit.bounds]\nyoung_modulus = [\"10 kPa\", \"1 GPa\"]\n", "estimate = [\"shear_branches\"]\n");
  const BulkFitCase fit(held);
  const Outcome outcome = run({"fit", fit.directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(content_of(fit.directory.results() / "case.fitted.toml").find("young_modulus = \"1 MPa\""),
            std::string::npos);
}

TEST(ViscoelasticCase, ANegativeStorageModulusIsNamed) {
  const BulkFitCase fit;
  fit.directory.write("dma.csv", "f,G1,tan\nrad/s,MPa,-\n6.2831853,1,0.1\n62.831853,-2,0.2\n");
  const Outcome outcome = run({"check", fit.directory.path().string()});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("a storage modulus must be positive; that at 10 Hz is -2 MPa"), std::string::npos)
      << outcome.err;
}

/// A Maxwell liquid over frequency: 1 MPa, 1 s.
std::string liquid() {
  std::string text = "f,G1,tan\nrad/s,MPa,-\n";
  for (int i = -20; i <= 20; ++i) {
    const double w = std::pow(10.0, 0.1 * i), scatter = 1.0 + 0.01 * std::sin(7.0 * i * i);
    text += std::to_string(w) + "," + std::to_string(scatter * w * w / (1.0 + w * w)) + "," + std::to_string(1.0 / w) +
            "\n";
  }
  return text;
}

// Without a modulus at rest the fit says that the material flows, and that key which keeps one makes it sound.
TEST(ViscoelasticCase, ALiquidIsNamed) {
  const std::string alone =
      replaced(bulk_fit.substr(0, bulk_fit.find("[[fit.experiments]]")) + bulk_fit.substr(bulk_fit.rfind("[[fit.exp")),
               "branches = [1, 5]", "branches = [1, 2]");
  const std::string of_file = replaced(alone, "young_modulus = [\"10 kPa\", \"1 GPa\"]\n", "");
  const BulkFitCase fit(of_file);
  fit.directory.write("dma.csv", liquid());
  const Outcome outcome = run({"fit", fit.directory.path().string()});
  EXPECT_NE(
      (outcome.out + outcome.err).find("the relaxed modulus is zero as far as the tests tell: the material flows"),
      std::string::npos)
      << outcome.out << outcome.err;
  EXPECT_NE(outcome.out.find("verdict: questionable"), std::string::npos) << outcome.out;
  fit.directory.write("case.toml", replaced(replaced(bulk_case + of_file, "[fit.bounds]\n", ""), "branches = [1, 2]",
                                            "branches = [1, 2]\nestimate = [\"shear_branches\"]")
                                       .replace(bulk_case.find("\"1 MPa\""), 7, "\"1 Pa\""));
  const Outcome kept = run({"fit", fit.directory.path().string()});
  EXPECT_NE(kept.out.find("verdict: sound"), std::string::npos) << kept.out << kept.err;
}

TEST(ViscoelasticCase, AStressOfTheOtherSignIsRefused) {
  const BulkFitCase fit;
  fit.directory.write("relaxation.csv", "t;gamma;tau\n0;0;0\n10;1;-2\n20;1;-1.5\n30;1;-1.2\n40;1;-1.1\n");
  const Outcome outcome = run({"check", fit.directory.path().string()});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("stress and strain have opposite signs"), std::string::npos) << outcome.err;
}

TEST(ViscoelasticCase, AFrequencyWithoutUnitIsRefused) {
  const BulkFitCase fit(bulk_fit, "-");
  const Outcome outcome = run({"check", fit.directory.path().string()});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("the file does not say the unit of the frequency: unit = \"Hz\" or unit = \"rad/s\""),
            std::string::npos)
      << outcome.err;
}

const BadInput bad_cases[] = {
    {"strain_and_stress",
     "increments = 7\n",
     "increments = 7\nstress = \"1 kPa\"\n",
     {"a segment has either a strain or a stress"}},
    {"mixed",
     "spacing = \"logarithmic\"\nstrain = \"2 %\"",
     "stress = \"1 kPa\"",
     {"all segments prescribe the strain, or all the stress"}},
    {"no_duration", "duration = \"20 s\"\n", "", {"\"duration\" is missing"}},
    {"frequencies", "to = \"1 kHz\"", "to = \"1 mHz\"", {"must be above \"from\""}},
    {"negative_modulus", "\"1.5 MPa\"", "\"-1.5 MPa\"", {"must be positive"}},
    {"incompressible", "0.49", "0.5", {"must be above -1 and at most 0.4999"}},
};

class BadViscoelasticCase : public testing::TestWithParam<BadInput> {};

TEST_P(BadViscoelasticCase, IsRefusedWithOneMessage) {
  const TemporaryCase directory(replaced(relaxing_case, GetParam().good, GetParam().bad));
  expect_refused(directory, GetParam());
}

INSTANTIATE_TEST_SUITE_P(ViscoelasticCase, BadViscoelasticCase, testing::ValuesIn(bad_cases),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace pfdm::this_file
