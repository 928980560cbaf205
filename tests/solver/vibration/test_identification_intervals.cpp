// Intervals of parameters from blocks of residuals, against the exact covariance of linear least squares.

#include "solver/vibration/identification/identification_intervals.h"
#include "solver/vibration/simulation/vibration_excitation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace pfdm::this_file {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index block_length = 200;
constexpr Index block_count = 30;
constexpr Index samples = block_length * block_count;

std::vector<ResidualBlock> equal_blocks() {
  std::vector<ResidualBlock> blocks;
  for (Index k = 0; k < block_count; ++k) blocks.emplace_back(k * block_length, (k + 1) * block_length);
  return blocks;
}

/// Sines, known everywhere; the last of them only within `informed` blocks.
MatrixXd sensitivities(Index informed) {
  MatrixXd J(samples, 3);
  for (Index i = 0; i < samples; ++i) {
    const double t = static_cast<double>(i);
    J.row(i) << std::sin(0.11 * t), 40.0 * std::cos(0.07 * t), 1e-3 * std::sin(0.19 * t);
    if (i >= informed * block_length) J(i, 2) = 0.0;
  }
  return J;
}

/// White noise, or one whose neighbours are alike over some ten samples, of deviation 1.
VectorXd noise(std::uint64_t seed, double memory) {
  VectorXd e = normal_numbers(samples, seed);
  for (Index i = 1; i < samples; ++i) e[i] = memory * e[i - 1] + std::sqrt(1.0 - memory * memory) * e[i];
  return e;
}

struct Coverage {
  VectorXd held;    ///< part of the records whose interval holds the truth, 0
  VectorXd stated;  ///< rms of the standard errors that are stated
};

Coverage coverage(const MatrixXd& J, double memory, int records) {
  const Index p = J.cols();
  const auto blocks = equal_blocks();
  Coverage c{VectorXd::Zero(p), VectorXd::Zero(p)};
  const MatrixXd inverse = (J.transpose() * J).inverse();
  for (int record = 0; record < records; ++record) {
    const VectorXd e = noise(1000 + static_cast<std::uint64_t>(record), memory);
    const VectorXd x = inverse * (J.transpose() * e);
    const auto replicates = parameter_replicates(x, e - J * x, J, blocks, 400, 0.95, 1);
    for (Index j = 0; j < p; ++j) {
      VectorXd sorted = replicates.widened.row(j);
      std::ranges::sort(sorted);
      c.held[j] += sorted[10] < 0.0 && sorted[389] > 0.0 ? 1.0 / records : 0.0;  // 2.5 and 97.5 %
      c.stated[j] += (replicates.around.row(j).array() - x[j]).square().mean() / records;
    }
  }
  c.stated = c.stated.cwiseSqrt();
  return c;
}

/// Exact standard errors under noise whose autocorrelation is memory^|lag|.
VectorXd exact_errors(const MatrixXd& J, double memory) {
  MatrixXd smoothed = J;  // the autocorrelation's product with J
  const Index reach = memory > 0.0 ? 200 : 0;
  for (Index lag = 1; lag <= reach; ++lag) {
    const double r = std::pow(memory, static_cast<double>(lag));
    smoothed.topRows(samples - lag) += r * J.bottomRows(samples - lag);
    smoothed.bottomRows(samples - lag) += r * J.topRows(samples - lag);
  }
  const MatrixXd inverse = (J.transpose() * J).inverse();
  return (inverse * (J.transpose() * smoothed) * inverse).diagonal().cwiseSqrt();
}

TEST(IdentificationIntervals, AreRightWhereAllBlocksKnowOfAllParameters) {
  const MatrixXd J = sensitivities(block_count);
  const Coverage c = coverage(J, 0.0, 400);
  const VectorXd exact = exact_errors(J, 0.0);
  for (Index j = 0; j < J.cols(); ++j) {
    EXPECT_NEAR(c.stated[j] / exact[j], 1.0, 0.04);
    EXPECT_NEAR(c.held[j], 0.95, 0.035);  // three standard deviations of 400
  }
}

// Drawn with their sensitivities the blocks would state several times the error of the third.
TEST(IdentificationIntervals, AreRightWhereFewBlocksKnowOfAParameter) {
  for (const Index informed : {2, 4}) {
    const MatrixXd J = sensitivities(informed);
    const Coverage c = coverage(J, 0.0, 400);
    const VectorXd exact = exact_errors(J, 0.0);
    for (Index j = 0; j < J.cols(); ++j) {
      EXPECT_NEAR(c.stated[j] / exact[j], 1.0, 0.08) << informed;
      EXPECT_NEAR(c.held[j], 0.95, 0.035) << informed << ", parameter " << j;
    }
  }
}

TEST(IdentificationIntervals, KnowOfNoiseThatIsCorrelated) {
  const MatrixXd J = sensitivities(block_count);
  const Coverage c = coverage(J, 0.9, 400);
  const VectorXd exact = exact_errors(J, 0.9);
  EXPECT_GT(exact[1], 1.5 * exact_errors(J, 0.0)[1]);  // as if it were white would be wrong
  for (Index j = 0; j < J.cols(); ++j) {
    EXPECT_NEAR(c.stated[j] / exact[j], 1.0, 0.1);
    EXPECT_NEAR(c.held[j], 0.95, 0.035);
  }
}

// By the variance of all residuals: the block's own score is zero after the fit.
TEST(IdentificationIntervals, SayWhereOneBlockAloneKnowsOfAParameter) {
  const MatrixXd J = sensitivities(1);
  const Coverage c = coverage(J, 0.0, 100);
  EXPECT_NEAR(c.stated[2] / exact_errors(J, 0.0)[2], 1.0, 0.05);
  EXPECT_NEAR(c.held[2], 1.0, 1e-12);  // one degree of freedom: 6.5 times as wide
  const VectorXd e = noise(1, 0.0), x = VectorXd::Zero(3);
  EXPECT_TRUE(parameter_replicates(x, e, J, equal_blocks(), 10, 0.95, 1).rest_on_one_block);
  EXPECT_FALSE(parameter_replicates(x, e, sensitivities(2), equal_blocks(), 10, 0.95, 1).rest_on_one_block);
}

TEST(IdentificationIntervals, OfASingleBlockAreNotOfZeroWidth) {
  const MatrixXd J = sensitivities(block_count);
  const VectorXd e = noise(1, 0.0), x = (J.transpose() * J).inverse() * (J.transpose() * e);
  const std::vector<ResidualBlock> whole{{0, samples}};
  const auto replicates = parameter_replicates(x, e - J * x, J, whole, 400, 0.95, 1);
  EXPECT_TRUE(replicates.rest_on_one_block);
  const VectorXd exact = exact_errors(J, 0.0);
  for (Index j = 0; j < 3; ++j)
    EXPECT_NEAR(std::sqrt((replicates.around.row(j).array() - x[j]).square().mean()) / exact[j], 1.0, 0.15);
}

TEST(IdentificationIntervals, OfAParameterThatNothingKnowsAreWide) {
  MatrixXd J = sensitivities(block_count);
  J.col(2).setZero();
  const VectorXd e = noise(1, 0.0), x = VectorXd::Zero(3);
  const auto replicates = parameter_replicates(x, e, J, equal_blocks(), 100, 0.95, 1);
  EXPECT_TRUE(replicates.rest_on_one_block);
  EXPECT_TRUE(replicates.widened.allFinite());
  EXPECT_GT(replicates.widened.row(2).cwiseAbs().mean(), 1e6);
}

}  // namespace
}  // namespace pfdm::this_file
