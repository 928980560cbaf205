// Laws as input of other codes: what is written is read back by a small reader of each format, in each system of units,
// and loaded by the formula of the code that takes it.

#include "postproc/exports/export_formats.h"

#include "physics/angle.h"
#include "physics/error.h"
#include "tests/postproc/deck_readers.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <map>
#include <regex>
#include <sstream>

namespace pfdm::test::this_file {
namespace {

using testing::HasSubstr;

// ---- Records

using Curve = std::function<double(double)>;  // traction [Pa] at a separation [m]

using States = std::vector<TractionPoint>;

/// A plane with one place that went through these states; its columns dissipate `dissipated`.
CohesiveReport report_of(const States& states, double dissipated = 10.0) {
  ColumnRecord record{.name = "band", .kind = SurfaceKind::plane, .places = {{.area = 2.0}}, .steps = {}};
  record.steps.push_back({ColumnSample{}});
  for (const auto& [separation, traction] : states)
    record.steps.push_back({{.traction = Vector(traction, 0, 0),
                             .separation = Vector(separation, 0, 0),
                             .surface_energy = dissipated,
                             .largest_damage = 1.0}});
  CohesiveReport report{
      .case_name = "bar", .case_hash = "0123", .version = "9.9", .records = {record}, .results = {{}}, .curve = {}};
  for (CohesiveLaw& law : averaged_laws(record)) {
    const CohesiveFigures figures = figures_of(record, law);
    report.results[0].push_back({.law = std::move(law), .figures = figures, .fits = {}});
  }
  return report;
}

/// Through `n` states of the curve up to `end`.
CohesiveReport report_of(const Curve& curve, double end, int n = 240, double dissipated = 10.0) {
  States states;
  for (int i = 0; i <= n; ++i) states.push_back({end * i / n, curve(end * i / n)});
  return report_of(states, dissipated);
}

constexpr double um = 1e-6, MPa = 1e6;

double rigid(double w) { return 2 * MPa * std::exp(-w / (3 * um)); }
double straight(double w) { return w < 0.5 * um ? 4e12 * w : 2 * MPa * std::exp(-(w - 0.5 * um) / (3 * um)); }
double smooth(double w) { return 2 * MPa * std::cbrt(w / (1 * um)) * std::exp((1 - w / (1 * um)) / 3); }
double breaks(double w) { return w < 3 * um ? 2 * MPa * std::sin(w / (3 * um)) : 0.0; }

const std::map<std::string, Curve> traced{{"rigid", rigid}, {"straight", straight}, {"smooth", smooth}};
constexpr double end_of_record = 12 * um;

double trapezoids(const CohesiveReport& report) {
  const std::vector<ColumnSample>& states = report.results[0][0].law.states;
  double sum = 0.0;
  for (std::size_t i = 1; i < states.size(); ++i)
    sum += 0.5 * (states[i].traction[0] + states[i - 1].traction[0]) *
           (states[i].separation[0] - states[i - 1].separation[0]);
  return sum;
}

/// Area and peak of a law, by many small steps.
std::pair<double, double> area_and_peak(const Curve& law, double end, int n = 400000) {
  double area = 0.0, peak = 0.0;
  for (int i = 0; i < n; ++i) {
    const double T = law(end * (i + 0.5) / n);
    area += T * end / n;
    peak = std::max(peak, T);
  }
  return {area, peak};
}

// ---- Laws of the other codes, in mode I

/// MOOSE's BiLinearMixedModeTraction::computeDamage; Abaqus' linear softening by energy is the same.
Curve bilinear(double K, double N, double G) {
  return [=](double w) {
    const double init = N / K, final_ = 2 * G / K / init;
    if (w > final_) return 0.0;
    const double d = w < init ? 0.0 : final_ * (w - init) / w / (final_ - init);
    return (1 - d) * K * w;
  };
}

double interpolated(const std::vector<std::vector<double>>& rows, std::size_t x, std::size_t y, double at) {
  for (std::size_t i = 1; i < rows.size(); ++i)
    if (at <= rows[i][x])
      return rows[i - 1][y] + (rows[i][y] - rows[i - 1][y]) * (at - rows[i - 1][x]) / (rows[i][x] - rows[i - 1][x]);
  return rows.back()[y];
}

// ---- Tests

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

void expect_close(double value, double expected, double tolerance = 1e-8) {
  EXPECT_NEAR(value, expected, tolerance * std::abs(expected));
}

TEST(ExportedLaw, HasStrengthAndEnergyOfTheRecord) {
  for (const auto& [name, curve] : traced) {
    SCOPED_TRACE(name);
    const CohesiveReport report = report_of(curve, end_of_record);
    const ExportedLaw law = law_to_export(report, {});
    expect_close(law.strength.value, 2 * MPa, 2e-3);
    expect_close(law.energy.value, trapezoids(report));
    const auto [area, peak] = area_and_peak(bilinear(law.stiffness.value, law.strength.value, law.energy.value),
                                            1.1 * law.final_separation());
    expect_close(area, trapezoids(report), 1e-5);
    expect_close(peak, law.strength.value, 1e-4);
    EXPECT_EQ(law.shear_strength.value, law.strength.value);
    EXPECT_EQ(law.shear_energy.value, law.energy.value);
  }
  const ExportedLaw law = law_to_export(report_of(rigid, end_of_record), {});
  expect_close(law.onset(), 0.01 * law.final_separation());
  // The straight rise of 4e12 Pa/m is in series with the rule's stiffness.
  const ExportedLaw soft = law_to_export(report_of(straight, end_of_record), {});
  const double rule = 50 * soft.strength.value * soft.strength.value / soft.energy.value;
  expect_close(1 / soft.stiffness.value, 1 / rule + 1 / 4e12, 1e-6);
}

TEST(ExportedLaw, FollowsTheRecordInItsTables) {
  for (const auto& [name, curve] : traced) {
    SCOPED_TRACE(name);
    const CohesiveReport report = report_of(curve, end_of_record);
    for (const double factor : {1.0, 0.2, 5.0}) {
      const double K = factor * law_to_export(report, {}).stiffness.value;
      if (name != "rigid" && factor > 1) continue;  // stiffer than its own rise
      const ExportedLaw law = law_to_export(report, {.stiffness = K});
      EXPECT_LE(law.curve_error, 0.00101);
      EXPECT_LE(law.damage_error, 0.0024);
      EXPECT_LT(law.curve.size(), 80u);
      EXPECT_LT(law.damage.size(), 300u);
      expect_close(area_under(law.curve), trapezoids(report), 5e-3);
      expect_close(area_under(law.damage, K), trapezoids(report), 5e-3);
      for (std::size_t i = 1; i < law.damage.size(); ++i) {
        EXPECT_GT(law.damage[i].separation, law.damage[i - 1].separation);
        EXPECT_GE(law.damage[i].damage, law.damage[i - 1].damage);
      }
      EXPECT_EQ(law.damage.front().damage, 0.0);
      EXPECT_EQ(law.damage.back().damage, 1.0);
      EXPECT_EQ(law.curve.front().separation, 0.0);
      EXPECT_EQ(law.curve.back().traction, 0.0);
      const auto [area, peak] =
          area_and_peak([&](double w) { return traction_at(law.damage, K, w); }, law.damage.back().separation);
      expect_close(area, area_under(law.damage, K), 1e-4);
      expect_close(peak, law.strength.value, 3e-3);
    }
  }
}

TEST(ExportedLaw, IsCompletedAcrossAJump) {
  const CohesiveReport report = report_of(breaks, end_of_record, 201);
  ASSERT_TRUE(report.results[0][0].figures.jump);
  const ExportedLaw law = law_to_export(report, {});
  EXPECT_DOUBLE_EQ(law.energy.value, 10.0);
  expect_close(area_under(law.curve), 10.0, 5e-3);
  EXPECT_GT(law.curve.back().separation, 3 * um);
  EXPECT_THAT(law.energy.basis, HasSubstr("surface energy that the columns dissipated"));
  EXPECT_THAT(law.remarks, testing::Contains(HasSubstr("broke at once: not seen")));
  EXPECT_DOUBLE_EQ(law_to_export(report, {.energy = 20.0}).energy.value, 20.0);
  // Less than the work up to the jump cannot be.
  const ExportedLaw short_law = law_to_export(report_of(breaks, end_of_record, 201, 0.5), {});
  EXPECT_THAT(short_law.energy.basis, HasSubstr("is not more"));
  EXPECT_GT(short_law.energy.value, 2.0);
}

// As beside a pole that debonds: unloaded, and broken when it opens again. Nothing between was seen, though no step
// falls by half the strength.
TEST(ExportedLaw, EndsWhereItWasUnloaded) {
  const CohesiveReport report = report_of({{0.5 * um, 1 * MPa},
                                           {1 * um, 2 * MPa},
                                           {0.7 * um, 1.3 * MPa},
                                           {0.4 * um, 0.6 * MPa},
                                           {5 * um, 0.1 * MPa},
                                           {9 * um, 0.0}});
  EXPECT_TRUE(report.results[0][0].figures.is_traced());
  const ExportedLaw law = law_to_export(report, {});
  EXPECT_DOUBLE_EQ(law.energy.value, 10.0);
  EXPECT_THAT(law.remarks, testing::Contains(HasSubstr("seen from 0 to 1e-06 m (2e+06 Pa). From there to 5e-06 m")));
  expect_close(area_under(law.curve), 10.0, 5e-3);
}

TEST(ExportedLaw, NeedsAnEnergyIfItEndsEarly) {
  const CohesiveReport report = report_of(rigid, 2 * um);
  EXPECT_THAT([&] { law_to_export(report, {}); },
              testing::ThrowsMessage<InputError>(HasSubstr("not known to its end (it carries 1.027e+06 Pa there)")));
  const ExportedLaw law = law_to_export(report, {.energy = 6.0});
  EXPECT_DOUBLE_EQ(law.energy.value, 6.0);
  expect_close(area_under(law.curve), 6.0, 5e-3);
  EXPECT_THAT([&] { law_to_export(report_of(rigid, end_of_record), {.energy = 6.0}); },
              testing::ThrowsMessage<InputError>(HasSubstr("its area is its energy")));
}

// That of a confined band, which its case knows.
TEST(ExportedLaw, HasTheShearStrengthOfItsBand) {
  CohesiveReport report = report_of(rigid, end_of_record);
  EXPECT_DOUBLE_EQ(law_to_export(report, {}).shear_strength.value, law_to_export(report, {}).strength.value);
  report.shear_ratios = {0.25};
  const ExportedLaw law = law_to_export(report, {});
  EXPECT_DOUBLE_EQ(law.shear_strength.value, 0.25 * law.strength.value);
  EXPECT_THAT(law.shear_strength.basis, HasSubstr("(mu/M)^(1/2) = 0.25"));
  EXPECT_DOUBLE_EQ(law_to_export(report, {.shear_strength = 3e5}).shear_strength.value, 3e5);
}

// The law of an interface is given, not extracted.
TEST(ExportedLaw, IsNotOneOfCohesiveFaces) {
  CohesiveReport report = report_of(rigid, end_of_record);
  report.records[0].is_cohesive = true;
  EXPECT_THAT([&] { law_to_export(report, {}); }, testing::ThrowsMessage<InputError>(HasSubstr("no law to export")));
}

TEST(ExportedLaw, IsTheOneAskedFor) {
  CohesiveReport report = report_of(rigid, end_of_record);
  CohesiveReport other = report_of(breaks, end_of_record, 201);
  other.records[0].name = "other";
  report.records.push_back(other.records[0]);
  report.results.push_back(other.results[0]);
  EXPECT_EQ(law_to_export(report, {}).surface, "band");  // traced
  EXPECT_EQ(law_to_export(report, {.surface = "other"}).surface, "other");
  EXPECT_THAT([&] { law_to_export(report, {.surface = "none"}); },
              testing::ThrowsMessage<InputError>(HasSubstr("no surface \"none\" (available: band, other)")));
  report.records[0].kind = report.records[1].kind = SurfaceKind::interface;
  report.results[0][0].law.to = 15 * degree;
  report.results[1][0].law.from = 15 * degree;
  report.results[1][0].law.to = 30 * degree;
  EXPECT_EQ(law_to_export(report, {.angle = 20 * degree}).surface, "other");
  EXPECT_THAT([&] { law_to_export(report, {.angle = 40 * degree}); },
              testing::ThrowsMessage<InputError>(HasSubstr("no law to export at 40 degrees")));
  EXPECT_THAT([&] { law_to_export(report, {.stiffness = 1e10}); },
              testing::ThrowsMessage<InputError>(HasSubstr("needs more than strength^2 / (2 GI)")));
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
