#include "cases/program/plate/plate_words.h"

#include "solver/dynamics/mode_waves.h"
#include "solver/momentum/bending/bending_layers.h"

#include <fmt/format.h>

namespace pfdm {

std::optional<std::string> words_on_layers(const Mesh& mesh, const Unknowns& unknowns) {
  const auto worst = largest_bending_error(mesh, unknowns);
  if (!worst) return std::nullopt;
  if (worst->layers.n < 2.0)
    return "1 layer of hexahedra: it hardly resists bending, and frequencies are wrong. Take four layers ([mesh])";
  if (unknowns.pressure_cells.empty()) return std::nullopt;
  return fmt::format(
      "{:g} layers of hexahedra at nu = {:g}: where cells carry a pressure, above nu = 0.47, frequencies of modes that "
      "bend the body are 2 to 3 % too low with five to ten layers. Take ten ([mesh])",
      worst->layers.n, worst->poisson_ratio);
}

std::optional<std::string> words_on_half_waves(const PlateRun& run, std::span<const Resonance> resonances,
                                               double highest) {
  constexpr double enough = 8.0;
  std::optional<HalfWaves> worst;
  std::size_t of_mode = 0;
  for (std::size_t k = 0; k < resonances.size() && resonances[k].frequency <= highest; ++k) {
    const auto here = fewest_cells_to_half_wave(run.body(), run.modes()[k]);
    if (!here || (worst && worst->cells <= here->cells)) continue;
    worst = here;
    of_mode = k;
  }
  if (!worst || worst->cells >= enough) return std::nullopt;
  return fmt::format(
      "mode {} has {:.1f} cells to a half wave along {}: frequencies of such modes are up to {:.0f} % too low, beside "
      "clamps up to twice that. For {:.0f} %: {:.1f} times as many cells along {} ([mesh])",
      of_mode + 1, worst->cells, "xyz"[worst->axis], 100.0 * most_error_by_half_waves(worst->cells),
      100.0 * most_error_by_half_waves(enough), enough / worst->cells, "xyz"[worst->axis]);
}

}  // namespace pfdm
