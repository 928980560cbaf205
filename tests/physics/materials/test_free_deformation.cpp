// Free deformation at finite strain: its stress, tangent and energy slope are derivatives of J* W(F F*^-1).

#include "physics/materials/free_deformation.h"
#include "physics/materials/hyperelastic.h"
#include "tests/physics/physics_checks.h"

namespace pfdm::this_file {
namespace {

const Tensor swelling = (Tensor() << 0.25, 0.08, -0.05, 0.08, -0.12, 0.04, -0.05, 0.04, 0.4).finished();
const Tensor gradient = (Tensor() << 0.3, 0.2, -0.1, -0.15, 0.1, 0.05, 0.07, -0.2, 0.45).finished();

std::shared_ptr<const Material> rubber() {
  return make_hyperelastic("ogden", {.elasticity = from_young_poisson(2e6, 0.4),
                                     .volumetric = VolumetricForm::logarithmic,
                                     .shares = {1.2, -0.2},
                                     .exponents = {1.3, -2.0}});
}

// By W alone, from F and F*.
double energy(const Tensor& H, const Tensor& eigenstrain) {
  const Tensor one = Tensor::Identity(), F_e = (one + H) * (one + eigenstrain).inverse();
  const auto material = rubber();
  return (one + eigenstrain).determinant() *
         dynamic_cast<const HyperelasticMaterial&>(*material).potential(F_e - one).energy;
}

PotentialAt elastic_at(const Tensor& H, const FreeDeformation& free) {
  const auto material = rubber();
  return dynamic_cast<const HyperelasticMaterial&>(*material).potential(free.elastic(H));
}

TEST(FreeDeformation, StressIsTheSlopeOfTheEnergyPerReferenceVolume) {
  const FreeDeformation free(swelling);
  const Tensor P = free.stress(elastic_at(gradient, free).stress);
  for (Index i = 0; i < 3; ++i)
    for (Index j = 0; j < 3; ++j) {
      const Tensor change = 1e-5 * Vector::Unit(i) * Vector::Unit(j).transpose();
      const double slope = (energy(gradient + change, swelling) - energy(gradient - change, swelling)) / 2e-5;
      EXPECT_NEAR(P(i, j), slope, 1e-7 * P.norm());
    }
}

TEST(FreeDeformation, TangentIsTheSlopeOfTheStress) {
  const FreeDeformation free(swelling);
  const GradientTangent A = free.tangent(elastic_at(gradient, free).tangent);
  for (Index k = 0; k < 9; ++k) {
    const Tensor change = 1e-5 * from_components(Components::Unit(k));
    const Tensor slope = (free.stress(elastic_at(gradient + change, free).stress) -
                          free.stress(elastic_at(gradient - change, free).stress)) /
                         2e-5;
    EXPECT_LE((A.col(k) - to_components(slope)).norm(), 1e-7 * A.norm());
  }
}

TEST(FreeDeformation, EnergySlopeIsThatByTheFreeDeformation) {
  const FreeDeformation free(swelling);
  const Tensor P = free.stress(elastic_at(gradient, free).stress);
  const Tensor found = free.energy_slope(energy(gradient, swelling), P, gradient);
  for (Index i = 0; i < 3; ++i)
    for (Index j = 0; j < 3; ++j) {
      const Tensor change = 1e-5 * Vector::Unit(i) * Vector::Unit(j).transpose();
      const double slope = (energy(gradient, swelling + change) - energy(gradient, swelling - change)) / 2e-5;
      EXPECT_NEAR(found(i, j), slope, 1e-7 * found.norm());
    }
}

TEST(FreeDeformation, ElasticPartsLoseNoDigitsAndComeBack) {
  const FreeDeformation large(swelling), small(1e-9 * swelling);
  EXPECT_LE((large.total(large.elastic(gradient)) - gradient).norm(), 1e-15);
  EXPECT_LE((small.elastic(1e-9 * gradient) - 1e-9 * (gradient - swelling)).norm(), 1e-17);
  EXPECT_NEAR(small.change(), 1e-9 * swelling.trace(), 1e-17);
  EXPECT_NEAR(large.elastic_change(volume_change(gradient)), volume_change(large.elastic(gradient)), 1e-15);
  EXPECT_EQ(FreeDeformation().elastic(gradient), gradient);
  EXPECT_EQ(FreeDeformation().volume(), 1.0);
}

}  // namespace
}  // namespace pfdm::this_file
