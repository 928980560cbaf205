#include "tests/verification/support.h"

#include <cmath>
#include <ctime>

namespace pfdm::verification {

BoundaryCondition displacement_on(const std::string& patch, DisplacementField u) {
  return {.patch = patch,
          .kind = BoundaryCondition::Kind::components,
          .displacement_prescribed = {true, true, true},
          .value = [u = std::move(u)](const Vector& x, double) { return u(x); }};
}

BoundaryCondition traction_on(const std::string& patch, std::function<Vector(const Vector&)> traction) {
  return {.patch = patch,
          .kind = BoundaryCondition::Kind::components,
          .displacement_prescribed = {false, false, false},
          .value = [t = std::move(traction)](const Vector& x, double) { return t(x); }};
}

BoundaryCondition symmetry_on(const std::string& patch) {
  return {.patch = patch, .kind = BoundaryCondition::Kind::symmetry, .value = {}};
}

BoundaryCondition plane_on(const std::string& patch) {
  return {.patch = patch, .kind = BoundaryCondition::Kind::plane, .value = {}};
}

std::vector<BoundaryCondition> displacement_on_all(const Mesh& mesh, const DisplacementField& u) {
  std::vector<BoundaryCondition> all;
  for (const Patch& patch : mesh.patches) all.push_back(displacement_on(patch.name, u));
  return all;
}

FractureModel elastic_model(std::vector<IsotropicElasticity> by_region, std::vector<BoundaryCondition> boundary) {
  FractureModel model;
  for (const IsotropicElasticity& c : by_region) model.regions.push_back({.elasticity = c, .damageable = false});
  model.crack = &crack_geometry("AT2");
  model.degradation = &degradation("quadratic");
  model.split = &energy_split("none");
  model.boundary = std::move(boundary);
  return model;
}

std::unique_ptr<ElasticSolution> solve_elastic(const Mesh& mesh, const FractureModel& model, const CellField<double>& g,
                                               double residual) {
  auto solution = std::make_unique<ElasticSolution>();
  const std::clock_t start = std::clock();
  solution->unknowns = place_unknowns(mesh, model);
  solution->solver = std::make_unique<MomentumSolver>(mesh, solution->unknowns);
  CellField<IsotropicElasticity> moduli(as_size(mesh.n_cells()));
  CellField<double> factors = g.size() > 0 ? g : CellField<double>(as_size(mesh.n_cells()), 1.0);
  for (Index c = 0; c < mesh.n_cells(); ++c)
    moduli[c] = model.split->secant(model.regions[as_size(mesh.region[c])].elasticity, factors[c], Tensor::Zero());
  solution->solver->set_moduli(moduli, factors);
  solution->u.assign(as_size(solution->unknowns.n_nodes()), Vector::Zero());
  solution->equilibrium =
      solution->solver->solve(1.0, {.reduction = 0.0, .ceiling = residual, .floor = residual}, solution->u);
  solution->cpu_seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
  solution->cells = solution->solver->balance().mechanics(solution->u);
  return solution;
}

double relative_error(const Mesh& mesh, const std::function<Vector(Index)>& value,
                      const std::function<Vector(Index)>& exact, const std::function<bool(Index)>& counts) {
  double error = 0.0, size = 0.0;
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    if (!counts(c)) continue;
    error += mesh.cell_volume[c] * (value(c) - exact(c)).squaredNorm();
    size += mesh.cell_volume[c] * exact(c).squaredNorm();
  }
  return std::sqrt(error / size);
}

double relative_stress_error(const Mesh& mesh, const CellField<Tensor>& stress,
                             const std::function<Tensor(const Vector&)>& exact,
                             const std::function<bool(Index)>& counts) {
  double error = 0.0, size = 0.0;
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    if (!counts(c)) continue;
    const Tensor truth = exact(mesh.cell_centre[c]);
    error += mesh.cell_volume[c] * (stress[c] - truth).squaredNorm();
    size += mesh.cell_volume[c] * truth.squaredNorm();
  }
  return std::sqrt(error / size);
}

Mesh sphere_in_cube(Index subdivision, Index n_layers, double half_width, double grading) {
  ParticlesInBoxSettings settings;
  settings.lower = Vector::Constant(-half_width);
  settings.upper = Vector::Constant(half_width);
  settings.grading = grading;
  Particle sphere;
  sphere.radius = 1.0;
  sphere.subdivision = subdivision;
  sphere.n_layers = n_layers;
  sphere.layer_thickness = n_layers > 0 ? 0.4 : 0.0;
  settings.particles = {sphere};
  return make_particles_in_box(settings);
}

}  // namespace pfdm::verification
