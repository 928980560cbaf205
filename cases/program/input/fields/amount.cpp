#include "cases/program/input/fields/amount.h"

#include "cases/program/input/config/expression.h"
#include "cases/program/input/config/key.h"
#include "cases/program/input/fields/field_reader.h"

#include <fmt/format.h>

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
  const ConfigTable table = value.table();
  if (!table.has("from") || !table.has("key")) return true;
  table.entries();  // all of them are known to whoever reads the number
  return false;
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

Amount amount_of(const FieldInFile& field) {
  if (field.is_series()) return {.value = field, .at_full_load = std::nullopt, .from_start = field};
  return {.value = [field](const Vector& x, double t) { return t * field(x, 1.0); },
          .at_full_load = std::nullopt,
          .from_start = field};
}

/// Of a value that may depend on the place alone.
FieldInFile steady_field(const ConfigValue& value, const Dimension& due) {
  FieldInFile field(value, due);
  if (field.is_series()) throw value.error("this may depend on x, y and z only, not on the time of a list of frames");
  return field;
}

/// What `at` gives, where it is allowed.
std::function<double(const Vector&)> within_range(const ConfigValue& value, const Dimension& due, const Range& allowed,
                                                  const std::function<double(const Vector&)>& at) {
  return [value, due, allowed, at](const Vector& x) {
    const double here = at(x);
    if (!allowed.holds(here))
      throw value.error(fmt::format("{:.6g}{} at ({:.6g}, {:.6g}, {:.6g}) m must be {}", here,
                                    has_unit(due) ? fmt::format(" {}", due.si_unit) : "", x[0], x[1], x[2],
                                    allowed.words));
    return here;
  };
}

const Dimension& due_of(const KeyType& type) { return type.due != nullptr ? *type.due : dimension::number; }

}  // namespace

Amount read_amount(const ConfigValue& value) { return read_amount(value, due_of(plain_type(value))); }

Parameter read_parameter(const ConfigValue& value) {
  const KeyType& type = plain_type(value);
  return read_parameter(value, due_of(type), type.allowed);
}

Amount read_amount(const ConfigValue& value, const Dimension& due) {
  if (is_field(value)) return amount_of(FieldInFile(value, due));
  if (is_expression(value)) {
    const ScalarField as_it_stands = [value, scaled = read_expression(value.table(), due)](const Vector& x, double t) {
      return value.in_context([&] { return scaled.factor * scaled.expression(x, t); });
    };
    return {.value = as_it_stands, .at_full_load = std::nullopt, .from_start = as_it_stands};
  }
  const double full = plain_value(value, due, range::any);
  return {.value = [full](const Vector&, double t) { return t * full; },
          .at_full_load = full,
          .from_start = [full](const Vector&, double) { return full; }};
}

Parameter read_parameter(const ConfigValue& value, const Dimension& due, const Range& allowed) {
  if (!is_expression(value)) {
    const double plain = plain_value(value, due, allowed);
    return {.at = [plain](const Vector&) { return plain; }, .varies = false, .text = fmt::format("{}", plain)};
  }
  if (is_field(value)) {
    const FieldInFile field = steady_field(value, due);
    return {.at = within_range(value, due, allowed, [field](const Vector& x) { return field(x, 0.0); }),
            .varies = true,
            .text = field.text()};
  }
  const ConfigTable table = value.table();
  const ExpressionInUnit scaled = read_expression(table, due);
  if (scaled.expression.uses_load())
    throw value.error("this may depend on x, y and z (metres) only, not on the load parameter t");
  const auto at = [value, scaled](const Vector& x) {
    return value.in_context([&] { return scaled.factor * scaled.expression(x, 0.0); });
  };
  return {.at = within_range(value, due, allowed, at),
          .varies = true,
          .text = fmt::format("{} * {}", scaled.factor, table.string("expr"))};
}

Vector read_point(const ConfigValue& value, const Range& allowed) {
  const auto entries = value.list(3);
  Vector point;
  for (Eigen::Index i = 0; i < 3; ++i) point[i] = entries[i].quantity(dimension::length, allowed);
  return point;
}

Vector read_direction(const ConfigValue& value) {
  const std::vector<ConfigValue> entries = value.list(3);
  const Vector direction(entries[0].number(), entries[1].number(), entries[2].number());
  if (!(direction.norm() > 0.0)) throw value.error("a direction must not be zero");
  return direction;
}

}  // namespace pfdm
