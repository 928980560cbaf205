// The momentum balance with each of its linear solvers: the same solutions; which one is chosen; when it is rebuilt.

#include "solver/momentum/solution/preconditioner.h"

#include <algorithm>
#include <cmath>

#include "mesh/dual.h"
#include "physics/error.h"
#include "solver/momentum/solution/momentum_solver.h"
#include "tests/solver/solver_checks.h"

namespace pfdm::this_file {
namespace {

BoundaryCondition pulled(const std::string& patch) {
  BoundaryCondition condition = clamped(patch);
  condition.value = [](const Vector&, double t) -> Vector { return t * Vector(0.01, 0.002, 0.02); };
  return condition;
}

struct Body {
  Body(Mesh of, double poisson_ratio, std::vector<BoundaryCondition> boundary) : mesh(std::move(of)) {
    for (std::size_t k = 0; k < mesh.region_names.size(); ++k)
      model.regions.push_back({.elasticity = from_young_poisson(75e6, poisson_ratio)});
    model.boundary = std::move(boundary);
    unknowns = place_unknowns(mesh, elastic_body(model));
    g = CellField<double>(mesh.n_cells(), 1.0);
  }

  CellField<IsotropicElasticity> moduli() const {
    CellField<IsotropicElasticity> result(mesh.n_cells());
    const IsotropicElasticity& whole = model.regions.front().elasticity;
    for (Index c = 0; c < mesh.n_cells(); ++c) result[c] = {.lambda = g[c] * whole.lambda, .mu = g[c] * whole.mu};
    return result;
  }

  // A crack around the middle, from side to side.
  void break_cells(double to) {
    for (Index c = 0; c < mesh.n_cells(); ++c) {
      const Vector& x = mesh.cell_centre[c];
      if (std::abs(x[2] - 1.5) < 0.3 && x.head<2>().norm() > 1.0) g[c] = to;
    }
  }

