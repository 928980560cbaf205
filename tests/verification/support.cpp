#include "tests/verification/support.h"

#include "mesh/geometry.h"
#include "mesh/patch_rules.h"
#include "solver/fracture/equilibrium/law_newton.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <numeric>

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

BoundaryCondition plane_stress_on(const std::string& patch) {
  return {.patch = patch, .kind = BoundaryCondition::Kind::plane_stress, .value = {}};
}

BoundaryCondition axisymmetric_on(const std::string& patch) {
  return {.patch = patch, .kind = BoundaryCondition::Kind::axisymmetric, .value = {}};
}

BoundaryCondition plane_on(const std::string& patch) {
  return {.patch = patch, .kind = BoundaryCondition::Kind::plane, .value = {}};
}

BoundaryCondition moved(const std::string& patch, std::array<bool, 3> components,
                        std::function<Vector(const Vector&, double)> displacement) {
  return {.patch = patch,
          .kind = BoundaryCondition::Kind::components,
          .displacement_prescribed = components,
          .value = std::move(displacement)};
}

std::vector<BoundaryCondition> displacement_on_all(const Mesh& mesh, const DisplacementField& u) {
  std::vector<BoundaryCondition> all;
  for (const Patch& patch : mesh.patches) all.push_back(displacement_on(patch.name, u));
  return all;
}

FractureModel elastic_model(const std::vector<IsotropicElasticity>& by_region,
                            std::vector<BoundaryCondition> boundary) {
  FractureModel model;
  for (const IsotropicElasticity& c : by_region) model.regions.push_back({.elasticity = c, .damageable = false});
  model.crack = &crack_geometry("AT2");
  model.degradation = degradation("quadratic");
  model.split = energy_split("none");
  model.boundary = std::move(boundary);
  return model;
}

FractureState advance_to_end(FractureRun& run, FractureState state, const StepSeen& seen) {
  while (!run.is_complete(state)) {
    const StepReport report = run.step(state);
    seen(state, report);
  }
  return state;
}

FractureState run_to_end(FractureRun& run, FractureState start, const StepSeen& seen) {
  seen(start, run.report_of(start));
  return advance_to_end(run, std::move(start), seen);
}

FractureState run_to_end(FractureRun& run, const StepSeen& seen) { return run_to_end(run, run.initial_state(), seen); }

std::unique_ptr<ElasticSolution> solve_elastic(const Mesh& mesh, const FractureModel& model, const CellField<double>& g,
                                               double residual, const DisplacementField& body_force, double closure) {
  auto solution = std::make_unique<ElasticSolution>();
  const std::clock_t start = std::clock();
  solution->unknowns = place_unknowns(mesh, elastic_body(model));
  solution->solver = std::make_unique<MomentumSolver>(mesh, solution->unknowns);
  CellField<IsotropicElasticity> moduli(mesh.n_cells());
  const CellField<double> factors = g.size() > 0 ? g : CellField<double>(mesh.n_cells(), 1.0);
  std::vector<Vector> force_on_cells;
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    moduli[c] = model.split.secant(model.regions[mesh.region[c]].elasticity, factors[c], closure);
    if (body_force) force_on_cells.emplace_back(mesh.cell_volume[c] * body_force(mesh.cell_centre[c]));
  }
  solution->solver->set_moduli(moduli, factors);
  solution->solver->set_body_force(std::move(force_on_cells));
  solution->u.assign(solution->unknowns.n_unknowns(), Vector::Zero());
  solution->equilibrium =
      solution->solver->solve(1.0, {.reduction = 0.0, .ceiling = residual, .floor = residual}, solution->u);
  solution->cpu_seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
  solution->cells = solution->solver->balance().mechanics(solution->u);
  return solution;
}

