// A coarse form of the case l_panel: the L-shaped concrete panel of Winkler (PhD thesis, Innsbruck 2001) with a
// cohesive crack, twice the length ell of the case.

#include "solver/fracture/fracture_run.h"
#include "tests/verification/support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace pfdm::verification::this_file {
namespace {

constexpr double mm = 1e-3, thickness = 100.0 * mm, E = 20e9, Gc = 130.0, ft = 2.5e6, ell = 15.0 * mm;

Mesh panel() {
  return make_box_hexes({.axes = {{{{260.0 * mm, 52, 1.0}, {240.0 * mm, 24, 1.0}},
                                   {{235.0 * mm, 14, 0.14}, {60.0 * mm, 12, 1.0}, {205.0 * mm, 13, 6.0}},
                                   {{thickness, 1, 1.0}}}},
                         .regions = {{"loaded", {435.0 * mm, 250.0 * mm, 0.0}, {500.0 * mm, 275.0 * mm, thickness}}},
                         .slits = {},
                         .holes = {{"corner", {250.0 * mm, 0.0, 0.0}, {500.0 * mm, 250.0 * mm, thickness}}},
                         .patches = {{"load", {460.0 * mm, 250.0 * mm, 0.0}, {480.0 * mm, 250.0 * mm, thickness}}}});
}

FractureModel concrete(const Mesh& mesh) {
  FractureModel model =
      elastic_model({}, {plane_stress_on("zmin"), plane_stress_on("zmax"),
                         displacement_on("ymin", [](const Vector&) -> Vector { return Vector::Zero(); })});
  for (const std::string& name : mesh.region_names)
    model.regions.push_back(
        {.elasticity = from_young_poisson(E, 0.18),
         .Gc = Gc,
         .ell = ell,
         .damageable = name != "loaded",
         .degradation = rational_degradation(rational_coefficients(softening_law("cornelissen"), E, Gc, ft, ell))});
  model.crack = &crack_geometry("Wu");
  model.degradation = degradation("rational");
  model.split = energy_split("rankine");
  model.boundary.push_back({.patch = "load",
                            .kind = BoundaryCondition::Kind::components,
                            .displacement_prescribed = {false, true, false},
                            .value = [](const Vector&, double t) { return Vector(0.0, t * mm, 0.0); }});
  return model;
}

// Height of the most damaged cell in the column of cells around x [mm].
double crack_height(const Mesh& mesh, const CellField<double>& damage, double x) {
  Index most = -1;
  for (Index c = 0; c < mesh.n_cells(); ++c)
    if (std::abs(mesh.cell_centre[c].x() - x * mm) < 2.6 * mm && (most < 0 || damage[c] > damage[most])) most = c;
  return mesh.cell_centre[most].y() / mm;
}

// Measured: 7219 N at 0.208 mm, 3522 N at 0.4 mm.
TEST(CornerCrack, BreaksAsTheMeasuredPanel) {
  const Mesh mesh = panel();
  FractureRun run(mesh, concrete(mesh), {},
                  {.end = 0.4, .initial_increment = 0.04, .maximum_increment = 0.04, .stops = {}});
  const auto load = mesh.patch_index("load");
  std::map<double, double> displacement_at_force;
  double last = 0.0;
  const auto step_done = [&](const FractureState&, const StepReport& r) {
    last = r.reaction[load].y();
    displacement_at_force[last] = r.load;
  };
  const CellField<double> damage = run_to_end(run, step_done).damage;
  const auto& [peak, displacement] = *displacement_at_force.rbegin();
  const double at_corner = crack_height(mesh, damage, 240.0), inside = crack_height(mesh, damage, 130.0);
  report_row("peak", {{"force, N", peak},
                      {"displacement, mm", displacement},
                      {"force at 0.4 mm, N", last},
                      {"crack at x = 240 mm, y, mm", at_corner},
                      {"at 130 mm", inside}});
  EXPECT_NEAR(peak, 7219.0, 0.02 * 7219.0);
  EXPECT_NEAR(displacement, 0.208, 0.016);
  EXPECT_NEAR(last, 3522.0, 0.02 * 3522.0);
  EXPECT_NEAR(at_corner, 250.0, 5.0);  // a cell
  EXPECT_GT(inside, at_corner + 2.0);
  EXPECT_NEAR(inside, 252.5, 5.0);
}

}  // namespace
}  // namespace pfdm::verification::this_file
