// Eigenstrains, as of thermal expansion. A uniform eigenstrain E with displacements u on the surface makes the stress
// of the body without it under u - E x: for every cell, split and damage. Closed forms: a bar between rigid walls; the
// bimetal strip of Timoshenko (J. Opt. Soc. Am. 11 (1925) 233); a sphere that does not fit its hole (Eshelby, Proc. R.
// Soc. A 241 (1957) 376: a mean strain e in the sphere, displacement A r inside, A a^3/r^2 outside,
// A = 3 K e/(3 K + 4 mu), K of the sphere and mu of the matrix).

#include "mesh/generators/sphere_sector.h"
#include "physics/materials/hyperelastic.h"
#include "solver/fracture/bending_words.h"
#include "solver/fracture/equilibrium/law_newton.h"
#include "tests/verification/bar.h"
#include "tests/verification/support.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>

namespace pfdm::verification::this_file {
namespace {

const IsotropicElasticity glass = from_young_poisson(70e9, 0.2), epoxy = from_young_poisson(3e9, 0.35),
                          rubber = from_young_poisson(3e6, 0.4999);
const Tensor slope = (Tensor() << 1.0, 0.3, 0.0, 0.1, -0.7, 0.0, 0.0, 0.0, 0.6).finished() * 1e-3;

std::shared_ptr<const LoadField<Tensor>> given(const Tensor& strain) {
  return std::make_shared<const LoadField<Tensor>>([strain](const Vector&, double t) -> Tensor { return t * strain; });
}

struct Answer {
  CellMechanics cells;
  CellField<double> driving, stored;
  double residual = 0.0;
};

// At given damage and the load parameter 1: closures follow until they falsify the energy by less than 1e-13.
Answer equilibrium(const Mesh& mesh, const FractureModel& model, const CellField<double>& damage) {
  const Unknowns unknowns = place_unknowns(mesh, elastic_body(model));
  MomentumSolver solver(mesh, unknowns);
  CellStiffness stiffness(mesh, model);
  stiffness.start_step(0.0);
  const std::size_t n = mesh.n_cells();
  FractureState state;
  state.step = 1;
  state.load = 1.0;
  state.damage = damage;
  state.closure = CellField<double>(n, 0.0);
  state.displacement.assign(unknowns.n_unknowns(), Vector::Zero());
  constexpr MomentumSolver::Tolerance tight{.ceiling = 1e-12, .floor = 1e-12};
  Answer answer;
  answer.driving = answer.stored = CellField<double>(n);
  double unsettled = 1.0;
  for (int k = 0; unsettled > 1e-13 && k < 60; ++k) {
    stiffness.set(state, solver);
    const Equilibrium on = stiffness.is_linearised() ? solve_with_laws(stiffness, tight, solver, state)
                                                     : solver.solve(1.0, tight, state.displacement);
    EXPECT_LT(on.residual, 1e-11);
    answer.residual = on.residual;
    answer.cells =
        solver.balance().mechanics(state.displacement, MomentumOperator::Wanted::all, stiffness.degradable_part(state));
    double energy = 0.0;
    for (Index c = 0; c < mesh.n_cells(); ++c) energy += stiffness.stored_energy(c, answer.cells, state);
    unsettled = stiffness.follow(answer.cells, state) / std::max(energy, 1e-300);
  }
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    answer.driving[c] = stiffness.driving_energy(c, answer.cells, state);
    answer.stored[c] = stiffness.stored_energy(c, answer.cells, state);
  }
  return answer;
}

struct Problem {
  std::string name;
  Mesh mesh;
  std::vector<IsotropicElasticity> materials;  // by region
  std::vector<std::string> held;               // patches whose displacement is prescribed
  std::vector<BoundaryCondition> sides;        // conditions on the others
  Tensor slope, eigenstrain;
  std::string split = "none";
  bool has_damage = false;
};

FractureModel model_of(const Problem& problem, bool with_eigenstrain) {
  FractureModel model = elastic_model(problem.materials, problem.sides);
  model.split = energy_split(problem.split);
  for (RegionModel& region : model.regions) {
    if (problem.has_damage) region.damageable = true;
    region.Gc = region.ell = 1.0;
  }
  const Tensor strain = problem.eigenstrain, moved = with_eigenstrain ? problem.slope : Tensor(problem.slope - strain);
  const auto eigenstrain = given(strain);
  if (with_eigenstrain)
    for (RegionModel& region : model.regions) region.eigenstrain = eigenstrain;
  for (const std::string& patch : problem.held)
    model.boundary.push_back(displacement_on(patch, [moved](const Vector& x) -> Vector { return moved * x; }));
  return model;
}

// Of cells from sound to nearly broken, in patches.
CellField<double> some_damage(const Mesh& mesh) {
  CellField<double> damage(mesh.n_cells());
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const Vector& x = mesh.cell_centre[c];
    damage[c] = 0.45 * (1.0 + std::sin(3.0 * x[0] + 1.0) * std::cos(2.0 * x[1] - 0.3 * x[2]));
  }
  return damage;
}

