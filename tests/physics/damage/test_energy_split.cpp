#include "physics/damage/energy_split.h"
#include "physics/error.h"
#include "tests/physics/physics_checks.h"

#include <algorithm>
#include <functional>
#include <vector>

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

TEST(EnergySplit, ParametersWithoutADefaultMustBeGiven) {
  EXPECT_THAT(message_of<InputError>([] { energy_split("star_convex"); }), ::testing::HasSubstr("gamma"));
}

TEST(EnergySplit, UnknownNamesAreAnsweredWithThoseThereAre) {
  expect_unknown_name_is_answered(energy_splits(), split_law);
}

TEST(EnergySplit, NoTensionBearsNoTension) {
  for_splits_and_strains([](const EnergySplit& split, const Tensor& eps) {
    if (split.name() != "no_tension") return;
    const Vector sigma = principal_axes(degraded_stress(split, glass, 0.0, eps)).value;
    EXPECT_LE(sigma[2], 1e-12 * stress(glass, eps).norm());
  });
}

}  // namespace
}  // namespace pfdm::this_file
