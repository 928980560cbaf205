// Damage at finite strain: the homogeneous response, a broken layer that is stretched without end, a bar that breaks.

#include "tests/verification/support.h"

#include "physics/materials/hyperelastic.h"
#include "solver/fracture/cells/finite_cells.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pfdm::verification::this_file {
namespace {

const IsotropicElasticity rubber = from_young_poisson(1.5e6, 0.45);

// A block along x, held on all its sides: F = diag(stretch, 1, 1).
Mesh block(Index n, double length) {
  return make_box_hexes(
      {.axes = {{{{.length = length, .n = n}}, {{.length = 0.25, .n = 1}}, {{.length = 0.25, .n = 1}}}},
       .regions = {},
       .slits = {}});
}

std::vector<BoundaryCondition> pulled(double elongation) {
  std::vector<BoundaryCondition> boundary{
      moved("xmax", {true, true, true},
            [elongation](const Vector&, double t) -> Vector { return elongation * t * Vector::UnitX(); })};
  boundary.push_back(symmetry_on("xmin"));
  for (const char* patch : {"ymin", "ymax", "zmin", "zmax"})
    boundary.push_back(moved(patch, {false, true, true}, [](const Vector&, double) { return Vector(0.0, 0.0, 0.0); }));
  return boundary;
}

FractureModel damaged_model(std::string_view crack, double Gc, double ell, std::vector<BoundaryCondition> boundary,
                            std::string_view split) {
  FractureModel model = elastic_model({rubber}, std::move(boundary));
  model.regions[0].material = make_hyperelastic("neo_hookean", {.elasticity = rubber});
  model.regions[0].damageable = true;
  model.regions[0].Gc = Gc;
  model.regions[0].ell = ell;
  model.crack = &crack_geometry(crack);
  model.degradation = degradation("quadratic");
  model.split = energy_split(split);
  return model;
}

// Of a mesh of one cell.
CellMechanics uniform(const Tensor& H) {
  CellMechanics mechanics;
  mechanics.gradient = CellField<Tensor>(1, H);
  mechanics.energy = CellField<double>(1, 0.0);
  return mechanics;
}

// W and P_11 of diag(l, 1, 1), by hand.
double energy_at(double l) {
  return 0.5 * rubber.mu * (l * l - 1.0) - rubber.mu * std::log(l) + 0.5 * rubber.lambda * (l - 1.0) * (l - 1.0);
}
double stress_at(double l) { return rubber.mu * (l - 1.0 / l) + rubber.lambda * (l - 1.0); }

// AT2: d = 2 W/(2 W + Gc/ell), sigma = (1 - d)^2 P.
TEST(FiniteStrainDamage, HomogeneousResponseToAStretchOfTwo) {
  const Mesh mesh = block(2, 1.0);
  const double Gc = 4e7, ell = 100.0;  // too long to localise
  FractureModel model = damaged_model("AT2", Gc, ell, pulled(1.0), "none");
  FractureRun run(mesh, model, {.damage_tolerance = 1e-8, .energy_tolerance = 1e-10, .equilibrium_tolerance = 1e-9},
                  {.initial_increment = 0.1, .maximum_increment = 0.1, .stops = {}});
  double worst = 0.0;
  const FractureState end = run_to_end(run, [&](const FractureState& state, const StepReport& report) {
    if (report.step == 0) return;
    const double l = 1.0 + state.load, W = energy_at(l), d = 2.0 * W / (2.0 * W + Gc / ell);
    const double g = (1.0 - 1e-6) * (1.0 - d) * (1.0 - d) + 1e-6;
    const double force = report.reaction[mesh.patch_index("xmax")].x() / 0.0625;
    worst = std::max({worst, std::abs(force / (g * stress_at(l)) - 1.0), std::abs(report.max_damage / d - 1.0)});
  });
  report_row("homogeneous", {{"damage at the end", end.damage[0]}, {"largest relative error", worst}});
  EXPECT_LE(worst, 1e-4);
}

// What drives the damage of a cell is the derivative of what it stores by the stiffness factor, through the range in
// which it becomes a network; and its stress and pressure are those of that energy.
TEST(FiniteStrainDamage, OneEnergyDrivesTheDamageAndHasTheStress) {
  const Mesh mesh = block(1, 1.0);
  const double volume = mesh.cell_volume[0];
  Tensor shear = Tensor::Zero();
  shear(0, 1) = 0.3, shear(2, 0) = -0.1;
  double of_g = 0.0, of_curvature = 0.0, of_stress = 0.0;
  for (const double nu : {0.45, 0.497})
    for (const char* split : {"none", "volumetric_deviatoric"})
      for (const Vector& l :
           {Vector(1.2, 0.9, 1.0), Vector(4.0, 0.4, 0.8), Vector(8.0, 0.5, 0.5), Vector(1.3, 0.8, 0.8)}) {
        const IsotropicElasticity elasticity = from_young_poisson(1.5e6, nu);
        FractureModel model = damaged_model("AT2", 100.0, 0.05, pulled(1.0), split);
        model.regions[0].elasticity = elasticity;
        model.regions[0].material = make_hyperelastic("neo_hookean", {.elasticity = elasticity});
        const FiniteCells cells(mesh, model);
        const Tensor H = Tensor(l.asDiagonal()) + shear - Tensor::Identity();
        const double J = (Tensor::Identity() + H).determinant(), closure = J < 1.0 ? 1.0 : 0.0;
        const auto stored = [&](const Tensor& at, double g) {
          return cells.stored_energy(0, cells.energies(0, uniform(at), {g, closure}), g);
        };
        for (const double g : {0.5, 2e-2, 2.9e-3, 1e-3, 3.5e-4, 1e-4}) {
          const double e = 1e-4 * g;
          const double slope = (stored(H, g + e) - stored(H, g - e)) / (2.0 * e * volume);
          const FiniteEnergies found_sound = cells.energies(0, uniform(H), {0.9, closure});
          const auto driving = [&](double by) { return cells.driving_energy(0, found_sound, by); };
          of_g = std::max(of_g, std::abs(driving(g).value - std::max(slope, 0.0)) / std::abs(slope));
          const double curvature = (driving(g + e).value - driving(g - e).value) / (2.0 * e);
          of_curvature = std::max(of_curvature, std::abs(driving(g).slope - curvature) * g / std::abs(slope));
          const FiniteLaw law = cells.law({0}, H, {g, closure});
          Tensor P = law.stress;
          if (law.pressure != nullptr) {
            const double modulus = law.pressure_share * law.pressure->pressure_modulus() + law.pressure_kept;
            P += modulus * (J - 1.0) * cofactor(Tensor::Identity() + H);
          }
          const Tensor direction = Tensor::Identity() + 0.5 * shear;
          const double step = 1e-6, change = stored(H + step * direction, g) - stored(H - step * direction, g);
          of_stress = std::max(of_stress, std::abs(change / (2.0 * step * volume) - contract(P, direction)) /
                                              (P.norm() * direction.norm()));
        }
      }
  report_row("one energy", {{"driving energy", of_g}, {"its slope by g", of_curvature}, {"stress", of_stress}});
  EXPECT_LE(of_g, 1e-6);
  EXPECT_LE(of_curvature, 1e-6);
  EXPECT_LE(of_stress, 1e-6);
}

// The split "hybrid" stores what "none" does; compressed cells are driven by W - W(J^(1/3) 1), by hand.
TEST(FiniteStrainDamage, HybridIsDrivenByAllButTheEnergyOfCompression) {
  const Mesh mesh = block(1, 1.0);
  const FractureModel whole = damaged_model("AT2", 100.0, 0.05, pulled(1.0), "none");
  const FractureModel hybrid = damaged_model("AT2", 100.0, 0.05, pulled(1.0), "hybrid");
  const FiniteCells by_all(mesh, whole), by_tension(mesh, hybrid);
  constexpr double g = 0.5;
  for (const Vector& l : {Vector(1.4, 0.9, 0.9), Vector(1.3, 0.8, 0.8), Vector(0.7, 1.1, 0.9), Vector(0.8, 0.8, 0.8)}) {
    Tensor F = l.asDiagonal();
    F(0, 1) = 0.2;
    const double J = F.determinant(), mu = rubber.mu, Lambda = rubber.lambda;
    const double of_volume = -mu * std::log(J) + 0.5 * Lambda * (J - 1.0) * (J - 1.0);
    const double W = 0.5 * mu * (F.squaredNorm() - 3.0) + of_volume;
    const double W_c = J < 1.0 ? 1.5 * mu * (std::pow(J, 2.0 / 3.0) - 1.0) + of_volume : 0.0;
    const CellMechanics mechanics = uniform(F - Tensor::Identity());
    const FiniteEnergies at = by_tension.energies(0, mechanics, {g});
    EXPECT_NEAR(by_tension.driving_energy(0, at, g).value, W - W_c, 1e-12 * W);
    EXPECT_NEAR(by_tension.stored_energy(0, at, g) / mesh.cell_volume[0], g * W, 1e-12 * W);
    EXPECT_EQ(by_tension.law({0}, mechanics.gradient[0], {g}).stress,
              by_all.law({0}, mechanics.gradient[0], {g}).stress);
  }
}

// The same where the pressure is an unknown: c U drives in expansion alone.
TEST(FiniteStrainDamage, HybridIsNotDrivenByPressureOfNearlyIncompressibleCells) {
  const Mesh mesh = block(1, 1.0);
  const IsotropicElasticity soft = from_young_poisson(1.5e6, 0.4999);
  const auto driving = [&](const char* split, double stretch) {
    FractureModel model = damaged_model("AT2", 100.0, 0.05, pulled(1.0), split);
    model.regions[0].elasticity = soft;
    model.regions[0].material = make_hyperelastic("neo_hookean", {.elasticity = soft});
    const FiniteCells cells(mesh, model);
    const CellMechanics mechanics = uniform((stretch - 1.0) * Tensor::Identity());
    return cells.driving_energy(0, cells.energies(0, mechanics, {1.0}), 1.0).value;
  };
  EXPECT_GT(driving("none", 1.05), 0.0);
  EXPECT_EQ(driving("hybrid", 1.05), driving("none", 1.05));
  EXPECT_GT(driving("none", 0.95), 0.0);
  EXPECT_LE(driving("hybrid", 0.95), 1e-9 * driving("none", 0.95));
  // The pressure's volume passes through that at rest, that of the mean gradient does not: nothing jumps.
  FractureModel model = damaged_model("AT2", 100.0, 0.05, pulled(1.0), "hybrid");
  model.regions[0].elasticity = soft;
  model.regions[0].material = make_hyperelastic("neo_hookean", {.elasticity = soft});
  const FiniteCells cells(mesh, model);
  const auto driving_at = [&](double stretch, double change) {
    CellMechanics mechanics =
        uniform(Vector(1.4 * stretch, 0.8 * stretch, 0.9 * stretch).asDiagonal().toDenseMatrix() - Tensor::Identity());
    mechanics.volume_change = CellField<double>(mesh.n_cells(), change);
    return cells.driving_energy(0, cells.energies(0, mechanics, {0.9}), 0.9).value;
  };
  for (const double stretch : {0.95, 1.05})
    EXPECT_NEAR(driving_at(stretch, -1e-9), driving_at(stretch, 1e-9), 1e-3 * driving_at(stretch, 1e-9));
}

// Of a cell stretched to twice its length or more it is convex in the damage beyond d = 0.6: no damage below which much
// drives it on and above which little does. At smaller stretches, and of the relaxed c U at small d, it is not.
TEST(FiniteStrainDamage, TheEnergyOfAStretchedCellIsConvexInTheDamage) {
  const Mesh mesh = block(1, 1.0);
  for (const double nu : {0.45, 0.49, 0.4999})
    for (const Vector& l :
         {Vector(2.0, 1.0, 1.0), Vector(3.0, 0.9, 0.9), Vector(8.0, 0.4, 0.5), Vector(10.0, 1.0, 1.0)}) {
      const IsotropicElasticity elasticity = from_young_poisson(1.5e6, nu);
      FractureModel model = damaged_model("AT2", 100.0, 0.05, pulled(1.0), "none");
      model.regions[0].elasticity = elasticity;
      model.regions[0].material = make_hyperelastic("neo_hookean", {.elasticity = elasticity});
      const FiniteCells cells(mesh, model);
      const CellMechanics mechanics = uniform(Tensor(l.asDiagonal()) - Tensor::Identity());
      const auto energy = [&](double z) {
        return cells.stored_energy(0, cells.energies(0, mechanics, {z * z}), z * z);
      };
      double least = 0.0;
      for (double z = 0.002; z < 0.4; z += 0.001)
        least = std::min(least, (energy(z + 0.001) - 2.0 * energy(z) + energy(z - 0.001)) / energy(z));
      report_row(fmt::format("nu {}, stretch {}", nu, l.x()), {{"least second difference over the energy", least}});
      EXPECT_GE(least, -1e-12);
    }
}

// The middle layer is broken from the beginning: it takes the whole elongation, the halves stay as they are.
TEST(FiniteStrainDamage, ABrokenLayerStretchesWithoutEnd) {
  const Mesh mesh = block(21, 1.0);
  FractureModel model = damaged_model("AT2", 100.0, 0.05, pulled(2.0), "volumetric_deviatoric");
  model.initial_damage = CellField<double>(mesh.n_cells(), 0.0);
  for (Index c = 0; c < mesh.n_cells(); ++c)
    if (std::abs(mesh.cell_centre[c].x() - 0.5) < 0.03) model.initial_damage[c] = 1.0;
  FractureRun run(mesh, model, {}, {.initial_increment = 0.1, .maximum_increment = 0.1, .stops = {}});
  StepReport last;
  const FractureState end = run_to_end(run, [&](const FractureState&, const StepReport& report) { last = report; });
  double left = 0.0, right = 0.0;
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    if (mesh.cell_centre[c].x() < 0.2) left = std::max(left, std::abs(end.displacement[c].x()));
    if (mesh.cell_centre[c].x() > 0.8) right = std::max(right, std::abs(end.displacement[c].x() - 2.0));
  }
  const double force = last.reaction[mesh.patch_index("xmax")].x() / 0.0625 / stress_at(3.0);
  report_row("broken layer, elongation 2", {{"left half", left}, {"right half", right}, {"force", force}});
  EXPECT_LE(left, 2e-3);
  EXPECT_LE(right, 2e-3);
  EXPECT_LE(std::abs(force), 1e-3);
}