double largest(const CellField<Tensor>& field) {
  double most = 0.0;
  for (const Tensor& value : field) most = std::max(most, value.norm());
  return most;
}

void expect_same_stress(const Problem& problem) {
  const CellField<double> damage =
      problem.has_damage ? some_damage(problem.mesh) : CellField<double>(problem.mesh.n_cells(), 0.0);
  const Answer with = equilibrium(problem.mesh, model_of(problem, true), damage);
  const Answer without = equilibrium(problem.mesh, model_of(problem, false), damage);
  double stress = 0.0, driving = 0.0, stored = 0.0;
  for (Index c = 0; c < problem.mesh.n_cells(); ++c) {
    stress = std::max(stress, (with.cells.stress[c] - without.cells.stress[c]).norm());
    driving = std::max(driving, std::abs(with.driving[c] - without.driving[c]));
    stored = std::max(stored, std::abs(with.stored[c] - without.stored[c]));
  }
  stress /= largest(without.cells.stress);
  driving /= *std::max_element(without.driving.begin(), without.driving.end());
  stored /= *std::max_element(without.stored.begin(), without.stored.end());
  report_row(problem.name, {{"stress", stress}, {"driving energy", driving}, {"stored energy", stored}});
  EXPECT_LT(stress, 1e-8) << problem.name;
  EXPECT_LT(driving, 1e-8) << problem.name;
  EXPECT_LT(stored, 1e-8) << problem.name;
}

const std::vector<std::string> six{"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"};

Mesh plate(Index along, Index across, double length = 1.0) {
  BoxHexesSettings box;
  box.axes[0] = {{length, along, 2.0}};
  box.axes[1] = {{1.0, across, 1.0}};
  box.axes[2] = {{0.2, 1, 1.0}};
  box.regions = {{.name = "right", .lower = {0.4 * length, -1.0, -1.0}, .upper = {2.0 * length, 2.0, 1.0}}};
  return make_box_hexes(box);
}

Tensor general_strain() { return (Tensor() << 1.2, 0.4, -0.3, 0.4, 0.5, 0.2, -0.3, 0.2, -0.9).finished() * 1e-3; }

// Within the plane, and across it.
Tensor plane_strain_of(double across) {
  Tensor strain = general_strain();
  strain.row(2).setZero();
  strain.col(2).setZero();
  strain(2, 2) = across;
  return strain;
}

TEST(Eigenstrains, ActAsDisplacementsOfTheSurfaceOnTetrahedraPrismsAndPolyhedra) {
  for (const bool dual : {false, true})
    for (const bool soft : {false, true}) {
      const Mesh mesh = sphere_in_cube(1, 2, 2.0, 0.6);
      Problem problem{.name = fmt::format("{}{}", dual ? "polyhedra" : "tetrahedra and prisms", soft ? ", rubber" : ""),
                      .mesh = dual ? barycentric_dual(mesh) : mesh,
                      .materials = {glass, soft ? rubber : epoxy},
                      .held = six,
                      .sides = {},
                      .slope = slope,
                      .eigenstrain = general_strain(),
                      .has_damage = true};
      problem.materials.resize(problem.mesh.region_names.size(), problem.materials.back());
      if (soft) {  // a free side, or the change of volume times lambda would be all of it
        problem.held = {"xmin", "xmax", "ymin", "ymax", "zmin"};
        problem.has_damage = false;
      }
      if (soft) continue;
      expect_same_stress(problem);
    }
}

TEST(Eigenstrains, ActAsDisplacementsOfTheSurfaceInPlates) {
  for (const bool plane_stress : {false, true})
    for (const SplitLaw& law : energy_splits()) {
      if (law.parameters.size() > 0) continue;
      const auto side = plane_stress ? plane_stress_on : plane_on;
      expect_same_stress({.name = fmt::format("{}, {}", law.name, plane_stress ? "plane stress" : "plane strain"),
                          .mesh = plate(8, 6),
                          .materials = {glass, epoxy},
                          .held = {"xmin", "xmax", "ymin", "ymax"},
                          .sides = {side("zmin"), side("zmax")},
                          .slope = plane_strain_of(0.0) - Tensor(slope.topLeftCorner<3, 3>() * 0.0),
                          .eigenstrain = -0.6 * plane_strain_of(plane_stress ? 4e-4 : 0.0),
                          .split = std::string(law.name),
                          .has_damage = true});
    }
}

