#include "solver/point/endochronic_identification.h"

#include "physics/quantity_text.h"
#include "physics/registry.h"

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

using Experiments = std::vector<MaterialExperiment>;

LawFit fit_chosen(const EndochronicLaw& law, const FitChoice& choice, const Experiments& experiments,
                  const EndochronicIdentificationSettings& settings) {
  return fit_law(law, choice, experiments, settings.limits, settings.fit, settings.control);
}

/// Fits every wanted number of terms; the least Bayesian information decides.
EndochronicIdentification select(const EndochronicLaw& law, const FitChoice& choice, const Experiments& experiments,
                                 const EndochronicIdentificationSettings& settings) {
  EndochronicIdentification best;
  if (settings.least_terms == 0) {
    best.fit = fit_chosen(law, choice, experiments, settings);
    return best;
  }
  std::vector<TriedKernel> tried;
  const double negligible = 1e-9 * (noise_is_known(experiments) ? 1e3 : 1.0);
  for (int n = settings.least_terms; n <= settings.most_terms; ++n) {
    EndochronicLaw first = law;
    first.kernel = first_kernel(law, experiments, n);
    LawFit fitted;
    try {
      fitted = fit_chosen(first, choice, experiments, settings);
    } catch (const ComputationError& error) {
      settings.say(fmt::format("{} terms: {}", n, error.what()));
      continue;
    }
    const FitResult& result = fitted.result;
    tried.push_back(
        {n, rms_misfit(fitted.law, experiments, settings.control),
         bayesian_information(result.sum_of_squares, n_measured(experiments), fitted.parameters.size(), negligible)});
    settings.say(fmt::format("{} terms: rms misfit {}, Bayesian information {:.6g}", n,
                             quantity_text(tried.back().rms, "Pa", 6), tried.back().information));
    const bool better = std::ranges::all_of(
        tried, [&](const TriedKernel& other) { return tried.back().information <= other.information; });
    if (better) best.fit = std::move(fitted);
  }
  if (tried.empty()) throw ComputationError("no number of kernel terms could be fitted");
  best.tried = std::move(tried);
  return best;
}

EndochronicIdentification identify_joint(const EndochronicLaw& law, const Experiments& experiments,
                                         const EndochronicIdentificationSettings& settings) {
  return select(law, settings.choice, experiments, settings);
}

EndochronicIdentification identify_kernel(const EndochronicLaw& law, const Experiments& experiments,
                                          const EndochronicIdentificationSettings& settings) {
  return select(law, {.kernel = true, .hardening = false, .rate = false, .young_modulus = false}, experiments,
                settings);
}

/// Rms weight of the points, which scales them.
double rms_weight(const std::vector<std::vector<HardeningPoint>>& transients) {
  double sum = 0.0, n = 0.0;
  for (const auto& points : transients)
    for (const HardeningPoint& point : points) sum += point.weight * point.weight, n += 1.0;
  return n > 0.0 ? std::sqrt(sum / n) : 1.0;
}

/// The law of f that runs best through the points, each with the weight of its influence on the stress. With a kernel
/// that is not yet right the points lie on another level than f(0) = 1: the level is estimated too, and alpha divided
/// by it, which is the same material (gauge). Nothing if there are too few points.
std::optional<EndochronicLaw> fit_hardening(const EndochronicLaw& law,
                                            const std::vector<std::vector<HardeningPoint>>& transients,
                                            const EndochronicIdentificationSettings& settings) {
  const FitChoice choice{.kernel = false, .hardening = true, .rate = settings.choice.rate, .young_modulus = false};
  const double scale = rms_weight(transients);
  std::vector<FitParameter> parameters = fit_parameters(law, choice);
  parameters.push_back({.name = "level", .unit = "1", .first = 1.0, .lower = 0.02, .upper = 50.0, .log_scale = true});
  const auto residuals = [&](std::span<const double> values) -> std::optional<std::vector<double>> {
    const auto trial = with_values(law, choice, values.first(values.size() - 1));
    if (!trial) return std::nullopt;
    std::vector<double> result;
    for (const auto& points : transients)
      for (const HardeningPoint& p : points)
        result.push_back(p.weight / scale * std::log(values.back() * trial->hardening(p.zeta, p.rate).f / p.f));
    return result;
  };
  std::size_t n_points = 0;
  for (const auto& points : transients) n_points += points.size();
  if (n_points < parameters.size()) return std::nullopt;
  FitSettings robust = settings.fit;
  robust.robust_scale = 0.05;  // points just after reversals may be on another root
  const std::vector<double> values = fit({.parameters = parameters, .residuals = residuals}, robust).values();
  EndochronicLaw fitted = *with_values(law, choice, std::span(values).first(values.size() - 1));
  for (KernelTerm& term : fitted.kernel) term.alpha /= values.back();
  return fitted;
}