// A block of a sixteenth of the stiffness is pressed to a negative volume; beyond J = 0.1 the functions of J are
// parabolas.
TEST(FiniteStrainDamage, ADamagedBlockMayBePressedInsideOut) {
  const Mesh mesh = block(4, 1.0);
  constexpr double pressed = 1.1, damage = 0.75;
  FractureModel model = damaged_model("AT2", 1e12, 100.0, pulled(-pressed), "none");
  model.initial_damage = CellField<double>(mesh.n_cells(), damage);
  FractureRun run(mesh, model, {}, {.initial_increment = 0.1, .maximum_increment = 0.1, .stops = {}});
  const auto stress = [](double l) {
    constexpr double least = 0.1;
    const double slope = rubber.mu / (least * least) + rubber.lambda, J = std::max(l, least);
    return rubber.mu * l - rubber.mu / J + rubber.lambda * (J - 1.0) + slope * (l - J);
  };
  double worst = 0.0;
  const FractureState end = run_to_end(run, [&](const FractureState& state, const StepReport& report) {
    if (report.step == 0) return;
    const double g = (1.0 - 1e-6) * std::pow(1.0 - state.damage[0], 2) + 1e-6;
    const double force = report.reaction[mesh.patch_index("xmax")].x() / 0.0625;
    worst = std::max(worst, std::abs(force / (g * stress(1.0 - pressed * state.load)) - 1.0));
  });
  report_row("pressed block", {{"damage", end.damage[0]}, {"largest relative error of the force", worst}});
  ASSERT_EQ(end.load, 1.0);
  EXPECT_NEAR(end.damage[0], damage, 1e-3);
  EXPECT_LE(worst, 1e-6);
}

