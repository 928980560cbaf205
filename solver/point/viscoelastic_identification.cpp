#include "solver/point/viscoelastic_identification.h"

#include "physics/error.h"
#include "physics/quantity_text.h"
#include "solver/point/viscoelastic_start.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace pfdm {
namespace {

constexpr double negligible_residual = 1e-3;  // over the noise: rounding, which more branches do not improve
constexpr double worth_mention = 2.0;         // of the information: fewer branches are taken
constexpr double very_strong = 10.0;          // likewise: branches that are not determined are in the data
constexpr int reweightings = 2;
constexpr int values_for_noise = 3;  // for each parameter, where the noise is not known
constexpr double softer_nu = 0.1;    // at once than relaxed: no material is known to be so

struct Problem {
  const PronyLaw& law;
  const ViscoelasticExperiments& experiments;
  const ViscoelasticSettings& settings;
  TimeWindow window;      ///< by the law's temperature shift
  int most_branches = 0;  ///< of the settings, or as many as there are values for
  bool holds_relaxed() const { return !settings.choice.young_modulus; }
};

/// Throws InputError if there are too few values for the least number of branches.
int most_branches(const PronyLaw& law, const ViscoelasticExperiments& experiments,
                  const ViscoelasticSettings& settings) {
  const auto n = static_cast<int>(std::min<std::size_t>(n_measured(experiments), 1000));
  const PronyLaw without_branches{.relaxed = law.relaxed, .shift = law.shift};
  const auto others = static_cast<int>(fit_parameters(without_branches, settings.choice, {}).size());
  const auto with_values_for = [&](int parameters) { return (parameters - others) / (settings.choice.times ? 2 : 1); };
  int most = std::min(settings.most_branches, with_values_for(n));
  // The noise that is not known is that about the law with most branches, which must not follow it.
  if (!noise_is_known(experiments))
    most = std::min(most, std::max(with_values_for(n / values_for_noise), settings.least_branches));
  if (most < settings.least_branches)
    throw InputError(fmt::format("{} measured values cannot determine {} branch{}", n, settings.least_branches,
                                 settings.least_branches == 1 ? "" : "es"));
  if (most < settings.most_branches)
    settings.say(fmt::format("no more than {} {} tried: there are {} measured values", most,
                             most == 1 ? "branch is" : "branches are", n));
  return most;
}

ViscoelasticFit fit_from_law(const Problem& p, const PronyLaw& start, std::span<const double> deviations,
                             const FitSettings& settings) {
  return fit_law(start, p.settings.choice, p.experiments, deviations, p.settings.limits, settings);
}

/// To compare fits: too many branches creep along valleys.
FitSettings roughly(FitSettings settings) {
  settings.cost_tolerance = std::max(settings.cost_tolerance, 1e-7);
  return settings;
}

/// The lowest of the minima from these starts.
ViscoelasticFit lowest_from(const Problem& p, const std::vector<PronyLaw>& starts, std::span<const double> deviations) {
  std::optional<ViscoelasticFit> best;
  for (const PronyLaw& start : starts) {
    try {
      ViscoelasticFit found = fit_from_law(p, start, deviations, roughly(p.settings.fit));
      if (!best || found.result.sum_of_squares < best->result.sum_of_squares) best = std::move(found);
    } catch (const ComputationError&) {
      if (&start == &starts.back() && !best) throw;
    }
  }
  return std::move(*best);
}

/// Branches of fixed times that the data want at zero are left out.
ViscoelasticFit without_zeros(const Problem& p, ViscoelasticFit found, std::span<const double> deviations) {
  for (std::size_t turn = found.law.shear.size(); turn > 1; --turn) {
    const auto& parameters = found.parameters;
    std::vector<PronyBranch> left;
    for (std::size_t i = 0; i < found.law.shear.size(); ++i) {
      const auto at = std::ranges::find(parameters, fmt::format("modulus_{}", i + 1), &FitParameter::name);
      const bool is_zero = at != parameters.end() &&
                           found.law.shear[i].modulus < 1e-6 * (found.law.relaxed.mu + found.law.shear[i].modulus) &&
                           !(found.result.estimates[static_cast<std::size_t>(at - parameters.begin())].standard_error <
                             found.law.shear[i].modulus);
      if (!is_zero) left.push_back(found.law.shear[i]);
    }
    if (left.size() == found.law.shear.size() || left.empty()) return found;
    PronyLaw fewer = found.law;
    fewer.shear = left;
    found = fit_from_law(p, fewer, deviations, roughly(p.settings.fit));
  }
  return found;
}

/// Of times at the reference of a law's temperature shift.
TimeWindow window_by(const Problem& p, const PronyLaw& law) {
  return time_window(at_reference(p.experiments, law.shift));
}

/// With n branches; `before`: the law with one less, if there is one.
ViscoelasticFit fit_branches(const Problem& p, int n, const std::optional<PronyLaw>& before,
                             std::span<const double> deviations) {
  if (!p.settings.choice.times) {
    const PronyLaw start = law_of_times(p.law, p.holds_relaxed(), p.experiments, deviations, spread_times(p.window, n));
    return without_zeros(p, fit_from_law(p, start, deviations, roughly(p.settings.fit)), deviations);
  }
  std::vector<PronyLaw> starts{law_of_branches(p.law, p.holds_relaxed(), p.experiments, deviations, n)};
  PronyLaw even = law_of_times(p.law, p.holds_relaxed(), p.experiments, deviations, spread_times(p.window, n + 2));
  if (std::ssize(even.shear) == n) starts.push_back(even);
  if (before) starts.push_back(with_one_more(*before, window_by(p, *before)));
  return lowest_from(p, starts, deviations);
}

/// The fewest branches whose information is within two of the least, of those without an objection; of all where these
/// meet the data much better.
std::size_t choice_of(const std::vector<TriedBranches>& tried) {
  constexpr double none = std::numeric_limits<double>::infinity();
  double least = none, determined = none;
  for (const TriedBranches& t : tried) {
    least = std::min(least, t.information);
    if (t.objection.empty()) determined = std::min(determined, t.information);
  }
  const bool of_all = determined > least + very_strong;
  const double limit = (of_all ? least : determined) + worth_mention;
  for (std::size_t i = 0; i < tried.size(); ++i)
    if ((of_all || tried[i].objection.empty()) && tried[i].information <= limit) return i;
  return 0;
}

struct Selection {
  ViscoelasticFit fit;
  std::vector<TriedBranches> tried{};
};

TriedBranches tried_of(const Problem& p, const ViscoelasticFit& fit) {
  const FitResult& found = fit.result;
  return {.n_branches = static_cast<int>(fit.law.shear.size()),
          .rms = found.rms,
          .information = bayesian_information(found.sum_of_squares, found.residuals.size(), fit.parameters.size(),
                                              negligible_residual),
          .objection = objection_to(fit, window_by(p, fit.law))};
}

/// Fits that miss the data by far more than the next one, of a branch more, begin again from that: over many decades
/// they may have ended beside the least sum of squares.
void improve_from_above(const Problem& p, std::span<const double> deviations, std::vector<ViscoelasticFit>& fits) {
  constexpr double far = 1.05;
  if (!p.settings.choice.times) return;
  for (std::size_t i = fits.size(); i-- > 1;) {
    const ViscoelasticFit& more = fits[i];
    ViscoelasticFit& fewer = fits[i - 1];
    if (more.law.shear.size() != fewer.law.shear.size() + 1 || fewer.result.rms < far * more.result.rms) continue;
    try {
      ViscoelasticFit found = lowest_from(p, with_one_less(more.law), deviations);
      if (far * found.result.rms < fewer.result.rms) fewer = std::move(found);
    } catch (const ComputationError&) {
      continue;  // the first one stays
    }
  }
}

Selection select(const Problem& p, std::span<const double> deviations) {
  std::vector<ViscoelasticFit> fits;
  Selection result;
  std::optional<PronyLaw> before;
  for (int n = p.settings.least_branches; n <= p.most_branches; ++n) {
    try {
      fits.push_back(fit_branches(p, n, before, deviations));
    } catch (const ComputationError& error) {
      p.settings.say(fmt::format("{} branches: {}", n, error.what()));
      before.reset();
      continue;
    }
    before = fits.back().law;
  }
  if (fits.empty()) throw NoConvergence("no number of branches could be fitted");
  improve_from_above(p, deviations, fits);
  for (const ViscoelasticFit& fit : fits) {
    const TriedBranches& now = result.tried.emplace_back(tried_of(p, fit));
    p.settings.say(fmt::format("{} branch{}: residuals {:.4g} times the noise, Bayesian information {:.6g}{}",
                               now.n_branches, now.n_branches == 1 ? "" : "es", now.rms, now.information,
                               now.objection.empty() ? "" : "; " + now.objection));
  }
  const std::size_t chosen = choice_of(result.tried);
  result.fit = std::move(fits[chosen]);
  return result;
}

/// The law with the most branches that can be fitted.
PronyLaw law_with_most(const Problem& p, std::span<const double> deviations) {
  for (int n = p.most_branches;; --n) {
    try {
      return fit_branches(p, n, std::nullopt, deviations).law;
    } catch (const ComputationError&) {
      if (n <= std::max(p.settings.least_branches, 1)) throw;
    }
  }
}

/// Of tests in tension: their branches are right only if the bulk modulus relaxes as the law says. Empty if nothing
/// speaks against it.
std::string doubt_of_bulk(const PronyLaw& law, const ViscoelasticExperiments& experiments) {
  const auto is_tension = [](const ViscoelasticExperiment& e) { return e.deformation == Deformation::tension; };
  const double at_once = instantaneous_elasticity(law).poisson_ratio(), relaxed = law.relaxed.poisson_ratio();
  if (std::ranges::none_of(experiments, is_tension) || at_once > relaxed - softer_nu) return "";
  return fmt::format(
      "Poisson's ratio would be {:.2g} at once and {:.2g} relaxed, as the bulk modulus is taken as that of the relaxed "
      "material: if it relaxes too (bulk_branches in [material]), tests in tension have other shear branches",
      at_once, relaxed);
}

}  // namespace

