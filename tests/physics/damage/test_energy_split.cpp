#include "physics/damage/energy_split.h"
#include "physics/error.h"
#include "tests/physics/physics_checks.h"

namespace pfdm::this_file {
namespace {

// Every split, with an example of its parameters.
std::vector<EnergySplit> examples() {
  std::vector<EnergySplit> splits;
  for (const SplitLaw& law : energy_splits()) {
    LawParameters p{};
    for (std::size_t i = 0; i < law.parameters.size(); ++i) p[i] = 1.5 + double(i);
    splits.emplace_back(law, p);
  }
  return splits;
}

// Random strains of both signs of the trace, for one split after the other.
void for_splits_and_strains(const std::function<void(const EnergySplit&, const Tensor& eps)>& check,
                            bool variational_only = false) {
  for (const EnergySplit& split : examples()) {
    if (variational_only && !split.is_variational()) continue;
    SCOPED_TRACE(split.name());
    RandomTensors random;
    int expanding = 0, compressed = 0;
    for (int i = 0; i < 20; ++i) {
      const Tensor eps = random.symmetric(1e-2);
      ++(eps.trace() > 0.0 ? expanding : compressed);
      check(split, eps);
    }
    EXPECT_GT(expanding, 4);
    EXPECT_GT(compressed, 4);
  }
}

const IsotropicElasticity glass = from_young_poisson(70e9, 0.3);

TEST(EnergySplit, PartsAreNotNegativeAndAddUp) {
  for_splits_and_strains([](const EnergySplit& split, const Tensor& eps) {
    const auto [plus, minus] = split.energy(glass, eps);
    if (split.name() != "star_convex") {
      EXPECT_GE(plus, 0.0);
    }
    EXPECT_GE(minus, 0.0);
    if (split.is_variational()) {
      EXPECT_NEAR(plus + minus, energy_density(glass, eps), 1e-12 * energy_density(glass, eps));
    }
  });
}

TEST(EnergySplit, StressIsTheSlopeOfTheDegradedEnergy) {
  for (const double g : {1.0, 0.3, 1e-6})
    for_splits_and_strains(
        [g](const EnergySplit& split, const Tensor& eps) {
          const auto degraded = [&](const Tensor& e) {
            const auto [plus, minus] = split.energy(glass, e);
            return g * plus + minus;
          };
          const Tensor expected = slope(degraded, eps, 1e-6);
          const Tensor sigma = degraded_stress(split, glass, g, eps);
          EXPECT_LE((sigma - expected).norm(), 1e-7 * stress(glass, eps).norm()) << "g = " << g;
        },
        true);
}

TEST(EnergySplit, HalfTheStressTimesTheStrainIsTheDegradedEnergy) {
  for_splits_and_strains(
      [](const EnergySplit& split, const Tensor& eps) {
        constexpr double g = 0.3;
        const auto [plus, minus] = split.energy(glass, eps);
        EXPECT_NEAR(0.5 * contract(degraded_stress(split, glass, g, eps), eps), g * plus + minus,
                    1e-12 * (plus + minus));
      },
      true);
}

// Largest difference between the tangent and central differences of the stress, over the norm of the stiffness.
double tangent_error(const EnergySplit& split, double g, const Tensor& eps, double step) {
  const MandelMatrix tangent = degraded_tangent(split, glass, g, eps);
  EXPECT_LE((tangent - tangent.transpose()).norm(), 1e-14 * tangent.norm());
  double largest = 0.0;
  for (Index k = 0; k < 6; ++k) {
    const Tensor change = to_tensor(step * Mandel::Unit(k));
    const Tensor difference =
        (degraded_stress(split, glass, g, eps + change) - degraded_stress(split, glass, g, eps - change)) / (2 * step);
    largest = std::max(largest, (to_mandel(difference) - tangent.col(k)).norm());
  }
  return largest / glass.constrained_modulus();
}

TEST(EnergySplit, TangentIsTheSlopeOfTheStress) {
  for (const double g : {1.0, 0.3, 1e-6})
    for_splits_and_strains([g](const EnergySplit& split, const Tensor& eps) {
      EXPECT_LE(tangent_error(split, g, eps, 1e-8), 1e-6) << "g = " << g;
    });
}

// Two and three equal principal strains, exactly and nearly, whatever their signs.
TEST(EnergySplit, TangentIsTheSlopeOfTheStressAtRepeatedPrincipalStrains) {
  RandomTensors rotations;
  for (const EnergySplit& split : examples()) {
    SCOPED_TRACE(split.name());
    for (const Vector& principal : {Vector(2, 2, 1), Vector(-1, -1, 3), Vector(3, -2, -2), Vector(-3, -3, -1),
                                    Vector(1, 1, -4), Vector(1, 1, 1), Vector(-1, -1, -1)})
      for (const double apart : {0.0, 1e-15, 1e-12, 1e-9, 1e-7}) {
        const Tensor R = rotations.rotation();
        const Vector spread = principal + apart * Vector(1.0, -1.0, 0.5);
        const Tensor eps = 1e-3 * R * spread.asDiagonal() * R.transpose();
        EXPECT_LE(tangent_error(split, 0.3, symmetric_part(eps), 1e-8), 1e-6)
            << principal.transpose() << ", apart " << apart;
      }
  }
}

// The quotient (sigma_i - sigma_j) / (eps_i - eps_j) loses digits before the limit takes over.
TEST(EnergySplit, TangentIsAsGoodWhereTheLimitTakesOver) {
  const Tensor R = RandomTensors().rotation();
  for (const EnergySplit& split : examples()) {
    const auto at = [&](double apart) {
      return degraded_tangent(split, glass, 0.3,
                              R * Tensor(Vector(1e-3, 1e-3 * (1.0 + apart), -1.7e-3).asDiagonal()) * R.transpose());
    };
    EXPECT_LE((at(2e-8) - at(0.0)).norm(), 1e-6 * at(0.0).norm()) << split.name();
  }
}

TEST(EnergySplit, DegradableStressIsTheSlopeOfTheStressByTheFactor) {
  for_splits_and_strains([](const EnergySplit& split, const Tensor& eps) {
    if (!split.is_variational()) return;
    const Tensor slope =
        (degraded_stress(split, glass, 0.9, eps) - degraded_stress(split, glass, 0.4, eps)) / (0.9 - 0.4);
    EXPECT_LE((degradable_stress(split, glass, eps) - slope).norm(), 1e-12 * glass.young_modulus() * eps.norm());
  });
}

TEST(EnergySplit, TangentTimesStrainIsTheStressWhateverTheLength) {
  for_splits_and_strains([](const EnergySplit& split, const Tensor& eps) {
    const MandelMatrix one = degraded_tangent(split, glass, 0.3, eps),
                       other = degraded_tangent(split, glass, 0.3, 1e-7 * eps);
    EXPECT_LE((one - other).norm(), 1e-9 * one.norm());
  });
}

// A tangent with a direction of negative stiffness would make the balance of momentum unstable.
TEST(EnergySplit, TangentIsPositiveDefinite) {
  for_splits_and_strains([](const EnergySplit& split, const Tensor& eps) {
    constexpr double g = 1e-3;
    const Eigen::SelfAdjointEigenSolver<MandelMatrix> eigen(degraded_tangent(split, glass, g, eps));
    EXPECT_GE(eigen.eigenvalues()[0], 0.999 * g * std::min(2.0 * glass.mu, 3.0 * glass.bulk_modulus()));
  });
}

TEST(EnergySplit, SplitsSayEitherSecantModuliOrWhatIsKept) {
  for (const EnergySplit& split : examples()) {
    EXPECT_EQ(split.has_secant(), split.law().closure != nullptr) << split.name();
    EXPECT_NE(split.has_secant(), split.law().kept != nullptr) << split.name();
  }
}

TEST(EnergySplit, UndamagedSecantDoesNotDependOnTheClosure) {
  for (const EnergySplit& split : examples())
    for (const double closure : {0.0, 0.5, 1.0}) {
      if (!split.has_secant()) continue;
      EXPECT_NEAR(split.secant(glass, 1.0, closure).lambda, glass.lambda, 1e-12 * glass.lambda) << split.name();
      EXPECT_NEAR(split.secant(glass, 1.0, closure).mu, glass.mu, 1e-12 * glass.mu) << split.name();
    }
}

TEST(EnergySplit, DoesNotDependOnTheAxes) {
  RandomTensors rotations;
  for_splits_and_strains([&](const EnergySplit& split, const Tensor& eps) {
    const Tensor R = rotations.rotation();
    const Tensor turned = R * eps * R.transpose();
    const double psi = energy_density(glass, eps);
    EXPECT_NEAR(split.energy(glass, turned).psi_plus, split.energy(glass, eps).psi_plus, 1e-12 * psi);
    const Tensor sigma = degraded_stress(split, glass, 0.3, eps);
    const Tensor sigma_turned = degraded_stress(split, glass, 0.3, turned);
    EXPECT_LE((sigma_turned - R * sigma * R.transpose()).norm(), 1e-12 * sigma.norm());
  });
}

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

TEST(EnergySplit, ParametersWithoutADefaultMustBeGiven) {
  EXPECT_THAT(message_of<InputError>([] { energy_split("star_convex"); }), ::testing::HasSubstr("gamma"));
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

TEST(EnergySplit, NoTensionBearsNoTension) {
  for_splits_and_strains([](const EnergySplit& split, const Tensor& eps) {
    if (split.name() != "no_tension") return;
    const Vector sigma = principal_axes(degraded_stress(split, glass, 0.0, eps)).value;
    EXPECT_LE(sigma[2], 1e-12 * stress(glass, eps).norm());
  });
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

TEST(EnergySplit, UnknownNamesAreAnsweredWithThoseThereAre) {
  expect_unknown_name_is_answered(energy_splits(), split_law);
}

}  // namespace
}  // namespace pfdm::this_file
