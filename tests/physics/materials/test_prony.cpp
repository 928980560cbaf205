// Viscoelasticity by Prony series against closed forms and a fine integration of its branches.

#include "physics/error.h"
#include "physics/materials/prony.h"
#include "tests/physics/physics_checks.h"

#include <cmath>
#include <complex>
#include <memory>
#include <numbers>
#include <vector>

namespace pfdm::this_file {
namespace {

const IsotropicElasticity rubber = from_young_poisson(2e6, 0.4);
const std::vector<PronyBranch> shear_branches{{1e6, 1e-3}, {0.5e6, 0.1}, {0.3e6, 10.0}};
const std::vector<PronyBranch> bulk_branches{{2e6, 0.05}};

/// A material point whose displacement gradient goes to given values within given times.
class Point {
 public:
  explicit Point(const PronyLaw& law) : material_(make_prony(law)), history_(material_->history_size()) {
    material_->start(history_);
  }
  Tensor go_to(const Tensor& H, double duration) {
    std::vector<double> next(history_.size());
    const MaterialResponse response = material_->update({H_, H, duration, history_}, next);
    H_ = H;
    history_ = next;
    return response.stress;
  }
  MaterialEnergy energy(std::string_view split = "none") const {
    return material_->energy(H_, history_, energy_split(split));
  }
  const Material& material() const { return *material_; }

