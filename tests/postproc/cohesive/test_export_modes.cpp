// What is written for another code acts there as here, in opening, in shear and between: each deck is evaluated by the
// equations of the code that takes it, on straight paths from the origin, and its tractions are compared with the
// law's.

#include "physics/registry.h"
#include "postproc/exports/export_formats.h"
#include "postproc/exports/law/given_law.h"
#include "tests/postproc/deck_laws.h"
#include "tests/postproc/deck_readers.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <regex>
#include <string>
#include <string_view>
#include <vector>

namespace pfdm::test::this_file {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr InterfaceStrength glue{
    .strength = 10e6, .toughness = 400.0, .shear_strength = 17e6, .shear_toughness = 900.0, .stiffness = 1e13};

GivenLaw bond(std::string_view rule, double ratio, std::string_view law = "linear") {
  GivenLaw given{.name = "bond", .law = {}, .at = glue};
  given.law.law = &find_by_name(traction_separation_laws(), law, "law");
  given.law.mixed_mode = &find_by_name(mixed_modes(), rule, "mixed mode");
  given.law.shear_ratio = given.law.mixed_mode->has_shear_strength() ? 1.0 : ratio;
  given.law.exponent = given.law.depends_on_mode() ? 1.7 : 1.0;
  const auto& shape = given.law.law->shape;
  for (std::size_t i = given.law.law->has_rise() ? 1 : 0; i < shape.size(); ++i)
    given.law.shape.push_back(shape[i].first);
  if (!given.law.law->has_rise()) given.at.stiffness = 0.0;
  return given;
}

Law law_of(const GivenLaw& given) {
  return [given](double opening, double slip) -> Tractions {
    const Vector T = given.law.respond(given.at, Vector::UnitX(), Vector(opening, slip, 0.0), {}).traction;
    return {T.x(), T.y()};
  };
}

std::string deck_of(const GivenLaw& given, const char* format) {
  return export_text(formats_named({format}).front(), law_to_export(given, {}), unit_system("SI"));
}

/// Head and comments without their line breaks.
std::string words_of(std::string deck) {
  deck = std::regex_replace(deck, std::regex("\n(\\*\\*|#|\\$|//) +"), " ");
  return std::regex_replace(deck, std::regex(" +"), " ");
}

/// Largest difference of the tractions over the strength, along rays at these angles from opening [degree].
double difference(const Law& one, const Law& other, std::vector<double> angles = {0, 15, 40, 60, 80, 90}) {
  const double end = 4.0 * glue.shear_toughness / glue.strength;
  double worst = 0.0;
  for (const double angle : angles)
    for (int i = 1; i <= 3000; ++i) {
      const double size = end * std::pow(i / 3000.0, 3.0), phi = angle * std::numbers::pi / 180.0;
      const double opening = angle == 90 ? 0.0 : size * std::cos(phi), slip = size * std::sin(phi);
      const Tractions a = one(opening, slip), b = other(opening, slip);
      worst = std::max({worst, std::abs(a.normal - b.normal), std::abs(a.shear - b.shear)});
    }
  return worst / glue.strength;
}

class ExportedModes : public testing::TestWithParam<double> {};

// Camacho and Ortiz' rule with a shear strength of 0.7, 1 and 1.6 times that in opening.
TEST_P(ExportedModes, OfCamachoAndOrtizActAsHere) {
  const double b = GetParam();
  const GivenLaw given = bond("camacho_ortiz", b);
  const Law here = law_of(given);
  const std::string deck = deck_of(given, "abaqus");
  Deck blocks = read_abaqus(deck);
  for (const char* block : {"PFDM_bond", "PFDM_bond_CONTACT"})
    EXPECT_LT(difference(abaqus(blocks[block]), here), b == 1.0 ? 1e-7 : 3e-3) << block;
  EXPECT_LT(difference(abaqus(blocks["PFDM_bond_TABLE"]), here), 7e-3 * std::max(1.0, b));
  EXPECT_NEAR(blocks["PFDM_bond"]["*ELASTIC, TYPE=TRACTION"].at(0).at(1), b * b * glue.stiffness,
              1e-6 * glue.stiffness);
  const Cards cards = read_lsdyna(deck_of(given, "lsdyna"));
  EXPECT_LT(difference(mat_138(cards), here), 1e-3);
  EXPECT_LT(difference(mat_186(cards), here), 5e-3);
  EXPECT_LT(difference(optistruct(deck_of(given, "optistruct")), here), 1e-5);
  EXPECT_LT(difference(akantu_bilinear(deck_of(given, "akantu")), here), 1e-7);
  const std::string of_moose = deck_of(given, "moose");
  EXPECT_LT(difference(moose(of_moose), here, {0}), 1e-7);
  if (b == 1.0) {
    EXPECT_LT(difference(moose(of_moose), here), 1e-7);
    EXPECT_THAT(words_of(of_moose), Not(HasSubstr("One stiffness")));
  } else {
    EXPECT_THAT(words_of(of_moose), HasSubstr("One stiffness for all modes"));
  }
  EXPECT_THAT(words_of(deck_of(given, "table")), HasSubstr("shear_ratio = "));
}

INSTANTIATE_TEST_SUITE_P(ShearRatios, ExportedModes, testing::Values(0.7, 1.0, 1.6));

// The tables have the law's own shape, in every mode.
TEST(ExportedModes, OfOtherShapesActAsHereInTheTables) {
  for (const char* law : {"exponential", "bilinear"}) {
    const GivenLaw given = bond("camacho_ortiz", 0.7, law);
    Deck blocks = read_abaqus(deck_of(given, "abaqus"));
    EXPECT_LT(difference(abaqus(blocks["PFDM_bond_TABLE"]), law_of(given)), 8e-3) << law;
    EXPECT_LT(difference(mat_186(read_lsdyna(deck_of(given, "lsdyna"))), law_of(given)), 6e-3) << law;
  }
}

TEST(ExportedModes, OfThePowerLawActAsHere) {
  for (const GivenLaw& given : {bond("power_law", 1.0), bond("equal_stiffness", 0.7), bond("equal_stiffness", 1.6)}) {
    SCOPED_TRACE(given.law.mixed_mode->name);
    const Law here = law_of(given);
    Deck blocks = read_abaqus(deck_of(given, "abaqus"));
    EXPECT_LT(difference(abaqus(blocks["PFDM_bond"]), here), 1e-6);
    EXPECT_LT(difference(moose(deck_of(given, "moose")), here), 1e-6);
    EXPECT_LT(difference(mat_138(read_lsdyna(deck_of(given, "lsdyna"))), here), 1e-3);
    EXPECT_THAT(words_of(deck_of(given, "abaqus")), HasSubstr("Of the table: it is the law in opening"));
    EXPECT_THAT(words_of(deck_of(given, "optistruct")), HasSubstr("the exponent and the power law have no place"));
    EXPECT_THAT(words_of(deck_of(given, "akantu")), HasSubstr("between them kappa mixes, and not the power law"));
  }
  EXPECT_THAT(words_of(deck_of(bond("equal_stiffness", 0.5), "table")),
              HasSubstr("mixed_mode = \"equal_stiffness\", shear_ratio = 0.5"));
  EXPECT_THAT(words_of(deck_of(bond("power_law", 1.0), "table")),
              HasSubstr("the power law has no place beside a table"));
}

// The codes begin damage by the squares of both tractions; the energies are the law's in every mode.
TEST(ExportedModes, OfBenzeggaghAndKenaneActAsHereInBothModesAndSayWhatIsBetween) {
  const GivenLaw given = bond("benzeggagh_kenane", 1.0);
  const Law here = law_of(given);
  const auto energy = [](const Law& law, double angle) {
    const double phi = angle * std::numbers::pi / 180.0, end = 4.0 * glue.shear_toughness / glue.strength;
    constexpr int steps = 20000;
    double work = 0.0;
    for (int i = 0; i < steps; ++i) {
      const double size = end * (i + 0.5) / steps;
      const Tractions T = law(size * std::cos(phi), size * std::sin(phi));
      work += (T.normal * std::cos(phi) + T.shear * std::sin(phi)) * end / steps;
    }
    return work;
  };
  Deck blocks = read_abaqus(deck_of(given, "abaqus"));
  for (const Law& there :
       {abaqus(blocks["PFDM_bond"]), moose(deck_of(given, "moose")), mat_138(read_lsdyna(deck_of(given, "lsdyna")))}) {
    EXPECT_LT(difference(there, here, {0, 90}), 1e-3);
    for (const double angle : {20.0, 45.0, 70.0})
      EXPECT_NEAR(energy(there, angle), energy(here, angle), 1e-3 * energy(here, angle)) << angle;
  }
  // At B = 0.7: ((0.3/10^2 + 0.7/17^2)^-1 / (10^2 + 189 0.7^1.7))^(1/2) = 1.0255...; the largest and the least are
  // said.
  const auto ratio = [](double B) {
    return std::sqrt(1.0 / ((1 - B) / 100 + B / 289) / (100 + 189 * std::pow(B, 1.7)));
  };
  double low = 1.0, high = 1.0;
  for (int i = 0; i <= 200; ++i) low = std::min(low, ratio(i / 200.0)), high = std::max(high, ratio(i / 200.0));
  for (const char* format : {"abaqus", "moose", "lsdyna"})
    EXPECT_THAT(words_of(deck_of(given, format)),
                HasSubstr(fmt::format("{:.3g} to {:.3g} times the strength", low, high)));
}

// The potential has another stiffness in shear, and no counterpart between the modes.
TEST(ExportedModes, OfXuAndNeedlemansPotentialAreItsTwoModes) {
  GivenLaw given = bond("xu_needleman", 1.0, "xu_needleman");
  given.at.shear_toughness = 300.0;
  const ExportedLaw law = law_to_export(given, {});
  EXPECT_EQ(law.shear_strength.value, 17e6);
  EXPECT_EQ(law.shear_energy.value, 300.0);
  // 2 q Gc/length_s^2 over Gc/length_n^2 with Gc = e strength length_n, q Gc = (e/2)^(1/2) shear_strength length_s.
  const double ratio = 2.0 * (300.0 / 400.0) * std::pow(400.0 / (std::numbers::e * 10e6), 2.0) /
                       std::pow(300.0 / (std::sqrt(0.5 * std::numbers::e) * 17e6), 2.0);
  EXPECT_NEAR(law.shear_stiffness.value, ratio * law.stiffness.value, 1e-9 * law.shear_stiffness.value);
  EXPECT_THAT(words_of(deck_of(given, "abaqus")), HasSubstr("potential has no counterpart"));
}

}  // namespace
}  // namespace pfdm::test::this_file
