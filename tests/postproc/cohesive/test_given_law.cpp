// Laws of cohesive interfaces as input of other codes, against their closed forms.

#include "physics/error.h"
#include "postproc/exports/export_formats.h"
#include "postproc/exports/law/given_law.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace pfdm::test::this_file {
namespace {

constexpr double strength = 10e6, toughness = 400.0;  // [Pa], [J/m^2]

template <class Row>
const Row& named(std::span<const Row> rows, std::string_view name) {
  return *std::ranges::find(rows, name, &Row::name);
}

GivenLaw bond(std::string_view law, double stiffness = 0.0, std::string_view mode = "camacho_ortiz") {
  GivenLaw given{.name = "bond",
                 .law = {.law = &named(traction_separation_laws(), law), .mixed_mode = &named(mixed_modes(), mode)},
                 .at = {.strength = strength, .toughness = toughness, .stiffness = stiffness}};
  const auto& shape = given.law.law->shape;
  for (std::size_t i = given.law.law->has_rise() ? 1 : 0; i < shape.size(); ++i)
    given.law.shape.push_back(shape[i].first);
  return given;
}

void expect_curve(const ExportedLaw& law, const std::function<double(double)>& traction, double end) {
  for (int i = 1; i < 200; ++i) {
    const double separation = end * i / 200.0;
    EXPECT_NEAR(traction_at(law.curve, separation), traction(separation), 4e-3 * strength) << separation;
    EXPECT_NEAR(traction_at(law.damage, law.stiffness.value, separation), traction(separation), 6e-3 * strength);
  }
  EXPECT_NEAR(area_under(law.curve), toughness, 4e-3 * toughness);
}

// K in series with delta = delta_f (1 - T/strength): T = strength (1 - delta/delta_f) / (1 - strength/(K delta_f)).
TEST(GivenLaws, ThatAreRigidAtFirstHaveThePenaltyStiffnessInSeries) {
  const ExportedLaw law = law_to_export(bond("linear"), {});
  const double K = 50.0 * strength * strength / toughness, end = 2.0 * toughness / strength;
  EXPECT_NEAR(law.stiffness.value, K, 1e-4 * K);
  EXPECT_EQ(law.strength.value, strength);
  EXPECT_EQ(law.energy.value, toughness);
  expect_curve(
      law,
      [&](double delta) {
        return std::min(K * delta, std::max(0.0, strength * (1.0 - delta / end) / (1.0 - strength / (K * end))));
      },
      1.1 * end);
}

TEST(GivenLaws, WithAStiffnessBeginWithIt) {
  const double K = 1e12, rise = strength / K, end = 2.0 * toughness / strength;
  const ExportedLaw law = law_to_export(bond("linear", K), {});
  EXPECT_EQ(law.stiffness.value, K);
  expect_curve(
      law,
      [&](double delta) { return delta < rise ? K * delta : std::max(0.0, strength * (end - delta) / (end - rise)); },
      1.1 * end);
}

// sigma e x exp(-x) with x = delta/delta_0, delta_0 = Gc/(e sigma), whose rise is steepest at once: in series with K
// less that.
TEST(GivenLaws, OfXuAndNeedlemanKeepTheirArea) {
  const ExportedLaw law = law_to_export(bond("xu_needleman"), {});
  EXPECT_NEAR(area_under(law.curve), toughness, 0.01 * toughness);
  double most = 0.0;
  for (const TractionPoint& p : law.curve) most = std::max(most, p.traction);
  EXPECT_NEAR(most, strength, 1e-3 * strength);
}

TEST(GivenLaws, HaveTheModesOfTheirRule) {
  GivenLaw given = bond("linear");
  given.law.shear_ratio = 0.5;
  ExportedLaw law = law_to_export(given, {});
  EXPECT_EQ(law.shear_strength.value, 0.5 * strength);
  EXPECT_EQ(law.shear_energy.value, toughness);
  given = bond("linear", 1e13, "benzeggagh_kenane");
  given.at.shear_strength = 17e6, given.at.shear_toughness = 900.0, given.law.exponent = 1.7;
  law = law_to_export(given, {});
  EXPECT_EQ(law.shear_strength.value, 17e6);
  EXPECT_EQ(law.shear_energy.value, 900.0);
  EXPECT_EQ(law.exponent.value, 1.7);
  const std::string deck = export_text(formats_named({"moose"}).front(), law, unit_system("mm-N-s"));
  for (const char* line : {"normal_strength = 10\n", "shear_strength = 17\n", "GI_c = 0.4\n", "GII_c = 0.9\n",
                           "eta = 1.7\n", "penalty_stiffness = 10000\n"})
    EXPECT_THAT(deck, testing::HasSubstr(line));
  law = law_to_export(given, {.shear_strength = 5e6, .shear_energy = 50.0, .exponent = 3.0});
  EXPECT_EQ(law.shear_strength.value, 5e6);
  EXPECT_EQ(law.shear_energy.value, 50.0);
  EXPECT_EQ(law.exponent.value, 3.0);
  given.law.mixed_mode = &named(mixed_modes(), "power_law");
  EXPECT_EQ(law_to_export(given, {}).exponent.value, 1.7);
  EXPECT_EQ(law_to_export(given, {}).mix, ModeMix::power_law);
  EXPECT_THAT(export_text(formats_named({"moose"}).front(), law_to_export(given, {}), unit_system("SI")),
              testing::HasSubstr("mixed_mode_criterion = POWER_LAW\n"));
}

void expect_refusal(const ExportChoice& choice, const std::string& message) {
  try {
    law_to_export(bond("linear"), choice);
    ADD_FAILURE() << message;
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr(message));
  }
}

TEST(GivenLaws, LeaveNoRoomForAnAngleOrAnEnergy) {
  expect_refusal({.angle = 0.1}, "--angle: the law of \"bond\" is the same everywhere");
  expect_refusal({.energy = 10.0}, "--energy: the toughness of \"bond\" is given by the case");
  expect_refusal({.stiffness = 1e11}, "the law needs more than strength^2 / (2 GI)");
}

}  // namespace
}  // namespace pfdm::test::this_file
