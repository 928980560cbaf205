// The energy release rate by G-theta, on a sharp slit under the displacements of its own field:
// G = (K_I^2 + K_II^2) (1 - nu^2)/E.

#include "postproc/fields/energy_release_rate.h"
#include "tests/verification/near_field.h"
#include "tests/verification/support.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pfdm::verification {
namespace {

constexpr double E = 210e9, nu = 0.3, G_exact = 2700.0;

struct SlitPlate {
  Mesh mesh;
  OutputFields fields;
};

// A square of 2 mm, slit to its middle, n cells a side; K in units of sqrt(E' G).
SlitPlate solve(Index n, double K_I, double K_II) {
  constexpr double half = 1e-3;
  SlitPlate plate;
  plate.mesh = make_box_hexes({.origin = {-half, -half, 0.0},
                               .axes = {{{{2.0 * half, n, 1.0}}, {{2.0 * half, n, 1.0}}, {{2.5e-4, 1, 1.0}}}},
                               .regions = {},
                               .slits = {{"slit", {-half, 0.0, 0.0}, {0.0, 0.0, 1.0}}}});
  const IsotropicElasticity elasticity = from_young_poisson(E, nu);
  const double K = std::sqrt(E / (1.0 - nu * nu) * G_exact);
  std::vector<BoundaryCondition> boundary{plane_on("zmin"), plane_on("zmax")};
  for (const char* side : {"xmin", "xmax", "ymin", "ymax"})
    boundary.push_back(
        displacement_on(side, [=](const Vector& x) { return near_field(elasticity, x, K * K_I, K * K_II); }));
  const FractureModel model = elastic_model({elasticity}, boundary);
  const auto solution = solve_elastic(plate.mesh, model);
  plate.fields.damage = CellField<double>(as_size(plate.mesh.n_cells()), 0.0);
  plate.fields.strain = solution->cells.strain;
  plate.fields.gradient = solution->cells.gradient;
  plate.fields.stress = solution->cells.stress;
  return plate;
}

double measured(const SlitPlate& plate, std::string_view shape, double inner, double outer) {
  TipRegion region{.name = "tip", .inner = inner, .outer = outer};
  for (const RegionShape& s : region_shapes())
    if (s.name == shape) region.shape = &s;
  return energy_release_rate(plate.mesh, plate.fields, region).G / G_exact;
}

// The discrete body is too stiff around the tip, by h to the first power; the value does not depend on the ring.
void expect_exact_value(double K_I, double K_II) {
  std::vector<double> errors;
  for (const Index n : {20, 40, 80}) {
    const SlitPlate plate = solve(n, K_I, K_II);
    const double wide = measured(plate, "disc", 0.3e-3, 0.8e-3), narrow = measured(plate, "disc", 0.2e-3, 0.4e-3);
    const double box = measured(plate, "box", 0.3e-3, 0.8e-3);
    report_row("h = " + std::to_string(2000 / n) + " um",
               {{"G/exact, disc 0.3-0.8 mm", wide}, {"disc 0.2-0.4 mm", narrow}, {"box 0.3-0.8 mm", box}});
    errors.push_back(1.0 - wide);
    EXPECT_NEAR(narrow, wide, n > 20 ? 0.001 : 0.005);
    EXPECT_NEAR(box, wide, n > 20 ? 0.001 : 0.005);
  }
  EXPECT_LT(std::abs(errors[2]), 0.01);
  EXPECT_GT(std::log2(errors[0] / errors[1]), 0.9);
  EXPECT_GT(std::log2(errors[1] / errors[2]), 0.9);
}

TEST(EnergyReleaseRate, OfASlitIsThatOfItsStressIntensity) { expect_exact_value(1.0, 0.0); }

TEST(EnergyReleaseRate, OfAMixedFieldIsTheSumOfBothModes) { expect_exact_value(0.8, 0.6); }

TEST(EnergyReleaseRate, IsNoneWhereTheRingLeavesTheBody) {
  EXPECT_TRUE(std::isnan(measured(solve(20, 1.0, 0.0), "disc", 0.5e-3, 1.2e-3)));
}

TEST(EnergyReleaseRate, FollowsTheForemostDamage) {
  const SlitPlate plate = solve(20, 1.0, 0.0);
  CellField<double> damage = plate.fields.damage;
  for (Index c = 0; c < plate.mesh.n_cells(); ++c) {
    const Vector& x = plate.mesh.cell_centre[c];
    if (std::abs(x.y() - 0.05e-3) < 1e-9) damage[c] = x.x() < 0.4e-3 ? 1.0 : (x.x() < 0.5e-3 ? 0.8 : 0.0);
    if (std::abs(x.y() - 0.55e-3) < 1e-9) damage[c] = x.x() < 0.6e-3 ? 1.0 : 0.0;
  }
  TipRegion region{.name = "tip", .shape = &region_shapes().front(), .inner = 1e-4, .outer = 2e-4, .follows = true};
  EXPECT_NEAR(crack_tip(plate.mesh, damage, region).x(), 0.56e-3, 1e-9);
  region.corridor = 0.2e-3;
  const Vector tip = crack_tip(plate.mesh, damage, region);
  EXPECT_NEAR(tip.x(), 0.4e-3, 1e-9);  // halfway from d = 1 at 0.35 mm to 0.8 at 0.45 mm
  EXPECT_NEAR(tip.y(), 0.05e-3, 1e-9);
  region.follows = false;
  EXPECT_EQ(crack_tip(plate.mesh, damage, region), region.point);
}

}  // namespace
}  // namespace pfdm::verification
