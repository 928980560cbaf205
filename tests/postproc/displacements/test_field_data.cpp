#include "physics/error.h"
#include "postproc/displacements/field_outliers.h"
#include "postproc/displacements/field_path.h"
#include "postproc/displacements/field_residuals.h"
#include "postproc/displacements/field_thinning.h"
#include "postproc/displacements/place_sampler.h"
#include "tests/postproc/boxes.h"
#include "tests/postproc/displacements/grid_fields.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>

namespace pfdm::this_file {
namespace {

using test::box_mesh;
using testing::HasSubstr;

// A linear displacement has a constant gradient, so that cell values and gradients give it exactly.
TEST(PlaceSampler, IsExactForLinearDisplacements) {
  const Mesh mesh = box_mesh({1.0, 4, 3.0}, {1.0, 3, 1.0}, {0.5, 2, 1.0});
  const Tensor G = (Tensor() << 0.1, 0.2, -0.3, 0.05, -0.1, 0.4, 0.3, 0.2, 0.1).finished();
  CellField<Vector> u(mesh.n_cells());
  CellField<Tensor> gradient(mesh.n_cells());
  for (Index c = 0; c < mesh.n_cells(); ++c) u[c] = G * mesh.cell_centre[c], gradient[c] = G;
  const std::vector<FieldPlace> places{{{Vector(0.31, 0.77, 0.5)}},
                                       {{Vector(0, 0, 0), Vector(1, 1, 0.5), Vector(0.9, 0.1, 0.2)}}};
  const std::vector<Vector> means = PlaceSampler(mesh, places)(u, gradient);
  EXPECT_LT((means[0] - G * Vector(0.31, 0.77, 0.5)).norm(), 1e-14);
  EXPECT_LT((means[1] - G * Vector(1.9 / 3, 1.1 / 3, 0.7 / 3)).norm(), 1e-14);
}

TEST(CellLocator, SaysHowFarAPointIsOutside) {
  const Mesh mesh = box_mesh({1.0, 4, 1.0}, {1.0, 4, 1.0}, {1.0, 1, 1.0});
  const CellLocator locator(mesh);
  EXPECT_EQ(locator.cell_at({0.3, 0.6, 0.5}).second, 0.0);
  EXPECT_NEAR(locator.cell_at({1.2, 0.6, 0.5}).second, 0.2, 1e-12);
}

// Means over squares are of the same points in what is measured and computed: no field, however curved, differs.
TEST(SelectedField, AveragesBothAlike) {
  const Mesh mesh = box_mesh({1.0, 4, 1.0}, {1.0, 4, 1.0}, {1.0, 1, 1.0});
  const auto u = [](const Vector& x) { return Vector(std::sin(9.0 * x[0] * x[1]), x[0] * x[0] * x[0], 0.0); };
  std::vector<FieldPlace> places;
  const MeasuredField field = selected_field(field_of({grid_frame(40, 0.025, u), grid_frame(40, 0.025, u)}),
                                             {.most = 100, .drops_outliers = false}, mesh, places);
  EXPECT_LE(places.size(), 100u);
  EXPECT_GT(places.size(), 60u);  // both frames have the same places
  EXPECT_EQ(field.frames[0].places, field.frames[1].places);
  EXPECT_NEAR(field.spacing, 0.025, 1e-9);
  const Eigen::MatrixXd difference = frame_difference(field, field.frames[0], computed_by(places, u));
  EXPECT_LT(difference.cwiseAbs().maxCoeff(), 1e-14);
}

TEST(SelectedField, LeavesOutWhatDoesNotCountAndSaysIt) {
  const Mesh mesh = box_mesh({1.0, 4, 1.0}, {1.0, 4, 1.0}, {1.0, 1, 1.0});
  RecordedFrame frame = grid_frame(20, 0.06, zero);  // up to 1.17: seven of twenty rows and columns have a part outside
  RecordedFrame small{.name = "2",
                      .displacement = 2.0,
                      .points = {Vector(0.5, 0.5, 0), Vector(0.6, 0.5, 0)},
                      .u = {zero({}), zero({})}};
  std::vector<FieldPlace> places;
  const MeasuredField field =
      selected_field(field_of({frame, small}),
                     {.masked = {{Vector(0.0, 0.5, 0.0), Vector(0.5, 0.5, 0.0), 0.05}}, .most = 400}, mesh, places);
  std::size_t outside = 0, masked = 0;
  for (const Vector& p : frame.points) {
    const bool is_outside = p[0] > 1.0001 || p[1] > 1.0001;
    outside += is_outside ? 1 : 0;
    masked += !is_outside && (p - Vector(std::min(p[0], 0.5), 0.5, 0.0)).norm() < 0.05 ? 1 : 0;
  }
  EXPECT_GT(masked, 0u);
  EXPECT_EQ(field.frames.size(), 1u);
  EXPECT_EQ(field.frames[0].places.size(), 400 - outside - masked);
  EXPECT_THAT(field.told,
              testing::ElementsAre(fmt::format("{} points left out: they lie outside of the body", outside),
                                   fmt::format("{} points left out: they lie in a masked strip", masked + 1),
                                   HasSubstr("frame 2 is left out: it has 1 points")));
}

TEST(SelectedField, IsRefusedBesideTheBody) {
  const Mesh mesh = box_mesh({1.0, 4, 1.0}, {1.0, 4, 1.0}, {1.0, 1, 1.0});
  RecordedField field = field_of({grid_frame(5, 0.1, zero)});
  field.plane.origin = Vector(3.0, 0.0, 0.0);
  std::vector<FieldPlace> places;
  try {
    selected_field(field, {}, mesh, places);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("all points of \"front\" lie outside of the body, the nearest by 2.05 m"));
  }
}

TEST(Outliers, AreFoundInNoiseAndNotBesideACrack) {
  std::mt19937 engine(3);
  std::normal_distribution<double> noise(0.0, 0.01);
  const auto opened = [&](const Vector& x) {
    return Vector(2.0 * x[0] + noise(engine), (x[1] > 0.5 ? 1.0 : 0.0) + noise(engine), 0.0);
  };
  RecordedFrame frame = grid_frame(20, 0.05, opened);
  const std::vector<bool> none = outliers_of(frame, 0.05, 2);
  EXPECT_EQ(std::ranges::count(none, true), 0);
  frame.u[5 * 20 + 3][0] += 0.2;
  frame.u[5 * 20 + 4][0] -= 0.3;
  frame.u[12 * 20 + 17][1] += 0.2;
  const std::vector<bool> found = outliers_of(frame, 0.05, 2);
  EXPECT_EQ(std::ranges::count(found, true), 3);
  EXPECT_TRUE(found[5 * 20 + 3] && found[5 * 20 + 4] && found[12 * 20 + 17]);
}

TEST(RigidMotion, IsTakenOutOfBoth) {
  const Mesh mesh = box_mesh({1.0, 4, 1.0}, {1.0, 4, 1.0}, {1.0, 1, 1.0});
  const auto moved = [](const Vector& x) { return Vector(0.3 - 0.02 * x[1], -0.1 + 0.02 * x[0], 0.0); };
  std::vector<FieldPlace> places;
  const MeasuredField field = selected_field(field_of({grid_frame(10, 0.1, moved)}), {.most = 40}, mesh, places);
  const RigidMotion motion(field, field.frames[0]);
  const Eigen::MatrixXd difference = frame_difference(field, field.frames[0], computed_by(places, zero));
  EXPECT_GT(difference.norm(), 0.1);
  EXPECT_LT(motion.projected(difference).norm(), 1e-12);
  EXPECT_LT(motion.reduced(difference).norm(), 1e-12);
  EXPECT_EQ(motion.reduced(difference).size(), static_cast<Eigen::Index>(field.n_data(field.frames[0])));
  // What is no rigid motion keeps its length, weighted by the numbers of points.
  const auto stretched = [](const Vector& x) { return Vector(0.1 * (x[0] - 0.5), 0.0, 0.0); };
  const Eigen::MatrixXd stretch = frame_difference(field, field.frames[0], computed_by(places, stretched));
  double weighted = 0.0;
  const Eigen::MatrixXd left = motion.projected(stretch);
  for (Eigen::Index i = 0; i < left.rows(); ++i)
    weighted += field.frames[0].n_points[static_cast<std::size_t>(i)] * left.row(i).squaredNorm();
  EXPECT_NEAR(motion.reduced(stretch).norm(), std::sqrt(weighted), 1e-12);
}

/// Noise of a grid, and an error of the model that is a wave over the whole of it: means over `width` points each way
/// of independent noise, `frames` of them with a share in common.
FieldScatter scatter_of_noise(int width, int frames, double common, unsigned seed, double error = 0.0,
                              double subset = 0.0, double taken = 0.0) {
  const Mesh mesh = box_mesh({1.0, 4, 1.0}, {1.0, 4, 1.0}, {1.0, 1, 1.0});
  constexpr int n = 24;
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal;
  const auto white = [&] {
    Eigen::MatrixXd values(n + width - 1, n + width - 1), mean = Eigen::MatrixXd::Zero(n, n);
    for (double& v : values.reshaped()) v = normal(engine);
    for (int i = 0; i < width; ++i)
      for (int j = 0; j < width; ++j) mean += values.block(i, j, n, n) / width;
    return mean;
  };
  const std::array<Eigen::MatrixXd, 2> shared{white(), white()};
  std::vector<RecordedFrame> recorded;
  for (int f = 0; f < frames; ++f) {
    recorded.push_back(grid_frame(n, 1.0 / n, zero));
    recorded.back().displacement = f;
    for (int k = 0; k < 2; ++k) {
      const Eigen::MatrixXd own = white();
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
          recorded.back().u[static_cast<std::size_t>(i * n + j)][k] =
              std::sqrt(1.0 - common) * own(i, j) + std::sqrt(common) * shared[static_cast<std::size_t>(k)](i, j) +
              error * std::sin(6.28 * i / n);
    }
  }
  std::vector<FieldPlace> places;
  MeasuredField field = selected_field(field_of(recorded), {.most = 1000, .drops_outliers = false}, mesh, places);
  field.subset = subset;
  std::vector<std::size_t> all;
  std::vector<Eigen::MatrixXd> left;
  for (std::size_t f = 0; f < field.frames.size(); ++f) {
    all.push_back(f);
    left.push_back(RigidMotion(field, field.frames[f])
                       .projected(frame_difference(field, field.frames[f], computed_by(places, zero))));
  }
  return scatter_of(field, all, left, taken);
}

TEST(FieldScatter, OfIndependentNoiseIsThatOfAPoint) {
  int inflated = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const FieldScatter scatter = scatter_of_noise(1, 4, 0.0, seed);
    EXPECT_NEAR(scatter.deviation, 1.0, 0.05);
    inflated += scatter.inflation > 1.0 ? 1 : 0;
  }
  EXPECT_LE(inflated, 1);
}

