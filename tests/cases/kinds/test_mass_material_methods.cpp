// Cases of kind mass_material: what a fit writes as a case, and its methods beside the output error.

#include "cases/program/input/case_files/case_file.h"
#include "cases/program/vibration/mass_material_case.h"
#include "tests/cases/soft_sample.h"
#include "tests/cases/temporary_case.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

namespace pfdm::this_file {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

TEST(MassMaterialProgram, WritesACaseWithWhatItFound) {
  const TemporaryCase directory(soft_case());
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  ASSERT_EQ(run({"fit", directory.path().string()}).status, 0);
  const fs::path fitted = directory.results() / "case.fitted.toml";
  const Outcome outcome = run({"check", fitted.string()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const auto c = read_mass_material_case(open_case(fitted).config.root(), directory.path());
  EXPECT_NEAR(c.model.damping, 40.0, 0.02);
  EXPECT_EQ(c.model.stiffness.size(), 5u);
  EXPECT_EQ(c.tests.size(), 2u);
}

TEST(MassMaterialProgram, FittedTextKeepsEveryTerm) {
  MassMaterial m{.mass = 1.5,
                 .stiffness = {1e6, -2e9},
                 .damping = 0.1,
                 .damping_exponent = 1.25,
                 .reference_velocity = 0.3,
                 .forcing = KernelForcing::damping,
                 .kernel = {{400.0, 1.0 / 3.0}, {{20.0, 7.0}, {-1.0, 2.0}}}};
  const TemporaryCase directory(soft_case());
  directory.write("case.toml", with_table(open_case(directory.path()), "model", model_text("6", m), directory.path()));
  const auto c = read_mass_material_case(open_case(directory.path()).config.root(), directory.path());
  EXPECT_EQ(c.structure, "6");
  EXPECT_EQ(c.model.mass, m.mass);
  EXPECT_EQ(c.model.stiffness, m.stiffness);
  EXPECT_EQ(c.model.damping_exponent, m.damping_exponent);
  ASSERT_EQ(c.model.kernel.size(), 2u);
  EXPECT_EQ(c.model.kernel[0].beta, m.kernel[0].beta);
  EXPECT_EQ(c.model.kernel[1].alpha, m.kernel[1].alpha);
  EXPECT_EQ(c.model.kernel[1].beta, m.kernel[1].beta);
}

TEST(MassMaterialProgram, FittedTextNamesRecordsFromWhereItStands) {
  const TemporaryCase directory("[model]\nmass = 1\n[[test]]\nrecord = { file = \"data/day1.csv\", time = \"t\" }\n");
  const CaseFile file = open_case(directory.path());
  EXPECT_EQ(with_table(file, "model", "[model]\nmass = 2\n", directory.results()),
            "[model]\nmass = 2\n[[test]]\nrecord = { file = \"../data/day1.csv\", time = \"t\" }\n");
}

TEST(MassMaterialProgram, OffersTheReportsLeastSquares) {
  const TemporaryCase directory(soft_case() + "method = \"least_squares\"\n");
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  const Outcome outcome = run({"fit", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json fit = parsed(directory.results() / "fit.json");
  EXPECT_EQ(fit["method"], "least_squares");
  EXPECT_NEAR(fit["parameters"][0]["estimate"].get<double>(), 54e3, 0.05 * 54e3);
  EXPECT_TRUE(fit["parameters"][0]["lower"].is_null());
}

/// Rows of a CSV file below remark, names and units.
std::vector<std::vector<double>> rows_of(const fs::path& file) {
  std::istringstream text(content_of(file));
  std::vector<std::vector<double>> rows;
  int above = 2;  // names and units
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with("#") || above-- > 0) continue;
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream numbers(line);
    rows.emplace_back();
    for (double x = 0.0; numbers >> x;) rows.back().push_back(x);
  }
  return rows;
}

// Iterations, Prony series and the kernel's responses of the report's A4.3; another method's fit takes them away.
TEST(MassMaterialProgram, DocumentsTheTenSteps) {
  const std::string ten_step = replaced(soft_case() + "method = \"ten_step\"\nkernel_order = 2\n", "[fit]\n",
                                        "[fit]\nstructure = \"linear_4b\"\n");
  const TemporaryCase directory(ten_step);
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  const Outcome outcome = run({"fit", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("ten steps: "), std::string::npos) << outcome.out;
  const fs::path folder = directory.results() / "ten_steps";
  const auto iterations = rows_of(folder / "iterations.csv"), series = rows_of(folder / "prony_series.csv");
  const json parameters = parsed(directory.results() / "fit.json")["parameters"];
  ASSERT_FALSE(iterations.empty());
  EXPECT_DOUBLE_EQ(iterations.back()[2], parameters[0]["estimate"].get<double>());
  EXPECT_DOUBLE_EQ(iterations.back()[1], parameters[1]["estimate"].get<double>());
  ASSERT_FALSE(series.empty());
  for (std::size_t i = 1; i < series.size(); ++i) EXPECT_GE(series[i - 1][4], series[i][4]);
  // At t = 0 the impulse response is the sum of the weights, that of a pair twice the real part.
  double sum = 0.0, kept = 0.0;
  for (const auto& term : series) {
    const double weight = (term[1] != 0.0 ? 2.0 : 1.0) * term[2];
    sum += weight;
    kept += term[5] * weight;
  }
  const auto impulse = rows_of(folder / "kernel_impulse.csv");
  ASSERT_FALSE(impulse.empty());
  EXPECT_NEAR(impulse[0][1], sum, 1e-9 * std::abs(sum));
  EXPECT_NEAR(impulse[0][2], kept, 1e-9 * std::abs(kept));
  EXPECT_EQ(rows_of(folder / "kernel_response.csv").front().size(), 9U);
  directory.write("case.toml", soft_case());
  ASSERT_EQ(run({"fit", directory.path().string()}).status, 0);
  EXPECT_FALSE(fs::exists(folder));
}

TEST(MassMaterialProgram, SaysHowManyKernelTermsAMethodTakes) {
  const auto checked = [](const char* fit) {
    const TemporaryCase directory(soft_case() + fit);
    return run({"check", directory.path().string()});
  };
  EXPECT_EQ(checked("method = \"ten_step\"\nkernel_order = 20\n").status, 0);
  const Outcome beyond = checked("method = \"ten_step\"\nkernel_order = 21\n"),
                of_others = checked("kernel_order = 7\n");
  EXPECT_EQ(beyond.status, 2);
  EXPECT_NE(beyond.err.find("between 1 and 20"), std::string::npos) << beyond.err;
  EXPECT_EQ(of_others.status, 2);
  EXPECT_NE(of_others.err.find("between 0 and 6 (\"ten_step\": up to 20)"), std::string::npos) << of_others.err;
}

}  // namespace
}  // namespace pfdm::this_file
