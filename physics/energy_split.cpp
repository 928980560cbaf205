#include "physics/energy_split.h"

#include "physics/registry.h"

#include <algorithm>

namespace pfdm {
namespace {

double largest_principal_value(const Tensor& a) {
  return Eigen::SelfAdjointEigenSolver<Tensor>().computeDirect(a, Eigen::EigenvaluesOnly).eigenvalues()[2];
}

IsotropicElasticity degrade_all(const IsotropicElasticity& c, double g, double) { return {g * c.lambda, g * c.mu}; }

constexpr EnergySplit none{
    .name = "none",
    .description = "the whole elastic energy is degraded",
    .variational = true,
    .energy =
        [](const IsotropicElasticity& c, const Tensor& eps) {
          return SplitEnergy{energy_density(c, eps), 0.0};
        },
    .closure = [](const Tensor&) { return 0.0; },
    .secant = degrade_all,
};

// Amor, Marigo, Maurini, J. Mech. Phys. Solids 57 (2009) 1209, eqs. 25-26: compression of the volume is kept.
constexpr EnergySplit volumetric_deviatoric{
    .name = "volumetric_deviatoric",
    .description = "shear and expansion are degraded, compression is not (Amor 2009)",
    .variational = true,
    .energy =
        [](const IsotropicElasticity& c, const Tensor& eps) {
          const double trace = eps.trace();
          const double expansion = std::max(trace, 0.0);
          const double compression = std::min(trace, 0.0);
          const Tensor shear = deviator(eps);
          const double K = c.bulk_modulus();
          return SplitEnergy{0.5 * K * expansion * expansion + c.mu * contract(shear, shear),
                             0.5 * K * compression * compression};
        },
    .closure = [](const Tensor& eps) { return eps.trace() < 0.0 ? 1.0 : 0.0; },
    .secant =
        [](const IsotropicElasticity& c, double g, double closure) {
          const double K = (g + closure * (1.0 - g)) * c.bulk_modulus();
          return IsotropicElasticity{K - 2.0 * g * c.mu / 3.0, g * c.mu};
        },
};

// Wu, J. Mech. Phys. Solids 103 (2017) 72, eq. 2.44: the largest effective principal stress drives, all stiffness is
// degraded. Not variational: the energies do not balance where the stress is not uniaxial.
constexpr EnergySplit rankine{
    .name = "rankine",
    .description = "<sigma_1>^2/(2E) drives damage, the whole stiffness is degraded (PF-CZM; not variational)",
    .variational = false,
    .energy =
        [](const IsotropicElasticity& c, const Tensor& eps) {
          const double tension = std::max(largest_principal_value(stress(c, eps)), 0.0);
          return SplitEnergy{0.5 * tension * tension / c.young_modulus(), 0.0};
        },
    .closure = [](const Tensor&) { return 0.0; },
    .secant = degrade_all,
};

constexpr EnergySplit table[] = {none, volumetric_deviatoric, rankine};

}  // namespace

std::span<const EnergySplit> energy_splits() { return table; }

const EnergySplit& energy_split(std::string_view name) { return find_by_name(energy_splits(), name, "energy split"); }

}  // namespace pfdm
