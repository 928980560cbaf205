// Places of frames that lose points.

#include "postproc/displacements/field_residuals.h"
#include "postproc/displacements/field_thinning.h"
#include "tests/postproc/boxes.h"
#include "tests/postproc/displacements/grid_fields.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <utility>

namespace pfdm::this_file {
namespace {

using test::box_mesh;
using testing::HasSubstr;

Vector bent(const Vector& x) { return {x[0] + 0.5 * x[0] * x[1], 0.5 * x[1] * x[1] - x[0], 0.0}; }
Vector waves(const Vector& x) {
  return {std::sin(2.0 * std::numbers::pi * x[0]), std::cos(2.0 * std::numbers::pi * x[1]), 0.0};
}

/// What is measured, and how.
struct HoledFrames {
  Vector (*u)(const Vector&) = bent;
  double noise = 1e-3;
  double deviation = 0.0;  ///< as stated
};

/// Frames that lose 5 % of their points each: n x n points of a face, squares of which no frame has more than 400. The
/// places that are made, and the mean square of what is left over its deviation.
std::pair<std::size_t, double> places_of_holed_frames(int n, int n_frames, std::string& told,
                                                      const HoledFrames& how = {}) {
  const Mesh mesh = box_mesh({1.0, 4, 1.0}, {1.0, 4, 1.0}, {1.0, 1, 1.0});
  const auto u = how.u;
  const double noise = how.noise;
  std::mt19937 engine(3);
  std::normal_distribution<double> normal(0.0, noise);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<RecordedFrame> frames;
  for (int f = 0; f < n_frames; ++f) {
    RecordedFrame& frame =
        frames.emplace_back(RecordedFrame{.name = "f", .displacement = f + 1.0, .points = {}, .u = {}});
    const RecordedFrame whole = grid_frame(n, 1.0 / n, u);
    for (std::size_t i = 0; i < whole.points.size(); ++i) {
      if (uniform(engine) < 0.05) continue;
      frame.points.push_back(whole.points[i]);
      frame.u.push_back(whole.u[i] + Vector(normal(engine), normal(engine), 0.0));
    }
  }
  std::vector<FieldPlace> places;
  RecordedField recorded = field_of(frames);
  recorded.deviation = how.deviation;
  const MeasuredField field = selected_field(recorded, {.drops_outliers = false}, mesh, places);
  const std::vector<double> computed = computed_by(places, u);
  double squares = 0.0, count = 0.0;
  for (const FieldFrame& frame : field.frames) {
    const Eigen::MatrixXd difference = frame_difference(field, frame, computed);
    for (std::size_t i = 0; i < frame.places.size(); ++i) {
      squares += difference.row(static_cast<Eigen::Index>(i)).squaredNorm() * frame.n_points[i] / (noise * noise);
      count += 2.0;
    }
  }
  told = fmt::format("{}", fmt::join(field.told, "; "));
  std::printf("%d x %d points: %zu places in %d frames; means over their standard deviation: rms %.4f\n", n, n,
              places.size(), n_frames, std::sqrt(squares / count));
  return {places.size(), squares / count};
}

TEST(SelectedField, HasPlacesInCommonWherePointsDropOut) {
  std::string told;
  const auto [n_places, square] = places_of_holed_frames(100, 50, told);  // 25 in a square
  EXPECT_LE(n_places, 420u);
  EXPECT_NEAR(square, 1.0, 0.02);  // of 40,000 data: 0.007
  EXPECT_THAT(told, HasSubstr("are carried to the middle of all"));
}

// Four in a square, which hardly have a plane: places are as many as there are ways to lack points.
TEST(SelectedField, HasFewPlacesWhereSquaresHaveFewPoints) {
  std::string told;
  const auto [n_places, square] = places_of_holed_frames(40, 50, told);
  const auto [n_later, square_later] = places_of_holed_frames(40, 200, told);
  EXPECT_LT(n_later, 2 * n_places);
  EXPECT_NEAR(square, 1.0, 0.02);
  EXPECT_NEAR(square_later, 1.0, 0.01);
}

// Over a square of 5 x 5 points the waves differ from a plane by up to 47 times the smallest noise, rms of both
// components, and by twice the largest.
TEST(SelectedField, CarriesNoMeanAcrossACurvedField) {
  for (const double noise : {1e-4, 4e-4, 2e-3})
    for (const double deviation : {0.0, noise}) {
      std::string told;
      const auto [n_places, square] = places_of_holed_frames(100, 20, told, {waves, noise, deviation});
      EXPECT_NEAR(square, 1.0, 0.03) << noise << " " << deviation;  // of 16,000 data: 0.011
    }
}

TEST(SelectedField, HasWholeSquaresInAnyOrderOfRows) {
  const Mesh mesh = box_mesh({1.0, 4, 1.0}, {1.0, 4, 1.0}, {1.0, 1, 1.0});
  std::vector<RecordedFrame> frames(2, grid_frame(50, 0.02 * (1.0 + 1e-9), bent));
  std::ranges::reverse(frames[1].points);
  std::ranges::reverse(frames[1].u);
  std::vector<FieldPlace> places;
  const MeasuredField field = selected_field(field_of(frames), {.drops_outliers = false}, mesh, places);
  EXPECT_THAT(field.told, testing::Not(testing::Contains(HasSubstr("lack"))));
  EXPECT_EQ(places.size(), field.frames[0].places.size());
}

// Of five frames two lack the same half of the points in a corner.
TEST(SelectedField, CountsMeansAtTheirOwnPoints) {
  const Mesh mesh = box_mesh({1.0, 4, 1.0}, {1.0, 4, 1.0}, {1.0, 1, 1.0});
  std::vector<RecordedFrame> frames(5, grid_frame(40, 0.025, bent));
  for (const std::size_t f : {1u, 2u}) {
    std::vector<Vector> points, u;
    for (std::size_t i = 0; i < frames[f].points.size(); ++i) {
      if (frames[f].points[i][0] < 0.2 && frames[f].points[i][1] < 0.2 && i % 2 == 0) continue;
      points.push_back(frames[f].points[i]), u.push_back(frames[f].u[i]);
    }
    frames[f].points = points, frames[f].u = u;
  }
  std::vector<FieldPlace> places;
  const MeasuredField field = selected_field(field_of(frames), {.most = 25, .drops_outliers = false}, mesh, places);
  const std::size_t n_own = places.size() - field.frames[0].places.size();
  ASSERT_GT(n_own, 0u);
  EXPECT_THAT(field.told, testing::Contains(testing::StartsWith(fmt::format("{} means lack more", 2 * n_own))));
}

// A crack along y = 0.5 is within squares: no plane goes through its sides.
TEST(SelectedField, CarriesNoMeanAcrossACrack) {
  const Mesh mesh = box_mesh({1.0, 4, 1.0}, {1.0, 4, 1.0}, {1.0, 1, 1.0});
  const auto u = [](const Vector& x) { return Vector(0.0, x[1] > 0.5 ? 1.0 : 0.0, 0.0); };
  std::vector<RecordedFrame> frames{grid_frame(35, 1.0 / 35, u), grid_frame(35, 1.0 / 35, u)};
  std::mt19937 engine(3);
  std::normal_distribution<double> normal(0.0, 1e-3);
  for (RecordedFrame& frame : frames)
    for (Vector& at : frame.u) at += Vector(normal(engine), normal(engine), 0.0);
  std::vector<RecordedFrame> holed = frames;
  for (std::size_t i = holed[1].points.size(); i-- > 0;) {
    if (i % 9 != 0) continue;
    holed[1].points.erase(holed[1].points.begin() + static_cast<std::ptrdiff_t>(i));
    holed[1].u.erase(holed[1].u.begin() + static_cast<std::ptrdiff_t>(i));
  }
  std::vector<FieldPlace> places;
  const MeasuredField field = selected_field(field_of(holed), {.most = 60, .drops_outliers = false}, mesh, places);
  const Eigen::MatrixXd difference = frame_difference(field, field.frames[1], computed_by(places, u));
  EXPECT_LT(difference.cwiseAbs().maxCoeff(), 1.5e-3);
  EXPECT_GT(places.size(), field.frames[0].places.size());
}

}  // namespace
}  // namespace pfdm::this_file
