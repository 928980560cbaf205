#pragma once
// The mass-material equation in time. Two ways that know nothing of each other, so that one can test the other:
// simulate() steps with error control and is what a run does; simulate_batch() takes fixed steps, for several
// neighbouring models at once, and is what an identification calls thousands of times.

#include "physics/point/mass_material.h"
#include "solver/vibration/simulation/vibration_excitation.h"
#include "solver/vibration/simulation/vibration_record.h"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace pfdm {

/// Beyond this displacement [m] the mass has run away: samples are centimetres tall.
constexpr double runaway_displacement = 10.0;

/// Motion relative to the base at the samples; it starts at rest.
struct Motion {
  double rate = 0.0;             ///< [Hz]
  Eigen::VectorXd base;          ///< y'' [m/s^2]
  Eigen::VectorXd displacement;  ///< z [m]
  Eigen::VectorXd velocity;      ///< z' [m/s]
  Eigen::VectorXd acceleration;  ///< z'' [m/s^2]
  bool bounded = true;           ///< false: the mass ran away, and the rest is NaN
};

/// Boost.Odeint's Runge-Kutta-Fehlberg 7(8) with relative error control of each step.
Motion simulate(const MassMaterial& model, const Excitation& excitation, double rate, double tolerance = 1e-10);

/// Steps of the size that the fixed-step scheme needs for its error to stay below about 1e-7 of the motion: fast
/// kernel terms and a fast resonance need several per sample.
int substeps_for(const MassMaterial& model, double rate);

/// One model under one base acceleration; both outlive the simulation.
struct SimulationRun {
  const MassMaterial* model = nullptr;
  const BaseNodes* base = nullptr;
  InitialMotion start{};  ///< kernel states begin at zero
};

/// Runs as they are best simulated together: side by side in vector registers. Their models must have the same terms,
/// their bases the same substeps; rates and durations may differ.
std::vector<std::vector<SimulationRun>> simulation_groups(std::span<const SimulationRun> runs);

/// Relative accelerations [m/s^2] of the runs of a group. One that is unbounded is NaN.
std::vector<Eigen::VectorXd> simulate_group(std::span<const SimulationRun> runs);

/// The same of several models under one base acceleration, a column each.
Eigen::MatrixXd simulate_batch(std::span<const MassMaterial> models, const BaseNodes& base,
                               const InitialMotion& start = {});
/// The same of one model from several initial motions.
Eigen::MatrixXd simulate_starts(const MassMaterial& model, const BaseNodes& base,
                                std::span<const InitialMotion> starts);

/// Adds Gaussian noise, white up to half the rate, of `decibel` below each channel's own rms.
void add_noise(VibrationRecord& record, double decibel, std::uint64_t seed);

}  // namespace pfdm
