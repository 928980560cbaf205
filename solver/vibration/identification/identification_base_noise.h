#pragma once
// Noise on the base's acceleration drives the simulated mass, not the real one. Least squares of the response then
// finds estimates that respond less than the sample does. Under a swept sine the noise is taken off before; otherwise
// its level is estimated from the residuals, in which it has passed the resonance, and its effect on the estimates
// taken back to first order (bias-compensated least squares: Stoica, Soderstrom, Int. J. Control 36 (1982) 1019).

#include "solver/vibration/identification/identification_coordinates.h"

#include <Eigen/Core>

#include <optional>
#include <span>

namespace pfdm {

/// Densities of white noise on both channels [m^2/s^4/Hz]: those with which |residual|^2 = relative + base |H|^2 fits
/// best over the compared band. H: of the model about z = 0, at the velocity amplitude `velocity` [m/s].
struct ChannelNoise {
  double relative = 0.0;
  double base = 0.0;
};
ChannelNoise channel_noise(const MassMaterial& model, const VibrationRecord& record, double crop, double velocity,
                           const Eigen::VectorXd& residual);

/// What the base's noise has added to the coordinates x; zero of records under swept sines, nothing
/// if it is too much for the first order. `weighted`: residuals of
/// all records below each other, those of a record over the rms of its response; `jacobian`: d weighted / d x.
std::optional<Eigen::VectorXd> base_noise_bias(std::span<const VibrationRecord> records,
                                               const ParameterCoordinates& coordinates, const Eigen::VectorXd& x,
                                               const Eigen::VectorXd& weighted, const Eigen::MatrixXd& jacobian,
                                               double crop);

}  // namespace pfdm
