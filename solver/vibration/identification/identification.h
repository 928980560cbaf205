#pragma once
// Identification of the mass-material model from vibration records: the parameters with which the equation, or its
// solution, fits the measurements. Methods (the report is AFRL-RW-EG-TR-2016-088):
//
//   regress_states     the report's continuous-time least squares (A4.2): the terms of the equation of motion are the
//                      columns of a linear system; with one kernel term by its third-order equation
//   regress_ten_steps  the report's iteration for more terms (A4.3)
//   regress_separable  any number of terms: for given rates alpha their convolutions are columns too
//   refine_output      output error: the simulated response to the measured base acceleration is to be the measured
//                      one, all records at once
//   identify           the whole: separable start, output error, order of the kernel by BIC, intervals by bootstrap

#include "physics/point/mass_material.h"
#include "solver/calibration/calibration.h"
#include "solver/vibration/simulation/vibration_record.h"

#include <Eigen/Core>

#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace pfdm {

struct IdentificationSettings {
  double mass = 1.0;                ///< known [kg]
  double reference_velocity = 1.0;  ///< V of the model [m/s]
  std::optional<int> kernel_order;  ///< none: by BIC
  int maximum_kernel_order = 4;
  double crop = 0.05;    ///< of each record, at either end
  int replicates = 500;  ///< of the bootstrap
  double confidence = 0.95;
  std::uint64_t seed = 1;                                                   ///< of the bootstrap
  std::function<void(const std::string&)> say = [](const std::string&) {};  ///< told what is being done
};

/// Parameters that fit a linear system of the equation's terms.
struct Regression {
  MassMaterial model;
  double misfit = 0.0;  ///< norm of the residual over that of the left side
};

/// For structures without kernel, or with a single term.
Regression regress_states(std::span<const VibrationRecord> records, const ModelStructure& structure,
                          const IdentificationSettings& settings);

/// None if no choice of rates gives `kernel_order` terms that all dissipate.
std::optional<Regression> regress_separable(std::span<const VibrationRecord> records, const ModelStructure& structure,
                                            int kernel_order, const IdentificationSettings& settings);

/// The report's iteration for kernels of higher order (A4.3): Prony series of `prony_order` terms, cut to
/// `kernel_order` by energy. Takes the first record alone. For comparison: it stops near where it starts.
Regression regress_ten_steps(std::span<const VibrationRecord> records, const ModelStructure& structure,
                             int kernel_order, const IdentificationSettings& settings, int prony_order = 40,
                             int maximum_iterations = 100);

struct Estimate {
  std::string name;  ///< "k1_N_per_m", "alpha1_per_s" ...
  std::string unit;  ///< "N/m", "1/s" ...
  double value = 0.0;
  double lower = 0.0;  ///< of the interval
  double upper = 0.0;
  double standard_error = 0.0;
  double lower_bound = -std::numeric_limits<double>::infinity();  ///< of the search
  double upper_bound = std::numeric_limits<double>::infinity();
  bool at_bound = false;
};

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

struct OrderTrial {
  int kernel_order = 0;  ///< number of terms, a pair counting one
  double bic = 0.0;
  double misfit = 0.0;
  bool pair = false;  ///< one of the terms is a conjugate pair
};
struct Identification {
  OutputErrorFit fit;
  Regression start;
  std::vector<OrderTrial> orders;       ///< that were tried
  Passivity passivity;                  ///< over the excited band
  std::vector<InitialMotion> starts{};  ///< of each record; none where all begin at rest
};

/// Records that begin in motion are told from the others by what the model leaves, and the motion is estimated with the
/// parameters. Throws ComputationError if no parameters can be found.
Identification identify(std::span<const VibrationRecord> records, const ModelStructure& structure,
                        const IdentificationSettings& settings);

/// The model's answer z'' to the record's base acceleration [m/s^2]; NaN where it is unbounded. It begins at rest, or
/// with the motion that a record has which begins in motion (identification_initial_motion.h).
Eigen::VectorXd predicted_response(const MassMaterial& model, const VibrationRecord& record, double crop = 0.05);

/// Relative misfit of the model's response to the record's base acceleration: norm of the difference of z'' over that
/// of the measured one, within the excited band and its harmonics.
double prediction_misfit(const MassMaterial& model, const VibrationRecord& record, double crop);

/// The values that a user asks for, units in their names too; bounds equal to the value.
std::vector<Estimate> named_values(const MassMaterial& model);

/// What records excite together.
struct ExcitedRange {
  double low, high;     ///< [Hz]
  double velocity;      ///< the largest [m/s]
  double displacement;  ///< the largest [m]
};
ExcitedRange excited_range(std::span<const VibrationRecord> records);

/// Over the band that the records excite, at the largest velocity in them.
Passivity passivity_in_band(const MassMaterial& model, std::span<const VibrationRecord> records);

/// What a record's motion reaches away from its ends; for what depends on the test's level.
struct PeakMotion {
  double displacement = 0.0;  ///< [m]
  double velocity = 0.0;      ///< [m/s]
};
PeakMotion peak_motion(const VibrationRecord& record);

}  // namespace pfdm
