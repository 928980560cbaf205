// The energy release rate in sectors about an axis: of a crack in the shape of a penny, G = 4 (1 - nu^2) p^2 a/(pi E)
// (Sneddon, Proc. R. Soc. London A 187 (1946) 229), and of a bar that is pulled out of a rigid wall, of the shape of a
// tube: G = p^2 a/(4 E).

#include "mesh/generators/cylinder_sector.h"
#include "postproc/fields/energy_release_rate.h"
#include "tests/verification/support.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace pfdm::verification::energy_release_about_axis {
namespace {

constexpr double E = 1e9, nu = 0.3, p = 1e6, a = 1e-3;

double measured(const Mesh& mesh, std::vector<BoundaryCondition> boundary, double poisson, const TipRegion& ring) {
  boundary.push_back(axisymmetric_on("front"));
  boundary.push_back(axisymmetric_on("back"));
  const FractureModel model = elastic_model({from_young_poisson(E, poisson)}, std::move(boundary));
  const auto solution = solve_elastic(mesh, model);
  OutputFields fields;
  fields.damage = CellField<double>(mesh.n_cells(), 0.0);
  fields.strain = solution->cells.strain;
  fields.gradient = solution->cells.gradient;
  fields.stress = solution->cells.stress;
  return energy_release_rate(mesh, fields, ring).G;
}

TipRegion ring_about(const Vector& point, const Vector& direction, double inner, double outer) {
  return {.name = "tip",
          .point = point,
          .direction = direction,
          .front = Vector::UnitY(),
          .shape = &region_shapes().front(),
          .inner = inner,
          .outer = outer,
          .is_about_axis = true};
}

Vector up(const Vector&) { return {0.0, 0.0, p}; }

// Half of a cylinder of radius and height 12 a, the crack in its plane of symmetry: half of the body has half of G.
double of_a_penny(Index n, double inner, double outer) {
  const Mesh mesh = make_cylinder_sector({.azimuth = 0.05,
                                          .radius = {{a, n, 0.1}, {11.0 * a, 2 * n, 60.0}},
                                          .height = {{12.0 * a, 2 * n, 80.0}},
                                          .patches = {{.name = "crack", .outer_radius = a}}});
  return 2.0 * measured(mesh, {symmetry_on("bottom"), traction_on("top", up)}, nu,
                        ring_about({a, 0.0, 0.0}, Vector::UnitX(), inner, outer));
}

// A bar of radius a that a clamped wall holds along z > 0 and that is pulled at z < 0: as the bond tears on, bar that
// is free takes the place of bar that has no stress, pi a^2 p^2/(2 E) per length on a front of 2 pi a.
double of_a_pull_out(Index n, double inner, double outer) {
  const Mesh mesh = make_cylinder_sector(
      {.azimuth = 0.05,
       .bottom = -4.0 * a,
       .radius = {{a, n, 0.3}},
       .height = {{4.0 * a, 3 * n, 0.1}, {4.0 * a, 3 * n, 10.0}},
       .patches = {{.name = "bond", .inner_radius = a, .outer_radius = a, .bottom = 0.0, .top = 4.0 * a}}});
  const auto held = [](const Vector&) -> Vector { return Vector::Zero(); };
  const auto down = [](const Vector& x) -> Vector { return -up(x); };
  return measured(mesh, {displacement_on("bond", held), traction_on("bottom", down)}, 0.0,
                  ring_about({a, 0.0, 0.0}, Vector::UnitZ(), inner, outer));
}

TEST(EnergyReleaseAboutAnAxis, OfAPennyIsSneddons) {
  const double due = 4.0 * (1.0 - nu * nu) * p * p * a / (std::numbers::pi * E);
  std::vector<double> errors;
  for (const Index n : {15, 30}) {
    const double wide = of_a_penny(n, 0.3 * a, 0.7 * a) / due, narrow = of_a_penny(n, 0.15 * a, 0.4 * a) / due;
    report_row("n = " + std::to_string(n), {{"G/Sneddon's, ring 0.3-0.7 a", wide}, {"0.15-0.4 a", narrow}});
    EXPECT_NEAR(narrow, wide, 0.01);
    errors.push_back(wide - 1.0);
  }
  EXPECT_NEAR(errors[1], 0.0, 0.02);
  EXPECT_LT(std::abs(errors[1]), 0.8 * std::abs(errors[0]));
}

TEST(EnergyReleaseAboutAnAxis, OfABarPulledOutIsWhatItsFreePartStores) {
  const double due = p * p * a / (4.0 * E);
  for (const Index n : {12, 24}) {
    const double wide = of_a_pull_out(n, 0.3 * a, 0.8 * a) / due, narrow = of_a_pull_out(n, 0.2 * a, 0.5 * a) / due;
    report_row("n = " + std::to_string(n), {{"G/closed form, ring 0.3-0.8 a", wide}, {"0.2-0.5 a", narrow}});
    EXPECT_NEAR(wide, 1.0, 0.03);
    EXPECT_NEAR(narrow, wide, 0.01);
  }
}

}  // namespace
}  // namespace pfdm::verification::energy_release_about_axis
