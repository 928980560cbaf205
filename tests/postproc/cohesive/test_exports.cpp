// Laws as input of other codes: what is written is read back by a small reader of each format, in each system of units,
// and loaded by the formula of the code that takes it.

#include "physics/error.h"
#include "postproc/exports/export_formats.h"
#include "tests/postproc/deck_readers.h"
#include "tests/postproc/traced_laws.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace pfdm::test::this_file {
namespace {

using testing::HasSubstr;

double interpolated(const std::vector<std::vector<double>>& rows, std::size_t x, std::size_t y, double at) {
  for (std::size_t i = 1; i < rows.size(); ++i)
    if (at <= rows[i][x])
      return rows[i - 1][y] + (rows[i][y] - rows[i - 1][y]) * (at - rows[i - 1][x]) / (rows[i][x] - rows[i - 1][x]);
  return rows.back()[y];
}

/// Metres, Pascals and kilograms of the units of a system: [length, stress, mass].
const std::map<std::string, std::array<double, 3>> in_si{
    {"SI", {1, 1, 1}}, {"mm-N-s", {1e-3, 1e6, 1e3}}, {"mm-kN-ms", {1e-3, 1e9, 1}}, {"um-uN-s", {1e-6, 1e6, 1}}};

struct Exported {
  CohesiveReport report;
  ExportedLaw law;
  double L = 1, S = 1, M = 1, G = 1, K = 1;  // SI value of the units
  std::string text;
  double energy = 0.0;
};

ExportChoice given_shear() { return {.shear_strength = 3e6, .shear_energy = 25.0, .exponent = 1.5}; }

/// Calls `check` for each traced law and system of units.
void for_all(const std::string& format, const ExportChoice& choice, const std::function<void(const Exported&)>& check) {
  for (const auto& [name, curve] : traced)
    for (const auto& [system, si] : in_si) {
      SCOPED_TRACE(name + " in " + system);
      Exported e;
      e.report = report_of(curve, end_of_record);
      e.law = law_to_export(e.report, choice);
      e.L = si[0], e.S = si[1], e.M = si[2], e.G = e.S * e.L, e.K = e.S / e.L;
      e.text = export_text(formats_named({format}).front(), e.law, unit_system(system));
      e.energy = trapezoids(e.report);
      check(e);
    }
}

TEST(Exports, AbaqusReadsBack) {
  for_all("abaqus", given_shear(), [](const Exported& e) {
    Deck deck = read_abaqus(e.text);
    const std::string evolution = "*DAMAGE EVOLUTION, TYPE=ENERGY, SOFTENING=LINEAR, MIXED MODE BEHAVIOR=BK, POWER=1.5";
    for (const std::string block : {"PFDM_band", "PFDM_band_CONTACT"}) {
      const auto rigidity = deck[block][block == "PFDM_band" ? "*ELASTIC, TYPE=TRACTION" : "*COHESIVE BEHAVIOR"].at(0);
      const auto initiation = deck[block]["*DAMAGE INITIATION, CRITERION=QUADS"].at(0);
      const auto energies = deck[block][evolution].at(0);
      for (const double K : rigidity) expect_close(K * e.K, e.law.stiffness.value);  // GII is not GI: one for all modes
      expect_close(initiation.at(0) * e.S, e.law.strength.value);
      expect_close(initiation.at(1) * e.S, 3e6);
      expect_close(initiation.at(2) * e.S, 3e6);
      expect_close(energies.at(0) * e.G, e.energy);
      expect_close(energies.at(1) * e.G, 25.0);
      expect_close(energies.at(2) * e.G, 25.0);
    }
    auto& table = deck["PFDM_band_TABLE"];
    const double K = table["*ELASTIC, TYPE=TRACTION"].at(0).at(0);
    const double onset = table["*DAMAGE INITIATION, CRITERION=QUADS"].at(0).at(0) / K;
    const auto& rows = table["*DAMAGE EVOLUTION, TYPE=DISPLACEMENT, SOFTENING=TABULAR"];
    EXPECT_EQ(rows.front(), (std::vector<double>{0, 0}));
    EXPECT_EQ(rows.back()[0], 1.0);
    const auto law = [&](double w) { return (1 - (w < onset ? 0 : interpolated(rows, 1, 0, w - onset))) * K * w; };
    const auto [area, peak] = area_and_peak(law, onset + rows.back()[1]);
    expect_close(area * e.G, e.energy, 5e-3);
    expect_close(peak * e.S, e.law.strength.value, 3e-3);
  });
}

TEST(Exports, MooseReadsBack) {
  for_all("moose", given_shear(), [](const Exported& e) {
    auto values = read_assignments(e.text);
    EXPECT_EQ(values["type"], "BiLinearMixedModeTraction");
    EXPECT_EQ(values["mixed_mode_criterion"], "BK");
    const double K = std::stod(values["penalty_stiffness"]), N = std::stod(values["normal_strength"]);
    const double G = std::stod(values["GI_c"]);
    expect_close(K * e.K, e.law.stiffness.value);
    expect_close(N * e.S, e.law.strength.value);
    expect_close(std::stod(values["shear_strength"]) * e.S, 3e6);
    expect_close(std::stod(values["GII_c"]) * e.G, 25.0);
    EXPECT_EQ(std::stod(values["eta"]), 1.5);
    const auto [area, peak] = area_and_peak(bilinear(K, N, G), 3 * G / N);
    expect_close(area * e.G, e.energy, 1e-5);
    expect_close(peak * e.S, e.law.strength.value, 1e-3);
    EXPECT_EQ(std::count(e.text.begin(), e.text.end(), '['), std::count(e.text.begin(), e.text.end(), ']'));
  });
}

TEST(Exports, LsDynaReadsBack) {
  for_all("lsdyna", given_shear(), [](const Exported& e) {
    auto cards = read_fields(e.text, [](const std::string& keyword, std::size_t row) -> std::size_t {
      return keyword == "*DEFINE_CURVE" && row > 0 ? 20 : 10;
    });
    const auto& bilinear_card = cards["*MAT_COHESIVE_MIXED_MODE"];
    expect_close(bilinear_card[0].at(1) * e.M / e.L / e.L, 1e-3, 1e-4);
    expect_close(bilinear_card[0].at(4) * e.K, e.law.stiffness.value, 1e-4);
    expect_close(bilinear_card[0].at(5) * e.K, e.law.stiffness.value, 1e-4);
    expect_close(bilinear_card[0].at(6) * e.G, e.energy, 1e-4);
    expect_close(bilinear_card[0].at(7) * e.G, 25.0, 1e-4);
    expect_close(bilinear_card[1].at(1) * e.S, e.law.strength.value, 1e-4);
    expect_close(bilinear_card[1].at(2) * e.S, 3e6, 1e-4);
    const auto& general = cards["*MAT_COHESIVE_GENERAL"];
    EXPECT_EQ(general[0].at(4), 1.0);  // Benzeggagh and Kenane; 2: separations over their final values
    EXPECT_EQ(general[0].at(5), cards["*DEFINE_CURVE"][0].at(0));
    EXPECT_EQ(general[1].at(0), 1.5);
    // Normalised; the final separation is GIC / (area T).
    std::vector<std::vector<double>> points(cards["*DEFINE_CURVE"].begin() + 1, cards["*DEFINE_CURVE"].end());
    EXPECT_EQ(points.front(), (std::vector<double>{0, 0}));
    EXPECT_EQ(points.back(), (std::vector<double>{1, 0}));
    const auto [area, peak] = area_and_peak([&](double x) { return interpolated(points, 0, 1, x); }, 1.0);
    expect_close(peak, 1.0, 1e-3);
    const double final_separation = general[0].at(6) / (area * general[1].at(1)) * e.L;
    expect_close(final_separation, end_of_record, 6e-3);
  });
}

TEST(Exports, OptiStructReadsBack) {
  for_all("optistruct", given_shear(), [](const Exported& e) {
    EXPECT_THAT(e.text, HasSubstr("\nMCOHE*  "));
    const std::vector<std::string> fields = read_large_fields(e.text);
    ASSERT_EQ(fields.size(), 16u);
    EXPECT_EQ(std::stoi(fields[0]), 1);
    EXPECT_EQ(std::stoi(fields[1]), 1);  // bilinear
    const double energy = std::stod(fields[8]), onset = std::stod(fields[9]), end = std::stod(fields[10]);
    expect_close(energy * e.G, e.energy);
    expect_close(2 * energy / end * e.S, e.law.strength.value);
    expect_close(2 * energy / end / onset * e.K, e.law.stiffness.value);
    expect_close(std::stod(fields[11]), 3e6 / e.law.strength.value);
    EXPECT_EQ(std::stod(fields[15]), -1.0);
    for (const std::string& field : fields) {
      const bool empty = field.find_first_not_of(' ') == std::string::npos;
      EXPECT_TRUE(empty || field[0] == ' ') << field;
    }
  });
}

TEST(Exports, AkantuReadsBack) {
  for_all("akantu", given_shear(), [](const Exported& e) {
    auto values = read_assignments(e.text);
    EXPECT_THAT(e.text, HasSubstr("\nmaterial cohesive_linear [\n"));
    const double sigma = std::stod(values["sigma_c"]), G = std::stod(values["G_c"]);
    const double beta = std::stod(values["beta"]), kappa = std::stod(values["kappa"]), delta_c = 2 * G / sigma;
    expect_close(std::stod(values["penalty"]) * e.K, e.law.stiffness.value);
    const auto [area, peak] = area_and_peak([&](double w) { return sigma * (1 - w / delta_c); }, delta_c);
    expect_close(area * e.G, e.energy, 1e-5);
    expect_close(peak * e.S, e.law.strength.value, 1e-3);
    // Sliding alone: Delta = beta/kappa delta_t, T_t = beta^2/kappa delta_t/Delta sigma_c (1 - Delta/delta_c).
    const auto [shear_area, shear_peak] = area_and_peak(
        [&](double w) { return beta * sigma * (1 - beta / kappa * w / delta_c); }, kappa * delta_c / beta);
    expect_close(shear_area * e.G, 25.0, 1e-5);
    expect_close(shear_peak * e.S, 3e6, 1e-3);
  });
}

TEST(Exports, Solids4foamReadsBack) {
  for_all("solids4foam", given_shear(), [](const Exported& e) {
    auto mixed = read_dimensioned(e.text, "solidCohesive");
    expect_close(mixed.at("sigmaMax") * e.S, e.law.strength.value);
    expect_close(mixed.at("tauMax") * e.S, 3e6);
    expect_close(mixed.at("GIc") * e.G, e.energy);
    expect_close(mixed.at("GIIc") * e.G, 25.0);
    auto mode_I = read_dimensioned(e.text, "simpleCohesiveZone");
    const double sigma = mode_I.at("sigmaMax"), end = 2 * mode_I.at("GIc") / sigma;
    const auto [area, peak] = area_and_peak([&](double w) { return sigma * (1 - w / end); }, end);
    expect_close(area * e.G, e.energy, 1e-5);
    EXPECT_EQ(std::count(e.text.begin(), e.text.end(), '{'), std::count(e.text.begin(), e.text.end(), '}'));
  });
}

TEST(Exports, TableReadsBack) {
  for_all("table", {}, [](const Exported& e) {
    std::istringstream lines(e.text);
    std::vector<std::vector<double>> rows;
    bool named = false;
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("#")) continue;
      if (!std::exchange(named, true)) continue;
      std::vector<double> row;
      std::istringstream entries(line);
      for (std::string entry; std::getline(entries, entry, ',');) row.push_back(std::stod(entry));
      ASSERT_EQ(row.size(), 3u);
      rows.push_back(row);
    }
    const double K = e.law.stiffness.value / e.K;
    for (const auto& row : rows) EXPECT_NEAR(row[1], (1 - row[2]) * K * row[0], 1e-6 * e.law.strength.value / e.S);
    const auto law = [&](double w) { return (1 - interpolated(rows, 0, 2, w)) * K * w; };
    expect_close(area_and_peak(law, rows.back()[0]).first * e.G, e.energy, 5e-3);
  });
}

