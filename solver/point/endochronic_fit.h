#pragma once
// The endochronic law as a forward model: measured strains drive it, its stresses are compared with measured ones; or,
// as in creep, measured stresses drive it and its strains are compared.

#include "solver/calibration/calibration.h"
#include "solver/point/mixed_control.h"

#include <string>
#include <vector>

namespace pfdm {

/// A test on a material point that began as virgin material.
struct MaterialExperiment {
  struct Channel {
    int component = 0;           ///< 0 ... 5
    std::vector<double> values;  ///< measured, at the times of the loading: stress [Pa] or (tensor) strain
    double noise = 0.0;          ///< standard deviation, as the values; 0: not known
  };
  std::string name;
  LoadSegment loading;  ///< measured strains (stresses) that are followed; the other pairs are free of stress
  std::vector<Channel> channels;
  bool follows_stress = false;  ///< its channels are strains
};

/// What is estimated; f_0 is not, so that the scale of the intrinsic time is fixed by f(0) = f_0.
struct FitChoice {
  bool kernel = true;
  bool hardening =
      true;  ///< parameters of the hardening law; of a table, f at all points but the first: f_2 ..., f_1_2 ...
  bool rate = false;  ///< parameters of the rate factor but for its reference rate
  bool young_modulus = false;
};

/// The chosen parameters of the law, all on a logarithmic scale: C_1 [Pa], alpha_1, ..., f_inf, b ...
std::vector<FitParameter> fit_parameters(const EndochronicLaw& law, const FitChoice& choice);
/// The law with these values; nothing if they make no law.
std::optional<EndochronicLaw> with_values(const EndochronicLaw& law, const FitChoice& choice,
                                          std::span<const double> values);

/// What the channels of one experiment would measure; nothing where the law cannot follow.
std::optional<std::vector<std::vector<double>>> respond(const EndochronicLaw& law, const MaterialExperiment& experiment,
                                                        const ControlSettings& settings = {});

/// Whether every channel says how noisy it is.
bool noise_is_known(const std::vector<MaterialExperiment>& experiments);

/// Model less measurement over the noise, or over the rms of all measured stresses (strains) where the noise is not
/// known.
std::optional<std::vector<double>> fit_residuals(const EndochronicLaw& law,
                                                 const std::vector<MaterialExperiment>& experiments,
                                                 const ControlSettings& settings = {});

/// How many values were measured in all.
std::size_t n_measured(const std::vector<MaterialExperiment>& experiments);
/// Rms of all measured stresses [Pa]; of those experiments that measure strains, their rms.
double rms_measured(const std::vector<MaterialExperiment>& experiments, bool strains = false);
/// Rms of model less measurement of one experiment [Pa, or strain]; infinite where the law cannot follow.
double rms_misfit(const EndochronicLaw& law, const MaterialExperiment& experiment,
                  const ControlSettings& settings = {});
/// Of all stresses [Pa].
double rms_misfit(const EndochronicLaw& law, const std::vector<MaterialExperiment>& experiments,
                  const ControlSettings& settings);
/// Rms of model less measurement, of stresses over their rms and of strains over theirs.
double relative_misfit(const EndochronicLaw& law, const std::vector<MaterialExperiment>& experiments,
                       const ControlSettings& settings);

struct LawFit {
  EndochronicLaw law;
  FitChoice choice;
  std::vector<FitParameter> parameters;
  FitResult result;
};

/// Least squares over all experiments from the values of `law` on; kernel terms come back with falling alpha.
/// `limits`: parameters whose bounds replace those by default, found by name.
LawFit fit_law(const EndochronicLaw& law, const FitChoice& choice, const std::vector<MaterialExperiment>& experiments,
               const std::vector<FitParameter>& limits, const FitSettings& settings,
               const ControlSettings& control = {});

}  // namespace pfdm
