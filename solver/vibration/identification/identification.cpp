#include "solver/vibration/identification/identification.h"

#include "physics/error.h"
#include "solver/vibration/identification/identification_added_term.h"
#include "solver/vibration/identification/identification_evidence.h"
#include "solver/vibration/identification/identification_initial_motion.h"
#include "solver/vibration/identification/identification_stiffness.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

namespace pfdm {
namespace {

/// A choice of kernel terms, from its regression on, as far as the comparison with others needs.
struct Trial {
  Regression start;
  OutputErrorFit fit;
  OrderTrial result;
};

double mean_misfit(const OutputErrorFit& fit) {
  double sum = 0.0;
  for (const double m : fit.record_misfit) sum += m;
  return sum / static_cast<double>(fit.record_misfit.size());
}

/// None if no bounded solution was found. `rival`: a fit that it would have to surpass.
std::optional<Trial> tried(std::span<const VibrationRecord> records, Regression start,
                           const IdentificationSettings& settings, const std::optional<Trial>& rival = std::nullopt) {
  Trial trial{.start = std::move(start), .fit = {}, .result = {}};
  trial.fit =
      approach_output(records, trial.start.model, settings, rival ? std::optional(rival->fit.bic) : std::nullopt);
  if (trial.fit.record_misfit.empty()) return std::nullopt;
  const auto& kernel = trial.fit.model.kernel;
  trial.result = {.kernel_order = static_cast<int>(kernel.size()),
                  .bic = trial.fit.bic,
                  .misfit = mean_misfit(trial.fit),
                  .pair = std::ranges::any_of(kernel, &HereditaryTerm::is_pair)};
  settings.say(fmt::format("kernel of {} terms{}: misfit {:.4g}, Bayesian information {:.7g}, {} simulations",
                           trial.result.kernel_order, trial.result.pair ? ", one a conjugate pair" : "",
                           trial.result.misfit, trial.result.bic, trial.fit.evaluations));
  return trial;
}

bool may_have_pair(const ModelStructure& structure, const IdentificationSettings& settings) {
  return structure.forcing != KernelForcing::none && !structure.kernel_order && !settings.kernel_order;
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

/// Where a model with so many kernel terms starts; none if it has no passive parameters.
using StartOfOrder = std::function<std::optional<Regression>(int order)>;

/// From the complex stiffness where the spectra show it, else from the equation of motion.
StartOfOrder start_of_order(std::span<const VibrationRecord> records, const ModelStructure& structure,
                            const IdentificationSettings& settings) {
  if (is_linear_viscoelastic(structure) && segment_length(records))
    return [=, &settings](int order) -> std::optional<Regression> {
      StiffnessFit fit = fit_stiffness(records, order, settings);
      return Regression{.model = std::move(fit.model), .misfit = std::sqrt(fit.chi2)};
    };
  return [=, &structure, &settings](int order) { return regress_separable(records, structure, order, settings); };
}

bool is_doubted(std::span<const VibrationRecord> records, const MassMaterial& model, double crop) {
  std::vector<RecordEvidence> evidence;
  for (const VibrationRecord& record : records) evidence.push_back(record_evidence(model, record, crop));
  return !doubts_of(evidence).empty();
}

/// A conjugate pair, and beside it real terms until the information no longer falls. `plain`: model without a kernel.
std::optional<Trial> pair_trial(std::span<const VibrationRecord> records, MassMaterial plain,
                                const ModelStructure& structure, std::vector<OrderTrial>& orders,
                                const IdentificationSettings& settings) {
  plain.kernel.clear();
  plain.forcing = structure.forcing;
  std::optional<Trial> best;
  for (int terms = 1; terms <= settings.maximum_kernel_order; ++terms) {
    const auto start = with_added_term(records, best ? best->fit.model : plain,
                                       terms == 1 ? TermKind::pair : TermKind::real, settings);
    auto trial = start ? tried(records, {.model = start->model, .misfit = 0.0}, settings, best) : std::nullopt;
    if (!trial) break;
    orders.push_back(trial->result);
    if (best && trial->fit.bic >= best->fit.bic) break;
    best = std::move(trial);
  }
  return best;
}

/// Whether a pair meets the equation of motion better than two real terms, which have as many parameters.
bool pair_is_nearer(std::span<const VibrationRecord> records, MassMaterial plain, KernelForcing forcing,
                    const IdentificationSettings& settings) {
  plain.kernel.clear();
  plain.forcing = forcing;
  const auto pair = with_added_term(records, plain, TermKind::pair, settings),
             one = with_added_term(records, plain, TermKind::real, settings),
             two = one ? with_added_term(records, one->model, TermKind::real, settings) : std::nullopt;
  return pair && (!two || pair->left < two->left);
}

/// Real terms by the output error of each order. Where one of them leaves more than noise a pair is tried before two if
/// the equation of motion is for it, else after all of them if they still leave more than noise. One that needs more
/// terms beside it is compared with real terms alone, which a pair whose imaginary part vanishes can imitate.
std::optional<Trial> output_trial(std::span<const VibrationRecord> records, const ModelStructure& structure,
                                  std::vector<OrderTrial>& orders, const IdentificationSettings& settings) {
  const StartOfOrder start_of = start_of_order(records, structure, settings);
  std::optional<Trial> best, with_pair;
  bool pairs = may_have_pair(structure, settings);
  const auto better_pair = [&]() -> std::optional<Trial> {
    if (!std::exchange(pairs, false) || !best || !is_doubted(records, best->fit.model, settings.crop))
      return std::nullopt;
    auto pair = pair_trial(records, best->fit.model, structure, orders, settings);
    return pair && pair->fit.bic < best->fit.bic ? std::move(pair) : std::nullopt;
  };
  for (const int order : orders_to_try(structure, settings)) {
    if (order == 2 && pairs && best && pair_is_nearer(records, best->fit.model, structure.forcing, settings)) {
      with_pair = better_pair();
      if (with_pair && with_pair->fit.model.kernel.size() == 1) return with_pair;
    }
    auto start = start_of(order);
    auto trial = start ? tried(records, std::move(*start), settings, best) : std::nullopt;
    if (!trial) continue;
    orders.push_back(trial->result);
    if (best && trial->fit.bic >= best->fit.bic) break;  // one more term is not worth its two parameters
    best = std::move(trial);
  }
  if (!with_pair) with_pair = better_pair();
  return with_pair && with_pair->fit.bic < best->fit.bic ? std::move(with_pair) : std::move(best);
}

/// Real terms by the complex stiffness; a pair where they leave more than noise.
std::optional<Trial> linear_trial(std::span<const VibrationRecord> records, const ModelStructure& structure,
                                  std::vector<OrderTrial>& orders, const IdentificationSettings& settings) {
  StiffnessIdentification stiffness = identify_stiffness(records, settings);
  orders = std::move(stiffness.orders);
  auto real = tried(records, {.model = stiffness.fit.model, .misfit = std::sqrt(stiffness.fit.chi2)}, settings);
  if (!may_have_pair(structure, settings)) return real;
  if (real && !is_doubted(records, real->fit.model, settings.crop)) return real;
  auto pair = pair_trial(records, stiffness.fit.model, structure, orders, settings);
  return pair && (!real || pair->fit.bic < real->fit.bic) ? pair : real;
}

/// The chosen terms refined to the end.
Identification refined(std::span<const VibrationRecord> records, Trial trial, std::vector<OrderTrial> orders,
                       const IdentificationSettings& settings) {
  Identification result{.fit = refine_output(records, trial.fit.model, settings, true),
                        .start = std::move(trial.start),
                        .orders = std::move(orders),
                        .passivity = {}};
  if (result.fit.record_misfit.empty()) throw ComputationError("the fitted model gives no bounded motion");
  result.fit.path.insert(result.fit.path.begin(), trial.fit.path.begin(), trial.fit.path.end());
  result.fit.evaluations += trial.fit.evaluations;
  result.passivity = passivity_in_band(result.fit.model, records);
  return result;
}

/// With the motions that the records are said to begin with.
Identification identify_from_starts(std::span<const VibrationRecord> records, const ModelStructure& structure,
                                    const IdentificationSettings& settings) {
  std::vector<OrderTrial> orders;
  const bool linear = is_linear_viscoelastic(structure) && segment_length(records) == SegmentSettings{}.length;
  auto best =
      linear ? linear_trial(records, structure, orders, settings) : output_trial(records, structure, orders, settings);
  if (!best)
    throw ComputationError(fmt::format(
        "model \"{}\" has no passive (energy-dissipating) parameters that fit the records", structure.name));
  return refined(records, std::move(*best), std::move(orders), settings);
}

/// From the frequency and the decay of ring-downs alone, which have no base motion that the equation of motion could be
/// fitted to. Nothing of other records, and of models with a kernel or a damping that is not linear.
std::optional<Identification> identify_ring_downs(std::span<VibrationRecord> records, const ModelStructure& structure,
                                                  const IdentificationSettings& settings) {
  if (structure.forcing != KernelForcing::none || structure.nonlinear_damping) return std::nullopt;
  std::optional<MassMaterial> ringing;
  for (const VibrationRecord& record : records) {
    const auto model = ringing_model(record, settings.mass, settings.crop);
    if (!model) return std::nullopt;
    if (!ringing) ringing = model;
  }
  ringing->stiffness.resize(structure.stiffness_order, 0.0);
  ringing->reference_velocity = settings.reference_velocity;
  update_starts(records, *ringing, settings.crop);
  auto trial = tried(records, {.model = *ringing}, settings);
  if (!trial) return std::nullopt;
  const OrderTrial order = trial->result;
  return refined(records, std::move(*trial), {order}, settings);
}

void say_starts(std::span<const VibrationRecord> records, const IdentificationSettings& settings) {
  for (const VibrationRecord& r : records)
    if (!r.start.is_rest())
      settings.say(
          fmt::format("test {} begins in motion: its first displacement and velocity are estimated too", r.name));
}

}  // namespace

Identification identify(std::span<const VibrationRecord> records, const ModelStructure& structure,
                        const IdentificationSettings& settings) {
  constexpr int most_rounds = 8;
  constexpr double settled = 1e-5;
  std::vector<VibrationRecord> begun(records.begin(), records.end());
  auto ring_downs = identify_ring_downs(begun, structure, settings);
  Identification found = ring_downs ? std::move(*ring_downs) : identify_from_starts(begun, structure, settings);
  double change = update_starts(begun, found.fit.model, settings.crop);
  if (change == 0.0) return found;
  say_starts(begun, settings);
  if (!ring_downs) {
    found = identify_from_starts(begun, structure, settings);
    change = update_starts(begun, found.fit.model, settings.crop);
  }
  for (int round = 0; round < most_rounds && change > settled; ++round) {
    OutputErrorFit again = refine_output(begun, found.fit.model, settings, true);
    if (again.record_misfit.empty()) break;
    again.evaluations += found.fit.evaluations;
    again.path.insert(again.path.begin(), found.fit.path.begin(), found.fit.path.end());
    found.fit = std::move(again);
    change = update_starts(begun, found.fit.model, settings.crop);
  }
  found.passivity = passivity_in_band(found.fit.model, records);
  if (std::ranges::any_of(begun, [](const VibrationRecord& r) { return !r.start.is_rest(); }))
    for (const VibrationRecord& record : begun) found.starts.push_back(record.start);
  return found;
}

}  // namespace pfdm
