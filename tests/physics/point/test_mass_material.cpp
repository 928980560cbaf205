#include "physics/error.h"
#include "physics/point/mass_material.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

namespace pfdm::this_file {
namespace {

using Complex = std::complex<double>;

MassMaterial sample(std::string_view structure) {
  const ModelStructure& s = model_structure(structure);
  MassMaterial model{.mass = 1.12, .stiffness = {2.7e6}, .damping = 70.0, .reference_velocity = 0.3, .kernel = {}};
  if (s.stiffness_order == 5) model.stiffness = {2.7e6, -6.8e8, -2.7e12, 2.7e15, 1.4e19};
  if (s.nonlinear_damping) model.damping_exponent = 1.8;
  model.forcing = s.forcing;
  const double scale = s.forcing == KernelForcing::stiffness      ? -150.0
                       : s.forcing == KernelForcing::displacement ? -1.6e8
                                                                  : 3e5;
  if (s.forcing != KernelForcing::none) model.kernel.push_back({1500.0, scale});
  return model;
}

TEST(MassMaterial, EveryNamedModelHasTheTermsOfItsRow) {
  std::set<std::string_view> names;
  for (const ModelStructure& s : model_structures()) {
    SCOPED_TRACE(s.name);
    EXPECT_TRUE(names.insert(s.name).second);
    const MassMaterial model = sample(s.name);
    const double z = 1.3e-4;
    const double velocity = -0.21;
    const double ratio = s.nonlinear_damping ? std::pow(0.7, 1.8) : 1.0;
    EXPECT_NEAR(damping_force(model, velocity), 70.0 * velocity * ratio, 1e-10);
    double k = 0.0;
    for (int i = 0; i < s.stiffness_order; ++i) k += model.stiffness[i] * std::pow(z, i + 1);
    EXPECT_NEAR(stiffness_force(model, z), k, 1e-12 * std::abs(k));
    const double expected[] = {0.0, z, velocity, k, velocity * ratio};
    EXPECT_NEAR(kernel_forcing(model, z, velocity), expected[static_cast<int>(s.forcing)], 1e-12 * std::abs(k));
    EXPECT_EQ(s.kernel_order == 0, s.forcing == KernelForcing::none);
  }
}

TEST(MassMaterial, SlopeOfTheStiffnessIsItsDerivative) {
  const MassMaterial model = sample("2");
  for (const double z : {-3e-4, 0.0, 2e-4}) {
    const double h = 1e-8;
    const double difference = (stiffness_force(model, z + h) - stiffness_force(model, z - h)) / (2 * h);
    EXPECT_NEAR(stiffness_slope(model, z), difference, 1e-6 * std::abs(difference));
  }
}

// The transform of g, integrated numerically, for a real term and a conjugate pair.
TEST(MassMaterial, KernelResponseIsTheTransformOfTheKernel) {
  MassMaterial model = sample("4b");
  model.kernel = {{40.0, 3.0}, {Complex(60.0, 300.0), Complex(1.0, -2.0)}};
  const double omega = 150.0;
  Complex integral = 0.0;
  const double h = 2e-6;
  for (int i = 0; i < 400000; ++i) {
    const double t = (i + 0.5) * h;
    integral += h * kernel_value(model, t) * std::exp(Complex(0.0, -omega * t));
  }
  EXPECT_NEAR(std::abs(kernel_response(model, omega) - integral), 0.0, 1e-7);
  EXPECT_NEAR(static_kernel(model), 3.0 / 40.0 + 2.0 * (Complex(1.0, -2.0) / Complex(60.0, 300.0)).real(), 1e-14);
}

TEST(MassMaterial, FirstHarmonicOfTheDampingIsThatOfTheForce) {
  for (const double lambda : {0.0, 1.0, 1.8}) {
    double sum = 0.0;
    const int n = 100000;
    for (int i = 0; i < n; ++i) {
      const double c = std::cos(2 * std::numbers::pi * (i + 0.5) / n);
      sum += 2.0 / n * c * c * std::pow(std::abs(c), lambda);
    }
    EXPECT_NEAR(first_harmonic_factor(lambda), sum, 1e-7) << lambda;
  }
}

TEST(MassMaterial, ComplexStiffnessAddsUpItsTerms) {
  MassMaterial model = sample("7");
  const double omega = 1500.0;
  const Complex G = 3e5 / Complex(1500.0, omega);
  const double c = 70.0 * first_harmonic_factor(1.8) * std::pow(2.0, 1.8);
  const Complex K = complex_stiffness(model, omega, 0.6);
  EXPECT_NEAR(std::abs(K - (2.7e6 + Complex(0.0, omega) * (c + G))), 0.0, 1e-9 * std::abs(K));
}

TEST(MassMaterial, SettlesWhereTheForceCarriesTheWeight) {
  for (const char* name : {"1", "2", "4a", "4b", "5", "7"}) {
    SCOPED_TRACE(name);
    const MassMaterial model = sample(name);
    const auto z0 = static_settling_point(model, 9.80665);
    ASSERT_TRUE(z0);
    EXPECT_LT(*z0, 0.0);
    const double force = stiffness_force(model, *z0) + kernel_forcing(model, *z0, 0.0) * model.kernel.empty() * 0.0 +
                         (model.kernel.empty() ? 0.0 : kernel_forcing(model, *z0, 0.0) * static_kernel(model));
    EXPECT_NEAR(force, -1.12 * 9.80665, 1e-9);
  }
  EXPECT_NEAR(*static_settling_point(sample("1"), 9.80665), -1.12 * 9.80665 / 2.7e6, 1e-15);
}

TEST(MassMaterial, FallsThroughASampleTooSoft) {
  MassMaterial model = sample("1");
  model.stiffness = {1000.0, 0.0, -1e8};  // carries at most 1.2 N
  EXPECT_FALSE(static_settling_point(model, 9.80665));
  model.stiffness = {1000.0, 0.0, -1e4};
  EXPECT_TRUE(static_settling_point(model, 9.80665));
  model.forcing = KernelForcing::displacement;
  model.kernel = {{1.0, -2000.0}};  // relaxes to a negative stiffness
  EXPECT_FALSE(static_settling_point(model, 9.80665));
}

TEST(MassMaterial, ExpandedModelGivesTheSameForces) {
  const MassMaterial model = sample("2");
  const double z0 = -4e-5;
  const MassMaterial about = expanded_about(model, z0);
  for (const double z : {-1e-4, 3e-5, 2e-4})
    EXPECT_NEAR(stiffness_force(about, z), stiffness_force(model, z0 + z) - stiffness_force(model, z0), 1e-9);
}

// The report leaves the sign of beta open: with v on the left, f = z and k(z) dissipate for beta < 0 only.
TEST(MassMaterial, PassivityTellsTheSignOfBeta) {
  for (const char* name : {"4a", "4b", "5", "7"}) {
    MassMaterial model = sample(name);
    model.damping = 0.0;
    SCOPED_TRACE(name);
    EXPECT_GT(dissipative_sign(model.forcing) * model.kernel.front().beta.real(), 0.0);
    EXPECT_TRUE(passivity(model, 600.0, 3000.0, 0.3).passive);
    model.kernel.front().beta *= -1.0;
    const Passivity active = passivity(model, 600.0, 3000.0, 0.3);
    EXPECT_FALSE(active.passive);
    EXPECT_LT(active.least_damping, 0.0);
  }
  MassMaterial growing = sample("4b");
  growing.kernel.front().alpha = -10.0;
  EXPECT_FALSE(passivity(growing, 600.0, 3000.0, 0.3).passive);
}

TEST(MassMaterial, NamesWhatThereIsWhereThereIsNoSuchModel) {
  try {
    model_structure("4c");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("4a, 4b, 5"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace pfdm::this_file
