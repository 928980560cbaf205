#include "physics/damage/energy_split.h"

#include "physics/registry.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace pfdm {
namespace {

std::string names_where(bool (*suits)(const SplitLaw&)) {
  std::vector<std::string_view> names;
  for (const SplitLaw& law : energy_splits())
    if (suits(law)) names.push_back(law.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

MandelMatrix degraded_tangent(const EnergySplit& split, const IsotropicElasticity& c, double g, const Tensor& eps) {
  if (split.has_secant()) return stiffness_matrix(split.secant(c, g, split.closure(eps)));
  if (g == 1.0) return stiffness_matrix(c);
  const PrincipalAxes axes = principal_axes(eps);
  return g * stiffness_matrix(c) + (1.0 - g) * tangent(axes, split.kept(c, axes.value));
}

Tensor degradable_stress(const EnergySplit& split, const IsotropicElasticity& c, const Tensor& eps) {
  if (split.has_secant()) {
    const double closure = split.closure(eps);
    return stress(split.secant(c, 1.0, closure), eps) - stress(split.secant(c, 0.0, closure), eps);
  }
  const PrincipalAxes axes = principal_axes(eps);
  const Vector kept = split.kept(c, axes.value).stress;
  return stress(c, eps) - axes.direction * kept.asDiagonal() * axes.direction.transpose();
}

Tensor degraded_stress(const EnergySplit& split, const IsotropicElasticity& c, double g, const Tensor& eps) {
  return to_tensor(degraded_tangent(split, c, g, eps) * to_mandel(eps));
}

// The part of the stress that the split keeps belongs to the sound material.
MandelMatrix degraded_tangent(const EnergySplit& split, const AnisotropicElasticity& c, double g, const Tensor& eps) {
  if (g == 1.0) return c.stiffness;
  return g * c.stiffness + (1.0 - g) * split.law().kept_of(c, eps);
}

Tensor degradable_stress(const EnergySplit& split, const AnisotropicElasticity& c, const Tensor& eps) {
  return to_tensor((c.stiffness - split.law().kept_of(c, eps)) * to_mandel(eps));
}

SplitEnergy energy(const EnergySplit& split, const AnisotropicElasticity& c, const Tensor& eps) {
  const Mandel strain = to_mandel(eps);
  const double psi_minus = 0.5 * strain.dot(split.law().kept_of(c, eps) * strain);
  return {std::max(0.5 * strain.dot(c.stiffness * strain) - psi_minus, 0.0), psi_minus};
}

std::string splits_with_secant() {
  return names_where([](const SplitLaw& law) { return law.secant != nullptr; });
}

std::string splits_for_anisotropy() {
  return names_where([](const SplitLaw& law) { return law.kept_of != nullptr; });
}

const SplitLaw& split_law(std::string_view name) { return find_by_name(energy_splits(), name, "energy split"); }

EnergySplit energy_split(std::string_view name) {
  const SplitLaw& law = split_law(name);
  for (const LawParameter& parameter : law.parameters)
    if (std::isnan(parameter.otherwise))
      throw InputError(fmt::format("the energy split \"{}\" needs its parameter {}", name, parameter.name));
  return EnergySplit(law);
}

}  // namespace pfdm
