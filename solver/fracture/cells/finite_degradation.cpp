#include "solver/fracture/cells/finite_degradation.h"

#include "physics/error.h"
#include "solver/momentum/body/cell_pressure.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <vector>

namespace pfdm {
namespace {

constexpr double least_modulus = 1e-9;  // of a pressure, over the undamaged one

constexpr FiniteSplit all_splits[] = {
    {.name = "none"},
    {.name = "volumetric_deviatoric", .keeps_compression = true, .driven_by_compression = false},
    {.name = "hybrid", .driven_by_compression = false},
};

// g w, w being 1 in cells that have to keep their orientation and 0 in broken ones. Where a law is lost within a small
// range of d it drives the damage much there and little beyond, the damage has two states of equilibrium and the
// iterations go to and fro between them. g w is convex in z = g^(1/2) = 1 - d, therefore, and so is the energy of cells
// that are stretched to twice their length or more, for d > 0.6; (1 - w) g is not, nor is the relaxed c U at small d.
// From z = 0.055 (g = 3e-3) down g w goes on along its tangent, which is 0 at half of that, rounded off by a parabola.
FiniteShare sound_share(const HyperelasticMaterial& material, double g) {
  const double sound = material.pressure_modulus() > 0.0 ? 0.15 : 0.055, middle = 0.5 * sound,
               half_width = 0.6 * middle;
  const double z = std::sqrt(g), above = z - (middle - half_width);
  if (z >= sound) return {.value = g, .slope = 1.0};
  if (above <= 0.0) return {.value = 0.0};
  const bool is_straight = above >= 2.0 * half_width;
  const double value = is_straight ? sound * (2.0 * z - sound) : 0.5 * sound / half_width * above * above;
  const double by_z = is_straight ? 2.0 * sound : sound / half_width * above;
  const double twice_by_z = is_straight ? 0.0 : sound / half_width;
  return {.value = value, .slope = 0.5 * by_z / z, .curvature = 0.25 * (twice_by_z - by_z / z) / g};
}

// Share of the volumetric energy c U that is left to a material with a pressure: g w/(1 + kappa/kappa_s (1 - g)^2).
void share_pressure(const HyperelasticMaterial& material, double g, FiniteShares& shares) {
  const FiniteShare& sound = shares.moderate;
  const double ratio =
      material.pressure_modulus() / (CellPressure::moderate_lambda * material.instantaneous_shear_modulus());
  const double lost = 1.0 - g, by = 1.0 + ratio * lost * lost, by_slope = -2.0 * ratio * lost;
  const double value = sound.value / by, slope = (sound.slope - value * by_slope) / by;
  const double curvature = (sound.curvature - 2.0 * slope * by_slope - 2.0 * ratio * value) / by;
  constexpr double part = 1.0 - least_modulus;
  shares.pressure = {.value = least_modulus + part * value, .slope = part * slope, .curvature = part * curvature};
  shares.pressure_as_moderate = {.slope = part * sound.slope / by,
                                 .curvature = part * (sound.curvature - sound.slope * by_slope / by) / by};
}

}  // namespace

const FiniteSplit& finite_split(std::string_view name) {
  std::vector<std::string_view> names;
  for (const FiniteSplit& split : all_splits) {
    if (split.name == name) return split;
    names.push_back(split.name);
  }
  throw InputError(fmt::format("materials of finite strain can only be combined with the energy splits {}, not {}",
                               fmt::join(names, ", "), name));
}

FiniteShares finite_shares(const HyperelasticMaterial& material, double g) {
  const FiniteShare sound = sound_share(material, g);
  FiniteShares shares{.moderate = sound,
                      .network = {.value = g - sound.value, .slope = 1.0 - sound.slope, .curvature = -sound.curvature}};
  share_pressure(material, g, shares);
  return shares;
}

PotentialAt network_potential(const HyperelasticMaterial& material, const Tensor& H) {
  const double mu = material.elasticity().mu;
  return {0.5 * mu * (2.0 * H.trace() + H.squaredNorm()), mu * (Tensor::Identity() + H),
          mu * GradientTangent::Identity()};
}

}  // namespace pfdm
