// Endochronic cells in the field solver: uniform bodies against the material point, of which they know nothing; damaged
// ones.

#include "physics/error.h"
#include "solver/fracture/fracture_run.h"
#include "solver/point/mixed_control.h"
#include "tests/verification/histories/endochronic_bodies.h"
#include "tests/verification/support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace pfdm::verification::this_file {
namespace {

// Two cycles of growing strain.
double wave(double t) { return 0.01 * t * std::sin(4.0 * std::numbers::pi * t); }

// In tension along x, free of stress on the sides.
std::vector<EndochronicUpdate> point_in_tension(const EndochronicLaw& law, Index n, double duration) {
  std::array<ControlCondition, 6> conditions;
  conditions[0].on_strain = Mandel::Unit(0);
  for (Index k = 1; k < 6; ++k) conditions[k].on_stress = Mandel::Unit(k);
  EndochronicState state = virgin_state(law);
  std::vector<EndochronicUpdate> updates;
  for (Index i = 1; i <= n; ++i) {
    Mandel change = Mandel::Zero();
    change[0] = wave(double(i) / double(n)) - wave(double(i - 1) / double(n));
    const ControlledStep step = controlled_step(law, state, conditions, change, duration / double(n));
    EXPECT_TRUE(step.converged);
    state = step.update.state;
    updates.push_back(step.update);
  }
  return updates;
}

// A unit cube pulled along x.
FractureModel cube_in_tension(const EndochronicLaw& law) {
  return endochronic_model(
      law, {symmetry_on("xmin"), symmetry_on("ymin"), symmetry_on("zmin"),
            moved("xmax", {true, false, false}, [](const Vector&, double t) { return Vector(wave(t), 0.0, 0.0); })});
}

// A single cell, whose faces are points, held along its axis.
FractureModel cell_in_tension(const EndochronicLaw& law) {
  const auto still = [](const Vector&, double) -> Vector { return Vector::Zero(); };
  return endochronic_model(
      law, {moved("xmin", {true, true, true}, still), moved("ymin", {false, false, true}, still),
            moved("xmax", {true, true, true}, [](const Vector&, double t) { return Vector(wave(t), 0.0, 0.0); })});
}

Mesh cube(Index n) {
  return make_box_hexes({.axes = {{{{1.0, n, 1.0}}, {{1.0, n, 1.0}}, {{1.0, n, 1.0}}}}, .regions = {}, .slits = {}});
}

struct Difference {
  double stress = 0.0, strain = 0.0;  // largest over cells and steps, relative to the largest of all
};

Difference difference(const std::vector<Step>& steps, const std::vector<EndochronicUpdate>& point) {
  Difference worst;
  double stress = 0.0, strain = 0.0;
  for (std::size_t i = 0; i < point.size(); ++i) {
    const OutputFields& fields = steps[i].fields;
    stress = std::max(stress, point[i].stress.norm());
    strain = std::max(strain, point[i].state.strain.norm());
    for (Index c = 0; c < fields.stress.size(); ++c) {
      worst.stress = std::max(worst.stress, (to_mandel(fields.stress[c]) - point[i].stress).norm());
      worst.strain = std::max(worst.strain, (to_mandel(fields.strain[c]) - point[i].state.strain).norm());
    }
  }
  return {worst.stress / stress, worst.strain / strain};
}

TEST(EndochronicCells, OneOfThemIsTheMaterialPoint) {
  for (const bool looks_at_rate : {false, true}) {
    const EndochronicLaw law = soft_metal(looks_at_rate);
    const auto point = point_in_tension(law, 40, 100.0);
    const auto steps = steps_of(cube(1), cell_in_tension(law), in_steps(40, 100.0));
    ASSERT_EQ(steps.size(), point.size());
    const Difference d = difference(steps, point);
    report_row(looks_at_rate ? "with rate" : "without rate",
               {{"stress", d.stress}, {"strain", d.strain}, {"iterations", double(most_iterations(steps))}});
    EXPECT_LE(d.stress, 1e-11);
    EXPECT_LE(d.strain, 1e-12);
    EXPECT_LE(most_iterations(steps), 10);
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const EndochronicState& state = point[i].state;
      EXPECT_NEAR(steps[i].report.energy.elastic, free_energy(law, state), 1e-9 * free_energy(law, point.back().state));
      EXPECT_NEAR(steps[i].report.energy.plastic_dissipation, state.dissipation, 1e-9 * point.back().state.dissipation);
      EXPECT_NEAR(path_length(steps[i].fields)[0], state.zeta, 1e-10);
    }
  }
}

TEST(EndochronicCells, BodiesOfThemInUniformStressAreTheMaterialPoint) {
  const EndochronicLaw law = soft_metal();
  const auto point = point_in_tension(law, 12, 1.0);
  const Mesh wedges = extruded_triangles(3, {0.0, 0.3, 1.0});
  for (const Mesh& mesh : {cube(3), wedges, barycentric_dual(wedges)}) {
    const auto steps = steps_of(mesh, cube_in_tension(law), in_steps(12));
    const Difference d = difference(steps, point);
    report_row(std::to_string(mesh.n_cells()) + " cells", {{"stress", d.stress}, {"strain", d.strain}});
    EXPECT_LE(d.stress, 2e-11);
    EXPECT_LE(d.strain, 2e-11);
  }
}

