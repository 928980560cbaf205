#include "cases/program/fracture/anisotropy_reader.h"

#include "cases/program/input/amount.h"
#include "physics/anisotropy.h"

#include <fmt/format.h>

#include <array>

namespace pfdm {
namespace {

struct Direction {
  std::array<Parameter, 3> parts;
  Vector at(const Vector& x) const { return {parts[0].at(x), parts[1].at(x), parts[2].at(x)}; }
};

Direction read_varying_direction(const ConfigValue& value) {
  const std::vector<ConfigValue> entries = value.list(3);
  Direction direction;
  for (std::size_t i = 0; i < 3; ++i) direction.parts[i] = read_parameter(entries[i], dimension::number, range::any);
  return direction;
}

}  // namespace

MandelMatrix read_anisotropic(const ConfigValue& value) {
  const ConfigTable given = value.table();
  const auto modulus = [](const ConfigTable& table, const char* key) { return table.quantity(key, dimension::stress); };
  if (given.has("stiffness")) {
    const std::vector<ConfigValue> entries = given.with_keys({"stiffness"}).at("stiffness").list(21);
    std::array<double, 21> voigt{};
    for (std::size_t k = 0; k < voigt.size(); ++k) voigt[k] = entries[k].quantity(dimension::stress);
    return value.in_context([&] { return general_stiffness(voigt); });
  }
  if (given.has("C11")) {
    const ConfigTable table = given.with_keys({"C11", "C12", "C44"});
    return value.in_context(
        [&] { return cubic_stiffness(modulus(table, "C11"), modulus(table, "C12"), modulus(table, "C44")); });
  }
  const ConfigTable table = given.with_keys({"E1", "E2", "E3", "nu12", "nu13", "nu23", "G12", "G13", "G23"});
  const OrthotropicConstants c{modulus(table, "E1"),
                               modulus(table, "E2"),
                               modulus(table, "E3"),
                               table.number("nu12", range::any),
                               table.number("nu13", range::any),
                               table.number("nu23", range::any),
                               modulus(table, "G12"),
                               modulus(table, "G13"),
                               modulus(table, "G23")};
  return value.in_context([&] { return orthotropic_stiffness(c); });
}

MaterialAxes read_axes(const ConfigValue& value) {
  const ConfigTable table = value.table().with_keys({"first", "second"});
  const Direction first = read_varying_direction(table.at("first")),
                  second = read_varying_direction(table.at("second"));
  MaterialAxes axes;
  for (const Direction* direction : {&first, &second})
    for (const Parameter& part : direction->parts) axes.varies = axes.varies || part.varies;
  axes.at = [value, first, second](const Vector& x) {
    return value.in_context([&] { return axes_along(first.at(x), second.at(x)); });
  };
  if (!axes.varies) axes.at(Vector::Zero());
  return axes;
}

}  // namespace pfdm
