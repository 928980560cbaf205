#include "cases/program/amount.h"

#include "cases/program/expression.h"

namespace pfdm {
namespace {

ScalarField read_expression(const ConfigTable& table, const Dimension& due) {
  const ConfigValue text = table.at("expr");
  const ConfigValue unit = table.at("unit");
  const double factor = unit.in_context([&] { return unit_in_si(unit.string(), due); });
  const Expression expression = text.in_context([&] { return Expression(text.string()); });
  return [expression, factor](const Vector& x, double t) { return factor * expression(x, t); };
}

}  // namespace

Amount read_amount(const ConfigValue& value, const Dimension& due) {
  if (value.is_table()) return {.value = read_expression(value.table(), due), .at_full_load = std::nullopt};
  const double full = value.quantity(due);
  return {.value = [full](const Vector&, double t) { return t * full; }, .at_full_load = full};
}

Vector read_point(const ConfigValue& value, const Range& allowed) {
  const auto entries = value.list(3);
  Vector point;
  for (Eigen::Index i = 0; i < 3; ++i)
    point[i] = entries[static_cast<std::size_t>(i)].quantity(dimension::length, allowed);
  return point;
}

}  // namespace pfdm
