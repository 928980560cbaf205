// The table of energy splits: energy_splits() of energy_split.h.

#include "physics/damage/energy_split.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace pfdm {
namespace {

double largest_principal_value(const Tensor& a) {
  return Eigen::SelfAdjointEigenSolver<Tensor>().computeDirect(a, Eigen::EigenvaluesOnly).eigenvalues()[2];
}

IsotropicElasticity degrade_all(const IsotropicElasticity& c, double g, double, const LawParameters&) {
  return {g * c.lambda, g * c.mu};
}

MandelMatrix keep_nothing(const AnisotropicElasticity&, const Tensor&) { return MandelMatrix::Zero(); }

double never_closed(const Tensor&) { return 0.0; }
double closed_in_compression(const Tensor& eps) { return eps.trace() < 0.0 ? 1.0 : 0.0; }

constexpr SplitLaw none{
    .name = "none",
    .description = "the whole elastic energy is degraded, also in compression: cracks do not close",
    .variational = true,
    .energy =
        [](const IsotropicElasticity& c, const Tensor& eps, const LawParameters&) {
          return SplitEnergy{energy_density(c, eps), 0.0};
        },
    .closure = never_closed,
    .secant = degrade_all,
    .kept_of = keep_nothing,
};

// Compression of the volume is kept where elasticity depends on the direction: of stresses -p I, which crack strains
// that take no volume away leave, the nearest in the norm of the energy, p = -K tr(eps) with the bulk modulus K = 1/(I
// : C^-1 : I) (as Ziaei-Rad, Mollaali, Nagel, Kolditz, Yoshioka, J. Mech. Phys. Solids 171 (2023) 105143, by the
// projection of Freddi, Royer-Carfagni 2010).
MandelMatrix keep_pressure(const AnisotropicElasticity& c, const Tensor& eps) {
  if (eps.trace() >= 0.0) return MandelMatrix::Zero();
  return c.bulk_modulus * mandel_identity() * mandel_identity().transpose();
}

// Amor, Marigo, Maurini, J. Mech. Phys. Solids 57 (2009) 1209, eqs. 25-26: compression of the volume is kept.
constexpr SplitLaw volumetric_deviatoric{
    .name = "volumetric_deviatoric",
    .description = "shear and expansion are degraded, compression is not (Amor 2009)",
    .variational = true,
    .energy =
        [](const IsotropicElasticity& c, const Tensor& eps, const LawParameters&) {
          const double trace = eps.trace();
          const double expansion = std::max(trace, 0.0);
          const double compression = std::min(trace, 0.0);
          const Tensor shear = deviator(eps);
          const double K = c.bulk_modulus();
          return SplitEnergy{0.5 * K * expansion * expansion + c.mu * contract(shear, shear),
                             0.5 * K * compression * compression};
        },
    .closure = closed_in_compression,
    .secant =
        [](const IsotropicElasticity& c, double g, double closure, const LawParameters&) {
          const double K = (g + closure * (1.0 - g)) * c.bulk_modulus();
          return IsotropicElasticity{K - 2.0 * g * c.mu / 3.0, g * c.mu};
        },
    .kept_of = keep_pressure,
};

// Ambati, Gerasimov, De Lorenzis, Comput. Mech. 55 (2015) 383, with the energy of Amor et al. in place of the
// spectral one and without their condition that closes cracks.
constexpr SplitLaw hybrid{
    .name = "hybrid",
    .description =
        "driven as by volumetric_deviatoric, the whole stiffness is degraded: cracks do not close (Ambati 2015; not "
        "variational)",
    .variational = false,
    .energy =
        [](const IsotropicElasticity& c, const Tensor& eps, const LawParameters& p) {
          return SplitEnergy{volumetric_deviatoric.energy(c, eps, p).psi_plus, 0.0};
        },
    .closure = never_closed,
    .secant = degrade_all,
};

// Vicentini, Zolesi, Carrara, Maurini, De Lorenzis, Int. J. Fract. 247 (2024) 291: compression of the volume is kept
// and lowers the energy that drives damage, so that the ratio of compressive to tensile strength is a parameter.
constexpr LawParameter star_convex_parameters[] = {{"gamma", "1", true}};
constexpr SplitLaw star_convex{
    .name = "star_convex",
    .description =
        "as volumetric_deviatoric; compression lowers the driving energy by gamma K/2 <-tr eps>^2 "
        "(Vicentini 2024)",
    .variational = true,
    .energy =
        [](const IsotropicElasticity& c, const Tensor& eps, const LawParameters& p) {
          const double expansion = std::max(eps.trace(), 0.0), compression = std::min(eps.trace(), 0.0);
          const Tensor shear = deviator(eps);
          const double half_K = 0.5 * c.bulk_modulus(), pressed = half_K * compression * compression;
          return SplitEnergy{half_K * expansion * expansion + c.mu * contract(shear, shear) - p[0] * pressed,
                             (1.0 + p[0]) * pressed};
        },
    .closure = closed_in_compression,
    .secant =
        [](const IsotropicElasticity& c, double g, double closure, const LawParameters& p) {
          const double K = (g + closure * (1.0 - g) * (1.0 + p[0])) * c.bulk_modulus();
          return IsotropicElasticity{K - 2.0 * g * c.mu / 3.0, g * c.mu};
        },
    .parameters = star_convex_parameters,
};

// Wu, J. Mech. Phys. Solids 103 (2017) 72, eq. 2.44: the largest effective principal stress drives, all stiffness is
// degraded. Not variational: the energies do not balance where the stress is not uniaxial.
constexpr SplitLaw rankine{
    .name = "rankine",
    .description =
        "<sigma_1>^2/(2E) drives damage, the whole stiffness is degraded: cracks do not close (PF-CZM; not "
        "variational)",
    .variational = false,
    .energy =
        [](const IsotropicElasticity& c, const Tensor& eps, const LawParameters&) {
          const double tension = std::max(largest_principal_value(stress(c, eps)), 0.0);
          return SplitEnergy{0.5 * tension * tension / c.young_modulus(), 0.0};
        },
    .closure = never_closed,
    .secant = degrade_all,
};

// Splits that say what is kept: psi_minus = 1/2 kept stress : eps, as for any energy of second degree.
template <PrincipalStress (*kept)(const IsotropicElasticity&, const Vector&, const LawParameters&)>
SplitEnergy energy_less_kept(const IsotropicElasticity& c, const Tensor& eps, const LawParameters& p) {
  const Vector principal = principal_axes(eps).value;
  const double psi_minus = 0.5 * kept(c, principal, p).stress.dot(principal);
  return {std::max(energy_density(c, eps) - psi_minus, 0.0), psi_minus};
}

// Miehe, Hofacker, Welschinger, CMAME 199 (2010) 2765, eqs. 19-23: lambda/2 <-tr eps>^2 + mu sum <-eps_i>^2 is kept.
PrincipalStress kept_by_spectral(const IsotropicElasticity& c, const Vector& eps, const LawParameters&) {
  PrincipalStress kept;
  if (eps.sum() < 0.0) kept.slope.setConstant(c.lambda);
  for (Index i = 0; i < 3; ++i)
    if (eps[i] < 0.0) kept.slope(i, i) += 2.0 * c.mu;
  kept.stress = kept.slope * eps;
  return kept;
}

constexpr SplitLaw spectral{
    .name = "spectral",
    .description = "positive principal strains and expansion are degraded (Miehe 2010)",
    .variational = true,
    .energy = energy_less_kept<kept_by_spectral>,
    .kept = kept_by_spectral,
};

// Del Piero, Meccanica 24 (1989) 150; Freddi, Royer-Carfagni, J. Mech. Phys. Solids 58 (2010) 1154, sec. 3.3: what a
// material without tensile strength stores. Crack strains open freely in the principal directions whose stress would be
// tensile; from the smallest strain upwards none, one, two or all three directions stay under compression.
PrincipalStress kept_by_no_tension(const IsotropicElasticity& c, const Vector& eps, const LawParameters&) {
  const double E = c.young_modulus(), nu = c.poisson_ratio();
  PrincipalStress kept;
  if (eps[0] >= 0.0) return kept;
  if (eps[1] + nu * eps[0] >= 0.0) {
    kept.slope(0, 0) = E;
  } else if ((1.0 - nu) * eps[2] + nu * (eps[0] + eps[1]) >= 0.0) {
    kept.slope.topLeftCorner<2, 2>() << 1.0, nu, nu, 1.0;
    kept.slope *= E / (1.0 - nu * nu);
  } else {
    kept.slope = Tensor::Constant(c.lambda) + 2.0 * c.mu * Tensor::Identity();
  }
  kept.stress = kept.slope * eps;
  return kept;
}

constexpr SplitLaw no_tension{
    .name = "no_tension",
    .description = "what a no-tension material (masonry) carries is kept (Del Piero 1989, Freddi 2010)",
    .variational = true,
    .energy = energy_less_kept<kept_by_no_tension>,
    .kept = kept_by_no_tension,
};

// Nguyen, Yvonnet, Waldmann, He, Int. J. Numer. Meth. Engng 121 (2020) 4717; He, Int. J. Solids Struct. 295 (2024)
// 112818: the strain is taken to C^(1/2) eps, whose square is twice the energy, and its negative principal values are
// kept, psi_minus = 1/2 sum <-e_i>^2. The two parts of the strain are orthogonal in the norm of the energy. Isotropic:
// e = (3 K)^(1/2) of the volume + (2 mu)^(1/2) of the deviator, with the axes of the strain.
PrincipalStress kept_by_orthogonal(const IsotropicElasticity& c, const Vector& eps, const LawParameters&) {
  const double shear = std::sqrt(2.0 * c.mu), beyond = (std::sqrt(3.0 * c.bulk_modulus()) - shear) / 3.0;
  PrincipalStress kept;
  for (Index i = 0; i < 3; ++i) {
    const Vector by_eps = shear * Vector::Unit(i) + beyond * Vector::Ones();
    if (by_eps.dot(eps) < 0.0) kept.slope += by_eps * by_eps.transpose();
  }
  kept.stress = kept.slope * eps;
  return kept;
}

MandelMatrix keep_orthogonal(const AnisotropicElasticity& c, const Tensor& eps) {
  const PrincipalAxes axes = principal_axes(to_tensor(c.root * to_mandel(eps)));
  PrincipalStress negative;
  for (Index i = 0; i < 3; ++i)
    if (axes.value[i] < 0.0) negative.slope(i, i) = 1.0;
  negative.stress = negative.slope * axes.value;
  return c.root * tangent(axes, negative) * c.root;
}

constexpr SplitLaw orthogonal{
    .name = "orthogonal",
    .description =
        "positive principal values of C^(1/2) eps are degraded, orthogonal to the rest in the norm of the energy, also "
        "of "
        "elasticity that depends on the direction (Nguyen 2020)",
    .variational = true,
    .energy = energy_less_kept<kept_by_orthogonal>,
    .kept = kept_by_orthogonal,
    .kept_of = keep_orthogonal,
};

// De Lorenzis, Maurini, Int. J. Fract. 237 (2022) 61: what a material keeps whose crack strains satisfy tr eta >= 6 B
// sqrt(J2(eta)), as of a frictional material without cohesion: its stress, nearest in the norm of the energy, with
// sqrt(J2) + B I1 <= 0. With AT1 and the cohesive model the strength surface between the two cones is
// sqrt(J2) + B I1 = constant.
PrincipalStress kept_by_drucker_prager(const IsotropicElasticity& c, const Vector& eps, const LawParameters& p) {
  const double B = p[0], K = c.bulk_modulus(), trace = eps.sum();
  const Vector shear = eps.array() - trace / 3.0;
  const double size = std::sqrt(0.5 * shear.squaredNorm());  // sqrt(J2) of the strain
  PrincipalStress kept;
  if (trace >= 6.0 * B * size) return kept;
  if (2.0 * c.mu * size <= -3.0 * B * K * trace) {
    kept.slope = Tensor::Constant(c.lambda) + 2.0 * c.mu * Tensor::Identity();
  } else {  // pressure times (-1, ..., -1) + 3 B shear/size
    const double stiffness = 1.0 / (1.0 / K + 9.0 * B * B / c.mu);
    const double pressure = stiffness * (6.0 * B * size - trace);
    const Vector along = 3.0 * B / size * shear - Vector::Ones();
    const Tensor deviatoric = Tensor::Identity() - Tensor::Constant(1.0 / 3.0);
    kept.slope = stiffness * along * along.transpose() +
                 3.0 * B * pressure / size * (deviatoric - shear * shear.transpose() / (2.0 * size * size));
  }
  kept.stress = kept.slope * eps;
  return kept;
}

constexpr LawParameter drucker_prager_parameters[] = {{"B", "1", true}};
constexpr SplitLaw drucker_prager{
    .name = "drucker_prager",
    .description =
        "what a frictional material without cohesion carries is kept: sqrt(J2) + B I1 <= 0 (De Lorenzis 2022)",
    .variational = true,
    .energy = energy_less_kept<kept_by_drucker_prager>,
    .kept = kept_by_drucker_prager,
    .parameters = drucker_prager_parameters,
};

constexpr SplitLaw all_splits[] = {none,       volumetric_deviatoric, star_convex, spectral, no_tension,
                                   orthogonal, drucker_prager,        rankine,     hybrid};

}  // namespace

std::span<const SplitLaw> energy_splits() { return all_splits; }

}  // namespace pfdm
