// Fits of bulk material to tests at several temperatures, by the program.

#include "postproc/fits/fit_json.h"
#include "tests/cases/viscoelastic_fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>

namespace pfdm::this_file {
namespace {

using ::testing::HasSubstr;

constexpr const char* shift =
    "temperature_shift = { law = \"wlf\", reference = \"25 degC\", C1 = 17.4, C2 = \"51.6 K\" }\n";

const std::string dma_fit = R"(
[fit]
branches = [1, 4]
[[fit.experiments]]
name = "DMA"
csv = "dma.csv"
deformation = "shear"
temperature = { column = "T" }
frequency = { column = "f" }
storage_modulus = { column = "G1", relative_noise = "1 %" }
loss_modulus = { column = "G2", relative_noise = "1 %" }
)";

std::string with_shift(const std::string& text) {
  return replaced(text, "poisson_ratio = 0.49\n", std::string("poisson_ratio = 0.49\n") + shift);
}

/// Of the true series and WLF with 8.9 and 101.6 K, by hand, a share of each value off by turns.
std::string dma_at(std::initializer_list<double> celsius) {
  std::string text = "# synthetic\nT;f;G1;G2\ndegC;Hz;MPa;MPa\n";
  for (const double T : celsius)
    for (int i = 0; i <= 20; ++i) {
      const double f = 0.1 * std::pow(10.0, 0.1 * i), factor = std::pow(10.0, -8.9 * (T - 25.0) / (101.6 + T - 25.0));
      std::complex<double> M = true_series.relaxed.mu;
      for (const auto& [mu, tau] : true_series.shear) {
        const std::complex<double> x(0.0, 2.0 * std::numbers::pi * f * tau * factor);
        M += mu * x / (1.0 + x);
      }
      const double off = 0.01 * std::sin(13.0 * i * i + T);
      text += fmt::format("{};{};{};{}\n", T, f, 1e-6 * (1.0 + off) * M.real(), 1e-6 * (1.0 - off) * M.imag());
    }
  return text;
}

TEST(ViscoelasticShiftCase, IsFittedWithAColumnOfTemperatures) {
  const TemporaryCase directory(with_shift(bulk_case) + dma_fit);
  directory.write("dma.csv", dma_at({-20.0, 0.0, 25.0, 50.0, 80.0}));
  const Outcome outcome = run({"fit", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const FitReport fit = read_fit_json(directory.results() / "fit.json");
  const auto estimate = [&](const std::string& name) {
    return std::ranges::find(fit.found.parameters, name, &FittedParameter::name)->estimate;
  };
  EXPECT_NEAR(estimate("C1"), 8.9, 0.2);
  EXPECT_NEAR(estimate("C2"), 101.6, 2.0);
  EXPECT_NEAR(estimate("time_3"), 60.0, 3.0);
  EXPECT_THAT(content_of(directory.results() / "case.fitted.toml"), HasSubstr("temperature_shift = { law = \"wlf\""));
  const CsvTable curve = read_csv(directory.results() / "fit_DMA.csv");
  EXPECT_DOUBLE_EQ(curve.column("temperature_K").front(), 353.15);  // hot: low frequencies at the reference
  EXPECT_TRUE(std::ranges::is_sorted(curve.column("reduced_frequency_Hz")));
  ASSERT_EQ(run({"report", directory.path().string(), "--quiet"}).status, 0);
  EXPECT_THAT(content_of(directory.results() / "report" / "index.html"),
              HasSubstr("frequency at the reference temperature [Hz]"));
  EXPECT_EQ(run({"check", (directory.results() / "case.fitted.toml").string()}).status, 0);
}

struct Refused {
  const char* name;
  std::string text;
  std::initializer_list<double> celsius;
  const char* message;
};

TEST(ViscoelasticShiftCase, SaysWhatItNeeds) {
  const std::string all = with_shift(bulk_case) + dma_fit;
  const std::string temperature = "temperature = { column = \"T\" }\n";
  for (const Refused& wrong :
       {Refused{"no shift", bulk_case + dma_fit, {0.0, 25.0, 50.0}, "need temperature_shift in [material]"},
        Refused{"no temperature", replaced(all, temperature, ""), {25.0}, "the test needs its temperature"},
        Refused{"two of three", all, {0.0, 25.0}, "tests at 2 temperatures do not determine C1 and C2 of WLF"},
        Refused{"another unit", replaced(all, "\"T\" }", "\"T\", unit = \"Hz\" }"), {25.0}, "temperature"},
        Refused{"C2 in degC", replaced(all, "\"51.6 K\"", "\"51.6 degC\""), {25.0}, "C2 is a difference"},
        Refused{"estimated without",
                replaced(bulk_case + dma_fit, "branches = [1, 4]\n",
                         "branches = [1, 4]\nestimate = [\"temperature_shift\"]\n"),
                {25.0},
                "[material] has no temperature_shift to begin with"}}) {
    const TemporaryCase directory(wrong.text);
    directory.write("dma.csv", dma_at(wrong.celsius));
    const Outcome outcome = run({"check", directory.path().string()});
    EXPECT_EQ(outcome.status, 2) << wrong.name;
    EXPECT_THAT(outcome.err, HasSubstr(wrong.message)) << wrong.name;
  }
}

}  // namespace
}  // namespace pfdm::this_file
