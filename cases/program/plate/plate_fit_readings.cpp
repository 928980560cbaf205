// What a measured H1 may be in place of acceleration over acceleration with exp(+i omega t).

#include "cases/program/plate/plate_fit_model.h"

#include "physics/error.h"

#include <algorithm>

namespace pfdm {
namespace {

struct NamedReading {
  ResponseReading reading;
  const char* what;
};

constexpr NamedReading other_readings[] = {
    {{.conjugate = true, .relative = false},
     "H1 of the other sign of phase: it lags behind the base, so that its phase is negative; take -phase"},
    {{.conjugate = false, .relative = true},
     "H1 of the acceleration relative to the base: it is to be the absolute one; take 1 + H1"},
    {{.conjugate = true, .relative = true},
     "H1 of the acceleration relative to the base and of the other sign of phase; take 1 + the conjugate of H1"},
};

/// Rms of what is left of H1 alone; nothing where the fit finds no way.
std::optional<double> rms_of_fit(const PlateFit& fit, PlateModel& model, const FitSettings& settings) {
  FitProblem problem;
  for (const CurveFitParameter& parameter : fit.parameters) problem.parameters.push_back(parameter.in_fit);
  problem.noise_is_known = true;
  problem.residuals = model.remembered_residuals();
  try {
    return pfdm::fit(problem, settings).rms;
  } catch (const ComputationError&) {
    return std::nullopt;
  }
}

}  // namespace

std::vector<FitSuspect> suspected_readings(PlateModel& model, const PlateFit& fit, FitSettings settings) {
  const bool has_phase = std::ranges::any_of(fit.responses, [](const auto& r) { return !r.phase.empty(); });
  settings.iterated = {};
  std::vector<FitSuspect> suspects;
  for (const auto& [reading, what] : other_readings) {
    if (fit.responses.empty() || (reading.conjugate && !has_phase)) continue;
    model.read_as(reading);
    if (const auto rms = rms_of_fit(fit, model, settings)) suspects.push_back({what, *rms});
  }
  model.read_as({});
  std::ranges::sort(suspects, {}, &FitSuspect::rms);
  return suspects;
}

}  // namespace pfdm
