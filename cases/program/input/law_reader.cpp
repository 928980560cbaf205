#include "cases/program/input/law_reader.h"

#include <fmt/format.h>

#include <cmath>

namespace pfdm {

double read_law_parameter(const ConfigTable& table, const LawParameter& due) {
  const Range& allowed = due.may_be_zero ? range::not_negative : range::positive;
  const bool has_default = !std::isnan(due.otherwise);
  if (due.unit == "1")
    return has_default ? table.number(due.name, allowed, due.otherwise) : table.number(due.name, allowed);
  return table.quantity(due.name, dimension::rate, allowed);
}

std::vector<std::string_view> keys_of_law(std::span<const LawParameter> parameters) {
  std::vector<std::string_view> keys{"law"};
  for (const LawParameter& parameter : parameters) keys.push_back(parameter.name);
  return keys;
}

LawParameters parameters_by_default(const ConfigValue& value, std::string_view law,
                                    std::span<const LawParameter> parameters) {
  for (const LawParameter& due : parameters)
    if (std::isnan(due.otherwise))
      throw value.error(
          fmt::format("\"{0}\" needs its parameter {1}, as in {{ law = \"{0}\", {1} = 1.0 }}", law, due.name));
  return default_values(parameters);
}

}  // namespace pfdm
