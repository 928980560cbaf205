#pragma once
// Replicates of fitted parameters, and the intervals that follow from them.

#include "solver/vibration/identification/identification_coordinates.h"
#include "solver/vibration/identification/identification_output_error.h"

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <utility>

namespace pfdm {

/// First residual of a block, and the one behind its last.
using ResidualBlock = std::pair<Eigen::Index, Eigen::Index>;

struct ParameterReplicates {
  Eigen::MatrixXd around;          ///< (parameters, replicates): scatter as the estimates do
  Eigen::MatrixXd widened;         ///< the same with deviations by Student's t in place of the normal distribution's
  bool rest_on_one_block = false;  ///< of a parameter: its errors are those of white noise
};

/// Wild bootstrap of the scores of blocks (Kline and Santos 2012, J. Econometric Methods 1, 23): the gradient J_k^T r_k
/// of each block is weighed by a standard normal number, and the parameters follow by one Gauss-Newton step with the
/// sensitivities of all blocks. Blocks keep what neighbouring residuals have in common; they are as long as that. The
/// scores are first rid of what the fit took from them, (I - H_k)^(-1/2) with the block's leverage H_k, and where few
/// blocks know of a parameter its Student's t has their effective number of degrees of freedom (Bell and McCaffrey
/// 2002, Survey Methodology 28, 169). Blocks that are drawn together with their sensitivities make intervals several
/// times too wide there: a draw may lack those blocks. Where one block alone knows of a parameter nothing is left of
/// its score: the noise then counts as white, of the variance of all residuals, with one degree of freedom. x: the
/// estimates (p); residuals: (n), J: their sensitivities (n, p); confidence: of the intervals, as 0.95.
ParameterReplicates parameter_replicates(const Eigen::VectorXd& x, const Eigen::VectorXd& residuals,
                                         const Eigen::MatrixXd& J, std::span<const ResidualBlock> blocks, int number,
                                         double confidence, std::uint64_t seed);

/// Sets the intervals of the fit's estimates by percentiles of the replicates of each value, and its standard errors
/// and correlations by their scatter.
void set_intervals(OutputErrorFit& fit, const ParameterCoordinates& coordinates, const ParameterReplicates& replicates,
                   double confidence);

}  // namespace pfdm
