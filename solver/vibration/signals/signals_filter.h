#pragma once
// Filters without phase, integration and envelopes, all by Fourier transform. Signals are taken as periodic, so that
// their first and last parts, up to a few periods of the lowest frequency that passes, are not to be used.

#include <Eigen/Core>

#include <cmath>
#include <limits>

namespace pfdm {

/// Root mean square.
inline double rms(const Eigen::VectorXd& x) { return x.norm() / std::sqrt(static_cast<double>(x.size())); }

/// What passes: everything from low to high [Hz]; beside it the gain falls to zero as a cosine squared, over `skirt` of
/// the edge's frequency.
struct PassBand {
  double low = 0.0;
  double high = std::numeric_limits<double>::infinity();
  double skirt = 0.3;
  double gain(double frequency) const;
};

Eigen::VectorXd filtered(const Eigen::VectorXd& x, double rate, const PassBand& band);

/// Integrates (order 1, 2), keeps (0) or differentiates (-1): the spectrum is divided by (j omega)^order within the
/// band. With order > 0 the band must leave zero frequency out.
Eigen::VectorXd integrated(const Eigen::VectorXd& x, double rate, int order, const PassBand& band);

/// x + j H[x], H the Hilbert transform: modulus is the envelope, argument the phase.
Eigen::VectorXcd analytic_signal(const Eigen::VectorXd& x);
Eigen::VectorXd envelope(const Eigen::VectorXd& x);

/// Unwrapped phase [rad] of a sine that drives: that of the signal within the band.
Eigen::VectorXd driving_phase(const Eigen::VectorXd& x, double rate, const PassBand& band);

/// The response at multiples of the driving frequency along a sweep (the report's fig. 16(b)): complex amplitudes
/// a_h(t) with x = sum_h Re[a_h exp(j h phase)], h = 1 ... n, a column each. Each is what a filter of +-`bandwidth`
/// [Hz] leaves that moves with the frequency (the signal is turned back by the phase, then low-passed).
Eigen::MatrixXcd harmonics(const Eigen::VectorXd& x, double rate, const Eigen::VectorXd& phase, int n,
                           double bandwidth);

/// The sweep alone, without the noise beside its frequency: its amplitude within `bandwidth` [Hz], turned forward
/// again; likewise of two harmonics, where they stand out of the noise.
Eigen::VectorXd tracked_sweep(const Eigen::VectorXd& x, double rate, const PassBand& band, double bandwidth);

}  // namespace pfdm
