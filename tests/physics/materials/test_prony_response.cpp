// Responses of Prony series against closed forms, a fine integration of the branches, and the material of the field
// solver.

#include "physics/materials/prony_response.h"
#include "tests/physics/physics_checks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <vector>

namespace pfdm::this_file {
namespace {

const PronyLaw rubber{.relaxed = from_young_poisson(2e6, 0.4),
                      .shear = {{1e6, 1e-3}, {0.5e6, 0.1}, {0.3e6, 10.0}},
                      .bulk = {{2e6, 0.05}}};

// A ramp of the shear strain gamma within T, then held: mu gamma + sum mu_i gamma tau_i/T (1 - exp(-T/tau_i))
// exp(-(t-T)/tau_i); during the ramp rate (mu t + sum mu_i tau_i (1 - exp(-t/tau_i))).
TEST(PronyResponse, RampAndRelaxationInShearAreExact) {
  constexpr double gamma = 0.02, T = 0.3;
  const std::vector<double> times{0.0, 0.01, 0.07, T, 0.31, 1.0, 30.0, 1e4};
  std::vector<double> strains;
  for (const double t : times) strains.push_back(gamma * std::min(t / T, 1.0));
  const std::vector<double> found = stress_response(modulus_in(rubber, Deformation::shear), times, strains);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double t = times[i];
    double expected = rubber.relaxed.mu * strains[i];
    for (const auto& [mu, tau] : rubber.shear)
      expected += mu * gamma * tau / T * -std::expm1(-std::min(t, T) / tau) * std::exp(-std::max(t - T, 0.0) / tau);
    EXPECT_NEAR(found[i], expected, 1e-12 * expected) << t << " s";
  }
}

// One shear branch and an elastic bulk modulus: the compliance 1/(3 mu(s)) + 1/(9 K) by hand. mu(s) = mu + mu_1 s/(s +
// r) has the zero s = -r mu/(mu + mu_1), so that J = 1/(mu + mu_1) + (1/mu - 1/(mu + mu_1)) (1 - exp(-t/lambda)) with
// lambda = tau (mu + mu_1)/mu. The rest of E: with D_0 = J_0/3 + 1/(9 K) and D_1 the retarded part the one root of
// D_0 + D_1/(1 + s lambda) is s = -(1 + D_1/D_0)/lambda, E_inf = 1/(D_0 + D_1), E_0 = 1/D_0.
TEST(PronyResponse, TensionOfOneBranchIsTheOneOfItsCompliance) {
  constexpr double mu = 0.7e6, mu_1 = 2e6, tau = 0.4, K = 5e6;
  const PronyLaw law{.relaxed = {.lambda = K - 2.0 * mu / 3.0, .mu = mu}, .shear = {{mu_1, tau}}};
  const double lambda = tau * (mu + mu_1) / mu;
  const double D_0 = 1.0 / (3.0 * (mu + mu_1)) + 1.0 / (9.0 * K), D_1 = (1.0 / mu - 1.0 / (mu + mu_1)) / 3.0;
  const RelaxationModulus E = young_modulus(law);
  ASSERT_EQ(E.branches.size(), 1u);
  EXPECT_NEAR(E.relaxed, 1.0 / (D_0 + D_1), 1e-12 * E.relaxed);
  EXPECT_NEAR(E.branches[0].time, lambda * D_0 / (D_0 + D_1), 1e-12 * lambda);
  EXPECT_NEAR(E.branches[0].modulus, 1.0 / D_0 - 1.0 / (D_0 + D_1), 1e-12 * E.relaxed);
  // Creep under a stress that rises within T: D_0 sigma + D_1 (sigma - rate lambda (1 - exp(-t/lambda))).
  const double rate = 1e4;
  const std::vector<double> times{0.0, 0.2, 3.0}, stresses{0.0, 0.2 * rate, 3.0 * rate};
  const std::vector<double> strains = strain_response(creep_compliance(E), times, stresses);
  for (const std::size_t i : {1u, 2u}) {
    const double t = times[i];
    const double expected = D_0 * rate * t + D_1 * rate * (t + lambda * std::expm1(-t / lambda));
    EXPECT_NEAR(strains[i], expected, 1e-12 * expected);
  }
}

// E* = 9 K* mu*/(3 K* + mu*) with mu* and K* by their branches.
TEST(PronyResponse, ComplexModuliOverSixDecades) {
  const RelaxationModulus shear = modulus_in(rubber, Deformation::shear), E = modulus_in(rubber, Deformation::tension);
  for (const double w : {1e-2, 1e-1, 1.0, 1e1, 1e2, 1e3, 1e4}) {
    const auto sum = [w](double relaxed, const std::vector<PronyBranch>& branches) {
      std::complex<double> total = relaxed;
      for (const auto& [modulus, tau] : branches)
        total += modulus * std::complex(0.0, w * tau) / std::complex(1.0, w * tau);
      return total;
    };
    const auto mu = sum(rubber.relaxed.mu, rubber.shear), K = sum(rubber.relaxed.bulk_modulus(), rubber.bulk);
    const auto expected = 9.0 * K * mu / (3.0 * K + mu);
    for (const auto& [found, due] :
         {std::pair(complex_modulus(shear, w), mu), std::pair(complex_modulus(E, w), expected)}) {
      EXPECT_NEAR(found.real(), due.real(), 1e-10 * due.real()) << w << " rad/s";
      EXPECT_NEAR(found.imag(), due.imag(), 1e-10 * due.imag()) << w << " rad/s";
    }
  }
}

/// Axial stress of a bar whose strain goes on at one rate, by the classical Runge-Kutta method: shear and bulk branches
/// of springs and dashpots, the transverse strain so that the transverse stress is zero.
class Bar {
 public:
  explicit Bar(const PronyLaw& law) : law_(law), state_(law.shear.size() + law.bulk.size(), 0.0) {}
  void strain(double rate, double duration, int steps) {
    const double h = duration / steps;
    for (int i = 0; i < steps; ++i, axial_ += rate * h) {
      const auto k_1 = slopes(state_, axial_), k_2 = slopes(moved(k_1, 0.5 * h), axial_ + 0.5 * rate * h);
      const auto k_3 = slopes(moved(k_2, 0.5 * h), axial_ + 0.5 * rate * h);
      const auto k_4 = slopes(moved(k_3, h), axial_ + rate * h);
      for (std::size_t j = 0; j < state_.size(); ++j)
        state_[j] += h / 6.0 * (k_1[j] + 2.0 * k_2[j] + 2.0 * k_3[j] + k_4[j]);
    }
  }
  double stress() const { return stresses(state_, axial_).first; }

