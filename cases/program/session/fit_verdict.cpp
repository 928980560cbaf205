#include "cases/program/session/fit_verdict.h"

#include "cases/program/session/page_origin.h"
#include "physics/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace pfdm {
namespace {

/// 3 of 123.4, -1 of 0.0123.
int places_before_point(double value) {
  return value == 0.0 ? 1 : static_cast<int>(std::floor(std::log10(std::abs(value)))) + 1;
}

}  // namespace

int digits_of_interval(double lower, double upper, int least) {
  constexpr int of_width = 3, most = 12;
  const double width = std::abs(upper - lower), largest = std::max(std::abs(lower), std::abs(upper));
  if (!(width > 0.0) || !std::isfinite(largest)) return least;
  const int before = static_cast<int>(std::floor(std::log10(largest)) - std::floor(std::log10(width)));
  return std::clamp(before + of_width, least, most);
}

std::string interval_text(double lower, double upper, double confidence, int digits) {
  if (!std::isfinite(lower) || !std::isfinite(upper)) return "no interval";
  return fmt::format("{:g} % between {}", 100.0 * confidence, ends_text(lower, upper, " and ", digits));
}

std::string ends_text(double lower, double upper, const std::string& between, int digits) {
  constexpr int longest = 6;  // of numbers before the point that are written out
  digits = digits_of_interval(lower, upper, digits);
  digits = std::max(digits, std::min(places_before_point(std::max(std::abs(lower), std::abs(upper))), longest));
  return fmt::format("{:.{}g}{}{:.{}g}", lower, digits, between, upper, digits);
}

std::string value_text(double value, double lower, double upper) {
  constexpr int alone = 4, most = 6;
  if (!std::isfinite(lower) || !std::isfinite(upper)) return fmt::format("{:.{}g}", value, alone);
  const int behind =
      digits_of_interval(lower, upper, 3) - places_before_point(std::max(std::abs(lower), std::abs(upper)));
  const int before = places_before_point(value);
  const int digits = std::clamp(before + behind, std::clamp(before, 1, most), most);
  return fmt::format("{:.{}g}", value, digits);
}

ScaledUnit unit_of_estimate(double estimate, const std::string& unit) {
  constexpr std::array<std::string_view, 5> taking_prefix{"Pa", "m", "N", "Hz", "J"};
  if (unit == "1") return {};
  if (unit == "s") return scaled_seconds(estimate);
  const std::string_view first = std::string_view(unit).substr(0, unit.find_first_of("/ "));
  return std::ranges::count(taking_prefix, first) > 0 ? scaled_unit(estimate, unit) : ScaledUnit{1.0, unit};
}

std::string estimate_text(const FittedParameter& p, double confidence) {
  const ScaledUnit unit = unit_of_estimate(p.estimate, p.unit);
  return fmt::format("{}{}{}, {}", value_text(unit.factor * p.estimate, unit.factor * p.lower, unit.factor * p.upper),
                     unit.name.empty() ? "" : " ", unit.name,
                     interval_text(unit.factor * p.lower, unit.factor * p.upper, confidence));
}

std::string end_of_search(const std::string& message) { return message.substr(0, message.find(". ")); }

std::string moved_text(const FittedParameter& p) {
  if (!std::isfinite(p.moved_by_finer)) return "";
  return fmt::format("; finer: {:+.2g} %", 100.0 * p.moved_by_finer / p.estimate);
}

std::string verdict_text(const FitFindings& found) {
  if (is_sound(found.verdict))
    return fmt::format("{}{}", name_of(found.verdict),
                       found.is_discretised && found.finer.empty() ? ", the error of mesh and steps not tried" : "");
  return fmt::format("{}, {}", name_of(found.verdict),
                     found.posterior ? "intervals with a discrepancy of the model only" : "no intervals");
}

void say_fitted_case(const Session& session) {
  session.log.say(fmt::format("written to {}; run it with: {} run {}", session.results.string(), called_as(),
                              (session.results / "case.fitted.toml").string()));
}

void say_verdict(const FitFindings& found, const Session& session) {
  for (const std::string& warning : found.warnings) session.log.warn(warning);
  for (const std::string& reason : found.reasons) session.log.warn(reason);
  const bool sound = is_sound(found.verdict);
  const char* without = found.posterior ? "; see the warnings above. Only the posterior, which holds a discrepancy of "
                                          "the model, gives intervals"
                                        : "; see the warnings above. The estimates have no intervals, which would not "
                                          "hold";
  const bool is_untried = found.is_discretised && found.finer.empty();
  const char* untried =
      is_untried ? "; what mesh and steps do to the estimates is not in the intervals (finer of [fit] tries it)" : "";
  session.log.say(fmt::format("verdict: {}{}", name_of(found.verdict), sound ? untried : without));
  if (!sound && session.strict)
    throw ComputationError(fmt::format("the fit is {}: {}", name_of(found.verdict), found.reasons.front()));
}

}  // namespace pfdm