// Means over w points each way have the deviation 1, and sums over large squares w times that of independent ones.
TEST(FieldScatter, SeesOverlappingSubsets) {
  double mean = 0.0;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const FieldScatter scatter = scatter_of_noise(3, 4, 0.0, seed);
    EXPECT_NEAR(scatter.deviation, 1.0, 0.1);
    EXPECT_FALSE(scatter.is_long_ranged) << seed;
    mean += scatter.inflation / 10.0;
  }
  EXPECT_NEAR(mean, 3.0, 0.5);
}

// With half of the variance in all four frames, their sums have 1 + 3/2 times the variance.
TEST(FieldScatter, SeesNoiseOfTheReferenceImage) {
  double mean = 0.0;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const FieldScatter scatter = scatter_of_noise(1, 4, 0.5, seed);
    EXPECT_TRUE(scatter.over_frames);
    EXPECT_FALSE(scatter.is_long_ranged) << seed;
    mean += scatter.inflation / 10.0;
  }
  EXPECT_NEAR(mean, std::sqrt(2.5), 0.25);
}

TEST(FieldScatter, IsWiderByOverlapAndByParameters) {
  const FieldScatter plain = scatter_of_noise(1, 1, 0.0, 3), wide = scatter_of_noise(1, 1, 0.0, 3, 0.0, 5.0 / 24);
  EXPECT_EQ(plain.inflation, 1.0);
  EXPECT_NEAR(wide.inflation, 5.0, 1e-6);
  EXPECT_EQ(wide.over, 5.0 / 24);
  const FieldScatter fitted = scatter_of_noise(1, 1, 0.0, 3, 0.0, 0.0, 100.0);
  EXPECT_NEAR(fitted.deviation, plain.deviation * std::sqrt(plain.freedom / (plain.freedom - 100.0)), 1e-12);
}

