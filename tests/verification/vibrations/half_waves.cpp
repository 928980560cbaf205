// Few cells to a half wave: how many there are, what that costs, and modes of like frequency on such meshes.

#include "solver/dynamics/mode_waves.h"
#include "tests/verification/vibrations/vibrating_boxes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pfdm::verification::this_file {
namespace {

using namespace verification::vibrating_boxes;

const Vector strip{0.1, 0.012, 0.004};  // [m]

std::vector<Mode> modes_of(const VibratingBody& body, int count) { return lowest_modes(body, count); }

TEST(HalfWaves, AreCounted) {
  const Mesh mesh = box(strip, {60, 4, 2});
  const VibratingBody body(mesh, body_of(0.3, {clamped("xmin")}), {rho});
  for (const double cells : {4.0, 6.0, 15.0}) {
    Mode mode{.shape = Eigen::VectorXd::Zero(body.size())};
    for (Index c = 0; c < mesh.n_cells(); ++c)
      mode.shape[3 * Eigen::Index{c} + 2] = std::cos(pi * mesh.cell_centre[c][0] / (cells * strip[0] / 60.0));
    const auto found = fewest_cells_to_half_wave(body, mode);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->axis, 0);
    EXPECT_NEAR(found->cells / cells, 1.0, 0.02);
  }
}

// Modes that bend a cantilever across and in its plane, beside those of short cells.
TEST(HalfWaves, SayWhatFrequenciesAreOffBy) {
  const auto modes_with = [](Index nx, auto&& see) {
    const Mesh mesh = box(strip, {nx, 6, 4});
    const VibratingBody body(mesh, body_of(0.3, {clamped("xmin")}), {rho});
    const auto modes = modes_of(body, 5);
    for (std::size_t k = 0; k < modes.size(); ++k) see(k, modes[k], body);
  };
  std::vector<double> due(5);
  modes_with(96, [&](std::size_t k, const Mode& mode, const VibratingBody&) { due[k] = mode.omega; });
  int few = 0;
  for (const Index nx : {10, 14})
    modes_with(nx, [&](std::size_t k, const Mode& mode, const VibratingBody& body) {
      const auto waves = fewest_cells_to_half_wave(body, mode);
      ASSERT_TRUE(waves);
      if (waves->axis != 0 || waves->cells > 8.0) return;
      const double error = 1.0 - mode.omega / due[k], most = most_error_by_half_waves(waves->cells);
      report_row("mode " + std::to_string(k + 1) + ", " + std::to_string(nx) + " cells along",
                 {{"cells to a half wave", waves->cells}, {"too low by", error}, {"at most, as told", most}});
      EXPECT_LT(error, 1.2 * most);
      EXPECT_GT(error, 0.4 * most);
      ++few;
    });
  EXPECT_GE(few, 4);
}

// With 16 cells along a strip that both ends hold the 7th to 10th modes are conjugate pairs.
TEST(HalfWaves, OfLikeModesAreFoundWhereTheyAreFew) {
  const Mesh mesh = box(strip, {16, 12, 4});
  const VibratingBody body(mesh, body_of(0.3, {clamped("xmin"), clamped("xmax")}), {rho});
  const auto modes = modes_of(body, 10);
  ASSERT_EQ(modes.size(), 10U);
  for (std::size_t k = 1; k < modes.size(); ++k) {
    EXPECT_GT(modes[k].omega, modes[k - 1].omega);
    const double overlap = std::abs(body.inner(modes[k].shape, modes[k - 1].shape));
    EXPECT_LT(overlap, k == 7 || k == 9 ? 1e-9 : 0.2) << k;  // of a pair
  }
}

}  // namespace
}  // namespace pfdm::verification::this_file