std::vector<std::vector<HardeningPoint>> transients_of(const EndochronicLaw& law, const Experiments& experiments) {
  std::vector<std::vector<HardeningPoint>> transients;
  for (const MaterialExperiment& experiment : experiments)
    transients.push_back(experiment.follows_stress ? std::vector<HardeningPoint>{}
                                                   : transient_hardening(law, experiment));
  return transients;
}

/// The lowest of the minima from these starts: noise in the transient response may lead far away.
LawFit fit_from(const std::vector<EndochronicLaw>& starts, const FitChoice& choice, const Experiments& experiments,
                const EndochronicIdentificationSettings& settings) {
  std::optional<LawFit> best;
  for (const EndochronicLaw& start : starts) {
    try {
      LawFit found = fit_chosen(start, choice, experiments, settings);
      if (!best || found.result.sum_of_squares < best->result.sum_of_squares) best = std::move(found);
    } catch (const ComputationError&) {
      if (&start == &starts.back() && !best) throw;
    }
  }
  return std::move(*best);
}

EndochronicIdentification identify_hardening(const EndochronicLaw& law, const Experiments& experiments,
                                             const EndochronicIdentificationSettings& settings) {
  EndochronicIdentification result;
  result.transients = transients_of(law, experiments);
  EndochronicLaw start = fit_hardening(law, result.transients, settings).value_or(law);
  start.kernel = law.kernel;  // which is known, and its level with it
  const FitChoice choice{.kernel = false, .hardening = true, .rate = settings.choice.rate};
  result.fit = fit_from({start, law}, choice, experiments, settings);
  return result;
}

/// Whether the last round ended where the one before the last did.
bool goes_in_circles(const std::vector<StaggeredRound>& rounds, double tolerance) {
  if (rounds.size() < 3) return false;
  const double now = rounds.back().misfit, before = rounds[rounds.size() - 3].misfit;
  return std::abs(now - before) <= tolerance * now;
}

/// A joint fit from the best of the rounds and from where they began, and why.
void finish_jointly(EndochronicIdentification& result, const std::vector<EndochronicLaw>& starts, bool settled,
                    const Experiments& experiments, const EndochronicIdentificationSettings& settings) {
  double least = std::numeric_limits<double>::infinity();
  for (const StaggeredRound& round : result.rounds) least = std::min(least, round.rms_after_kernel);
  result.remark = fmt::format(
      "the staggered scheme {} after {} rounds, at best with an rms misfit of {}; the estimates are those of the joint "
      "fit",
      settled ? "settled" : "went to and fro and did not settle", result.rounds.size(), quantity_text(least, "Pa", 6));
  settings.say(result.remark);
  const FitChoice choice{.kernel = true, .hardening = true, .rate = settings.choice.rate};
  result.fit = fit_from(starts, choice, experiments, settings);
}

EndochronicIdentification identify_staggered(const EndochronicLaw& start, const Experiments& experiments,
                                             const EndochronicIdentificationSettings& settings) {
  EndochronicIdentification result;
  EndochronicLaw law = start;
  if (settings.least_terms > 0) law.kernel = first_kernel(law, experiments, settings.least_terms);
  const EndochronicLaw first = law;
  EndochronicLaw best = law;
  double last = std::numeric_limits<double>::infinity(), least = last;
  bool settled = false;
  for (int round = 0; round < settings.maximum_rounds && !settled; ++round) {
    result.transients = transients_of(law, experiments);
    const auto hardened = fit_hardening(law, result.transients, settings);
    if (!hardened) break;
    law = *hardened;
    const double after_hardening = rms_misfit(law, experiments, settings.control);
    law = fit_chosen(law, {.kernel = true, .hardening = false}, experiments, settings).law;
    const double after_kernel = rms_misfit(law, experiments, settings.control);
    const double now = relative_misfit(law, experiments, settings.control);
    result.rounds.push_back({after_hardening, after_kernel, now});
    settings.say(fmt::format("iteration {}: rms misfit {} after the hardening, {} after the kernel", round + 1,
                             quantity_text(after_hardening, "Pa", 6), quantity_text(after_kernel, "Pa", 6)));
    if (now < least) best = law;
    least = std::min(least, now);
    settled = std::abs(last - now) <= settings.round_tolerance * now;
    if (!settled && goes_in_circles(result.rounds, settings.round_tolerance)) break;
    last = now;
  }
  finish_jointly(result, {best, first}, settled, experiments, settings);
  return result;
}

constexpr IdentificationMethod table[] = {
    {"joint", "kernel and hardening at once by least squares", identify_joint},
    {"kernel", "the kernel by least squares, the hardening fixed", identify_kernel},
    {"hardening", "the hardening by least squares from that of the transient response, the kernel fixed",
     identify_hardening},
    {"staggered",
     "alternately the hardening from the transient response and the kernel by least squares, in the end both at once",
     identify_staggered},
};

}  // namespace

