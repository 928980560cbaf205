// Biot stress against the polar decomposition, and the energies at strengths against numbers by SciPy (roots of the
// principal forces of the polyurethane of Kamarei, Zeng, Dolbow, Lopez-Pamies, CMAME 448 (2026) 118449).

#include "physics/error.h"
#include "physics/materials/biot_stress.h"
#include "physics/materials/strength_model.h"
#include "tests/physics/physics_checks.h"

#include <cmath>
#include <memory>

namespace pfdm::this_file {
namespace {

constexpr double mu = 0.52e6, Lambda = 85.77e6, ts = 0.3e6, hs = 1e6, Gc = 41.0;

std::shared_ptr<const Material> polyurethane() {
  return make_hyperelastic("neo_hookean", {.elasticity = {.lambda = Lambda, .mu = mu}});
}

const HyperelasticMaterial& as_hyperelastic(const std::shared_ptr<const Material>& material) {
  return dynamic_cast<const HyperelasticMaterial&>(*material);
}

StrengthData strengths(double scale = 1.0) {
  return {.elasticity = {.lambda = Lambda, .mu = mu},
          .tensile = scale * ts,
          .hydrostatic = scale * hs,
          .Gc = Gc,
          .ell = 50e-6,
          .material = polyurethane()};
}

// F = R U, P = R T: the stress that is found has to be T, with T = sum t_i n_i n_i^T, t_i = mu (l - 1/l) + Lambda (J -
// 1) J/l.
TEST(BiotStress, IsThatOfThePrincipalForces) {
  RandomTensors random;
  const auto material = polyurethane();
  for (int i = 0; i < 20; ++i) {
    const Tensor Q = random.rotation(), R = random.rotation();
    const Vector l(0.7 + 0.05 * i, 1.1, 1.3 - 0.02 * i);
    const double J = l.prod();
    const Tensor F = R * Q * l.asDiagonal() * Q.transpose(), H = F - Tensor::Identity();
    Vector t;
    for (Index k = 0; k < 3; ++k) t[k] = mu * (l[k] - 1.0 / l[k]) + Lambda * (J - 1.0) * J / l[k];
    const Tensor due = Q * t.asDiagonal() * Q.transpose();
    const Tensor found = biot_stress(H, as_hyperelastic(material).potential(H).stress);
    EXPECT_LE((found - due).norm(), 1e-10 * due.norm());
  }
}

TEST(BiotStress, EnergiesAtTheStrengthsOfPolyurethane) {
  const StrengthEnergies W = energies_at_strengths(strengths());
  EXPECT_NEAR(W.tensile, 37308.952475628, 1e-4);
  EXPECT_NEAR(W.hydrostatic, 5718.4529965, 1e-4);
}

// 2 W + c of a sound cell is 3/8 delta Gc/ell at both strengths, with W by SciPy.
TEST(BiotStress, StrengthsOfPolyurethaneAreExact) {
  const StrengthLaw& law = strength_law("strength");
  for (const double ell : {200e-6, 50e-6, 5e-6}) {
    StrengthData data = strengths();
    data.ell = ell;
    const StrengthModel on(law, data, law.delta(data, 0.0));
    const double resistance = 3.0 / 8.0 * on.delta() * Gc / ell;
    EXPECT_NEAR(2.0 * 37308.952475628 + on.force(Vector(ts, 0.0, 0.0).asDiagonal()), resistance, 1e-8 * resistance);
    EXPECT_NEAR(2.0 * 5718.4529965 + on.force(hs * Tensor::Identity()), resistance, 1e-8 * resistance);
  }
}

TEST(BiotStress, WeakMaterialsHaveTheEnergiesOfSmallStrain) {
  StrengthData finite = strengths(1e-4), small = finite;
  small.material = nullptr;
  const StrengthEnergies W = energies_at_strengths(finite), due = energies_at_strengths(small);
  EXPECT_NEAR(W.tensile / due.tensile, 1.0, 1e-4);
  EXPECT_NEAR(W.hydrostatic / due.hydrostatic, 1.0, 1e-4);
}

// 4 mu (l^-0.5 - l^-1.25), incompressible, has its maximum 1.3 mu at a stretch of 3.4.
TEST(BiotStress, RefusesAStrengthAboveTheLargestStress) {
  const auto material =
      make_hyperelastic("ogden", {.elasticity = {.lambda = Lambda, .mu = mu}, .shares = {1.0}, .exponents = {0.5}});
  EXPECT_GT(energy_at_biot_stress(as_hyperelastic(material), 1.2 * mu * Vector::UnitX()), 0.0);
  EXPECT_THROW(energy_at_biot_stress(as_hyperelastic(material), 1.4 * mu * Vector::UnitX()), InputError);
}

}  // namespace
}  // namespace pfdm::this_file
