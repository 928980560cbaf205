#include "cases/program/studies/fit/material_tests.h"

#include "physics/quantity_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace pfdm {

std::string fit_curve_file(const std::string& experiment) {
  std::string name = experiment;
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return "fit_" + name + ".csv";
}

void require_own_file(const ConfigTable& test, const std::string& other) {
  const std::string name = test.string("name");
  if (fit_curve_file(other) == fit_curve_file(name))
    throw test.at("name").error(
        fmt::format("the curves of \"{}\" and \"{}\" would have the same file, {}: use names "
                    "with different letters or digits",
                    other, name, fit_curve_file(name)));
}

double read_noise(const ConfigTable& column, const Dimension& due) {
  if (!column.has("noise")) return 0.0;
  const ConfigValue noise = column.at("noise");
  const bool is_stress = due.name == dimension::stress.name;
  if (!is_stress && !noise.is_string() && column.has("unit"))
    throw noise.error(fmt::format("the column has a unit, so the noise needs one too, as \"{} {}\"",
                                  noise.number(range::positive), column.string("unit")));
  return is_stress || noise.is_string() ? noise.quantity(due, range::positive) : noise.number(range::positive);
}

void require_noise_of_all_or_none(const ConfigTable& fit, std::size_t with, std::size_t all, std::string_view called) {
  if (with != 0 && with != all)
    throw fit.error(
        fmt::format("noise is given for {} of {} measured {}; give it for all or for none", with, all, called));
}

std::vector<FitParameter> read_fit_bounds(
    const ConfigTable& fit, const std::vector<FitParameter>& parameters,
    const std::function<double(const FitParameter& parameter, const ConfigValue& end)>& read) {
  std::vector<FitParameter> limits;
  std::vector<std::string> names;
  for (const FitParameter& p : parameters) names.push_back(p.name);
  for (const auto& [key, value] : fit.table("bounds").entries()) {
    const auto p = std::ranges::find(parameters, key, &FitParameter::name);
    if (p == parameters.end())
      throw value.error(fmt::format("\"{}\" is not estimated (available: {})", key, fmt::join(names, ", ")));
    const auto ends = value.list(2);
    const double lower = read(*p, ends[0]), upper = read(*p, ends[1]);
    if (!(lower < upper)) throw value.error("the lower bound must be below the upper one");
    limits.push_back({.name = key, .unit = "", .first = lower, .lower = lower, .upper = upper});
  }
  return limits;
}

FittedRecord record_of(const AnsweredColumn& column) {
  FittedRecord record{.row = [test = column.test, quantity = column.quantity, unit = column.unit,
                              measured = column.measured, at = column.at](std::size_t i) {
    return fmt::format("the row of {} with a {} of {} at {}", test, quantity, quantity_text(measured[i], unit, 4),
                       at(i));
  }};
  for (std::size_t i = 0; i < column.measured.size(); ++i) {
    record.measured.push_back(column.measured[i] / column.deviation(i));
    record.size.push_back(std::abs(column.answered[i]) / column.usual);
  }
  return record;
}

}  // namespace pfdm