std::vector<Vector> displacements_by_laws(const Mesh& mesh, const FractureModel& model, double damage) {
  const Unknowns unknowns = place_unknowns(mesh, elastic_body(model));
  MomentumSolver solver(mesh, unknowns);
  const auto stiffness = make_cell_stiffness(mesh, model);
  stiffness->start_step(0.0);
  FractureState state;
  state.step = 1;
  state.load = 1.0;
  state.damage = CellField<double>(mesh.n_cells(), damage);
  state.closure = CellField<double>(mesh.n_cells(), 0.0);
  state.displacement.assign(unknowns.n_unknowns(), Vector::Zero());
  stiffness->set(state, solver);
  EXPECT_TRUE(solve_with_laws(*stiffness, {.ceiling = 1e-9, .floor = 1e-9}, solver, state).converged);
  return solver.balance().patch_displacements(state.displacement);
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

double relative_stress_error(const Mesh& mesh, const CellField<Tensor>& stress, const StressField& exact,
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

double displacement_error(const Mesh& mesh, const ElasticSolution& solution, const DisplacementField& exact) {
  return relative_error(
      mesh, [&](Index c) { return solution.u[c]; }, [&](Index c) { return exact(mesh.cell_centre[c]); },
      [](Index) { return true; });
}

std::vector<Vector> reactions(const Mesh& mesh, const ElasticSolution& solution) {
  const std::vector<Vector> forces = solution.solver->balance().boundary_forces(solution.u);
  std::vector<Vector> sums;
  for (const Patch& patch : mesh.patches) {
    const auto first = forces.begin() + (patch.first_face - mesh.n_interior_faces());
    sums.push_back(std::accumulate(first, first + patch.n_faces, Vector(Vector::Zero())));
  }
  return sums;
}

double reaction_imbalance(const Mesh& mesh, const ElasticSolution& solution) {
  Vector sum = Vector::Zero();
  double largest = 0.0;
  for (const Vector& force : reactions(mesh, solution)) {
    sum += force;
    largest = std::max(largest, force.norm());
  }
  return sum.norm() / largest;
}

double energy_imbalance(const Mesh& mesh, const ElasticSolution& solution) {
  const std::vector<Vector> forces = solution.solver->balance().boundary_forces(solution.u);
  double half_work = 0.0;
  for (std::size_t k = 0; k < forces.size(); ++k) {
    const Index node = solution.unknowns.node_of_face[mesh.n_interior_faces() + static_cast<Index>(k)];
    if (node >= 0) half_work += 0.5 * forces[k].dot(solution.u[node]);
  }
  const auto& energy = solution.cells.energy;
  return std::abs(std::accumulate(energy.begin(), energy.end(), 0.0) - half_work) / half_work;
}

double observed_order(double coarse_error, Index coarse_cells, double fine_error, Index fine_cells) {
  return 3.0 * std::log(coarse_error / fine_error) / std::log(double(fine_cells) / coarse_cells);
}

Mesh rotated(Mesh mesh, const Tensor& rotation) {
  for (Vector& x : mesh.points) x = rotation * x;
  compute_geometry(mesh);
  return mesh;
}

Tensor arbitrary_rotation() { return Eigen::AngleAxisd(0.7, Vector(0.3, -0.5, 0.8).normalized()).toRotationMatrix(); }

Mesh extruded_triangles(Index n, const std::vector<double>& levels) {
  CellSoup soup;
  soup.region_names = {"body"};
  const Index row = n + 1, plane = row * row;
  for (const double z : levels)
    for (Index k = 0; k < plane; ++k) {
      const Index i = k % row, j = k / row;
      const bool inner = i > 0 && i < n && j > 0 && j < n;
      const double wobble = inner ? 0.15 / n : 0.0;
      soup.points.emplace_back(double(i) / n + wobble * std::sin(37.0 * k), double(j) / n + wobble * std::sin(91.0 * k),
                               z);
    }
  const auto n_layers = count_of(levels) - 1;
  for (Index layer = 0; layer < n_layers; ++layer)
    for (Index square = 0; square < n * n; ++square) {
      const Index a = layer * plane + square / n * row + square % n, b = a + 1, c = b + row, d = a + row;
      for (const auto& [p, q, r] : {std::array{a, b, c}, std::array{a, c, d}})
        soup.add_cell(CellShape::wedge, std::array{p, r, q, p + plane, r + plane, q + plane}, 0);
    }
  return assemble_mesh(std::move(soup), box_patches({0.0, 0.0, levels.front()}, {1.0, 1.0, levels.back()}));
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

void report_row(const std::string& label, const std::vector<std::pair<std::string, double>>& values) {
  std::string row = label + ":";
  for (const auto& [name, value] : values) {
    row += fmt::format(" {} {:.4g},", name, value);
    testing::Test::RecordProperty(fmt::format("{}: {}", label, name), fmt::format("{:.6g}", value));
  }
  row.pop_back();
  fmt::print("  {}\n", row);
}

}  // namespace pfdm::verification
