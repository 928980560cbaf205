#include "solver/fracture/increments.h"

#include <algorithm>

namespace pfdm {
namespace {

constexpr Index easy_iterations = 12;  // after a step with at most these the increment grows
constexpr double bearable_share =
    0.5;  // of the most iterations: after a step with at most these a cut increment recovers
constexpr double growth = 1.5;
constexpr double aim = 0.7;  // of the limits on damage growth and energy release

double dissipation_of(const LoadingSettings& loading, double increment) {
  return loading.maximum_dissipation * std::min(1.0, increment / loading.maximum_increment);
}

}  // namespace

double next_frame(const LoadingSettings& loading, double load) {
  double frame = loading.end;
  for (const double stop : loading.stops)
    if (stop > load + load_rounding) frame = std::min(frame, stop);
  return frame;
}

double next_increment(const LoadingSettings& loading, const StaggeredSettings& settings, double increment,
                      const StepOutcome& outcome) {
  const double grown = growth * increment;
  double next = increment;
  if (outcome.iterations <= easy_iterations)
    next = std::min(grown, loading.maximum_increment);
  else if (double(outcome.iterations) <= bearable_share * double(settings.maximum_iterations) &&
           increment < loading.initial_increment)
    next = std::min(grown, loading.initial_increment);
  // Extrapolates the damage and release per increment of this step.
  const double broken =
      std::max({outcome.growth / loading.damage_growth, outcome.energy_release / loading.energy_release, 1e-12});
  return std::min(next, std::max(aim / broken * increment, loading.finest_increment));
}

StepLimits step_limits(const LoadingSettings& loading, double increment, double planned_increment) {
  StepLimits limits{.dissipation = dissipation_of(loading, planned_increment),
                    .duration = increment * loading.duration,
                    .may_be_cut = increment_cut * increment >= loading.minimum_increment};
  const bool may_jump = increment <= loading.finest_increment * (1.0 + load_rounding);
  if (!may_jump) limits.growth = loading.damage_growth, limits.energy_release = loading.energy_release;
  return limits;
}

}  // namespace pfdm
