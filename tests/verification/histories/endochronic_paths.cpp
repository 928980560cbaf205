// The endochronic law under mixed control against closed forms (physics/closed_forms/endochronic.h), an independent
// integration of the continuous law, and a kinematic hardening model written another way.

#include "physics/closed_forms/endochronic.h"
#include "tests/physics/endochronic_laws.h"
#include "tests/solver/loadings.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace pfdm::this_file {
namespace {

constexpr double pi = std::numbers::pi;

/// Strain of the tension test as a function of the plastic strain.
Path total_strain(const EndochronicLaw& law, const Path& sigma) {
  return [E = law.elasticity.young_modulus(), sigma](double plastic) { return sigma(plastic) / E + plastic; };
}

HistoryResult run(const EndochronicLaw& law, const LoadSegment& segment) {
  HistoryResult result = run_history(law, {segment});
  EXPECT_TRUE(result.converged) << result.failure;
  return result;
}

TEST(EndochronicPaths, T1TensionAtAnyStep) {
  const EndochronicLaw law = one_term_law();
  const Path sigma = [&](double p) { return endochronic_tension(law.kernel[0], 1.0, p); };
  double largest = 0.0;
  for (const int n : {1, 2, 10, 1000})
    for (const HistoryPoint& point : run(law, tension_path(total_strain(law, sigma), n, 0.01)).points)
      if (point.time > 0.0) largest = std::max(largest, std::abs(point.stress[0] / sigma(point.time) - 1.0));
  fmt::print("tension: {:.2g}\n", largest);
  EXPECT_LE(largest, 1e-11);
}

TEST(EndochronicPaths, T1AtGivenTotalStrains) {
  // Independent values, from the closed form solved for the total strain.
  const HistoryResult result = run(one_term_law(), tension_path([](double t) { return t; }, 10, 0.01));
  EXPECT_NEAR(result.points[1].stress[0], 43.6483571445e6, 43.6e-5);
  EXPECT_NEAR(result.points[2].stress[0], 72.7670061864e6, 72.7e-5);
  EXPECT_NEAR(result.points[5].stress[0], 101.931455836e6, 101.9e-5);
  EXPECT_NEAR(result.points[10].stress[0], 104.935303059e6, 104.9e-5);
  EXPECT_NEAR(result.points[10].state.strain[1], -0.00485649873086, 1e-13);
}

TEST(EndochronicPaths, T2LinearKinematicHardening) {
  EndochronicLaw law = one_term_law();
  law.kernel = {{2e9, 0.0}};
  const double E = law.elasticity.young_modulus();
  const double tangent = E * 6e9 / (E + 6e9);
  for (const HistoryPoint& point : run(law, tension_path([](double t) { return 0.01 * std::sin(7.0 * t); }, 37)).points)
    EXPECT_NEAR(point.stress[0], tangent * point.state.strain[0], 1e-11 * tangent * 0.01);
}

TEST(EndochronicPaths, T3Torsion) {
  const EndochronicLaw law = one_term_law();
  const double mu = law.elasticity.mu;
  for (const int n : {1, 7, 200}) {
    const auto tau = [&](double gamma_p) { return endochronic_shear(law.kernel[0], 1.0, gamma_p); };
    const auto half_gamma = [&](double gamma_p) { return 0.5 * (tau(gamma_p) / mu + gamma_p); };
    for (const HistoryPoint& point : run(law, strain_paths({Path(), {}, {}, {}, {}, Path(half_gamma)}, n, 0.02)).points)
      EXPECT_NEAR(to_tensor(point.stress)(0, 1), tau(point.time), 1e-11 * tau(0.02));
  }
}

TEST(EndochronicPaths, T4CyclicSteadyState) {
  const EndochronicLaw law = one_term_law();
  const double peak = endochronic_cyclic_peak(law.kernel[0], 0.003);
  const double strain = peak / law.elasticity.young_modulus() + 0.003;
  const Path triangle = [&](double t) {  // peaks at t = 1, 3, 5 ...
    const double phase = 0.25 * (t + 1.0);
    return strain * (1.0 - std::abs(4.0 * (phase - std::floor(phase)) - 2.0));
  };
  for (const std::size_t per_quarter : {1, 16}) {
    const HistoryResult result = run(law, tension_path(triangle, static_cast<int>(79 * per_quarter), 79.0));
    EXPECT_NEAR(result.points[77 * per_quarter].stress[0], peak, 1e-11 * peak);
    EXPECT_NEAR(result.points[79 * per_quarter].stress[0], -peak, 1e-11 * peak);
  }
}

TEST(EndochronicPaths, T5LinearHardeningAndTheOrderOfBeta) {
  EndochronicLaw law = one_term_law();
  const double b = 30.0;
  law.hardening.with_path = make_factor(hardening_law("linear"), {b, 1.0});
  const Path sigma = [&](double p) { return endochronic_tension_linear_hardening(law.kernel[0], b, p); };
  for (const double beta : {0.0, 0.5, 1.0}) {
    law.beta = beta;
    const auto error = [&](int n) {
      double largest = 0.0;
      for (const HistoryPoint& point : run(law, tension_path(total_strain(law, sigma), n, 0.05)).points)
        largest = std::max(largest, std::abs(point.stress[0] - sigma(point.time)) / sigma(0.05));
      return largest;
    };
    const double order = std::log2(error(640) / error(1280));
    fmt::print("beta = {}: error {:.2g} at 1280 steps, order {:.3f}\n", beta, error(1280), order);
    EXPECT_NEAR(order, beta == 0.5 ? 2.0 : 1.0, 0.05);
  }
}

TEST(EndochronicPaths, T6ConstantPlasticRate) {
  EndochronicLaw law = one_term_law();
  law.hardening.with_rate = logarithmic_rate(0.1, 1e-4);
  const double expected[] = {106.168856e6, 131.957187e6, 178.433285e6};
  for (int i = 0; i < 3; ++i) {
    const double rate = std::pow(10.0, -5 + 2 * i);  // of the plastic strain [1/s]
    const double f = 1.0 + 0.1 * std::log1p(std::sqrt(1.5) * rate / 1e-4);
    const double end = 0.01 / rate;
    const auto plastic = [&](double t) { return rate * t; };
    const Path sigma = [&](double t) { return endochronic_tension(law.kernel[0], f, plastic(t)); };
    const Path strain = [&](double t) { return sigma(t) / law.elasticity.young_modulus() + plastic(t); };
    for (const int n : {1, 10, 100})
      for (const HistoryPoint& point : run(law, tension_path(strain, n, end)).points)
        EXPECT_NEAR(point.stress[0], sigma(point.time), 1e-11 * sigma(end));
    EXPECT_NEAR(sigma(end), expected[i], 1.0);
  }
}

// Half the way between two rates, in ln, f = f_0 + b zeta is the mean of the rows. At a constant plastic rate
// sigma = sqrt(6) C/(alpha + b) (F - f_0 (F/f_0)^(-alpha/b)), F = f_0 + b sqrt(3/2) eps_p (T5 with f_0).
TEST(EndochronicPaths, TableOfPathAndRateAtAConstantRate) {
  EndochronicLaw law = one_term_law();
  const double rate = 1e-3, zeta_rate = std::sqrt(1.5) * rate;
  law.hardening.with_path =
      make_factor(hardening_law("table_with_rate"),
                  rate_table_parameters({0.0, 1.0}, {zeta_rate / 7.0, 7.0 * zeta_rate}, {1.0, 21.0, 1.4, 41.4}));
  const double C = law.kernel[0].C, alpha = law.kernel[0].alpha, f_0 = 1.2, b = 30.0;
  const Path sigma = [&](double t) {
    const double F = f_0 + b * zeta_rate * t;
    return std::sqrt(6.0) * C / (alpha + b) * (F - f_0 * std::pow(F / f_0, -alpha / b));
  };
  const Path strain = [&](double t) { return sigma(t) / law.elasticity.young_modulus() + rate * t; };
  const auto error = [&](int n) {
    double largest = 0.0;
    for (const HistoryPoint& point : run(law, tension_path(strain, n, 20.0)).points)
      largest = std::max(largest, std::abs(point.stress[0] - sigma(point.time)) / sigma(20.0));
    return largest;
  };
  const double order = std::log2(error(640) / error(1280));
  fmt::print("table of path and rate: error {:.2g} at 1280 steps, order {:.3f}\n", error(1280), order);
  EXPECT_NEAR(order, 2.0, 0.05);
  EXPECT_LT(error(1280), 1e-6);
}

// Rates that jump, and turn: strain rates of 1e-4, 1e-2, 1e-5, -1e-3 and 0.1 /s. Stress and zeta from the rate form of
// the law, E (eps' - p') = sum 3 C_r p' - alpha_r sigma_r zeta'/f(zeta, zeta'), zeta' = sqrt(3/2) |p'|, solved for p'
// by bisection and integrated with scipy's DOP853 at a tolerance of 1e-11.
TEST(EndochronicPaths, RateJumpsUnderATableOfPathAndRate) {
  struct At {
    double strain, sigma, zeta;
  };
  constexpr At expected[] = {{0.004, 1.2938851623e+08, 0.0035445528},
                             {0.008, 1.7581228886e+08, 0.0079575727},
                             {0.012, 1.6581646506e+08, 0.0129611875},
                             {-0.002, -1.9433095053e+08, 0.0263376268},
                             {0.004, 1.4337980255e+08, 0.0301509720}};
  constexpr double rates[] = {1e-4, 1e-2, 1e-5, -1e-3, 0.1};
  EndochronicLaw law = one_term_law();
  law.kernel = {{60e9, 3000.0}, {15e9, 500.0}};
  law.hardening.with_path = make_factor(
      hardening_law("table_with_rate"),
      rate_table_parameters({0.0, 0.004, 0.02}, {1e-5, 1e-3, 1e-1}, {1.0, 1.2, 1.5, 1.1, 1.4, 1.6, 1.3, 1.5, 2.0}));
  const auto error = [&](int n) {
    std::vector<LoadSegment> segments;
    double from = 0.0;
    for (std::size_t i = 0; i < std::size(rates); from = expected[i++].strain)
      segments.push_back(tension_path([=, rate = rates[i]](double t) { return from + rate * t; }, n,
                                      (expected[i].strain - from) / rates[i]));
    const HistoryResult result = run_history(law, segments);
    EXPECT_TRUE(result.converged) << result.failure;
    double largest = 0.0;
    for (std::size_t i = 0; i < std::size(rates); ++i) {
      const HistoryPoint& point = result.points[(i + 1) * static_cast<std::size_t>(n)];
      largest = std::max(largest, std::abs(point.stress[0] - expected[i].sigma) / 1.9e8);
      largest = std::max(largest, std::abs(point.state.zeta - expected[i].zeta) / 0.03);
    }
    return largest;
  };
  fmt::print("rate jumps: error {:.2g}, {:.2g}, {:.2g} at 100, 400, 1600 steps\n", error(100), error(400), error(1600));
  EXPECT_LT(error(1600), 1e-7);
  EXPECT_LT(error(1600), 0.08 * error(400));  // second order: 1/16
}

struct Reference {
  double time, sigma, tau, zeta;
};
// eps_xx = 0.004 sin(2 pi t), gamma_xy = sqrt(3) 0.004 (1 - cos(2 pi t)), 90 degrees out of phase; sigma_xx, tau_xy and
// zeta from the rate form of the law (d sigma_r = 3 C_r d eps_p - alpha_r sigma_r dz and likewise in shear), integrated
// with scipy's DOP853 at a tolerance of 1e-13.
constexpr Reference out_of_phase[] = {{0.125, 1.0416624309e+08, 3.1960850326e+07, 0.002584294009},
                                      {0.250, 7.5051198441e+07, 7.4941108609e+07, 0.005921976661},
                                      {0.375, -1.2425355996e+07, 9.1755784374e+07, 0.009232683552},
                                      {0.500, -1.0371213557e+08, 6.5847361082e+07, 0.012435123765},
                                      {0.625, -1.4019497019e+08, 7.6492720262e+06, 0.015638649931},
                                      {0.750, -9.7380614374e+07, -4.9305871208e+07, 0.018880341719},
                                      {0.875, 1.8007305169e+06, -7.2963433643e+07, 0.022065742096},
                                      {1.000, 1.0323640145e+08, -4.8174194956e+07, 0.025172059110},
                                      {1.125, 1.4514669095e+08, 1.2343473496e+07, 0.028312698957},
                                      {1.250, 1.0208189280e+08, 7.2089760065e+07, 0.031518449136},
                                      {1.375, -1.1260344176e+06, 9.7096744193e+07, 0.034675674276},
                                      {1.500, -1.0793749368e+08, 7.1461157878e+07, 0.037744797370},
                                      {1.625, -1.5370301644e+08, 7.8863149512e+06, 0.040837612669},
                                      {1.750, -1.1069414755e+08, -5.5701346674e+07, 0.043992805249},
                                      {1.875, -4.1353840069e+06, -8.3469025167e+07, 0.047100978908},
                                      {2.000, 1.0725050266e+08, -5.8520465745e+07, 0.050125038546}};

double out_of_phase_error(int per_cycle) {
  EndochronicLaw law = one_term_law();
  law.kernel = {{60e9, 3000.0}, {15e9, 500.0}, {2e9, 30.0}, {0.5e9, 0.0}};
  law.hardening.with_path = saturating(1.6, 20.0);
  const Path axial = [](double t) { return 0.004 * std::sin(2.0 * pi * t); };
  const Path shear = [](double t) { return 0.5 * std::sqrt(3.0) * 0.004 * (1.0 - std::cos(2.0 * pi * t)); };
  const HistoryResult result = run(law, strain_paths({axial, {}, {}, {}, {}, shear}, 2 * per_cycle, 2.0));
  double largest = 0.0;
  for (std::size_t i = 0; i < std::size(out_of_phase); ++i) {
    const HistoryPoint& point = result.points[(i + 1) * static_cast<std::size_t>(per_cycle) / 8];
    largest = std::max({largest, std::abs(point.stress[0] - out_of_phase[i].sigma),
                        std::abs(to_tensor(point.stress)(0, 1) - out_of_phase[i].tau)});
    EXPECT_NEAR(point.state.zeta, out_of_phase[i].zeta, 20.0 / (per_cycle * per_cycle));
  }
  return largest / 1.54e+08;
}

TEST(EndochronicPaths, OutOfPhaseAgainstAnIndependentIntegration) {
  double last = 0.0;
  for (const int n : {200, 400, 800}) {
    const double error = out_of_phase_error(n);
    fmt::print("{} steps a cycle: {:.3g}, order {:.3f}\n", n, error, std::log2(last / error));
    if (n == 400) {
      EXPECT_LE(error, 1e-4);
    }
    if (n >= 400) {
      EXPECT_NEAR(std::log2(last / error), 2.0, 0.05);
    }
    last = error;
  }
}

// Armstrong, Frederick (1966) with a yield surface of radius zero: s = X, dX = (2/3) C d eps_p - gamma X dp, with
// C = 3 C_1 and gamma = alpha_1 sqrt(3/2). Classical Runge-Kutta on tensors, in plain arrays of the rates.
class ArmstrongFrederick {
 public:
  ArmstrongFrederick(double mu, double C, double gamma) : mu_(mu), C_(C), gamma_(gamma) {}

