// Cohesive faces at finite strain: the linearised balance against differences, each law in a bar in series, the limit
// of small strain, an opened interface that is turned, a sphere in rubber.

#include "physics/materials/hyperelastic.h"
#include "solver/fracture/cells/cell_stiffness.h"
#include "solver/fracture/equilibrium/cohesive_newton.h"
#include "tests/verification/cohesive_blocks.h"
#include "tests/verification/noise.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pfdm::verification::this_file {
namespace {

const IsotropicElasticity rubber = from_young_poisson(2e6, 0.3);
constexpr InterfaceStrength bond{
    .strength = 1e6, .toughness = 4000.0, .shear_strength = 1.5e6, .shear_toughness = 7000.0, .stiffness = 2e10};

// Regions of one elasticity share their material: no unknowns on the faces between them, as at small strain.
void make_finite(FractureModel& model) {
  std::shared_ptr<const Material> last;
  for (RegionModel& region : model.regions) {
    if (!last || !(last->elasticity() == region.elasticity))
      last = make_hyperelastic("neo_hookean", {.elasticity = region.elasticity});
    region.material = last;
  }
}

FractureModel bonded_blocks(const Mesh& mesh, const InterfaceLaw& law, const IsotropicElasticity& elasticity) {
  FractureModel model = elastic_model(std::vector(mesh.region_names.size(), elasticity), {});
  glue(model, mesh, law, bond, Vector::UnitX(), [](const Vector& x) { return std::abs(x.x() - edge) < 1e-9; });
  make_finite(model);
  return model;
}

const TractionSeparationLaw& linear_law() { return find_by_name(traction_separation_laws(), "linear", "law"); }

struct Step {
  Vector force;  // on the patch xmax
  OutputInterface interface;
  EnergyAccount energy;
};

// Steps through the values 1, 2 ... of the load parameter.
std::vector<Step> step_through(const Mesh& mesh, const FractureModel& model, std::size_t n_steps,
                               double tolerance = 1e-12) {
  FractureRun run(mesh, model, {.equilibrium_tolerance = tolerance},
                  {.end = double(n_steps),
                   .initial_increment = 1.0,
                   .minimum_increment = 1.0,
                   .maximum_increment = 1.0,
                   .stops = {}});
  std::vector<Step> steps;
  run_to_end(run, [&](const FractureState& state, const StepReport& report) {
    steps.push_back({report.reaction[mesh.patch_index("xmax")], run.output(state).interfaces[0], report.energy});
  });
  return steps;
}

// The closed form of a neo-Hookean bar between sliding sides: lambda_y = lambda_z = 1,
// P = mu (s - 1/s) + Lambda (s - 1) at the stretch s.
double confined_traction(double s) { return rubber.mu * (s - 1.0 / s) + rubber.lambda * (s - 1.0); }
double confined_stretch(double P) {
  double low = 0.2, high = 8.0;
  for (int i = 0; i < 200; ++i) (confined_traction(0.5 * (low + high)) < P ? low : high) = 0.5 * (low + high);
  return 0.5 * (low + high);
}

class FiniteBlocks : public testing::TestWithParam<TractionSeparationLaw> {};

// Loaded to stretches of the blocks of up to 1.3, unloaded, closed.
TEST_P(FiniteBlocks, AreANeoHookeanBarInSeriesWithTheLaw) {
  const InterfaceLaw law = law_of(GetParam());
  const double length = bond.toughness / bond.strength;
  std::vector<double> opening{0.0};
  for (const double x : {0.001, 0.05, 0.3, 0.8, 1.5, 0.75, 0.0}) opening.push_back(x * length);
  opening.push_back(-5e5 / law.initial_stiffness(bond));
  std::vector<double> traction, path;
  InterfaceHistory history;
  for (const double delta : opening) {
    const InterfaceResponse response = law.respond(bond, Vector::UnitX(), delta * Vector::UnitX(), history);
    history = response.history;
    traction.push_back(response.traction.x());
    path.push_back(delta + 2.0 * edge * (confined_stretch(traction.back()) - 1.0));
  }
  const Mesh mesh = two_blocks(2);
  FractureModel model = bonded_blocks(mesh, law, rubber);
  const auto at = [&](double t) { return path[std::min(static_cast<std::size_t>(std::lround(t)), path.size() - 1)]; };
  model.boundary = {
      moved("xmin", {true, false, false}, [](const Vector&, double) -> Vector { return Vector::Zero(); }),
      moved("xmax", {true, false, false}, [&](const Vector&, double t) -> Vector { return at(t) * Vector::UnitX(); })};
  for (const char* side : {"ymin", "ymax", "zmin", "zmax"}) model.boundary.push_back(symmetry_on(side));
  const std::vector<Step> steps = step_through(mesh, model, path.size() - 1);
  ASSERT_EQ(steps.size(), path.size());
  double of_force = 0.0, of_opening = 0.0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    of_force = std::max(of_force, std::abs(steps[i].force.x() / (edge * edge) - traction[i]) / bond.strength);
    for (Index k = 0; k < steps[i].interface.opening.size(); ++k)
      of_opening = std::max(of_opening, std::abs(steps[i].interface.opening[k] - opening[i]) / length);
  }
  const double dissipated = steps.back().energy.interface_dissipation / (edge * edge * bond.toughness);
  report_row(fmt::format("neo-Hookean bar, {}", GetParam().name),
             {{"traction", of_force}, {"opening", of_opening}, {"dissipated", dissipated}});
  EXPECT_LT(of_force, 1e-10);
  EXPECT_LT(of_opening, 1e-10);
  EXPECT_NEAR(dissipated, history.dissipated / bond.toughness, 1e-10);
}