// A bar of AT1 damages from W = 3 Gc/(16 ell) on and breaks at once: until then work is stored, and the crack takes Gc.
TEST(FiniteStrainDamage, WorkOfABreakingBarIsAccountedFor) {
  const Mesh mesh = block(40, 1.0);
  const double Gc = 1.5e5, ell = 0.1;
  for (const char* split : {"none", "volumetric_deviatoric"}) {
    FractureModel model = damaged_model("AT1", Gc, ell, pulled(1.2), split);
    model.initial_damage = CellField<double>(mesh.n_cells(), 0.0);
    for (Index c = 19; c < 21; ++c) model.initial_damage[c] = 0.05;
    FractureRun run(mesh, model, {.damage_tolerance = 1e-5, .energy_tolerance = 1e-7},
                    {.initial_increment = 0.02,
                     .maximum_increment = 0.02,
                     .energy_release = 0.02,
                     .finest_increment = 1e-4,
                     .stops = {}});
    EnergyAccount first;
    double broke_at = 0.0, before = 0.0, work = 0.0;
    StepReport last;
    run_to_end(run, [&](const FractureState& state, const StepReport& report) {
      if (report.step == 0) first = report.energy;
      if (report.max_damage < 0.95) broke_at = state.load;
      work = std::max(work, report.energy.external_work);
      if (report.max_damage < 0.95)
        before = std::max(before, std::abs(left_over(first, report.energy)) / std::max(work, 1.0));
      last = report;
    });
    report_row(fmt::format("bar, split {}", split), {{"breaks at", broke_at},
                                                     {"unaccounted before", before},
                                                     {"surface energy / Gc A", last.energy.fracture / (Gc * 0.0625)},
                                                     {"iterations", double(run.staggered_iterations())},
                                                     {"steps", double(last.step)}});
    EXPECT_LE(before, 0.01);
    EXPECT_GT(last.max_damage, 0.99);
    EXPECT_NEAR(last.energy.fracture / (Gc * 0.0625), 1.0, 0.1);
  }
}

}  // namespace
}  // namespace pfdm::verification::this_file