  Tensor X = Tensor::Zero();

  void step(const Tensor& de) {
    const Tensor k1 = rate(X, de), k2 = rate(X + 0.5 * k1, de), k3 = rate(X + 0.5 * k2, de), k4 = rate(X + k3, de);
    X += (k1 + 2.0 * k2 + 2.0 * k3 + k4) / 6.0;
  }

 private:
  /// s = 2 mu (e - eps_p) = X: 2 mu (de - de_p) = (2/3) C de_p - gamma X dp, dp = sqrt(2/3) |de_p|.
  Tensor rate(const Tensor& back, const Tensor& de) const {
    double low = 0.0, high = 10.0 * std::sqrt(2.0 / 3.0) * de.norm();
    const auto plastic = [&](double dp) {
      return Tensor((2.0 * mu_ * de + gamma_ * dp * back) / (2.0 * mu_ + 2.0 / 3.0 * C_));
    };
    for (int i = 0; i < 60; ++i) {
      const double dp = 0.5 * (low + high);
      (std::sqrt(2.0 / 3.0) * plastic(dp).norm() > dp ? low : high) = dp;
    }
    const double dp = 0.5 * (low + high);
    return 2.0 / 3.0 * C_ * plastic(dp) - gamma_ * dp * back;
  }
  double mu_, C_, gamma_;
};

TEST(EndochronicPaths, OneTermIsArmstrongFrederickWithoutYieldSurface) {
  const EndochronicLaw law = one_term_law();
  const auto strain_at = [](double t) {
    return deviator(Mandel{0.004 * std::sin(t), 0.0, 0.0, 0.0, 0.002 * std::sin(2.0 * t), 0.003 * (1.0 - std::cos(t))});
  };
  const auto error = [&](int n) {
    ArmstrongFrederick other(law.elasticity.mu, 3.0 * law.kernel[0].C, law.kernel[0].alpha * std::sqrt(1.5));
    EndochronicState state = virgin_state(law);
    double largest = 0.0;
    for (int i = 0; i < n; ++i) {
      const Mandel change = strain_at(4.0 * (i + 1) / n) - strain_at(4.0 * i / n);
      other.step(to_tensor(change));
      state = update(law, state, change, 1.0).state;
      largest = std::max(largest, (to_tensor(stress(law, state)) - other.X).norm() / 1e8);
    }
    return largest;
  };
  const double coarse = error(10000), fine = error(40000);
  fmt::print("against Armstrong-Frederick: {:.2g} at 10000 steps, {:.2g} at 40000\n", coarse, fine);
  EXPECT_LE(coarse, 2e-8);
  EXPECT_LE(fine, 2e-9);
  EXPECT_GE(coarse / fine, 12.0);  // what is left is the step's error, of second order
}

}  // namespace
}  // namespace pfdm::this_file
