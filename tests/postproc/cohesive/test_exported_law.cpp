// The law that is exported has what the record tells: strength, energy, shape, and what completes it.

#include "physics/angle.h"
#include "physics/error.h"
#include "tests/postproc/deck_readers.h"
#include "tests/postproc/traced_laws.h"

#include <gmock/gmock.h>

namespace pfdm::test::this_file {
namespace {

using testing::HasSubstr;

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

}  // namespace
}  // namespace pfdm::test::this_file
