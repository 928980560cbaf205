// The viscous (Ginzburg-Landau) damage equation on a homogeneous plate: eta d' = 2 (1 - d) psi - Gc d/ell (AT2). Under
// a strain that is held, d = d_end (1 - exp(-t/tau)), tau = eta/(2 psi + Gc/ell), d_end = 2 psi tau/eta.

#include "physics/error.h"
#include "solver/fracture/fracture_run.h"
#include "tests/verification/support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pfdm::verification::this_file {
namespace {

constexpr double E = 30e9, Gc = 100.0, ell = 5e-3, side = 10e-3;

struct Row {
  double damage, stress, elastic, fracture, work, viscous;  // energies per volume [J/m^3]
};

/// The strain along x as a function of t; a symmetric plate of 2 x 2 cells with nu = 0.
std::vector<Row> stretch(const std::function<double(double)>& strain, double viscosity, Index n_steps,
                         double end = 1.0) {
  const Mesh mesh =
      make_box_hexes({.axes = {{{{side, 2, 1.0}}, {{side, 2, 1.0}}, {{side, 1, 1.0}}}}, .regions = {}, .slits = {}});
  FractureModel model =
      elastic_model({}, {symmetry_on("xmin"), symmetry_on("ymin"), plane_on("zmin"), plane_on("zmax")});
  model.regions = {{.elasticity = from_young_poisson(E, 0.0), .Gc = Gc, .ell = ell}};
  model.viscosity = viscosity;
  model.residual_stiffness = 1e-12;
  model.boundary.push_back({.patch = "xmax",
                            .kind = BoundaryCondition::Kind::components,
                            .displacement_prescribed = {true, false, false},
                            .value = [&](const Vector&, double t) { return Vector(strain(t) * side, 0.0, 0.0); }});
  const double increment = end / double(n_steps);
  FractureRun run(
      mesh, model, {.damage_tolerance = 1e-9, .energy_tolerance = 1e-9},
      {.end = end, .initial_increment = increment, .maximum_increment = increment, .duration = 1.0, .stops = {}});
  const auto pulled = mesh.patch_index("xmax");
  const double volume = side * side * side;
  std::vector<Row> rows;
  const auto step_done = [&](const FractureState&, const StepReport& r) {
    if (r.step > 0)
      rows.push_back({r.max_damage, r.reaction[pulled][0] / (side * side), r.energy.elastic / volume,
                      r.energy.fracture / volume, r.energy.external_work / volume,
                      r.energy.viscous_dissipation / volume});
  };
  run_to_end(run, step_done);
  return rows;
}

TEST(ViscousDamage, RelaxesAsItsDifferentialEquationHasIt) {
  const double strain = 1e-3, psi = 0.5 * E * strain * strain, rate = 2.0 * psi + Gc / ell, eta = 0.4 * rate;
  std::vector<double> errors, imbalances;
  for (const Index n : {20, 40, 80}) {
    const std::vector<Row> rows = stretch([=](double) { return strain; }, eta, n);
    double error = 0.0, discrete_error = 0.0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const double t = double(i + 1) / double(n), end = 2.0 * psi / rate;
      error = std::max(error, std::abs(rows[i].damage - end * (1.0 - std::exp(-t * rate / eta))));
      const double backward_euler = end * (1.0 - std::pow(1.0 + rate / (eta * double(n)), -double(i + 1)));
      discrete_error = std::max(discrete_error, std::abs(rows[i].damage - backward_euler));
    }
    // While the strain is held no work is done: what the plate loses is dissipated.
    const double lost = rows.front().elastic + rows.front().fracture - rows.back().elastic - rows.back().fracture;
    const double imbalance = 1.0 - (rows.back().viscous - rows.front().viscous) / lost;
    report_row(std::to_string(n) + " steps",
               {{"error of d", error}, {"against backward Euler", discrete_error}, {"imbalance", imbalance}});
    errors.push_back(error);
    imbalances.push_back(imbalance);
    EXPECT_LT(discrete_error, 1e-6);
    EXPECT_NEAR(rows.back().work, rows.front().work, 1e-9 * rows.front().work);
  }
  EXPECT_GT(std::log2(errors[1] / errors[2]), 0.95);
  EXPECT_LT(errors[2], 0.005);
  EXPECT_GT(std::log2(imbalances[1] / imbalances[2]), 0.9);
  EXPECT_LT(std::abs(imbalances[2]), 0.02);
}

// Pulled at one rate, the strength rises with the viscosity, and is the rate-independent one without.
TEST(ViscousDamage, LosesItsRateDependenceAsTheViscosityVanishes) {
  const double strength = 9.0 / 16.0 * std::sqrt(E * Gc / (3.0 * ell)), strain = 2.5 * strength / E;
  const auto peak = [&](double viscosity) {
    const std::vector<Row> rows = stretch([=](double t) { return strain * t; }, viscosity, 400);
    const Row& last = rows.back();
    EXPECT_NEAR(last.elastic + last.fracture + last.viscous, last.work, 0.01 * last.work);
    EXPECT_EQ(last.viscous > 0.0, viscosity > 0.0);
    return std::max_element(rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.stress < b.stress; })
               ->stress /
           strength;
  };
  std::vector<double> excess;
  for (const double share : {1e-1, 1e-2, 1e-3, 0.0}) excess.push_back(peak(share * Gc / ell) - 1.0);
  report_row("strength beyond the rate-independent one, eta = 0.1, 0.01, 0.001, 0 Gc/ell T",
             {{"", excess[0]}, {"", excess[1]}, {"", excess[2]}, {"", excess[3]}});
  EXPECT_NEAR(excess[0], 10.0 * excess[1], 1.5 * excess[1]);
  EXPECT_NEAR(excess[1], 10.0 * excess[2], 1.5 * excess[2]);
  EXPECT_LT(excess[2], 2e-3);
  EXPECT_NEAR(excess[3], 0.0, 1e-4);
}

TEST(ViscousDamage, IsRefusedWithoutTimeAndWithAPrescribedDissipation) {
  const Mesh mesh =
      make_box_hexes({.axes = {{{{side, 2, 1.0}}, {{side, 2, 1.0}}, {{side, 1, 1.0}}}}, .regions = {}, .slits = {}});
  FractureModel model =
      elastic_model({from_young_poisson(E, 0.0)}, {symmetry_on("xmin"), symmetry_on("ymin"), symmetry_on("zmin")});
  model.viscosity = 1.0;
  EXPECT_THROW(FractureRun(mesh, model, {}, {}), InputError);
  EXPECT_THROW(FractureRun(mesh, model, {}, {.maximum_dissipation = 1.0, .duration = 1.0, .stops = {}}), InputError);
  EXPECT_NO_THROW(FractureRun(mesh, model, {}, {.duration = 1.0, .stops = {}}));
}

}  // namespace
}  // namespace pfdm::verification::this_file
