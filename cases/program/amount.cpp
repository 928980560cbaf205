#include "cases/program/amount.h"

#include "cases/program/expression.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

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

Vector read_direction(const ConfigValue& value) {
  const std::vector<ConfigValue> entries = value.list(3);
  const Vector direction(entries[0].number(), entries[1].number(), entries[2].number());
  if (!(direction.norm() > 0.0)) throw value.error("a direction must not be zero");
  return direction;
}

std::string read_plain_name(const ConfigValue& value, std::string_view use) {
  const std::string name = value.string();
  const bool plain = std::ranges::all_of(name, [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; });
  if (name.empty() || !plain)
    throw value.error(fmt::format("\"{}\" becomes the name of {}: letters, digits, _ and - only", name, use));
  return name;
}

}  // namespace pfdm
