#include "physics/point/hardening.h"
#include "tests/physics/physics_checks.h"

namespace pfdm::this_file {
namespace {

/// f at zeta = 0.5, 2, 3.5 (columns) for rates of 0.1, 10 and 100 /s.
Factor example_with_rate() {
  return make_factor(
      hardening_law("table_with_rate"),
      rate_table_parameters({0.5, 2.0, 3.5}, {0.1, 10.0, 100.0}, {1.0, 1.7, 1.4, 1.2, 2.0, 1.6, 1.3, 1.8, 2.5}));
}

/// A factor of each kind, with parameters that are not special.
Factor example(const FactorLaw& law) {
  if (law.of_path_and_rate != nullptr) return example_with_rate();
  if (law.tabulated) return make_factor(law, {0.0, 0.5, 2.0, 1.0, 1.7, 1.4});
  std::vector<double> p;
  for (std::size_t i = 0; i < law.parameters.size(); ++i)
    p.push_back(std::isnan(law.parameters[i].otherwise) ? 0.7 + 0.6 * static_cast<double>(i)
                                                        : law.parameters[i].otherwise);
  return make_factor(law, p);
}

void for_factors(const std::function<void(const Factor&)>& check) {
  for (const auto& table : {hardening_laws(), rate_factors()})
    for (const FactorLaw& law : table) {
      SCOPED_TRACE(law.name);
      check(example(law));
    }
}

TEST(Hardening, IsOneAtTheBeginning) {
  for_factors([](const Factor& factor) { EXPECT_NEAR(factor(0.0).value, 1.0, 1e-15); });
}

TEST(Hardening, SlopesAreThoseOfTheValues) {
  for_factors([](const Factor& factor) {
    for (const double x : {0.013, 0.4, 1.1, 3.0, 20.0})
      EXPECT_NEAR(factor(x).slope, slope([&](double y) { return factor(y).value; }, x, 1e-5 * x), 1e-8) << "at " << x;
  });
}

TEST(Hardening, ValuesOfTheFormulas) {
  // By hand: 3 - 2 exp(-6*0.1), 1 + 2*0.25, (1 + 0.3/0.1)^0.5, 1 + 0.1 ln(1 + 0.1/1e-4), (1 + 15)^0.25.
  EXPECT_NEAR(make_factor(hardening_law("saturating"), {3.0, 6.0, 1.0})(0.1).value, 1.9023767278119472, 1e-14);
  EXPECT_NEAR(make_factor(hardening_law("linear"), {2.0, 1.0})(0.25).value, 1.5, 1e-15);
  EXPECT_NEAR(make_factor(hardening_law("power"), {0.1, 0.5, 1.0})(0.3).value, 2.0, 1e-14);
  EXPECT_NEAR(make_factor(rate_factor("logarithmic"), {0.1, 1e-4})(0.1).value, 1.6908754779315221, 1e-14);
  EXPECT_NEAR(make_factor(rate_factor("power"), {0.25, 1.0})(15.0).value, 2.0, 1e-14);
  const Factor table = make_factor(hardening_law("table"), {0.0, 1.0, 3.0, 1.0, 2.0, 1.5});
  EXPECT_NEAR(table(0.5).value, 1.5, 1e-15);
  EXPECT_NEAR(table(2.0).value, 1.75, 1e-15);
  EXPECT_NEAR(table(99.0).value, 1.5, 1e-15);
}

TEST(Hardening, ProductRule) {
  Hardening hardening{.with_path = make_factor(hardening_law("saturating"), {3.0, 6.0, 1.0}),
                      .with_rate = make_factor(rate_factor("power"), {0.25, 1.0})};
  const auto f = [&](double zeta, double rate) { return hardening(zeta, rate).f; };
  const HardeningValue at = hardening(0.2, 4.0);
  EXPECT_NEAR(at.f_zeta, slope([&](double zeta) { return f(zeta, 4.0); }, 0.2), 1e-8);
  EXPECT_NEAR(at.f_rate, slope([&](double rate) { return f(0.2, rate); }, 4.0), 1e-8);
  EXPECT_TRUE(hardening.depends_on_rate());
  EXPECT_FALSE(Hardening{}.depends_on_rate());
}

// By hand: at zeta = 1.25 the rows are 1.35, 1.6, 1.55; 1 /s is half the way from 0.1 to 10 /s in ln.
TEST(Hardening, TableOfPathAndRate) {
  const Hardening hardening{.with_path = example_with_rate(), .with_rate = make_factor(rate_factor("none"), {})};
  EXPECT_NEAR(hardening(1.25, 0.1).f, 1.35, 1e-15);
  EXPECT_NEAR(hardening(1.25, 1.0).f, 1.475, 1e-15);
  EXPECT_NEAR(hardening(1.25, 10.0).f, 1.6, 1e-15);
  EXPECT_NEAR(hardening(1.25, 1e9).f, 1.55, 1e-15);
  EXPECT_NEAR(hardening(1.25, 0.0).f, 1.35, 1e-15);
  EXPECT_NEAR(hardening(0.0, 0.1).f, 1.0, 1e-15);
  EXPECT_NEAR(hardening(9.0, 100.0).f, 2.5, 1e-15);
  for (const double zeta : {0.2, 1.3, 2.6, 5.0})
    for (const double rate : {0.01, 0.7, 30.0, 400.0}) {
      const HardeningValue at = hardening(zeta, rate);
      EXPECT_NEAR(at.f_zeta, slope([&](double z) { return hardening(z, rate).f; }, zeta), 1e-8);
      EXPECT_NEAR(at.f_rate, slope([&](double r) { return hardening(zeta, r).f; }, rate, 1e-5 * rate), 1e-8);
    }
  EXPECT_TRUE(hardening.depends_on_rate());
}

TEST(Hardening, RefusesParametersThatMakeNoSense) {
  using testing::HasSubstr;
  const auto refused = [](const FactorLaw& law, std::vector<double> p) {
    return message_of<InputError>([&] { make_factor(law, p); });
  };
  EXPECT_THAT(refused(hardening_law("saturating"), {3.0, 6.0}), HasSubstr("expected 3 parameters, found 2"));
  EXPECT_THAT(refused(hardening_law("saturating"), {-3.0, 6.0, 1.0}), HasSubstr("f_inf = -3 must be positive"));
  EXPECT_THAT(refused(hardening_law("saturating"), {3.0, NAN, 1.0}), HasSubstr("a parameter is nan"));
  EXPECT_THAT(refused(hardening_law("table"), {0.0, 0.0, 1.0, 2.0}), HasSubstr("zeta must increase"));
  EXPECT_THAT(refused(hardening_law("table"), {0.0, 1.0, 1.0, 0.0}), HasSubstr("f must be positive"));
  EXPECT_THAT(refused(hardening_law("table"), {0.0, 1.0, 1.0}), HasSubstr("an f for each zeta"));
  const auto refused_grid = [&](const std::vector<double>& zeta, const std::vector<double>& rate, std::size_t n) {
    return refused(hardening_law("table_with_rate"),
                   rate_table_parameters(zeta, rate, std::vector<double>(n, zeta.size() > 2 ? -1.0 : 1.0)));
  };
  EXPECT_THAT(refused_grid({0.0, 0.0}, {1.0, 2.0}, 4), HasSubstr("zeta must increase"));
  EXPECT_THAT(refused_grid({0.0, 1.0}, {2.0, 1.0}, 4), HasSubstr("the rate must increase"));
  EXPECT_THAT(refused_grid({0.0, 1.0}, {0.0, 1.0}, 4), HasSubstr("the rate must be positive"));
  EXPECT_THAT(refused_grid({0.0, 1.0, 2.0}, {1.0, 2.0}, 6), HasSubstr("f must be positive"));
  EXPECT_THAT(refused_grid({0.0, 1.0}, {1.0, 2.0}, 3), HasSubstr("an f for each pair"));
  EXPECT_THAT(refused_grid({0.0}, {1.0, 2.0}, 2), HasSubstr("two zeta and two rates or more"));
}

TEST(Hardening, UnknownNamesAreAnsweredWithThoseThereAre) {
  expect_unknown_name_is_answered(hardening_laws(), hardening_law);
  expect_unknown_name_is_answered(rate_factors(), rate_factor);
}

}  // namespace
}  // namespace pfdm::this_file
