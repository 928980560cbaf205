#include "cases/program/fracture/body/anisotropy_reader.h"

#include "cases/program/fracture/body/body_keys.h"
#include "cases/program/input/fields/amount.h"
#include "physics/elasticity/anisotropy.h"

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
  for (std::size_t i = 0; i < 3; ++i) direction.parts[i] = read_parameter(entries[i]);
  return direction;
}

}  // namespace

const KeyTable& general_stiffness_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "elasticity of any symmetry",
      .sentence = "The stiffness of an anisotropic material in Voigt's notation.",
      .keys = {{"stiffness", list(quantity(dimension::stress), 21, 21), "",
                "Rows of the upper triangle of the stiffness matrix, order xx, yy, zz, yz, xz, xy."}}};
  return table;
}

const KeyTable& cubic_keys() {
  using namespace keys;
  const KeyType stress = quantity(dimension::stress);
  static const KeyTable table{
      .name = "elasticity of a cubic crystal",
      .sentence = "The stiffness of a cubic crystal.",
      .keys = {{"C11", stress, "", "Elastic constant C11 of a cubic crystal."},
               {"C12", stress, "", "Elastic constant C12 of a cubic crystal."},
               {"C44", stress, "", "Elastic constant C44 of a cubic crystal, its shear modulus."}}};
  return table;
}

const KeyTable& orthotropic_keys() {
  using namespace keys;
  const KeyType stress = quantity(dimension::stress);
  static const KeyTable table{
      .name = "elasticity, orthotropic",
      .sentence = "The elastic constants of an orthotropic material, as a fibre-reinforced layer or wood.",
      .keys = {{"E1", stress, "", "Young's modulus along the material's axis 1, as of the fibres."},
               {"E2", stress, "", "Young's modulus along the material's axis 2."},
               {"E3", stress, "", "Young's modulus along the material's axis 3."},
               {"nu12", number(), "", "Poisson's ratio: contraction along 2 under a stress along 1."},
               {"nu13", number(), "", "Poisson's ratio: contraction along 3 under a stress along 1."},
               {"nu23", number(), "", "Poisson's ratio: contraction along 3 under a stress along 2."},
               {"G12", stress, "", "Shear modulus in the plane of the axes 1 and 2."},
               {"G13", stress, "", "Shear modulus in the plane of the axes 1 and 3."},
               {"G23", stress, "", "Shear modulus in the plane of the axes 2 and 3."}}};
  return table;
}

MandelMatrix read_anisotropic(const ConfigValue& value) {
  const ConfigTable given = value.table();
  const auto modulus = [](const ConfigTable& table, const char* key) { return table.quantity(key); };
  if (given.has("stiffness")) {
    const std::vector<ConfigValue> entries = given.with_keys(general_stiffness_keys()).at("stiffness").list(21);
    std::array<double, 21> voigt{};
    for (std::size_t k = 0; k < voigt.size(); ++k) voigt[k] = entries[k].quantity();
    return value.in_context([&] { return general_stiffness(voigt); });
  }
  if (given.has("C11")) {
    const ConfigTable table = given.with_keys(cubic_keys());
    return value.in_context(
        [&] { return cubic_stiffness(modulus(table, "C11"), modulus(table, "C12"), modulus(table, "C44")); });
  }
  const ConfigTable table = given.with_keys(orthotropic_keys());
  const OrthotropicConstants c{modulus(table, "E1"),  modulus(table, "E2"),  modulus(table, "E3"),
                               table.number("nu12"),  table.number("nu13"),  table.number("nu23"),
                               modulus(table, "G12"), modulus(table, "G13"), modulus(table, "G23")};
  return value.in_context([&] { return orthotropic_stiffness(c); });
}

MaterialAxes read_axes(const ConfigValue& value) {
  const ConfigTable table = value.table();
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
