#pragma once
// What the verification problems share: models of one law, elastic solutions to a tight residual, error norms, and the
// printing of what was measured.

#include "mesh/dual.h"
#include "mesh/generators/box_hexes.h"
#include "mesh/generators/particles_in_box.h"
#include "solver/fracture/fracture_run.h"
#include "solver/momentum/solution/momentum_solver.h"

#include <array>
#include <functional>
#include <memory>
#include <utility>

namespace pfdm::verification {

using DisplacementField = std::function<Vector(const Vector&)>;
using StressField = std::function<Tensor(const Vector&)>;

BoundaryCondition displacement_on(const std::string& patch, DisplacementField u);
BoundaryCondition traction_on(const std::string& patch, std::function<Vector(const Vector&)> traction);
BoundaryCondition symmetry_on(const std::string& patch);
BoundaryCondition axisymmetric_on(const std::string& patch);
BoundaryCondition plane_on(const std::string& patch);
BoundaryCondition plane_stress_on(const std::string& patch);
/// These components of the displacement follow a function of the place and the load parameter.
BoundaryCondition moved(const std::string& patch, std::array<bool, 3> components,
                        std::function<Vector(const Vector&, double)> displacement);
std::vector<BoundaryCondition> displacement_on_all(const Mesh& mesh, const DisplacementField& u);

/// One elasticity per region, undamageable, no split.
FractureModel elastic_model(const std::vector<IsotropicElasticity>& by_region, std::vector<BoundaryCondition> boundary);

using StepSeen = std::function<void(const FractureState&, const StepReport&)>;
/// Steps to the end of the load; `seen` is called after each. run_to_end calls it for the start as well.
FractureState advance_to_end(FractureRun& run, FractureState state, const StepSeen& seen);
FractureState run_to_end(FractureRun& run, FractureState start, const StepSeen& seen);
FractureState run_to_end(FractureRun& run, const StepSeen& seen);

/// Equilibrium with the stiffness factors g (all 1 if empty) and a body force [N/m^3] (none if empty), to a relative
/// residual.
struct ElasticSolution {
  Unknowns unknowns;
  std::unique_ptr<MomentumSolver> solver;
  std::vector<Vector> u;
  CellMechanics cells;
  Equilibrium equilibrium;
  double cpu_seconds = 0.0;
};
std::unique_ptr<ElasticSolution> solve_elastic(const Mesh& mesh, const FractureModel& model,
                                               const CellField<double>& g = {}, double residual = 1e-10,
                                               const DisplacementField& body_force = {}, double closure = 0.0);

/// Mean displacement of each patch [m] at equilibrium of stresses that are functions of the strain, evenly damaged.
std::vector<Vector> displacements_by_laws(const Mesh& mesh, const FractureModel& model, double damage = 0.0);

/// Volume-weighted L2 norm of the difference over that of the exact field; `counts` says which cells take part.
double relative_error(const Mesh& mesh, const std::function<Vector(Index)>& value,
                      const std::function<Vector(Index)>& exact, const std::function<bool(Index)>& counts);
double relative_stress_error(const Mesh& mesh, const CellField<Tensor>& stress, const StressField& exact,
                             const std::function<bool(Index)>& counts);
/// The displacement's, over all cells.
double displacement_error(const Mesh& mesh, const ElasticSolution& solution, const DisplacementField& exact);

/// Force on each patch [N].
std::vector<Vector> reactions(const Mesh& mesh, const ElasticSolution& solution);
/// |sum of the patches' forces| over the largest of them.
double reaction_imbalance(const Mesh& mesh, const ElasticSolution& solution);
/// |sum of the cells' energies - half the work of the boundary forces| over the latter.
double energy_imbalance(const Mesh& mesh, const ElasticSolution& solution);

/// Observed order of convergence between two meshes of mean cell size (volume / cells)^(1/3).
double observed_order(double coarse_error, Index coarse_cells, double fine_error, Index fine_cells);

/// The mesh turned about the origin; its patches keep their names.
Mesh rotated(Mesh mesh, const Tensor& rotation);
/// Some rotation about no special axis.
Tensor arbitrary_rotation();

/// A unit square of n x n squares cut into triangles, its inner points moved about, extruded through the given levels
/// of z into layers of wedges of one region "body".
Mesh extruded_triangles(Index n, const std::vector<double>& levels);

/// A cube of the given half-width with a sphere of radius 1 at the origin; the layers take 0.4 together.
Mesh sphere_in_cube(Index subdivision, Index n_layers, double half_width, double grading);

/// Prints one row of measured values and records them as properties "label: name" of the running test.
void report_row(const std::string& label, const std::vector<std::pair<std::string, double>>& values);

}  // namespace pfdm::verification