TEST(Eigenstrains, ActAsDisplacementsOfTheSurfaceInBeamsWithCubicFaces) {
  expect_same_stress({.name = "8 x 4 cells, 5 x 1",
                      .mesh = plate(8, 4, 5.0),
                      .materials = {glass, epoxy},
                      .held = {"xmin", "xmax", "ymin"},
                      .sides = {plane_on("zmin"), plane_on("zmax")},
                      .slope = Tensor::Zero(),
                      .eigenstrain = plane_strain_of(0.0),
                      .has_damage = false});
}

// Also without a displacement on the surface: what expands freely has no stress.
double stress_of_free_body(Mesh mesh, const IsotropicElasticity& material, const std::string& split, bool damaged,
                           const Tensor& expansion, std::vector<BoundaryCondition> sides) {
  FractureModel model = elastic_model({}, std::move(sides));
  model.split = energy_split(split);
  for (std::size_t r = 0; r < mesh.region_names.size(); ++r)
    model.regions.push_back(
        {.elasticity = material, .Gc = 1.0, .ell = 1.0, .damageable = damaged, .eigenstrain = given(expansion)});
  const CellField<double> damage = damaged ? some_damage(mesh) : CellField<double>(mesh.n_cells(), 0.0);
  const Answer answer = equilibrium(mesh, model, damage);
  return largest(answer.cells.stress) / (material.young_modulus() * expansion.norm());
}

TEST(Eigenstrains, LeaveAFreeBodyWithoutStress) {
  const Tensor alike = 1e-3 * Tensor::Identity(), three = Vector(1e-3, -4e-4, 2e-3).asDiagonal();
  const std::vector<BoundaryCondition> corner{symmetry_on("xmin"), symmetry_on("ymin"), symmetry_on("zmin")};
  const std::vector<BoundaryCondition> sector{axisymmetric_on("front"), axisymmetric_on("back"),
                                              symmetry_on("equator")};
  const auto shell = [] {
    return make_sphere_sector({.azimuth = 0.1,
                               .inner_radius = 0.5,
                               .shells = {{{0.5, 4, 1.0}, "body"}},
                               .polar = {{std::numbers::pi / 2.0, 8, 1.0}}});
  };
  const Mesh cube = sphere_in_cube(1, 2, 2.0, 0.6);
  for (const auto& split : {"none", "volumetric_deviatoric", "spectral"})
    for (const bool damaged : {false, true}) {
      const double found = stress_of_free_body(cube, epoxy, split, damaged, three, corner);
      report_row(fmt::format("{}{}", split, damaged ? ", damaged" : ""), {{"stress over E eps*", found}});
      EXPECT_LT(found, 1e-10);
    }
  const double in_rubber = stress_of_free_body(cube, rubber, "none", false, three, corner);
  const double in_sector = stress_of_free_body(shell(), epoxy, "none", true, alike, sector);
  const double of_rubber = stress_of_free_body(shell(), rubber, "none", false, alike, sector);
  report_row("rubber, sector, sector of rubber", {{"a", in_rubber}, {"b", in_sector}, {"c", of_rubber}});
  EXPECT_LT(in_rubber, 1e-9);  // over E: the pressure has 1/(1 - 2 nu) times its rounding
  EXPECT_LT(in_sector, 1e-10);
  EXPECT_LT(of_rubber, 1e-9);
}

