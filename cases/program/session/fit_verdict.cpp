#include "cases/program/session/fit_verdict.h"

#include "physics/error.h"

#include <fmt/format.h>

#include <cmath>

namespace pfdm {

std::string interval_text(double lower, double upper, double confidence, int digits) {
  if (!std::isfinite(lower) || !std::isfinite(upper)) return "no interval";
  return fmt::format("{:g} % between {:.{}g} and {:.{}g}", 100.0 * confidence, lower, digits, upper, digits);
}

std::string moved_text(const FittedParameter& p) {
  if (!std::isfinite(p.moved_by_finer)) return "";
  return fmt::format("; finer: {:+.2g} %", 100.0 * p.moved_by_finer / p.estimate);
}

std::string verdict_text(const FitFindings& found) {
  if (is_sound(found.verdict)) return std::string(name_of(found.verdict));
  return fmt::format("{}, {}", name_of(found.verdict),
                     found.posterior ? "intervals with a discrepancy of the model only" : "no intervals");
}

void say_verdict(const FitFindings& found, const Session& session) {
  for (const std::string& warning : found.warnings) session.log.warn(warning);
  for (const std::string& reason : found.reasons) session.log.warn(reason);
  const bool sound = is_sound(found.verdict);
  const char* without = found.posterior ? "; see the warnings above. Only the posterior, which holds a discrepancy of "
                                          "the model, gives intervals"
                                        : "; see the warnings above. The estimates have no intervals, which would not "
                                          "hold";
  session.log.say(fmt::format("verdict: {}{}", name_of(found.verdict), sound ? "" : without));
  if (!sound && session.strict)
    throw ComputationError(fmt::format("the fit is {}: {}", name_of(found.verdict), found.reasons.front()));
}

}  // namespace pfdm
