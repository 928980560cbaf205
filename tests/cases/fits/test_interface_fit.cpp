// From a measured curve to the law of an interface for another code: pfdm fit, report and cohesive --export of cases
// whose cracks are cohesive faces.

#include "cases/program/fracture/page/fracture_report.h"
#include "cases/program/input/case_files/case_file.h"
#include "postproc/files/csv_table.h"
#include "postproc/page/display_unit.h"
#include "tests/cases/fits/glued_fit.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <sstream>

namespace pfdm::this_file {
namespace {

using ::testing::HasSubstr;

// Writes the record; returns its least-squares line.
struct Straight {
  double strength, toughness;  // [Pa], [J/m^2]
};
Straight measure(const TemporaryCase& directory) {
  const double compliance = 2e-3 / 1e9, area = 1e-6;
  const auto [u, force] = record_glue(directory);
  double n = 0, su = 0, sf = 0, suu = 0, suf = 0;
  for (std::size_t i = 0; i < u.size(); ++i)
    n += 1, su += u[i], sf += force[i], suu += u[i] * u[i], suf += u[i] * force[i];
  // F = F0 (1 - u/u_end): no traction at delta_f; the strength where it meets F = A u E/(2 L).
  const double slope = (n * suf - su * sf) / (n * suu - su * su), F0 = (sf - slope * su) / n;
  const double found = F0 / area / (1.0 - slope * compliance / area);
  return {.strength = found, .toughness = 0.5 * found * (-F0 / slope)};
}

/// Comments in one line.
std::string one_line(const std::string& text) {
  std::string joined;
  std::istringstream words(text);
  for (std::string word; words >> word;)
    if (word != "#") joined += word + " ";
  return joined;
}

ReportPage page_of(const TemporaryCase& directory, const std::string& hash) {
  const CaseFile file = open_case(directory.path());
  return fracture_page(read_fracture_case(file.config.root(), file.directory),
                       read_experiment(file.config.root(), file.directory), case_name(file), hash, directory.results());
}

Table table_of(const ReportPage& page, const std::string& caption) {
  for (const PageRow& row : page.rows)
    for (const PageBlock& block : row.blocks)
      if (const auto* table = std::get_if<Table>(&block); table != nullptr && table->caption.starts_with(caption))
        return *table;
  throw std::runtime_error("the page has no table \"" + caption + "\"");
}

std::vector<std::string> captions_of(const ReportPage& page) {
  std::vector<std::string> captions;
  for (const PageRow& row : page.rows)
    for (const PageBlock& block : row.blocks)
      if (const auto* chart = std::get_if<Chart>(&block)) captions.push_back(chart->caption);
  return captions;
}

// Which parameter moves which part of the curve; `due`: strength and toughness.
void expect_sensitivity_of_a_line(const CsvTable& changes, const std::array<double, 2>& due) {
  const auto force_of = [](double u, double strength, double toughness) {
    const double compliance = 2e-3 / 1e9, final_opening = 2.0 * toughness / strength;
    const double opening = (u - compliance * strength) / (1.0 - compliance * strength / final_opening);
    return 1e-6 * strength * (1.0 - opening / final_opening);
  };
  for (const std::size_t at : {std::size_t{10}, std::size_t{40}, std::size_t{70}}) {
    const double u = changes.column("displacement_m")[at], here = force_of(u, due[0], due[1]);
    EXPECT_NEAR(changes.column("change_by_0_N")[at], force_of(u, 1.01 * due[0], due[1]) - here, 3e-4) << u;
    EXPECT_NEAR(changes.column("change_by_1_N")[at], force_of(u, due[0], 1.01 * due[1]) - here, 3e-4) << u;
  }
}

void expect_page_without_a_run(const TemporaryCase& directory, const nlohmann::json& fit) {
  const ReportPage page = page_of(directory, fit["case_hash"]);
  EXPECT_THAT(page.subtitle, HasSubstr("fitted, not run"));
  const Table estimates = table_of(page, "Fit: sound");
  ASSERT_EQ(estimates.rows.size(), 3U);
  EXPECT_EQ(estimates.rows[0].back(), "by profile likelihood");
  EXPECT_EQ(estimates.rows[1].front(), "interface[0].strength");
  EXPECT_EQ(estimates.rows[1][1], shown(1.6e6, "Pa"));
  const double lower = fit["parameters"][1]["profile"]["lower"], upper = fit["parameters"][1]["profile"]["upper"];
  EXPECT_EQ(estimates.rows[2].back(), fmt::format("{} J/m^2 to {} J/m^2", shown(lower), shown(upper)));
}

void expect_law_without_a_run(const std::string& deck, const nlohmann::json& fit, double strength) {
  const auto& toughness = fit["parameters"][1];
  const std::string key = "normal_strength = ";
  const double written = std::stod(deck.substr(deck.find(key) + key.size()));
  EXPECT_NEAR(written, 1e-6 * strength, 1e-3 * 1e-6 * strength);
  EXPECT_THAT(one_line(deck), HasSubstr("Source: fitted to 1 curves of case"));
  EXPECT_THAT(one_line(deck), HasSubstr("verdict sound"));
  EXPECT_THAT(one_line(deck),
              HasSubstr(fmt::format("toughness = {:.4g} J/m^2, 95 % interval {:.4g} to {:.4g} by profile",
                                    toughness["estimate"].get<double>(), toughness["profile"]["lower"].get<double>(),
                                    toughness["profile"]["upper"].get<double>())));
  EXPECT_THAT(one_line(deck), HasSubstr("Validity: no run of this case is there"));
}

TEST(InterfaceFit, FindsTheLineThatTheLawIsAndExportsIt) {
  const TemporaryCase directory(glued_fit(glue_guess, "profile"));
  const Straight line = measure(directory);
  const std::string place = directory.path().string();
  const Outcome outcome = run({"fit", place});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto fit = nlohmann::json::parse(content_of(directory.results() / "fit.json"));
  ASSERT_EQ(fit["verdict"], "sound") << fit["reasons"];
  const std::array<double, 2> due{line.strength, line.toughness};
  for (std::size_t k = 0; k < 2; ++k) {
    const auto& p = fit["parameters"][k];
    EXPECT_NEAR(p["estimate"].get<double>(), due[k], 1e-3 * due[k]) << p["name"];
    EXPECT_LT(p["profile"]["lower"].get<double>(), due[k]);
    EXPECT_GT(p["profile"]["upper"].get<double>(), due[k]);
  }
  expect_sensitivity_of_a_line(read_csv(directory.results() / fit["sensitivity_file"].get<std::string>()), due);
  expect_page_without_a_run(directory, fit);
  const std::string fitted = (directory.results() / "case.fitted.toml").string();
  const Outcome exported =
      run({"cohesive", fitted, "--export", "moose", "--units", "mm-N-s", "--output", place + "/law"});
  ASSERT_EQ(exported.status, 0) << exported.err;
  const std::string deck = content_of(directory.path() / "law" / "cohesive_law" / "moose.i");
  expect_law_without_a_run(deck, fit, line.strength);
  // With a run.
  ASSERT_EQ(run({"run", fitted, "--quiet", "--output", place + "/law"}).status, 0);
  ASSERT_EQ(run({"cohesive", fitted, "--export", "moose", "--output", place + "/law"}).status, 0);
  EXPECT_THAT(one_line(content_of(directory.path() / "law" / "cohesive_law" / "moose.i")),
              HasSubstr("dissipated up to 1 of its toughness"));
}

// Each law of the posterior is a line from the strength to 2 toughness/strength: the band is that of the samples.
TEST(InterfaceFit, HasALawWithABand) {
  const TemporaryCase directory(glued_fit(glue_guess, "posterior"));
  const Straight line = measure(directory);
  ASSERT_EQ(run({"fit", directory.path().string()}).status, 0);
  const auto fit = nlohmann::json::parse(content_of(directory.results() / "fit.json"));
  ASSERT_EQ(fit["verdict"], "sound") << fit["reasons"];
  const double due[] = {line.strength, line.toughness};
  for (std::size_t k = 0; k < 2; ++k) {
    const auto& p = fit["parameters"][k];
    const double width = p["upper"].get<double>() - p["lower"].get<double>();
    EXPECT_NEAR(p["posterior"]["median"].get<double>(), due[k], 0.1 * width) << p["name"];
    EXPECT_NEAR(p["posterior"]["lower"].get<double>(), p["lower"].get<double>(), 0.15 * width) << p["name"];
    EXPECT_NEAR(p["posterior"]["upper"].get<double>(), p["upper"].get<double>(), 0.15 * width) << p["name"];
  }
  const CsvTable samples = read_csv(directory.results() / "fit_posterior.csv");
  const std::vector<double>&strength = samples.column("interface[0].strength"),
        &toughness = samples.column("interface[0].toughness");
  ASSERT_EQ(fit["posterior"]["law_files"].size(), 1u);
  const CsvTable law = read_csv(directory.results() / fit["posterior"]["law_files"][0].get<std::string>());
  const std::vector<double>& separation = law.column("separation_m");
  for (const std::size_t at : {separation.size() / 4, separation.size() / 2, 3 * separation.size() / 4}) {
    std::vector<double> tractions;
    for (std::size_t i = 0; i < strength.size(); ++i)
      tractions.push_back(strength[i] * std::max(0.0, 1.0 - separation[at] * strength[i] / (2.0 * toughness[i])));
    std::ranges::sort(tractions);
    const double lower = tractions[tractions.size() / 40], upper = tractions[39 * tractions.size() / 40];
    EXPECT_NEAR(law.column("lower_traction_Pa")[at], lower, 0.2 * (upper - lower)) << separation[at];
    EXPECT_NEAR(law.column("upper_traction_Pa")[at], upper, 0.2 * (upper - lower)) << separation[at];
    EXPECT_NEAR(law.column("traction_Pa")[at],
                line.strength * (1.0 - separation[at] * line.strength / (2.0 * line.toughness)), 2e-3 * line.strength);
  }
  const ReportPage page = page_of(directory, fit["case_hash"]);
  EXPECT_EQ(table_of(page, "Fit: sound").rows[0].back(), "posterior: median, interval");
  EXPECT_THAT(captions_of(page), testing::IsSupersetOf({testing::Eq("Law of \"glue\" in opening, with its posterior"),
                                                        testing::Eq("Posterior of interface[0].strength [MPa]"),
                                                        testing::Eq("Posterior: samples")}));
}

// Blocks of half the cells and of stone that is 0.7 times as stiff lead the fit: by themselves they would be 3 % off.
TEST(InterfaceFit, IsLedByACoarseCaseToTheSameLine) {
  std::string text = glued_fit(glue_guess, "profile");
  text.replace(text.find("intervals = \"profile\""), std::string("intervals = \"profile\"").size(),
               "coarse = { \"mesh.x[0].cells\" = 4, \"materials.stone.young_modulus\" = \"0.7 GPa\" }");
  const TemporaryCase directory(text);
  const Straight line = measure(directory);
  const Outcome outcome = run({"fit", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("with mesh.x[0].cells = 4, materials.stone.young_modulus = 0.7 GPa"));
  const auto fit = nlohmann::json::parse(content_of(directory.results() / "fit.json"));
  ASSERT_EQ(fit["verdict"], "sound") << fit["reasons"];
  EXPECT_NEAR(fit["parameters"][0]["estimate"].get<double>(), line.strength, 1e-3 * line.strength);
  EXPECT_NEAR(fit["parameters"][1]["estimate"].get<double>(), line.toughness, 1e-3 * line.toughness);
  EXPECT_LE(fit["fracture"]["runs"]["made"].get<int>(), 6);
  EXPECT_GT(fit["fracture"]["coarse_runs"]["made"].get<int>(), 10);
}

TEST(InterfaceFit, IsNoModelOfFractureOnThePage) {
  const TemporaryCase directory(glued_blocks(linear_glue + "name = \"glue\"\n"));
  ASSERT_EQ(run({"run", directory.path().string(), "--quiet"}).status, 0);
  const auto summary = nlohmann::json::parse(content_of(directory.results() / "summary.json"));
  const Table model = table_of(page_of(directory, summary["case_hash"]), "Model and run");
  EXPECT_EQ(model.rows[0][0], "interface glue");
  EXPECT_EQ(model.rows[0][1], fmt::format("linear, {}, 100 J/m²", shown(2e6, "Pa")));
  for (const auto& row : model.rows) EXPECT_TRUE(row[0] != "fracture" && row[0] != "split") << row[0];
}

void expect_refusal(const std::string& text, std::vector<std::string> options, const std::string& message) {
  const TemporaryCase directory(text);
  options.insert(options.begin(), {"cohesive", directory.path().string()});
  const Outcome outcome = run(options);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr(message));
  EXPECT_FALSE(std::filesystem::exists(directory.results()));
}

TEST(InterfaceExport, RefusesWhatIsNotOneLaw) {
  const std::string both = glued_blocks(linear_glue + "name = \"glue\"\n") +
                           "[[interface]]\nplane = { point = [\"0.5 mm\", \"0 mm\", \"0 mm\"], normal = [1, 0, 0] }\n"
                           "law = \"linear\"\nstrength = \"1 MPa\"\ntoughness = \"9 J/m^2\"\n";
  expect_refusal(both, {}, "there are no results; pfdm run makes them");
  expect_refusal(both + "[cohesive]\ninterfaces = []\n", {}, "--export FORMAT writes one for another code");
  expect_refusal(both, {"--export", "abaqus"},
                 "--surface: say which interface's law is to be written (available: glue, interface_2)");
  expect_refusal(both, {"--export", "abaqus", "--surface", "band"},
                 "there is no surface \"band\" (available: glue, interface_2)");
  expect_refusal(glued_blocks("between = [\"left\", \"right\"]\nlaw = \"linear\"\ntoughness = \"9 J/m^2\"\n"
                              "strength = { expr = \"1 + y\", unit = \"MPa\" }\n"),
                 {"--export", "abaqus"}, "varies from place to place");
}

}  // namespace
}  // namespace pfdm::this_file