INSTANTIATE_TEST_SUITE_P(Laws, FiniteBlocks, testing::ValuesIn(traction_separation_laws()),
                         [](const auto& test) { return std::string(test.param.name); });

class FiniteModes : public testing::TestWithParam<std::string_view> {};

// The whole surface is moved and the other half sheared and opened; then both halves are turned together, by 90 degrees
// about an oblique axis in three steps.
TEST_P(FiniteModes, TurnWithAnOpenedInterface) {
  InterfaceLaw law = law_of(linear_law(), GetParam());
  law.exponent = law.depends_on_mode() ? 1.8 : 1.0;
  law.shear_ratio = GetParam() == "equal_stiffness" ? 0.6 : 1.0;
  const Mesh mesh = two_blocks(2);
  FractureModel model = bonded_blocks(mesh, law, rubber);
  const Vector apart = bond.toughness / bond.strength * Vector(0.5, 0.3, 0.1) + edge * Vector(0.2, 0.3, 0.0);
  const Vector axis = Vector(1.0, 2.0, -1.0).normalized();
  const auto turn = [&](double t) -> Tensor {
    return Eigen::AngleAxisd(std::max(0.0, t - 2.0) * M_PI / 6.0, axis).toRotationMatrix();
  };
  model.boundary = {
      moved("xmin", {true, true, true}, [&](const Vector& x, double t) -> Vector { return turn(t) * x - x; }),
      moved("xmax", {true, true, true},
            [&](const Vector& x, double t) -> Vector { return turn(t) * (x + std::min(0.5 * t, 1.0) * apart) - x; })};
  const std::vector<Step> steps = step_through(mesh, model, 5, 1e-13);
  const Step &drawn = steps[2], &turned = steps[5];
  const Tensor R = turn(5.0);
  const double stored = drawn.energy.elastic + drawn.energy.interface_energy;
  double of_traction = 0.0, of_separation = 0.0, most = 0.0;
  for (Index k = 0; k < drawn.interface.opening.size(); ++k) {
    of_traction = std::max(of_traction, (turned.interface.traction[k] - R * drawn.interface.traction[k]).norm());
    of_separation =
        std::max(of_separation, (turned.interface.separation[k] - R * drawn.interface.separation[k]).norm());
    most = std::max(most, drawn.interface.opening[k]);
  }
  const double energy = std::abs((turned.energy.elastic + turned.energy.interface_energy) / stored - 1.0);
  const double dissipated = std::abs(turned.energy.interface_dissipation / drawn.energy.interface_dissipation - 1.0);
  const double force = (turned.force - R * drawn.force).norm() / drawn.force.norm();
  report_row(fmt::format("turned, {}", GetParam()),
             {{"energy", energy},
              {"dissipated", dissipated},
              {"force", force},
              {"traction", of_traction / bond.strength},
              {"opening / (Gc/strength)", most * bond.strength / bond.toughness}});
  EXPECT_GT(most, 0.2 * bond.toughness / bond.strength);
  EXPECT_GT(drawn.energy.interface_dissipation, 0.05 * bond.toughness * edge * edge);
  EXPECT_LT(energy, 1e-9);
  EXPECT_LT(dissipated, 1e-9);
  EXPECT_LT(force, 1e-9);
  EXPECT_LT(of_traction, 1e-9 * bond.strength);
  EXPECT_LT(of_separation, 1e-9 * bond.toughness / bond.strength);
}