 private:
  // The viscous strains: of a shear branch the axial deviator's (the transverse one is minus half of it), of a bulk
  // branch the volume's.
  std::vector<double> moved(const std::vector<double>& slope, double h) const {
    std::vector<double> next = state_;
    for (std::size_t j = 0; j < next.size(); ++j) next[j] += h * slope[j];
    return next;
  }
  /// Axial stress and transverse strain: s_t + p = 0 is linear in the transverse strain.
  std::pair<double, double> stresses(const std::vector<double>& x, double axial) const {
    double mu_0 = law_.relaxed.mu, K_0 = law_.relaxed.bulk_modulus(), s_v = 0.0, p_v = 0.0;
    for (std::size_t i = 0; i < law_.shear.size(); ++i)
      mu_0 += law_.shear[i].modulus, s_v += 2.0 * law_.shear[i].modulus * x[i];
    for (std::size_t j = 0; j < law_.bulk.size(); ++j)
      K_0 += law_.bulk[j].modulus, p_v += law_.bulk[j].modulus * x[law_.shear.size() + j];
    // s_t = -s_a/2, s_a = 2 mu_0 (2/3) (axial - t) - s_v, p = K_0 (axial + 2 t) - p_v.
    const double t = (2.0 * mu_0 / 3.0 * axial - 0.5 * s_v - K_0 * axial + p_v) / (2.0 * K_0 + 2.0 * mu_0 / 3.0);
    return {4.0 * mu_0 / 3.0 * (axial - t) - s_v + K_0 * (axial + 2.0 * t) - p_v, t};
  }
  std::vector<double> slopes(const std::vector<double>& x, double axial) const {
    const double t = stresses(x, axial).second;
    std::vector<double> slope(x.size());
    for (std::size_t i = 0; i < law_.shear.size(); ++i)
      slope[i] = (2.0 / 3.0 * (axial - t) - x[i]) / law_.shear[i].time;
    for (std::size_t j = 0; j < law_.bulk.size(); ++j) {
      const std::size_t k = law_.shear.size() + j;
      slope[k] = (axial + 2.0 * t - x[k]) / law_.bulk[j].time;
    }
    return slope;
  }

