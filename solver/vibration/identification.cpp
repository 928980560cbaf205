#include "solver/vibration/identification.h"

#include "physics/error.h"
#include "solver/vibration/identification_stiffness.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numbers>

namespace pfdm {
namespace {

/// One order of the kernel, from its regression on. None if no dissipative start or no bounded solution was found.
std::optional<Identification> identify_order(std::span<const VibrationRecord> records, const ModelStructure& structure,
                                             int order, const IdentificationSettings& settings) {
  auto start = regress_separable(records, structure, order, settings);
  if (!start) return std::nullopt;
  Identification result;
  result.fit = refine_output(records, start->model, settings);
  result.start = std::move(*start);
  if (result.fit.record_misfit.empty()) return std::nullopt;
  return result;
}

double mean_misfit(const OutputErrorFit& fit) {
  double sum = 0.0;
  for (const double m : fit.record_misfit) sum += m;
  return sum / static_cast<double>(fit.record_misfit.size());
}

std::vector<int> orders_to_try(const ModelStructure& structure, const IdentificationSettings& settings) {
  if (structure.forcing == KernelForcing::none) return {0};
  if (settings.kernel_order) return {*settings.kernel_order};
  if (structure.kernel_order && *structure.kernel_order <= settings.maximum_kernel_order)
    return {*structure.kernel_order};
  std::vector<int> orders;
  for (int i = 0; i <= settings.maximum_kernel_order; ++i) orders.push_back(i);
  return orders;
}

/// Linear in everything: the frequency response says all, and noise on it is known from the coherence.
bool is_linear_viscoelastic(const ModelStructure& structure) {
  return structure.stiffness_order == 1 && !structure.nonlinear_damping && structure.forcing == KernelForcing::velocity;
}

bool long_enough_for_spectra(std::span<const VibrationRecord> records) {
  return std::ranges::all_of(records, [](const VibrationRecord& r) { return r.n() >= 16 * SegmentSettings{}.length; });
}

Identification identify_linear(std::span<const VibrationRecord> records, const IdentificationSettings& settings) {
  StiffnessIdentification stiffness = identify_stiffness(records, settings);
  Identification result;
  result.start = {.model = stiffness.fit.model, .misfit = std::sqrt(stiffness.fit.chi2)};
  result.orders = std::move(stiffness.orders);
  result.fit = refine_output(records, result.start.model, settings);
  if (result.fit.record_misfit.empty()) throw ComputationError("the fitted complex stiffness gives no bounded motion");
  result.passivity = passivity_in_band(result.fit.model, records);
  return result;
}

}  // namespace

ExcitedRange excited_range(std::span<const VibrationRecord> records) {
  ExcitedRange range{.low = std::numeric_limits<double>::infinity(), .high = 0.0, .velocity = 0.0, .displacement = 0.0};
  for (const VibrationRecord& r : records) {
    range.low = std::min(range.low, r.band_low);
    range.high = std::max(range.high, r.band_high);
    const PeakMotion peak = peak_motion(r);
    range.velocity = std::max(range.velocity, peak.velocity);
    range.displacement = std::max(range.displacement, peak.displacement);
  }
  return range;
}

Passivity passivity_in_band(const MassMaterial& model, std::span<const VibrationRecord> records) {
  const auto [low, high, velocity, displacement] = excited_range(records);
  return passivity(model, 2.0 * std::numbers::pi * low, 2.0 * std::numbers::pi * high, velocity);
}

Identification identify(std::span<const VibrationRecord> records, const ModelStructure& structure,
                        const IdentificationSettings& settings) {
  if (is_linear_viscoelastic(structure) && long_enough_for_spectra(records)) return identify_linear(records, settings);
  std::optional<Identification> best;
  std::vector<OrderTrial> tried;
  for (const int order : orders_to_try(structure, settings)) {
    auto found = identify_order(records, structure, order, settings);
    if (!found) continue;
    tried.push_back({order, found->fit.bic, mean_misfit(found->fit)});
    if (best && found->fit.bic >= best->fit.bic) break;  // one more term is not worth its two parameters
    best = std::move(found);
  }
  if (!best)
    throw ComputationError(fmt::format(
        "model \"{}\" has no passive (energy-dissipating) parameters that fit the records", structure.name));
  best->orders = std::move(tried);
  best->passivity = passivity_in_band(best->fit.model, records);
  return std::move(*best);
}

}  // namespace pfdm
