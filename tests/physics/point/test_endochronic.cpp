#include "physics/closed_forms/endochronic.h"
#include "tests/physics/endochronic_laws.h"
#include "tests/physics/physics_checks.h"

namespace pfdm::this_file {
namespace {

TEST(Endochronic, EveryStepFromEveryStateIsSolved) {
  RandomEndochronic random;
  long iterations = 0;
  int most = 0;
  constexpr int n = 10000;
  for (int i = 0; i < n; ++i) {
    const EndochronicLaw law = random.law();
    const EndochronicState before = random.state(law);
    const double size = random.log_uniform(1e-12, 10.0);
    const double dt = 1.0;
    const EndochronicUpdate step = update(law, before, size * random.direction(), dt);
    ASSERT_TRUE(step.converged) << i;
    ASSERT_LE(step.residual, 1e-10) << i;
    // The equations of the step, from the state it gives alone.
    const double scale = step.stress.norm() + law.elasticity.mu * step.state.strain.norm();
    ASSERT_LE(invariant_error(law, step.state), 1e-10 * scale) << i;
    const double dzeta = step.state.zeta - before.zeta;
    const double dz = step.state.z - before.z;
    const Mandel de_p = step.state.plastic_strain - before.plastic_strain;
    const double rounding = 1e-15 * (before.zeta + before.plastic_strain.norm());
    ASSERT_NEAR(de_p.norm(), dzeta, 1e-9 * dzeta + rounding) << i;
    ASSERT_NEAR(law.hardening(before.zeta + law.beta * dzeta, dzeta / dt).f * dz, dzeta, 1e-9 * dzeta + rounding) << i;
    iterations += step.iterations;
    most = std::max(most, step.iterations);
  }
  RecordProperty("mean_iterations", std::to_string(double(iterations) / n));
  std::printf("iterations: mean %.2f, most %d\n", double(iterations) / n, most);
  EXPECT_LE(double(iterations) / n, 4.0);
  EXPECT_LE(most, 9);
}

TEST(Endochronic, TangentIsThatOfTheStep) {
  RandomEndochronic random;
  double largest = 0.0;
  for (int i = 0; i < 500; ++i) {
    const EndochronicLaw law = random.law();
    const EndochronicState before = random.state(law);
    const double size = random.log_uniform(1e-5, 1e-1);
    const Mandel increment = size * random.direction();
    const MandelMatrix tangent = update(law, before, increment, 1.0).tangent;
    MandelMatrix differences;
    const double h = 1e-5 * size;
    for (int k = 0; k < n_components; ++k) {
      const Mandel change = h * Mandel::Unit(k);
      differences.col(k) =
          (update(law, before, increment + change, 1.0).stress - update(law, before, increment - change, 1.0).stress) /
          (2.0 * h);
    }
    largest = std::max(largest, (tangent - differences).norm() / tangent.norm());
  }
  std::printf("largest relative difference of the tangent: %.2g\n", largest);
  EXPECT_LE(largest, 2e-7);
}

/// Total strain of the tension test at the plastic strain of the closed form.
Mandel tension_strain(const IsotropicElasticity& c, double sigma, double plastic) {
  const double axial = sigma / c.young_modulus() + plastic;
  const double lateral = -c.poisson_ratio() * sigma / c.young_modulus() - 0.5 * plastic;
  return {axial, lateral, lateral, 0.0, 0.0, 0.0};
}

TEST(Endochronic, TensionIsExactForAnyStep) {
  const EndochronicLaw law = one_term_law();
  const double plastic = 0.01;
  for (const int n : {1, 2, 10, 1000}) {
    EndochronicState state = virgin_state(law);
    for (int i = 1; i <= n; ++i) {
      const double now = plastic * i / n;
      const double sigma = endochronic_tension(law.kernel[0], 1.0, now);
      const EndochronicUpdate step = update(law, state, tension_strain(law.elasticity, sigma, now) - state.strain, 1.0);
      ASSERT_NEAR(step.stress[0], sigma, 1e-11 * sigma) << n << " steps, step " << i;
      ASSERT_LE(step.stress.tail<5>().norm(), 1e-9 * sigma);
      state = step.state;
    }
    EXPECT_NEAR(state.zeta, std::sqrt(1.5) * plastic, 1e-13);
  }
}

TEST(Endochronic, SeveralTermsAddUp) {
  EndochronicLaw law = one_term_law();
  law.kernel = {{30e9, 700.0}, {5e9, 40.0}, {1e9, 0.0}};
  double sigma = 0.0;
  for (const KernelTerm& term : law.kernel) sigma += endochronic_tension(term, 1.0, 0.004);
  const EndochronicUpdate step = update(law, virgin_state(law), tension_strain(law.elasticity, sigma, 0.004), 1.0);
  EXPECT_NEAR(step.stress[0], sigma, 1e-11 * sigma);
}

TEST(Endochronic, SmallAndLargeExponentsAgreeWithTheClosedForm) {
  // phi1 changes from its series to the formula at alpha dz = 0.02.
  for (const double exponent : {1e-9, 1e-3, 0.019999, 0.020001, 1.0, 50.0, 5000.0}) {
    EndochronicLaw law = one_term_law();
    const double plastic = exponent / (700.0 * std::sqrt(1.5));
    const double sigma = endochronic_tension(law.kernel[0], 1.0, plastic);
    const EndochronicUpdate step = update(law, virgin_state(law), tension_strain(law.elasticity, sigma, plastic), 1.0);
    EXPECT_NEAR(step.stress[0], sigma, 1e-12 * sigma) << exponent;
  }
}

TEST(Endochronic, DoesNotDependOnTheAxes) {
  RandomTensors rotations;
  RandomEndochronic random;
  for (int i = 0; i < 50; ++i) {
    const Tensor R = rotations.rotation();
    const auto turned = [&](const Mandel& v) { return to_mandel(R * to_tensor(v) * R.transpose()); };
    const EndochronicLaw law = random.law();
    const EndochronicState state = random.state(law);
    EndochronicState state_turned = state;
    state_turned.strain = turned(state.strain);
    state_turned.plastic_strain = turned(state.plastic_strain);
    for (Mandel& s : state_turned.s) s = turned(s);
    const Mandel increment = 1e-3 * random.direction();
    const Mandel sigma = update(law, state, increment, 1.0).stress;
    EXPECT_LE((update(law, state_turned, turned(increment), 1.0).stress - turned(sigma)).norm(), 1e-11 * sigma.norm());
  }
}

TEST(Endochronic, ScaleOfIntrinsicTimeIsAGauge) {
  EndochronicLaw law = three_term_law();
  EndochronicLaw scaled = law;
  constexpr double l = 3.7;
  for (KernelTerm& term : scaled.kernel) term.alpha *= l;
  scaled.hardening.with_path = make_factor(hardening_law("saturating"), {l * 3.0, 6.0, l});
  EndochronicState a = virgin_state(law), b = virgin_state(scaled);
  RandomEndochronic random;
  for (int i = 0; i < 100; ++i) {
    const Mandel increment = 1e-3 * random.direction();
    const EndochronicUpdate step = update(law, a, increment, 1.0);
    const EndochronicUpdate step_scaled = update(scaled, b, increment, 1.0);
    ASSERT_LE((step.stress - step_scaled.stress).norm(), 1e-11 * step.stress.norm());
    a = step.state;
    b = step_scaled.state;
  }
  EXPECT_GT(a.zeta, 0.01);
}

TEST(Endochronic, WorkIsStoredOrDissipated) {
  // The trapezoidal rule of the work is of second order, and so is what is left of the account.
  const auto gap = [](int n) {
    const EndochronicLaw law = three_term_law();
    EndochronicState state = virgin_state(law);
    double work = 0.0;
    Mandel sigma = Mandel::Zero();
    for (int i = 1; i <= n; ++i) {
      const double angle = 4.0 * std::numbers::pi * i / n;
      const Mandel strain{0.01 * std::sin(angle),       0.0, 0.003 * std::sin(2.0 * angle), 0.0, 0.0,
                          0.005 * std::sin(0.5 * angle)};
      const EndochronicUpdate step = update(law, state, strain - state.strain, 1.0);
      work += 0.5 * (sigma + step.stress).dot(strain - state.strain);
      EXPECT_GE(step.state.dissipation, state.dissipation);
      sigma = step.stress;
      state = step.state;
    }
    return std::abs(work - free_energy(law, state) - state.dissipation) / work;
  };
  const double coarse = gap(400), fine = gap(800);
  EXPECT_LE(fine, 1e-3);
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.15);
}

TEST(Endochronic, StressStaysWithinTheSaturationRadius) {
  const EndochronicLaw law = three_term_law();
  EndochronicState state = virgin_state(law);
  RandomEndochronic random;
  for (int i = 0; i < 200; ++i) {
    const EndochronicUpdate step = update(law, state, 0.05 * random.direction(), 1.0);
    state = step.state;
    EXPECT_LE(deviator(step.stress).norm(), saturation_radius(law, state.zeta, 0.0) * (1.0 + 1e-12));
  }
  const Mandel along = 0.5 * deviator(Mandel(Mandel::Unit(0)));
  for (int i = 0; i < 5; ++i) state = update(law, state, along, 1.0).state;
  EXPECT_NEAR(deviator(stress(law, state)).norm(), saturation_radius(law, state.zeta, 0.0),
              1e-4 * stress(law, state).norm());
}

TEST(Endochronic, StepsWithoutShapeChangeAreElastic) {
  const EndochronicLaw law = three_term_law();
  const EndochronicUpdate step = update(law, virgin_state(law), 1e-3 * mandel_identity(), 1.0);
  EXPECT_TRUE(step.converged);
  EXPECT_EQ(step.state.zeta, 0.0);
  EXPECT_LE((step.stress - 3e-3 * law.elasticity.bulk_modulus() * mandel_identity()).norm(), 1e-6);
}

TEST(Endochronic, InputThatIsNotFiniteIsNotConverged) {
  EndochronicLaw law = one_term_law();
  EXPECT_FALSE(update(law, virgin_state(law), Mandel::Constant(NAN), 1.0).converged);
  EXPECT_TRUE(update(law, virgin_state(law), 1e-3 * Mandel::Unit(0), 0.0).converged);
  law.hardening.with_rate = logarithmic_rate(0.1, 1e-4);
  EXPECT_FALSE(update(law, virgin_state(law), 1e-3 * Mandel::Unit(0), 0.0).converged);
}

TEST(Endochronic, RefusesLawsThatMakeNoSense) {
  const auto refused = [](auto change) {
    EndochronicLaw law = one_term_law();
    change(law);
    return message_of<InputError>([&] { check(law); });
  };
  using testing::HasSubstr;
  EXPECT_THAT(refused([](EndochronicLaw& law) { law.kernel.clear(); }), HasSubstr("at least one term"));
  EXPECT_THAT(refused([](EndochronicLaw& law) { law.kernel[0].C = -1.0; }), HasSubstr("C must be positive"));
  EXPECT_THAT(refused([](EndochronicLaw& law) { law.kernel[0].alpha = -1.0; }), HasSubstr("alpha zero or positive"));
  EXPECT_THAT(refused([](EndochronicLaw& law) { law.beta = 1.5; }), HasSubstr("between 0 and 1"));
  EXPECT_THAT(refused([](EndochronicLaw& law) { law.elasticity.mu = 0.0; }), HasSubstr("elastic moduli"));
}

}  // namespace
}  // namespace pfdm::this_file
