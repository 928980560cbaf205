#pragma once
// Interfaces of each law and rule of mixed mode, and differences of their tractions.

#include "physics/interfaces/interface_law.h"
#include "physics/registry.h"

#include <string_view>
#include <vector>

namespace pfdm::glued_interfaces {

inline constexpr InterfaceStrength glued{
    .strength = 3e6, .toughness = 120.0, .shear_strength = 5e6, .shear_toughness = 300.0, .stiffness = 2e12};
inline const Vector n = Vector(1.0, 2.0, -2.0) / 3.0, s = Vector(2.0, 1.0, 2.0) / 3.0;

inline std::vector<double> inner_shape(const TractionSeparationLaw& law) {
  std::vector<double> shape;
  for (std::size_t i = law.has_rise() ? 1 : 0; i < law.shape.size(); ++i) shape.push_back(law.shape[i].first);
  return shape;
}

inline InterfaceLaw interface_with(const TractionSeparationLaw& law, std::string_view mode, double ratio = 1.0,
                                   double exponent = 1.0) {
  const MixedMode& rule = find_by_name(mixed_modes(), mode, "mixed mode");
  return {.law = &law,
          .shape = inner_shape(law),
          .mixed_mode = &rule,
          .shear_ratio = rule.has_shear_strength() ? 1.0 : ratio,
          .exponent = exponent};
}

/// The rules that mix the modes of a law.
inline std::vector<std::string_view> rules_of(const TractionSeparationLaw& law) {
  std::vector<std::string_view> names;
  for (const MixedMode& mode : mixed_modes())
    if (mode.suits(law)) names.push_back(mode.name);
  return names;
}

/// The potential wants less toughness in shear than in opening.
inline InterfaceStrength glue_for(std::string_view mode) {
  InterfaceStrength at = glued;
  if (mode == "xu_needleman") at.shear_toughness = 0.7 * at.toughness;
  return at;
}

inline const TractionSeparationLaw& law_named(std::string_view name) {
  return find_by_name(traction_separation_laws(), name, "law");
}

inline double one_mode_traction(const TractionSeparationLaw& law, double separation, const InterfaceStrength& at) {
  std::vector<double> shape = inner_shape(law);
  if (law.has_rise()) shape.insert(shape.begin(), at.strength * at.strength / (2.0 * at.stiffness * at.toughness));
  return law.traction(law, separation, at.strength, at.toughness, shape);
}

/// Central differences of the traction.
inline Tensor differences(const InterfaceLaw& law, const InterfaceStrength& glue, const Vector& at,
                          const InterfaceHistory& before, double step) {
  Tensor tangent;
  for (int i = 0; i < 3; ++i) {
    const Vector d = step * Vector::Unit(i);
    tangent.col(i) =
        (law.respond(glue, n, at + d, before).traction - law.respond(glue, n, at - d, before).traction) / (2.0 * step);
  }
  return tangent;
}

/// Central differences of what decohesion dissipates.
inline Vector dissipation_differences(const InterfaceLaw& law, const InterfaceStrength& glue, const Vector& at,
                                      const InterfaceHistory& before, double step) {
  Vector slope;
  for (int i = 0; i < 3; ++i) {
    const auto dissipated = [&](double sign) {
      return law.respond(glue, n, at + sign * step * Vector::Unit(i), before).history.dissipated;
    };
    slope[i] = (dissipated(1.0) - dissipated(-1.0)) / (2.0 * step);
  }
  return slope;
}

}  // namespace pfdm::glued_interfaces
