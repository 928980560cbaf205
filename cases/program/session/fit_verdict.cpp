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
  return fmt::format("{}{}", name_of(found.verdict), is_sound(found.verdict) ? "" : ", no intervals");
}

void say_verdict(const FitFindings& found, const Session& session) {
  for (const std::string& warning : found.warnings) session.log.warn(warning);
  for (const std::string& reason : found.reasons) session.log.warn(reason);
  const bool sound = is_sound(found.verdict);
  session.log.say(
      fmt::format("verdict: {}{}", name_of(found.verdict),
                  sound ? "" : "; see the warnings above. The estimates have no intervals, which would not hold"));
  if (!sound && session.strict)
    throw ComputationError(fmt::format("the fit is {}: {}", name_of(found.verdict), found.reasons.front()));
}

}  // namespace pfdm
