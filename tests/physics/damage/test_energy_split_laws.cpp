// Energy splits one by one: what each keeps and what drives damage, by hand, by search and by the papers.

#include "physics/damage/energy_split.h"
#include "tests/physics/physics_checks.h"

#include <algorithm>
#include <cmath>

namespace pfdm::this_file {
namespace {

const IsotropicElasticity glass = from_young_poisson(70e9, 0.3);

// Of strains whose C^(1/2) eps has these principal values half the sum of the squares of the positive ones is degraded;
// without Poisson's effect that is the spectral split.
TEST(EnergySplit, OrthogonalSplitsTheSquareRootOfTheEnergy) {
  const EnergySplit split = energy_split("orthogonal");
  const Tensor R = RandomTensors().rotation();
  const Vector root(3.0, -1.0, -4.0);  // Pa^(1/2)
  const double mean = root.mean() / std::sqrt(3.0 * glass.bulk_modulus());
  const Vector strain = Vector::Constant(mean) + (root - Vector::Constant(root.mean())) / std::sqrt(2.0 * glass.mu);
  const SplitEnergy energy = split.energy(glass, R * strain.asDiagonal() * R.transpose());
  EXPECT_NEAR(energy.psi_plus, 4.5, 1e-12);
  EXPECT_NEAR(energy.psi_minus, 8.5, 1e-12);
  const IsotropicElasticity cork = from_young_poisson(1e9, 0.0);
  RandomTensors random;
  for (int i = 0; i < 10; ++i) {
    const Tensor eps = random.symmetric(1e-3);
    EXPECT_NEAR(split.energy(cork, eps).psi_plus, energy_split("spectral").energy(cork, eps).psi_plus,
                1e-12 * 1e9 * 1e-6);
  }
}

TEST(EnergySplit, VolumetricDeviatoricKeepsCompressionAlone) {
  const EnergySplit split = energy_split("volumetric_deviatoric");
  const Tensor compression = -1e-3 * Tensor::Identity();
  EXPECT_NEAR(split.energy(glass, compression).psi_plus, 0.0, 1e-20);
  EXPECT_LE(
      (stress(split.secant(glass, 1e-6, split.closure(compression)), compression) - stress(glass, compression)).norm(),
      1e-3);
  Tensor shear = Tensor::Zero();
  shear(0, 1) = shear(1, 0) = 1e-3;
  EXPECT_EQ(split.energy(glass, shear).psi_minus, 0.0);
}

// Vicentini 2024: hydrostatic compression and shear, by hand.
TEST(EnergySplit, StarConvexLowersTheDrivingEnergyByCompression) {
  constexpr double gamma = 4.0, e = 1e-3, s = 2e-3;
  const EnergySplit split(split_law("star_convex"), {gamma});
  const double K = glass.bulk_modulus();
  Tensor eps = -e / 3.0 * Tensor::Identity();
  eps(0, 1) = eps(1, 0) = s;
  const auto [plus, minus] = split.energy(glass, eps);
  EXPECT_NEAR(plus, 2.0 * glass.mu * s * s - gamma * 0.5 * K * e * e, 1e-12 * K * e * e);
  EXPECT_NEAR(minus, (1.0 + gamma) * 0.5 * K * e * e, 1e-12 * K * e * e);
  const EnergySplit without(split_law("star_convex"), {0.0}), amor = energy_split("volumetric_deviatoric");
  EXPECT_NEAR(without.energy(glass, eps).psi_plus, amor.energy(glass, eps).psi_plus, 1e-12 * K * e * e);
  EXPECT_LE((degraded_stress(without, glass, 0.1, eps) - degraded_stress(amor, glass, 0.1, eps)).norm(), 1e-9 * K * e);
}

// Uniaxial stress, by hand from its volumetric and deviatoric parts: what damages in compression falls with gamma.
TEST(EnergySplit, StarConvexTellsCompressionFromTension) {
  const double K = glass.bulk_modulus(), mu = glass.mu;
  const auto driving = [&](double gamma, double sign) {  // of the stress sign * 1 Pa
    const double tr = sign / (3.0 * K), dev = sign / (2.0 * mu) * std::sqrt(2.0 / 3.0);
    const double volume = 0.5 * K * tr * tr;
    return mu * dev * dev + (sign > 0.0 ? volume : -gamma * volume);
  };
  for (const double gamma : {0.0, 1.0, 5.0}) {
    const EnergySplit split(split_law("star_convex"), {gamma});
    for (const double sign : {1.0, -1.0}) {
      const double E = glass.young_modulus(), nu = glass.poisson_ratio();
      const Tensor eps = Vector(sign / E, -nu * sign / E, -nu * sign / E).asDiagonal();
      EXPECT_NEAR(split.energy(glass, eps).psi_plus, driving(gamma, sign), 1e-9 * driving(0.0, 1.0));
    }
  }
}

// Least energy over all crack strains with tr eta >= 6 B sqrt(J2(eta)), by ternary search over their sqrt(J2); the
// optimal one has the deviator's direction.
TEST(EnergySplit, DruckerPragerKeepsTheLeastEnergy) {
  RandomTensors random;
  const double K = glass.bulk_modulus();
  for (const double B : {0.0, 0.1, 0.4, 1.5})
    for (int i = 0; i < 40; ++i) {
      const Tensor eps = random.symmetric(1e-2);
      const Tensor shear = deviator(eps);
      const double trace = eps.trace(), size = std::sqrt(0.5 * contract(shear, shear));
      const auto energy_less = [&](double crack) {
        const double closed = std::max(6.0 * B * crack - trace, 0.0);
        return 0.5 * K * closed * closed + 2.0 * glass.mu * (size - crack) * (size - crack);
      };
      double low = 0.0, high = size;
      for (int k = 0; k < 200; ++k) {
        const double third = (high - low) / 3.0;
        if (energy_less(low + third) > energy_less(high - third))
          low += third;
        else
          high -= third;
      }
      const SplitEnergy energy = EnergySplit(split_law("drucker_prager"), {B}).energy(glass, eps);
      EXPECT_NEAR(energy.psi_minus, energy_less(0.5 * (low + high)), 1e-9 * energy_density(glass, eps)) << "B = " << B;
    }
}

TEST(EnergySplit, DruckerPragerWithoutFrictionIsVolumetricDeviatoric) {
  const EnergySplit split(split_law("drucker_prager"), {0.0}), amor = energy_split("volumetric_deviatoric");
  RandomTensors random;
  for (int i = 0; i < 20; ++i) {
    const Tensor eps = random.symmetric(1e-2);
    EXPECT_NEAR(split.energy(glass, eps).psi_plus, amor.energy(glass, eps).psi_plus,
                1e-12 * energy_density(glass, eps));
    EXPECT_LE((degraded_stress(split, glass, 0.1, eps) - degraded_stress(amor, glass, 0.1, eps)).norm(),
              1e-9 * stress(glass, eps).norm());
  }
}

// AT1 breaks sound material where psi_plus reaches w, here in 200 directions of stress (De Lorenzis, Maurini 2022).
TEST(EnergySplit, StrengthSurfacesAreThoseOfThePapers) {
  constexpr double w = 1e4, B = 0.2, gamma = 3.0;
  const double K = glass.bulk_modulus(), mu = glass.mu, E = glass.young_modulus(), nu = glass.poisson_ratio();
  const EnergySplit drucker_prager(split_law("drucker_prager"), {B}), star_convex(split_law("star_convex"), {gamma});
  int n_on_plane = 0, n_on_ellipsoid = 0, n_never = 0;
  for (int i = 0; i < 200; ++i) {
    const double z = -1.0 + (i + 0.5) / 100.0, turn = 2.399963 * i, r = std::sqrt(1.0 - z * z);
    const Vector sigma(r * std::cos(turn), r * std::sin(turn), z);
    const Tensor eps = Vector((1.0 + nu) / E * sigma.array() - nu / E * sigma.sum()).asDiagonal();
    const Vector s = sigma.array() - sigma.sum() / 3.0;
    const double I1 = sigma.sum(), shear = std::sqrt(0.5 * s.squaredNorm());
    const double whole = shear * shear / (2.0 * mu) + I1 * I1 / (18.0 * K);
    const auto strength = [&](const EnergySplit& split) { return std::sqrt(w / split.energy(glass, eps).psi_plus); };
    if (shear + B * I1 <= 0.0) {
      ++n_never;
      EXPECT_NEAR(drucker_prager.energy(glass, eps).psi_plus, 0.0, 1e-12 * whole);
    } else if (I1 / (3.0 * K) >= 3.0 * B * shear / mu) {
      ++n_on_ellipsoid;
      EXPECT_NEAR(strength(drucker_prager), std::sqrt(w / whole), 1e-9 * strength(drucker_prager));
    } else {
      ++n_on_plane;
      const double due = std::sqrt(2.0 * w * (mu + 9.0 * B * B * K)) / (shear + B * I1);
      EXPECT_NEAR(strength(drucker_prager), due, 1e-6 * due);
    }
    const double star = shear * shear / (2.0 * mu) + (I1 > 0.0 ? 1.0 : -gamma) * I1 * I1 / (18.0 * K);
    if (star > 0.0) {
      EXPECT_NEAR(strength(star_convex), std::sqrt(w / star), 1e-6 * std::sqrt(w / star));
    }
  }
  EXPECT_GT(n_on_plane, 50);
  EXPECT_GT(n_on_ellipsoid, 10);
  EXPECT_GT(n_never, 5);
}

// eqs. 19-23 of Miehe 2010 written out: lambda/2 <tr>^2 + mu sum <eps_i>^2, either side.
TEST(EnergySplit, SpectralEnergiesAreThoseOfThePaper) {
  const EnergySplit split = energy_split("spectral");
  for (const Vector& e : {Vector(1, 2, 3), Vector(-1, 2, 3), Vector(-3, -1, 2), Vector(-3, -2, -1), Vector(-2, 0, 1)}) {
    const Vector eps = 1e-3 * e;
    const double plus =
        0.5 * glass.lambda * std::pow(std::max(eps.sum(), 0.0), 2) + glass.mu * eps.cwiseMax(0.0).squaredNorm();
    const double minus =
        0.5 * glass.lambda * std::pow(std::min(eps.sum(), 0.0), 2) + glass.mu * eps.cwiseMin(0.0).squaredNorm();
    const Tensor R = RandomTensors().rotation();
    const SplitEnergy energy = split.energy(glass, R * Tensor(eps.asDiagonal()) * R.transpose());
    EXPECT_NEAR(energy.psi_plus, plus, 1e-12 * (plus + minus)) << e.transpose();
    EXPECT_NEAR(energy.psi_minus, minus, 1e-12 * (plus + minus)) << e.transpose();
  }
}

// Least energy over all crack strains that open: a search over them finds nothing lower.
TEST(EnergySplit, NoTensionKeepsTheLeastEnergy) {
  const EnergySplit split = energy_split("no_tension");
  RandomTensors random;
  for (int i = 0; i < 20; ++i) {
    const Vector eps = principal_axes(random.symmetric(1e-2)).value;
    const auto energy_less = [&](const Vector& crack) {
      return energy_density(glass, Vector(eps - crack.cwiseMax(0.0)).asDiagonal());
    };
    Vector crack = Vector::Zero();
    for (int sweep = 0; sweep < 500; ++sweep)  // coordinate descent, each direction solved exactly
      for (Index k = 0; k < 3; ++k) {
        const double others = eps.sum() - crack.sum() - (eps[k] - crack[k]);
        crack[k] = std::max(eps[k] + glass.lambda * others / glass.constrained_modulus(), 0.0);
      }
    EXPECT_NEAR(split.energy(glass, eps.asDiagonal()).psi_minus, energy_less(crack),
                1e-9 * energy_density(glass, eps.asDiagonal()));
  }
}

// A crack that is pressed shut is as stiff as sound material.
TEST(EnergySplit, CompressionIsKept) {
  const Tensor R = RandomTensors().rotation();
  const double E = glass.young_modulus(), nu = glass.poisson_ratio();
  const Tensor hydrostatic = -1e-3 * Tensor::Identity();
  const Tensor uniaxial = -1e-3 * (R * Tensor(Vector(1.0, -nu, -nu).asDiagonal()) * R.transpose());
  for (const char* name : {"volumetric_deviatoric", "spectral", "no_tension"}) {
    const EnergySplit split = energy_split(name);
    EXPECT_LE((degraded_stress(split, glass, 1e-6, hydrostatic) - stress(glass, hydrostatic)).norm(), 1e-5 * E * 1e-3)
        << name;
    EXPECT_EQ(degraded_stress(split, glass, 1e-6, Tensor::Zero()).norm(), 0.0);
  }
  EXPECT_LE((degraded_stress(energy_split("no_tension"), glass, 1e-6, uniaxial) - stress(glass, uniaxial)).norm(),
            1e-5 * E * 1e-3);
}

// Uniaxial stress: the driving energy is the whole one in tension, none in compression, whatever nu.
TEST(EnergySplit, RankineIsDrivenByTheLargestPrincipalStress) {
  const EnergySplit split = energy_split("rankine");
  const double E = glass.young_modulus(), nu = glass.poisson_ratio(), sigma = 40e6;
  const Tensor R = RandomTensors().rotation();
  const Tensor tension = R * Tensor(Vector(sigma / E, -nu * sigma / E, -nu * sigma / E).asDiagonal()) * R.transpose();
  EXPECT_NEAR(split.energy(glass, tension).psi_plus, energy_density(glass, tension), 1e-10 * sigma * sigma / E);
  EXPECT_NEAR(split.energy(glass, -tension).psi_plus, 0.0, 1e-12 * sigma * sigma / E);
  const Tensor hydrostatic = sigma * (1.0 - 2.0 * nu) / E * Tensor::Identity();
  EXPECT_NEAR(split.energy(glass, hydrostatic).psi_plus, 0.5 * sigma * sigma / E, 1e-10 * sigma * sigma / E);
}

TEST(EnergySplit, HybridIsDrivenAsAmorsAndKeepsNothing) {
  const EnergySplit hybrid = energy_split("hybrid"), amor = energy_split("volumetric_deviatoric");
  RandomTensors random;
  for (int i = 0; i < 20; ++i) {
    const Tensor eps = random.symmetric(1e-2);
    EXPECT_EQ(hybrid.energy(glass, eps).psi_plus, amor.energy(glass, eps).psi_plus);
    EXPECT_LE((degraded_stress(hybrid, glass, 0.1, eps) - 0.1 * stress(glass, eps)).norm(),
              1e-14 * stress(glass, eps).norm());
  }
}

}  // namespace
}  // namespace pfdm::this_file