 private:
  std::shared_ptr<const Material> material_;
  Tensor H_ = Tensor::Zero();
  std::vector<double> history_;
};

Tensor shear(double gamma) {
  Tensor H = Tensor::Zero();
  H(0, 1) = gamma;
  return H;
}

Tensor dilation(double volume) { return (volume / 3.0 * Tensor::Identity()).eval(); }

// The mean of q:q over a step by Simpson's rule, also where the formula changes, and held springs of any length of
// step.
TEST(PronySquare, IsTheMeanOfASpringThatIsStrainedEvenly) {
  constexpr int parts = 10000;
  for (const double x : {0.0, 1e-4, 9.99e-3, 1.001e-2, 0.5, 3.0, 40.0}) {
    double start = 0.0, cross = 0.0, end = 0.0;
    for (int k = 0; k <= parts; ++k) {
      const double at = double(k) / parts, w = x > 0.0 ? std::expm1(-x * at) / std::expm1(-x) : at;
      const double weight = (k == 0 || k == parts ? 1.0 : k % 2 == 1 ? 4.0 : 2.0) / (3.0 * parts);
      start += weight * (1.0 - w) * (1.0 - w), cross += weight * 2.0 * w * (1.0 - w), end += weight * w * w;
    }
    const PronySquare found = square_over(x);
    EXPECT_NEAR(found.start, start, 2e-9 * start) << x;
    EXPECT_NEAR(found.cross, cross, 2e-9 * cross) << x;
    EXPECT_NEAR(found.end, end, 2e-9 * end) << x;
  }
  EXPECT_NEAR(1e12 * square_over(1e12).start, 0.5, 1e-9);
}

// A ramp of the shear gamma within T, then held: tau = mu gamma + sum mu_i gamma tau_i/T (1 - exp(-T/tau_i))
// exp(-(t-T)/tau_i), whatever the steps.
TEST(Prony, RampAndRelaxationAreExactInAnySteps) {
  constexpr double gamma = 0.02, T = 0.3;
  for (const int n : {1, 7, 1000})
    for (const double hold : {1e-4, 0.05, 3.0, 200.0}) {
      Point point({.relaxed = rubber, .shear = shear_branches});
      Tensor stress;
      for (int i = 1; i <= n; ++i) stress = point.go_to(shear(gamma * i / n), T / n);
      for (int i = 1; i <= n; ++i) stress = point.go_to(shear(gamma), hold / n);
      double expected = rubber.mu * gamma;
      for (const auto& [mu, tau] : shear_branches)
        expected += mu * gamma * tau / T * -std::expm1(-T / tau) * std::exp(-hold / tau);
      EXPECT_NEAR(stress(0, 1), expected, 1e-12 * expected) << n << " steps, held for " << hold;
      EXPECT_LE((stress - Tensor(expected * (shear(1.0) + shear(1.0).transpose()))).norm(), 1e-12 * expected);
    }
}

TEST(Prony, PressureRelaxesByTheBulkBranches) {
  constexpr double volume = 0.01, T = 0.02, hold = 0.08;
  Point point({.relaxed = rubber, .shear = shear_branches, .bulk = bulk_branches});
  point.go_to(dilation(volume), T);
  const double pressure = point.go_to(dilation(volume), hold).trace() / 3.0;
  const auto& [K, tau] = bulk_branches[0];
  const double expected =
      volume * (rubber.bulk_modulus() + K * tau / T * -std::expm1(-T / tau) * std::exp(-hold / tau));
  EXPECT_NEAR(pressure, expected, 1e-12 * expected);
}

// Steps that are short and long against every branch: instantaneous and relaxed elasticity.
TEST(Prony, LimitsOfFastAndSlowLoading) {
  const Tensor H = RandomTensors().symmetric(0.01);
  Point fast({.relaxed = rubber, .shear = shear_branches, .bulk = bulk_branches}), slow = fast;
  const IsotropicElasticity at_once = fast.material().elasticity();
  EXPECT_NEAR(at_once.mu, rubber.mu + 1.8e6, 1e-9 * at_once.mu);
  EXPECT_NEAR(at_once.bulk_modulus(), rubber.bulk_modulus() + 2e6, 1e-9 * at_once.bulk_modulus());
  const Tensor stiff = stress(at_once, symmetric_part(H)), soft = stress(rubber, symmetric_part(H));
  EXPECT_LE((fast.go_to(H, 1e-13) - stiff).norm(), 1e-9 * stiff.norm());
  slow.go_to(H, 1e-13);
  EXPECT_LE((slow.go_to(H, 1e4) - soft).norm(), 1e-12 * soft.norm());
}

// The shear gamma sin(w t) from rest: tau = gamma Im[G* exp(i w t)] less what decays, G* = mu + sum mu_i A_i with A_i =
// i w tau_i/(1 + i w tau_i). Steps are linear, the error is of second order in their length.
TEST(Prony, HarmonicMotionOverSixDecades) {
  constexpr double gamma = 0.01;
  for (const double w : {1e-2, 1e-1, 1.0, 1e1, 1e2, 1e3, 1e4}) {
    double error[2] = {0.0, 0.0};
    for (const int k : {0, 1}) {
      const int n = 200 << k;
      Point point({.relaxed = rubber, .shear = shear_branches});
      const double dt = 2.0 * std::numbers::pi / w / n;
      for (int i = 1; i <= 2 * n; ++i) {
        const double t = i * dt, found = point.go_to(shear(gamma * std::sin(w * t)), dt)(0, 1);
        double expected = rubber.mu * gamma * std::sin(w * t);
        for (const auto& [mu, tau] : shear_branches) {
          const std::complex<double> A = std::complex(0.0, w * tau) / std::complex(1.0, w * tau);
          expected += mu * gamma * ((A * std::polar(1.0, w * t)).imag() - A.imag() * std::exp(-t / tau));
        }
        error[k] = std::max(error[k], std::abs(found - expected) / (rubber.mu * gamma));
      }
    }
    EXPECT_LE(error[1], 5e-5) << w << " rad/s";
    EXPECT_LE(error[1], 0.32 * error[0] + 1e-12) << w << " rad/s";
  }
}

// Heat of a step as the integral of the branches' dashpots, by Simpson's rule in s, t = T s^3.
TEST(Prony, HeatIsThatOfTheDashpots) {
  constexpr double gamma = 0.02;
  for (const double T : {1e-5, 1e-2, 1.0, 300.0}) {
    Point point({.relaxed = rubber, .shear = shear_branches});
    point.go_to(shear(gamma), 1e-2);
    const double before = point.energy().dissipated;
    point.go_to(shear(-0.5 * gamma), T);
    double expected = 0.0;
    for (const auto& [mu, tau] : shear_branches) {
      const double q_0 = gamma * tau / 1e-2 * -std::expm1(-1e-2 / tau), rate = -1.5 * gamma / T;
      constexpr int n = 20000;
      for (int i = 0; i <= n; ++i) {
        const double at = static_cast<double>(i) / n, t = T * at * at * at;
        const double q = q_0 * std::exp(-t / tau) - rate * tau * std::expm1(-t / tau);
        expected += (i == 0 || i == n ? 1.0 : (i % 2 == 1 ? 4.0 : 2.0)) * T * at * at / n * mu * q * q / tau;
      }
    }
    EXPECT_NEAR(point.energy().dissipated - before, expected, 1e-6 * expected + 1e-14 * before) << T << " s";
  }
}

TEST(Prony, DamageIsDrivenByTheRelaxedElasticityOrByAllThatIsStored) {
  const Tensor H = RandomTensors().symmetric(0.01);
  PronyLaw law{.relaxed = rubber, .shear = shear_branches};
  Point relaxed(law);
  law.drive = PronyDrive::stored;
  Point stored(law);
  relaxed.go_to(H, 0.01), stored.go_to(H, 0.01);
  for (const char* split : {"none", "volumetric_deviatoric"}) {
    const double expected = energy_split(split).energy(rubber, symmetric_part(H)).psi_plus;
    EXPECT_NEAR(relaxed.energy(split).driving, expected, 1e-12 * expected);
    EXPECT_GT(stored.energy(split).driving, 1.1 * expected);
    EXPECT_NEAR(relaxed.energy(split).driving + relaxed.energy(split).idle, stored.energy(split).driving,
                1e-12 * expected);
    EXPECT_EQ(stored.energy(split).idle, 0.0);
  }
}

TEST(Prony, RefusesWhatIsNoSeries) {
  EXPECT_THROW(make_prony({.relaxed = rubber}), InputError);
  EXPECT_THROW(make_prony({.relaxed = rubber, .shear = {{1e6, 0.0}}}), InputError);
  EXPECT_THROW(make_prony({.relaxed = rubber, .shear = {{-1e6, 1.0}}}), InputError);
  EXPECT_THROW(make_prony({.relaxed = rubber, .bulk = {{1e6, std::nan("")}}}), InputError);
}

}  // namespace
}  // namespace pfdm::this_file