// Heated between walls: -E alpha dT along it, the work of heating is what it stores.
TEST(Eigenstrains, BarBetweenWalls) {
  BoxHexesSettings box;
  box.axes = {{{{10.0, 10, 1.0}}, {{1.0, 2, 1.0}}, {{1.0, 2, 1.0}}}};
  const Mesh mesh = make_box_hexes(box);
  FractureModel model =
      elastic_model({epoxy}, {symmetry_on("xmin"), symmetry_on("xmax"), symmetry_on("ymin"), symmetry_on("zmin")});
  constexpr double alpha = 6e-5, dT = 40.0;
  model.regions[0].expansion = alpha * Tensor::Identity();
  model.loads.temperature = [](const Vector&, double t) { return t * dT; };
  FractureRun run(mesh, model, {.equilibrium_tolerance = 1e-12},
                  {.initial_increment = 0.5, .maximum_increment = 0.5, .stops = {}});
  StepReport last;
  const FractureState state = run_to_end(run, [&](const FractureState&, const StepReport& report) { last = report; });
  const double E = epoxy.young_modulus(), stress = -E * alpha * dT;
  const double energy = 0.5 * stress * stress / E * 10.0;
  const OutputFields fields = run.output(state);
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    EXPECT_NEAR(fields.stress[c](0, 0) / stress, 1.0, 1e-9);
    EXPECT_NEAR(fields.stress[c](1, 1) / stress, 0.0, 1e-9);
    EXPECT_NEAR(fields.strain[c](1, 1), (1.0 + epoxy.poisson_ratio()) * alpha * dT, 1e-12);
  }
  EXPECT_NEAR(last.reaction[1][0] / stress, 1.0, 1e-9);
  EXPECT_NEAR(last.energy.elastic / energy, 1.0, 1e-9);
  EXPECT_NEAR(last.energy.eigenstrain_work / energy, 1.0, 1e-9);
  EXPECT_NEAR(left_over({}, last.energy) / energy, 0.0, 1e-9);
}

struct Strip {
  double curvature = 0.0, exact = 0.0;
};

enum class StripIn { plane_stress, space, finite };

struct StripOf {
  Index along = 0;
  std::array<Index, 2> layers{4, 6};  // of the lower and the upper material
  double E_lower = 200e9, E_upper = 90e9;
  StripIn in = StripIn::plane_stress;
};

// Of two layers, 0.4 and 0.6 of the height; plane stress, or half of a narrow strip in space. The last cells at its
// ends do not count. `warning`: what is said of it.
Strip bend_by_heat(const StripOf& of, std::string* warning = nullptr) {
  constexpr double length = 12.0, alpha_lower = 12e-6, alpha_upper = 30e-6;
  constexpr double lower = 0.4, upper = 0.6, dT = 1.0;
  const StripIn in = of.in;
  const IsotropicElasticity steel = from_young_poisson(of.E_lower, 0.3), zinc = from_young_poisson(of.E_upper, 0.3);
  BoxHexesSettings box;
  box.axes[0] = {{length, of.along, 1.0}};
  box.axes[1] = {{lower, of.layers[0], 1.0}, {upper, of.layers[1], 1.0}};
  box.axes[2] = {{0.2, 1, 1.0}};
  box.regions = {{.name = "upper", .lower = {-1.0, lower, -1.0}, .upper = {length + 1.0, 2.0, 1.0}}};
  box.patches = {{"pin", {-1e-9, -1e-9, -1.0}, {1e-9, lower / static_cast<double>(of.layers[0]) + 1e-9, 1.0}}};
  const Mesh mesh = make_box_hexes(box);
  std::vector<BoundaryCondition> boundary{
      symmetry_on("xmin"),
      moved("pin", {true, true, in != StripIn::space}, [](const Vector&, double) -> Vector { return Vector::Zero(); })};
  if (in == StripIn::space)
    boundary.push_back(symmetry_on("zmin"));
  else
    boundary.insert(boundary.end(), {plane_stress_on("zmin"), plane_stress_on("zmax")});
  FractureModel model = elastic_model({steel, zinc}, std::move(boundary));
  if (in == StripIn::finite)
    for (RegionModel& region : model.regions)
      region.material = make_hyperelastic("neo_hookean", {.elasticity = region.elasticity});
  model.regions[0].expansion = alpha_lower * Tensor::Identity();
  model.regions[1].expansion = alpha_upper * Tensor::Identity();
  model.loads.temperature = [](const Vector&, double t) { return t * dT; };
  FractureRun run(mesh, model, {.equilibrium_tolerance = 1e-10},
                  {.initial_increment = 1.0, .maximum_increment = 1.0, .stops = {}});
  const FractureState state = run_to_end(run, [](const FractureState&, const StepReport&) {});
  const OutputFields fields = run.output(state);
  // Slope of eps_xx over y by least squares, in the columns at mid-span.
  double sy = 0.0, se = 0.0, syy = 0.0, sye = 0.0, n = 0.0;
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const Vector& x = mesh.cell_centre[c];
    if (std::abs(x[0] - 0.5 * length) > 0.1 * length) continue;
    const double e = fields.strain[c](0, 0);
    sy += x[1], se += e, syy += x[1] * x[1], sye += x[1] * e, n += 1.0;
  }
  if (warning != nullptr) *warning = bending_warning(mesh, model).value_or("");
  const double m = lower / upper,
               ratio = of.E_lower / of.E_upper;  // Timoshenko's m and n, of the lower to the upper layer
  const double exact =
      6.0 * (alpha_upper - alpha_lower) * dT * (1.0 + m) * (1.0 + m) /
      ((lower + upper) * (3.0 * (1.0 + m) * (1.0 + m) + (1.0 + m * ratio) * (m * m + 1.0 / (m * ratio))));
  return {(n * sye - sy * se) / (n * syy - sy * sy), exact};
}

