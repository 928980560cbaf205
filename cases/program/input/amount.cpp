#include "cases/program/input/amount.h"

#include "cases/program/input/expression.h"
#include "cases/program/input/key.h"

#include <fmt/format.h>

#include <algorithm>

namespace pfdm {
namespace {

bool has_unit(const Dimension& due) { return due.name != dimension::number.name; }

struct ExpressionInUnit {
  Expression expression;
  double factor;  // one unit in SI
};

ExpressionInUnit read_expression(const ConfigTable& table, const Dimension& due) {
  table.with_keys(expression_keys());
  const ConfigValue text = table.at("expr");
  double factor = 1.0;
  if (has_unit(due) || table.has("unit")) {
    const ConfigValue unit = table.at("unit");
    factor = unit.in_context([&] { return unit_in_si(unit.string(), due); });
  }
  return {text.in_context([&] { return Expression(text.string()); }), factor};
}

/// Not a number out of a result file (result_number.h), which may stand for any number.
bool is_expression(const ConfigValue& value) {
  if (!value.is_table()) return false;
  const auto entries = value.table().entries();
  const auto has = [&](std::string_view key) {
    return std::ranges::any_of(entries, [&](const auto& entry) { return entry.first == key; });
  };
  return !has("from") || !has("key");
}

double plain_value(const ConfigValue& value, const Dimension& due, const Range& allowed) {
  return has_unit(due) ? value.quantity(due, allowed) : value.number(allowed);
}

/// What the row says of the plain value.
const KeyType& plain_type(const ConfigValue& value) {
  const KeyType* const type = value.type();
  if (const KeyType* quantity = type->as(KeyType::Kind::quantity)) return *quantity;
  return *type->as(KeyType::Kind::number);
}

const Dimension& due_of(const KeyType& type) { return type.due != nullptr ? *type.due : dimension::number; }

}  // namespace

Amount read_amount(const ConfigValue& value) { return read_amount(value, due_of(plain_type(value))); }

Parameter read_parameter(const ConfigValue& value) {
  const KeyType& type = plain_type(value);
  return read_parameter(value, due_of(type), type.allowed);
}

Amount read_amount(const ConfigValue& value, const Dimension& due) {
  if (is_expression(value))
    return {.value =
                [value, scaled = read_expression(value.table(), due)](const Vector& x, double t) {
                  return value.in_context([&] { return scaled.factor * scaled.expression(x, t); });
                },
            .at_full_load = std::nullopt};
  const double full = plain_value(value, due, range::any);
  return {.value = [full](const Vector&, double t) { return t * full; }, .at_full_load = full};
}

Parameter read_parameter(const ConfigValue& value, const Dimension& due, const Range& allowed) {
  if (!is_expression(value)) {
    const double plain = plain_value(value, due, allowed);
    return {.at = [plain](const Vector&) { return plain; }, .varies = false, .text = fmt::format("{}", plain)};
  }
  const ConfigTable table = value.table();
  const ExpressionInUnit scaled = read_expression(table, due);
  if (scaled.expression.uses_load())
    throw value.error("this may depend on x, y and z (metres) only, not on the load parameter t");
  const auto at = [value, scaled, due, allowed](const Vector& x) {
    const double here = value.in_context([&] { return scaled.factor * scaled.expression(x, 0.0); });
    if (!allowed.holds(here))
      throw value.error(fmt::format("{:.6g}{} at ({:.6g}, {:.6g}, {:.6g}) m must be {}", here,
                                    has_unit(due) ? fmt::format(" {}", due.si_unit) : "", x[0], x[1], x[2],
                                    allowed.words));
    return here;
  };
  return {.at = at, .varies = true, .text = fmt::format("{} * {}", scaled.factor, table.string("expr"))};
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

}  // namespace pfdm
