#include "cases/program/input/laws/law_reader.h"

#include "cases/program/input/laws/law_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pfdm {

KeyType type_of(const LawParameter& parameter) {
  const Range& allowed = parameter.may_be_zero ? range::not_negative : range::positive;
  if (parameter.unit == "1") return keys::number(allowed);
  return keys::quantity(parameter.unit == "m/s" ? dimension::velocity : dimension::rate, allowed);
}

std::string default_of(const LawParameter& parameter) {
  return std::isnan(parameter.otherwise) ? "" : fmt::format("{}", parameter.otherwise);
}

std::string_view sentence_of(std::string_view parameter, std::span<const ParameterWords> words) {
  const auto found = std::ranges::find(words, parameter, &ParameterWords::name);
  return found == words.end() ? "" : found->sentence;
}

double read_law_parameter(const ConfigTable& table, const LawParameter& due) {
  if (due.unit != "1") return table.quantity(due.name);
  return std::isnan(due.otherwise) ? table.number(due.name) : table.number(due.name, due.otherwise);
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