// What the layers exchange near the free end decides, within a length of the thickness.
TEST(Eigenstrains, BimetalStripBendsAsTimoshenkosDoes) {
  std::vector<double> errors;
  for (const Index along : {20, 60, 120}) {
    const Strip strip = bend_by_heat({.along = along, .layers = {2, 3}});
    report_row(fmt::format("{} x 5 cells", along), {{"curvature over Timoshenko's", strip.curvature / strip.exact}});
    errors.push_back(std::abs(strip.curvature / strip.exact - 1.0));
  }
  EXPECT_LT(errors[1], 0.02);
  EXPECT_LT(errors[2], 0.01);
}

// Gradients are those along lines of cells.
TEST(Eigenstrains, BimetalStripsOfFewOrLongCellsBendAsTimoshenkosDoes) {
  for (const StripIn in : {StripIn::plane_stress, StripIn::space, StripIn::finite})
    for (const Index along : {60, 30, 15}) {
      const Strip strip = bend_by_heat({.along = along, .in = in});
      report_row(fmt::format("{} x 10 cells, {}", along,
                             in == StripIn::space ? "in space" : (in == StripIn::finite ? "finite strain" : "plane")),
                 {{"curvature over Timoshenko's", strip.curvature / strip.exact}});
      EXPECT_NEAR(strip.curvature / strip.exact, 1.0, 0.03);
    }
}

// Fits to smooth fields, which plane bodies without eigenstrains have, bend the last four by 0.76 to 0.91 in 15 cells
// along. With a tenth of the stiffness in one material the forces are exchanged over several cells of it.
TEST(Eigenstrains, PlaneStripsOfFewLayersBendAsTimoshenkosDo) {
  for (const auto& [layers, E_lower, E_upper, bound] : {std::tuple{std::array<Index, 2>{2, 2}, 200e9, 90e9, 0.03},
                                                        {{3, 3}, 200e9, 200e9, 0.03},
                                                        {{2, 6}, 200e9, 90e9, 0.03},
                                                        {{3, 3}, 50e9, 200e9, 0.045},
                                                        {{4, 6}, 200e9, 20e9, 0.035},
                                                        {{2, 3}, 20e9, 200e9, 0.06}})
    for (const Index along : {60, 15}) {
      std::string warning;
      const Strip strip =
          bend_by_heat({.along = along, .layers = layers, .E_lower = E_lower, .E_upper = E_upper}, &warning);
      report_row(
          fmt::format("{} x {} + {} cells, {} to {} GPa", along, layers[0], layers[1], E_lower / 1e9, E_upper / 1e9),
          {{"curvature over Timoshenko's", strip.curvature / strip.exact}});
      EXPECT_NEAR(strip.curvature / strip.exact, 1.0, bound);
      EXPECT_EQ(warning, "");
    }
}

// A material of one cell bends within the cell, which its gradient does not see.
TEST(Eigenstrains, PlaneStripsOfOneCellAMaterialAreWarnedOf) {
  std::string warning;
  const Strip strip = bend_by_heat({.along = 60, .layers = {1, 1}}, &warning);
  const double excess = strip.curvature / strip.exact - 1.0;
  report_row("60 x 1 + 1 cells", {{"curvature over Timoshenko's, less 1", excess}});
  EXPECT_NEAR(excess, 0.7 * 0.6 * 0.6, 0.7 * 0.6 * 0.6);
  EXPECT_GT(excess, 0.5 * 0.7 * 0.6 * 0.6);
  EXPECT_NE(warning.find("their stiffness is about 25 % too low (0.7 (t/thickness)^2"), std::string::npos) << warning;
}

