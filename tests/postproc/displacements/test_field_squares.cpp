// Places of frames that lose points.

#include "postproc/displacements/field_residuals.h"
#include "postproc/displacements/field_thinning.h"
#include "tests/postproc/boxes.h"
#include "tests/postproc/displacements/grid_fields.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <random>
#include <string>
#include <utility>

namespace pfdm::this_file {
namespace {

using test::box_mesh;
using testing::HasSubstr;

/// Frames that lose 5 % of their points each: a bent and stretched face, n x n points with noise of 1e-3, squares of
/// which no frame has more than 400. The places that are made, and the mean square of what is left over its deviation.
std::pair<std::size_t, double> places_of_holed_frames(int n, int n_frames, std::string& told) {
  const Mesh mesh = box_mesh({1.0, 4, 1.0}, {1.0, 4, 1.0}, {1.0, 1, 1.0});
  const auto u = [](const Vector& x) { return Vector(x[0] + 0.5 * x[0] * x[1], 0.5 * x[1] * x[1] - x[0], 0.0); };
  constexpr double noise = 1e-3;
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
  const MeasuredField field = selected_field(field_of(frames), {.drops_outliers = false}, mesh, places);
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
