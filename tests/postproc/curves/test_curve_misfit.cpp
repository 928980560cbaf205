#include "physics/error.h"
#include "postproc/curves/curve_misfit.h"
#include "solver/calibration/calibration_verdict.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace pfdm::this_file {
namespace {

SampledCurve curve(std::vector<double> x, std::vector<double> y, std::vector<double> deviation = {}) {
  return {.name = "one", .x = std::move(x), .y = std::move(y), .deviation = std::move(deviation)};
}

TEST(CurveMisfit, ComparesPointByPoint) {
  const SampledCurve a = curve({0, 1, 2, 3}, {0, 1, 2, 5}, {1, 0.5, 0.5, 1});
  const SampledCurve b = curve({1.5}, {2.0}, {0.25});
  const MeasuredPoints points = points_between({a, b}, 0.5, 2.5);
  ASSERT_EQ(points.points.size(), 3u);
  EXPECT_TRUE(points.noise_is_known);
  const SampledCurve model = curve({0, 4}, {0, 8});
  const auto residuals = residuals_of(model, points);
  ASSERT_TRUE(residuals);
  EXPECT_EQ(*residuals, (std::vector<double>{2.0, 4.0, 4.0}));
  EXPECT_DOUBLE_EQ(rms_difference(model, points, 1), 1.0);
  EXPECT_FALSE(residuals_of(curve({0, 1.8}, {0, 1}), points));
}

TEST(CurveMisfit, WeighsByTheRmsWhereTheNoiseIsNotKnown) {
  const MeasuredPoints points = points_between({curve({0, 1}, {3, 4}), curve({0, 1}, {3, 4}, {1, 1})}, -1.0, 2.0);
  EXPECT_FALSE(points.noise_is_known);
  EXPECT_DOUBLE_EQ(points.rms, std::sqrt(12.5));
  EXPECT_DOUBLE_EQ(residuals_of(curve({0, 1}, {4, 4}), points)->front(), 1.0 / std::sqrt(12.5));
}

// Where a curve falls at once, its derivatives depend on where the points lie; those of its means add up to the fall
// over the spacing, wherever it is.
TEST(CurveMisfit, MeansFollowAJumpBetweenPoints) {
  const SampledCurve data = curve({0, 1, 2, 3, 4, 5, 6, 7, 8}, {0, 0, 0, 0, 0, 0, 0, 0, 0});
  MeasuredPoints points = points_between({data}, 0.0, 8.0);
  points.rms = 1.0;
  const auto jump_at = [](double x) { return ModelCurves{curve({0, x - 0.005, x + 0.005, 8}, {4, 4, 0, 0})}; };
  const auto change = [&](auto residuals, double x) {
    constexpr double h = 0.1;
    const auto ahead = residuals(jump_at(x + h), points).value(), behind = residuals(jump_at(x - h), points).value();
    double sum = 0.0;
    for (std::size_t i = 0; i < ahead.size(); ++i) sum += (ahead[i] - behind[i]) / (2.0 * h);
    return sum;
  };
  const auto plain = [](const ModelCurves& m, const MeasuredPoints& p) { return residuals_of(m, p); };
  EXPECT_EQ(change(plain, 4.5), 0.0);   // between two points
  EXPECT_EQ(change(plain, 4.0), 20.0);  // over one
  for (const double x : {3.6, 4.0, 4.3, 4.5, 4.9}) EXPECT_NEAR(change(averaged_residuals_of, x), 4.0, 1e-9) << x;
}

TEST(CurveMisfit, MeansOfAStraightCurveAreItsValues) {
  const SampledCurve data = curve({0, 1, 2, 4, 8}, {1, 0, 3, 1, 2}), other = curve({1, 1, 3}, {0, 1, 2});
  const MeasuredPoints points = points_between({data, other}, 0.0, 8.0);
  const ModelCurves line{curve({0, 2.5, 8}, {1, 6, 17})};
  const auto values = residuals_of(line, points).value(), means = averaged_residuals_of(line, points).value();
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_NEAR(means[i], values[i], 1e-12) << i;
  EXPECT_FALSE(averaged_residuals_of(ModelCurves{curve({0, 1.8}, {0, 1})}, points));
}

TEST(CurveMisfit, RefusesWhatHasNoWeight) {
  EXPECT_THROW(points_between({curve({0, 1}, {0, 1}, {0, 1})}, 0, 1), InputError);
  EXPECT_THROW(points_between({curve({0, 1}, {0, 1})}, 2, 3), InputError);
}

// A curve that is measured with an offset, a displacement too small and a soft frame.
TEST(CurveMisfit, SaysThatDisplacementsAreNegative) {
  const SampledCurve pulled_back = curve({-2e-6, -1e-6}, {-2.0, -1.0});
  EXPECT_THAT([&] { points_between(std::vector{pulled_back}, 1e-9, 1e-5); },
              testing::ThrowsMessage<InputError>(testing::HasSubstr("all measured displacements are negative")));
}

TEST(CurveMisfit, WeighsSpecimensByTheirScatter) {
  MeasuredPoints points{.points = {{0, 0.0, 2.0, 0.0}, {0, 1.0, 2.0, 0.0}, {1, 0.0, 2.0, 0.0}, {1, 1.0, 2.0, 0.0}},
                        .rms = 2.0};
  EXPECT_TRUE(weights_by_scatter({0.01, -0.01, 0.01, 0.01}, points).empty());
  points.weight = weights_by_scatter({0.01, -0.01, 0.04, 0.04}, points);
  ASSERT_EQ(points.weight.size(), 2u);
  EXPECT_NEAR(points.weight[0] / points.weight[1], 4.0, 1e-12);
  EXPECT_NEAR(points.scale(points.points[0]) * 4.0, points.scale(points.points[2]), 1e-12);
  const std::vector<double> weight = points.weight;
  points.weight.clear();  // residuals behind those of the points are not theirs
  EXPECT_EQ(weights_by_scatter({0.01, -0.01, 0.04, 0.04, 7.0, 8.0, 9.0}, points), weight);
}

TEST(CurveMisfit, KnowsWhichOffsetsContradictACurve) {
  const SampledCurve unloaded = curve({0.0, 1.0, 2.0}, {0.1, 10.0, 4.0});
  EXPECT_TRUE(contradicts_unloaded_start(unloaded, -2.1));
  EXPECT_FALSE(contradicts_unloaded_start(unloaded, 0.3));
  EXPECT_FALSE(contradicts_unloaded_start(curve({0.0, 1.0}, {2.0, 10.0}), 2.1));
}

TEST(CurveMisfit, SetUpErrorsExplainASetUp) {
  std::vector<double> x, force, measured;
  for (int i = 0; i <= 100; ++i) {
    x.push_back(0.01 * i);
    force.push_back(std::sin(2.0 * x.back()));
  }
  const SampledCurve model = curve(x, force);
  for (const double u : x) {
    const double f = std::sin(2.0 * u);
    measured.push_back(f + 1e-4 + 2.0 * std::cos(2.0 * u) * (2e-4 - 3e-4 * f));
  }
  const MeasuredPoints points = points_between({curve(x, measured)}, 0, 1);
  const std::vector<double> residuals = residuals_of(model, points).value();
  EXPECT_LT(rms_left_by(residuals, set_up_errors(model, points)), 0.01 * rms_left_by(residuals, {}));
  std::vector<double> other;
  other.reserve(x.size());
  for (const double u : x) other.push_back(std::sin(40.0 * u));
  EXPECT_GT(rms_left_by(other, set_up_errors(model, points)), 0.9 * rms_left_by(other, {}));
}

TEST(DrivenCurve, DropsWhereTheComputedOneFallsBack) {
  const SampledCurve driven = driven_curve(curve({0, 2, 1, 3, 4}, {0, 4, 1, 2, 3}));
  EXPECT_EQ(driven.x, (std::vector<double>{0, 2, 2, 3, 4}));
  EXPECT_EQ(driven.y, (std::vector<double>{0, 4, 1.5, 2, 3}));
  EXPECT_DOUBLE_EQ(driven.at(2.5), 1.75);
  const SampledCurve forwards = curve({0, 1, 1, 2}, {0, 1, 0, 1});
  EXPECT_EQ(driven_curve(forwards).y, forwards.y);
}

}  // namespace
}  // namespace pfdm::this_file