INSTANTIATE_TEST_SUITE_P(All, FiniteModes,
                         testing::Values("camacho_ortiz", "equal_stiffness", "benzeggagh_kenane", "power_law"),
                         [](const auto& test) { return std::string(test.param); });

double norm(const std::vector<Vector>& v) {
  double sum = 0.0;
  for (const Vector& x : v) sum += x.squaredNorm();
  return std::sqrt(sum);
}

// Forces of the faces at displacements u + e v, against those of the springs linearised about u: the difference is of
// second order in e. Modes mixed, some faces closed.
class FiniteSprings : public testing::TestWithParam<double> {};

TEST_P(FiniteSprings, AreTheDerivative) {
  InterfaceLaw law = law_of(linear_law(), "benzeggagh_kenane");
  law.exponent = 1.8;
  const Mesh mesh = two_blocks(2);
  FractureModel model = bonded_blocks(mesh, law, from_young_poisson(2e6, GetParam()));
  model.boundary = {displacement_on("xmin", [](const Vector&) -> Vector { return Vector::Zero(); })};
  const Unknowns unknowns = place_unknowns(mesh, elastic_body(model));
  const CellStiffness cells(mesh, model);
  const CohesiveFaces faces(mesh, model, unknowns);
  MomentumSolver momentum(mesh, unknowns);
  const std::vector<InterfaceHistory> virgin = faces.virgin_histories();
  FractureRun run(mesh, model, {}, {});
  FractureState state = run.initial_state();
  Noise noise;
  std::vector<Vector> u(state.displacement.size()), direction(u.size());
  for (std::vector<Vector>* v : {&u, &direction})
    for (std::size_t i = 0; i < u.size(); ++i)
      (*v)[i] = i < as_size(unknowns.n_nodes()) ? Vector(0.1 * edge * noise.vector())
                                                : Vector(1e6 * noise.next() * Vector::UnitX());
  const auto rest = [&] {
    std::vector<Vector> forces = momentum.unbalanced_forces(0.0, state.displacement);
    momentum.balance().add_spring_offsets(forces);
    return forces;
  };
  const auto linearise = [&] {
    cells.set(state, momentum);
    faces.linearise(state.displacement, virgin, CohesiveFaces::Way::tangent, momentum);
  };
  state.displacement = u;
  linearise();
  const std::vector<Vector> start = rest();
  std::vector<double> error;
  for (const double e : {1e-3, 1e-4}) {
    state.displacement = u;
    linearise();
    for (std::size_t i = 0; i < u.size(); ++i) state.displacement[i] += e * direction[i];
    const std::vector<Vector> linear = rest();
    linearise();
    std::vector<Vector> exact = rest(), change = linear;
    for (std::size_t i = 0; i < u.size(); ++i) exact[i] -= linear[i], change[i] -= start[i];
    error.push_back(norm(exact) / norm(change));
  }
  report_row(fmt::format("springs against differences, nu {}", GetParam()),
             {{"error", error[0]}, {"of a tenth", error[1]}});
  EXPECT_LE(error[1], 0.12 * error[0]);
  EXPECT_LE(error[1], 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Nu, FiniteSprings, testing::Values(0.3, 0.4999), [](const auto& test) {
  return std::string(test.param > 0.4 ? "with_pressures" : "compressible");
});

constexpr InterfaceStrength weak{.strength = 0.2, .toughness = 8e-8, .stiffness = 1e8};

FractureModel weakly_bonded_sphere(const Mesh& mesh, double pull) {
  FractureModel model =
      elastic_model({}, {displacement_on("zmin", [](const Vector&) -> Vector { return Vector::Zero(); }),
                         moved("zmax", {false, false, true},
                               [pull](const Vector&, double t) -> Vector { return pull * t * Vector::UnitZ(); })});
  for (const std::string& name : mesh.region_names)
    model.regions.push_back(
        {.elasticity = name == "bead" ? from_young_poisson(2e9, 0.3) : from_young_poisson(2e6, 0.48),
         .damageable = false});
  glue(model, mesh, law_of(linear_law()), weak, Vector::UnitZ(), [](const Vector&) { return false; });
  CohesiveSurface& surface = model.interfaces[0];
  const Index bead = mesh.region_index("bead");
  for (Index f = 0; f < mesh.n_interior_faces(); ++f) {
    if ((mesh.region[mesh.owner[f]] == bead) == (mesh.region[mesh.neighbour[f]] == bead)) continue;
    surface.faces.push_back(f);
    surface.sign.push_back(1.0);
    surface.at.push_back(weak);
  }
  return model;
}

struct End {
  StepReport report;
  OutputInterface interface;
};

End end_of(const Mesh& mesh, const FractureModel& model) {
  FractureRun run(mesh, model, {.equilibrium_tolerance = 1e-9},
                  {.initial_increment = 0.2, .maximum_increment = 0.2, .stops = {}});
  End end;
  const FractureState last =
      run_to_end(run, [&](const FractureState&, const StepReport& report) { end.report = report; });
  end.interface = run.output(last).interfaces[0];
  return end;
}

// A stiff sphere in rubber that is drawn until its poles soften (without a jump), at a nominal strain of 1e-7: with and
// without finite strain.
TEST(FiniteFaces, AreThoseOfSmallStrainWhereItIsSmall) {
  constexpr double strain = 1e-7, half_width = 2.0;
  const Mesh mesh = sphere_in_cube(2, 2, half_width, 0.5);
  FractureModel model = weakly_bonded_sphere(mesh, 2.0 * half_width * strain);
  const End small = end_of(mesh, model);
  make_finite(model);
  const End large = end_of(mesh, model);
  const std::size_t top = mesh.patch_index("zmax");
  const double force = large.report.reaction[top].z() / small.report.reaction[top].z() - 1.0;
  const double dissipated = large.report.energy.interface_dissipation / small.report.energy.interface_dissipation - 1.0;
  double wrong = 0.0, most = 0.0;
  for (Index k = 0; k < small.interface.opening.size(); ++k) {
    wrong = std::max(wrong, (large.interface.separation[k] - small.interface.separation[k]).norm());
    most = std::max(most, small.interface.separation[k].norm());
  }
  report_row("sphere at small strain", {{"force", force},
                                        {"dissipated", dissipated},
                                        {"separation", wrong / most},
                                        {"largest / (Gc/strength)", most * weak.strength / weak.toughness}});
  EXPECT_GT(small.report.energy.interface_dissipation, 0.0);
  EXPECT_NEAR(force, 0.0, 1e-6);
  EXPECT_NEAR(dissipated, 0.0, 1e-6);
  EXPECT_LT(wrong, 1e-6 * most);
}

// A bar between sliding sides whose end moves by `drawn` [m].
std::vector<BoundaryCondition> drawn_out(double drawn) {
  std::vector<BoundaryCondition> boundary{
      moved("xmin", {true, false, false}, [](const Vector&, double) -> Vector { return Vector::Zero(); }),
      moved("xmax", {true, false, false},
            [drawn](const Vector&, double t) -> Vector { return drawn * t * Vector::UnitX(); })};
  for (const char* side : {"ymin", "ymax", "zmin", "zmax"}) boundary.push_back(symmetry_on(side));
  return boundary;
}

LoadingSettings in_thirds(double energy_release) {
  return {.initial_increment = 1.0 / 3.0,
          .maximum_increment = 1.0 / 3.0,
          .energy_release = energy_release,
          .finest_increment = 1e-2,
          .stops = {}};
}

// Steps of the sliding bar of above, drawn to a stretch of 1.9 and pressed to 0.55, with a limit on what is released.
// Its energy does not grow with the load squared; only a bond that gives way cuts the steps.
class FiniteReleases : public testing::TestWithParam<double> {};

TEST_P(FiniteReleases, AreOfBondsThatGiveWay) {
  const Mesh mesh = two_blocks(2);
  InterfaceStrength at = bond;
  for (const double held : {100.0, 1.0}) {
    at.strength = held * bond.strength, at.toughness = held * bond.toughness;
    FractureModel model = elastic_model(std::vector(mesh.region_names.size(), rubber), {});
    glue(model, mesh, law_of(linear_law()), at, Vector::UnitX(),
         [](const Vector& x) { return std::abs(x.x() - edge) < 1e-9; });
    make_finite(model);
    const double drawn = 2.0 * edge * GetParam();
    model.boundary = drawn_out(drawn);
    FractureRun run(mesh, model, {}, in_thirds(0.02));
    double dissipated = 0.0, largest = 0.0;
    StepReport last;
    run_to_end(run, [&](const FractureState&, const StepReport& report) {
      if (report.energy.interface_dissipation > dissipated + 1e-12) largest = std::max(largest, report.increment);
      dissipated = report.energy.interface_dissipation;
      last = report;
    });
    report_row(fmt::format("stretch {}, bond times {}", 1.0 + GetParam(), held),
               {{"steps", double(last.step)}, {"largest that dissipates", largest}, {"dissipated", dissipated}});
    const bool gives_way = held == 1.0 && GetParam() > 0.0;
    EXPECT_EQ(dissipated > 1e-12, gives_way);
    if (!gives_way)
      EXPECT_EQ(last.step, 3);
    else
      EXPECT_LT(largest, 0.1);
  }
}

INSTANTIATE_TEST_SUITE_P(Drawn, FiniteReleases, testing::Values(0.9, -0.45),
                         [](const auto& test) { return std::string(test.param > 0.0 ? "out" : "together"); });

// The bond is half of the section, gives way at a stretch between 1.1 and 1.2, and takes a hundredth of what is stored:
// what it releases besides, most of it into nothing, has to cut the steps.
TEST(FiniteFaces, ABondThatSnapsBesideABodyThatStaysStretchedCutsTheSteps) {
  const Mesh mesh = two_blocks(2);
  InterfaceStrength at = bond;
  at.strength = 4e5, at.toughness = 1.0, at.stiffness = 2e12;
  FractureModel model = elastic_model(std::vector(mesh.region_names.size(), rubber), {});
  glue(model, mesh, law_of(linear_law()), at, Vector::UnitX(),
       [](const Vector& x) { return std::abs(x.x() - edge) < 1e-9 && x.y() < 0.5 * edge; });
  make_finite(model);
  const double drawn = 0.3 * 2.0 * edge;
  model.boundary = drawn_out(drawn);
  FractureRun run(mesh, model, {}, in_thirds(0.03));
  double largest = 0.0, released = 0.0, torn = 0.0;
  StepReport before;
  run_to_end(run, [&](const FractureState&, const StepReport& report) {
    if (report.energy.interface_dissipation > before.energy.interface_dissipation + 1e-12) {
      largest = std::max(largest, report.increment);
      released = std::max(released, 1.0 - report.energy.elastic / before.energy.elastic);
      torn = std::max(torn, report.energy.interface_dissipation / before.energy.elastic);
    }
    before = report;
  });
  report_row("half a bond", {{"steps", double(before.step)},
                             {"largest that dissipates", largest},
                             {"share released", released},
                             {"share torn", torn}});
  EXPECT_LT(torn, 0.03);
  EXPECT_LE(largest, 1.01e-2);
}

// A run goes on from a state with open faces as the one that came there.
TEST(FiniteFaces, GoOnFromAState) {
  const Mesh mesh = two_blocks(2);
  FractureModel model = bonded_blocks(mesh, law_of(linear_law()), rubber);
  model.boundary = {displacement_on("xmin", [](const Vector&) -> Vector { return Vector::Zero(); }),
                    moved("xmax", {true, true, true},
                          [](const Vector&, double t) -> Vector { return edge * t * Vector(0.6, 0.4, 0.1); })};
  const LoadingSettings loading{
      .end = 4.0, .initial_increment = 1.0, .minimum_increment = 1.0, .maximum_increment = 1.0, .stops = {}};
  FractureRun run(mesh, model, {}, loading);
  FractureState midway;
  StepReport last;
  const FractureState end = run_to_end(run, [&](const FractureState& state, const StepReport& report) {
    if (state.step == 2) midway = state;
    last = report;
  });
  FractureRun other(mesh, model, {}, loading);
  const FractureState again = advance_to_end(other, midway, [](const FractureState&, const StepReport&) {});
  EXPECT_GT(last.energy.interface_dissipation, 0.0);
  EXPECT_EQ(again.displacement, end.displacement);
  EXPECT_EQ(again.interfaces, end.interfaces);
}

}  // namespace
}  // namespace pfdm::verification::this_file
