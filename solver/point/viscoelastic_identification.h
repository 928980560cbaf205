#pragma once
// How many Prony branches tests show, and which: fits with each number, and the fewest branches whose Bayesian
// information criterion is within two of the least (Kass, Raftery, J. Am. Stat. Assoc. 90 (1995) 773), among those that
// the data determine unless others meet them much better.

#include "solver/point/viscoelastic_fit.h"

#include <functional>
#include <string>
#include <vector>

namespace pfdm {

enum class BranchTimes {
  free,  ///< estimated
  fixed  ///< of the law, or evenly over the window of the data
};

struct ViscoelasticSettings {
  FitSettings fit{.maximum_iterations = 400, .tolerance = 1e-9, .cost_tolerance = 1e-9};
  ViscoelasticChoice choice{};
  std::vector<FitParameter> limits{};  ///< bounds by name
  int least_branches = 0;              ///< 0: as many as the law has, from its values
  int most_branches = 0;
  std::function<void(const std::string&)> say = [](const std::string&) {};
};

/// A number of branches that was tried.
struct TriedBranches {
  int n_branches = 0;
  double rms = 0.0;          ///< of the residuals over the noise
  double information = 0.0;  ///< Bayesian
  std::string objection;     ///< why the data do not determine them; empty: they do
};

struct ViscoelasticIdentification {
  ViscoelasticFit fit;
  std::vector<TriedBranches> tried{};
  std::vector<double> deviations{};   ///< of each measured value, by which the residuals are divided
  std::vector<std::string> doubts{};  ///< what the data leave open: an objection to the branches that were chosen
};

/// What of a fit's branches lies, or by its interval may lie, outside of the window of the data, or is not determined;
/// empty: nothing, or times that are not estimated.
std::string objection_to(const ViscoelasticFit& fit, const TimeWindow& window);

/// Throws NoConvergence if no number of branches can be fitted, InputError if the problem makes no sense.
ViscoelasticIdentification identify(const PronyLaw& law, const ViscoelasticExperiments& experiments,
                                    const ViscoelasticSettings& settings);

}  // namespace pfdm
