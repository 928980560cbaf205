#pragma once
// Discrete Fourier transforms of real signals, any length. The only place that knows FFTW. Plans are made by estimate,
// so that the same input gives the same bits each time; calls from several threads are in order.

#include <Eigen/Core>

namespace pfdm {

/// X_k = sum_n x_n exp(-2 pi j k n / N), k = 0 ... N/2.
Eigen::VectorXcd fourier(const Eigen::Ref<const Eigen::VectorXd>& x);
/// The real signal of length n whose transform this is; spectrum has n/2 + 1 entries.
Eigen::VectorXd inverse_fourier(const Eigen::VectorXcd& spectrum, Eigen::Index n);

/// The least number >= n with no prime factor above 5: lengths that transform fast.
Eigen::Index fast_length(Eigen::Index n);

}  // namespace pfdm
