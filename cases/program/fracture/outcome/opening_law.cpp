#include "cases/program/fracture/outcome/opening_law.h"

#include "cases/program/fracture/case/run_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

namespace pfdm {
namespace {

constexpr double end_of_law = 0.01;  // part of the strength at which the law ends
constexpr double rigid = 1e6;        // over strength^2 / (2 toughness)
constexpr double furthest = 50;      // toughness over strength

}  // namespace

bool is_uniform(const InterfaceSettings& interface) {
  const auto varies = [](const std::optional<Parameter>& parameter) { return parameter && parameter->varies; };
  return !interface.strength.varies && !interface.toughness.varies && !varies(interface.shear_strength) &&
         !varies(interface.shear_toughness) && !interface.strength_scatter && !interface.toughness_scatter;
}

InterfaceStrength strength_everywhere(const InterfaceSettings& interface) {
  const auto value = [](const std::optional<Parameter>& parameter) {
    return parameter ? parameter->at(Vector::Zero()) : 0.0;
  };
  InterfaceStrength at{.strength = interface.strength.at(Vector::Zero()),
                       .toughness = interface.toughness.at(Vector::Zero()),
                       .shear_strength = value(interface.shear_strength),
                       .shear_toughness = value(interface.shear_toughness),
                       .stiffness = interface.stiffness};
  if (interface.law.law->has_rise() && !(at.stiffness > 0.0))
    at.stiffness = rigid * 0.5 * at.strength * at.strength / at.toughness;
  return at;
}

double traction_along(const InterfaceLaw& law, const InterfaceStrength& at, const Vector& direction, double size) {
  return law.respond(at, Vector::UnitX(), size * direction, {}).traction.norm();
}

double end_along(const InterfaceLaw& law, const InterfaceStrength& at, const Vector& direction) {
  constexpr int samples = 2000;
  const double longest = furthest * std::max(at.toughness, at.shear_toughness) / at.strength;
  double most = 0.0, end = 0.0;
  for (int i = 1; i <= samples; ++i) {
    const double size = longest * std::pow(double(i) / samples, 3.0);
    const double T = traction_along(law, at, direction, size);
    most = std::max(most, T);
    if (T > end_of_law * most) end = size;
  }
  return end;
}

std::vector<LawOfCase> opening_laws(const CaseFile& file) {
  std::vector<std::filesystem::path> data_files;
  std::vector<LawOfCase> laws;
  for (const InterfaceSettings& interface :
       read_interfaces(file.config.root().with_keys(fracture_keys()), file.directory, data_files)) {
    if (!is_uniform(interface)) continue;
    const InterfaceStrength at = strength_everywhere(interface);
    if (interface.law.law->has_rise() && !(at.strength * at.strength < 2.0 * at.stiffness * at.toughness))
      throw InputError(fmt::format("{}: the straight rise of the law takes all of the toughness", interface.name));
    laws.push_back({.name = interface.name,
                    .end = end_along(interface.law, at, Vector::UnitX()),
                    .traction = [law = interface.law, at](double separation) {
                      return traction_along(law, at, Vector::UnitX(), separation);
                    }});
  }
  return laws;
}

}  // namespace pfdm