TEST(FieldScatter, TellsAnErrorOfTheModelFromNoise) {
  for (unsigned seed = 1; seed <= 5; ++seed) EXPECT_TRUE(scatter_of_noise(1, 4, 0.0, seed, 0.5).is_long_ranged) << seed;
}

TEST(FieldPath, IsLinearBetweenSteps) {
  const SampledCurve curve{.name = "", .x = {0, 1, 2, 4}, .y = {0, 10, 20, 30}};
  const FieldPath path(curve, {.offset = 0.5, .compliance = 0.01}, {}, 0);  // recorded at 0.5, 1.6, 2.7, 4.8
  const auto weights = path.at(2.15);
  ASSERT_TRUE(weights);
  double step = 0.0, sum = 0.0;
  for (const auto& [row, weight] : *weights) step += weight * static_cast<double>(row), sum += weight;
  EXPECT_NEAR(step, 1.5, 1e-12);
  EXPECT_NEAR(sum, 1.0, 1e-12);
  EXPECT_FALSE(path.at(4.9));
  EXPECT_DOUBLE_EQ(path.latest(), 4.8);
}

TEST(FieldPath, StaysOnItsSideOfAMeasuredJump) {
  // It jumps between rows 3 and 4; measured later, at 4.5: until then the first part goes on straight.
  const SampledCurve curve{.name = "", .x = {0, 1, 2, 3, 3.1, 4, 5, 6}, .y = {0, 10, 20, 30, 5, 6, 7, 8}};
  const MeasuredEvent jump{.kind = EventKind::jump, .place = 4.5, .figures = {{EventFigure::displacement, 4.5, 0.1}}};
  const FieldPath path(curve, {}, {jump}, 0);
  const auto value = [&](double x) {
    double sum = 0.0;
    const std::vector<double> u{0, 1, 2, 3, 100, 101, 102, 103};
    const StepWeights weights = path.at(x).value();
    for (const auto& [row, weight] : weights) sum += weight * u[row];
    return sum;
  };
  EXPECT_NEAR(value(2.5), 2.5, 1e-9);
  EXPECT_NEAR(value(4.2), 4.2, 1e-9);
  EXPECT_NEAR(value(5.5), 102.5, 1e-9);
}

}  // namespace
}  // namespace pfdm::this_file