TEST(Eigenstrains, SphereThatDoesNotFit) {
  constexpr double e = 1e-3;
  for (const bool soft : {false, true}) {
    const IsotropicElasticity matrix = soft ? rubber : epoxy;
    const double K = glass.bulk_modulus(), A = 3.0 * K * e / (3.0 * K + 4.0 * matrix.mu);
    const auto shrunk = [&](const Vector& x) -> Vector {
      const double r = x.norm();
      return r < 1.0 ? (A * x).eval() : (A / (r * r * r) * x).eval();
    };
    const auto exact = [&](const Vector& x) -> Tensor {
      const double r = x.norm();
      if (r < 1.0) return -4.0 * matrix.mu * A * Tensor::Identity();
      const Vector n = x / r;
      return 2.0 * matrix.mu * A / (r * r * r) * (Tensor::Identity() - 3.0 * n * n.transpose());
    };
    std::vector<double> errors;
    for (const Index n : {1, 2}) {
      const double ring = 0.1 / static_cast<double>(n);
      const Mesh mesh = make_sphere_sector({.azimuth = ring,
                                            .inner_radius = 0.2,
                                            .shells = {{{0.8, 6 * n, 1.0}, "glass"}, {{1.5, 12 * n, 3.0}, "matrix"}},
                                            .polar = {{std::numbers::pi / 2.0, 10 * n, 1.0}}});
      FractureModel model = elastic_model({glass, matrix}, {axisymmetric_on("front"), axisymmetric_on("back"),
                                                            symmetry_on("equator"), displacement_on("inner", shrunk)});
      if (soft)  // a pressure there would be anything
        model.boundary.push_back(
            traction_on("outer", [&](const Vector& x) -> Vector { return exact(x) * x / x.norm(); }));
      else
        model.boundary.push_back(displacement_on("outer", shrunk));
      model.regions[0].eigenstrain = given(e * Tensor::Identity());
      const Answer answer = equilibrium(mesh, model, CellField<double>(mesh.n_cells(), 0.0));
      const auto inside = [&](Index c) { return mesh.region[c] == 0; };
      const auto outside = [&](Index c) { return mesh.region[c] == 1; };
      const double in = relative_stress_error(mesh, answer.cells.stress, exact, inside);
      const double out = relative_stress_error(mesh, answer.cells.stress, exact, outside);
      report_row(fmt::format("{} cells, nu = {:.4f}", mesh.n_cells(), matrix.poisson_ratio()),
                 {{"inside", in}, {"outside", out}});
      errors.push_back(out);
      EXPECT_LT(in, 0.03);
      EXPECT_LT(out, 0.05);
    }
    EXPECT_LT(errors[1], 0.6 * errors[0]);
  }
}

// A bar that shrinks between walls breaks as one that is pulled by as much.
TEST(Eigenstrains, ShrinkingBarBreaksAsAPulledOne) {
  for (const char* split : {"none", "spectral"}) {
    const Bar bar({.length = 4.3, .poisson_ratio = 0.2, .split = split});
    const auto run = [&](const FractureModel& model) { return reports_of_break(bar, model); };
    FractureModel shrinking = bar.model();
    shrinking.boundary[1] = symmetry_on("xmax");
    const Tensor strain = -bar.strength() / Bar::E * Vector::UnitX() * Vector::UnitX().transpose();
    const auto eigenstrain = given(strain);
    for (RegionModel& region : shrinking.regions) region.eigenstrain = eigenstrain;
    const std::vector<StepReport> pulled = run(bar.model()), shrunk = run(shrinking);
    ASSERT_EQ(pulled.size(), shrunk.size());
    const auto wall = bar.mesh().patch_index("xmax");
    const double strength = bar.strength() * bar.area(), Gc = Bar::Gc * bar.area();
    double force = 0.0, fracture = 0.0, account = 0.0;
    for (std::size_t k = 1; k < pulled.size(); ++k) {
      force = std::max(force, std::abs(pulled[k].reaction[wall][0] - shrunk[k].reaction[wall][0]) / strength);
      fracture = std::max(fracture, std::abs(pulled[k].energy.fracture - shrunk[k].energy.fracture) / Gc);
      account = std::max(account, std::abs(pulled[k].energy.external_work - shrunk[k].energy.eigenstrain_work) / Gc);
    }
    report_row(split, {{"force", force}, {"fracture energy", fracture}, {"work", account}});
    EXPECT_GT(pulled.back().max_damage, 0.9);
    EXPECT_LT(force, 1e-4);
    EXPECT_LT(fracture, 1e-4);
    EXPECT_LT(account, 1e-4);
  }
}

}  // namespace
}  // namespace pfdm::verification::this_file
