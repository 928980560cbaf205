// A coarse form of the cases glass_bead_radius_cap and glass_bead_radius: remote stress at which a glass bead in
// Sylgard debonds, on a sector, from a cap of 30 degrees that is debonded already and from an interface that is whole.

#include "mesh/generators/sphere_sector.h"
#include "physics/closed_forms/goodier.h"
#include "physics/interfaces/interface_toughness.h"
#include "solver/fracture/fracture_run.h"
#include "tests/verification/support.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace pfdm::verification::this_file {
namespace {

constexpr double um = 1e-6, MPa = 1e6, degree = std::numbers::pi / 180.0, toughness = 10.0;

IsotropicElasticity glass() { return from_young_poisson(70e9, 0.3); }
IsotropicElasticity sylgard() { return from_young_poisson(75e6, 0.44); }

FractureModel bead_model(const Mesh& mesh, double radius, double stress) {
  const Goodier remote(glass(), sylgard(), radius, stress);
  FractureModel model;
  for (const std::string& name : mesh.region_names)
    model.regions.push_back({.elasticity = name == "bead" ? glass() : sylgard(),
                             .Gc = toughness,
                             .damageable = name != "bead" && name != "matrix"});
  model.split = energy_split("volumetric_deviatoric");
  model.boundary = {axisymmetric_on("front"),
                    axisymmetric_on("back"),
                    {.patch = "outer",
                     .displacement_prescribed = {true, true, true},
                     .value = [remote](const Vector& x, double t) -> Vector { return t * remote.displacement(x); }}};
  return model;
}

// Load parameter up to which cracks have grown by less than so much energy [J].
double load_of_growth(FractureRun& run, double energy) {
  double at_start = 0.0, load = 0.0;
  bool has_grown = false;
  const auto step_done = [&](const FractureState&, const StepReport& now) {
    if (now.step == 1) at_start = now.energy.fracture;
    has_grown = has_grown || (now.step > 1 && now.energy.fracture > at_start + energy);
    if (!has_grown) load = now.load;
  };
  run_to_end(run, step_done);
  EXPECT_TRUE(has_grown);
  return load;
}

struct Cap {
  double radius, end;    // [m], [Pa]
  Index cells_at_front;  // in 12 degrees of polar angle
};

// Stress at which the cap has grown by ell [Pa]; ell = 2 um, the band 5/3 ell wide.
double debond_stress(const Cap& cap) {
  const double ell = 2.0 * um, h = ell / 3.0, R = cap.radius;
  const Mesh mesh = make_sphere_sector(
      {.azimuth = 5.0 * degree,
       .inner_radius = 0.7 * R,
       .shells = {{{0.3 * R, 12, 0.1}, "bead"},
                  {{2.0 * h, 2, 1.0}, "below"},
                  {{h, 1, 1.0}, "crack"},
                  {{2.0 * h, 2, 1.0}, "above"},
                  {{2.0 * R, 28, 60.0}, "matrix"}},
       .polar = {{27.0 * degree, 12, 0.1}, {12.0 * degree, cap.cells_at_front, 1.0}, {141.0 * degree, 16, 20.0}}});
  FractureModel model = bead_model(mesh, R, cap.end);
  model.crack = &crack_geometry("AT1");
  model.degradation = degradation("quadratic");
  const BandNeighbour hard{std::numeric_limits<double>::infinity()};
  for (RegionModel& region : model.regions) {
    region.ell = ell;
    region.Gc = band_toughness(*model.crack, toughness, 5.0 * h, ell, hard, hard);
  }
  const Index row = mesh.region_index("crack");
  model.initial_damage = CellField<double>(mesh.n_cells(), 0.0);
  for (Index c = 0; c < mesh.n_cells(); ++c)
    if (mesh.region[c] == row && mesh.cell_centre[c].normalized().z() > std::cos(30.0 * degree))
      model.initial_damage[c] = 1.0;
  FractureRun run(mesh, model, {.damage_tolerance = 1e-3, .maximum_iterations = 3000},
                  {.initial_increment = 0.1,
                   .maximum_increment = 0.1,
                   .damage_growth = 0.2,
                   .finest_increment = 0.01,
                   .stops = {}});
  const double ring = toughness * R * 0.5 * 5.0 * degree * ell;  // of the crack's front, ell wide [J]
  return cap.end * load_of_growth(run, ring);
}

// Penny-shaped crack on a bead: reference in cases/glass_bead_radius_cap/README.md.
double predicted(double R) {
  const double nu = 0.44, at_pole = Goodier(glass(), sylgard(), 1.0, 1.0).interface_normal_traction(1.0);
  return std::sqrt(std::numbers::pi * 75.0 * MPa * toughness / (2.0 * (1.0 - nu * nu) * R * 0.5)) / at_pole;
}

TEST(BeadDebonding, FromACapFallsWithTheRadius) {
  const double small = debond_stress({50.0 * um, 4.2 * MPa, 16}), large = debond_stress({200.0 * um, 2.4 * MPa, 63});
  const double exponent = std::log(large / small) / std::log(4.0);
  report_row("cap of 30 degrees, R = 50 and 200 um", {{"stress, MPa", small / MPa},
                                                      {"over predicted", small / predicted(50.0 * um)},
                                                      {"stress, MPa (200)", large / MPa},
                                                      {"over predicted (200)", large / predicted(200.0 * um)},
                                                      {"exponent", exponent}});
  EXPECT_NEAR(small / predicted(50.0 * um), 1.0, 0.1);
  EXPECT_NEAR(large / predicted(200.0 * um), 1.0, 0.05);
  EXPECT_NEAR(exponent, -0.5, 0.08);
}

}  // namespace
}  // namespace pfdm::verification::this_file
