#pragma once
// What a fit found: parameters with their intervals, its verdict, and how it meets curves, events and fields. The same
// for every kind of case.

#include "postproc/curves/measured_curve.h"
#include "solver/calibration/calibration_statistics.h"
#include "solver/calibration/calibration_verdict.h"

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace pfdm {

/// 95 % interval by profile likelihood (solver/calibration/profile_likelihood.h).
struct FittedProfile {
  double lower = 0.0, upper = 0.0;
  bool lower_open = false, upper_open = false;  ///< the data allow everything up to the bound
};

struct FittedParameter {
  std::string name;
  std::string unit;
  double estimate = 0.0;
  double standard_error = 0.0;      ///< by noise alone; not finite where it is not known, as the interval
  double lower = 0.0, upper = 0.0;  ///< of the noise, and of what a finer discretisation moves
  double first_guess = std::numeric_limits<double>::quiet_NaN();  ///< NaN if there was none
  double lower_bound = -std::numeric_limits<double>::infinity();
  double upper_bound = std::numeric_limits<double>::infinity();
  bool at_bound = false;
  bool log_scale = false;
  std::optional<FittedProfile> profile = std::nullopt;
  std::optional<SampledInterval> posterior = std::nullopt;  ///< solver/calibration/posterior.h
  double widened_by = 1.0;  ///< standard error and interval, for residuals that are correlated or scatter unevenly
  double freedom = std::numeric_limits<double>::infinity();  ///< of Student's t, where widened
  /// How far a finer discretisation moves the estimate, to first order; NaN: it was not tried.
  double moved_by_finer = std::numeric_limits<double>::quiet_NaN();
};

/// A smooth discrepancy of the model in the posterior (solver/calibration/residual_likelihood.h).
struct DiscrepancyFindings {
  std::string file;             ///< over displacement
  SampledInterval amplitude{};  ///< of its force [N]
  SampledInterval length{};     ///< over which it varies [m]
};

/// What the posterior of all parameters together rests on.
struct PosteriorFindings {
  std::string file;                      ///< of samples
  double emulator_error = 0.0;           ///< of the logarithm
  double effective = 0.0;                ///< number of independent samples
  int evaluations = 0;                   ///< of the model
  std::vector<std::string> law_files{};  ///< of traction over separation, one for each interface
  std::optional<DiscrepancyFindings> discrepancy = std::nullopt;
};

/// What a fit, or a stage of one, found.
struct FitFindings {
  Verdict verdict = Verdict::sound;
  std::vector<std::string> reasons{};  ///< why it is not sound
  bool converged = false;
  std::string message{};  ///< what ended the fit
  std::vector<FittedParameter> parameters{};
  Eigen::MatrixXd correlation{};  ///< empty if not known
  std::size_t n_residuals = 0;
  double rms = 0.0;                                ///< of the residuals
  std::optional<double> first_rms = std::nullopt;  ///< with the first guess
  bool noise_is_known = false;                     ///< and the residuals are divided by its standard deviation
  int evaluations = 0;                             ///< of the model
  std::vector<std::string> warnings{};
  std::vector<FitIteration> starts{};    ///< what each start came to
  std::vector<FitIteration> path{};      ///< of the best start
  std::vector<FitIteration> screened{};  ///< points of a sample
  std::optional<PosteriorFindings> posterior = std::nullopt;
  std::string sensitivity_file{};  ///< by how much each parameter moves each part of the curve; empty: none
  std::string finer{};             ///< the finer discretisation; empty: none was tried
  bool is_discretised = false;     ///< the model has a mesh or steps that could be finer
};
FitFindings findings_of(const std::vector<FitParameter>& parameters, const FitResult& result);

/// Data and how well the estimates meet them.
struct ExperimentMisfit {
  struct Absolute {
    double rms = 0.0;           ///< of model less measurement [unit]
    double rms_measured = 0.0;  ///< [unit]
    std::string quantity;       ///< that was measured
    std::string unit;
  };
  std::string name;
  bool fitted = true;  ///< false: predicted only
  std::size_t n_data = 0;
  double relative = 0.0;                            ///< of the measured rms
  std::optional<Absolute> absolute = std::nullopt;  ///< where it is known
  std::string curve{};                              ///< file with both curves, if there is one
  std::vector<std::string> preparation{};           ///< what was done to the measured curve
};
ExperimentMisfit experiment_misfit(std::string name, std::size_t n_data, const ExperimentMisfit::Absolute& absolute,
                                   std::string curve);

/// An event of a measured curve, and of the fitted one.
struct FittedEvent {
  struct Figure {
    std::string name;                                             ///< "displacement"
    std::string unit;                                             ///< "m"
    double measured = std::numeric_limits<double>::quiet_NaN();   ///< NaN: not measured, as its deviation
    double deviation = std::numeric_limits<double>::quiet_NaN();  ///< standard deviation
    double computed = 0.0;
    double residual =
        std::numeric_limits<double>::quiet_NaN();  ///< computed less measured, in deviations; NaN: no datum
  };
  std::string name;  ///< "jump 1"
  std::string specimen;
  bool is_found = false;  ///< in the record
  bool is_there = false;  ///< in the fitted curve; otherwise what is computed stands for it
  SetUp set_up{};         ///< what it adds to the figures: they are those of the record
  std::vector<Figure> figures{};
  double figure(const std::string& name, double Figure::*value) const;  ///< NaN if it has none of this name
};

/// Tables of fields are called fit_field_0.csv and so on.
inline constexpr const char* field_tables = "fit_field_";

/// A field of measured displacements, and how the fit meets it.
struct FittedField {
  struct Frame {
    std::string name;
    double displacement = 0.0;  ///< of the record [m]
    std::size_t places = 0;
    double rms = 0.0, rms_measured = 0.0;  ///< of a component; of computed less measured and of measured [m]
  };
  std::string name;
  std::string specimen;
  std::string file;                    ///< of its table
  double pitch = 0.0;                  ///< of the places [m]
  std::size_t n_data = 0;              ///< without rigid motions
  double deviation = 0.0;              ///< of a component of one point, with which it counts [m]
  double stated = 0.0;                 ///< as the case says; 0: not stated
  double inflation = 1.0, over = 0.0;  ///< for correlated residuals, and the length over which they are [m]
  bool over_frames = false;
  std::vector<Frame> frames{};
};

/// A part of a fit, with some of the parameters and of the data.
struct FitStage {
  std::string name;
  double from = 0.0, to = 0.0;  ///< displacements [m]
  FitFindings found;
};

}  // namespace pfdm