std::string objection_to(const ViscoelasticFit& fit, const TimeWindow& window) {
  if (!fit.choice.times) return "";
  const auto is_outside = [&](double time) { return time < window.shortest || time > window.longest; };
  const auto object = [&](const FitParameter& p, const std::string& what) {
    return fmt::format(
        "{} {} outside of the window of the data, {}: longer, slower or faster tests would determine this branch",
        p.name, what, text_of(window));
  };
  std::string vague;
  for (std::size_t j = 0; j < fit.parameters.size(); ++j) {
    const FitParameter& p = fit.parameters[j];
    const FitEstimate& e = fit.result.estimates[j];
    if (p.unit == "s" && is_outside(e.value))
      return object(p, fmt::format("= {} lies", quantity_text(e.value, "s", 3)));
    if (!vague.empty()) continue;
    if (e.at_bound)
      vague = fmt::format("{} is at its bound", p.name);
    else if (p.log_scale && !(e.standard_error < e.value))
      vague = fmt::format("the data do not determine {}", p.name);
    else if (p.unit == "s" && (is_outside(e.lower_95) || is_outside(e.upper_95)))
      vague = object(p, fmt::format("= {}, between {} and {}, may lie", quantity_text(e.value, "s", 3),
                                    quantity_text(e.lower_95, "s", 3), quantity_text(e.upper_95, "s", 3)));
  }
  return vague;
}