TEST(Exports, SayWhatTheyRestOnBeforeTheFirstCard) {
  const ExportedLaw law = law_to_export(report_of(rigid, end_of_record), {});
  for (const ExportFormat& format : export_formats()) {
    const std::string text = export_text(format, law, unit_system("mm-N-s"));
    SCOPED_TRACE(text);
    std::istringstream lines(text);
    std::string head;
    for (std::string line; std::getline(lines, line) && line.starts_with(format.comment);) {
      EXPECT_LT(line.size(), 121u);
      head += line.substr(format.comment.size());
    }
    head = std::regex_replace(head, std::regex(" +"), " ");
    for (const char* said :
         {"pfdm 9.9, case bar (0123)", "surface \"band\"", "opening and tension are positive", "length mm, stress MPa",
          "not measured", "assumed, GI", "seen from 0 to 1.2e-05 m", "50 strength^2/GI", "% of the strength are left"})
      EXPECT_THAT(head, HasSubstr(said));
  }
}

TEST(Exports, NameFormatsAndUnits) {
  EXPECT_EQ(formats_named({"all"}).size(), export_formats().size());
  EXPECT_THAT([] { formats_named({"abacus"}); },
              testing::ThrowsMessage<InputError>(
                  HasSubstr("no format \"abacus\" (available: abaqus, moose, lsdyna, optistruct, akantu, solids4foam, "
                            "table, all)")));
  EXPECT_THAT([] { unit_system("inch"); },
              testing::ThrowsMessage<InputError>(HasSubstr("(available: SI, mm-N-s, mm-kN-ms, um-uN-s)")));
  for (const auto& [name, si] : in_si) {
    const UnitSystem& units = unit_system(name);
    EXPECT_EQ((std::array<double, 3>{units.length, units.stress, units.mass}), si) << name;
  }
}

}  // namespace
}  // namespace pfdm::test::this_file
