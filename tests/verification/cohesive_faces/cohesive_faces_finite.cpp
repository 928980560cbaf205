// Cohesive faces at finite strain: the linearised balance against differences, each law in a bar in series, an opened
// interface that is turned.

#include "physics/materials/hyperelastic.h"
#include "solver/fracture/cells/cell_stiffness.h"
#include "tests/verification/cohesive_blocks.h"
#include "tests/verification/cohesive_faces/finite_blocks.h"
#include "tests/verification/noise.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

namespace pfdm::verification::this_file {
namespace {

using namespace verification::finite_blocks;

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
  model.boundary = pulled_along(path);
  const std::vector<Step> steps = finite_steps(mesh, model, path.size() - 1);
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
  const std::vector<Step> steps = finite_steps(mesh, model, 5, 1e-13);
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
  const auto cells = make_cell_stiffness(mesh, model);
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
    return forces;
  };
  const auto linearise = [&] {
    cells->set(state, momentum);
    faces.linearise(state.displacement, virgin, virgin, CohesiveFaces::Way::tangent, momentum);
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

}  // namespace
}  // namespace pfdm::verification::this_file
