#include "solver/momentum/bending/line_weights.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

namespace pfdm::this_file {
namespace {

const Tensor along_x = Vector::UnitX() * Vector::UnitX().transpose();
const Tensor but_y = Tensor::Identity() - Vector::UnitY() * Vector::UnitY().transpose();

// Two cells of a line between two planes, the first of which holds x, the second all but y.
const std::vector<LinePlace> line{
    {.at = -0.5, .at_held = -0.25, .held = along_x}, {.at = 0.5, .at_held = 0.5}, {1.5, 1.25, but_y}};

// The mean derivative of a displacement whose slope is a + b s + c s^2, by components, where its slopes are.
Vector mean_of(const std::vector<LinePlace>& places, const LineWeights& weights, double a, double b, double c) {
  const auto slope = [&](const LinePlace& in, const Vector& component) {
    const double s = component.dot(in.held * component) > 0.5 ? in.at_held : in.at;
    return a + b * s + c * s * s;
  };
  std::vector<Vector> slopes;
  for (const LinePlace& in : places)
    slopes.emplace_back(slope(in, Vector::UnitX()), slope(in, Vector::UnitY()), slope(in, Vector::UnitZ()));
  Vector mean = Vector::Zero();
  for (std::size_t k = 0; k < places.size(); ++k) {
    mean += weights.of_all[k] * slopes[k];
    for (const LineWeights::Change& of : weights.of_held) mean += of.change[k] * (of.part * slopes[k]);
  }
  return mean;
}

// x is held at both ends, z at the second one, y at neither.
TEST(LineWeights, AreExactForParabolasWhateverTheEndsHold) {
  const Vector mean = mean_of(line, line_weights(line), 0.7, -2.0, 3.0);
  for (Index i = 0; i < 3; ++i) EXPECT_NEAR(mean[i], 0.7 + 3.0 / 12.0, 1e-14) << i;
}

TEST(LineWeights, OfOneEndOrNone) {
  for (const std::size_t held : {0U, 2U}) {
    std::vector<LinePlace> one = line;
    one[held].held = Tensor::Zero();
    const LineWeights weights = line_weights(one);
    EXPECT_EQ(weights.of_held.size(), 1U);
    const Vector mean = mean_of(one, weights, 0.7, -2.0, 3.0);
    for (Index i = 0; i < 3; ++i) EXPECT_NEAR(mean[i], 0.95, 1e-14) << held << i;
  }
  std::vector<LinePlace> none = line;
  none[0].held = none[2].held = Tensor::Zero();
  EXPECT_TRUE(line_weights(none).of_held.empty());
}

}  // namespace
}  // namespace pfdm::this_file
