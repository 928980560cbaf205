// The derivatives of the momentum balance by the stiffness of the cells; Newton's method on displacement and damage.

#include "solver/fracture/equilibrium/coupled_newton.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "physics/damage/crack_geometry.h"
#include "solver/fracture/fracture_run.h"
#include "solver/momentum/stiffness_coupling.h"
#include "tests/solver/solver_checks.h"

namespace pfdm::this_file {
namespace {

using Kind = BoundaryCondition::Kind;

struct Body {
  explicit Body(Mesh of, std::vector<BoundaryCondition> boundary = {clamped("zmin")}) : mesh(std::move(of)) {
    for (std::size_t k = 0; k < mesh.region_names.size(); ++k)
      model.regions.push_back({.elasticity = from_young_poisson(75e6 * (1.0 + 3.0 * static_cast<double>(k)), 0.35)});
    model.boundary = std::move(boundary);
    unknowns = place_unknowns(mesh, elastic_body(model));
  }

  CellField<IsotropicElasticity> moduli(const CellField<double>& g) const {
    CellField<IsotropicElasticity> result(mesh.n_cells());
    for (Index c = 0; c < mesh.n_cells(); ++c) {
      const IsotropicElasticity& whole = model.in_cell(mesh, c).elasticity;
      result[c] = {.lambda = g[c] * whole.lambda, .mu = g[c] * whole.mu};
    }
    return result;
  }

  Mesh mesh;
  FractureModel model;
  Unknowns unknowns;
};

double norm(const std::vector<Vector>& v) {
  double sum = 0.0;
  for (const Vector& x : v) sum += x.squaredNorm();
  return std::sqrt(sum);
}

// A u with the weights of the gradients of `weights`.
std::vector<Vector> forces(const Body& body, const CellField<double>& g, const CellField<double>& weights,
                           const std::vector<Vector>& u) {
  MomentumOperator balance(body.mesh, body.unknowns);
  balance.set_moduli(body.moduli(g), weights);
  std::vector<Vector> out(u.size());
  balance.apply(u, out);
  return out;
}

// Against central differences; g from 0.01 to 1 at random, so that neighbours differ by up to 100.
void expect_derivative(const Body& body) {
  const Index n = body.mesh.n_cells();
  RandomNumbers random;
  const CellField<double> g = random.field(n, 0.01, 1.0), dg = random.field(n, -1.0, 1.0);
  std::vector<Vector> u(body.unknowns.n_unknowns());
  for (Vector& x : u) x = 1e-3 * random.vector();
  MomentumOperator balance(body.mesh, body.unknowns);
  balance.keep_in_plane(u);
  balance.set_moduli(body.moduli(g), g);
  const CellField<double> one(n, 1.0);
  const StiffnessCoupling coupling(balance, body.moduli(one), u);
  std::vector<Vector> derivative(u.size());
  coupling.apply(dg, derivative);

  constexpr double step = 1e-5;
  CellField<double> more = g, less = g;
  for (Index c = 0; c < n; ++c) more[c] += step * dg[c], less[c] -= step * dg[c];
  std::vector<Vector> difference = forces(body, more, g, u);
  const std::vector<Vector> below = forces(body, less, g, u);
  for (std::size_t i = 0; i < u.size(); ++i) difference[i] = (difference[i] - below[i]) / (2.0 * step);
  const double size = norm(difference);
  for (std::size_t i = 0; i < u.size(); ++i) difference[i] -= derivative[i];
  EXPECT_GT(size, 0.0);
  EXPECT_LE(norm(difference), 1e-5 * size);
}

TEST(StiffnessCoupling, IsTheDerivativeOfTheForcesByTheStiffness) {
  expect_derivative(Body(tetrahedra_and_prisms(2, 3)));
  expect_derivative(Body(box(4, 3, 5)));
}

TEST(StiffnessCoupling, IsTheDerivativeInPlaneStrainAndPlaneStress) {
  for (const Kind kind : {Kind::plane, Kind::plane_stress})
    expect_derivative(Body(box(6, 5, 1), {clamped("xmin"), of_kind("zmin", kind), of_kind("zmax", kind)}));
}

// The energies' derivative by the displacement is the forces' by the stiffness, transposed. On orthogonal cells and for
// displacements u, v that are linear the discrete forms are symmetric.
TEST(StiffnessCoupling, IsSymmetric) {
  const Body body(box(4, 3, 5));
  const Index n = body.mesh.n_cells();
  RandomNumbers random;
  const Tensor G = 1e-3 * random.tensor(), H = random.tensor();
  std::vector<Vector> u(body.unknowns.n_unknowns()), v(u.size());
  const auto place = [&](std::size_t i) -> Vector {
    return i < as_size(n) ? body.mesh.cell_centre[i] : body.mesh.face_centre[body.unknowns.face_of_node[i - n]];
  };
  for (std::size_t i = 0; i < u.size(); ++i) u[i] = G * place(i), v[i] = H * place(i);
  MomentumOperator balance(body.mesh, body.unknowns);
  const CellField<double> one(n, 1.0), none(n, 0.0), dg = random.field(n, -1.0, 1.0);
  balance.set_moduli(body.moduli(one), one);
  StiffnessCoupling coupling(balance, body.moduli(one), u);
  CellField<double> energy(n);
  std::vector<Vector> force(u.size());
  coupling.apply(v, none, force, energy);
  // V sigma(G) : H of each cell, in closed form.
  for (Index c = 0; c < n; ++c) {
    const Tensor sigma = stress(body.model.in_cell(body.mesh, c).elasticity, symmetric_part(G));
    EXPECT_NEAR(energy[c], body.mesh.cell_volume[c] * contract(sigma, H), 1e-9 * std::abs(energy[c]) + 1e-9) << c;
  }
}

// A strip in plane strain, pulled apart; damage grows around a weak spot at its side, without a jump.
struct Strip {
  Strip()
      : mesh(box(24, 24, 1, {1e-3, 1e-3, 1e-3 / 24.0}, 1.0, {{"weak", {-1.0, 0.4e-3, -1.0}, {0.3e-3, 0.6e-3, 1.0}}})) {
    for (const std::string& name : mesh.region_names)
      model.regions.push_back(
          {.elasticity = from_young_poisson(210e9, 0.2), .Gc = name == "weak" ? 1500.0 : 2700.0, .ell = 1e-4});
    model.crack = &crack_geometry("AT2");
    model.degradation = degradation("quadratic");
    BoundaryCondition top = held_along("ymax", 1);
    top.value = [](const Vector&, double t) -> Vector { return Vector(0.0, 9e-6 * t, 0.0); };
    model.boundary = {held_along("xmin", 0), held_along("ymin", 1), top, of_kind("zmin", Kind::plane),
                      of_kind("zmax", Kind::plane)};
  }

