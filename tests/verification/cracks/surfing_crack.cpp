// A coarse form of the case surfing_crack: a crack in a strip under the displacements of a moving near field of G = Gc
// (Hossain, Hsueh, Bourdin, Bhattacharya, J. Mech. Phys. Solids 71 (2014) 15).

#include "postproc/fields/energy_release_rate.h"
#include "solver/fracture/fracture_run.h"
#include "tests/verification/near_field.h"
#include "tests/verification/support.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pfdm::verification::this_file {
namespace {

constexpr double mm = 1e-3, Gc = 2700.0, ell = 0.04 * mm, h = ell / 2, thickness = 1.0 * mm;
constexpr double speed = 1.0 * mm;  // of the field, per load parameter

// The notch is the middle row of cells, up to x = 0.5 mm.
Mesh strip() {
  const Index side_rows = 5;
  const double band = (2.0 * side_rows + 1.0) * h, rest = 0.5 * (1.0 * mm - band);
  return make_box_hexes({.origin = {0.0, -0.5 * mm, 0.0},
                         .axes = {{{{0.44 * mm, 8, 0.2}, {0.72 * mm, 36, 1.0}, {0.84 * mm, 10, 10.0}},
                                   {{rest, 7, 0.2}, {band, 2 * side_rows + 1, 1.0}, {rest, 7, 5.0}},
                                   {{thickness, 1, 1.0}}}},
                         .regions = {},
                         .slits = {},
                         .holes = {{"notch", {0.0, -0.5 * h, 0.0}, {0.5 * mm, 0.5 * h, thickness}}}});
}

FractureModel surfing_model() {
  const IsotropicElasticity steel = from_young_poisson(210e9, 0.3);
  const double K = std::sqrt(210e9 / (1.0 - 0.3 * 0.3) * Gc);
  FractureModel model = elastic_model({}, {plane_on("zmin"), plane_on("zmax")});
  model.regions = {{.elasticity = steel, .Gc = Gc, .ell = ell}};
  model.crack = &crack_geometry("AT1");
  for (const char* side : {"xmin", "xmax", "ymin", "ymax"}) {
    BoundaryCondition moving = displacement_on(side, {});
    moving.value = [=](const Vector& x, double t) {
      return near_field(steel, x - Vector(0.5 * mm + speed * t, 0.0, 0.0), K);
    };
    model.boundary.push_back(moving);
  }
  return model;
}

TEST(SurfingCrack, FollowsTheFieldAndDissipatesItsToughness) {
  const Mesh mesh = strip();
  FractureRun run(mesh, surfing_model(), {},
                  {.end = 0.52, .initial_increment = 0.04, .maximum_increment = 0.04, .stops = {}});
  const TipRegion region{.name = "ring",
                         .point = {0.5 * mm, 0.0, 0.0},
                         .shape = &region_shapes().front(),
                         .inner = 3.0 * ell,
                         .outer = 8.0 * ell,
                         .follows = true};
  struct Row {
    double load, tip, G, fracture, left_over;
  };
  std::vector<Row> rows;
  const auto step_done = [&](const FractureState& state, const StepReport& report) {
    if (report.load < 0.395) return;  // the ring has left the notch behind
    const EnergyRelease release = energy_release_rate(mesh, run.output(state), region);
    rows.push_back({report.load, release.tip.x(), release.G, report.energy.fracture,
                    report.energy.external_work - report.energy.elastic - report.energy.fracture});
    EXPECT_LT(release.damaged_share, 0.02);
    EXPECT_NEAR(release.tip.y(), 0.0, 1e-9);
  };
  run_to_end(run, step_done);
  const Row &first = rows.front(), &last = rows.back();
  const double advance = last.tip - first.tip, area = advance * thickness;
  const double dissipated = (last.fracture - first.fracture) / (Gc * area);
  const double lost = (last.left_over - first.left_over) / (Gc * area);
  report_row("h = ell/2", {{"speed over the field's", advance / (speed * (last.load - first.load))},
                           {"G/Gc", last.G / Gc},
                           {"dissipated over Gc", dissipated},
                           {"lost in jumps from cell to cell over Gc", lost}});
  EXPECT_NEAR(advance, speed * (last.load - first.load), 1e-3 * advance);
  EXPECT_NEAR(dissipated, 1.0 + h * h / (32.0 * ell * ell), 0.01);
  EXPECT_NEAR(last.G / Gc, dissipated + lost, 0.02);  // what flows in is what is spent
  EXPECT_NEAR(last.G / Gc, 1.0, 0.01);
  EXPECT_NEAR(lost, 0.0, 0.02);
}

}  // namespace
}  // namespace pfdm::verification::this_file
