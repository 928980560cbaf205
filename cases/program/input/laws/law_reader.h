#pragma once
// Laws that are rows of tables, with their parameters: a name, or { law = "name", parameter = ... }.

#include "cases/program/input/config/key.h"
#include "physics/law_parameters.h"

#include <utility>

namespace pfdm {

/// SI value of the parameter among the keys of `table`, or its default. Throws InputError if its row does not allow it.
double read_law_parameter(const ConfigTable& table, const LawParameter& due);

/// Throws InputError if the law has parameters without a default.
LawParameters parameters_by_default(const ConfigValue& value, std::string_view law,
                                    std::span<const LawParameter> parameters);

/// The row that the key "law" of the table names, and its parameters.
template <class Row>
std::pair<const Row*, LawParameters> law_of_table(const ConfigTable& table, std::span<const Row> rows,
                                                  std::string_view what) {
  const Row& row = choose(table.at("law"), rows, what);
  LawParameters p{};
  for (std::size_t i = 0; i < row.parameters.size(); ++i) p[i] = read_law_parameter(table, row.parameters[i]);
  return {&row, p};
}

/// The row that `value` names, and its parameters; `what` says of what kind the laws are. Its type has the rows of the
/// laws' keys (law_type() of law_keys.h).
template <class Row>
std::pair<const Row*, LawParameters> choose_law(const ConfigValue& value, std::span<const Row> rows,
                                                std::string_view what) {
  if (!value.is_table()) {
    const Row& row = choose(value, rows, what);
    return {&row, parameters_by_default(value, row.name, row.parameters)};
  }
  return law_of_table(value.table().with_keys(value.type()->as(KeyType::Kind::table)->table()), rows, what);
}

}  // namespace pfdm