std::span<const IdentificationMethod> identification_methods() { return table; }

const IdentificationMethod& identification_method(std::string_view name) {
  return find_by_name(identification_methods(), name, "method of identification");
}

// Residuals r and Jacobian J, of standard deviation s: a change d of r moves the estimates by (J'J)^-1 J'd, each by at
// most |d|/s of its standard errors (Cauchy, Schwarz).
std::optional<double> effect_of_steps(const LawFit& fit, const std::vector<MaterialExperiment>& experiments,
                                      const ControlSettings& control) {
  ControlSettings finer = control;
  finer.substeps = 4 * control.substeps;
  const auto now = fit_residuals(fit.law, experiments, control), then = fit_residuals(fit.law, experiments, finer);
  if (!now || !then) return std::nullopt;
  double change = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < now->size(); ++i) {
    change += std::pow((*now)[i] - (*then)[i], 2);
    squares += std::pow((*now)[i], 2);
  }
  const double deviation = noise_is_known(experiments) ? 1.0 : std::sqrt(squares / static_cast<double>(now->size()));
  return deviation > 0.0 ? std::sqrt(change) / deviation : 0.0;
}

namespace {

/// What quarter steps change of an estimate, in its standard errors; the largest. Nothing where the law cannot follow.
std::optional<double> move_by_steps(const LawFit& fit, const std::vector<MaterialExperiment>& experiments,
                                    const ControlSettings& control) {
  ControlSettings finer = control;
  finer.substeps = 4 * control.substeps;
  const auto then = fit_residuals(fit.law, experiments, finer);
  const FitResult& result = fit.result;
  if (!then || then->size() != result.residuals.size()) return std::nullopt;
  const auto n = std::ssize(*then);
  const Eigen::VectorXd change =
      Eigen::VectorXd::Map(then->data(), n) - Eigen::VectorXd::Map(result.residuals.data(), n);
  const Eigen::VectorXd moves = result.inverse_normal * (result.derivatives.transpose() * change);
  double largest = 0.0;
  for (Eigen::Index j = 0; j < moves.size(); ++j)
    if (const double variance = result.covariance(j, j); variance > 0.0 && std::isfinite(variance))
      largest = std::max(largest, std::abs(moves[j]) / std::sqrt(variance));
  return largest;
}

}  // namespace

EndochronicLaw law_that_bears(const EndochronicLaw& law, const std::vector<MaterialExperiment>& experiments,
                              const EndochronicIdentificationSettings& settings) {
  constexpr double growth = 1.3, most = 100.0;
  const auto first_that_breaks = [&](const EndochronicLaw& trial) {
    return std::ranges::find_if(experiments, [&](const MaterialExperiment& experiment) {
      return experiment.follows_stress && !respond(trial, experiment, settings.control);
    });
  };
  EndochronicLaw larger = law;
  double factor = 1.0;
  for (auto broken = first_that_breaks(law); broken != experiments.end(); broken = first_that_breaks(larger)) {
    factor *= growth;
    if (!settings.choice.kernel || factor > most)
      throw InputError(
          fmt::format("the first guess does not bear the stresses of \"{}\": a larger C or f_inf of "
                      "[material], or shorter increments (substeps of [fit])",
                      broken->name));
    for (std::size_t i = 0; i < larger.kernel.size(); ++i) larger.kernel[i].C = factor * law.kernel[i].C;
  }
  if (factor > 1.0)
    settings.say(
        fmt::format("the first guess does not bear the given stresses: the fit starts with C {:.3g} times as "
                    "large",
                    factor));
  return larger;
}

void divide_steps(EndochronicIdentification& found, const std::vector<MaterialExperiment>& experiments,
                  const EndochronicIdentificationSettings& settings, ControlSettings& control) {
  constexpr double allowed = 0.1, noiseless = 1e-4, wrong = 3.0;
  constexpr int most = 16;
  for (int turn = 0; turn < 3 && control.substeps < most; ++turn) {
    if (relative_misfit(found.fit.law, experiments, control) < noiseless) return;
    if (found.fit.result.noise_is_known && found.fit.result.rms > wrong) return;
    const auto move = move_by_steps(found.fit, experiments, control);
    if (!move || *move <= allowed) return;
    const double factor = std::sqrt(*move / (0.7 * allowed));  // a scheme of second order
    const int before = control.substeps;
    control.substeps = std::min(most, std::max(before + 1, static_cast<int>(std::ceil(before * factor))));
    settings.say(
        fmt::format("{} steps of the model for each increment of the curves: with {} they move an estimate by "
                    "{:.2g} of its standard errors",
                    control.substeps, before, *move));
    found.fit = fit_law(found.fit.law, found.fit.choice, experiments, settings.limits, settings.fit, control);
  }
}

}  // namespace pfdm