  Mesh mesh;
  FractureModel model;
  Unknowns unknowns;
  CellField<double> g;
};

struct Solved {
  std::vector<Vector> u;
  Equilibrium equilibrium;
};

Solved solve(const Body& body, std::string_view linear, double residual) {
  MomentumSolver solver(body.mesh, body.unknowns, &linear_solver(linear));
  solver.set_moduli(body.moduli(), body.g);
  Solved solved;
  solved.u.assign(body.unknowns.n_unknowns(), Vector::Zero());
  solved.equilibrium = solver.solve(1.0, {.reduction = 0.0, .ceiling = residual, .floor = residual}, solved.u);
  EXPECT_TRUE(solved.equilibrium.converged) << linear << ": " << solved.equilibrium.residual;
  return solved;
}

// Largest difference of a cell's displacement, over the largest displacement.
double difference(const Body& body, const Solved& a, const Solved& b) {
  double most = 0.0, size = 0.0;
  for (Index c = 0; c < body.mesh.n_cells(); ++c) {
    most = std::max(most, (a.u[c] - b.u[c]).norm());
    size = std::max(size, a.u[c].norm());
  }
  return most / size;
}

void expect_same(const Body& body, double tolerance, double residual = 1e-11) {
  EXPECT_LE(difference(body, solve(body, "multigrid", residual), solve(body, "direct", residual)), tolerance);
}

Mesh polyhedra() { return barycentric_dual(tetrahedra_and_prisms()); }
std::vector<BoundaryCondition> stretched() { return {clamped("zmin"), pulled("zmax")}; }

using LinearSolvers = WithThreads;

TEST_F(LinearSolvers, AgreeOnTetrahedraAndPrisms) { expect_same({tetrahedra_and_prisms(), 0.44, stretched()}, 1e-9); }

TEST_F(LinearSolvers, AgreeOnPolyhedra) { expect_same({polyhedra(), 0.3, stretched()}, 1e-9); }

TEST_F(LinearSolvers, AgreeWithBrokenCells) {
  for (Mesh& mesh : std::vector<Mesh>{tetrahedra_and_prisms(), polyhedra()}) {
    Body body(std::move(mesh), 0.3, stretched());
    body.break_cells(1e-6);
    expect_same(body, 1e-5, 1e-9);
  }
}

TEST_F(LinearSolvers, AgreeWithPressures) {
  for (Mesh& mesh : std::vector<Mesh>{tetrahedra_and_prisms(), polyhedra()}) {
    const Body body(std::move(mesh), 0.4999, stretched());
    ASSERT_FALSE(body.unknowns.pressure_cells.empty());
    expect_same(body, 1e-8);
  }
}

TEST_F(LinearSolvers, AgreeOnPlates) {
  using Kind = BoundaryCondition::Kind;
  const Mesh plate = box(20, 12, 1, {2.0, 1.0, 0.1});
  for (const Kind kind : {Kind::plane, Kind::plane_stress}) {
    Body body(plate, 0.3, {of_kind("zmin", kind), of_kind("zmax", kind), clamped("xmin"), pulled("xmax")});
    for (Index c = 0; c < 240; c += 20) body.g[c + 9] = 1e-6;
    expect_same(body, 1e-8);
  }
  expect_same({plate, 0.3, {clamped("xmin"), pulled("xmax")}}, 1e-6);  // it bends easily
}

TEST_F(LinearSolvers, DirectSolutionIsBitwiseTheSameForAnyNumberOfThreads) {
  const Body body(polyhedra(), 0.3, stretched());
  std::vector<std::vector<Vector>> answers;
  for (const int threads : {1, 2, 3}) {
    set_threads(threads);
    answers.push_back(solve(body, "direct", 1e-9).u);
  }
  EXPECT_EQ(answers[1], answers[0]);
  EXPECT_EQ(answers[2], answers[0]);
}

TEST_F(LinearSolvers, FactorsAreKeptUntilTheStiffnessHasChanged) {
  Body body(box(20, 12, 1, {2.0, 1.0, 0.1}), 0.3, {clamped("xmin"), pulled("xmax")});
  MomentumSolver solver(body.mesh, body.unknowns, &linear_solver("direct"));
  const auto factors_at = [&](double g) {
    body.g[100] = g;
    solver.set_moduli(body.moduli(), body.g);
    Solved solved{.u = std::vector<Vector>(body.unknowns.n_unknowns(), Vector::Zero()), .equilibrium = {}};
    solved.equilibrium = solver.solve(1.0, {.ceiling = 1e-11, .floor = 1e-11}, solved.u);
    EXPECT_LE(difference(body, solve(body, "direct", 1e-11), solved), 1e-6);
    return solver.n_preconditioners();
  };
  EXPECT_EQ(factors_at(1.0), 1);
  EXPECT_EQ(factors_at(1.0), 1);
  EXPECT_EQ(factors_at(0.6), 1) << "less than half of it is gone";
  EXPECT_EQ(factors_at(0.1), 2);
  solver.start_afresh();
  EXPECT_EQ(factors_at(0.1), 2) << "the same stiffness";
}

TEST_F(LinearSolvers, SingularStiffnessIsNamedWithItsPlace) {
  Body body(box(4, 4, 1), 0.3, {clamped("xmin"), pulled("xmax")});
  for (Index c = 0; c < body.mesh.n_cells(); ++c)
    if (body.mesh.cell_centre[c].isApprox(Vector(0.375, 0.375, 0.5))) body.g[c] = 0.0;
  MomentumSolver solver(body.mesh, body.unknowns, &linear_solver("direct"));
  try {
    solver.set_moduli(body.moduli(), body.g);
    FAIL() << "no error";
  } catch (const ComputationError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("the stiffness of the body is singular at (0.375, 0.375, 0.5) m"));
  }
}

TEST_F(LinearSolvers, MeshesOneCellThickAreSolvedDirectly) {
  EXPECT_TRUE(prefers_direct(box(20, 12, 1)));
  EXPECT_TRUE(prefers_direct(box(1, 1, 30)));
  EXPECT_FALSE(prefers_direct(box(20, 12, 2)));
  EXPECT_FALSE(prefers_direct(tetrahedra_and_prisms()));
  EXPECT_FALSE(prefers_direct(box(250, 200, 1))) << "too many cells";
  EXPECT_THROW(linear_solver("gauss"), InputError);
}

}  // namespace
}  // namespace pfdm::this_file
