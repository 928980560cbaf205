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

}  // namespace pfdm
