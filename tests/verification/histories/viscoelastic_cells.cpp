// Viscoelasticity by Prony series in the field solver, by the correspondence principle: a bar under a held traction, a
// thick-walled cylinder under a held pressure; the account of work, stored energy and heat, also through a crack.

#include "mesh/generators/cylinder_sector.h"
#include "physics/materials/prony.h"
#include "solver/fracture/fracture_run.h"
#include "tests/verification/support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pfdm::verification::this_file {
namespace {

const IsotropicElasticity relaxed = from_young_poisson(2e6, 0.4);
constexpr double branch = 1e6, tau = 0.5;      // [Pa], [s]
constexpr double ramp = 1e-6, duration = 4.0;  // share of the load parameter, [s]
constexpr StaggeredSettings tight{.damage_tolerance = 1e-9, .energy_tolerance = 1e-12, .equilibrium_tolerance = 1e-11};

/// 1/M of a modulus M(s) = M_inf + M_1 s tau/(1 + s tau) under a load that is held since the time 0.
double compliance(double M_inf, double M_1, double time) {
  const double M_0 = M_inf + M_1;
  return 1.0 / M_inf - (1.0 / M_inf - 1.0 / M_0) * std::exp(-time * M_inf / (M_0 * tau));
}

FractureModel viscoelastic_model(std::vector<BoundaryCondition> boundary) {
  const auto material = make_prony({.relaxed = relaxed, .shear = {{branch, tau}}});
  FractureModel model = elastic_model({material->elasticity()}, std::move(boundary));
  model.regions[0].material = material;
  return model;
}

BoundaryCondition sector(const char* side) {
  return {.patch = side, .kind = BoundaryCondition::Kind::axisymmetric, .value = {}};
}

// Increments grow from the ramp's to a hundredth of the time.
LoadingSettings held() {
  return {.initial_increment = ramp,
          .minimum_increment = 1e-9,
          .maximum_increment = 0.01,
          .duration = duration,
          .stops = {},
          .is_proportional = false};
}

double grown(double t) { return std::min(t / ramp, 1.0); }

// eps = sigma (1/(9 K) + J(t)/3), J of the shear modulus.
TEST(ViscoelasticCells, ABarCreepsUnderAHeldTraction) {
  constexpr double sigma = 2e4;
  const Mesh mesh =
      make_box_hexes({.axes = {{{{1.0, 3, 1.0}}, {{1.0, 2, 1.0}}, {{1.0, 2, 1.0}}}}, .regions = {}, .slits = {}});
  FractureRun run(
      mesh,
      viscoelastic_model({symmetry_on("xmin"), symmetry_on("ymin"), symmetry_on("zmin"),
                          moved("xmax", {false, false, false},
                                [](const Vector&, double t) { return Vector(sigma * grown(t), 0.0, 0.0); })}),
      tight, held());
  const auto patch = mesh.patch_index("xmax");
  run_to_end(run, [&](const FractureState&, const StepReport& report) {
    if (report.step == 0) return;
    const double expected =
        sigma * (1.0 / (9.0 * relaxed.bulk_modulus()) + compliance(relaxed.mu, branch, duration * report.load) / 3.0);
    EXPECT_NEAR(report.patch_displacement[patch].x(), expected, 2e-4 * expected) << report.load;
    if (report.load == 1.0) {
      EXPECT_NEAR(left_over({}, report.energy), 0.0, 1e-3 * report.energy.external_work);
      EXPECT_GT(report.energy.plastic_dissipation, 0.05 * report.energy.external_work);
    }
  });
}

// u(r) = p a^2/(b^2 - a^2) (r/(2 (K + mu/3)) + b^2/(2 mu r)) in plane strain.
TEST(ViscoelasticCells, ACylinderCreepsUnderAHeldPressure) {
  constexpr double a = 1.0, b = 2.0, p = 1e4;
  for (const Index n : {8, 16}) {
    const Mesh mesh = make_cylinder_sector({.azimuth = 0.05,
                                            .inner_radius = a,
                                            .radius = {{.length = b - a, .n = n}},
                                            .height = {{.length = 0.2, .n = 1}}});
    BoundaryCondition pressed{.patch = "inner", .value = {}};
    pressed.pressure = [](const Vector&, double t) { return p * grown(t); };
    FractureRun run(
        mesh, viscoelastic_model({pressed, symmetry_on("bottom"), symmetry_on("top"), sector("front"), sector("back")}),
        tight, held());
    const auto inner = mesh.patch_index("inner");
    const auto outer = mesh.patch_index("outer");
    const double sizes = 0.5 * (1.0 + std::cos(0.025));  // the sector's faces are chords
    run_to_end(run, [&](const FractureState&, const StepReport& report) {
      if (report.step == 0) return;
      const double time = duration * report.load, k = relaxed.bulk_modulus() + relaxed.mu / 3.0;
      const auto due = [&](double r) {
        return p * a * a / (b * b - a * a) *
               (r * compliance(k, branch / 3.0, time) / 2.0 + b * b / r * compliance(relaxed.mu, branch, time) / 2.0);
      };
      const double allowed = n == 8 ? 0.02 : 0.005;
      EXPECT_NEAR(report.patch_displacement[inner].x() / sizes, due(a), allowed * due(a)) << n << " cells, " << time;
      EXPECT_NEAR(report.patch_displacement[outer].x() / sizes, due(b), allowed * due(b)) << n << " cells, " << time;
    });
  }
}

// The first equilibrium of a step knows how much the material relaxes in it: hardly more iterations than an elastic
// body, and no energy that cracks would seem to release. By the stress of the step before these were 540 steps.
TEST(ViscoelasticCells, AStepOfFourRelaxationTimesIsFoundAtOnce) {
  const Mesh mesh =
      make_box_hexes({.axes = {{{{1.0, 3, 1.0}}, {{1.0, 2, 1.0}}, {{1.0, 2, 1.0}}}}, .regions = {}, .slits = {}});
  const auto most_iterations = [&](FractureModel model) {
    model.boundary = {
        symmetry_on("xmin"), symmetry_on("ymin"), symmetry_on("zmin"),
        moved("xmax", {true, true, true}, [](const Vector&, double t) { return Vector(0.01 * t, 0.0, 0.0); })};
    FractureRun run(
        mesh, model, tight,
        {.initial_increment = 0.25, .maximum_increment = 0.25, .energy_release = 2e-3, .duration = 8.0, .stops = {}});
    Index most = 0, steps = 0;
    run_to_end(run, [&](const FractureState&, const StepReport& report) {
      most = std::max(most, report.staggered_iterations);
      steps = report.step;
    });
    EXPECT_EQ(steps, 4);
    return most;
  };
  EXPECT_LE(most_iterations(viscoelastic_model({})), most_iterations(elastic_model({relaxed}, {})) + 1);
}

// A bar that breaks while it relaxes: work is stored, spent on the surface, or heat.
TEST(ViscoelasticCells, WorkIsStoredSurfaceOrHeatThroughACrack) {
  for (const PronyDrive drive : {PronyDrive::equilibrium, PronyDrive::stored}) {
    const Mesh mesh =
        make_box_hexes({.axes = {{{{0.1, 40, 1.0}}, {{0.01, 1, 1.0}}, {{0.01, 1, 1.0}}}}, .regions = {}, .slits = {}});
    const auto material = make_prony({.relaxed = relaxed, .shear = {{branch, tau}}, .drive = drive});
    FractureModel model = elastic_model(
        {material->elasticity()},
        {symmetry_on("xmin"), symmetry_on("ymin"), symmetry_on("zmin"),
         moved("xmax", {true, false, false}, [](const Vector&, double t) { return Vector(0.012 * t, 0.0, 0.0); })});
    model.regions[0].material = material;
    model.regions[0].damageable = true;
    model.regions[0].Gc = 100.0;
    model.regions[0].ell = 0.01;
    model.crack = &crack_geometry("AT2");
    model.degradation = degradation("quadratic");
    FractureRun run(mesh, model, {},
                    {.initial_increment = 0.005, .maximum_increment = 0.005, .duration = 2.0, .stops = {}});
    double worst = 0.0, heat = 0.0, damage = 0.0;
    run_to_end(run, [&](const FractureState&, const StepReport& report) {
      if (report.step == 0 || report.max_damage > 0.5) return;
      worst = std::max(worst, std::abs(left_over({}, report.energy)) / report.energy.external_work);
      heat = report.energy.plastic_dissipation / report.energy.external_work;
      damage = report.max_damage;
    });
    EXPECT_LE(worst, 2e-3);
    EXPECT_GT(heat, 0.02);
    EXPECT_GT(damage, 0.1);
  }
}

}  // namespace
}  // namespace pfdm::verification::this_file
