// A linear displacement is reproduced exactly on every kind of cell and with every kind of boundary.

#include "tests/verification/support.h"

#include <gtest/gtest.h>

namespace pfdm::verification {
namespace {

const Tensor slope = (Tensor() << 1.0, 0.3, -0.2, 0.1, -0.7, 0.4, 0.25, -0.15, 0.6).finished() * 1e-3;

DisplacementField linear() {
  return [](const Vector& x) -> Vector { return slope * x; };
}

void expect_exact(const Mesh& mesh, const FractureModel& model) {
  const auto solution = solve_elastic(mesh, model, {}, 1e-12);
  const double error = relative_error(
      mesh, [&](Index c) { return solution->u[as_size(c)]; }, [&](Index c) -> Vector { return slope * mesh.cell_centre[c]; },
      [](Index) { return true; });
  std::printf("%d cells, %d iterations, residual %.1e, error %.1e\n", mesh.n_cells(), solution->equilibrium.iterations,
              solution->equilibrium.residual, error);
  EXPECT_LE(error, 1e-9);
  const IsotropicElasticity& c = model.regions.front().elasticity;
  const Tensor truth = stress(c, symmetric_part(slope));
  EXPECT_LE(relative_stress_error(mesh, solution->cells.stress, [&](const Vector&) { return truth; }, [](Index) { return true; }), 1e-9);
}

TEST(PatchTest, DisplacementOnTetrahedraAndPrisms) {
  const Mesh mesh = sphere_in_cube(4, 5, 3.0, 0.5);
  const IsotropicElasticity c = from_young_poisson(75e6, 0.44);
  expect_exact(mesh, elastic_model({c, c, c}, displacement_on_all(mesh, linear())));
}

TEST(PatchTest, TractionOnTetrahedraAndPrisms) {
  const Mesh mesh = sphere_in_cube(4, 5, 3.0, 0.5);
  const IsotropicElasticity c = from_young_poisson(75e6, 0.44);
  auto boundary = displacement_on_all(mesh, linear());
  const Tensor sigma = stress(c, symmetric_part(slope));
  for (BoundaryCondition& b : boundary)
    if (b.patch == "xmax" || b.patch == "ymin")
      b = traction_on(b.patch, [&, outward = b.patch == "xmax" ? Vector(1, 0, 0) : Vector(0, -1, 0)](const Vector&) -> Vector { return sigma * outward; });
  expect_exact(mesh, elastic_model({c, c, c}, boundary));
}

}  // namespace
}  // namespace pfdm::verification