// One cell thick, with nothing to hold it across.
TEST(EndochronicCells, APlateInPlaneStressIsTheMaterialPoint) {
  const EndochronicLaw law = soft_metal();
  const auto point = point_in_tension(law, 12, 1.0);
  FractureModel model = endochronic_model(
      law, {symmetry_on("xmin"), symmetry_on("ymin"), plane_stress_on("zmin"), plane_stress_on("zmax"),
            moved("xmax", {true, false, false}, [](const Vector&, double t) { return Vector(wave(t), 0.0, 0.0); })});
  const Mesh plate =
      make_box_hexes({.axes = {{{{1.0, 3, 1.0}}, {{1.0, 3, 1.0}}, {{0.2, 1, 1.0}}}}, .regions = {}, .slits = {}});
  for (const Mesh& mesh : {plate, extruded_triangles(3, {0.0, 0.3})}) {
    const auto steps = steps_of(mesh, model, in_steps(12));
    ASSERT_EQ(steps.size(), point.size());
    const Difference d = difference(steps, point);
    report_row(std::to_string(mesh.n_cells()) + " cells", {{"stress", d.stress}, {"strain", d.strain}});
    EXPECT_LE(d.stress, 2e-11);
    EXPECT_LE(d.strain, 2e-11);
    EXPECT_LE(most_iterations(steps), 12);
  }
}

// A law that creeps at a material point, under a traction that is held from half of the time on: the cells keep their
// strain, at the material point's when the loading ends, and no step is cut.
TEST(EndochronicCells, StayAtRestUnderAHeldTraction) {
  EndochronicLaw law = soft_metal();
  law.kernel = {{300e9, 15000.0}, {30e9, 1000.0}};
  law.hardening = {.with_path = make_factor(hardening_law("saturating"), {1.4, 60.0, 1.0}),
                   .with_rate = make_factor(rate_factor("logarithmic"), {0.1, 1e-4})};
  const auto pulled = [](const Vector&, double t) { return Vector(140e6 * std::min(2.0 * t, 1.0), 0.0, 0.0); };
  const FractureModel model =
      endochronic_model(law, {symmetry_on("xmin"),
                              symmetry_on("ymin"),
                              symmetry_on("zmin"),
                              {.patch = "xmax", .displacement_prescribed = {false, false, false}, .value = pulled}});
  const auto steps = steps_of(cube(2), model, in_steps(80, 2.0));
  ASSERT_EQ(steps.size(), 80u);
  const auto strain = [&](std::size_t step) { return to_mandel(steps[step].fields.strain[0])[0]; };
  EXPECT_NEAR(strain(39), 0.0025, 1e-5);  // LSODA: 0.002500466653
  EXPECT_NEAR(strain(79), strain(39), 1e-10 * strain(39));
}

// Confined on all sides, so that the strain is given: what damage leaves of the stress follows from the point's.
TEST(EndochronicCells, DamageDegradesTheEffectiveStress) {
  const EndochronicLaw law = soft_metal();
  constexpr double d = 0.4, residual = 1e-6, g = (1.0 - residual) * (1.0 - d) * (1.0 - d) + residual;
  const double K = law.elasticity.bulk_modulus();
  for (const std::string split : {"none", "volumetric_deviatoric"}) {
    const auto stretched = [](const Vector& x, double t) { return Vector(wave(t) * x[0], 0.0, 0.0); };
    FractureModel model = endochronic_model(law, {});
    for (const char* side : {"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"})
      model.boundary.push_back(moved(side, {true, true, true}, stretched));
    model.split = energy_split(split);
    model.residual_stiffness = residual;
    model.regions[0].damageable = true;
    model.regions[0].Gc = 1e15, model.regions[0].ell = 1.0;
    model.initial_damage = CellField<double>(1, d);
    const auto steps = steps_of(cube(1), model, in_steps(20));
    EndochronicState state = virgin_state(law);
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const double strain = wave(double(i + 1) / 20.0);
      const EndochronicUpdate point = update(law, state, strain * Mandel::Unit(0) - state.strain, 0.05);
      state = point.state;
      const bool closed = split == "volumetric_deviatoric" && strain < 0.0;
      const Mandel due = g * point.stress + (closed ? (1.0 - g) * K * strain : 0.0) * mandel_identity();
      EXPECT_LE((to_mandel(steps[i].fields.stress[0]) - due).norm(), 1e-9 * K * 0.01) << split << ", step " << i;
      const double kept = closed ? 0.5 * K * strain * strain : 0.0;
      EXPECT_NEAR(steps[i].fields.driving_energy[0], free_energy(law, state) - kept, 1e-9 * free_energy(law, state));
      EXPECT_NEAR(steps[i].report.energy.elastic, g * (free_energy(law, state) - kept) + kept,
                  1e-9 * free_energy(law, state));
      EXPECT_NEAR(steps[i].report.energy.plastic_dissipation, g * state.dissipation, 1e-9 * state.dissipation);
    }
  }
}

TEST(EndochronicCells, AreRefusedWhereTheyCannotBe) {
  const Mesh mesh = cube(1);
  FractureModel model = cell_in_tension(soft_metal(true));
  EXPECT_NO_THROW(FractureRun(mesh, model, {}, in_steps(4)));
  EXPECT_THROW(FractureRun(mesh, model, {}, in_steps(4, 0.0)), InputError);
  LoadingSettings followed = in_steps(4);
  followed.maximum_dissipation = 1.0;
  EXPECT_THROW(FractureRun(mesh, model, {}, followed), InputError);
  model.split = energy_split("spectral");
  EXPECT_THROW(FractureRun(mesh, model, {}, in_steps(4)), InputError);
}

}  // namespace
}  // namespace pfdm::verification::this_file