ViscoelasticIdentification identify(const PronyLaw& law, const ViscoelasticExperiments& experiments,
                                    const ViscoelasticSettings& settings) {
  ViscoelasticIdentification result;
  result.deviations = first_deviations(experiments);
  const PronyLaw first = settings.choice.shift && settings.choice.moduli
                             ? law_of_shift(law, !settings.choice.young_modulus, experiments, result.deviations)
                             : law;
  const Problem p{first, experiments, settings, time_window(at_reference(experiments, first.shift)),
                  most_branches(law, experiments, settings)};
  if (settings.least_branches > 0) {
    // Noise by the law with the most branches, the same for all numbers: their residuals can be compared.
    result.deviations = deviations(law_with_most(p, result.deviations), experiments);
    Selection selected = select(p, result.deviations);
    result.fit = std::move(selected.fit);
    result.tried = std::move(selected.tried);
  } else {
    std::vector<PronyLaw> starts{law};
    if (settings.choice.times && settings.choice.moduli)
      starts.push_back(law_of_branches(first, p.holds_relaxed(), experiments, result.deviations,
                                       static_cast<int>(law.shear.size())));
    result.fit = lowest_from(p, starts, result.deviations);
  }
  for (int turn = 0; turn < reweightings; ++turn) {
    result.deviations = deviations(result.fit.law, experiments);
    result.fit = fit_from_law(p, result.fit.law, result.deviations, p.settings.fit);
  }
  if (const std::string objection = objection_to(result.fit, window_by(p, result.fit.law)); !objection.empty())
    result.doubts.push_back(objection);
  if (const std::string doubt = doubt_of_bulk(result.fit.law, experiments); !doubt.empty())
    result.doubts.push_back(doubt);
  return result;
}

}  // namespace pfdm
