#include "physics/random_field.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pfdm::this_file {
namespace {

// Mean over many fields of products of values at two places.
double covariance(const Vector& a, const Vector& b) {
  constexpr int n = 4000;
  double sum = 0.0;
  for (int seed = 1; seed <= n; ++seed) {
    const RandomField field(static_cast<std::uint64_t>(seed), 2e-3);
    sum += field.at(a) * field.at(b) / n;
  }
  return sum;
}

TEST(RandomField, HasItsCovariance) {
  const Vector here(1e-3, 0.5e-3, 0.0);
  EXPECT_NEAR(covariance(here, here), 1.0, 0.08);
  for (const double r : {1e-3, 2e-3, 5e-3})
    EXPECT_NEAR(covariance(here, here + r * Vector(0.6, 0.0, 0.8)), std::exp(-0.5 * r * r / 4e-6), 0.06) << r;
}

TEST(RandomField, IsThatOfItsSeed) {
  const Vector x(0.1, 0.2, 0.3);
  EXPECT_EQ(RandomField(7, 0.5).at(x), RandomField(7, 0.5).at(x));
  EXPECT_NE(RandomField(7, 0.5).at(x), RandomField(8, 0.5).at(x));
}

}  // namespace
}  // namespace pfdm::this_file
