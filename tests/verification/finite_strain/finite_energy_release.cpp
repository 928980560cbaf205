// The energy release rate by G-theta at finite strain, of a slit strip of neo-Hookean rubber that is clamped along its
// sides ("pure shear"; Rivlin, Thomas, J. Polym. Sci. 10 (1953) 291): what the strip ahead of the slit stores over its
// height.

#include "postproc/fields/energy_release_rate.h"
#include "tests/verification/finite.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

namespace pfdm::verification::this_file {
namespace {

constexpr double half = 1e-3, stretch = 1.4;
// By hand: energy of the law where the strip is stretched and thins to `across`.
double energy(const IsotropicElasticity& rubber, double across) {
  const double J = stretch * across;
  return 0.5 * rubber.mu * (1.0 + stretch * stretch + across * across - 3.0) - rubber.mu * std::log(J) +
         0.5 * rubber.lambda * (J - 1.0) * (J - 1.0);
}

// Where a sheet carries nothing across: the energy's minimum.
double thinned(const IsotropicElasticity& rubber) {
  double low = 0.5, high = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high), J = stretch * middle;
    const double force = rubber.mu * (middle - 1.0 / middle) + rubber.lambda * (J - 1.0) * stretch;
    (force < 0.0 ? low : high) = middle;
  }
  return low;
}

// 10 mm x 2 mm, slit up to the middle, cells of 1 mm / n at its tip.
Mesh slit_strip(Index n) {
  return make_box_hexes({.origin = {-5.0 * half, -half, 0.0},
                         .axes = {{{{4.0 * half, 2 * n, 0.3}, {2.0 * half, 2 * n, 1.0}, {4.0 * half, 2 * n, 1.0 / 0.3}},
                                   {{2.0 * half, 2 * n, 1.0}},
                                   {{0.2 * half, 1, 1.0}}}},
                         .regions = {},
                         .slits = {{"slit", {-1.0, 0.0, -1.0}, {0.0, 0.0, 1.0}}}});
}

struct Release {
  double wide = 0.0, narrow = 0.0;  // over the closed form
};

Release of_a_strip(Index n, bool is_sheet) {
  const Mesh mesh = slit_strip(n);
  const IsotropicElasticity rubber = from_young_poisson(1.5e6, is_sheet ? 0.49 : 0.3);
  const auto grip = [](double lift) {
    return [=](const Vector&, double t) -> Vector { return Vector(0.0, t * lift, 0.0); };
  };
  std::vector<BoundaryCondition> boundary{moved("ymin", {true, true, false}, grip(0.0)), symmetry_on("xmax"),
                                          moved("ymax", {true, true, false}, grip((stretch - 1.0) * 2.0 * half))};
  for (const char* side : {"zmin", "zmax"}) boundary.push_back(is_sheet ? plane_stress_on(side) : plane_on(side));
  FractureRun run(mesh, finite_body(mesh, make_hyperelastic("neo_hookean", {.elasticity = rubber}), boundary),
                  {.equilibrium_tolerance = 1e-8}, {.initial_increment = 0.25, .maximum_increment = 0.25, .stops = {}});
  const OutputFields fields = run.output(run_to_end(run, [](const FractureState&, const StepReport&) {}));
  const double due = 2.0 * half * energy(rubber, is_sheet ? thinned(rubber) : 1.0);
  const auto within = [&](double inner, double outer) {
    const TipRegion ring{
        .name = "tip", .shape = &region_shapes().front(), .inner = inner * half, .outer = outer * half};
    return energy_release_rate(mesh, fields, ring).G / due;
  };
  return {.wide = within(0.3, 0.8), .narrow = within(0.2, 0.5)};
}

TEST(FiniteEnergyRelease, OfAStripIsWhatItStoresAhead) {
  for (const bool is_sheet : {true, false}) {
    const Release coarse = of_a_strip(6, is_sheet), fine = of_a_strip(12, is_sheet);
    report_row(is_sheet ? "sheet" : "plane strain", {{"G/closed form, h = 0.17 mm", coarse.wide},
                                                     {"narrow ring", coarse.narrow},
                                                     {"h = 0.083 mm", fine.wide},
                                                     {"narrow ring", fine.narrow}});
    EXPECT_NEAR(coarse.wide, 1.0, 0.01);
    EXPECT_NEAR(fine.wide, 1.0, 0.003);
    EXPECT_NEAR(fine.narrow, 1.0, 0.003);
  }
}

// Hexahedra whose faces are warped, in a uniform deformation: no energy flows, whatever the ring.
TEST(FiniteEnergyRelease, IsNoneInAUniformDeformationOfWarpedCells) {
  const Mesh mesh = mapped_box({6, 6, 4}, [](const Vector& x) -> Vector {
    const auto wave = [](double s) { return std::sin(std::numbers::pi * s); };
    const double inner = 0.15 * wave(x[0]) * wave(x[1]) * wave(x[2]);
    return x + inner * Vector(wave(3.0 * x[1]), wave(2.0 * x[2] + 0.3), wave(3.0 * x[0] - 0.2));
  });
  Tensor H;
  H << 0.2, 0.1, -0.05, 0.03, -0.1, 0.2, 0.1, -0.02, 0.15;
  std::vector<BoundaryCondition> boundary;
  for (const Patch& side : mesh.patches)
    boundary.push_back(
        moved(side.name, {true, true, true}, [=](const Vector& x, double t) -> Vector { return t * H * x; }));
  const auto rubber = make_hyperelastic("neo_hookean", {.elasticity = from_young_poisson(1.5e6, 0.4)});
  FractureRun run(mesh, finite_body(mesh, rubber, boundary), {.equilibrium_tolerance = 1e-12},
                  {.initial_increment = 0.5, .maximum_increment = 0.5, .stops = {}});
  const OutputFields fields = run.output(run_to_end(run, [](const FractureState&, const StepReport&) {}));
  const TipRegion ring{
      .name = "tip", .point = {0.5, 0.5, 0.5}, .shape = &region_shapes().front(), .inner = 0.1, .outer = 0.45};
  const double G = energy_release_rate(mesh, fields, ring).G, unit = fields.energy_density[0] * ring.outer;
  report_row("uniform deformation, warped hexahedra", {{"G over energy density times outer", G / unit}});
  EXPECT_LT(std::abs(G), 1e-8 * unit);
}

}  // namespace
}  // namespace pfdm::verification::this_file
