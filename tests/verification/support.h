#pragma once
// What the verification problems share: models of one law, elastic solutions to a tight residual, error norms.

#include "mesh/box_hexes.h"
#include "mesh/particles_in_box.h"
#include "solver/momentum_solver.h"

#include <memory>

namespace pfdm::verification {

using DisplacementField = std::function<Vector(const Vector&)>;

BoundaryCondition displacement_on(const std::string& patch, DisplacementField u);
BoundaryCondition traction_on(const std::string& patch, std::function<Vector(const Vector&)> traction);
BoundaryCondition symmetry_on(const std::string& patch);
BoundaryCondition plane_on(const std::string& patch);
std::vector<BoundaryCondition> displacement_on_all(const Mesh& mesh, const DisplacementField& u);

/// One elasticity per region, undamageable, no split.
FractureModel elastic_model(std::vector<IsotropicElasticity> by_region, std::vector<BoundaryCondition> boundary);

/// Equilibrium with the stiffness factors g (all 1 if empty), to a relative residual.
struct ElasticSolution {
  Unknowns unknowns;
  std::unique_ptr<MomentumSolver> solver;
  std::vector<Vector> u;
  CellMechanics cells;
  Equilibrium equilibrium;
  double cpu_seconds = 0.0;
};
std::unique_ptr<ElasticSolution> solve_elastic(const Mesh& mesh, const FractureModel& model,
                                               const CellField<double>& g = {}, double residual = 1e-10);

/// Volume-weighted L2 norm of the difference over that of the exact field; `counts` says which cells take part.
double relative_error(const Mesh& mesh, const std::function<Vector(Index)>& value,
                      const std::function<Vector(Index)>& exact, const std::function<bool(Index)>& counts);
double relative_stress_error(const Mesh& mesh, const CellField<Tensor>& stress,
                             const std::function<Tensor(const Vector&)>& exact,
                             const std::function<bool(Index)>& counts);

/// A cube of the given half-width with a sphere of radius 1 at the origin.
Mesh sphere_in_cube(Index subdivision, Index n_layers, double half_width, double grading);

}  // namespace pfdm::verification
