#include "cases/program/viscoelastic/viscoelastic_bounds.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <vector>

namespace pfdm {
namespace {

/// Branches are numbered by rising times.
void require_rising_times(const ConfigTable& fit, const ViscoelasticSettings& settings) {
  const auto number = [](const FitParameter& p) { return std::stoi(p.name.substr(p.name.find('_') + 1)); };
  for (const FitParameter& a : settings.limits)
    for (const FitParameter& b : settings.limits)
      if (a.name.starts_with("time_") && b.name.starts_with("time_") && number(a) < number(b) && b.upper <= a.lower)
        throw fit.table("bounds").at(b.name).error(fmt::format(
            "branches are numbered by rising times: {} must reach beyond the lower bound of {}", b.name, a.name));
}

}  // namespace

void read_limits(const ConfigTable& fit, const PronyLaw& law, ViscoelasticSettings& settings) {
  if (!fit.has("bounds")) return;
  PronyLaw longest = law;
  while (std::ssize(longest.shear) < settings.most_branches) longest.shear.push_back({1.0, 1.0});
  const std::vector<FitParameter> parameters = fit_parameters(longest, settings.choice, {});
  std::vector<std::string> names;
  for (const FitParameter& p : parameters) names.push_back(p.name);
  for (const auto& [key, value] : fit.table("bounds").entries()) {
    const auto p = std::ranges::find(parameters, key, &FitParameter::name);
    if (p == parameters.end())
      throw value.error(fmt::format("\"{}\" is not estimated (available: {})", key, fmt::join(names, ", ")));
    const Dimension& due = p->unit == "Pa" ? dimension::stress : p->unit == "s" ? dimension::time : dimension::number;
    const auto read = [&](const ConfigValue& end) {
      return p->unit == "1" ? end.number(range::poisson_ratio) : end.quantity(due, range::positive);
    };
    const auto ends = value.list(2);
    const double lower = read(ends[0]), upper = read(ends[1]);
    if (!(lower < upper)) throw value.error("the lower bound must be below the upper one");
    settings.limits.push_back({.name = key, .unit = "", .first = lower, .lower = lower, .upper = upper});
  }
  require_rising_times(fit, settings);
}

}  // namespace pfdm
