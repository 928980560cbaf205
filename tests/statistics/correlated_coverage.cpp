// How often intervals hold the truth where residuals are correlated; its figures stand in README.md.
//
//   correlated_coverage NUMBER

#include "postproc/fits/fit_judgement.h"
#include "tests/solver/noisy_bar.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>

namespace {

using namespace pfdm;

struct Counts {
  int sound = 0, widened = 0;
  std::array<int, 3> held{}, held_as_if_white{};
};

Counts repeated(const std::string& kind, std::size_t n, int number) {
  Counts counts;
  std::mt19937_64 engine(1);
  for (int i = 0; i < number; ++i) {
    const FitProblem problem = noisy_bar::problem(noisy_bar::noise(kind, n, engine));
    const FitResult result = fit(problem, {.step = 1e-4});
    FitFindings found = findings_of(problem.parameters, result);
    judge(found, {.series = {{.name = "bar", .along = "displacement", .values = result.residuals}},
                  .result = &result,
                  .misfit = result.rms});
    counts.sound += found.verdict == Verdict::sound ? 1 : 0;
    counts.widened += found.verdict == Verdict::correlated ? 1 : 0;
    for (std::size_t j = 0; j < 3; ++j) {
      const double truth = noisy_bar::truth[j];
      const FittedParameter& p = found.parameters[j];
      const FitEstimate& white = result.estimates[j];
      if (!is_sound(found.verdict)) continue;
      counts.held[j] += p.lower < truth && truth < p.upper ? 1 : 0;
      counts.held_as_if_white[j] += white.lower_95 < truth && truth < white.upper_95 ? 1 : 0;
    }
  }
  return counts;
}

}  // namespace

int main(int argc, char** argv) {
  const int number = argc > 1 ? std::atoi(argv[1]) : 1000;
  fmt::print(
      "| noise | points | sound, with correlated residuals, not | E, ft, Gc held in % of those with intervals | "
      "by independent residuals |\n|---|---|---|---|---|\n");
  for (const char* kind : {"white", "ar 0.15", "ar 0.3", "ar 0.6", "ar 0.8", "ar 0.9", "slow", "steps", "mesh"})
    for (const std::size_t n : {60u, 100u, 200u, 400u}) {
      const Counts c = repeated(kind, n, number);
      const double all = std::max(1, c.sound + c.widened), percent = 100.0 / all;
      fmt::print("| {} | {} | {}, {}, {} | {:.1f}, {:.1f}, {:.1f} | {:.1f}, {:.1f}, {:.1f} |\n", kind, n, c.sound,
                 c.widened, number - c.sound - c.widened, percent * c.held[0], percent * c.held[1], percent * c.held[2],
                 percent * c.held_as_if_white[0], percent * c.held_as_if_white[1], percent * c.held_as_if_white[2]);
    }
}
