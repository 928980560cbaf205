#pragma once
// Ways to identify the endochronic law from experiments: kernel alone, hardening alone from the transient response, the
// two alternately (the staggered scheme of AFRL-RW-EG-TR-2016-088, A5.2.3), and both at once by least squares.
//
// The transient response is differentiated data, in whose path noise adds up: what it gives is biased, and the
// alternating scheme need not settle. Both are where least squares of the stresses start, which have the last word.

#include "solver/point/endochronic_transient.h"

#include <functional>
#include <optional>

namespace pfdm {

struct EndochronicIdentificationSettings {
  /// The stresses are exact to rounding, so that short one-sided differences do.
  FitSettings fit{.maximum_iterations = 60, .tolerance = 1e-9, .differences = Differences::forward, .step = 1e-7};
  ControlSettings control{};
  FitChoice choice{};
  std::vector<FitParameter> limits{};  ///< bounds and priors by name
  int least_terms = 0;                 ///< 0: as many as the law has, from its values
  int most_terms = 0;
  int maximum_rounds = 30;        ///< of the staggered scheme
  double round_tolerance = 1e-4;  ///< relative change of the rms misfit between rounds
  std::function<void(const std::string&)> say = [](const std::string&) {};
};

/// A number of kernel terms that was tried.
struct TriedKernel {
  int n_terms = 0;
  double rms = 0.0;          ///< [Pa]
  double information = 0.0;  ///< Bayesian; the least is chosen
};

/// A round of the staggered scheme.
struct StaggeredRound {
  double rms_after_hardening = 0.0;  ///< [Pa]
  double rms_after_kernel = 0.0;     ///< [Pa]
  double misfit = 0.0;               ///< after the kernel, of stresses and strains, relative to their rms
};

struct EndochronicIdentification {
  LawFit fit;
  std::vector<TriedKernel> tried;
  std::vector<StaggeredRound> rounds;
  std::vector<std::vector<HardeningPoint>> transients;  ///< of each experiment, where the method uses them
  std::string remark{};  ///< how the method came to its estimates, where that is not plain
};

struct IdentificationMethod {
  std::string_view name;
  std::string_view description;
  EndochronicIdentification (*identify)(const EndochronicLaw& law, const std::vector<MaterialExperiment>& experiments,
                                        const EndochronicIdentificationSettings& settings);
};
std::span<const IdentificationMethod> identification_methods();
/// Throws InputError naming those there are.
const IdentificationMethod& identification_method(std::string_view name);

/// By how many of its standard errors an estimate may be off, at most, because the model takes the increments of the
/// curves as its steps: norm of what quarter steps change in the residuals, over their standard deviation (1 where the
/// noise is known). Nothing where the law cannot follow.
std::optional<double> effect_of_steps(const LawFit& fit, const std::vector<MaterialExperiment>& experiments,
                                      const ControlSettings& control);

/// The law, or with the kernel's C larger by one factor, so that it bears the stresses of the experiments that follow
/// them; `settings.say` is told. Throws InputError that names an experiment whose stresses it does not bear, where the
/// kernel is not estimated or a factor of 100 does not do.
EndochronicLaw law_that_bears(const EndochronicLaw& law, const std::vector<MaterialExperiment>& experiments,
                              const EndochronicIdentificationSettings& settings);

/// Divides the increments of the curves further, and fits again from the estimates on, until what steps of a quarter
/// change would move no estimate by more than 0.1 of its standard errors, or 16 steps an increment are reached.
/// `control`: of the fit that was done; comes back with the steps of the last one. Fits that leave no noise, below 1e-4
/// of the data, stay as they are: such curves were computed with these steps. So do those that leave three times the
/// stated noise: they are wrong.
void divide_steps(EndochronicIdentification& found, const std::vector<MaterialExperiment>& experiments,
                  const EndochronicIdentificationSettings& settings, ControlSettings& control);

}  // namespace pfdm
