// Statistics of the joint calibration on synthetic data, long: run by hand, its figures stand in log_histories.md.
//
//   endochronic_recovery [repetitions] [points of the experiment]

#include "physics/error.h"
#include "solver/parallel.h"
#include "solver/point/endochronic_identification.h"
#include "tests/solver/synthetic_experiments.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace pfdm {
namespace {

struct Tally {
  std::string name;
  double truth = 0.0;
  int covered = 0;
  std::vector<double> errors;  // relative
};

std::vector<Tally> tallies_of(const EndochronicLaw& truth, const FitChoice& choice) {
  std::vector<Tally> tallies;
  for (const FitParameter& p : fit_parameters(truth, choice)) tallies.push_back({p.name, p.first, 0, {}});
  return tallies;
}

EndochronicLaw first_guess() {
  EndochronicLaw law = three_term_law();
  law.kernel = {{40e9, 2000.0}, {25e9, 300.0}, {3e9, 50.0}};
  law.hardening.with_path = saturating(2.0, 10.0);
  return law;
}

double percentile(std::vector<double> values, double part) {
  std::ranges::sort(values);
  return values[static_cast<std::size_t>(part * static_cast<double>(values.size() - 1))];
}

void study(double noise, int repetitions, int points) {
  const EndochronicLaw truth = three_term_law();
  const std::vector<MaterialExperiment> clean{measured(truth, eight_cycles(points), {0}, 0.0, 1)};
  double peak = 0.0;
  for (const double sigma : clean[0].channels[0].values) peak = std::max(peak, std::abs(sigma));
  std::vector<Tally> tallies = tallies_of(truth, {});
  std::vector<double> curve;
  for (int i = 0; i < repetitions; ++i) {
    const std::vector<MaterialExperiment> data{
        measured(truth, eight_cycles(points), {0}, noise, 1000 + static_cast<unsigned>(i))};
    const LawFit fitted = identification_method("joint").identify(first_guess(), data, {}).fit;
    for (std::size_t j = 0; j < tallies.size(); ++j) {
      const FitEstimate& e = fitted.result.estimates[j];
      tallies[j].covered += e.lower_95 <= tallies[j].truth && tallies[j].truth <= e.upper_95 ? 1 : 0;
      tallies[j].errors.push_back(std::abs(e.value / tallies[j].truth - 1.0));
    }
    curve.push_back(rms_misfit(fitted.law, clean, {}));
  }
  fmt::print("noise {:.3g} Pa ({:.2g} % of the peak), {} points, {} repetitions; curve off by {:.3g} Pa rms (median)\n",
             noise, 100.0 * noise / peak, points, repetitions, percentile(curve, 0.5));
  int covered = 0;
  for (const Tally& t : tallies) {
    covered += t.covered;
    fmt::print("  {:<8} covered {:5.1f} %, error median {:.3g} %, 90 % below {:.3g} %\n", t.name,
               100.0 * t.covered / repetitions, 100.0 * percentile(t.errors, 0.5), 100.0 * percentile(t.errors, 0.9));
  }
  fmt::print("  all      covered {:5.1f} %\n", 100.0 * covered / (repetitions * static_cast<double>(tallies.size())));
  std::fflush(stdout);
}

}  // namespace
}  // namespace pfdm

int main(int argc, char** argv) {
  const int repetitions = argc > 1 ? std::atoi(argv[1]) : 100;
  const int points = argc > 2 ? std::atoi(argv[2]) : 331;
  for (const double noise : {0.1e6, 0.5e6, 1.0e6}) pfdm::study(noise, repetitions, points);
}
