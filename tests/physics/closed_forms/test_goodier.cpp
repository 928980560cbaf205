#include "physics/closed_forms/goodier.h"

#include <cmath>

#include "tests/physics/physics_checks.h"

namespace pfdm::this_file {
namespace {

const IsotropicElasticity glass = from_young_poisson(70e9, 0.3);
const IsotropicElasticity sylgard = from_young_poisson(75e6, 0.44);
constexpr double radius = 100e-6;  // [m]
constexpr double remote = 1e6;     // [Pa]

Goodier bead() { return {glass, sylgard, radius, remote}; }

TEST(Goodier, DisplacementAndTractionAreContinuous) {
  const Goodier field = bead();
  RandomTensors random;
  for (int i = 0; i < 20; ++i) {
    const Vector n = random.direction();
    const Vector below = n * radius * (1.0 - 1e-10), above = n * radius * (1.0 + 1e-10);
    EXPECT_LE((field.displacement(above) - field.displacement(below)).norm(), 1e-9 * remote / 75e6 * radius);
    EXPECT_LE((field.stress(above) * n - field.stress(below) * n).norm(), 1e-6 * remote);
    EXPECT_NEAR(field.interface_normal_traction(n[2]), n.dot(field.stress(below) * n), 1e-6 * remote);
  }
}

TEST(Goodier, GradientIsThatOfTheDisplacement) {
  const Goodier field = bead();
  RandomTensors random;
  for (const double r : {0.4, 1.001, 1.3, 3.0}) {
    const Vector x = r * radius * random.direction();
    Tensor expected;
    for (int j = 0; j < 3; ++j) {
      const Vector step = 1e-5 * radius * Vector::Unit(j);
      expected.col(j) = (field.displacement(x + step) - field.displacement(x - step)) / (2e-5 * radius);
    }
    EXPECT_LE((field.gradient(x) - expected).norm(), 1e-8 * expected.norm() + 1e-12) << r;
  }
}

TEST(Goodier, StressIsInEquilibrium) {
  const Goodier field = bead();
  RandomTensors random;
  for (const double r : {0.4, 1.01, 1.3, 3.0}) {
    const Vector x = r * radius * random.direction();
    const double step = 1e-4 * radius;
    Vector divergence = Vector::Zero();
    for (int j = 0; j < 3; ++j)
      divergence += (field.stress(x + step * Vector::Unit(j)) - field.stress(x - step * Vector::Unit(j))).col(j);
    EXPECT_LE(divergence.norm() / (2.0 * step), 1e-6 * remote / radius) << r;
  }
}

TEST(Goodier, RemoteStressIsUniaxial) {
  const Tensor far = bead().stress({2e3 * radius, -1e3 * radius, 3e3 * radius});
  EXPECT_LE((far - Tensor(Vector(0.0, 0.0, remote).asDiagonal())).norm(), 1e-9 * remote);
}

// literature.md 5.1: glass in Sylgard.
TEST(Goodier, PoleAndEquatorOfGlassInSylgard) {
  const Goodier field = bead();
  EXPECT_NEAR(field.interface_normal_traction(1.0) / remote, 1.942210, 1e-6);
  EXPECT_NEAR(field.interface_normal_traction(0.0) / remote, -0.388118, 1e-6);
}

// On the axis the largest radial stress lies ahead of the bead (literature.md 5.1).
TEST(Goodier, AxialProfileOfGlassInSylgard) {
  const Goodier field = bead();
  const double table[][2] = {{1.05, 2.081}, {1.1, 2.142}, {1.2, 2.133}, {1.5, 1.827}, {2.0, 1.430}, {3.0, 1.144}};
  for (const auto& [r, stress] : table)
    EXPECT_NEAR(field.stress({0.0, 0.0, r * radius})(2, 2) / remote, stress, 6e-4) << r;
  const double displacements[][2] = {{1.1, 0.10375}, {1.2, 0.25312}, {2.0, 1.52609}, {5.0, 4.91412}};
  for (const auto& [r, u] : displacements)
    EXPECT_NEAR(field.displacement({0.0, 0.0, r * radius})[2] * 75e6 / (remote * radius), u, 1e-5) << r;
}

TEST(Goodier, EqualMaterialsFeelNoSphere) {
  const Goodier field(sylgard, sylgard, radius, remote);
  const Tensor uniaxial = Vector(0.0, 0.0, remote).asDiagonal();
  for (const double r : {0.3, 1.0, 2.0})
    EXPECT_LE((field.stress({0.6 * r * radius, 0.0, 0.8 * r * radius}) - uniaxial).norm(), 1e-9 * remote);
}

}  // namespace
}  // namespace pfdm::this_file