  // Iterations of each step.
  std::vector<Index> run(const std::string& split, Index n_steps, FractureState& state) {
    model.split = energy_split(split);
    FractureRun run(mesh, model, {.damage_tolerance = 1e-8, .energy_tolerance = 1e-8, .equilibrium_tolerance = 1e-9},
                    {.end = 1.0, .initial_increment = 0.1, .maximum_increment = 0.1, .stops = {}});
    state = run.initial_state();
    std::vector<Index> iterations;
    iterations.reserve(n_steps);
    for (Index k = 0; k < n_steps; ++k) iterations.push_back(run.step(state).staggered_iterations);
    return iterations;
  }

  Mesh mesh;
  FractureModel model;
};

// A strip pulled apart, its damage far from a jump. It is open everywhere, so that the volumetric-deviatoric split,
// with which the alternation works alone, has the same solution.
TEST(CoupledNewton, ConvergesInAFewIterationsToTheSolutionOfTheAlternation) {
  Strip strip;
  constexpr Index n_steps = 5;
  FractureState state, alternated;
  const std::vector<Index> iterations = strip.run("none", n_steps, state);
  const std::vector<Index> alone = strip.run("volumetric_deviatoric", n_steps, alternated);
  for (const Index n : iterations) EXPECT_LE(n, 7);
  EXPECT_GT(alone.back(), 2 * iterations.back());
  const double most = *std::max_element(state.damage.begin(), state.damage.end());
  EXPECT_GT(most, 0.1);
  EXPECT_LT(most, 0.9);
  for (Index c = 0; c < strip.mesh.n_cells(); ++c) EXPECT_NEAR(state.damage[c], alternated.damage[c], 1e-6) << c;
  EXPECT_NEAR(state.energy.elastic + state.energy.fracture, alternated.energy.elastic + alternated.energy.fracture,
              1e-7 * state.energy.elastic);
}

}  // namespace
}  // namespace pfdm::this_file
