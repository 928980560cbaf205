#pragma once
// Output error: the simulated response to the measured base acceleration is to be the measured one, all records at
// once.

#include "physics/point/mass_material.h"
#include "solver/calibration/calibration.h"
#include "solver/vibration/identification/identification_values.h"
#include "solver/vibration/simulation/vibration_record.h"

#include <Eigen/Core>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace pfdm {

struct OutputErrorFit {
  MassMaterial model;
  std::vector<Estimate> estimates;
  Eigen::MatrixXd correlation;     ///< of the estimates, from the bootstrap
  std::vector<FitIteration> path;  ///< values in the order of the estimates; rms relative to that of the records
  int evaluations = 0;             ///< simulated responses to all records
  std::size_t n_residuals = 0;
  std::vector<double> record_misfit;  ///< of each record: norm of simulated minus measured z'' over that of measured
  double bic = 0.0;
  bool converged = false;
  std::vector<std::string> doubts{};  ///< what the estimates cannot be rid of
};

/// `start` gives the terms as well; `is_near`: it is where approach_output() ended.
OutputErrorFit refine_output(std::span<const VibrationRecord> records, const MassMaterial& start,
                             const IdentificationSettings& settings, bool is_near = false);

/// Roughly, to compare models: as few samples and iterations as that takes, no intervals. `rival`: an information that
/// is to be surpassed; a search that would not at its pace ends early.
OutputErrorFit approach_output(std::span<const VibrationRecord> records, const MassMaterial& start,
                               const IdentificationSettings& settings, std::optional<double> rival = std::nullopt);

}  // namespace pfdm
