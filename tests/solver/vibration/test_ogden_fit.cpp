#include "physics/error.h"
#include "solver/vibration/simulation/ogden_fit.h"

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include <cmath>

namespace pfdm::this_file {
namespace {

constexpr double length = 0.0762, area = 4.56e-3;  // the report's cylinder

/// The polynomial k_1 z ... k_n z^n nearest to a material's force up to a displacement.
std::vector<double> polynomial_of(std::span<const OgdenTerm> terms, int n, double largest) {
  constexpr int n_points = 401;
  Eigen::MatrixXd powers(n_points, n);
  Eigen::VectorXd force(n_points);
  for (int i = 0; i < n_points; ++i) {
    const double x = 2.0 * i / (n_points - 1) - 1.0;
    for (int k = 0; k < n; ++k) powers(i, k) = std::pow(x, k + 1);
    force[i] = area * nominal_stress(terms, 1.0 + x * largest / length);
  }
  const Eigen::VectorXd scaled = powers.colPivHouseholderQr().solve(force);
  std::vector<double> k;
  k.reserve(n);
  for (int i = 0; i < n; ++i) k.push_back(scaled[i] / std::pow(largest, i + 1));
  return k;
}

TEST(OgdenFit, FindsTheMaterialOfAPolynomial) {
  const OgdenTerm truth[] = {{2e5, 1.8}, {-4e3, -14.0}};
  const double largest = 0.006;
  const OgdenFit found = fit_ogden(polynomial_of(truth, 7, largest), length, area, largest, 2);
  ASSERT_EQ(found.terms.size(), 2u);
  EXPECT_LT(found.relative_misfit, 1e-5);
  EXPECT_NEAR(shear_modulus(found.terms), shear_modulus(truth), 1e-4 * shear_modulus(truth));
  EXPECT_NEAR(found.terms[0].alpha, -14.0, 0.5);
  EXPECT_NEAR(found.terms[1].alpha, 1.8, 0.2);
  for (const double z : {-0.006, 0.002, 0.005}) {
    const double stress = nominal_stress(truth, 1.0 + z / length);
    EXPECT_NEAR(nominal_stress(found.terms, 1.0 + z / length), stress, 1e-4 * std::abs(stress));
  }
  EXPECT_EQ(found.largest_displacement, largest);
}

TEST(OgdenFit, TakesOneTermForALinearSample) {
  const std::vector<double> stiffness{54e3};
  const OgdenFit found = fit_ogden(stiffness, length, area, 1e-3, 1);
  ASSERT_EQ(found.terms.size(), 1u);
  EXPECT_NEAR(3.0 * shear_modulus(found.terms), 54e3 * length / area, 1e-3 * 54e3 * length / area);
  EXPECT_LT(found.relative_misfit, 1e-3);
}

TEST(OgdenFit, KeepsToStableMaterialsAndSaysHowFarOffTheyAre) {
  // Softer to both sides: no stable incompressible material is.
  const double k1 = 54e3;
  const std::vector<double> stiffness{k1, 0.0, -0.3 * k1 / (4e-3 * 4e-3)};
  const OgdenFit found = fit_ogden(stiffness, length, area, 4e-3, 2);
  for (const OgdenTerm& term : found.terms) EXPECT_GT(term.mu * term.alpha, 0.0);
  EXPECT_GT(found.relative_misfit, 0.02);
  EXPECT_THROW(fit_ogden(std::vector<double>{-1e3}, length, area, 1e-3, 1), InputError);
  EXPECT_THROW(fit_ogden(stiffness, length, area, 0.1, 1), InputError);
}

}  // namespace
}  // namespace pfdm::this_file
