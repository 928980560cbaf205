#include "physics/interfaces/traction_separation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pfdm::this_file {
namespace {

constexpr double strength = 3e6, energy = 120.0;  // [Pa], [J/m^2]

class TractionSeparation : public testing::TestWithParam<TractionSeparationLaw> {
 protected:
  std::vector<double> shape() const {
    std::vector<double> values;
    for (const ShapeParameter& p : GetParam().shape) values.push_back(p.first);
    return values;
  }
  double traction(double separation) const {
    return GetParam().traction(GetParam(), separation, strength, energy, shape());
  }
};

TEST_P(TractionSeparation, HasItsStrengthAndItsEnergy) {
  // In separations over energy / strength; the tail of the hyperbolic law beyond 400 of them holds a 400th of it.
  constexpr int n = 200000;
  constexpr double end = 400.0;
  double largest = 0.0, area = 0.0;
  for (int i = 0; i < n; ++i) {
    const double y = (i + 0.5) / n;  // crowded where the traction is large
    const double t = traction(end * y * y * y * energy / strength);
    largest = std::max(largest, t);
    area += t * end * 3.0 * y * y / n / strength;
  }
  EXPECT_NEAR(largest, strength, 1e-3 * strength);
  EXPECT_NEAR(area, 1.0, GetParam().name == "hyperbolic" ? 4e-3 : 1e-3);
}

TEST_P(TractionSeparation, BeginsAtZeroAndEnds) {
  EXPECT_EQ(traction(0.0), 0.0);
  EXPECT_EQ(traction(-1e-6), 0.0);
  EXPECT_LT(traction(1e3 * energy / strength), 1e-5 * strength);
}

TEST_P(TractionSeparation, TakesEveryShapeWithinItsBounds) {
  for (std::size_t j = 0; j < GetParam().shape.size(); ++j)
    for (const double bound : {GetParam().shape[j].lower, GetParam().shape[j].upper}) {
      std::vector<double> at_bound = shape();
      at_bound[j] = bound;
      for (const double x : {1e-6, 0.01, 0.5, 1.0, 2.0, 10.0}) {
        const double t = GetParam().traction(GetParam(), x * energy / strength, strength, energy, at_bound);
        EXPECT_TRUE(std::isfinite(t));
        EXPECT_GE(t, 0.0);
        EXPECT_LE(t, strength * (1.0 + 1e-9)) << GetParam().shape[j].name << " " << bound << " at " << x;
      }
    }
}

INSTANTIATE_TEST_SUITE_P(Laws, TractionSeparation, testing::ValuesIn(traction_separation_laws()),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace pfdm::this_file