  PronyLaw law_;
  std::vector<double> state_;
  double axial_ = 0.0;
};

TEST(PronyResponse, TensionIsThatOfAFineIntegration) {
  const std::vector<double> times{0.0, 0.5, 2.0, 2.5}, strains{0.0, 0.03, 0.03, -0.01};
  const std::vector<double> found = stress_response(modulus_in(rubber, Deformation::tension), times, strains);
  Bar bar(rubber);
  for (std::size_t i = 1; i < times.size(); ++i) {
    const double duration = times[i] - times[i - 1];
    bar.strain((strains[i] - strains[i - 1]) / duration, duration, 20000);
    EXPECT_NEAR(found[i], bar.stress(), 1e-9 * std::abs(bar.stress())) << times[i] << " s";
  }
}

// Also with branches that hardly count and times that lie close together.
TEST(PronyResponse, ModulusAndComplianceAreEachOthersInverse) {
  for (const auto& branches : std::vector<std::vector<PronyBranch>>{
           {{1e6, 1.0}}, {{1e6, 1e-3}, {1.0, 1.0}, {3e8, 1e3}}, {{1e6, 1.0}, {2e6, 1.0001}, {1e5, 50.0}}}) {
    const RelaxationModulus modulus{.relaxed = 1e5, .branches = branches};
    const CreepCompliance compliance = creep_compliance(modulus);
    const RelaxationModulus again = relaxation_modulus(compliance);
    ASSERT_EQ(again.branches.size(), branches.size());
    EXPECT_NEAR(again.relaxed, 1e5, 1e-6);
    for (const double w : {1e-5, 1e-3, 0.1, 1.0, 10.0, 1e4}) {
      std::complex<double> J = compliance.instantaneous;
      for (const auto& [J_k, lambda] : compliance.retardations) J += J_k / std::complex(1.0, w * lambda);
      const auto M = complex_modulus(modulus, w);
      EXPECT_LE(std::abs(J * M - 1.0), 1e-10) << w << " rad/s";
      EXPECT_LE(std::abs(complex_modulus(again, w) - M), 1e-10 * std::abs(M)) << w << " rad/s";
    }
  }
}

TEST(PronyResponse, BranchesOfOneTimeAreOne) {
  const CreepCompliance compliance = creep_compliance({.relaxed = 1.0, .branches = {{2.0, 3.0}, {1.0, 3.0}}});
  ASSERT_EQ(compliance.retardations.size(), 1u);
  EXPECT_NEAR(compliance.retardations[0].time, 3.0 * 4.0, 1e-12);
  EXPECT_NEAR(compliance.retardations[0].compliance, 1.0 - 0.25, 1e-14);
}

/// The material of the field solver at a point.
class Point {
 public:
  explicit Point(const PronyLaw& law) : material_(make_prony(law)), history_(material_->history_size()) {
    material_->start(history_);
  }
  Tensor stress_after(const Tensor& H, double duration) const {
    std::vector<double> next(history_.size());
    return material_->update({H_, H, duration, history_}, next).stress;
  }
  void go_to(const Tensor& H, double duration) {
    std::vector<double> next(history_.size());
    material_->update({H_, H, duration, history_}, next);
    H_ = H, history_ = next;
  }
  const Tensor& H() const { return H_; }

 private:
  std::shared_ptr<const Material> material_;
  Tensor H_ = Tensor::Zero();
  std::vector<double> history_;
};

/// The displacement gradient of a bar: axial, and the transverse one that leaves no transverse stress (linear).
Tensor free_sides(const Point& point, double axial, double duration) {
  const auto gradient = [axial](double t) -> Tensor {
    return Eigen::Vector3d(axial, t, t).asDiagonal().toDenseMatrix();
  };
  const double at_0 = point.stress_after(gradient(0.0), duration)(1, 1);
  const double at_1 = point.stress_after(gradient(1e-2), duration)(1, 1);
  return gradient(-1e-2 * at_0 / (at_1 - at_0));
}

// In shear the same in each step, to rounding. In tension the field solver's transverse strain is linear in a step: it
// comes to the closed response with the second order of the steps.
TEST(PronyResponse, TheMaterialOfTheFieldSolverGivesTheSame) {
  const std::vector<double> times{0.0, 0.1, 0.2, 0.9}, strains{0.0, 0.02, 0.02, -0.01};
  const std::vector<double> shear = stress_response(modulus_in(rubber, Deformation::shear), times, strains);
  Point sheared(rubber);
  for (std::size_t i = 1; i < times.size(); ++i) {
    Tensor H = Tensor::Zero();
    H(0, 1) = strains[i];
    const double duration = times[i] - times[i - 1];
    EXPECT_NEAR(sheared.stress_after(H, duration)(0, 1), shear[i], 1e-12 * std::abs(shear[i]));
    sheared.go_to(H, duration);
  }
  const std::vector<double> tension = stress_response(modulus_in(rubber, Deformation::tension), times, strains);
  double error[2] = {0.0, 0.0};
  for (const int k : {0, 1}) {
    const int n = 2000 << k;
    Point bar(rubber);
    for (std::size_t i = 1; i < times.size(); ++i) {
      double stress = 0.0;
      for (int j = 1; j <= n; ++j) {
        const double duration = (times[i] - times[i - 1]) / n;
        const Tensor H = free_sides(bar, strains[i - 1] + (strains[i] - strains[i - 1]) * j / n, duration);
        stress = bar.stress_after(H, duration)(0, 0);
        bar.go_to(H, duration);
      }
      error[k] = std::max(error[k], std::abs(stress / tension[i] - 1.0));
    }
  }
  EXPECT_LE(error[1], 1e-6);
  EXPECT_LE(error[1], 0.3 * error[0] + 1e-11);
}

}  // namespace
}  // namespace pfdm::this_file
