// Speed of the kernels on the mesh of a glass bead in Sylgard (twenty layers of prisms): CPU time of the whole process,
// so that threads that wait are paid for, and wall-clock time. memory_bandwidth is the limit that most of them meet.

#include <benchmark/benchmark.h>

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <map>

#include "mesh/generators/particles_in_box.h"
#include "postproc/fields/frame.h"
#include "solver/fracture/damage/damage_equation.h"
#include "solver/momentum/solution/momentum_solver.h"
#include "solver/parallel.h"

namespace pfdm {
namespace {

// Subdivisions of the icosahedron: 40, 110, 390, 1,000 thousand cells.
constexpr Index small = 8, usual = 12, large = 19, largest = 26;

ParticlesInBoxSettings bead_in_cube(Index subdivision) {
  ParticlesInBoxSettings settings;
  settings.lower = Vector::Constant(-4.0);
  settings.upper = Vector::Constant(4.0);
  settings.grading = 0.3 * 12.0 / double(subdivision);
  Particle bead;
  bead.region = "bead";
  bead.radius = 1.0;
  bead.subdivision = subdivision;
  bead.n_layers = 20;
  bead.layer_thickness = 0.4;  // of all together
  settings.particles = {bead};
  return settings;
}

const Mesh& mesh_of(Index subdivision) {
  static std::map<Index, Mesh> meshes;
  const auto found = meshes.find(subdivision);
  return found != meshes.end()
             ? found->second
             : meshes.emplace(subdivision, make_particles_in_box(bead_in_cube(subdivision))).first->second;
}

FractureModel pulled(const Mesh& mesh) {
  FractureModel model;
  for (const std::string& name : mesh.region_names)
    model.regions.push_back(
        {.elasticity = name == "bead" ? from_young_poisson(70e9, 0.3) : from_young_poisson(75e6, 0.44),
         .Gc = 10.0,
         .ell = 0.2,
         .damageable = name != "bead"});
  model.crack = &crack_geometry("AT2");
  model.degradation = degradation("quadratic");
  model.split = energy_split("none");
  for (const Patch& patch : mesh.patches)
    model.boundary.push_back({.patch = patch.name,
                              .displacement_prescribed = {true, true, true},
                              .value = [](const Vector& x, double t) -> Vector { return t * x[2] * Vector::UnitZ(); }});
  return model;
}

// The momentum balance of the undamaged body.
struct Momentum {
  explicit Momentum(const Mesh& mesh)
      : model(pulled(mesh)), unknowns(place_unknowns(mesh, elastic_body(model))), solver(mesh, unknowns) {
    CellField<IsotropicElasticity> moduli(mesh.n_cells());
    for (Index c = 0; c < mesh.n_cells(); ++c) moduli[c] = model.regions[mesh.region[c]].elasticity;
    solver.set_moduli(moduli, CellField<double>(mesh.n_cells(), 1.0));
  }
  FractureModel model;
  Unknowns unknowns;
  MomentumSolver solver;
};

void memory_bandwidth(benchmark::State& state) {
  set_threads(static_cast<int>(state.range(0)));
  constexpr Index n = 20'000'000;
  std::vector<double> a(n, 1.0), b(n, 2.0), c(n, 3.0);
  for ([[maybe_unused]] const auto step : state) {
    parallel_chunks(
        n,
        [&](Index begin, Index end) {
          for (Index i = begin; i < end; ++i) a[i] = b[i] + 0.5 * c[i];
        },
        n / 16);
    benchmark::ClobberMemory();
  }
  state.SetBytesProcessed(state.iterations() * n * 24);
}

void traction_operator(benchmark::State& state) {
  set_threads(static_cast<int>(state.range(0)));
  const Mesh& mesh = mesh_of(usual);
  Momentum momentum(mesh);
  std::vector<Vector> u(momentum.unknowns.n_unknowns(), Vector::Ones()), force(u.size());
  for ([[maybe_unused]] const auto step : state) momentum.solver.balance().apply(u, force);
  state.counters["cells"] = mesh.n_cells();
}

// From nothing to a true residual of 1e-8: multigrid built, all unknowns zero.
void elastic_solve(benchmark::State& state) {
  const Mesh& mesh = mesh_of(static_cast<Index>(state.range(0)));
  set_threads(static_cast<int>(state.range(1)));
  Index iterations = 0;
  for ([[maybe_unused]] const auto step : state) {
    Momentum momentum(mesh);
    std::vector<Vector> u(momentum.unknowns.n_unknowns(), Vector::Zero());
    const Equilibrium equilibrium = momentum.solver.solve(1.0, {.reduction = 0.0, .ceiling = 1e-8, .floor = 1e-8}, u);
    if (!equilibrium.converged) state.SkipWithError("no equilibrium");
    iterations = equilibrium.iterations;
  }
  state.counters["cells"] = mesh.n_cells();
  state.counters["iterations"] = iterations;
}

// From d = 0 to the damage of a driving energy that falls with the distance from the bead.
void damage_solve(benchmark::State& state) {
  set_threads(static_cast<int>(state.range(0)));
  const Mesh& mesh = mesh_of(usual);
  const FractureModel model = pulled(mesh);
  DamageEquation equation(mesh, model, Vector::Zero());
  const CellField<double> zero(mesh.n_cells(), 0.0);
  CellField<double> psi = zero;
  for (Index c = 0; c < mesh.n_cells(); ++c) psi[c] = 200.0 * std::pow(mesh.cell_centre[c].norm(), -6.0);
  for ([[maybe_unused]] const auto step : state) {
    CellField<double> d = zero;
    if (!equation.solve(psi, zero, {.reduction = 1e-3}, d).converged) state.SkipWithError("no solution");
  }
  state.counters["cells"] = mesh.n_cells();
}

void meshing(benchmark::State& state) {
  Index cells = 0;
  for ([[maybe_unused]] const auto step : state) cells = make_particles_in_box(bead_in_cube(usual)).n_cells();
  state.counters["cells"] = cells;
}

void frame_writing(benchmark::State& state) {
  const Mesh& mesh = mesh_of(usual);
  const std::size_t n = mesh.n_cells();
  OutputFields output{.displacement = CellField<Vector>(n),
                      .damage = CellField<double>(n, 0.0),
                      .stress = CellField<Tensor>(n),
                      .strain = CellField<Tensor>(n),
                      .energy_density = CellField<double>(n, 0.0),
                      .driving_energy = CellField<double>(n, 0.0),
                      .fracture_energy_density = CellField<double>(n, 0.0),
                      .traction = {}};
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const Vector x = mesh.cell_centre[c];
    output.displacement[c] = x.array().sin();
    output.damage[c] = 1.0 / (1.0 + x.squaredNorm());
    output.strain[c] = x * x.transpose();
    output.stress[c] = std::exp(x[0]) * output.strain[c];
    output.energy_density[c] = output.driving_energy[c] = std::cos(x[1]);
  }
  const VtuWriter writer(mesh);
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("pfdm_frame_" + std::to_string(::getpid()) + ".vtu");
  for ([[maybe_unused]] const auto step : state) writer.write(path, frame_fields(mesh, output), 1.0);
  state.counters["cells"] = mesh.n_cells();
  state.counters["MB"] = double(std::filesystem::file_size(path)) / 1e6;
  std::filesystem::remove(path);
}

void as_measured(benchmark::internal::Benchmark* b) {
  b->MeasureProcessCPUTime()->UseRealTime()->Unit(benchmark::kMillisecond);
}

BENCHMARK(memory_bandwidth)->ArgName("threads")->Arg(1)->Arg(2)->Apply(as_measured);
BENCHMARK(traction_operator)->ArgName("threads")->Arg(1)->Arg(2)->Apply(as_measured);
BENCHMARK(damage_solve)->ArgName("threads")->Arg(1)->Arg(2)->Apply(as_measured);
BENCHMARK(elastic_solve)
    ->ArgNames({"subdivision", "threads"})
    ->Args({small, 1})
    ->Args({usual, 1})
    ->Args({usual, 2})
    ->Args({large, 1})
    ->Args({largest, 1})
    ->Apply(as_measured);
BENCHMARK(meshing)->Apply(as_measured);
BENCHMARK(frame_writing)->Apply(as_measured);

}  // namespace
}  // namespace pfdm

BENCHMARK_MAIN();
